"""The exchange verbs with several controls: a table of results, and one exit code for all."""

from __future__ import annotations

import argparse
import csv
import html
import io
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from amp_studio.files import ParameterFile, write_atomic
from amp_studio.files.spreadsheet import text_cell
from amp_studio.report.wording import counted
from amp_studio.transfer.client.exchange import Outcome
from amp_studio.transfer.client.fleet import FleetResult, check_addresses, with_each
from amp_studio.transfer.client.parameters import download_file, fetch_image, sha256
from amp_studio.transfer.client.record import add_exchange, exchange_now
from amp_studio.transfer.client.verification import ImageComparison, verify_content
from amp_studio.transfer.content import decode_content
from amp_studio.transfer.progress import Progress, Stop

from .console import note, print_json, progress
from .errors import UsageError
from .output import check_new, write_new
from .program import AT_CONTROL, CHANGED, FAULT, UNKNOWN

REPORTS = (".csv", ".html")


@dataclass(frozen=True)
class Row:
    """One control in the table: how it ended in a word and in a sentence, and the exit code of it alone."""

    address: str
    result: str
    code: int
    sha256: str = ""
    kept: str = ""
    text: str = ""


def check_fleet(options: argparse.Namespace, addresses: Sequence[str]) -> None:
    """Refuse what cannot be used before anything is begun. Raises UsageError, ValueError."""
    check_addresses(addresses)
    if options.report is not None:
        if options.report.suffix.lower() not in REPORTS:
            raise UsageError(f"{options.report}: the table is written as {' or '.join(REPORTS)}")
        check_new(options.report, "a table of results")


def is_fleet(options: argparse.Namespace, addresses: Sequence[str]) -> bool:
    """Return whether the results are a table: of several controls, or because one was asked for."""
    return (
        len(addresses) > 1 or options.report is not None or (options.json and options.verb == "download_verb")
    )


def note_exchange(
    verb: str, path: Path, file: ParameterFile, address: str, content: bytes, text: str
) -> None:
    """Record an exchange that replaced nothing, in the folder of a file."""
    digest = sha256(content) if content else ""
    family = file.schema.family.family
    entry = exchange_now(verb, path, family, address, before=digest, after=digest, text=text)
    if problem := add_exchange(path, entry):
        note(problem)


def download_to_several(
    options: argparse.Namespace, file: ParameterFile, path: Path, keep: Path, stop: Stop
) -> int:
    """Send a file to each control; returns the exit code of all."""
    files = {address: file.copy() for address in options.to}  # a thread each

    def work(address: str, show: Progress) -> Outcome:
        return download_file(files[address], address, keep, path.stem, show, stop, expected=options.expect,
                             record=path, notify=note)  # fmt: skip

    found = with_each(
        options.to, work, _progress, failed=lambda outcome: not outcome.verified,
        stop_on_failure=options.stop_on_failure, cancel=stop)  # fmt: skip
    return _end(options, [_downloaded(each) for each in found])


def _downloaded(found: FleetResult[Outcome]) -> Row:
    outcome = found.result
    if outcome is None:
        return _failed(found)
    if not outcome.verified:
        state = {"new": "not proved"}.get(outcome.at_control, outcome.at_control)
        return Row(found.address, state, AT_CONTROL[outcome.at_control], outcome.sha256, outcome.kept or "", outcome.text)  # fmt: skip
    result = "done" if outcome.written else "had it already"
    return Row(found.address, result, 0, outcome.sha256, outcome.kept or "", outcome.text)


def verify_several(options: argparse.Namespace, file: ParameterFile, stop: Stop) -> int:
    """Compare a file with each control; 1 where one differs, 2 where one could not be read."""
    family = file.schema.family.family
    files = {address: file.copy() for address in options.control}

    def work(address: str, show: Progress) -> tuple[ImageComparison, str]:
        content = fetch_image(address, show, stop, family=family)
        verified = verify_content(files[address], content)
        note_exchange("verify", options.path, file, address, content, verified.summary())
        return verified, sha256(content)

    found = with_each(
        options.control, work, _progress, failed=lambda pair: not pair[0].is_same,
        stop_on_failure=options.stop_on_failure, cancel=stop)  # fmt: skip
    rows = []
    for each in found:
        if each.result is None:
            rows.append(_failed(each))
            continue
        verified, digest = each.result
        word = "same" if verified.is_same else "differs"
        rows.append(Row(each.address, word, int(not verified.is_same), digest, text=verified.summary()))
    return _end(options, rows)


