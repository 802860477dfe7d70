"""Verbs that exchange files with a control."""

from __future__ import annotations

import argparse
import sys

from amp_studio.files import Document, ParameterFile, RangeFault, open_file
from amp_studio.files.lock import now
from amp_studio.schema import Address, ValueFault
from amp_studio.transfer.parameters import download_file, emulate, fetch_file, out_of_range

from .console import ask, family, note, progress
from .errors import UsageFault
from .files import diff_verb


def emulate_verb(options: argparse.Namespace) -> int:
    """Be a control until stopped."""
    family(options.family)
    return emulate(options.family, options.listen, options.state, machine=options.machine, estop=not options.no_estop,
                   autostart=not options.manual_restart, faults=options.faults)  # fmt: skip


def download_verb(options: argparse.Namespace) -> int:
    """Send a file to a control; 1 where it does not hold it afterwards."""
    file = open_file(options.path).file
    outcome = download_file(
        file, options.to, options.keep or options.path.parent, options.path.stem, progress()
    )
    print(outcome.text)
    return 0 if outcome.verified else 1


def upload_verb(options: argparse.Namespace) -> int:
    """Fetch a control's file under a new name."""
    if options.output.exists():
        raise UsageFault(f"{options.output} exists already: an upload gets a new name")
    file = fetch_file(options.source, progress())
    for address, said in out_of_range(file):
        walk(file, address, said, options.on_fault, "an upload")
    file.header.name = options.output.stem
    Document.create(file, options.output).close()
    print(f"{options.output}: {len(file.values)} values")
    return 0


def walk(file: ParameterFile, address: Address, said: str, on_fault: str, by: str) -> None:
    """Ask what to do with one out-of-range value that came from elsewhere: continue, edit, or quit."""
    if on_fault == "quit" or (on_fault == "ask" and not sys.stdin.isatty()):
        raise UsageFault(
            f"{by} holds an illegal value, nothing was written: {said} (--on-fault keep takes it)"
        )
    while on_fault == "ask":
        answer = ask(f"{said}\n[C]ontinue checking, [E]dit parameter, [Q]uit? ").strip().casefold()
        if answer.startswith("q"):
            raise UsageFault("given up, nothing was written")
        if answer.startswith("c"):
            break
        if answer.startswith("e"):
            try:
                file.set_many({address: file.read(address, ask("new value: "))})
                return
            except (ValueFault, RangeFault) as error:
                note(str(error))
    file.forced[address] = f"on {now()} by {by}"


def verify_verb(options: argparse.Namespace) -> int:
    """Compare a file with what a control holds; 1 where they differ."""
    options.a, options.b = str(options.path), options.control
    return diff_verb(options)
