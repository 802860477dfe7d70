"""Machine code of a law: found again in later processes, and never that of another law."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from types import FunctionType

import numpy as np
import pytest

from amp_studio.sim.engine import machine_code
from amp_studio.sim.engine.arrays import Vector
from amp_studio.sim.engine.compiled import code_of, compiled, kernel_name, plain
from amp_studio.sim.engine.machine_code import VECTOR
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
        assert (compiled(law.position_sample, law.velocity_sample) is not None) is used


KEPT = """
import sys, tests.sim.tiny as law
from amp_studio.sim.axis.motion import Until, run_axis
from amp_studio.sim.command.ramps import move
from amp_studio.sim.engine import machine_code
from amp_studio.sim.engine.signals import POSITION_LOOP
CHANGE
axis = law.tiny()
profile = move(1.0, 100.0, axis.ramps["linear"], 1e-3)
runs = [run_axis(axis, profile, Until(0.1), mode=POSITION_LOOP, engine="compiled") for _ in range(2)]
assert all((runs[0].columns[name] == runs[1].columns[name]).all() for name in runs[0].columns)
print("numba" in sys.modules)
"""
OTHER_VERSION = 'machine_code._makers = lambda: "another version"'
ENDED = "machine_code.child_command = lambda *_: [sys.executable, '-c', 'import os; os.abort()']"


def kept(caches: Path, change: str = "") -> bool:
    """Return whether a process had to make the machine code."""
    own = {"XDG_CACHE_HOME": str(caches / "user"), "PYTHONPYCACHEPREFIX": str(caches / "python")}
    done = subprocess.run(
        [sys.executable, "-c", KEPT.replace("CHANGE", change)],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, **own, "PYTHONPATH": "."},
    )
    return done.stdout == "True\n"


def codes(caches: Path) -> list[Path]:
    return [*caches.glob("python/**/run_*.json")]


def doubled(values: Vector, result: Vector, _: Vector) -> None:
    result[0] = 2.0 * values[0]


def test_only_code_is_kept_that_comes_to_the_same_numbers_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("numba")
    stored: list[str] = []
    monkeypatch.setattr(machine_code, "_keep", lambda name, _: stored.append(name))
    monkeypatch.setattr(machine_code, "_read", lambda _: None)
    apart = machine_code._apart
    for answer, is_kept in ((lambda _: b"other numbers", False), (apart, True)):
        monkeypatch.setattr(machine_code, "_apart", answer)
        code = code_of(doubled, {}, (VECTOR,) * 3, result=False)
        assert code is not None
        for _ in range(2):
            result = np.zeros(1)
            code(np.full(1, 4.5), result, np.zeros(1))
            assert result[0] == 9.0
        assert len(stored) == is_kept


def test_machine_code_is_made_once_and_found_without_numba(tmp_path: Path) -> None:
    pytest.importorskip("numba")
    assert kept(tmp_path, ENDED)
    assert not codes(tmp_path), "LLVM alone does not run it here"
    assert kept(tmp_path)
    assert not kept(tmp_path)
    (code,) = codes(tmp_path)
    code.write_bytes(code.read_bytes()[:-1])
    assert kept(tmp_path), "what is damaged is made again"
    assert kept(tmp_path, OTHER_VERSION), "and so is that of another version"
    # Where compiled modules cannot be kept it is kept in the user's cache.
    (tmp_path / "python").rename(tmp_path / "gone")
    (tmp_path / "python").write_text("no folder")
    assert kept(tmp_path)
    assert not kept(tmp_path)


def test_machine_code_refuses_what_it_would_read_wrongly() -> None:
    pytest.importorskip("numba")
    run = compiled(law.position_sample, law.velocity_sample)
    assert run is not None
    vectors, rows = [np.zeros(80) for _ in range(11)], np.zeros((4, 20))
    for wrong in (np.zeros(80, dtype=np.float32), np.zeros((8, 10)), np.zeros(160)[::2]):
        with pytest.raises(TypeError):
            run(*vectors[:10], wrong, rows)


def test_a_numba_that_cannot_be_imported_is_plain_python(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("numba")
    monkeypatch.setitem(sys.modules, "numba", None)
    assert compiled(with_globals(sample), None) is None
    assert plain(with_globals(sample), None) is not None


def test_linear_algebra_has_one_thread() -> None:
    # Threads that wait for each other made 5 s of 0.7 s on a busy machine.
    script = "import amp_studio.sim, os; print(os.environ['OPENBLAS_NUM_THREADS'])"
    free = {name: value for name, value in os.environ.items() if not name.endswith("_NUM_THREADS")}
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True, env=free
    )
    assert done.stdout == "1\n"
