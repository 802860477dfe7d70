"""The same exchange with several controls: side by side, or one after the other until one fails."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Generic, TypeVar

from amp_studio.schema.quoting import quoted
from amp_studio.transfer.errors import AtControl, TransferError, unforeseen
from amp_studio.transfer.links.endpoint import parse_endpoint
from amp_studio.transfer.progress import Progress

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
