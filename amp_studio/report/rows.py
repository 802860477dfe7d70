"""One report row for each value of a file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from amp_studio.files import ParameterFile, value_note, with_local_times
from amp_studio.schema import (
    MASKED,
    Address,
    Bit,
    MachineSchema,
    Parameter,
    StateInfo,
    UnitError,
    Value,
    convert,
    dimension,
    field_value,
    unit_text,
    write_value,
)

from .axes import axis_label, place_of, printed_axes, scope_of
from .contents import UnitChoice
from .data_values import data_of
from .language import ENGLISH, Language
from .model import ReportRow

_EXACT = 9
"""Most digits of a converted figure that is exact; with more of them it would be the same figure by
chance."""
_ROUNDED = 7
"""Digits of a converted figure that is not exact."""


@dataclass(frozen=True)
class Rows:
    """The values of a file in the manual's order, and the number of values that no report prints."""

    rows: tuple[ReportRow, ...]
    hidden: int
    """Number of hidden values of fitted axes and of the control."""
    unfitted: int
    """Number of values of unfitted axes."""


def rows_of(file: ParameterFile, units: UnitChoice = "file", language: Language = ENGLISH) -> Rows:
    """Return a row for every value; hidden values and those of unfitted axes are only counted.

    Of optional entries (those of a tool table) there are only rows for the values that are set.
    """
    axes = printed_axes(file)
    # Once for all rows: a label looks through all axes for the same letter.
    labels = {axis: axis_label(file, axis) for axis in axes}
    rows, hidden, unfitted = [], 0, 0
    marks: dict[tuple[str, str], str] = {}
    for address in file.addresses():
        if scope_of(file, address) == "axis" and address[1] not in axes:
            unfitted += 1
        elif (state := file.evaluation.state(address)).state == "hidden":
            hidden += 1
        elif address in file.values or not file.schema.parameters[address[0]].optional:
            place = labels[address[1]] if scope_of(file, address) == "axis" else None
            rows.append(row_of(file, address, _state_mark(state, marks), units, place, language))
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
    file: ParameterFile,
    address: Address,
    state_mark: str = "",
    units: UnitChoice = "file",
    place: str | None = None,
    language: Language = ENGLISH,
) -> ReportRow:
    """Return the row of one value; ``state_mark`` is the mark of the reason why it is inactive,
    ``place`` is ``place_of`` where it is known. What is printed is in a language; what is exported
    (``value``, ``unit``, ``plain_default``) is as in the file.

    Secrets are masked. The row of a secret has no default:
    together with the mark of a change it would reveal the value.
    """
    schema, here = file.schema, file.machine_schema
    parameter = schema.parameters[address[0]]
    value, default, state = file.get(address), file.default(address), file.evaluation.state(address)
    unit = _unit_of_entry(file, address)
    figure, printed_unit, also = _printed(file, address, unit, units)
    plain, data = _bare(parameter, value), data_of(parameter, value)
    if parameter.secret:
        plain = figure = MASKED if value is not None else ""
        also, default, data = "", None, None
    is_number = parameter.type in ("real", "integer")
    # Of a secret too: without a default beside it the mark reveals nothing.
    is_changed = value is not None and not file.is_default(address)
    # Not ``default``, which a secret row lacks.
    has_default = file.default(address) is not None
    return ReportRow(
        id=address[0],
        instance=address[1],
        number=_number_of(here, address),
        name=parameter.name,
        group=schema.group_of[address[0]].name,
        place=place_of(file, address) if place is None else place,
        is_set=value is not None,
        is_number=is_number,
        value=plain,
        unit=unit,
        figure=language.number(figure) if is_number else figure,
        shown_unit=language.unit(unit_text(printed_unit)),
        also=language.quantity(also),
        entered=language.quantity(_with_unit(plain, unit)) if figure.startswith("≈") else "",
        detail=_bits(parameter, value, language),
        default=_printed_default(parameter, default, printed_unit, language),
        plain_default=_bare(parameter, _converted(default, unit)),
        is_changed=is_changed and has_default,
        no_default=is_changed and not has_default,
        state=state.state,
        why=language.sentence(state.why),
        state_mark=state_mark,
        forced=with_local_times(file.forced.get(address, "")),
        note=" ".join(value_note(file, address).split()),
        data=data,
        default_data=data_of(parameter, _converted(default, unit)),
    )


def _number_of(here: MachineSchema, address: Address) -> str:
    """Return the number as the manual has it; "" where it prints one by mistake, or none."""
    return "" if here.is_disputed(address[0]) else here.number(address) or ""