def upload_several(options: argparse.Namespace, stop: Stop) -> int:
    """Fetch what each control contains into a file of a folder, named by its address; returns the exit code of all."""
    folder: Path = options.output
    if not folder.is_dir():
        raise UsageError(
            f"{folder} is no folder: an upload from several controls writes a file for each there"
        )
    outputs = {address: folder / f"{_as_name(address)}.amp" for address in options.source}
    for output in outputs.values():
        check_new(output, "an upload")

    def work(address: str, show: Progress) -> tuple[bytes, ParameterFile]:
        content = fetch_image(address, show, stop)
        if not content:
            raise UsageError("the control is empty: there is nothing to upload")
        return content, decode_content(content)

    found = with_each(
        options.source, work, _progress, failed=lambda _: False, stop_on_failure=options.stop_on_failure, cancel=stop)  # fmt: skip
    rows = []
    for each in found:
        if each.result is None:
            rows.append(_failed(each))
            continue
        content, file = each.result
        output = outputs[each.address]
        file.header.name = output.stem
        try:
            write_new(file, output)
            note_exchange("upload", output, file, each.address, content, "uploaded")
            rows.append(
                Row(
                    each.address,
                    "done",
                    0,
                    sha256(content),
                    text=f"{output}: {counted(len(file.values), 'value')}",
                )
            )
        except (OSError, ValueError) as error:
            rows.append(Row(each.address, "not written", FAULT, sha256(content), text=str(error)))
    return _end(options, rows)


def _progress(address: str) -> Progress:
    return progress(address)


def _as_name(address: str) -> str:
    """Return a file name of an address: ``tcp-192.168.0.5-9600``."""
    return "-".join(filter(None, "".join(c if c.isalnum() or c in "._" else "-" for c in address).split("-")))


def _failed(found: FleetResult[Any]) -> Row:
    if not found.was_tried:
        return Row(found.address, "not tried", FAULT, text="an exchange before it failed, or was stopped")
    word = {"": "failed", "old": "failed", "new": "not proved"}.get(found.state, found.state)
    return Row(found.address, word, AT_CONTROL.get(found.state, FAULT), kept=found.kept, text=found.error)


def _end(options: argparse.Namespace, rows: list[Row]) -> int:
    """Print the table, write the report and return one code: 4 where the state of a control is not known, 3 where some took
    what others did not.
    """
    if options.json:
        print_json({"controls": [{"address": r.address, "result": r.result, "code": r.code, "sha256": r.sha256 or None,
                                  "kept": r.kept or None, "text": r.text} for r in rows]})  # fmt: skip
    else:
        wide = max(len(row.address) for row in rows)
        for row in rows:
            print(f"{row.address:{wide}}  {row.result:14}  {row.sha256[:12]:12}  {row.text}".rstrip())
    if options.report is not None:
        _write_report(options.report, rows)
    code = _code(options, rows)
    if code > 1:
        well = sum(row.code <= 1 for row in rows)
        wrong = ", ".join(f"{row.address} {row.result}" for row in rows if row.code > 1)
        note(f"amp-studio: {well} of {counted(len(rows), 'control')} done; {wrong}")
    return code


def _code(options: argparse.Namespace, rows: list[Row]) -> int:
    codes = {row.code for row in rows}
    if codes <= {0, 1}:
        return max(codes)
    if UNKNOWN in codes:
        return UNKNOWN
    is_partly = options.verb == "download_verb" and any(row.result == "done" for row in rows)
    return CHANGED if CHANGED in codes or is_partly else FAULT


def _write_report(path: Path, rows: list[Row]) -> None:
    heads = ("Address", "Result", "SHA-256", "Kept copy", "How it ended")
    cells = [(r.address, r.result, r.sha256, r.kept, r.text) for r in rows]
    if path.suffix.lower() == ".csv":
        text = io.StringIO()
        write = partial(csv.writer(text).writerow)
        for row in (heads, *cells):
            write([text_cell(cell) for cell in row])
        content = text.getvalue()
    else:
        content = _page(heads, cells)
    write_atomic(path, content.encode(), expected=None)


def _page(heads: Sequence[str], cells: Sequence[Sequence[str]]) -> str:
    def line(tag: str, row: Sequence[str]) -> str:
        return f"<tr>{''.join(f'<{tag}>{html.escape(cell)}</{tag}>' for cell in row)}</tr>"

    body = "\n".join([line("th", heads), *(line("td", row) for row in cells)])
    style = "table{border-collapse:collapse}td,th{border:1px solid #ccc;padding:4px 8px;text-align:left}"
    return (f'<!doctype html>\n<html lang="en"><meta charset="utf-8"><title>Controls</title><style>{style}</style>\n'
            f"<table>\n{body}\n</table></html>\n")  # fmt: skip
