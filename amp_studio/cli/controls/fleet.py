"""The exchange verbs with several controls: a table of results, and one exit code for all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from amp_studio import MachineParameters
from amp_studio.cli.console import print_json, print_remark, progress
from amp_studio.cli.errors import UsageError
from amp_studio.cli.exit_codes import AT_CONTROL, CHANGED, FAULT, UNKNOWN
from amp_studio.cli.output import check_new, write_new
from amp_studio.cli.verb import Options
from amp_studio.files import ParameterFile
from amp_studio.report import check_paper_ending, counted, results_paper, write_paper
from amp_studio.transfer import Exchange, decode_content
from amp_studio.transfer.client import (
    HEADS,
    ExchangeOf,
    FleetResult,
    FleetRow,
    check_addresses,
    download_each,
    failed_row,
    fetch_image,
    record_look,
    sha256,
    verify_each,
    with_each,
)


def check_fleet(options: Options, addresses: Sequence[str]) -> None:
    """Refuse what cannot be used before anything is begun. Raises UsageError, ValueError."""
    check_addresses(addresses)
    if options.report is not None:
        check_paper_ending(options.report)
        check_new(options.report, "a table of results")


def is_fleet(options: Options, addresses: Sequence[str]) -> bool:
    """Return whether the results are a table: of several controls, or because one was asked for."""
    return len(addresses) > 1 or options.report is not None or (options.json and options.verb == "download")


def download_to_several(options: Options, file: ParameterFile, exchange: Exchange) -> int:
    """Send a file to each control; returns the exit code of all."""
    return _end(
        options,
        download_each(
            file,
            options.to,
            _one_of_several(exchange),
            expected=options.expect,
            stop_on_failure=options.stop_on_failure,
        ),
    )


def verify_several(options: Options, file: ParameterFile, exchange: Exchange) -> int:
    """Compare a file with each control; 1 where one differs, 2 where one could not be read."""
    of_each = _one_of_several(exchange)
    return _end(options, verify_each(file, options.control, of_each, stop_on_failure=options.stop_on_failure))


def _one_of_several(exchange: Exchange) -> ExchangeOf:
    """Return the exchange with each control, whose progress names its address."""
    return lambda address: replace(exchange, progress=progress(address))


def upload_several(options: Options, exchange: Exchange) -> int:
    """Fetch what each control contains into a file of a folder, named by its address;
    returns the exit code of all.
    """
    folder: Path = options.output
    if not folder.is_dir():
        raise UsageError(
            f"{folder} is no folder: an upload from several controls writes a file for each there"
        )
    # All names before the first control is asked: an upload must not end at a file that exists.
    outputs = {address: folder / f"{_as_name(address)}.amp" for address in options.source}
    for output in outputs.values():
        check_new(output, "an upload")

    def work(address: str, with_control: Exchange) -> tuple[bytes, ParameterFile]:
        content = fetch_image(address, with_control)
        # Refused and not written: a file without values looks like a backup and is none.
        if not content:
            raise UsageError("the control is empty: there is nothing to upload")
        return content, decode_content(content)

    found = with_each(
        options.source,
        work,
        _one_of_several(exchange),
        failed=lambda _: False,
        stop_on_failure=options.stop_on_failure,
    )
    return _end(options, [_uploaded(each, outputs[each.address]) for each in found])


def _uploaded(found: FleetResult[tuple[bytes, ParameterFile]], output: Path) -> FleetRow:
    """Write what one control contains, and return its row; a file that cannot be written ends no other."""
    if found.result is None:
        return failed_row(found)
    content, file = found.result
    digest = sha256(content)
    try:
        write_new(MachineParameters(file), output)
    except (OSError, ValueError) as error:
        return FleetRow(found.address, "not written", "failed", sha256=digest, text=str(error))
    record_upload(output, file, found.address, content)
    text = f"{output}: {counted(len(file.values), 'value')}"
    return FleetRow(found.address, "done", sha256=digest, text=text)


def record_upload(output: Path, file: ParameterFile, address: str, content: bytes) -> None:
    """Record an upload in the folder of the file that was made of it."""
    exchange = Exchange(record=output, notify=print_remark)
    record_look("upload", exchange, file.schema.family.family, address, content, "uploaded")


def _as_name(address: str) -> str:
    """Return a file name of an address: ``tcp-192.168.0.5-9600``."""
    return "-".join(filter(None, "".join(c if c.isalnum() or c in "._" else "-" for c in address).split("-")))


def _print_table(rows: list[FleetRow]) -> None:
    wide = max(len(row.address) for row in rows)
    for row in rows:
        print(f"{row.address:{wide}}  {row.word:14}  {row.sha256[:12]:12}  {row.text}".rstrip())


def _end(options: Options, rows: list[FleetRow]) -> int:
    """Print the table, write the report and return one code for all."""
    codes = [_code(row) for row in rows]
    if options.json:
        print_json({"controls": list(map(_as_json, rows, codes))})
    else:
        _print_table(rows)
    if options.report is not None:
        write_paper(results_paper("Controls", HEADS, [row.cells for row in rows]), options.report)
    wrong = [f"{row.address} {row.word}" for row, code in zip(rows, codes, strict=True) if code > 1]
    if not wrong:
        return max(codes)
    print_remark(
        f"amp-studio: {len(rows) - len(wrong)} of {counted(len(rows), 'control')} done; {', '.join(wrong)}"
    )
    return _one_code(options, rows, codes)


def _one_code(options: Options, rows: list[FleetRow], codes: list[int]) -> int:
    """Return the worst of the codes; one control that was changed makes a failure a change in part."""
    # What a control contains now is not known: worse than one that failed and kept its values.
    if UNKNOWN in codes:
        return UNKNOWN
    is_partly = options.verb == "download" and "done" in [row.word for row in rows]
    return CHANGED if CHANGED in codes or is_partly else FAULT


def _as_json(row: FleetRow, code: int) -> dict[str, object]:
    """Return one control as ``--json`` lists it."""
    return {
        "address": row.address,
        "result": row.word,
        "code": code,
        "sha256": row.sha256 or None,
        "kept": row.kept or None,
        "text": row.text,
    }


def _code(row: FleetRow) -> int:
    """Return the exit code of one control."""
    if row.ending in ("well", "differs"):
        return int(row.ending == "differs")
    return AT_CONTROL.get(row.state, FAULT)
