"""The report as data: one JSON document whose keys are names and never headings of a page.

Numbers are numbers in the unit beside them, yes and no are true and false, and what a person or a control
wrote stays as it is. ``docs/report.schema.json`` describes it; ``FORMAT`` is another where a key changes its
meaning.
"""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

from amp_studio.report.chapters import CheckedMotion, Danger, ExchangeLine, ProgramState, TuningLine
from amp_studio.report.findings.printed_finding import PrintedFinding
from amp_studio.report.model import Report, ReportRow

FORMAT = 2
_FACTS = {
    "Machine": "name",
    "Project": "project",
    "Builder": "builder",
    "Serial number": "serial_number",
    "Built": "built",
    "Machine type": "type",
    "Application": "application",
    "Control": "control",
    "Control software revision": "revision",
    "Options": "options",
    "People": "people",
}
"""Fact of the cover -> its key; what else the cover has is in other places of the document."""
_NOTHING = "–"


def render_json(report: Report) -> bytes:
    """Return the report as one JSON document."""
    return (json.dumps(report_data(report), ensure_ascii=False, indent=1) + "\n").encode("utf-8")


def report_data(report: Report) -> dict[str, Any]:
    """Return the report as plain data."""
    contents = report.contents
    rows = list(report.rows())
    return {
        "amp_studio_report": FORMAT,
        "program": report.program,
        "printed": report.date.isoformat(timespec="seconds"),
        "language": contents.language,
        "title": report.title,
        "family": {"id": report.family_id, "name": report.family},
        "machine": {_FACTS[title]: _or_none(body) for title, body in report.machine if title in _FACTS},
        "file": {"name": report.file_name or None, **report.file_data},
        "contents": {
            "order": contents.sort,
            "changed_only": contents.changed_only,
            "inactive": contents.inactive,
            "units": contents.units,
        },
        "counts": report.totals | {"printed": len(rows)},
        "notes": {
            "machine": report.remarks,
            "others": [{"about": about, "text": text} for about, text in report.remarked],
        },
        "axes": [
            # By position: the heads between letter and counts differ by family.
            {"axis": axis, "letter": _or_none(letter), "values": int(values)}
            for axis, letter, *_, values, _, _ in report.axes
        ],
        "values": [*map(_value, rows)],
        "findings": [*map(_finding, report.notes)],
        "not_set": [{"number": n or None, "name": name, "place": place} for n, name, place in report.not_set],
        "dangers": [*map(_danger, report.dangers)],
        "power_up": [*map(_fields, report.power_up)],
        "motion": {
            "runs": [each.run for each in report.motion if each.run],
            "notes": [{"about": each.title, "text": note} for each in report.motion for note in each.notes],
        },
        "checks": [*map(_check, report.checks)],
        "part_programs": [*map(asdict, report.programs)],
        "exchanges": [*map(_fields, report.exchanges)],
        "tunings": [*map(_tuning, report.tunings)],
    }


def _or_none(text: str) -> str | None:
    return None if text == _NOTHING else text


def _fields(record: ProgramState | ExchangeLine) -> dict[str, Any]:
    return {name: getattr(record, name) for name in record.__slots__}


def _tuning(tuning: TuningLine) -> dict[str, Any]:
    """Return one tuning as report.json has it."""
    gains = [
        {
            "number": each.number,
            "name": each.name,
            "before": each.before or None,
            "after": each.after,
            "in_file": each.is_in_file,
        }
        for each in tuning.gains
    ]
    figures = [
        {"name": n.name, "before": n.before, "after": n.after, "unit": n.unit or None} for n in tuning.figures
    ]
    plant = [{"name": name, "value": value, "from": how} for name, value, how in tuning.plant]
    head = {name: getattr(tuning, name) for name in ("when", "who", "axis", "aim", "note")}
    return {**head, "gains": gains, "figures": figures, "machine": plant}


def _check(check: CheckedMotion) -> dict[str, Any]:
    """Return one scenario of the check as report.json has it; its drawings are in the paper only."""
    return {
        "verdict": check.verdict,
        "scenario": check.scenario,
        "axis": check.axis,
        "figures": [{"name": n.name, "value": n.value, "unit": n.unit or None} for n in check.figures],
        "text": check.text,
        "alarms": [{"code": code, "message": message} for code, message in check.alarms],
    }


def _danger(danger: Danger) -> dict[str, Any]:
    about = [_address(anchor) for anchor, _ in danger.about]
    return {"text": danger.says, "page": danger.page, "about": about}


def _address(anchor: str) -> dict[str, str]:
    parameter, _, instance = anchor.rpartition("@")
    return {"id": parameter, "instance": instance}


def _value(row: ReportRow) -> dict[str, Any]:
    """Return one value as report.json has it; a secret has neither value nor default."""
    return {
        "id": row.id,
        "instance": row.instance,
        "number": row.number or None,
        "name": row.name,
        "group": row.group,
        "place": row.place or None,
        "value": row.data,
        "unit": row.unit or None,
        "default": row.default_data,
        "set": row.is_set,
        "changed": row.is_changed,
        "default_printed": not row.no_default,
        "state": row.state,
        "why": row.why or None,
        "forced": row.forced or None,
        "note": row.note or None,
    }


def _finding(finding: PrintedFinding) -> dict[str, Any]:
    """Return one finding as report.json has it, with every address, also those that the paper sums up."""
    return {
        "rule": finding.rule,
        "severity": finding.severity,
        "count": finding.count,
        "about": [{"id": parameter, "instance": instance} for parameter, instance in finding.addresses],
        "message": finding.message,
        "fix": [
            {"id": parameter, "instance": instance, "value": value, "unit": unit or None}
            for (parameter, instance), value, unit in finding.changes
        ],
        "page": None if finding.is_own else finding.page or None,
        "source": finding.page if finding.is_own else None,
    }
