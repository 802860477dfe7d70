"""From measured points to what is set in a file: calibration table, reversal error,
and what error is expected to remain.

Motion that is lost at a reversal leaves a rising run behind by half of it and a falling run ahead by the
other half; the mean of both directions is what the table takes away. Points measured with compensation on are
what it has left over, so what it takes away already is added again.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from amp_studio.files import ParameterFile
from amp_studio.schema import (
    UNITS,
    Address,
    Value,
    canonical,
    dimension,
    fault,
    real_value,
    size_of,
    unit_text,
)

from .ballbar import lost_motions
from .compensation import CalibrationTable, Compensation, compensation_of
from .curve import ErrorCurve, mean_curve
from .errors import CalibrationError
from .figures import AxisFigures, figures
from .measurement import Measurement

_USUAL_DECIMALS = 5


@dataclass(frozen=True)
class ProposalRequest:
    """What is to be made of measured points.

    ``was_on``  whether the axis was measured with its compensation on; None for not answered
    ``circle``  which axis of a ball-bar's circle it is, "first" or "second"; "" for not answered
    ``input``, ``start``  as the control's screen asks them, "" for what the present table has,
                          else the usual one
    """

    was_on: bool | None = None
    input: str = ""
    start: str = ""
    table: bool = True
    reversal: bool = True
    circle: str = ""


@dataclass(frozen=True)
class Proposal:
    """What is proposed for an axis; nothing is changed yet. Errors are in ``unit``: mm, deg or counts.

    ``settings``  the values to set
    ``before``    mean errors as measured, ``after`` as expected; ``True`` for the rising direction
    ``reversal``  lost motion that is compensated now and that is proposed;
                  None where there is nothing to propose
    """

    axis: str
    unit: str
    settings: Mapping[Address, Value]
    table: CalibrationTable | None
    reversal: tuple[Fraction, Fraction] | None
    figures: AxisFigures
    before: Mapping[bool, ErrorCurve]
    after: Mapping[bool, ErrorCurve]
    notes: tuple[str, ...]

    @property
    def span_before(self) -> Fraction:
        """Largest less smallest mean error of both directions as measured: E of ISO 230-2."""
        return _span(self.before)

    @property
    def span_after(self) -> Fraction:
        """The same as expected with what is proposed."""
        return _span(self.after)


def _offered(file: ParameterFile) -> Compensation:
    """Return how a family compensates; raises CalibrationError where it does not."""
    offered = compensation_of(file.schema.family.family)
    if not offered.reversal and offered.table is None:
        raise CalibrationError(
            f"{file.schema.family.name} has neither a calibration table nor a reversal error"
        )
    return offered


def _left_over(
    sides: Mapping[bool, ErrorCurve], added: ErrorCurve, removed: ErrorCurve, lost: Fraction
) -> dict[bool, ErrorCurve]:
    """Return the errors that are left of the measured ones: what was compensated already comes on top, what
    will be compensated is taken off; half of the lost motion is missing in each direction.
    """
    # A rising run is behind by half of the lost motion: compensated, it is that much further ahead.
    shifts = {True: lost / 2, False: -lost / 2}
    return {
        side: ErrorCurve(
            tuple((at, e + added.at(at) - removed.at(at) + shifts[side]) for at, e in curve.points)
        )
        for side, curve in sides.items()
    }


def _refuse_compensated(present: CalibrationTable | None, old: Fraction) -> None:
    """Raise CalibrationError for an axis that is compensated: of its errors it must be known whether they
    are what is left.
    """
    if present is not None or old:
        raise CalibrationError(
            "the axis is compensated already: name whether it was measured with compensation on or off"
        )


def propose(file: ParameterFile, axis: str, measurement: Measurement, request: ProposalRequest) -> Proposal:
    """Return what measured points make of an axis (its instance);
    raises CalibrationError for what is to be answered first.
    """
    offered = _offered(file)
    _check_unit(file, offered, axis, measurement.unit)
    present = _present(file, offered, axis, request)
    old = lost_motion(file, offered, axis)
    if request.was_on is None:
        _refuse_compensated(present, old)
    # What was measured with compensation on is the error that it leaves: it comes on top.
    was_on = bool(request.was_on)
    on = old if was_on else Fraction(0)
    notes = [*measurement.notes]
    if measurement.is_circle:
        return _of_circle(file, offered, axis, measurement, request, on, notes)
    sides = _mean_curves(measurement)
    raw = _mean_of_both(measurement)
    added = _curve_of(present if was_on else None)
    settings: dict[Address, Value] = {}
    table = reversal = None
    if request.table:
        table = _table(file, offered, axis, _plus(raw, added), request, present, settings, notes)
    if request.reversal:
        reversal = _reversal(file, offered, axis, measurement, on, settings, notes)
    # Without a new table the present one goes on working.
    removed = _curve_of(table or present)
    # The change against the measurement: what was compensated then is in the measured errors already.
    lost = (reversal[1] if reversal else old) - on
    if len(sides) == 1:
        notes.append("measured in one direction only: the lost motion is not known")
        lost = Fraction(0)
    after = _left_over(sides, added, removed, lost)
    return Proposal(
        axis, measurement.unit, settings, table, reversal, figures(measurement), sides, after, tuple(notes)
    )


def _mean_curves(measurement: Measurement) -> dict[bool, ErrorCurve]:
    """Return the mean errors of each direction that was measured; ``True`` is the rising one."""
    sides = {side: mean_curve(measurement, side) for side in (True, False)}
    return {side: curve for side, curve in sides.items() if curve.points}


def _mean_of_both(measurement: Measurement) -> ErrorCurve:
    """Return the mean errors of both directions; raises CalibrationError where no target has them."""
    curve = mean_curve(measurement)
    if not curve.points:
        raise CalibrationError("no target was reached from both directions")
    return curve


def _curve_of(table: CalibrationTable | None) -> ErrorCurve:
    """Return what a table takes away; no points without one."""
    return table.curve if table is not None else ErrorCurve(())


def _present(
    file: ParameterFile, offered: Compensation, axis: str, request: ProposalRequest
) -> CalibrationTable | None:
    """Return the table that the axis has; raises CalibrationError for one that cannot be read,
    unless it was off: what it takes away does not matter then.
    """
    try:
        return present_table(file, offered, axis)
    except CalibrationError:
        if request.was_on is not False:
            raise
        return None


def _of_circle(
    file: ParameterFile,
    offered: Compensation,
    axis: str,
    measurement: Measurement,
    request: ProposalRequest,
    on: Fraction,
    notes: list[str],
) -> Proposal:
    """Return what the circles of a ball-bar make of an axis: a reversal error and nothing else."""
    if not offered.reversal:
        raise CalibrationError("the control has no reversal error, and a circle gives no calibration table")
    settings: dict[Address, Value] = {}
    notes.append("a ball-bar gives the reversal error of the axis and no calibration table")
    lost = lost_motions(measurement, request.circle)
    reversal = _reversal_of(file, offered, axis, lost, on, settings, notes) if request.reversal else None
    curves = _mean_curves(measurement)
    return Proposal(axis, "deg", settings, None, reversal, figures(measurement), curves, curves, tuple(notes))


def _plus(curve: ErrorCurve, other: ErrorCurve) -> ErrorCurve:
    return ErrorCurve(tuple((at, value + other.at(at)) for at, value in curve.points))


def _span(sides: Mapping[bool, ErrorCurve]) -> Fraction:
    values = [value for curve in sides.values() for _, value in curve.points]
    return max(values) - min(values) if values else Fraction(0)


def axes_of(file: ParameterFile) -> tuple[str, ...]:
    """Return the axes that have a table or a reversal error, those that the file does not hide."""
    offered = compensation_of(file.schema.family.family)
    name = offered.table.parameter if offered.table else offered.reversal
    if not name:
        return ()
    instances = file.machine_schema.instances(file.schema.parameters[name])
    return tuple(axis for axis in instances if file.evaluation.state((name, axis)).state != "hidden")


def base_unit(file: ParameterFile, offered: Compensation, axis: str) -> str:
    """Return the unit in which an axis is measured: mm, deg, or counts where its parameters know no other."""
    address = (offered.table.parameter if offered.table else offered.reversal, axis)
    if file.evaluation.turns(address):
        return "deg"
    return "counts" if file.schema.parameters[address[0]].quantity == "counts" else "mm"


def shown_unit(file: ParameterFile, table: CalibrationTable) -> tuple[str, Fraction]:
    """Return the unit in which a table is shown and typed, that of the file,
    and what one of it is in the unit of the table.
    """
    if table.unit == "mm" and file.header.units == "inch":
        return "in", Fraction("25.4")
    return table.unit, Fraction(1)


def _check_unit(file: ParameterFile, offered: Compensation, axis: str, unit: str) -> None:
    """Raise CalibrationError where positions have no unit of this axis."""
    wanted = base_unit(file, offered, axis)
    if unit != wanted:
        name = {"mm": "a length (mm, in, um)", "deg": "degrees", "counts": "counts"}
        raise CalibrationError(f"the axis is measured in {name[wanted]}, and the points are in {unit}")


def present_table(file: ParameterFile, offered: Compensation, axis: str) -> CalibrationTable | None:
    """Return the table that an axis has; None where it has none.
    Raises CalibrationError for one that cannot be read.
    """
    if offered.table is None:
        return None
    value = file.get((offered.table.parameter, axis))
    if value is None or not str(value.value).strip():
        return None
    return offered.table.read(file, axis, str(value.value))


def lost_motion(file: ParameterFile, offered: Compensation, axis: str) -> Fraction:
    """Return the lost motion that an axis compensates now, in its base unit;
    positive unless its sign has a meaning.
    """
    if not offered.reversal:
        return Fraction(0)
    address = (offered.reversal, axis)
    own = file.get(address)
    if own is None or isinstance(own.value, (str, bool)):
        return Fraction(0)
    scaled = real_value(file.evaluation, address, own)
    value = (
        file.evaluation.canonical(address) if scaled is None else canonical(float(scaled.value), scaled.unit)
    )
    amount = Fraction(repr(float(value)))  # type: ignore[arg-type]  # the parameter is a number: offered.reversal names it
    return amount if offered.is_signed else abs(amount)


def _table(
    file: ParameterFile,
    offered: Compensation,
    axis: str,
    raw: ErrorCurve,
    request: ProposalRequest,
    present: CalibrationTable | None,
    settings: dict[Address, Value],
    notes: list[str],
) -> CalibrationTable | None:
    """Put the table that fits the errors into ``settings`` and return it; None where the control has none."""
    form = offered.table
    if form is None:
        notes.append("the control has no calibration table of an axis; only the reversal error is proposed")
        return None
    address = (form.parameter, axis)
    state = file.evaluation.state(address)
    if not state.is_active:
        raise CalibrationError(f"the calibration table of this axis is not used: {state.why}")
    before = (present.input, present.start) if present else ("", "")
    input_, start = request.input or before[0], request.start or before[1]
    if present and (input_, start) != before:
        notes.append("input and start can be chosen again because all points are replaced")
    fitted = form.fit(file, axis, raw, input_, start)
    notes += fitted.notes
    settings[address] = Value(form.write(file, axis, fitted.table))
    return fitted.table


def _reversal(
    file: ParameterFile,
    offered: Compensation,
    axis: str,
    measurement: Measurement,
    on: Fraction,
    settings: dict[Address, Value],
    notes: list[str],
) -> tuple[Fraction, Fraction] | None:
    """Return the lost motion that is compensated now and the one proposed; None where nothing is proposed."""
    up, down = measurement.errors(rising=True), measurement.errors(rising=False)
    common = [at for at in up if at in down]
    lost = [_mean(down[at]) - _mean(up[at]) for at in common]
    return _reversal_of(file, offered, axis, lost, on, settings, notes) if lost and offered.reversal else None


def _reversal_of(
    file: ParameterFile,
    offered: Compensation,
    axis: str,
    lost: list[Fraction],
    on: Fraction,
    settings: dict[Address, Value],
    notes: list[str],
) -> tuple[Fraction, Fraction] | None:
    """Return the same for lost motions that were measured at several places; ``on`` is compensated
    already.
    """
    address = (offered.reversal, axis)
    total = _mean(lost) + on
    if _mean(lost) < 0 and not on:
        notes.append("motion is gained at a reversal instead of lost: check the sign of the errors")
    state = file.evaluation.state(address)
    if not state.is_active:
        notes.append(f"no reversal error is proposed: {state.why}")
        return None
    # An amount without a sign cannot express motion that is gained: 0 is the nearest that can be set.
    if total < 0 and not offered.is_signed:
        if on:
            total = Fraction(0)
            notes.append("more is compensated than motion is lost: the reversal error becomes 0")
        else:
            return None
    low = min(lost) + on
    if low < total:
        notes.append(
            f"lost motion differs over the travel: the least is {float(low):.5f}"
            f" {base_unit(file, offered, axis)}, and the manuals warn of a value above it"
        )
    # In fractions up to here: what is shown as the remaining error is computed with the figure that the
    # control gets, to its last digit.
    value, made = rounded(file, address, total)
    if not offered.is_signed:
        value = _with_sign_of(value, file.get(address))
    if message := fault(file.evaluation, address, value):
        notes.append(f"no reversal error is proposed: {message}")
        return None
    settings[address] = value
    return lost_motion(file, offered, axis), made


def _with_sign_of(value: Value, present: Value | None) -> Value:
    """Return an amount with the sign of the value that the file has: there it decides nothing, and stays."""
    number = present.value if present is not None else None
    if isinstance(number, (str, bool)) or number is None or number >= 0 or not value.value:
        return value
    return Value(-value.value, value.unit)  # type: ignore[operator]  # a rounded value is a number


def rounded(file: ParameterFile, address: Address, amount: Fraction) -> tuple[Value, Fraction]:
    """Return an amount (mm, deg, counts) as a value in the unit of entry, rounded towards zero,
    and what it is then.
    """
    parameter = file.schema.parameters[address[0]]
    unit = file.evaluation.unit(address, file.header.units)
    size = size_of(file.evaluation, address, unit)
    if size is None and dimension(unit) not in ("length", "angle", "") and unit != "counts":
        raise CalibrationError(
            f"the size of {unit_text(unit)} is not set, so no value of {parameter.name} can be worked out"
        )
    factor = size.number * UNITS[size.unit][1] if size is not None else UNITS[unit][1]
    decimals = parameter.decimals
    if decimals is None:
        decimals = (parameter.storage.decimals if parameter.storage else None) or _USUAL_DECIMALS
    step = Fraction(1) if parameter.type == "integer" else Fraction(1, 10**decimals)
    # Manuals warn of more compensation than motion is lost, not of less.
    steps = int(amount / factor / step)  # towards zero
    number = steps * step
    whole = parameter.type == "integer"
    return Value(int(number) if whole else float(number), unit), number * factor


def _mean(values: list[Fraction]) -> Fraction:
    return sum(values, Fraction(0)) / len(values)
