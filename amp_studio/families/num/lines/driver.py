"""The tool as the peripheral of a NUM control:
it takes and gives the parameter table while a person presses the keys.

Sections 13.2.3 to 13.2.6 of the NUM parameter manual; docs/protocols/num-table.md.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, replace
from typing import ClassVar, Self

from amp_studio.schema import load_schema
from amp_studio.transfer import (
    ConnectionCutError,
    ControlIdentity,
    ControlSilentError,
    ImageDamagedError,
    ImageError,
    ImageRejectedError,
    LineDriver,
    NoConnectionError,
    OpenLink,
    Receipt,
    Replacement,
    SentValues,
    TransferError,
    Waiting,
)
from amp_studio.transfer.links import Endpoint, Link, LinkError, Parity, SerialSettings

from .content import FAMILY, NumTableContent, content_of_table, reference_of, table_text, words_of_table
from .table_reader import XOFF, XON, TableReader, with_parity

USUAL = SerialSettings(baud=9_600)
OPERATOR_WAIT = 300.0  # seconds a person may take to start an unload
RECOVERY_WAIT = 120.0  # seconds he may take to do so after a break
READY_WAIT = 60.0  # seconds after which a load is sent to a control that does not ask for it with Xon
STOPPED_WAIT = (
    300.0  # seconds the control may stop a load: its operator corrects the job reference (page 13-10)
)
GAP_WAIT = 20.0  # seconds between two characters of a table
TABLE_WAIT = 900.0  # seconds a table may take to come; the largest takes 420 s at 300 bit/s
LOAD_WAIT = 3_600.0  # seconds a load may take with all its stops
CHECK_WAIT = 15.0  # seconds after which a check that is stopped has found a difference
STOPPED_NOTICE = 2.0  # seconds a load is stopped until the person reads why
LISTEN = 0.01  # seconds between two looks whether the control stops the table
SETTLE = 0.5  # seconds in which the control may still refuse the end of a load
RATE = 11_520.0  # bytes a second on a line that states no rate: Xoff must not come too late
UNLOADS = 3  # until a table has come undamaged
LARGEST_DRAIN = 1 << 16

UNLOAD_TEXT = (
    "At the control: MACHINE SETUP DATA, 3 UNLOAD, Enter at READY?, leave the job reference as it is, start "
    "(NUM parameter manual, page 13-12)"
)
LOAD_TEXT = (
    "At the control: MACHINE SETUP DATA, 2 LOAD, Enter at READY? (page 13-10). The table is sent as soon as"
    f" the control asks for it, or in {READY_WAIT:g} s"
)
CHECK_TEXT = (
    "At the control: MACHINE SETUP DATA, 4 CHECK, Enter at READY? (page 13-13). It compares the table with"
    f" its memory. The table is sent as soon as the control asks for it, or in {READY_WAIT:g} s"
)
STOPPED_TEXT = (
    "The control has stopped the table. Where it shows a number with %, replace it by the job reference (page"
    " 13-10); where it shows FILE ERROR, stop here"
)


class PeripheralDriver(NumTableContent, LineDriver):
    """Speaks to a control in utility 5. Every operation is begun by a person;
    what to press comes through ``progress``.
    """

    family, protocol = FAMILY, "peripheral"
    usual = USUAL
    own_flow = True
    is_checked = False
    """Whether the line itself finds damaged bytes, as TCP does."""
    has_checked: ClassVar[bool] = False
    """Whether the control checks each unload."""

    def __init__(self, open_link: OpenLink, waiting: Waiting | None = None) -> None:
        super().__init__(open_link, waiting)
        self._link: Link | None = None
        self._parity: Parity = "none"
        self._seen: bytes | None = None
        """The table of the last unload, until it was asked for."""
        self._is_within_line = False
        self._is_stopped = False

    @classmethod
    def at(cls, endpoint: Endpoint, family: str = "") -> Self:
        """Return the driver of an endpoint; raises WrongFamilyError where another family is asked for."""
        place = endpoint.with_usual(USUAL)
        if place.bits == 7 and place.parity in ("even", "odd"):
            # The same ten bits a character; so a damaged one is seen here, where the port would pass it on
            # unnoticed.
            place = replace(place, bits=8, parity="none")
        driver = super().at(place, family)
        driver.is_checked = endpoint.kind in ("tcp", "tls")
        return driver

    def close(self) -> None:
        """Close the line."""
        if self._link is not None:
            self._link.close()
            self._link = None

    # -- what the driver is made of ----------------------------------------------------------------

    def _identity(self) -> ControlIdentity:
        """Return the job reference of the CNC, which its table begins with."""
        self._seen = self._unloaded("upload", OPERATOR_WAIT)
        return ControlIdentity(
            family=FAMILY,
            protocol=self.protocol,
            name=f"CNC with the job reference {reference_of(self._seen)}",
            signature=load_schema(FAMILY).signature,
            size=len(self._seen),
            sha256=hashlib.sha256(self._seen).digest(),
        )

    def _fetched(self, stage: str) -> bytes:
        """Return the table; the one that ``identify`` has just read need not be unloaded again."""
        seen, self._seen = self._seen, None
        return self._unloaded(stage, OPERATOR_WAIT) if seen is None else seen

    def _names(self, content: bytes) -> dict[str, str]:
        return words_of_table(content)

    def _send(self, replacement: Replacement, sent: SentValues) -> Receipt:
        """Load a table: the control takes all of its lines and answers none."""
        self._seen = None
        lines = table_text(replacement.content).splitlines(keepends=True)
        sent.when_stopped = "end the load at the control too"
        try:
            self._push(_Load(lines, LOAD_TEXT, "download", STOPPED_WAIT, sent))
        except LinkError as error:
            raise ConnectionCutError(f"the line broke: {error.what}") from None
        return Receipt(
            is_answered=False, notes=("Leave utility 5, confirm the changes and reset the CNC (page 13-8).",)
        )

    def _after_break(self, error: TransferError, sent: SentValues, replacement: Replacement) -> None:
        """Ask a person for one more unload, which alone can show what the control contains now."""
        self.close()
        self._waiting.ask(f"{error.what}. End the load at the control")
        super()._after_break(error, sent, replacement)

    def _fetched_after_break(self) -> bytes:
        return self._unloaded("verify", RECOVERY_WAIT)

    # -- unload -----------------------------------------------------------------------------------

    def _unloaded(self, stage: str, seconds: float) -> bytes:
        """Have a person unload until a table has come undamaged,
        twice the same where nothing on the line shows damage.
        """
        before, fault, last = b"", "", TransferError("no table")
        for _ in range(UNLOADS):
            self._line()  # what comes before the port is open is lost
            self._waiting.ask(f"{fault}{UNLOAD_TEXT}")
            try:
                reader = self._one_unload(stage, seconds)
                content = _checked(reader)
            except (ImageDamagedError, ConnectionCutError) as error:
                fault, last = f"{error.what}: unload it once more. ", error
                continue
            self._parity = reader.parity
            if self.has_checked:
                if self._check(content):
                    return content
                fault = "The control has found another table than its own: unload it once more. "
                last = ImageDamagedError("the control found the table it had unloaded to be another")
                continue
            # TCP has a checksum, a serial line at best parity; without any of them only a second table
            # proves the first.
            if self.is_checked or reader.parity != "none" or content == before:
                return content
            fault = (
                "Nothing on this line (no parity) shows a damaged character: unload it once more, to"
                " compare. "
            )
            last = ImageDamagedError("two unloads of the table were not the same")
            before = content
        raise last

    def _one_unload(self, stage: str, seconds: float) -> TableReader:
        """Read one table as it comes; raises ControlSilentError, ImageDamagedError, ConnectionCutError."""
        reader, waiting, has_begun = TableReader(), self._waiting, False
        end = waiting.now() + seconds
        try:
            link = self._line()
            while not reader.is_whole:
                is_coming = reader.has_begun or reader.has_noise
                # Before the first character a person has to walk to the control; then a gap means that
                # it has stopped.
                left = max(0.0, end - waiting.now())
                data = waiting.read(link, min(GAP_WAIT, left) if is_coming else left)
                if not data or (left == 0 and is_coming):
                    raise self._nothing_came(reader, seconds)
                reader.feed(data)
                if reader.has_begun and not has_begun:
                    # From here the patience is for the table, no longer for the person.
                    has_begun, end = True, waiting.now() + TABLE_WAIT
                waiting.note_answer()
                # How long the table will be is not known: half of it, until its end has come.
                waiting.notify(stage, len(reader.table), 2 * len(reader.table))
            waiting.notify(stage, len(reader.table), len(reader.table))
        except LinkError as error:
            self.close()
            raise ConnectionCutError(f"the line broke: {error.what}") from None
        return reader

    def _nothing_came(self, reader: TableReader, seconds: float) -> TransferError:
        """Return the error of a table that did not come, or stopped."""
        if reader.has_noise and not reader.has_begun:
            return ImageDamagedError("what has come does not begin with %, as a table does")
        if not reader.has_begun:
            return ControlSilentError(f"no table has come within {seconds:g} s")
        line = reader.table.count(b"\n") + 1
        return ImageDamagedError(f"the table did not come to its end: it stopped in line {line}")

    def _line(self) -> Link:
        """Return the line there is, or a new one; raises NoConnectionError."""
        if self._link is None:
            try:
                self._link = self._open_link(self._poll)
            except LinkError as error:
                raise NoConnectionError(f"no connection to the control: {error}") from None
        return self._link

    def _poll(self) -> None:
        """Be called while the link waits; a line of the table that has been begun is sent to its end."""
        if not self._is_within_line:
            self._waiting.look()

    # -- load and check ---------------------------------------------------------------------------

    def _check(self, content: bytes) -> bool:
        """Have the control compare a table with its memory;
        returns whether it took it to its end (page 13-13).

        Where a parameter differs the control stops there and shows FILE ERROR,
        and the person may stop here too.
        """
        lines = table_text(content).splitlines(keepends=True)
        try:
            self._push(_Load(lines, CHECK_TEXT, "verify", CHECK_WAIT, SentValues()))
        except ImageRejectedError:
            return False
        except LinkError as error:
            self.close()
            raise ConnectionCutError(f"the line broke: {error.what}") from None
        return True

    def _push(self, load: _Load) -> None:
        """Send a table line by line, as fast as the control takes it."""
        link, waiting = self._line(), self._waiting
        drained = 0
        # An Xoff of the last exchange must not stop this one; the bound is for a control that never
        # falls silent.
        while drained < LARGEST_DRAIN and (data := link.read(0)):
            drained += len(data)
        self._is_stopped = False
        waiting.ask(load.sentence)
        self._await_ready(link)
        rate = link.bytes_per_second or RATE
        due = began = waiting.now()
        for number, line in enumerate(load.lines, 1):
            waiting.look()
            self._await_resume(link, load.stopped_wait)
            if waiting.now() > began + LOAD_WAIT:
                raise ImageRejectedError(f"the control has not taken the table within {LOAD_WAIT:g} s")
            if line.startswith("#"):  # one that changes the control
                load.sent.begin("the table")
            self._write(link, line)
            # A port takes whole lines at once into its buffer: what the wire cannot have sent yet is
            # waited for, or Xoff would come too late.
            due = max(due, waiting.now()) + len(line) / rate
            self._listen(link, due - waiting.now())
            waiting.note_answer()
            waiting.notify(load.stage, number, len(load.lines))
        # Xoff behind the last character still means that the end was not taken.
        self._listen(link, SETTLE)
        self._await_resume(link, load.stopped_wait)

    def _write(self, link: Link, line: str) -> None:
        self._is_within_line = True
        try:
            link.write(bytes(with_parity(code, self._parity) for code in line.encode("ascii")))
        finally:
            self._is_within_line = False

    def _await_ready(self, link: Link) -> None:
        """Wait for the control to ask for the table; one that never does gets it after a while."""
        waiting = self._waiting
        end = waiting.now() + READY_WAIT
        while (left := end - waiting.now()) > 0:
            if any(byte & 0x7F == XON for byte in waiting.read(link, left)):
                break
        waiting.note_answer()

    def _listen(self, link: Link, seconds: float) -> None:
        """Let some time pass, and obey Xoff and Xon; what else a control sends means nothing."""
        waiting = self._waiting
        end = waiting.now() + seconds
        while True:
            waiting.look()
            for byte in link.read(0):
                self._is_stopped = {XOFF: True, XON: False}.get(byte & 0x7F, self._is_stopped)
            left = end - waiting.now()
            if left <= 0:
                return
            waiting.sleep(min(left, LISTEN))

    def _await_resume(self, link: Link, seconds: float) -> None:
        """Wait while the control has stopped the table; raises ImageRejectedError where it does not go on."""
        began, is_reported = self._waiting.now(), False
        while self._is_stopped:
            self._listen(link, 0.1)
            waited = self._waiting.now() - began
            if waited >= STOPPED_NOTICE and not is_reported:
                is_reported = True
                self._waiting.ask(STOPPED_TEXT)
            if waited >= seconds:
                raise ImageRejectedError(f"the control has stopped the table for {seconds:g} s")


@dataclass
class _Load:
    """A table that is sent: its lines, what a person is to do for it, and what becomes of it."""

    lines: list[str]
    sentence: str
    stage: str
    stopped_wait: float
    sent: SentValues


def _checked(reader: TableReader) -> bytes:
    """Return the content of a table whose lines are whole; raises ImageDamagedError."""
    content = content_of_table(reader.table.decode("ascii"))
    try:
        words_of_table(content)
    except ImageError as error:
        raise ImageDamagedError(f"the table has arrived damaged ({error})") from None
    return content


class CheckingPeripheralDriver(PeripheralDriver):
    """Has the control check each unload, as the manual asks for (page 13-13)."""

    protocol = "peripheral-check"
    has_checked = True
