"""Tasks that try an axis of a 57C422B out: home, move, gear, velocity and cam, in the form of the programs of
pages 5-6 to 5-10, with this file's figures.

Its statements are those of a BASIC task: ``CMD_VEL!`` is the variable of registers 19 and 20 (page 4-48), of
axis Y ``REG_2067!``. Each ends with its way to stop.
"""

from __future__ import annotations

from amp_studio.sim import AxisLaw, BoundMachine, MachineTest, MachineTestStep, SimulationError, value_text

from . import switch_bits as bits
from .formulas import acceleration_word, gear_ratio_word, velocity_word
from .law_axis import ModuleAxis
from .law_facts import ids
from .law_gear import LARGEST, SMALLEST

_MOVE_WORDS = (
    ("17", ids.command_position),
    ("19", ids.command_velocity),
    ("21", ids.command_acceleration),
    ("23", ids.command_deceleration),
)
_VARIABLES = {
    15: "HOME_SPD!",
    17: "CMD_POS!",
    19: "CMD_VEL!",
    21: "CMD_ACC!",
    23: "CMD_DEC!",
    25: "GEAR_RATIO!",
    65: "MODES%",
    66: "CMD66%",
    67: "CMD67%",
    130: "CAM_MODE%",
    131: "CAM_LOOPBACK%",
}
"""Register -> its variable in the printed programs (5-5 to 5-10)."""


def machine_tests(machine: BoundMachine, axis: AxisLaw) -> list[MachineTest]:
    """Return the tasks of one axis."""
    assert isinstance(axis, ModuleAxis)
    return [_wiring(axis), _home(axis), _move(machine, axis), _gear(axis), _velocity(axis), _cam(axis)]


def _variable(axis: str, register: int) -> str:
    """Return the variable of a register of an axis."""
    name = _VARIABLES[register]
    return f"REG_{register + _base(axis)}{name[-1]}" if _base(axis) else name


def _set(axis: AxisLaw, register: int, number: float | str) -> str:
    return f"{_variable(axis.axis, register)}={number if isinstance(number, str) else round(number)}"


def _masked(axis: AxisLaw, mask: str, bits: str = "") -> str:
    """Return the statement that clears bits of the mode, or sets some."""
    mode = _variable(axis.axis, 65)
    return f"{mode}={mode} OR {bits}" if bits else f"{mode}={mode} AND {mask}"


def _rates(axis: ModuleAxis) -> list[str]:
    """Return the assignments of velocity and ramps, which binding has found set."""
    ramp = axis.ramps["linear"]
    return [
        _set(axis, 19, velocity_word(axis.feedrate or 0.0)),
        _set(axis, 21, acceleration_word(ramp.acceleration)),
        _set(axis, 23, acceleration_word(ramp.deceleration)),
    ]


def _command(axis: AxisLaw, register: int, bit: str) -> str:
    return rf"{_set(axis, register, bit)} \GOSUB 25000"


def _base(axis: str) -> int:
    return 2048 if axis == "Y" else 0


def _wiring(axis: ModuleAxis) -> MachineTest:
    """Return the check of the inputs that register 2 uses (step 15 of the installation)."""
    title, setup = "Inputs of the axis, before the drive has power", axis.register(ids.setup_switches)
    used = [name for bit, name in bits.INPUTS.items() if setup is None or int(setup) & bit]
    steps = tuple(
        MachineTestStep(
            f"Switch the {name} on and off by hand", "its LED on the faceplate of the module follows"
        )
        for name in (*used, "registration input, where there is one")
    )
    note = "A signal that is too short to be seen needs an oscilloscope (3-9)."
    doubt = bits.SWITCHES if setup is not None else "Register 2 is not set: all inputs are listed."
    return MachineTest("wiring", title, "3-9", steps=steps, notes=(note, doubt))


def _home(axis: ModuleAxis) -> MachineTest:
    """Return the test of the homing, or why there is none."""
    title = "Home the axis by the sequence of register 2"
    try:
        homing = axis.homing() if axis.homing else None
    except SimulationError as error:
        return MachineTest("home", title, "5-6", refusal=str(error))
    if homing is None:
        return MachineTest("home", title, "5-6", refusal="No homing of this axis is known.")
    base, ramp = _base(axis.axis), axis.ramps["linear"]
    speeds = ((15, abs(homing.leave)), (19, abs(homing.approach)))
    lines = (
        *(_set(axis, register, velocity_word(speed)) for register, speed in speeds if speed),
        _set(axis, 17, homing.coordinate),
        _set(axis, 21, acceleration_word(ramp.acceleration)),
        _set(axis, 23, acceleration_word(ramp.deceleration)),
        _masked(axis, "0FEH"),
        "DELAY 10 TICKS",
        _masked(axis, "", "1"),
        _command(axis, 66, "4"),
        f"! until register {base + 72} bit 0 is on: axis done (4-43)",
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


def _move(machine: BoundMachine, axis: ModuleAxis) -> MachineTest:
    """Return the test of one move out and back, or why there is none."""
    title = "One move out and back at the speeds of the file"
    read, base = machine.read(axis.axis), _base(axis.axis)
    figures = {number: read.optional(name) for number, name in _MOVE_WORDS}
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
        _set(axis, 17, target),
        *_rates(axis),
        _command(axis, 66, "1"),
        f"! until register {base + 72} bit 0 is on: axis done (4-43)",
        _set(axis, 17, 0),
        _command(axis, 66, "1"),
    )
    steps = (
        MachineTestStep(
            f"Move, and read register {base + 80} while it goes",
            "the error is small and has the sign of the motion (page 5-4)",
        ),
        MachineTestStep("Move back", f"register {base + 72} bits 0 and 1 come on: axis done and locked"),
    )
    return MachineTest("move", title, "5-7", lines, steps)


