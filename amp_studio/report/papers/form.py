"""Tables to fill in by hand: each parameter with its numbers, its range and room for a value."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from datetime import datetime

from amp_studio.files import ParameterFile
from amp_studio.report.axes import place_of, printed_axes, scope_of
from amp_studio.report.language import Language, language_of
from amp_studio.report.parameter.manual_page import range_text
from amp_studio.schema import Address, Bit, Parameter, unit_text

from .paper import Paper, PaperTable

_SHARES = (1.6, 4.0, 1.6, 6.0, 3.0)
_HEADS = ("Number", "Parameter", "Belongs to", "Allowed", "Value")
_MOST_CHOICES = 6
_SHORT = 24


def form_paper(
    file: ParameterFile, *, everything: bool = False, date: datetime | None = None, language: str = "en"
) -> Paper:
    """Return the form of a file's machine; what is hidden on it and unfitted axes are left out, unless
    ``everything``. Values stay blank.

    ``language`` is a code of ``language_codes``.
    """
    family = file.schema.family
    machine = next((m.name for m in family.machines if m.key == file.machine), file.machine)
    facts = [
        ("Control family", family.name),
        ("Machine type", machine),
        ("Machine", ""),
        ("Serial number", ""),
    ]
    return Paper(
        "Form",
        file.header.name or family.name,
        tuple((k, v or "_" * 40) for k, v in facts),
        tuple(_tables(file, everything, language_of(language))),
        date or datetime.now().astimezone(),
        signed=("Filled in by", "Checked by"),
        language=language,
    )


def _is_there(file: ParameterFile, address: Address, axes: Collection[str]) -> bool:
    """Return whether a value exists on this machine, and its axis is printed."""
    is_of_axis = scope_of(file, address) == "axis"
    if is_of_axis and address[1] not in axes:
        return False
    return file.evaluation.state(address).state != "hidden"


def _row(file: ParameterFile, address: Address, language: Language) -> tuple[str, ...]:
    """Return number, name, place, what is allowed, and a line to write on."""
    parameter, here = file.schema.parameters[address[0]], file.machine_schema
    number = "" if here.is_disputed(parameter.id) else here.number(address) or ""
    blank = f"____________ {unit_text(file.evaluation.unit(address, file.header.units))}".rstrip()
    place = language.text(place_of(file, address))
    return number, parameter.name, place, _allowed(file, parameter, language), blank


def _tables(file: ParameterFile, everything: bool, language: Language) -> Iterator[PaperTable]:
    axes = printed_axes(file)
    for group in file.schema.groups:
        rows = []
        for parameter in group.parameters:
            for instance in file.machine_schema.instances(parameter):
                address = (parameter.id, instance)
                if everything or _is_there(file, address, axes):
                    rows.append(_row(file, address, language))
        if rows:
            title = group.whole_name
            yield PaperTable(title, _HEADS, tuple(rows), _SHARES, values_from=3)


def _bit(bit: Bit, language: Language) -> str:
    """Return a box for a bit, a blank for a field of several; a line does not end within a short one."""
    last = bit.bit + bit.width - 1
    if last > bit.bit:
        return f"{language.text(f'bits {bit.bit} to {last}')}: {bit.label} ____"
    text = f"[ ] {bit.bit} {bit.label}"
    return text.replace(" ", "\u00a0", -1 if len(text) < _SHORT else 3)


def _allowed(file: ParameterFile, parameter: Parameter, language: Language) -> str:
    if parameter.choices:
        labels = [choice.label for choice in parameter.choices]
        more = f" … ({len(labels)})" if len(labels) > _MOST_CHOICES else ""
        return " / ".join(labels[:_MOST_CHOICES]) + more
    if parameter.bits:
        return "   ".join(_bit(bit, language) for bit in parameter.bits)
    return "; ".join(map(language.message, range_text(parameter.ranges, file.schema)))
