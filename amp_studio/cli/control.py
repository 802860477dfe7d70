"""Verbs that exchange files with a control."""

from __future__ import annotations

import argparse
from dataclasses import asdict, replace
from pathlib import Path

from amp_studio.files import ParameterFile
from amp_studio.report.wording import counted
from amp_studio.transfer.client.exchange import Outcome
from amp_studio.transfer.client.kept import IMAGE, digest_path, open_copy, save_image
from amp_studio.transfer.client.parameters import (
    download_file,
    fetch_image,
    restore_copy,
    sha256,
)
from amp_studio.transfer.client.record import record_look
from amp_studio.transfer.client.verification import verify_content
from amp_studio.transfer.content import decode_content
from amp_studio.transfer.emulated.family_control import EmulatedOptions, emulate
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.image import ImageError
from amp_studio.transfer.links.endpoint import Endpoint, parse_endpoint
from amp_studio.transfer.links.security import Security, can_others_read, exposure, read_password
from amp_studio.transfer.progress import Stop

from .by_hand import note_by_hand, sheet_offered
from .comparing import difference_json, print_comparison, print_difference
from .console import assignments, family, note, print_json, progress
from .errors import UsageError
from .fleet import check_fleet, download_to_several, is_fleet, record_upload, upload_several, verify_several
from .opened import opened
from .out_of_range import settle_values
from .output import check_new, write_new
from .program import AT_CONTROL, CHANGED, FAULT
from .screen import end_results, flush_results
from .stopping import asked_politely


def emulate_verb(options: argparse.Namespace) -> int:
    """Be a control until stopped."""
    family(options.family)
    return emulate(_secured(options), EmulatedOptions(
        options.family, options.state, machine=options.machine, estop=not options.no_estop,
        autostart=not options.manual_restart, faults=options.faults,
        hardware=dict(assignments(options.option, "NAME=VALUE"))))  # fmt: skip


def _secured(options: argparse.Namespace) -> Endpoint:
    """Return where the control listens and what it asks of who connects; notes who else can reach it."""
    place = parse_endpoint(options.listen)
    if (options.key is not None) > (options.certificate is not None):
        raise UsageError("--key belongs to a --certificate")
    password = read_password(options.password_file) if options.password_file is not None else ""
    if options.password_file is not None and can_others_read(options.password_file):
        note(f"warning: {options.password_file} can be read by other users of this computer")
    warning = (
        exposure(place.host, has_tls=place.kind == "tls", has_password=bool(password)) if place.host else ""
    )
    if warning:
        note(f"warning: {warning}")
    return replace(place, security=Security(password, options.certificate, options.key))


def download_verb(options: argparse.Namespace) -> int:
    """Send a file to a control; 3 if that is not proved afterwards, 4 where it is not known what it contains."""
    file, path = opened(options.path, options), options.path
    errors = _note_errors(file, path)
    if errors and not options.accept_errors:
        raise UsageError(f"{path} has {errors}: nothing was sent (--accept-errors sends it anyway)")
    name = file.schema.family.family
    check_fleet(options, options.to)
    with asked_politely() as stop, sheet_offered(name):
        exchange = _exchange(options, path, stop)
        if is_fleet(options, options.to):
            return download_to_several(options, file, exchange)
        outcome = download_file(file, options.to[0], exchange, expected=options.expect)
        note_by_hand(name)
        return _print_outcome(outcome)


def _exchange(options: argparse.Namespace, path: Path, stop: Stop) -> Exchange:
    """Return the exchange of a verb that replaces what a control contains."""
    keep = options.keep / path.name if options.keep else path
    return Exchange(progress(), stop, keep, record=path, notify=note)


def restore_verb(options: argparse.Namespace) -> int:
    """Put back what a control has contained; codes as of a download."""
    path = options.copy
    copy = open_copy(path)
    if not copy.is_checked:
        note(f"{digest_path(path)} is not there: {path.name} goes back unchecked")
    if copy.file is None:
        note(f"{path} goes back byte for byte, but this program cannot read it: {copy.fault}")
    elif errors := _note_errors(copy.file, path):
        if not copy.is_kept:
            raise UsageError(
                f"{path} has {errors}, and no image beside it proves that a control contained it: nothing was sent "
                "(download --accept-errors sends it anyway)"
            )
        note(f"{path} goes back with {errors}, as the control contained it")
    with asked_politely() as stop:
        outcome = restore_copy(copy, options.to, _exchange(options, path, stop), expected=options.expect)
        return _print_outcome(outcome)