def _gear(axis: ModuleAxis) -> MachineTest:
    """Gearing on, the ratio changed while it runs, and off (5-8)."""
    title, base = "Gear the axis to a reference that moves slowly", _base(axis.axis)
    ratio = axis.register(ids.gear_ratio)
    if ratio is None:
        return MachineTest("gear", title, "5-8", refusal=f"{axis.names[ids.gear_ratio]} is not set.")
    if not SMALLEST <= abs(ratio) <= LARGEST:
        refusal = f"The gear ratio {ratio:g} is not between 1:32767 and 127:1 (4-15)."
        return MachineTest("gear", title, "5-8", refusal=refusal)
    top = (axis.feedrate or 0.0) / abs(ratio)
    lines = (
        _set(axis, 25, gear_ratio_word(abs(ratio))),
        _masked(axis, "0ADH"),
        *([_masked(axis, "", "010H")] if ratio < 0.0 else ()),
        _masked(axis, "", "2"),
        "! wait for the first step below; another ratio while it runs:",
        _command(axis, 67, "8"),
        "! off:",
        _masked(axis, "0ADH"),
    )
    steps = (
        MachineTestStep(
            f"With the reference at rest switch gearing on; then turn it slowly, at most"
            f" {value_text(top, 'counts/s')}",
            f"the axis goes {abs(ratio):g} times the counts of the reference"
            f"{', the other way' if ratio < 0.0 else ''}; register {base + 80} stays small",
        ),
        MachineTestStep("Switch gearing off", "the axis does not follow the reference any more"),
    )
    notes = (
        "Bit 4 of the mode is the direction: off where axis and reference shall turn the same way (5-8).",
    )
    return MachineTest("gear", title, "5-8", lines, steps, notes)


def _velocity(axis: ModuleAxis) -> MachineTest:
    """Velocity control at half of the speed, another velocity, and off (5-9)."""
    title, base = "Velocity control at half of the speed of the file", _base(axis.axis)
    half = 0.5 * (axis.feedrate or 0.0)
    ramp = axis.ramps["linear"]
    lines = (
        _masked(axis, "0AFH"),
        f"! for the other way: {_masked(axis, '', '010H')}",
        _set(axis, 19, velocity_word(half)),
        _set(axis, 21, acceleration_word(ramp.acceleration)),
        _set(axis, 23, acceleration_word(ramp.deceleration)),
        _masked(axis, "", "4"),
        "! wait for the first step below; another velocity while it runs:",
        _set(axis, 19, velocity_word(0.5 * half)),
        _command(axis, 66, "0100H"),
        "! off:",
        _masked(axis, "0BBH"),
    )
    limits = list(axis.travel().limits.values()) if axis.travel else []
    stop = half * half / (2.0 * ramp.deceleration)
    notes = [f"From {value_text(half, 'counts/s')} it stops within {value_text(stop, 'counts')} (5-9)."]
    if not limits:
        notes.append("No software overtravel is active on this axis: it turns until it is switched off.")
    elif min(high - low for low, high in limits) < stop * 2.0:
        short = f"The travel is shorter than twice the way of stopping, {value_text(stop, 'counts')}."
        return MachineTest("velocity", title, "5-9", refusal=short)
    steps = (
        MachineTestStep(
            "Switch velocity control on", f"register {base + 81}, the velocity error, goes to nearly 0 (5-4)"
        ),
        MachineTestStep("Switch it off", "the axis stops smoothly and cleanly (5-4)"),
    )
    return MachineTest("velocity", title, "5-9", lines, steps, tuple(notes))


def _cam(axis: ModuleAxis) -> MachineTest:
    """The cam of the registers, started and stopped (5-10)."""
    title, base = "Cam of the registers, from its first point", _base(axis.axis)
    points, mode = axis.register(ids.cam_points), axis.register(ids.cam_mode)
    if not points or mode is None:
        what = axis.names[ids.cam_points]
        return MachineTest("cam", title, "5-10", refusal=f"{what} is 0 or not set, or Cam Mode is not set.")
    lines = (
        _set(axis, 131, axis.register(ids.loop_back) or 0.0),
        _set(axis, 130, mode),
        _command(axis, 66, "080H"),
        "! end it: stop motion (4-31)",
        _command(axis, 66, "040H"),
    )
    scan = axis.register(ids.cam_time) or 1.25
    is_position = bool(int(mode) >> 8 & 1)
    lasts = "" if is_position else f" in {value_text(points * scan / 1000.0, 's')}"
    steps = (
        MachineTestStep(
            "Home the axis, and begin the cam with the machine empty",
            f"the {points:g} points are run through{lasts}, and register {base + 80} stays below"
            f" {axis.limits.get('maximum_position_error', 0.0):g} counts",
        ),
        MachineTestStep("Stop the motion", "the axis comes to rest by its deceleration"),
    )
    return MachineTest("cam", title, "5-10", lines, steps)
