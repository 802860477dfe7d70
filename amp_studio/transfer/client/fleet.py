"""The same exchange with several controls: side by side, or one after the other until one fails."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, Literal, TypeVar

from amp_studio.files import Notify, ParameterFile
from amp_studio.schema.quoting import quoted
from amp_studio.transfer.errors import AtControl, TransferError, unforeseen
from amp_studio.transfer.links.endpoint import parse_endpoint
from amp_studio.transfer.progress import Progress

from .exchange import Outcome
from .parameters import download_file, fetch_image, sha256
from .record import add_look
from .verification import ImageComparison, verify_content

MOST = 16
"""Controls with which is exchanged at once; the others wait."""

T = TypeVar("T")
FleetWork = Callable[[str, Progress], T]
"""The exchange with the control at an address."""


@dataclass(frozen=True)
class FleetResult(Generic[T]):
    """How the exchange with one control ended: with a result, or with an error; with neither where it was not tried.

    ``state`` is what a control whose exchange failed contains, as ``TransferError.at_control``.
    """

    address: str
    result: T | None = None
    error: str = ""
    state: AtControl = ""
    kept: str = ""

    @property
    def was_tried(self) -> bool:
        """Whether the exchange was begun."""
        return self.result is not None or bool(self.error)


def check_addresses(addresses: Sequence[str]) -> None:
    """Refuse an address that is none, and one that is named twice; raises ValueError."""
    seen: set[str] = set()
    for address in addresses:
        place = str(parse_endpoint(address))
        if place in seen:
            raise ValueError(f"{quoted(address)} is named twice: a control is exchanged with once")
        seen.add(place)


def with_each(
    addresses: Sequence[str],
    work: FleetWork[T],
    progress: Callable[[str], Progress],
    *,
    failed: Callable[[T], bool],
    stop_on_failure: bool = False,
    cancel: threading.Event | None = None,
) -> list[FleetResult[T]]:
    """Exchange with each control and return the results in the order of the addresses.

    ``progress`` gives the progress of an address. All exchanges run side by side; with ``stop_on_failure`` one after the
    other, and after the first that ``failed`` or raised no other is begun. ``cancel`` is for the exchanges themselves; once
    it is set no other is begun. Raises ValueError for addresses that cannot be used, before anything is begun.
    """
    check_addresses(addresses)
    is_over = threading.Event()

    def one(address: str) -> FleetResult[T]:
        if is_over.is_set() or (cancel is not None and cancel.is_set()):
            return FleetResult(address)
        found = _one(address, work, progress(address))
        if stop_on_failure and (found.result is None or failed(found.result)):
            is_over.set()
        return found

    if stop_on_failure:
        return [one(address) for address in addresses]
    with ThreadPoolExecutor(min(MOST, len(addresses)), thread_name_prefix="control") as pool:
        return list(pool.map(one, addresses))


def _one(address: str, work: FleetWork[T], progress: Progress) -> FleetResult[T]:
    try:
        return FleetResult(address, work(address, progress))
    except TransferError as error:
        return FleetResult(address, error=str(error), state=error.at_control, kept=error.kept or "")
    except (OSError, ValueError) as error:
        return FleetResult(address, error=str(error), state="old")
    except Exception as error:  # one control does not end the exchange with the others
        return FleetResult(address, error=unforeseen(error), state="unknown")


# -- downloads and comparisons as rows of a table -----------------------------------


@dataclass(frozen=True)
class FleetRow:
    """One control in the table of results: how its exchange ended, in a word and in a sentence.

    ``ending``  "well"; "differs" of a comparison; "failed", and then ``state`` is what the control contains; "not tried"
    """

    address: str
    word: str
    ending: Literal["well", "differs", "failed", "not tried"] = "well"
    state: AtControl = ""
    sha256: str = ""
    kept: str = ""
    text: str = ""

    @property
    def cells(self) -> tuple[str, ...]:
        """The row of a printed table, under ``HEADS``."""
        return self.address, self.word, self.sha256, self.kept, self.text


HEADS = ("Address", "Result", "SHA-256", "Kept copy", "How it ended")


def download_each(
    file: ParameterFile, path: Path, keep: Path, addresses: Sequence[str], progress: Callable[[str], Progress], *,
    expected: str | None = None, stop_on_failure: bool = False, cancel: threading.Event | None = None,
    notify: Notify = lambda _: None,
) -> list[FleetRow]:  # fmt: skip
    """Download a file to each control, as ``download_file`` does; ``path`` is its place, ``keep`` the folder of the copies."""
    files = {address: file.copy() for address in addresses}  # a thread each

    def work(address: str, show: Progress) -> Outcome:
        return download_file(files[address], address, keep, path.stem, show, cancel, expected=expected, record=path,
                             notify=notify)  # fmt: skip

    found = with_each(addresses, work, progress, failed=lambda outcome: not outcome.verified,
                      stop_on_failure=stop_on_failure, cancel=cancel)  # fmt: skip
    return [_downloaded(each) for each in found]


def _downloaded(found: FleetResult[Outcome]) -> FleetRow:
    outcome = found.result
    if outcome is None:
        return failed_row(found)
    kept = outcome.kept or ""
    if not outcome.verified:
        word = _WORDS.get(outcome.at_control, outcome.at_control)
        return FleetRow(found.address, word, "failed", outcome.at_control, outcome.sha256, kept, outcome.text)
    word = "done" if outcome.written else "had it already"
    return FleetRow(found.address, word, "well", outcome.at_control, outcome.sha256, kept, outcome.text)


def verify_each(
    file: ParameterFile, path: Path, addresses: Sequence[str], progress: Callable[[str], Progress], *,
    stop_on_failure: bool = False, cancel: threading.Event | None = None, notify: Notify = lambda _: None,
) -> list[FleetRow]:  # fmt: skip
    """Compare a file with what each control contains, and record that."""
    family = file.schema.family.family
    files = {address: file.copy() for address in addresses}

    def work(address: str, show: Progress) -> tuple[ImageComparison, str]:
        content = fetch_image(address, show, cancel, family=family)
        compared = verify_content(files[address], content)
        if problem := add_look("verify", path, family, address, content, compared.summary()):
            notify(problem)
        return compared, sha256(content)

    found = with_each(addresses, work, progress, failed=lambda pair: not pair[0].is_same,
                      stop_on_failure=stop_on_failure, cancel=cancel)  # fmt: skip
    return [_compared(each) for each in found]


def _compared(found: FleetResult[tuple[ImageComparison, str]]) -> FleetRow:
    if found.result is None:
        return failed_row(found)
    compared, digest = found.result
    if compared.is_same:
        return FleetRow(found.address, "same", sha256=digest, text=compared.summary())
    return FleetRow(found.address, "differs", "differs", sha256=digest, text=compared.summary())


_WORDS: dict[AtControl, str] = {"": "failed", "old": "failed", "new": "not proved"}


def failed_row(found: FleetResult[Any]) -> FleetRow:
    """Return the row of an exchange without a result."""
    if not found.was_tried:
        text = "an exchange before it failed, or was stopped"
        return FleetRow(found.address, "not tried", "not tried", text=text)
    word = _WORDS.get(found.state, found.state)
    return FleetRow(found.address, word, "failed", found.state, kept=found.kept, text=found.error)
