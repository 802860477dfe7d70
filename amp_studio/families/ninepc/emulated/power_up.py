"""What a 9/PC makes of its AMP when it starts: why it stays in E-Stop, and what its screen shows.

Written from the reference manual alone; a page is beside each behaviour. Assumed, because it is not printed:
to which values the following-error limits are corrected (here the smaller ones become smaller, Excess Error
stays as it protects the machine), that the stored AMP stays as it is, the order of several messages,
and all words but those in capitals.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, StorageError, stored_unit, to_stored, write_number

AXES = tuple("12345678")
MAX_AXES = 8
"""Of the series, with spindles; which of them were ordered decides for one control (page 3-1)."""
_MAX_SPINDLES = 2
_LIMITS = (
    "servo.inposition_band",
    "servo.gain_break_point",
    "servo.feedrate_suppression",
    "servo.excess_error",
)
_STEP = Fraction(1, 100_000)
"""The last decimal of the limits in Patch AMP (page 37-3)."""
_DAC_FUNCTIONS = (100, 200, 300, 400, 500, 600)
CORRECTED = "SERVO AMP FE LIMITS CORRECTED"


def fitted(file: ParameterFile) -> list[str]:
    """Return the numbers of the axes and spindles that the AMP configures."""
    return [axis for axis in AXES if _choice(file, ("axis.type", axis)) not in ("", "unfitted")]


def estop_reasons(file: ParameterFile, axes: int) -> Iterator[str]:
    """Yield each reason why a control that supports so many axes does not come out of E-Stop with this
    AMP.
    """
    here = fitted(file)
    spindles = [axis for axis in here if _choice(file, ("axis.type", axis)) == "spindle"]
    if len(here) > axes:
        yield f"{len(here)} axes are configured and the control supports {axes} (page 3-1)"
    if len(spindles) > _MAX_SPINDLES:
        yield f"{len(spindles)} spindles are configured and the control supports {_MAX_SPINDLES} (page 3-1)"
    for axis in here:
        if _choice(file, ("servo.loop_type", axis)) in ("", "none"):
            yield f"axis {axis} has a type and no Servo Loop Type (page 3-7)"
    yield from _dual_groups(file, here)
    modes = {_choice(file, (f"tool.{which}_mode", "")) for which in ("geometry", "wear")}
    if modes == {"shift-move", "shift-delayed-move"}:
        yield "INCOMPATIBLE TOOL ACTIVATION MODES (page 21-4)"
    yield from _monitor_codes(file)


def _monitor_codes(file: ParameterFile) -> Iterator[str]:
    """Yield the errors of power-up in the outputs of the DAC monitor."""
    for instance, number in (("2", 86), ("3", 87)):
        code = _number(file, ("patch.dac_monitor", instance))
        # By the manual no value switches the monitor off; 0 is taken as off.
        if code and not _is_dac_code(code):
            yield (
                f"parameter {number} contains {write_number(float(code))}, which is no function and axis"
                " (page A-6)"
            )


def _dual_groups(file: ParameterFile, here: list[str]) -> Iterator[str]:
    """Yield the dual groups whose first axis has no name."""
    groups: dict[str, str] = {}
    for axis in here:
        group = _choice(file, ("dual.group", axis))
        if group not in ("", "independent"):
            groups.setdefault(group, axis)
    for group, master in groups.items():
        name = _choice(file, ("axis.name", master))
        if name in ("", "none") or name.startswith("$"):
            yield f"dual axis group {group.removeprefix('g')} has no valid master name (page 31-3)"


def corrected_limits(file: ParameterFile) -> dict[str, dict[Address, Fraction]]:
    """Return axis -> the following-error limits that the control corrects,
    in the unit of Patch AMP (page 7-20).
    """
    found = {}
    for axis in fitted(file):
        numbers = {(name, axis): _number(file, (name, axis)) for name in _LIMITS}
        limits = {address: number for address, number in numbers.items() if number is not None}
        if len(limits) == len(numbers) and (changed := _lowered(limits)):
            found[axis] = changed
    return found


def _lowered(limits: Mapping[Address, Fraction]) -> dict[Address, Fraction]:
    """Return the limits that are not below the next one, from the highest down, as they then are."""
    changed: dict[Address, Fraction] = {}
    above: Fraction | None = None
    for address, value in reversed([*limits.items()]):
        most = value
        if above is not None:
            is_equal_allowed = address[0] == "servo.feedrate_suppression"
            most = above if is_equal_allowed else max(above - _STEP, Fraction(0))
        above = min(value, most)
        if above < value:
            changed[address] = above
    return changed


def _is_dac_code(code: Fraction) -> bool:
    return any(code - function in range(1, MAX_AXES + 1) for function in _DAC_FUNCTIONS)


def _choice(file: ParameterFile, address: Address) -> str:
    value = file.get(address) or file.default(address)
    return "" if value is None else str(value.value)


def _number(file: ParameterFile, address: Address) -> Fraction | None:
    """Return a value as the control stores it; None where there is none."""
    value = file.get(address)
    if value is None:
        return None
    parameter = file.schema.parameters[address[0]]
    try:
        return to_stored(parameter, value, stored_unit(parameter, turns=file.evaluation.turns(address)))
    except StorageError:
        return None
