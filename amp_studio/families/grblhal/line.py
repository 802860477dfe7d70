"""The line to a Grbl control: one command at a time, its answer up to ``ok`` or ``error:N``,
and what comes unasked.

The control may push an alarm, a message, a status report or the greeting of a start between any two lines. A
client that was lost may have left half a line:
it is erased before the first command (``docs/protocols/grblhal.md``).
"""

from __future__ import annotations

import re
from collections import deque

from amp_studio.schema import visible
from amp_studio.transfer import (
    CancelledError,
    ControlSilentError,
    NoConnectionError,
    OpenLink,
    ProtocolMismatchError,
    Recognised,
    TransferError,
    Waiting,
)
from amp_studio.transfer.links import LinkError

from .states import SUSPENDED, state_in, state_text

ERASE = b"\x7f" * 260 + b"$AMP\n\n"
"""More DEL than a line of the firmware is long, and a command that it refuses: its error is the answer to
this and not to what another client has asked. A Grbl 1.1 takes the DEL for too long a line,
which it refuses as well.

The empty line is answered ``ok``: until one is taken, a grblHAL that has refused a line refuses all G-code
(protocol.c), that of a program on another line too.
"""

_SLICE = 0.05  # seconds a read may last between two looks at the cancel event
START = 12.0  # seconds a control that has just been connected may take to answer: an Arduino restarts
_AGAIN = 2.5  # seconds after which the first line is sent once more: a boot loader has swallowed it
# seconds after which a control that is still reading the first line is asked for its state again: it is no
# silence
_ASK = 1.0
_QUIET = 0.15  # seconds without a byte after which nothing more comes of what was asked before
_ANSWER = 8.0  # seconds without a byte of an answer
_ANSWER_ENDS = 60.0  # seconds for the whole answer
STOP_GRACE = 0.15  # seconds a command that writes is seen through after a stop was asked for
_LONGEST_LINE = 8_192  # bytes
_LONGEST_ANSWER = 1 << 20  # bytes
_MESSAGES = 100  # pushed lines that are remembered

_GREETING = re.compile(r"Grbl(HAL)? ", re.IGNORECASE)
_ERROR = re.compile(r"error:(\d{1,3})")
_ALARM = re.compile(r"ALARM:(\d{1,3})")


RECOGNISED = Recognised("grbl", b"?", re.compile(rb"<[A-Z][A-Za-z:0-9]*\||^Grbl", re.MULTILINE))
"""A status request acts on nothing, and every Grbl answers it at once, whatever it does."""


class GrblRefusalError(Exception):
    """The control has answered ``error:N``."""

    def __init__(self, code: int, command: str) -> None:
        super().__init__(f"error:{code}")
        self.code, self.command = code, command


class GrblRestartedError(OSError):
    """The control has restarted while an answer was waited for."""


class ControlSuspendedError(TransferError):
    """The control reads no line until a person goes on at the machine."""

    def __init__(self, state: str) -> None:
        super().__init__(f"the control is in the state {state}: {state_text(state)}")


