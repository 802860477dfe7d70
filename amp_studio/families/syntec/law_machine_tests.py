"""The procedures of the Syntec slides as steps with this file's figures: the zero point of an absolute
encoder (2.1), homing (2.2), and the stroke limits (3.2).
"""

from __future__ import annotations

import math

from amp_studio.sim import AxisLaw, BoundMachine, MachineTest, MachineTestStep, SimulationError, value_text

from .law_facts import ids


def machine_tests(machine: BoundMachine, axis: AxisLaw) -> list[MachineTest]:
    """Return the procedures of one axis; they have no program."""
    letter = machine.letter(axis.axis) or axis.axis
    is_absolute = machine.read(axis.axis).value(ids.encoder_type) == "absolute"
    return [_zero_point(letter, is_absolute=is_absolute), _homing(axis, letter), _limits(axis, letter)]


def _zero_point(letter: str, *, is_absolute: bool) -> MachineTest:
    """Return the setting of an absolute encoder, or why there is none."""
    title = "Zero point of an absolute encoder"
    if not is_absolute:
        why = (
            f"The encoder of {letter} is no absolute one (Pr201 to Pr220 = 3): a search homes it"
            " (section 2.2)."
        )
        return MachineTest("zero-point", title, "2.1", refusal=why)
    steps = (
        MachineTestStep(
            f"Look at the motor of axis {letter}, and at Pn002 of its drive",
            "the fourth digit of the motor is 3, a 20-bit absolute encoder; Pn002 is 0000",
        ),
        MachineTestStep(
            f"Move axis {letter} to where its zero point shall be, and choose the mode HOME",
            "the machine position is that place",
        ),
        MachineTestStep(
            f"On the page of the serial parameters press F7, put the cursor on {letter}, and press F1",
            "its status is no longer red, but yellow: Set OK",
        ),
    )
    return MachineTest("zero-point", title, "2.1", steps=steps)


def _homing(axis: AxisLaw, letter: str) -> MachineTest:
    """Return the test of a search for the dog, or why there is none."""
    title = "Home grid and repeatability"
    try:
        homing = axis.homing() if axis.homing else None
    except SimulationError as error:
        return MachineTest("homing", title, "2.2", refusal=str(error))
    if homing is None:
        return MachineTest("homing", title, "2.2", refusal=f"Axis {letter} is not homed by a search.")
    speeds = [
        f"{value_text(abs(speed) * 60.0, f'{axis.unit}/min')} {where}"
        for speed, where in ((homing.approach, "onto the dog"), (homing.leave, "off it"))
        if speed
    ]
    steps = (
        MachineTestStep(
            f"Home axis {letter} (R13 = 7) and watch C79 to C82",
            f"{', '.join(speeds)}; the bit of the dog is on while the dog is met",
        ),
        MachineTestStep(
            "Read the home grid on the diagnosis page",
            "20 to 80 % of a pitch; below and above it move the dog, or use Pr941",
        ),
        MachineTestStep(
            "Home it five times",
            "the grids differ by less than 0.1 turn, else MOT-022 comes; S16 to S19 come on",
        ),
    )
    return MachineTest("homing", title, "2.2", steps=steps)


def _limits(axis: AxisLaw, letter: str) -> MachineTest:
    """Return the test of the first stroke limit, or why there is none."""
    title = "First stroke limit, jogged against at a low speed"
    limits = list(axis.travel().limits.values()) if axis.travel else []
    places = [place for edges in limits for place in edges if math.isfinite(place)]
    if not places:
        return MachineTest("limits", title, "3.2", refusal=f"No first stroke limit of axis {letter} is set.")
    steps = tuple(
        MachineTestStep(
            f"Home axis {letter}, and jog it towards {value_text(place, axis.unit)}",
            f"{'MOT-018' if place == min(places) else 'MOT-017'} comes, and the axis stops before its hard"
            " stop",
        )
        for place in places
    )
    return MachineTest("limits", title, "3.2", steps=steps)
