"""The same exchange with several controls: side by side, or one after the other until one fails."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any, Generic, Literal, TypeVar

from amp_studio.files import ParameterFile
from amp_studio.schema import quoted
from amp_studio.transfer.errors import AtControl, TransferError, unforeseen
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.links import parse_endpoint

from .exchange import Outcome
from .parameters import download_file, sha256
from .record import record_look
from .verification import ImageComparison, verify_at

_MAX_AT_ONCE = 16
"""Controls with which is exchanged at once; the others wait."""

T = TypeVar("T")
FleetWork = Callable[[str, Exchange], T]
"""What is done with the control at an address."""
ExchangeOf = Callable[[str], Exchange]
"""Gives the exchange with the control at an address; all of them can be stopped together."""


@dataclass(frozen=True)
class FleetResult(Generic[T]):
    """How the exchange with one control ended: with a result, or with an error;
    with neither where it was not tried.

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
    exchange_of: ExchangeOf,
    *,
    failed: Callable[[T], bool],
    stop_on_failure: bool = False,
) -> list[FleetResult[T]]:
    """Exchange with each control and return the results in the order of the addresses.

    All exchanges run side by side; with ``stop_on_failure`` one after the other, and after the first that
    ``failed`` or raised no other is begun. One that is stopped before it is begun is not tried. Raises
    ValueError for addresses that cannot be used, before anything is begun.
    """
    check_addresses(addresses)
    is_over = threading.Event()

    def one(address: str) -> FleetResult[T]:
        exchange = exchange_of(address)
        if is_over.is_set() or exchange.is_stopped:
            return FleetResult(address)
        found = _one(address, work, exchange)
        if stop_on_failure and (found.result is None or failed(found.result)):
            is_over.set()
        return found

    if stop_on_failure:
        return [one(address) for address in addresses]
    with ThreadPoolExecutor(min(_MAX_AT_ONCE, len(addresses)), thread_name_prefix="control") as pool:
        return list(pool.map(one, addresses))


def _one(address: str, work: FleetWork[T], exchange: Exchange) -> FleetResult[T]:
    try:
        return FleetResult(address, work(address, exchange))
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

    ``ending``  "well"; "differs" of a comparison; "failed", and then ``state`` is what the control contains;
                "not tried"
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
    file: ParameterFile,
    addresses: Sequence[str],
    exchange_of: ExchangeOf,
    *,
    expected: str | None = None,
    stop_on_failure: bool = False,
) -> list[FleetRow]:
    """Download a file to each control, as ``download_file`` does."""
    files = {address: file.copy() for address in addresses}  # a thread each

    def work(address: str, exchange: Exchange) -> Outcome:
        return download_file(files[address], address, exchange, expected=expected)

    found = with_each(
        addresses,
        work,
        exchange_of,
        failed=lambda outcome: not outcome.verified,
        stop_on_failure=stop_on_failure,
    )
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
    file: ParameterFile, addresses: Sequence[str], exchange_of: ExchangeOf, *, stop_on_failure: bool = False
) -> list[FleetRow]:
    """Compare a file with what each control contains, and record that."""
    family = file.schema.family.family
    files = {address: file.copy() for address in addresses}

    def work(address: str, exchange: Exchange) -> tuple[ImageComparison, str]:
        compared, content = verify_at(address, files[address], exchange, family)
        record_look("verify", exchange, family, address, content, compared.summary())
        return compared, sha256(content)

    found = with_each(
        addresses, work, exchange_of, failed=lambda pair: not pair[0].agrees, stop_on_failure=stop_on_failure
    )
    return [_compared(each) for each in found]


def _compared(found: FleetResult[tuple[ImageComparison, str]]) -> FleetRow:
    if found.result is None:
        return failed_row(found)
    compared, digest = found.result
    if compared.agrees:
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
