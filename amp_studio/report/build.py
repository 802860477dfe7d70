"""Builds the report of a parameter file."""

from __future__ import annotations

import hashlib
import os
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from datetime import datetime
from itertools import groupby
from pathlib import Path
from typing import TypeVar

from amp_studio.child_process import Awaited, beside
from amp_studio.files import (
    ParameterFile,
    ParameterFileError,
    ProjectInfo,
    all_notes,
    axis_instances,
    axis_kind,
    axis_letter,
    content_of,
    file_content,
    fitted_axes,
    machine_note,
    read_content,
    without_secrets,
)
from amp_studio.guide import Present, present
from amp_studio.schema import Address, Schema, label_of
from amp_studio.validate import NO_RULES, BuilderRules, Finding, validator_of
from amp_studio.version import __version__

from .axes import printed_axes, scope_of
from .chapters import ProgramState
from .contents import SORTS, UNIT_CHOICES, Contents
from .dangers import dangers_of
from .drawings import drawings
from .findings.alike import printed_findings, printed_suppressed
from .language import Language, language_of
from .model import NOTHING_ADDED, Additions, PrintedFigure, Report, ReportRow
from .parameter.manual_page import help_parts
from .rows import Rows, row_of, rows_of
from .sections import numbers_of, sections_of
from .wording import counted, delivered_text, joined_places

_T = TypeVar("_T")
_SHORT = 16
"""Digits of a schema's signature that are printed."""


def build_report(
    file: ParameterFile,
    contents: Contents | None = None,
    *,
    source: Path | None = None,
    project: ProjectInfo | None = None,
    date: datetime | None = None,
    own: BuilderRules = NO_RULES,
    added: Additions = NOTHING_ADDED,
) -> Report:
    """Return the report of a file as it is in memory; secrets are masked.

    ``source`` is its path on disk, ``project`` what its project has about the machine; ``date`` is printed,
    the present time if left out.
    """
    contents = contents or Contents()
    language = language_of(contents.language, file.schema.family.family)
    # Begun first, and asked for last: it runs beside all that follows (decision 0092).
    pictures = beside(lambda: drawings(file, language)) if "pictures" not in contents.without else ()
    found = rows_of(file, contents.units, language)
    printed = tuple(row for row in found.rows if _is_printed(row, contents))
    anchors = {row.anchor for row in printed}
    validator = validator_of(file, source, own)
    now = present(validator, validator.run())
    # All rows, not only the printed ones: the summary counts what the axis has.
    heads, axes = _axes(file, found.rows, now.findings)
    family = file.schema.family
    name = _name_of(source) if source else ""
    # As the program writes it, without the author's comments: one may spell a secret out (decision 0087).
    content = content_of(without_secrets(file))

    def with_part(part: str, made: Callable[[], Iterable[_T]]) -> tuple[_T, ...]:
        """Return a part that may be left out; then it is not made either."""
        return () if part in contents.without else tuple(made())

    return Report(
        title=file.header.name or name or family.name,
        family=family.name,
        file_name=name,
        date=date or datetime.now().astimezone(),
        program=f"AMP Studio {__version__}",
        contents=contents,
        machine=tuple(_machine(file, project)),
        facts=tuple(_facts(file, source, contents, content)),
        counts=tuple(_counts(file, found, len(printed), now)),
        remarks=machine_note(file).strip(),
        remarked=tuple(_remarked(file)),
        axis_heads=heads,
        axes=axes,
        notes=(
            printed_findings(file, now.findings, anchors, language)
            + printed_suppressed(file, validator.suppressed, anchors, language)
        ),
        dangers=dangers_of(file.schema, printed, language),
        forced=_forced(file, found.rows),
        not_set=tuple(_not_set(found.rows)),
        sections=sections_of(file, printed, contents.sort, language),
        power_up=with_part("power-up", lambda: _power_up(file, language)),
        exchanges=with_part("exchanges", lambda: added.exchanges),
        tunings=with_part("tuning", lambda: added.tunings),
        checks=tuple(added.checks),
        programs=tuple(added.programs),
        family_id=family.family,
        file_data=_file_data(file, source, content),
        totals=_totals(file, found, now),
        machine_file=content.decode("utf-8"),
        help={i: tuple(_help(file.schema, i, language)) for i in _ids_of(printed)},
        # Last, as they are made beside all this.
        pictures=tuple(pictures),
        motion=Awaited(_in_words(figure, language) for figure in added.motion)
        if "motion" not in contents.without
        else (),
    )


def _remarked(file: ParameterFile) -> Iterator[tuple[str, str]]:
    """Yield label and text of the notes of parameters."""
    return ((note.label, note.text.strip()) for note in all_notes(file) if note.subject != "machine")


def _ids_of(rows: Iterable[ReportRow]) -> dict[str, None]:
    """Return the ids of the parameters of some rows, each once, in their order."""
    return dict.fromkeys(row.id for row in rows)


