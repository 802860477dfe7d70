"""One download, restore or change: made, and recorded however it ends."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from amp_studio.transfer.content import ContentKind
from amp_studio.transfer.driver import ControlDriver
from amp_studio.transfer.errors import AtControl, TransferError
from amp_studio.transfer.exchange import Exchange

from .exchange import Keep, Outcome, WantedContent, download
from .kept import CopyError, open_copy
from .record import add_exchange, changes_of, digest_of, exchange_now, read_exchanges, record_path


class Recording:
    """Records one ``verb`` with the control at an address, in the folder that ``exchange`` names;
    nothing where it names none.
    """

    def __init__(self, verb: str, family: str, address: str, exchange: Exchange) -> None:
        self.exchange = exchange
        self._verb, self._family, self._address = verb, family, address
        self._current: bytes | None = None
        self._content = b""

    def run(
        self,
        driver: ControlDriver,
        wanted: WantedContent,
        keep: Keep,
        *,
        meanwhile: Callable[[], None] = lambda: None,
    ) -> Outcome:
        """Download and record it; one that ended before the control was read is left out.
        Raises as ``download``.
        """

        def content(current: bytes) -> bytes:
            made = wanted.of(current)
            self._current, self._content = current or None, made
            return made

        try:
            outcome = download(
                driver, replace(wanted, content=content), keep, self.exchange, meanwhile=meanwhile
            )
        except TransferError as error:
            # An attempt that never reached the control is no exchange.
            if self._current is not None or error.at_control not in ("", "old"):
                self._add(error.at_control, error.kept, str(error))
            raise
        self._add(outcome.at_control, outcome.kept, outcome.text, outcome.verified)
        return outcome

    def check_whole(self, kind: ContentKind, content: bytes, folder: Path) -> None:
        """Refuse to keep less than the newest copy of the same control has; raises CopyError.

        The record leads to that copy, in the ``folder`` where the next one is kept. Where there is none that
        can be read, there is nothing to compare.
        """
        beside = self.exchange.record
        try:
            exchanges = read_exchanges(record_path(beside).parent) if beside is not None else []
        except OSError:
            return
        kept = [each.kept for each in reversed(exchanges) if each.control == self._address]
        for path in (folder / Path(name).name for name in filter(None, kept)):
            try:
                earlier = open_copy(path).image
                # Another protocol keeps another kind, of which nothing can be missing here.
                is_alike = earlier.partition(b"\n")[0] == content.partition(b"\n")[0]
                lacking = kind.lacks(content, earlier) if is_alike else ""
            except (OSError, ValueError):
                continue
            if lacking:
                raise CopyError(
                    f"this reading lacks {lacking}, which {path.name} has: try once more; where another"
                    " control is connected there now, keep its copies in another folder"
                )
            return

    def _add(self, state: AtControl, kept: str | None, text: str, is_proven: bool = False) -> None:
        beside = self.exchange.record
        if beside is None:
            return
        current = self._current or b""
        after = digest_of(self._content) if is_proven else digest_of(current) if state == "old" else ""
        changes = () if state == "old" else changes_of(current, self._content)
        entry = exchange_now(
            self._verb,
            beside,
            self._family,
            self._address,
            before=digest_of(current),
            after=after,
            state=state,
            kept=kept or "",
            text=text,
            changes=changes,
        )
        if problem := add_exchange(beside, entry):
            self.exchange.notify(problem)