def _note_errors(file: ParameterFile, path: Path) -> str:
    """List the errors of a file, by the rules beside it too; returns how many there are, "" for none."""
    from amp_studio.report import alike, same_finding_text
    from amp_studio.validate import Validator, rules_beside

    findings = Validator(file, rules_beside(path, file.schema)).run()
    errors = [finding for finding in findings if finding.severity == "error"]
    for same in alike(errors):
        note(same_finding_text(file, same))
    return counted(len(errors), "error") if errors else ""


def _print_outcome(outcome: Outcome) -> int:
    """Print how an exchange ended and return the exit code; where it cannot be printed, that is no full success.

    A reader that has gone wanted no more: the exchange is as complete as it was.
    """
    code = 0 if outcome.verified else AT_CONTROL[outcome.at_control]
    try:  # a terminal takes each line at once, and may be gone
        print(outcome.text)
        if outcome.verified:
            print(f"sha256 {outcome.sha256}")
        flush_results()
    except BrokenPipeError:
        end_results()
        note(f"amp-studio: nobody reads the results any more; {outcome.text}")
    except (OSError, ValueError):
        end_results()
        note(f"amp-studio: the result cannot be printed; {outcome.text}")
        code = max(code, CHANGED if outcome.written else FAULT)
    return code


def upload_verb(options: argparse.Namespace) -> int:
    """Fetch what a control contains under a new name: its file, or byte for byte as an image."""
    output, source = options.output, options.source[0]
    check_fleet(options, options.source)
    if is_fleet(options, options.source):
        with asked_politely() as stop:
            return upload_several(options, Exchange(cancel=stop))
    check_new(output, "an upload")
    image = fetch_image(source, Exchange(progress()))
    if not image:
        raise UsageError("the control is empty: there is nothing to upload")
    values: int | None = None
    if output.suffix == IMAGE:
        save_image(image, output)
        text = f"{output}: {len(image)} bytes, digest in {digest_path(output).name}"
    else:
        file = _readable(image, output)
        note_by_hand(file.schema.family.family)
        settle_values(file, options.on_fault, "an upload")
        write_new(file, output)
        values = len(file.values)
        text = f"{output}: {counted(values, 'value')}"
        record_upload(output, file, source, image)
    if options.json:
        print_json({"path": str(output), "values": values, "sha256": sha256(image)})
    else:
        print(text)
        print(f"sha256 {sha256(image)}")
    return 0


def _readable(image: bytes, output: Path) -> ParameterFile:
    try:
        return decode_content(image)
    except ImageError as error:
        raise UsageError(
            f"{error}; nothing was written (-o {output.with_suffix(IMAGE)} keeps it byte for byte)"
        ) from None


def verify_verb(options: argparse.Namespace) -> int:
    """Compare a file with what a control contains, its values and every byte; 1 where they differ."""
    if options.all:
        from .drift import verify_all_verb  # compares many, and prints papers

        return verify_all_verb(options)
    if options.path is None or not options.control:
        raise UsageError("verify takes a file and --with ADDRESS, or --all (see 'amp-studio verify --help')")
    file = opened(options.path, options)
    check_fleet(options, options.control)
    if is_fleet(options, options.control):
        with asked_politely() as stop:
            return verify_several(options, file, Exchange(cancel=stop, record=options.path, notify=note))
    control, name = options.control[0], file.schema.family.family
    exchange = Exchange(progress(), record=options.path, notify=note)
    with sheet_offered(name):
        fetched = fetch_image(control, exchange, family=name)
    found = verify_content(file, fetched)
    record_look("verify", exchange, name, control, fetched, found.summary())
    if options.json:
        print_json({
            "differences": [difference_json(file, d, options.secrets) for d in found.values.differences], "same": found.values.same,
            "same_bytes": found.is_same, "sha256": sha256(fetched), "unreadable": found.unreadable or None, "absent": found.absent or None,
            "stays": found.stays or None,
            "header": [asdict(d) for d in found.head],
            "other_units": [difference_json(file, d, options.secrets) for d in found.other_units]})  # fmt: skip
        return int(not found.is_same)
    if not found.unreadable:
        print_comparison(file, found.values, options.secrets)
    for difference in found.other_units:
        print_difference(file, difference, options.secrets)
    for head in found.head:
        print(f"{head.line} in the header: '{head.a}'  |  '{head.b}'")
    print(found.summary())
    print(f"sha256 {sha256(fetched)}")
    return int(not found.is_same)
