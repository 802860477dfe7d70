"""The procedures of the Syntec slides as steps with this file's figures: homing (2.2),
and the stroke limits (3.2).
"""

from __future__ import annotations

import math

from amp_studio.sim import AxisLaw, BoundMachine, MachineTest, MachineTestStep, SimulationError, value_text


def machine_tests(machine: BoundMachine, axis: AxisLaw) -> list[MachineTest]:
    """Return the procedures of one axis; they have no program."""
    letter = machine.letter(axis.axis) or axis.axis
    return [_homing(axis, letter), _limits(axis, letter)]


def _homing(axis: AxisLaw, letter: str) -> MachineTest:
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
