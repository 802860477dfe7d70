"""Machine code and plain Python give the same answer, and the quicker one is taken."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from amp_studio.sim.rigid import engine, kernel
from amp_studio.sim.rigid.servo import AxisServo
from amp_studio.sim.rigid.step import StepMove, run_step

Axis = Callable[..., AxisServo]

CASES = {
    "closed loop": ({}, StepMove(30.0, 6000.0)),
    "weak": ({"torque_limit_positive": 20.0, "integral_rate": 3.0}, StepMove(-30.0, 6000.0)),
    "zero following error": (
        {
            "zero_following_error": True,
            "feed_forward": 90.0,
            "integral_rate": 2.0,
            "integrator_discharge": 4.0,
        },
        StepMove(30.0, 6000.0),
    ),
    "gain break and suppression": (
        {"gain_break_point": 1.0, "gain_break_ratio": 0.5, "feedrate_suppression": 4.0},
        StepMove(60.0, 6000.0),
    ),
    "friction": ({"coulomb_friction": 5.0, "viscous_friction": 2.0}, StepMove(30.0, 6000.0)),
    "alarm": ({"excess_error": 2.0}, StepMove(30.0, 6000.0)),
    "exponential": ({"exponential_time": 50.0}, StepMove(30.0, 6000.0, mode="exponential")),
    "no ramp, slow servo": ({"servo_period": 7.0}, StepMove(30.0, 6000.0, mode="none")),
}


@pytest.mark.parametrize("name", CASES)
def test_machine_code_gives_the_answer_of_plain_python(axis: Axis, name: str) -> None:
    figures, move = CASES[name]
    servo = axis(**figures)
    plain = run_step(servo, move, engine="plain")
    compiled = run_step(servo, move, engine="compiled")
    assert plain.rows == compiled.rows
    for column, values in plain.columns.items():
        # The same operations in the same order; only the exponential may differ in its last digit.
        assert compiled.columns[column] == pytest.approx(values, rel=1e-12, abs=1e-12), column
    assert plain.alarms == compiled.alarms


def test_a_short_move_does_not_wait_for_machine_code(monkeypatch: pytest.MonkeyPatch) -> None:
    engine.compiled_run_move.cache_clear()
    assert engine.run_move_by("auto", 10_000) is kernel.run_move
    assert engine.run_move_by("auto", 10 * engine.PLAIN_ROWS) is engine.compiled_run_move()
    assert engine.run_move_by("auto", 10) is engine.compiled_run_move()


def test_numba_can_be_switched_off(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")
    assert engine.run_move_by("compiled", 10**9) is kernel.run_move


def test_the_room_opens_without_loading_numba_or_typst(checkout: Path) -> None:
    code = "import sys, amp_studio.sim; print(sorted({'numba', 'llvmlite', 'typst'} & set(sys.modules)))"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=checkout, capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[]"


def test_everything_that_is_compiled_stands_in_one_file() -> None:
    # numba's cache notices a change of the file it compiled from, and of no other.
    parts = (kernel.run_move, *engine._PARTS)
    assert {part.__module__ for part in parts} == {kernel.__name__}
    called = set(kernel.run_move.__code__.co_names)
    for part in engine._PARTS:
        called |= set(part.__code__.co_names)
    functions = {name for name in called if callable(getattr(kernel, name, None))}
    assert functions <= {part.__name__ for part in engine._PARTS}


def test_repeated_runs_give_the_same_bits(axis: Axis) -> None:
    servo, move = axis(), StepMove(30.0, 6000.0)
    first, second = run_step(servo, move), run_step(servo, move)
    assert all(np.array_equal(first.columns[c], second.columns[c]) for c in first.columns)