def _is_printed(row: ReportRow, contents: Contents) -> bool:
    """Return whether a value is printed; one that was forced is in every report."""
    # Whatever else is left out: what is out of range on purpose must be seen on paper.
    if row.forced:
        return True
    is_wanted = contents.inactive or row.state == "in-force"
    return is_wanted and (not contents.changed_only or row.is_changed or row.no_default)


def _power_up(file: ParameterFile, language: Language) -> Iterator[ProgramState]:
    """Yield what is active in part programs after power-up; nothing for a family of which no page prints
    it.
    """
    if not file.schema.program.page:
        return
    from amp_studio.programs import power_up

    state = power_up(file)
    for line in (*state.active, *state.changes, *state.calls):
        schema = file.machine_schema
        numbers = ", ".join(map(schema.short, line.params))
        named = ", ".join(schema.number(each) or schema.label(each) for each in line.params)
        what, meaning = language.sentence(line.what), language.sentence(line.meaning)
        yield ProgramState(what, line.code, meaning, numbers, line.page, named)


def _help(schema: Schema, parameter_id: str, language: Language) -> Iterator[tuple[str, str]]:
    parameter = schema.parameters[parameter_id]
    yield from help_parts(schema, parameter, language)
    yield "Manual", language.text(f"page {parameter.page}")


def _in_words(figure: PrintedFigure, language: Language) -> PrintedFigure:
    """Return a drawing of the simulator with the sentences below it in a language."""
    return replace(figure, notes=tuple(map(language.sentence, figure.notes)))


# -- facts ---------------------------------------------------------------------


def _machine(file: ParameterFile, of_project: ProjectInfo | None) -> list[tuple[str, str]]:
    """Return title and text of what is known of the machine and its control; a dash for what is not."""
    family, header, project = file.schema.family, file.header, of_project or ProjectInfo("", "")
    facts = [
        ("Machine", header.name or project.name),
        ("Builder", project.builder),
        ("Serial number", project.serial_number),
        ("Built", project.built),
        ("Machine type", family.machine_name(file.machine)),
        ("Application", header.application or project.application),
        ("Control family", family.name),
        ("Control", project.control_name),
        ("Control software revision", header.revision or project.revision),
        ("Options", project.options),
        ("People", project.people),
    ]
    # The file's name counts; a project of several files may be called something else.
    if header.name and project.name.strip() not in ("", header.name):
        facts.insert(1, ("Project", project.name))
    if family.fits_axes:
        facts.append(("Axes", f"{len(fitted_axes(file))} of {len(axis_instances(file))} fitted"))
    return [(title, text.strip() or "–") for title, text in facts]


def _facts(
    file: ParameterFile, source: Path | None, contents: Contents, content: bytes
) -> list[tuple[str, str]]:
    """Return title and text of what is known of the file and of this document."""
    units = file.header.units if contents.units == "file" else UNIT_CHOICES[contents.units]
    return [
        ("File", _name_of(source) if source else "not saved yet"),
        _checksum(file, source, content),
        ("Schema signature", _signature(file)),
        ("Unit system", units),
        ("Order", SORTS[contents.sort]),
        ("Contents", contents.text),
    ]


def _name_of(source: Path) -> str:
    """Return the name of a file as a paper can have it, whatever its bytes are, and whatever the locale."""
    return os.fsencode(source.name).decode("utf-8", "replace")


def _checksum(file: ParameterFile, source: Path | None, content: bytes) -> tuple[str, str]:
    """Return title and checksum of the file on disk, with a note where its values differ from the report.

    With the report, its reader could try all passwords against a checksum, so it excludes secrets, as
    ``content`` does.
    """
    title = "SHA-256 of the file"
    if without_secrets(file) is not file:
        title, file = "SHA-256 without the secret values", without_secrets(file)
    if source is None:
        return title, _digest(content) + " (not saved yet)"
    try:
        stored = file_content(source)
        if stored == content:
            return title, _digest(content)
        opened = read_content(source, stored)
    except ParameterFileError:
        return title, "the file on disk cannot be read"
    on_disk = without_secrets(opened)
    # Without secrets it is the file byte for byte, so that a reader can check it with another program.
    digest = _digest(stored if on_disk is opened else content_of(on_disk))
    if on_disk.values != file.values:
        return title, digest + " – but this report contains unsaved changes"
    return title, digest


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def _signature(file: ParameterFile) -> str:
    own, written = file.schema.signature[:_SHORT], file.header.signature[:_SHORT]
    return f"{own} (the file was written under {written})" if written and written != own else own


def _counts(file: ParameterFile, found: Rows, printed: int, now: Present) -> list[tuple[str, str]]:
    """Return the counts of the cover: findings, values by state, what is printed."""
    rows = found.rows
    severities = [counted(n, s) for s in ("error", "warning", "advice") if (n := _severity(now.findings, s))]
    states = Counter(r.state for r in rows)
    counts = [
        ("Findings", ", ".join(severities) or "none"),
        *([("State", delivered_text(now.delivered, now.steps))] if now.delivered else []),
        ("Values", str(len(rows))),
        ("Printed here", str(printed)),
        ("Differ from the default", str(sum(r.is_changed for r in rows))),
        ("Set, no default printed", str(sum(r.no_default for r in rows))),
        ("Forced out of range", str(len(file.forced))),
        ("Not set", str(sum(map(_is_missing, rows)))),
        ("Ignored by the control", str(states["ignored"])),
        ("Not available", str(states["unusable"])),
        ("Hidden, left out", str(found.hidden)),
    ]
    if file.schema.family.fits_axes:
        counts.append(("Of unfitted axes, left out", str(found.unfitted)))
    if file.unknown:
        counts.append(("Unknown entries, kept in the file", str(len(file.unknown))))
    return counts


