"""One report row for each value of a file."""

from __future__ import annotations

from dataclasses import dataclass

from amp_studio.files import ParameterFile
from amp_studio.files.local_time import with_local_times
from amp_studio.schema import (
    MASKED,
    Address,
    Parameter,
    StateInfo,
    UnitError,
    Value,
    convert,
    field_value,
    shown,
    write_value,
)

from .axes import axis_label, printed_axes, scope_of
from .model import ReportRow


@dataclass(frozen=True)
class Rows:
    """The printed values of a file in the manual's order, and the number of values not printed."""

    rows: tuple[ReportRow, ...]
    hidden: int
    """Number of hidden values of fitted axes and of the control."""
    unfitted: int
    """Number of values of unfitted axes."""


def rows_of(file: ParameterFile, *, secrets: bool = False) -> Rows:
    """Return a row for every value; hidden values and those of unfitted axes are only counted.

    Secrets are masked unless ``secrets`` is true. Of optional entries (those of a tool table) only the
    values that are set are printed.
    """
    axes = printed_axes(file)
    rows, hidden, unfitted = [], 0, 0
    marks: dict[tuple[str, str], str] = {}
    for address in file.addresses():
        if scope_of(file, address) == "axis" and address[1] not in axes:
            unfitted += 1
        elif (state := file.evaluation.state(address)).state == "hidden":
            hidden += 1
        elif address in file.values or not file.schema.parameters[address[0]].optional:
            rows.append(row_of(file, address, _state_mark(state, marks), secrets=secrets))
    return Rows(tuple(rows), hidden, unfitted)


def _state_mark(state: StateInfo, marks: dict[tuple[str, str], str]) -> str:
    """Return the mark of a state; each different reason gets the next number."""
    letter = {"ignored": "i", "unusable": "u"}.get(state.state)
    if letter is None:
        return ""
    return marks.setdefault(
        (state.state, state.why), f"{letter}{sum(m[0] == letter for m in marks.values()) + 1}"
    )


def row_of(
    file: ParameterFile, address: Address, state_mark: str = "", *, secrets: bool = False
) -> ReportRow:
    """Return the row of one value; ``state_mark`` is the mark of the reason why it is inactive.

    The row of a secret has no default: together with the mark of a change it would reveal the value.
    """
    schema, here = file.schema, file.machine_schema
    parameter = schema.parameters[address[0]]
    value, default, state = file.get(address), file.default(address), file.evaluation.state(address)
    masked = parameter.secret and not secrets
    known = value or default
    unit = (
        known.unit if known else "" if parameter.choices else file.evaluation.unit(address, file.header.units)
    )
    on_axis = scope_of(file, address) == "axis"
    return ReportRow(
        id=address[0],
        instance=address[1],
        number="" if here.is_disputed(address[0]) else here.number(address) or "",
        name=parameter.name,
        group=schema.group_of[address[0]].name,
        place=axis_label(file, address[1]) if on_axis else here.instance_label(address),
        is_set=value is not None,
        value=MASKED if masked and value is not None else _bare(parameter, value),
        unit=unit,
        shown_unit=shown(unit),
        detail=_bits(parameter, value),
        default="" if masked else _default(parameter, default, unit),
        plain_default="" if masked else _bare(parameter, _converted(default, unit)),
        is_changed=value is not None and not file.is_default(address),
        state=state.state,
        why=state.why,
        state_mark=state_mark,
        forced=with_local_times(file.forced.get(address, "")),
    )


def _bare(parameter: Parameter, value: Value | None) -> str:
    """Return a value as exact text without its unit; empty when it is not set."""
    return "" if value is None else write_value(parameter, Value(value.value))


def _default(parameter: Parameter, default: Value | None, unit: str) -> str:
    """Return the default as printed; with its unit if that is not ``unit``."""
    if default is None or default.unit == unit:
        return _bare(parameter, default)
    return f"{_bare(parameter, default)} {shown(default.unit)}".rstrip()


def _converted(default: Value | None, unit: str) -> Value | None:
    """Return a default in another unit; None for a unit of another quantity."""
    if default is None or isinstance(default.value, (str, bool)) or default.unit == unit:
        return default
    try:
        return Value(convert(float(default.value), default.unit, unit), unit)
    except UnitError:
        return None


def _bits(parameter: Parameter, value: Value | None) -> str:
    """Return the meaning of the set bits and the fields of a packed word."""
    if not parameter.bits or value is None or isinstance(value.value, (str, bool)):
        return ""
    word, parts = int(value.value), []
    for bit in parameter.bits:
        field = field_value(bit, word)
        if bit.choices or bit.width > 1:
            label = next((c.label for c in bit.choices or () if c.raw == field), str(field))
            parts.append(f"{bit.label}: {label}")
        elif field:
            parts.append(f"bit {bit.bit}: {bit.label}")
    return "; ".join(parts)
