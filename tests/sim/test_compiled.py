"""Machine code of a law: found again in later processes, and never that of another law."""

import os
import subprocess
import sys
from types import FunctionType, SimpleNamespace

import numpy as np
import pytest

from amp_studio.sim.engine.arrays import Vector
from amp_studio.sim.engine.compiled import can_compile, compiled, kernel_name
from tests.sim import tiny as law

LIMIT = 5.0


def limited(value: float) -> float:
    return min(value, LIMIT)


def sample(p: Vector, s: Vector, io: Vector) -> None:
    io[6] = limited(p[0])


def with_globals(function: FunctionType, **names: object) -> FunctionType:
    return FunctionType(function.__code__, {**function.__globals__, **names}, function.__name__)


def test_the_same_law_has_the_same_name_in_every_process() -> None:
    script = (
        "from amp_studio.sim.engine.compiled import kernel_name; from tests.sim import tiny;"
        "print(kernel_name(tiny.position_sample, tiny.velocity_sample))"
    )
    reported = subprocess.run(
        [sys.executable, "-c", script],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": ".", "PYTHONHASHSEED": "7"},
    )
    assert reported.stdout.strip() == kernel_name(law.position_sample, law.velocity_sample)


def test_another_constant_or_function_far_below_makes_another_name() -> None:
    name = kernel_name(sample, None)
    assert kernel_name(with_globals(sample), None) == name
    assert kernel_name(with_globals(sample, limited=with_globals(limited, LIMIT=6.0)), None) != name
    assert kernel_name(law.position_sample, None) != name
    assert kernel_name(sample, sample) != name


def test_the_environment_can_ask_for_plain_python(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("numba")
    for value, used in (("", True), ("0", True), ("1", False)):
        monkeypatch.setenv("NUMBA_DISABLE_JIT", value)
        assert can_compile() is used


def test_machine_code_that_can_be_stored_nowhere_is_used_all_the_same(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    stored = []

    def njit(first: object, *, cache: bool = False, **_options: object) -> object:
        def jitted(function: FunctionType) -> FunctionType:
            stored.append(cache)
            if cache:
                raise RuntimeError("cannot cache function: no locator available")
            return function

        return first if isinstance(first, FunctionType) else jitted

    numbers = SimpleNamespace(
        njit=njit, float64=np.empty((1, 1), dtype=object), int64=lambda *_types: "signature"
    )
    monkeypatch.setitem(sys.modules, "numba", numbers)
    assert compiled(with_globals(sample), None).__name__.startswith("run_")
    assert stored == [True, False]


def test_linear_algebra_has_one_thread() -> None:
    # Threads that wait for each other made 5 s of 0.7 s on a busy machine.
    script = "import amp_studio.sim, os; print(os.environ['OPENBLAS_NUM_THREADS'])"
    free = {name: value for name, value in os.environ.items() if not name.endswith("_NUM_THREADS")}
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True, env=free
    )
    assert done.stdout == "1\n"
