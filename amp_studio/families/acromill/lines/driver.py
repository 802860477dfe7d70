"""An ACR card over its terminal: every setting asked for by its query, set by its command, read back, and saved with ESAVE.

Pages 91 and 113 to 135 of the AcroMill user's guide; docs/protocols/acr-terminal.md.
"""

from __future__ import annotations

import re
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import ClassVar

from amp_studio.families.acromill.formats.acr_command import CommandSetting
from amp_studio.schema import load_schema
from amp_studio.transfer.break_state import state_after_break
from amp_studio.transfer.driver import Abilities, ControlIdentity, NeverRestarts, Receipt
from amp_studio.transfer.errors import (
    AtControl,
    CancelledError,
    Confirmed,
    ConnectionCutError,
    ControlFullError,
    ControlSilentError,
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
    names_of,
    plain_figure,
    positions_of,
    same_figures,
    settings,
)
from .terminal import Terminal

USUAL = SerialSettings(baud=9_600)
"""As delivered (Communications, page 66)."""
ASKED = 12  # times a query is sent until enough answers in a row are the same
SET_TRIES = 3
FETCH_WAIT = 600.0  # seconds the answers of a whole card may take; 20 at 9600 bit/s
SAVES = 6  # times a setting is looked for and saved again where the line broke meanwhile
SAVE_WAIT = 30.0  # seconds ESAVE may take
CAN_BE_OFF = ("LOPASS", "NOTCH")
AXES = "XYZABCUV"
SHOWN = 60  # signs of the card's words in a message

_FIGURE = r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:E[+-]?[0-9]{1,2})?"
_FIGURES = re.compile(rf"\(?\s*({_FIGURE})(?:\s*,\s*({_FIGURE}))?\s*\)?", re.IGNORECASE)

_WORDS = re.compile(r"[A-Z]{3}[A-Z ,.;:'()/-]*", re.IGNORECASE)
"""An error in words: no damage to a figure makes three letters and leaves no digit."""

Figures = tuple[str, ...]