class GrblLine:
    """One open line to a control; obeys whom ``waiting`` serves.

    ``messages`` are the texts of ``[MSG:…]`` that came unasked, ``alarm`` the number of the last alarm;
    ``has_lost_memory`` whether the control has reported that it could not read its settings
    and begins with the defaults (``error:7``).
    """

    def __init__(self, open_link: OpenLink, waiting: Waiting) -> None:
        self._waiting = waiting
        self.messages: list[str] = []
        self.alarm: int | None = None
        self.has_lost_memory = False
        self._clock, self._sleep = waiting.now, waiting.sleep
        self._buffer = b""
        self._lines: deque[str] = deque()
        self._suspended = ""  # the state in which it reports itself and reads no line
        # refusals and ``ok`` of first lines that may still come, before any other answer
        self._pending = self._pending_oks = 0
        # Opening is bounded too: a port that opens and never answers would be waited for without an end.
        self._begin(START, finishes=False)
        try:
            self._link = open_link(self.look)
        except LinkError as error:
            raise NoConnectionError(f"no connection to the control ({error})") from None
        try:
            self._erase()
        except BaseException:
            self.close()
            raise

    def wait(self, seconds: float) -> None:
        """Wait; raises CancelledError."""
        self._begin(seconds + _ANSWER, finishes=False)
        end = self._clock() + seconds
        while (left := end - self._clock()) > 0:
            self.look()
            self._sleep(min(left, _SLICE))

    def close(self) -> None:
        """Close the line."""
        self._link.close()

    def check_cancel(self) -> None:
        """Raise CancelledError where a stop was asked for before anything more is sent."""
        self._begin(_ANSWER_ENDS, finishes=False)
        self.look()

    def ask(self, command: str, *, writes: bool = False) -> list[str]:
        """Send a command and return the lines of its answer, without ``ok``.

        With ``writes`` the answer is waited for a moment even after a stop was asked for. Raises
        ControlSuspendedError, GrblRefusalError, GrblRestartedError, LinkError, ControlSilentError,
        ProtocolMismatchError, CancelledError.
        """
        self.check_cancel()
        if self._suspended:
            self._erase()  # it may read lines again
        if self._suspended:
            raise ControlSuspendedError(self._suspended)
        self._begin(_ANSWER_ENDS, finishes=writes)
        self._link.write(command.encode() + b"\n")
        answer: list[str] = []
        size = 0
        while True:
            line = self._line(_ANSWER)
            if line == "ok" and self._pending_oks and not answer:
                self._pending_oks -= 1
                continue
            if line == "ok":
                self._waiting.note_answer()
                # Answers to first lines come before any other: none is owed any more.
                self._pending = self._pending_oks = 0
                return answer
            # error:7 answers no command: the firmware prints it at its start, when its memory could not
            # be read.
            found = None if self._lost_memory(line) else _ERROR.fullmatch(line)
            # A first line that was sent twice, for a boot loader, is refused twice: the second refusal
            # may come this late.
            if found and self._pending and not answer:
                self._pending -= 1
                continue
            if found:
                self._waiting.note_answer()
                raise GrblRefusalError(int(found[1]), command)
            if _GREETING.match(line):
                raise GrblRestartedError("the control has restarted meanwhile")
            if self._is_pushed(line) or self._lost_memory(line):
                continue
            answer.append(line)
            size += len(line) + 2
            # A line without ``ok``, as of another program, would fill the memory.
            if size > _LONGEST_ANSWER:
                raise ProtocolMismatchError("the control answers without an end")

    def state(self) -> str:
        """Return the state that the control reports: Idle, Run, Hold, Alarm …; raises as ``ask``."""
        return state_in(self.report())

    def report(self) -> str:
        """Return the whole report of its state, as ``?`` brings it; raises as ``ask``."""
        self.check_cancel()
        self._begin(_ANSWER, finishes=False)
        self._link.write(b"?")
        while True:
            line = self._line(_ANSWER)
            if line.startswith("<"):
                self._waiting.note_answer()
                return line
            if _GREETING.match(line):
                raise GrblRestartedError("the control has restarted meanwhile")
            self._is_pushed(line)

    # -- lines ---------------------------------------------------------------------------------------

    def _erase(self) -> None:
        """Erase what a lost client may have left of a line,
        and read all that is still to come of earlier commands.
        """
        self._begin(START, finishes=False)
        self._link.write(b"?")
        first = self._next(_ASK, self._clock()) or ""
        self._is_refusal(first)
        self._notice(state_in(first))
        sent, refused = self._send_first_line()
        more, oks = self._answers_until_quiet()
        self._buffer = b""
        # Every first line is refused once and answered ``ok`` once; what was not seen yet is on its way.
        self._pending, self._pending_oks = max(0, sent - refused - more), max(0, sent - oks)
        self._waiting.note_answer()

    def _send_first_line(self) -> tuple[int, int]:
        """Send the first line until it is refused; returns how often it was sent, and refused:
        not at all where the control has stopped.
        """
        # So that the first line is sent at once.
        sent, sent_at, asked_at, refused = 0, -_AGAIN, 0.0, 0
        is_alive = False  # it reports its state: no boot loader has swallowed the first line
        while not refused and not self._suspended:
            now = self._clock()
            # A control that reports its state has the line and only needs time; one that is silent has
            # lost it to a boot loader.
            again, pause = (START, _ASK) if is_alive else (_AGAIN, _AGAIN)
            if now - sent_at >= again:
                self._link.write(b"?" + ERASE)  # the state is reported at once, even where no line is read
                sent, sent_at, asked_at = sent + 1, now, now
            elif is_alive and now - asked_at >= _ASK:
                self._link.write(b"?")
                asked_at = now
            line = self._next(pause, asked_at)
            if line is not None and (state := state_in(line)):
                self._notice(state)
                is_alive = True
            refused += line is not None and self._is_refusal(line)
        return sent, refused

    def _answers_until_quiet(self) -> tuple[int, int]:
        """Read until nothing more comes; returns how many lines of it refuse a command and how many are
        ``ok``.
        """
        refused, oks, quiet_since = 0, 0, self._clock()
        while self._clock() - quiet_since < _QUIET:
            self.look()
            if data := self._link.read(_SLICE):
                self._split_lines(data)
                quiet_since = self._clock()
            while self._lines:
                line = self._lines.popleft()
                refused, oks = refused + self._is_refusal(line), oks + (line == "ok")
        return refused, oks

    def _notice(self, state: str) -> None:
        """Notice a state without lines: lines sent then would pile up until the operator resumes."""
        self._suspended = state if state in SUSPENDED else ""

    def _is_refusal(self, line: str) -> bool:
        """Return whether a line refuses a command; remembers what came unasked."""
        self._is_pushed(line)
        return not self._lost_memory(line) and _ERROR.fullmatch(line) is not None

    def _next(self, seconds: float, since: float) -> str | None:
        """Return the next line, None after so many seconds since a time."""
        while not self._lines:
            self.look()
            if self._clock() - since >= seconds:
                return None
            self._split_lines(self._link.read(_SLICE))
        return self._lines.popleft()

    def _line(self, patience: float) -> str:
        """Return the next line; raises ControlSilentError where no byte has come for so many seconds."""
        received_at = self._clock()
        while not self._lines:
            self.look()
            if data := self._link.read(_SLICE):
                self._split_lines(data)
                received_at = self._clock()
            elif self._clock() - received_at >= patience:
                raise ControlSilentError(f"the control has not answered for {patience:g} s")
        return self._lines.popleft()

    def _split_lines(self, data: bytes) -> None:
        """Part what has come into lines; empty ones mean nothing."""
        if data:
            self._waiting.note_answer()
        *lines, self._buffer = (self._buffer + data).split(b"\n")
        # Bounded: at a wrong baud rate everything is one line without an end.
        if len(self._buffer) > _LONGEST_LINE or any(len(line) > _LONGEST_LINE for line in lines):
            raise ProtocolMismatchError("the control sends a line without an end")
        # Replaced, not refused: a damaged byte is found by reading twice (``reading``).
        texts = (line.strip(b"\r\0").decode("utf-8", errors="replace") for line in lines)
        self._lines.extend(text for text in texts if text.strip())

    def _lost_memory(self, line: str) -> bool:
        """Notice ``error:7``: it comes of a start, before the greeting, and answers nothing."""
        self.has_lost_memory |= line == "error:7"
        return line == "error:7"

    def _is_pushed(self, line: str) -> bool:
        """Remember what came unasked; returns whether this line did."""
        if line.startswith("[MSG:"):
            self.messages = [*self.messages[-_MESSAGES:], visible(line[5:].removesuffix("]"))[:200]]
            return True
        if match := _ALARM.fullmatch(line):
            self.alarm = int(match[1])
            return True
        # A status report that another sender has asked for.
        return line.startswith("<")

    # -- patience ------------------------------------------------------------------------------------

    def _begin(self, seconds: float, *, finishes: bool) -> None:
        self._until = self._clock() + seconds
        self._finishes = finishes
        self._stopped_at: float | None = None
        self._waiting.note_answer()

    def look(self) -> None:
        """Be called by everything that waits, at least every 0.1 s; raises CancelledError,
        ControlSilentError.
        """
        now = self._clock()
        try:
            self._waiting.look()
        except CancelledError:
            self._stopped_at = now if self._stopped_at is None else self._stopped_at
            # A setting that is under way gets its answer, so that it is known whether it was taken.
            if not self._finishes or now - self._stopped_at >= STOP_GRACE:
                raise
        if now >= self._until:
            raise ControlSilentError("the control has not finished its answer in time")
