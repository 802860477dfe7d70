"""An ACR card over its terminal: every setting asked for by its query, set by its command, read back,
and saved with ESAVE.

Pages 91 and 113 to 135 of the AcroMill user's guide; docs/protocols/acr-terminal.md.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection
from functools import partial
from typing import ClassVar

from amp_studio.families.acromill.formats.acr_command import CommandSetting
from amp_studio.schema import load_schema
from amp_studio.transfer import (
    ConnectionCutError,
    ControlFullError,
    ControlIdentity,
    ControlSilentError,
    ControlStatus,
    ImageDamagedError,
    ImageRejectedError,
    LineDriver,
    OpenLink,
    ProtocolMismatchError,
    Receipt,
    Replacement,
    SentValues,
    TransferError,
    Waiting,
)
from amp_studio.transfer.links import SerialSettings

from .content import (
    FAMILY,
    LONGEST,
    AcrContent,
    CardContent,
    differing_settings,
    names_of,
    plain_figure,
    positions_of,
    same_figures,
    settings,
)
from .status import (
    BIT_STEP,
    ENCODER,
    ENCODER_STEP,
    NOT_EXCESS,
    PRIMARY,
    SECONDARY,
    SETPOINT_STEP,
    CardAxis,
    status_of,
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
SHOWN = 60  # characters of the card's words in a message

_FIGURE = r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:E[+-]?[0-9]{1,2})?"
_FIGURES = re.compile(rf"\(?\s*({_FIGURE})(?:\s*,\s*({_FIGURE}))?\s*\)?", re.IGNORECASE)

_WORDS = re.compile(r"[A-Z]{3}[A-Z ,.;:'()/-]*", re.IGNORECASE)
"""An error in words: no damage to a figure makes three letters and leaves no digit."""

Figures = tuple[str, ...]


class TerminalDriver(AcrContent, LineDriver):
    """Speaks to a card whose figures are in inches;
    the card does not know itself in which unit system they are.
    """

    family, protocol = FAMILY, "terminal"
    usual = USUAL
    system: ClassVar[str] = "inch"
    takes_live_values: ClassVar[bool] = True

    def __init__(self, open_link: OpenLink, waiting: Waiting | None = None) -> None:
        super().__init__(open_link, waiting)
        self._terminal = Terminal(open_link, self._waiting)
        self._answered: set[str] = set()
        """The settings that the card has answered for in the readings of this driver so far."""
        self._known: ControlIdentity | None = None
        self._pulses: dict[str, float] = {}
        """PPU of each axis, read once for the status."""

    def close(self) -> None:
        """Close the line."""
        self._terminal.close()

    # -- what the driver is made of ----------------------------------------------------------------

    def _identity(self) -> ControlIdentity:
        """Return the name and the version that the card prints."""
        # The version is only shown: two equal answers are enough, even on a bad line.
        rows = self._read_until_equal("VER", on_damage=2)  # only shown
        if self._terminal.program != "00":
            self._terminal.execute("PROG0")
        version = next((match[1] for row in rows if (match := re.match(r"Version\s+(\S+)", row))), "")
        return ControlIdentity(
            family=FAMILY,
            protocol=self.protocol,
            name=rows[0][:SHOWN] if rows and version else "ACR card",
            revision=version,
            signature=load_schema(FAMILY).signature,
        )

    def status(self) -> ControlStatus:
        """Return encoder positions, setpoints and excess-error bits of all axes: queries alone."""
        if self._known is None:
            # PPU makes pulses readable and is read once: positions are asked for again and again.
            self._known = self._identity()
            found = {axis: self._figures(f"PPU {axis}", 1) for axis in AXES}
            self._pulses = {axis: float(figures[0]) for axis, figures in found.items() if figures}
        axes = [self._axis_figures(n, axis) for n, axis in enumerate(AXES) if axis in self._pulses]
        return status_of(self._known, "in" if self.system == "inch" else "mm", axes)

    def _axis_figures(self, n: int, axis: str) -> CardAxis:
        encoder = self._queried(f"?P{ENCODER + n * ENCODER_STEP}")
        primary, secondary = (
            self._queried(f"?P{first + n * SETPOINT_STEP}") for first in (PRIMARY, SECONDARY)
        )
        within = self._queried(f"?BIT{NOT_EXCESS + n * BIT_STEP}")
        return CardAxis(axis, self._pulses[axis], encoder, primary, secondary, within != 0.0)

    def _queried(self, query: str) -> float:
        """Return a figure that may change from one look to the next,
        so that it is asked for until it is one; raises TransferError.
        """
        rows: list[str] = []
        for _ in range(SET_TRIES):
            rows = self._terminal.execute(query)
            if len(rows) == 1 and re.fullmatch(_FIGURE, rows[0], re.IGNORECASE):
                return float(rows[0])
        raise ProtocolMismatchError(
            f"the card answers '{query}' with '{rows[0][:SHOWN] if rows else 'nothing'}'"
        )

    def _names(self, content: bytes) -> dict[str, str]:
        return {name: ", ".join(figures) for name, figures in CardContent.read(content).names().items()}

    def _with_new(self, replacement: Replacement, names: Collection[str]) -> bytes:
        card, wanted = CardContent.read(replacement.current), CardContent.read(replacement.content)
        card.figures.update({name: wanted.figures[name] for name in names if name in wanted.figures})
        card.ballscrew.update({name: wanted.ballscrew[name] for name in names if name in wanted.ballscrew})
        return card.written()

    def _names_now(self, found: bytes, replacement: Replacement) -> dict[str, str]:
        """Return what the card shows, each figure as the content spells it that shows the same."""
        now = CardContent.read(found).names()
        for content in (replacement.current, replacement.content):
            known = CardContent.read(content).names()
            now.update(
                (name, known[name]) for name in now if name in known and same_figures(now[name], known[name])
            )
        return {name: ", ".join(figures) for name, figures in now.items()}

    def _after_break(self, error: TransferError, sent: SentValues, replacement: Replacement) -> None:
        if isinstance(error, ConnectionCutError):  # it was called long enough
            error.at_control, error.confirmed = "unknown", sent.confirmed
            error.remains = self._by_answers(sent, replacement)
        else:
            super()._after_break(error, sent, replacement)
        # What the card contains now is half of it: a refusal of ESAVE has the other half in its own words.
        if isinstance(error, ConnectionCutError | ControlSilentError) and sent.when_stopped:
            error.what += f"; {sent.when_stopped}"

    # -- reading ----------------------------------------------------------------------------------

    def _fetched(self, stage: str) -> bytes:
        """Return every setting; what was read before the line showed damage for the first time is read again.

        A setting counts as one that the card does not have where a second reading lacks it too. Raises
        ImageDamagedError where an earlier reading has it: what is short is no copy.
        """
        content = CardContent(self.system)
        for what in self._read_all(content, stage):
            self._read_into(content, what)
        missing = [setting for setting in settings() if setting.name not in content.figures]
        # Once more for what is missing: an answer that was lost looks like a setting that the card does not
        # have.
        for setting in missing:
            self._read_into(content, setting)
        # A setting missing in both readings may not exist on this card; one that ever was there has
        # been lost on the line.
        self._answered |= content.figures.keys()
        lost = [setting.name for setting in missing if setting.name in self._answered]
        if lost:
            raise ImageDamagedError(
                f"the card answers for {names_of(lost)} in one reading and not in another"
            )
        return content.written()

    def _read_all(self, found: CardContent, stage: str) -> list[CommandSetting | str]:
        """Ask for every setting and table; returns those to be read again,
        which came before the line showed damage for the first time.
        """
        asked: list[CommandSetting | str] = [*settings(), *AXES]
        early, end = [], self._waiting.now() + FETCH_WAIT
        for n, what in enumerate(asked, 1):
            if self._waiting.now() > end:
                raise ControlSilentError(
                    f"the card has not answered for its settings within {FETCH_WAIT:g} s"
                )
            self._read_into(found, what)
            # What came before the first damage was asked twice only, and is read again by the stricter
            # rule.
            if not self._terminal.faults:
                early.append(what)
            # Something else that echoes and prompts would give an empty card, and a download would then
            # overwrite nothing known.
            if what is settings()[-1] and not any(found.figures.values()):
                raise ProtocolMismatchError("this terminal answers for no setting of an ACR card")
            self._waiting.notify(stage, n, len(asked))
        return early if self._terminal.faults else []

    def _read_into(self, found: CardContent, what: CommandSetting | str) -> None:
        """Ask for a setting, or for the ballscrew table of an axis."""
        if isinstance(what, str):
            others = {name: figure for name, figure in found.ballscrew.items() if name[4] != what}
            found.ballscrew = others | self._ballscrew(what)
            return
        figures = self._figures(what.name, len(what.addresses))
        # A second reading replaces what the first one found, by nothing too.
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
        """Return the answer of a query: figures, the error of the card in words, or nothing.
        Raises ImageDamagedError.

        Whatever else comes, even twice, was damaged on the line and proves nothing of the card.
        """
        for _ in range(SET_TRIES):
            rows = self._read_until_equal(query)
            if not rows or _is_error(rows) or is_answer(rows):
                return rows
            self._terminal.faults += 1
        raise ImageDamagedError(
            f"the card answers '{query}' with '{rows[0][:SHOWN]}', which is neither a setting nor an error"
        )

    def _read_until_equal(self, query: str, on_damage: int = 3) -> list[str]:
        """Return an answer that has come twice in a row: nothing else on this line shows a damaged digit.

        On a line that has shown damage it has to come three times: of 10000 a zero is soon lost twice.
        """
        before, same = None, 0
        for _ in range(ASKED):
            rows = self._terminal.execute(query)
            same = same + 1 if rows == before else 1
            before = rows
            if same >= (on_damage if self._terminal.faults else 2):
                return rows
        raise ImageDamagedError(f"the card answers '{query}' otherwise each time")

    # -- writing ----------------------------------------------------------------------------------

    def _send(self, replacement: Replacement, sent: SentValues) -> Receipt:
        """Send the commands that differ, read each back, save."""
        transfer = _ScriptTransfer(replacement, sent)
        # A card that lost its power forgot what it had not saved: a new cut of the line shows that it may
        # have.
        cuts = self._terminal.cuts
        for number, name in enumerate(transfer.names, 1):
            self._waiting.look()
            if name in transfer.content.ballscrew:
                # A position has no query: tables are read back as a whole, below.
                self._command(transfer, name)
            else:
                self._set(transfer, name)
            self._waiting.notify("download", number, len(transfer.names))
        self._prove_tables(transfer)
        for _ in range(SAVES):
            # The line may have broken because the card lost its power, and with it all that is not
            # saved.
            if self._terminal.cuts != cuts:
                cuts = self._terminal.cuts
                self._set_again(transfer)
                continue
            rows = self._terminal.execute("ESAVE", SAVE_WAIT, transfer.begin_save)
            if rows:
                raise ControlFullError(
                    f"the card answers ESAVE with '{rows[0][:SHOWN]}', and loses with its power what it has"
                    " not saved"
                )
            # A break during ESAVE leaves open whether it was saved: all is read and saved again.
            if self._terminal.cuts == cuts:
                return Receipt(restart_needed=False, notes=("The card has saved it (ESAVE).",))
        raise ConnectionCutError("the line breaks each time the card is to save")

    def _command(self, transfer: _ScriptTransfer, name: str) -> str:
        """Send the command of one setting; returns what the card answers instead of obeying it,
        "" for nothing.
        """
        rows = self._terminal.execute(transfer.lines[name], sent=partial(transfer.begin, name))
        return f"the card answers '{rows[0][:SHOWN]}'" if rows else ""

    def _set(self, transfer: _ScriptTransfer, name: str) -> None:
        """Send the command of one setting until it is read back; raises ImageRejectedError with its line."""
        wanted, fault = transfer.figures[name], ""
        for _ in range(SET_TRIES):
            with self._terminal.seen_through():
                fault = self._command(transfer, name)
                present = self._figures(name, len(wanted))
            if not fault and present is not None and same_figures(present, wanted):
                transfer.sent.confirm(name)
                return
            fault = fault or f"the card takes it and shows {', '.join(present or ()) or 'nothing'}"
        raise transfer.refused(name, fault)

    def _prove_tables(self, transfer: _ScriptTransfer) -> None:
        """Read each ballscrew table back as a whole, and send again what is another;
        raises ImageRejectedError.
        """
        for axis in dict.fromkeys(name[4] for name in transfer.names if name in transfer.content.ballscrew):
            names, fault = [name for name in transfer.names if name.startswith(f"BSC {axis}")], ""
            for _ in range(SET_TRIES):
                present = self._ballscrew(axis)
                wrong = [name for name in names if present.get(name) != transfer.content.ballscrew[name]]
                if not wrong:
                    break
                for name in wrong:
                    fault = (
                        self._command(transfer, name)
                        or f"the card takes it and shows {present.get(name, 'nothing')}"
                    )
            else:
                raise transfer.refused(wrong[-1], fault)
            for name in names:
                transfer.sent.confirm(name)

    def _set_again(self, transfer: _ScriptTransfer) -> None:
        """Set once more what a card has forgotten that lost its power meanwhile: half of it is not saved."""
        for name in transfer.names:
            if name in transfer.content.ballscrew:
                continue
            present = self._figures(name, len(transfer.figures[name]))
            if present is None or not same_figures(present, transfer.figures[name]):
                self._set(transfer, name)
        self._prove_tables(transfer)


def _is_error(rows: list[str]) -> bool:
    return len(rows) == 1 and _WORDS.fullmatch(rows[0][:LONGEST]) is not None


def _is_answer(rows: list[str], name: str, count: int) -> bool:
    figures = _figures_in(rows[0], name)
    return len(rows) == 1 and figures is not None and len(figures) == count


def _figures_in(row: str, name: str) -> Figures | None:
    """Return the figures of an answer, behind the name of the setting or alone; None where there are none."""
    match = _FIGURES.fullmatch(row[:LONGEST].removeprefix(name).strip())
    return (
        None
        if match is None
        else tuple(plain_figure(figure) for figure in match.groups() if figure is not None)
    )


def _is_table(rows: list[str]) -> bool:
    try:
        return bool(dict(positions_of(rows)))
    except ValueError:
        return False


class _ScriptTransfer:
    """What is to be sent, and how far it has come."""

    def __init__(self, replacement: Replacement, sent: SentValues) -> None:
        self.content = CardContent.read(replacement.content)
        self.lines = self.content.lines()
        self.numbers = {name: number for number, name in enumerate(self.lines, 3)}
        self.figures = self.content.names()
        self.names = differing_settings(replacement.content, replacement.current)
        self.sent = sent
        sent.total = len(self.names)

    def refused(self, name: str, fault: str) -> ImageRejectedError:
        """Return the error of a setting that the card does not take, with its line."""
        return ImageRejectedError(f"line {self.numbers[name]} of the script, '{self.lines[name]}': {fault}")

    def begin(self, name: str) -> None:
        """Take notice that a command is being sent."""
        self.sent.begin(name)
        self.sent.when_stopped = "nothing of it is saved yet, and the card loses it with its power"

    def begin_save(self) -> None:
        """Take notice that the card is asked to save."""
        self.sent.when_stopped = "whether the card has saved it is not known"


class MetricTerminalDriver(TerminalDriver):
    """Speaks to a card whose figures are in millimetres."""

    protocol = "terminal-metric"
    system = "metric"
