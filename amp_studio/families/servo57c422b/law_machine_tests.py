"""Tasks that try an axis of a 57C422B out: home and move, in the form of the programs of pages 5-6 to 5-8,
with this file's figures.
"""

from __future__ import annotations

from amp_studio.sim import AxisLaw, BoundMachine, MachineTest, MachineTestStep, SimulationError, value_text

from .law_facts import ids

COUNTS = 65536
MOVE_WORDS = (
    ("17", ids.command_position),
    ("19", ids.command_velocity),
    ("21", ids.command_acceleration),
    ("23", ids.command_deceleration),
)


def machine_tests(machine: BoundMachine, axis: AxisLaw) -> list[MachineTest]:
    """Return the tasks of one axis."""
    return [_home(axis), _move(machine, axis)]


def _base(axis: str) -> int:
    return 2048 if axis == "Y" else 0


def _home(axis: AxisLaw) -> MachineTest:
    title = "Home the axis by the sequence of register 2"
    try:
        homing = axis.homing() if axis.homing else None
    except SimulationError as error:
        return MachineTest("home", title, "5-6", refusal=str(error))
    if homing is None:
        return MachineTest("home", title, "5-6", refusal="No homing of this axis is known.")
    base = _base(axis.axis)
    lines = (
        f"! register {base + 65} bit 0 on: the loop is closed and the setups are read (4-24)",
        (
            f"! register {base + 66} bit 2 on: home (4-29); off again once register {base + 72} bit 15 is on"
            " (4-36)"
        ),
        f"! wait until register {base + 72} bit 0 is on: axis done (4-43)",
    )
    steps = (
        MachineTestStep(
            "Jog the axis away from the switch, and home it",
            f"register {base + 74} shows {value_text(homing.coordinate, axis.unit)} at the place of "
            "the marker or"
            " switch",
        ),
        MachineTestStep(
            "Home it again from the other side of the machine", "the axis rests at the same place"
        ),
    )
    return MachineTest("home", title, "5-6", lines, steps, homing.notes)


def _move(machine: BoundMachine, axis: AxisLaw) -> MachineTest:
    title = "One move out and back at the speeds of the file"
    read, base = machine.read(axis.axis), _base(axis.axis)
    figures = {number: read.optional(name) for number, name in MOVE_WORDS}
    if missing := [number for number, figure in figures.items() if figure is None]:
        return MachineTest("move", title, "5-7", refusal=f"Registers {', '.join(missing)} are not set.")
    target = figures["17"] or 0.0
    for low, high in axis.travel().limits.values() if axis.travel else ():
        if not low <= target <= high:
            return MachineTest(
                "move",
                title,
                "5-7",
                refusal=(
                    f"The position of registers 17, 18, {target:g}, is outside of the software overtravel."
                ),
            )
    lines = (
        f"! registers {base + 17}, {base + 18}: position {target:g} counts, then 0",
        f"! register {base + 66} bit 0 on: move (4-28); off once register {base + 72} bit 15 is on (4-36)",
    )
    steps = (
        MachineTestStep(
            "Move, and read register 80 while it goes",
            "the error is small and has the sign of the motion (page 5-4)",
        ),
        MachineTestStep("Move back", f"register {base + 72} bits 0 and 1 come on: axis done and locked"),
    )
    return MachineTest("move", title, "5-7", lines, steps)