def _unit_of_entry(file: ParameterFile, address: Address) -> str:
    known = file.get(address) or file.default(address)
    if known:
        return known.unit
    has_choices = file.schema.parameters[address[0]].choices
    return "" if has_choices else file.evaluation.unit(address, file.header.units)


def _printed(file: ParameterFile, address: Address, unit: str, units: UnitChoice) -> tuple[str, str, str]:
    """Return a value as printed, its unit, and the value in the other unit system where both are wanted."""
    parameter, value = file.schema.parameters[address[0]], file.get(address)
    system = units if units in ("metric", "inch") else file.header.units
    printed_unit = _unit_for(file, address, unit, system)
    figure = _figure(parameter, value, printed_unit)
    other = _unit_for(file, address, unit, "inch" if system == "metric" else "metric")
    if units != "both" or value is None or other == printed_unit:
        return figure, printed_unit, ""
    return figure, printed_unit, _with_unit(_figure(parameter, value, other), other)


def _bare(parameter: Parameter, value: Value | None) -> str:
    """Return a value as exact text without its unit; empty when it is not set."""
    return "" if value is None else write_value(parameter, Value(value.value))


def _unit_for(file: ParameterFile, address: Address, unit: str, system: str) -> str:
    """Return the unit of entry of a value in a unit system; its own unit where it cannot be given in that."""
    wanted = file.evaluation.unit(address, system)
    return wanted if dimension(wanted) == dimension(unit) else unit


def _figure(parameter: Parameter, value: Value | None, unit: str) -> str:
    """Return a value in a unit as printed: exact, or with ``≈`` where it is rounded to seven digits."""
    other = _converted(value, unit)
    if other is None or other is value or value is None or isinstance(other.value, (str, bool)):
        return _bare(parameter, other or value)
    for digits in range(1, _EXACT + 1):
        rounded = float(f"{other.value:.{digits}g}")
        # The fewest digits that come back to the entered value: all others are of the conversion.
        if convert(rounded, unit, value.unit) == value.value:
            return _bare(parameter, Value(rounded))
    return f"≈ {_bare(parameter, Value(float(f'{other.value:.{_ROUNDED}g}')))}"


def _with_unit(figure: str, unit: str) -> str:
    return f"{figure}{'' if unit_text(unit) == '°' else ' '}{unit_text(unit)}".rstrip()


def _default(parameter: Parameter, default: Value | None, unit: str) -> str:
    """Return the default as printed; with its own unit where it cannot be given in ``unit``."""
    if default is None:
        return ""
    if _converted(default, unit) is None:
        return _with_unit(_bare(parameter, default), default.unit)
    return _figure(parameter, default, unit)


def _printed_default(parameter: Parameter, default: Value | None, unit: str, language: Language) -> str:
    text = _default(parameter, default, unit)
    return language.quantity(text) if parameter.type in ("real", "integer") else text


def _converted(value: Value | None, unit: str) -> Value | None:
    """Return a value in another unit; None for a unit of another quantity."""
    if value is None or isinstance(value.value, (str, bool)) or value.unit == unit:
        return value
    try:
        return Value(convert(float(value.value), value.unit, unit), unit)
    except UnitError:
        return None


def _bits(parameter: Parameter, value: Value | None, language: Language) -> str:
    """Return the meaning of the set bits and the fields of a packed word;
    bits of one lost figure have it once.
    """
    if not parameter.bits or value is None or isinstance(value.value, (str, bool)):
        return ""
    word = int(value.value)
    # A field has its value, a bit its label; bits of one lost figure have theirs together.
    by_label: dict[tuple[str, int | None], list[Bit]] = {}
    for bit in parameter.bits:
        if _is_field(bit) or field_value(bit, word):
            place = bit.bit if _is_field(bit) or not bit.unknown else None
            by_label.setdefault((bit.label, place), []).append(bit)
    return "; ".join(_bits_text(bits, word, language) for bits in by_label.values())


def _is_field(bit: Bit) -> bool:
    return bool(bit.choices) or bit.width > 1


def _bits_text(bits: Sequence[Bit], word: int, language: Language) -> str:
    """Return ``bits 3, 4: label`` of bits that are set, ``label: value`` of one field."""
    first = bits[0]
    if first.choices or first.width > 1:
        field = field_value(first, word)
        label = next((c.label for c in first.choices or () if c.raw == field), str(field))
        return f"{language.label(first.label)}: {language.label(label)}"
    noun = language.text("bits" if len(bits) > 1 else "bit")
    return f"{noun} {', '.join(str(bit.bit) for bit in bits)}: {language.label(first.label)}"
