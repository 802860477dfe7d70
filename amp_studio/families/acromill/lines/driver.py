"""An ACR card over its terminal: every setting asked for by its query, set by its command, read back, and saved with ESAVE.

Pages 91 and 113 to 135 of the AcroMill user's guide; docs/protocols/acr-terminal.md.
"""

from __future__ import annotations

import re
import threading
import time
from collections.abc import Callable
from functools import partial

from amp_studio.schema import load_schema
from amp_studio.transfer.break_state import state_after_break
from amp_studio.transfer.driver import Abilities, ControlIdentity, Receipt
from amp_studio.transfer.errors import (
    AtControl,
    CancelledError,
    ConnectionCutError,
    ControlFullError,
    ImageDamagedError,
    ImageRejectedError,
    ProtocolMismatchError,
    TransferError,
    WrongFamilyError,
)
from amp_studio.transfer.image import ImageError
from amp_studio.transfer.links.endpoint import Endpoint
from amp_studio.transfer.links.opening import connect
from amp_studio.transfer.links.serial_settings import SerialSettings
from amp_studio.transfer.progress import Progress, quiet
from amp_studio.transfer.waiting import OpenLink, Waiting

from .content import (
    FAMILY,
    LONGEST,
    AcrContent,
    CardContent,
    changed,
    plain_figure,
    positions_of,
    same_figures,
    settings,
)
from .terminal import Terminal

USUAL = SerialSettings(baud=9_600)
"""As delivered (Communications, page 66)."""
ASKED = 6  # times a query is sent until two answers in a row are the same
SET_TRIES = 3
SAVES = 6  # times a setting is looked for and saved again where the line broke meanwhile
SAVE_WAIT = 30.0  # seconds ESAVE may take
CAN_BE_OFF = ("LOPASS", "NOTCH")
AXES = "XYZABCUV"
SHOWN = 60  # signs of the card's words in a message

_FIGURE = r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:E[+-]?[0-9]{1,2})?"
_FIGURES = re.compile(rf"\(?\s*({_FIGURE})(?:\s*,\s*({_FIGURE}))?\s*\)?", re.IGNORECASE)

Figures = tuple[str, ...]


