"""``verify --all``: the known controls of a folder against their files,
on one page and with one exit code for a job.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any

from amp_studio.cli.checks.comparing import difference_json
from amp_studio.cli.console import print_json, print_remark, progress
from amp_studio.cli.errors import UsageError
from amp_studio.cli.exit_codes import FAULT
from amp_studio.cli.output import check_replaced
from amp_studio.cli.stopping import stop_requested
from amp_studio.cli.verb import Options
from amp_studio.files import Difference, ParameterFile
from amp_studio.report import Paper, PaperTable, check_paper_ending, counted, write_paper
from amp_studio.schema import show_value
from amp_studio.transfer import Exchange
from amp_studio.transfer.client import Drift, drift_of_all, known_controls

_FIRST = 12
"""Values of a control that are printed; --json and --report have all."""
_CODES = {"same": 0, "differs": 1, "not reached": FAULT, "no file": FAULT}
"""What a comparison can end with, and the exit code of it."""


def verify_all_verb(options: Options) -> int:
    """Compare every known control with its file; 1 where one differs, 2 where one could not be compared."""
    folder = _folder_of_controls(options)
    known = known_controls(folder)
    if not known:
        raise UsageError(
            f"{folder} knows no control: no download is recorded there, and no project.yaml names one"
        )
    with stop_requested() as stop:
        found = drift_of_all(known, lambda address: Exchange(progress(address), stop, notify=print_remark))
    counts = {word: sum(each.result == word for each in found) for word in _CODES}
    if options.json:
        controls = [_entry(each, options.secrets) for each in found]
        totals = {word.replace(" ", "_"): count for word, count in counts.items()}
        print_json({"controls": controls, **totals})
    else:
        _print(found, counts, options.secrets)
    if options.report is not None:
        write_paper(_paper(found, options.secrets), options.report, notify=print_remark)
    # The worst of all: a job that watches a shop looks at this one number.
    return max(_CODES[each.result] for each in found)


def _folder_of_controls(options: Options) -> Path:
    """Return the folder whose controls are compared; raises UsageError for options that do not fit."""
    folder = options.path or Path()
    if options.control:
        raise UsageError("--all compares the known controls: it takes no --with")
    if not folder.is_dir():
        raise UsageError(f"{folder} is no folder: --all compares the known controls of one")
    if options.report is not None:
        check_paper_ending(options.report)
        # Before the controls are asked: a name that cannot be written must not cost the comparison.
        check_replaced(options.report)  # a job writes the same page each time
    return folder


def _entry(drift: Drift, secrets: bool) -> dict[str, Any]:
    """Return one control as ``--json`` lists it."""
    listed = [difference_json(file, each, secrets) for file, each in _differences(drift)]
    return {
        "address": drift.known.address,
        "file": str(drift.known.path),
        "result": drift.result,
        "since": drift.since or None,
        "text": drift.text,
        "sha256": drift.sha256 or None,
        "differences": listed,
    }


def _differences(drift: Drift) -> list[tuple[ParameterFile, Difference]]:
    if drift.file is None or drift.compared is None:
        return []
    return [(drift.file, each) for each in (*drift.compared.values.differences, *drift.compared.other_units)]


def _difference_lines(each: Drift, secrets: bool) -> Iterator[str]:
    """Yield the first differences of a control from its file; why it differs where none can be listed."""
    listed = _differences(each)
    for row in _rows(listed[:_FIRST], secrets):
        yield f"{row[0]:48} {row[1]}  |  {row[2]}"
    if len(listed) > _FIRST:
        yield f"and {len(listed) - _FIRST} more"
    if each.result == "differs" and not listed:
        yield each.text


def _print(drifts: Sequence[Drift], counts: dict[str, int], secrets: bool) -> None:
    """Print a line for each control, the first values that differ below it, and the counts."""
    wide = max(len(each.known.address) for each in drifts)
    for each in drifts:
        text = "" if each.result == "same" else f"  {each.since or each.text}"
        print(f"{each.known.address:{wide}}  {each.result:11}  {each.known.path}{text}")
        for line in _difference_lines(each, secrets):
            print(f"{'':{wide}}  {line}")
    words = (f"{count} {word}" for word, count in counts.items() if count)
    print(f"{counted(len(drifts), 'control')}: {', '.join(words)}")


def _rows(listed: Sequence[tuple[ParameterFile, Difference]], secrets: bool) -> list[tuple[str, str, str]]:
    """Return name, value in the file and value in the control of each."""
    rows = []
    for file, each in listed:
        parameter = file.schema.parameters[each.address[0]]
        in_file, in_control = (show_value(parameter, value, secrets=secrets) for value in each.in_one_unit())
        rows.append((file.machine_schema.named(each.address), in_file, in_control))
    return rows


def _paper(drifts: Sequence[Drift], secrets: bool) -> Paper:
    """Return the table of all controls, and one for each that differs."""
    rows = [
        (each.known.address, str(each.known.path), each.result, each.since or each.text) for each in drifts
    ]
    tables = [
        PaperTable(
            "Controls", ("Address", "File", "Result", "How it ended"), tuple(rows), (3.0, 3.0, 1.5, 5.0)
        )
    ]
    for each in drifts:
        if values := _rows(_differences(each), secrets):
            heads = ("Parameter", "In the file", "In the control")
            tables.append(PaperTable(each.known.address, heads, tuple(values), (5.0, 3.4, 3.4)))
    return Paper("Results", "Controls and their files", (), tuple(tables), datetime.now().astimezone())