def _file_data(file: ParameterFile, source: Path | None, content: bytes) -> dict[str, str | bool | None]:
    """Return what is known of the file as data; the checksum is that of the values that are printed."""
    return {
        "sha256": _digest(content),
        "without_secrets": without_secrets(file) is not file,
        "saved": source is not None,
        "signature": file.schema.signature,
        "written_under": file.header.signature or None,
        "units": file.header.units,
    }


def _totals(file: ParameterFile, found: Rows, now: Present) -> dict[str, int]:
    """Return the counts as data, by the keys of report.json."""
    rows = found.rows
    return {
        "errors": _severity(now.findings, "error"),
        "warnings": _severity(now.findings, "warning"),
        "advice": _severity(now.findings, "advice"),
        "values": len(rows),
        "changed": sum(r.is_changed for r in rows),
        "no_default": sum(r.no_default for r in rows),
        "forced": len(file.forced),
        "not_set": sum(_is_missing(r) for r in rows),
        "ignored": sum(r.state == "ignored" for r in rows),
        "unusable": sum(r.state == "unusable" for r in rows),
        "hidden": found.hidden,
        "unfitted": found.unfitted,
        "unknown": len(file.unknown),
    }


def _severity(findings: Sequence[Finding], severity: str) -> int:
    return sum(f.severity == severity for f in findings)


def _forced(file: ParameterFile, rows: Sequence[ReportRow]) -> tuple[ReportRow, ...]:
    """Return all forced values, also those that are not printed otherwise."""
    printed = {(r.id, r.instance): r for r in rows}
    # In the manual's order, not that in which they were forced.
    forced = (a for a in file.addresses() if a in file.forced)
    # Axes that are not fitted have no row, and their forced values are still in the file.
    return tuple(printed.get(a) or row_of(file, a) for a in forced)


def _is_missing(row: ReportRow) -> bool:
    return not row.is_set and row.state == "in-force"


def _not_set(rows: Sequence[ReportRow]) -> Iterator[tuple[str, str, str]]:
    """Yield number, name and places of each active parameter without a value."""
    for _, members in groupby((r for r in rows if _is_missing(r)), key=lambda r: r.id):
        own = list(members)
        places = [r.place or "Control" for r in own] if any(r.place for r in own) else []
        yield numbers_of(own), own[0].name, joined_places(places)


# -- axes ----------------------------------------------------------------------


def _axes(
    file: ParameterFile, rows: Sequence[ReportRow], findings: Sequence[Finding]
) -> tuple[tuple[str, ...], tuple[tuple[str, ...], ...]]:
    """Return heads and lines of the axis summary; both are empty for a family without axes."""
    if not file.schema.family.fits_axes:
        return (), ()
    profile = file.schema.family.axes
    asked = [p for p in (profile.type, profile.hardware, profile.loop) if p] if profile else []
    heads = (
        "Axis",
        "Name",
        *(file.schema.parameters[p].name for p in asked),
        *([] if profile else ["Type"]),
        "Values",
        "Changed",
        "Findings",
    )
    return heads, tuple(_axis(file, axis, asked, rows, findings) for axis in printed_axes(file))


def _axis(
    file: ParameterFile,
    axis: str,
    asked: Sequence[str],
    rows: Sequence[ReportRow],
    findings: Sequence[Finding],
) -> tuple[str, ...]:
    """Return the line of one axis in the summary, in the order of its heads."""
    own = [row for row in rows if _is_of_axis(file, (row.id, row.instance), axis)]
    settings = [_setting(file, (p, axis)) for p in asked] or [axis_kind(file, axis) or "–"]
    return (
        axis,
        axis_letter(file, axis) or "–",
        *settings,
        str(len(own)),
        str(sum(r.is_changed for r in own)),
        _findings_of_axis(file, axis, findings),
    )


def _findings_of_axis(file: ParameterFile, axis: str, findings: Sequence[Finding]) -> str:
    touching = [f for f in findings if any(_is_of_axis(file, address, axis) for address in f.addresses)]
    severities = [counted(n, s) for s in ("error", "warning") if (n := _severity(touching, s))]
    return ", ".join(severities) or "–"


def _is_of_axis(file: ParameterFile, address: Address, axis: str) -> bool:
    return address[1] == axis and scope_of(file, address) == "axis"


def _setting(file: ParameterFile, address: Address) -> str:
    value = file.get(address)
    return label_of(file.schema.parameters[address[0]], str(value.value)) if value else "–"