class TerminalDriver(AcrContent):
    """Speaks to a card; ``system`` is the unit system of its figures, which it does not know itself."""

    abilities = Abilities(can_send=True, all_or_nothing=False)

    def __init__(
        self,
        open_link: OpenLink,
        system: str = "inch",
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self._waiting = Waiting(clock, sleep)
        self._terminal = Terminal(open_link, self._waiting)
        self._system = system

    @classmethod
    def at(cls, endpoint: Endpoint, family: str = "", system: str = "inch") -> TerminalDriver:
        """Return the driver of an endpoint; raises WrongFamilyError where another family is asked for."""
        if family not in ("", FAMILY):
            raise WrongFamilyError(f"this is how ACR cards are spoken to, not {family}")
        place = endpoint.with_usual(USUAL)
        return cls(lambda look: connect(place, look=look), system)

    # -- what a driver can be asked for -----------------------------------------------------------

    def identify(self, progress: Progress = quiet, cancel: threading.Event | None = None) -> ControlIdentity:
        """Return the name and the version that the card prints."""
        self._waiting.begin(progress, cancel)
        rows = self._twice("VER")
        if self._terminal.program != "00":
            self._terminal.obey("PROG0")
        version = next((found[1] for row in rows if (found := re.match(r"Version\s+(\S+)", row))), "")
        return ControlIdentity(
            family=FAMILY,
            protocol="terminal" if self._system == "inch" else f"terminal-{self._system}",
            name=rows[0][:SHOWN] if rows and version else "ACR card",
            revision=version,
            signature=load_schema(FAMILY).signature,
        )

    def fetch(
        self, progress: Progress = quiet, cancel: threading.Event | None = None, stage: str = "upload"
    ) -> bytes:
        """Return every setting the card answers for."""
        self._waiting.begin(progress, cancel)
        return self._fetched(stage)

    def send(
        self,
        content: bytes,
        *,
        signature: str,  # noqa: ARG002 -- the card states none
        expected: bytes,  # noqa: ARG002
        held: bytes,
        progress: Progress = quiet,
        cancel: threading.Event | None = None,
    ) -> Receipt:
        """Send the commands that differ, read each back, save; after a break everything is read again."""
        self._waiting.begin(progress, cancel)
        sending = _Sending(content, held)
        try:
            self._send(sending)
        except CancelledError as error:
            error.at_control, error.new = sending.state()
            if sending.is_saving:
                error.what += "; whether the card has saved it is not known"
            elif error.at_control != "old":
                error.what += "; nothing of it is saved yet, and the card loses it with its power"
            raise
        except TransferError as error:
            raise self._after_break(error, sending) from None
        return Receipt(restart_needed=False, notes=("The card has saved it (ESAVE).",))

    def wait_restarted(
        self,
        receipt: Receipt,  # noqa: ARG002
        seconds: float,  # noqa: ARG002
        progress: Progress = quiet,  # noqa: ARG002
        cancel: threading.Event | None = None,  # noqa: ARG002
    ) -> bool:
        """A setting is active at once."""
        return True

    def close(self) -> None:
        """Hang up."""
        self._terminal.close()

    # -- reading ----------------------------------------------------------------------------------

    def _fetched(self, stage: str) -> bytes:
        found = CardContent(self._system)
        total = len(settings()) + len(AXES)
        for n, setting in enumerate(settings(), 1):
            figures = self._figures(setting.name, len(setting.addresses))
            if figures is not None:
                found.figures[setting.name] = figures
            self._waiting.notify(stage, n, total)
        if not any(found.figures.values()):
            raise ProtocolMismatchError("this terminal answers for no setting of an ACR card")
        for n, axis in enumerate(AXES, len(settings()) + 1):
            found.ballscrew.update(self._ballscrew(axis))
            self._waiting.notify(stage, n, total)
        return found.written()

    def _figures(self, name: str, count: int) -> Figures | None:
        """Return the figures of a setting, none for one that is off; None where the card does not have it."""
        rows = self._twice(name)
        if not rows:
            return () if name.startswith(CAN_BE_OFF) else None
        found = _FIGURES.fullmatch(rows[0][:LONGEST].removeprefix(name).strip())
        if found is None or len(rows) > 1:
            return None
        figures = tuple(plain_figure(figure) for figure in found.groups() if figure is not None)
        return figures if len(figures) == count else None

    def _ballscrew(self, axis: str) -> dict[str, str]:
        rows = self._twice(f"BSC {axis}")
        try:
            return dict(positions_of(rows))
        except ValueError:
            return {}  # words: this card does not show its tables

    def _twice(self, query: str) -> list[str]:
        """Return an answer that has come twice in a row: nothing else on this line shows a damaged digit."""
        before = None
        for _ in range(ASKED):
            rows = self._terminal.obey(query)
            if rows == before:
                return rows
            before = rows
        raise ImageDamagedError(f"the card answers '{query}' otherwise each time")

    # -- writing ----------------------------------------------------------------------------------

    def _send(self, sending: _Sending) -> None:
        cuts = self._terminal.cuts
        for number, name in enumerate(sending.names, 1):
            self._waiting.look()
            self._set(sending, name)
            self._waiting.notify("download", number, len(sending.names))
        for _ in range(SAVES):
            if self._terminal.cuts != cuts:
                cuts = self._terminal.cuts
                self._set_again(sending)
                continue
            rows = self._terminal.obey("ESAVE", SAVE_WAIT, sending.begin_save)
            if rows:
                raise ControlFullError(
                    f"the card answers ESAVE with '{rows[0][:SHOWN]}', and loses with its power what it has not saved"
                )
            if self._terminal.cuts == cuts:
                return
        raise ConnectionCutError("the line breaks each time the card is to save")

    def _set(self, sending: _Sending, name: str) -> None:
        """Send the command of one setting until it is read back; raises ImageRejectedError with its line."""
        line, wanted, fault = sending.lines[name], sending.wanted[name], ""
        for _ in range(SET_TRIES):
            with self._terminal.seen_through():
                rows = self._terminal.obey(line, sent=partial(sending.is_sent, name))
                present = self._present(name, len(wanted))
            if not rows and present is not None and same_figures(present, wanted):
                sending.is_proved(name)
                return
            shown = "nothing" if not present else ", ".join(present)
            fault = (
                f"the card answers '{rows[0][:SHOWN]}'" if rows else f"the card takes it and shows {shown}"
            )
        raise ImageRejectedError(f"line {sending.numbers[name]} of the script, '{line}': {fault}")

    def _set_again(self, sending: _Sending) -> None:
        """Set once more what a card has forgotten that lost its power meanwhile: half of it is not saved."""
        for name in sending.names:
            present = self._present(name, len(sending.wanted[name]))
            if present is None or not same_figures(present, sending.wanted[name]):
                self._set(sending, name)

    def _present(self, name: str, count: int) -> Figures | None:
        if not name.startswith("BSC "):
            return self._figures(name, count)
        figure = self._ballscrew(name[4]).get(name)
        return None if figure is None else (figure,)

    def _after_break(self, error: TransferError, sending: _Sending) -> TransferError:
        """Return the error with what the card contains now, read from it."""
        if not sending.touched:
            return error
        if isinstance(error, ConnectionCutError):  # it was called long enough
            error.at_control = "unknown"
            return error
        try:
            now = _joined(CardContent.read(self._fetched("verify")), sending)
            error.at_control, error.new = state_after_break(
                _named(sending.held), _named(sending.content), now
            )
        except (TransferError, ImageError):
            error.at_control = "unknown"
        return error


class _Sending:
    """What is to be sent, and how far it has come."""

    def __init__(self, content: bytes, held: bytes) -> None:
        self.content, self.held = CardContent.read(content), CardContent.read(held)
        self.lines = self.content.lines()
        self.numbers = {name: number for number, name in enumerate(self.lines, 3)}
        self.wanted = self.content.names()
        self.names = changed(content, held)
        self.touched: set[str] = set()
        self.is_saving = False
        self._proved: list[str] = []

    def is_sent(self, name: str) -> None:
        """Take notice that a command is being sent."""
        self.touched.add(name)

    def begin_save(self) -> None:
        """Take notice that the card is asked to save."""
        self.is_saving = True

    def is_proved(self, name: str) -> None:
        """Take notice that a setting was read back."""
        if name not in self._proved:
            self._proved.append(name)

    def state(self) -> tuple[AtControl, Figures]:
        """Return what the card contains by what was read back of it so far."""
        if not self.touched:
            return "old", ()
        if self.touched != set(self._proved):
            return "unknown", ()
        return ("new", ()) if len(self._proved) == len(self.names) else ("mixed", tuple(self._proved))


def _named(card: CardContent) -> dict[str, str]:
    return {name: ", ".join(figures) for name, figures in card.names().items()}


def _joined(card: CardContent, sending: _Sending) -> dict[str, str]:
    """Return what the card shows, each figure as the content spells it that shows the same."""
    now = card.names()
    for known in (sending.held.names(), sending.wanted):
        now.update(
            (name, known[name]) for name in now if name in known and same_figures(now[name], known[name])
        )
    return {name: ", ".join(figures) for name, figures in now.items()}


def metric(endpoint: Endpoint, family: str = "") -> TerminalDriver:
    """Return the driver of a card whose figures are in millimetres."""
    return TerminalDriver.at(endpoint, family, "metric")