class TerminalDriver(AcrContent, NeverRestarts):
    """Speaks to a card; ``system`` is the unit system of its figures, which it does not know itself."""

    abilities = Abilities(can_send=True, all_or_nothing=False)
    takes_live_values: ClassVar[bool] = True

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
        self._answered: set[str] = set()
        """The settings that the card has answered for in the readings of this driver so far."""

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
        rows = self._twice("VER", on_damage=2)  # only shown
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
            error.confirmed = sending.confirmed
            if sending.is_saving:
                error.what += "; whether the card has saved it is not known"
            elif error.at_control != "old":
                error.what += "; nothing of it is saved yet, and the card loses it with its power"
            raise
        except TransferError as error:
            raise self._after_break(error, sending) from None
        return Receipt(restart_needed=False, notes=("The card has saved it (ESAVE).",))

    def close(self) -> None:
        """Hang up."""
        self._terminal.close()

    # -- reading ----------------------------------------------------------------------------------

    def _fetched(self, stage: str) -> bytes:
        """Return every setting; what was read before the line showed damage for the first time is read again.

        A setting counts as one that the card does not have where a second reading lacks it too. Raises ImageDamagedError
        where an earlier reading has it: what is short is no copy.
        """
        found = CardContent(self._system)
        asked = [*settings(), *AXES]
        early, end = [], self._waiting.now() + FETCH_WAIT
        for n, what in enumerate(asked, 1):
            if self._waiting.now() > end:
                raise ControlSilentError(
                    f"the card has not answered for its settings within {FETCH_WAIT:g} s"
                )
            self._read_into(found, what)
            if not self._terminal.faults:
                early.append(what)
            if what is settings()[-1] and not any(found.figures.values()):
                raise ProtocolMismatchError("this terminal answers for no setting of an ACR card")
            self._waiting.notify(stage, n, len(asked))
        for what in early if self._terminal.faults else ():
            self._read_into(found, what)
        absent = [setting for setting in settings() if setting.name not in found.figures]
        for setting in absent:
            self._read_into(found, setting)
        self._answered |= found.figures.keys()
        if any(setting.name in self._answered for setting in absent):
            names = names_of([setting.name for setting in absent if setting.name in self._answered])
            raise ImageDamagedError(f"the card answers for {names} in one reading and not in another")
        return found.written()

    def _read_into(self, found: CardContent, what: CommandSetting | str) -> None:
        """Ask for a setting, or for the ballscrew table of an axis."""
        if isinstance(what, str):
            others = {name: figure for name, figure in found.ballscrew.items() if name[4] != what}
            found.ballscrew = others | self._ballscrew(what)
            return
        figures = self._figures(what.name, len(what.addresses))
        found.figures.pop(what.name, None)
        if figures is not None:
            found.figures[what.name] = figures

    def _figures(self, name: str, count: int) -> Figures | None:
        """Return the figures of a setting, none for one that is off; None where the card does not have it."""
        rows = self._readable(name, lambda rows: _is_answer(rows, name, count))
        if not rows:
            return () if name.startswith(CAN_BE_OFF) else None
        return _figures_in(rows[0], name)

    def _ballscrew(self, axis: str) -> dict[str, str]:
        rows = self._readable(f"BSC {axis}", _is_table)
        return (
            {} if _is_error(rows) else dict(positions_of(rows))
        )  # words: this card does not show its tables

    def _readable(self, query: str, is_answer: Callable[[list[str]], bool]) -> list[str]:
        """Return the answer of a query: figures, the error of the card in words, or nothing. Raises ImageDamagedError.

        Whatever else comes, even twice, was damaged on the line and proves nothing of the card.
        """
        for _ in range(SET_TRIES):
            rows = self._twice(query)
            if not rows or _is_error(rows) or is_answer(rows):
                return rows
            self._terminal.faults += 1
        raise ImageDamagedError(
            f"the card answers '{query}' with '{rows[0][:SHOWN]}', which is neither a setting nor an error"
        )

    def _twice(self, query: str, on_damage: int = 3) -> list[str]:
        """Return an answer that has come twice in a row: nothing else on this line shows a damaged digit.

        On a line that has shown damage it has to come three times: of 10000 a zero is soon lost twice.
        """
        before, same = None, 0
        for _ in range(ASKED):
            rows = self._terminal.obey(query)
            same = same + 1 if rows == before else 1
            before = rows
            if same >= (on_damage if self._terminal.faults else 2):
                return rows
        raise ImageDamagedError(f"the card answers '{query}' otherwise each time")

    # -- writing ----------------------------------------------------------------------------------

    def _send(self, sending: _Sending) -> None:
        cuts = self._terminal.cuts
        for number, name in enumerate(sending.names, 1):
            self._waiting.look()
            if name in sending.content.ballscrew:
                self._command(sending, name)
            else:
                self._set(sending, name)
            self._waiting.notify("download", number, len(sending.names))
        self._prove_tables(sending)
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

    def _command(self, sending: _Sending, name: str) -> str:
        """Send the command of one setting; returns what the card answers instead of obeying it, "" for nothing."""
        rows = self._terminal.obey(sending.lines[name], sent=partial(sending.is_sent, name))
        return f"the card answers '{rows[0][:SHOWN]}'" if rows else ""

    def _set(self, sending: _Sending, name: str) -> None:
        """Send the command of one setting until it is read back; raises ImageRejectedError with its line."""
        wanted, fault = sending.wanted[name], ""
        for _ in range(SET_TRIES):
            with self._terminal.seen_through():
                fault = self._command(sending, name)
                present = self._figures(name, len(wanted))
            if not fault and present is not None and same_figures(present, wanted):
                sending.is_proved(name)
                return
            fault = fault or f"the card takes it and shows {', '.join(present or ()) or 'nothing'}"
        raise sending.refused(name, fault)

    def _prove_tables(self, sending: _Sending) -> None:
        """Read each ballscrew table back as a whole, and send again what is another; raises ImageRejectedError."""
        for axis in dict.fromkeys(name[4] for name in sending.names if name in sending.content.ballscrew):
            names, fault = [name for name in sending.names if name.startswith(f"BSC {axis}")], ""
            for _ in range(SET_TRIES):
                present = self._ballscrew(axis)
                wrong = [name for name in names if present.get(name) != sending.content.ballscrew[name]]
                if not wrong:
                    break
                for name in wrong:
                    fault = (
                        self._command(sending, name)
                        or f"the card takes it and shows {present.get(name, 'nothing')}"
                    )
            else:
                raise sending.refused(wrong[-1], fault)
            for name in names:
                sending.is_proved(name)

    def _set_again(self, sending: _Sending) -> None:
        """Set once more what a card has forgotten that lost its power meanwhile: half of it is not saved."""
        for name in sending.names:
            if name in sending.content.ballscrew:
                continue
            present = self._figures(name, len(sending.wanted[name]))
            if present is None or not same_figures(present, sending.wanted[name]):
                self._set(sending, name)
        self._prove_tables(sending)

    def _after_break(self, error: TransferError, sending: _Sending) -> TransferError:
        """Return the error with what the card contains now, read from it."""
        if not sending.touched:
            return error
        error.confirmed = sending.confirmed
        if isinstance(error, ImageRejectedError) and error.confirmed:  # it has been answered
            error.confirmed = replace(error.confirmed, unanswered="")
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


def _is_error(rows: list[str]) -> bool:
    return len(rows) == 1 and _WORDS.fullmatch(rows[0][:LONGEST]) is not None


def _is_answer(rows: list[str], name: str, count: int) -> bool:
    figures = _figures_in(rows[0], name)
    return len(rows) == 1 and figures is not None and len(figures) == count


def _figures_in(row: str, name: str) -> Figures | None:
    """Return the figures of an answer, behind the name of the setting or alone; None where there are none."""
    found = _FIGURES.fullmatch(row[:LONGEST].removeprefix(name).strip())
    return (
        None
        if found is None
        else tuple(plain_figure(figure) for figure in found.groups() if figure is not None)
    )


def _is_table(rows: list[str]) -> bool:
    try:
        return bool(dict(positions_of(rows)))
    except ValueError:
        return False


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

    def refused(self, name: str, fault: str) -> ImageRejectedError:
        """Return the error of a setting that the card does not take, with its line."""
        return ImageRejectedError(f"line {self.numbers[name]} of the script, '{self.lines[name]}': {fault}")

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

    @property
    def confirmed(self) -> Confirmed | None:
        """How far it has come; None before anything was sent."""
        under_way = next(
            (name for name in self.names if name in self.touched and name not in self._proved), ""
        )
        return Confirmed(len(self._proved), len(self.names), under_way) if self.touched else None

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
