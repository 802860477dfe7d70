"""The known controls of a folder against their files: which contain something else, and since when.

A control is known from the record of exchanges, with the file that was last put into it, and from
``project.yaml``, with the one file of the project where there is only one.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from amp_studio.files import (
    RECORD,
    ParameterFile,
    ParameterFileError,
    Project,
    is_there,
    local_time,
    open_file,
    parameter_files_in,
)
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.links import parse_endpoint

from .fleet import ExchangeOf, FleetResult, with_each
from .parameters import sha256
from .record import RecordedExchange, file_of_exchange, read_exchanges, record_look
from .verification import ImageComparison, verify_at

_PUT = ("download", "restore")
"""Exchanges that put a file into a control."""


@dataclass(frozen=True)
class ControlWithFile:
    """A control and the file that belongs into it; ``fault`` is why it is not known which, else empty."""

    address: str
    path: Path
    """The file; its folder where there is a fault."""
    fault: str = ""
    exchanges: tuple[RecordedExchange, ...] = ()
    """Those with this control, oldest first."""

    @property
    def last_put(self) -> RecordedExchange | None:
        """The last exchange that put a file into it."""
        return next((e for e in reversed(self.exchanges) if e.verb in _PUT and e.after), None)


@dataclass(frozen=True)
class Drift:
    """How a known control and its file compare."""

    known: ControlWithFile
    result: Literal["same", "differs", "not reached", "no file"]
    text: str
    """How the comparison ended, or why there is none, in a sentence."""
    since: str = ""
    """Of one that differs: which side was changed, and after which exchange."""
    sha256: str = ""
    file: ParameterFile | None = None
    compared: ImageComparison | None = None


def known_controls(folder: Path) -> list[ControlWithFile]:
    """Return the controls that a folder and those in it know, each once: where the last file was put into it.

    Raises OSError, ParameterFileError for what cannot be read.
    """
    found: dict[str, ControlWithFile] = {}
    for place in _folders(folder):
        for known in _controls_of(place):
            key = str(parse_endpoint(known.address))
            if key not in found or _when(known) > _when(found[key]):
                found[key] = known
    return sorted(found.values(), key=lambda known: (str(known.path), known.address))


def _folders(folder: Path) -> Iterator[Path]:
    """Yield a folder and those in it that are a project, or have a record of exchanges."""

    def refuse(error: OSError) -> None:
        raise error

    for name, inside, names in os.walk(folder, onerror=refuse):
        inside.sort()
        if RECORD in names or "project.yaml" in names:
            yield Path(name)


def _controls_of(folder: Path) -> Iterator[ControlWithFile]:
    exchanges = read_exchanges(folder)
    by_address: dict[str, list[RecordedExchange]] = {}
    for each in exchanges:
        try:
            by_address.setdefault(str(parse_endpoint(each.control)), []).append(each)
        except ValueError:  # an address of another version of the program
            continue
    named = {}
    if is_there(folder / "project.yaml") and (address := Project.open(folder).info.control):
        named[str(parse_endpoint(address))] = address
    for key, some in by_address.items():
        known = ControlWithFile(some[-1].control, folder, exchanges=tuple(some))
        if put := known.last_put:
            named.pop(key, None)
            yield _with_file(known, folder / file_of_exchange(put))
    for key, address in named.items():
        known = ControlWithFile(address, folder, exchanges=tuple(by_address.get(key, ())))
        files = parameter_files_in(folder)
        if len(files) == 1:
            yield _with_file(known, files[0])
        else:
            why = f"no download to it is recorded, and {folder} has {len(files)} parameter files"
            yield ControlWithFile(address, folder, why, known.exchanges)


def _with_file(known: ControlWithFile, path: Path) -> ControlWithFile:
    fault = "" if is_there(path) else f"{path}, which was put into it, is not there any more"
    return ControlWithFile(known.address, path, fault, known.exchanges)


def _when(known: ControlWithFile) -> str:
    return known.last_put.when if known.last_put else ""


def drift_of_all(controls: Sequence[ControlWithFile], exchange_of: ExchangeOf) -> list[Drift]:
    """Compare each control with its file, side by side, and record each look beside the file;
    in the order of the controls.
    """
    opened = {known.address: _opened(known) for known in controls}
    by_address = {known.address: known for known in controls}

    def work(address: str, exchange: Exchange) -> Drift:
        known, file = by_address[address], opened[address]
        assert isinstance(file, ParameterFile)
        family = file.schema.family.family
        compared, content = verify_at(address, file, exchange, family)
        drift = _drift(known, file, compared, sha256(content))
        beside = replace(exchange, record=known.path)
        record_look("verify", beside, family, address, content, compared.summary())
        return drift

    reachable = [address for address, file in opened.items() if isinstance(file, ParameterFile)]
    found: dict[str, FleetResult[Drift]] = {}
    if reachable:
        results = with_each(reachable, work, exchange_of, failed=lambda _: False)
        found = {each.address: each for each in results}
    return [_row(known, opened[known.address], found.get(known.address)) for known in controls]


def _opened(known: ControlWithFile) -> ParameterFile | str:
    """Return the file of a control, or why it cannot be compared."""
    if known.fault:
        return known.fault
    try:
        return open_file(known.path).file
    except ParameterFileError as error:
        return str(error)


def _row(known: ControlWithFile, file: ParameterFile | str, found: FleetResult[Drift] | None) -> Drift:
    if isinstance(file, str):
        return Drift(known, "no file", file)
    if found is None or found.result is None:
        why = found.error if found and found.error else "the comparison was stopped"
        return Drift(known, "not reached", why)
    return found.result


def _drift(known: ControlWithFile, file: ParameterFile, compared: ImageComparison, digest: str) -> Drift:
    if compared.agrees:
        return Drift(known, "same", compared.summary(), "", digest, file, compared)
    return Drift(known, "differs", compared.summary(), _since(known, digest), digest, file, compared)


def _since(known: ControlWithFile, digest: str) -> str:
    """Return which side was changed after which exchange, as far as the record shows it."""
    seen = [each for each in known.exchanges if each.after]
    if not seen:
        return "never seen before"
    put = known.last_put
    if put and put.after == digest:
        return f"the file was changed after {local_time(put.when)}; the control is as it was left then"
    first = len(seen)  # the first of the looks, without a gap until now, that saw what is there now
    while first and seen[first - 1].after == digest:
        first -= 1
    since = f", and seen so since {local_time(seen[first].when)}" if first < len(seen) else ""
    if not first:
        return f"different since the first look, {local_time(seen[0].when)}"
    return f"the control was changed after {local_time(seen[first - 1].when)}{since}"
