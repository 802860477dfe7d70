"""Tables to fill in by hand: each parameter with its numbers, its range and room for a value."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from datetime import datetime
from itertools import product

from amp_studio.files import ParameterFile
from amp_studio.report.axes import place_of, printed_axes, scope_of
from amp_studio.report.language import Language, language_of
from amp_studio.report.parameter.manual_page import range_text
from amp_studio.schema import Address, Bit, Parameter, unit_text

from .paper import Paper, PaperTable

_SHARES = (1.6, 4.0, 6.0, 3.0)
_HEADS = ("Number", "Parameter", "Allowed", "Value")
_ACROSS = 8
"""Most places beside each other."""
_MAX_PLACES = 32
"""Of more places each has its number or name at its blank, and none has a head."""
_MAX_CHOICES = 6
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


def _is_printed(file: ParameterFile, address: Address, axes: Collection[str]) -> bool:
    """Return whether a value exists on this machine, and its axis is printed."""
    is_of_axis = scope_of(file, address) == "axis"
    if is_of_axis and address[1] not in axes:
        return False
    return file.evaluation.state(address).state != "hidden"


def _tables(file: ParameterFile, everything: bool, language: Language) -> Iterator[PaperTable]:
    """Yield for each group a table of what there is once, and one for each row of places (axes, spindles)."""
    axes = printed_axes(file)
    for group in file.schema.groups:
        single: list[tuple[str, ...]] = []
        several: dict[tuple[str, ...], list[Parameter]] = {}
        for parameter in group.parameters:
            places = tuple(
                instance
                for instance in file.machine_schema.instances(parameter)
                if everything or _is_printed(file, (parameter.id, instance), axes)
            )
            if len(places) == 1:
                address = (parameter.id, places[0])
                allowed = _allowed(file, parameter, language)
                single.append(
                    (_number(file, address), parameter.name, allowed, _blank(file, address, language))
                )
            elif places:
                # Parameters with the same places share a table, so that its columns fit all its lines.
                several.setdefault(places, []).append(parameter)
        if single:
            yield PaperTable(group.whole_name, _HEADS, tuple(single), _SHARES)
        for places, parameters in several.items():
            yield _matrix(file, group.whole_name, places, parameters, language)


def _matrix(
    file: ParameterFile, title: str, places: tuple[str, ...], parameters: list[Parameter], language: Language
) -> PaperTable:
    """Return parameters that have the same places: a line each and a column a place, further places below."""
    rows: list[tuple[str, ...]] = []
    strong: set[tuple[int, int]] = set()
    parts = [places[at : at + _ACROSS] for at in range(0, len(places), _ACROSS)]
    is_ladder = len(places) > _MAX_PLACES
    width = len(parts[0])
    heads = [_filled(_labels(file, parameters[0], part, language), width) for part in parts]
    columns = [""] * width if is_ladder else heads[0]
    for n, part in enumerate(parts):
        if n and not is_ladder:
            strong |= set(product([len(rows)], range(2, width + 2)))
            rows.append(("", "", *heads[n]))
        for parameter in parameters:
            is_named = n == 0 or not is_ladder
            about = (parameter.name, _allowed(file, parameter, language, not n)) if is_named else ("", "")
            cells = [_cell(file, (parameter.id, place), language, is_ladder) for place in part]
            rows.append((*about, *_filled(cells, width)))
    shares = (3.4, 4.2, *[2.1] * width)
    return PaperTable(title, (*_HEADS[1:3], *columns), tuple(rows), shares, frozenset(strong))


def _filled(cells: list[str], width: int) -> list[str]:
    return [*cells, *[""] * (width - len(cells))]


def _labels(
    file: ParameterFile, parameter: Parameter, places: tuple[str, ...], language: Language
) -> list[str]:
    return [language.text(place_of(file, (parameter.id, place))) for place in places]


def _number(file: ParameterFile, address: Address) -> str:
    here = file.machine_schema
    return "" if here.is_disputed(address[0]) else here.number(address) or ""


def _cell(file: ParameterFile, address: Address, language: Language, is_ladder: bool) -> str:
    """Return number and blank; in a ladder the place and blank of what has no number."""
    place = language.text(place_of(file, address)) if is_ladder else ""
    return f"{_number(file, address) or place} {_blank(file, address, language)}".strip()


def _blank(file: ParameterFile, address: Address, language: Language) -> str:
    """Return a line to write on, with the unit."""
    unit = unit_text(file.evaluation.unit(address, file.header.units))
    return f"______ {language.unit(unit)}".rstrip()


def _bit(bit: Bit, language: Language) -> str:
    """Return a box for a bit, a blank for a field of several; a line does not end within a short one."""
    last = bit.bit + bit.width - 1
    label = language.label(bit.label)
    if last > bit.bit:
        return f"{language.text(f'bits {bit.bit} to {last}')}: {label} ____"
    text = f"[ ] {bit.bit} {label}"
    return text.replace(" ", "\u00a0", -1 if len(text) < _SHORT else 3)


def _allowed(file: ParameterFile, parameter: Parameter, language: Language, in_full: bool = True) -> str:
    """Return what a value may be; nothing where it has been given above."""
    if not in_full:
        return ""
    if parameter.choices:
        labels = [language.label(choice.label) for choice in parameter.choices]
        more = f" … ({len(labels)})" if len(labels) > _MAX_CHOICES else ""
        return " / ".join(labels[:_MAX_CHOICES]) + more
    if parameter.bits:
        return "   ".join(_bit(bit, language) for bit in parameter.bits)
    return "; ".join(range_text(parameter.ranges, file.schema, language))
