"""The terminal of an ACR card as a line to it: a command is typed, its echo compared,
and only then obeyed (page 91).

A line that was damaged on its way is therefore never obeyed,
and half a line that was left is taken away first.
"""

from __future__ import annotations

import contextlib
import re
from collections.abc import Callable, Iterator

from amp_studio.transfer import (
    CancelledError,
    ConnectionCutError,
    ControlSilentError,
    NoConnectionError,
    OpenLink,
    ProtocolMismatchError,
    Waiting,
)
from amp_studio.transfer.links import Link, LinkError

_LONGEST = 160  # characters of half a line that may be left
_TRIES = 8  # of one line
_ECHO_WAIT = 1.5  # seconds until the echo of a line begins
_ECHO_GAP = 0.4  # seconds between two characters of an echo: one that was lost does not come any more
_PROMPT_WAIT = 1.5  # seconds until the prompt comes back
_ANSWER_WAIT = (
    20.0  # seconds an answer may take that goes on; a table of 1,000 positions takes 13 at 9600 bit/s
)
_QUIET = 0.06  # seconds without a sign after which a line that was cleared is quiet
_MAX_LATE_PIECES = 100  # pieces that may come behind the prompt of a line that was cleared
_PATIENCE = 20.0  # seconds for which a line that is cut is made again
PAUSE = 0.3
_GRACE = 0.2  # seconds a setting that is under way may take on after a stop was asked for
LARGEST = 1 << 15  # bytes of an answer

_BACKSPACE = b"\b"
_SPOIL = b"Q)"
"""No figure ends so, and no command has a bracket that was not opened:
what is left of a line is not obeyed with it."""
_PROMPT = re.compile(rb"(?:^|[\r\n])P([0-9]{2})> ?$")


class _DamagedError(Exception):
    """What came is not what a card sends: the line is tried again."""


class Terminal:
    """One terminal; ``execute`` types a line and returns what the card shows before its next prompt."""

    def __init__(self, open_link: OpenLink, waiting: Waiting) -> None:
        self._open_link = open_link
        self._waiting = waiting
        self._link: Link | None = None
        self._is_clear = False
        self._sees_through = False
        self._stopped_at: float | None = None
        self.cuts = 0
        """How often the line has broken and was made again: a card may have lost its power then."""
        self.faults = 0
        """How often something has come otherwise than a card sends it."""
        self.program = ""
        """Of the last prompt: ``00``."""

    def close(self) -> None:
        """Close the line."""
        if self._link is not None:
            self._link.close()
            self._link = None
        self._is_clear = False

    def execute(
        self, line: str, seconds: float = _PROMPT_WAIT, sent: Callable[[], None] = lambda: None
    ) -> list[str]:
        """Have the card obey a line, in at most so many seconds; raises TransferError.

        ``sent`` is called before the character that has the line obeyed goes out. It may go out again after a
        fault, so that only commands are sent whose repetition changes nothing.
        """
        self.look()
        fault = ""
        for _ in range(_TRIES):
            try:
                link = self._line()
                rows = self._typed(link, line.encode("ascii"), seconds, sent)
            except LinkError as error:
                self._make_again()
                fault = error.what
                continue
            except _DamagedError as error:
                self._is_clear, fault = False, str(error)
                self.faults += 1
                continue
            # Only a whole answer counts as heard: noise must not keep a dead line alive.
            self._waiting.note_answer()
            return rows
        raise ControlSilentError(f"the card does not take '{line}': {fault or 'the line breaks each time'}")

    @contextlib.contextmanager
    def seen_through(self) -> Iterator[None]:
        """See commands through, if they do not take long, before a stop that was asked for is obeyed."""
        self._sees_through, self._stopped_at = True, None
        try:
            yield
        finally:
            self._sees_through = False

    def look(self) -> None:
        """Be called while something waits; raises CancelledError where a stop was asked for."""
        if self._sees_through and self._waiting.is_stopped:
            self._stopped_at = self._stopped_at or self._waiting.now()
            if self._waiting.now() - self._stopped_at <= _GRACE:
                return
        self._waiting.look()

    # -- one try ----------------------------------------------------------------------------------

    def _type(self, link: Link, line: bytes) -> None:
        """Type a line and compare its echo; it is not obeyed before its end is sent."""
        if not self._is_clear:
            self._clear(link)
        try:
            link.write(line)
            echo = self._read_until(link, lambda got: len(got) >= len(line), _ECHO_WAIT, gap=_ECHO_GAP)
            if echo != line:
                raise _DamagedError("its echo is another" if echo else "there is no echo")
        except CancelledError:
            self._is_clear = False
            with contextlib.suppress(LinkError):
                # The next line of another program is not to be glued to this one.
                link.write(_BACKSPACE * len(line))
            raise
        except BaseException:
            self._is_clear = False  # the next one takes away what is there of the line
            raise

    def _typed(self, link: Link, line: bytes, seconds: float, sent: Callable[[], None]) -> list[str]:
        """Type a line, compare its echo and have it obeyed; returns the rows of its answer.
        Raises _DamagedError for what is to be tried again.
        """
        self._type(link, line)
        # From here on the card may have obeyed, whatever comes back.
        sent()
        self._is_clear = False
        link.write(b"\r")
        # The prompt is at the end: eight characters are enough to look in, however long a table is.
        answer = self._read_until(
            link, lambda got: _PROMPT.search(got[-8:]) is not None, seconds, gap=seconds
        )
        match = _PROMPT.search(answer)
        # Behind the carriage return a card begins a new line; anything else is left of an earlier answer.
        if match is None or not answer.startswith((b"\r", b"\n")):
            raise _DamagedError("there is no prompt behind its answer")
        self._is_clear = True
        self.program = match[1].decode()
        rows = answer[: match.start()].decode("latin-1")
        if re.search(r"[^\r\n -~]", rows):
            raise _DamagedError("its answer is damaged")
        return [row.strip() for row in re.split("[\r\n]+", rows) if row.strip()]

    def _clear(self, link: Link) -> None:
        """Take half a line away, or spoil it where the card knows no backspace, and wait for a prompt."""
        # The carriage return is needed for a prompt, and would obey what is left of the line: it is
        # erased, and spoiled in case it is not.
        link.write(_BACKSPACE * _LONGEST + _SPOIL + b"\r")
        got = self._read_until(link, lambda got: _PROMPT.search(got) is not None, _PROMPT_WAIT, keep=64)
        if not got:
            raise _DamagedError("the card does not answer")
        # A card echoes what it has been sent and falls silent: an end without an end is another
        # machine.
        if all(self._read_until(link, bool, _QUIET, keep=1) for _ in range(_MAX_LATE_PIECES)):
            raise ProtocolMismatchError("this is no ACR card: it sends without an end")
        if not re.search(rb"P[0-9]{2}>", got):
            raise _DamagedError("there is no prompt as an ACR card has")
        self._is_clear = True

    def _read_until(
        self,
        link: Link,
        is_enough: Callable[[bytes], bool],
        seconds: float,
        *,
        keep: int = 0,
        gap: float | None = None,
    ) -> bytes:
        """Return what has come once it is enough or the time is over,
        or nothing has followed it for ``gap`` seconds.

        Of what is only looked through, ``keep`` bytes stay.
        """
        got, count = b"", 0
        end = self._waiting.now() + seconds
        latest = end + _ANSWER_WAIT
        while not is_enough(got):
            left = end - self._waiting.now()
            if left <= 0:
                break
            self.look()
            data = link.read(min(left, _QUIET))
            got, count = got + data, count + len(data)
            # Each byte earns another gap, up to the longest answer: a slow line is no silent one.
            if data and gap is not None:
                end = min(self._waiting.now() + gap, latest)
            if count > LARGEST:
                raise ProtocolMismatchError("this is no ACR card: it sends without an end")
            if keep:
                got = got[-keep:]
        return got

    # -- the line ---------------------------------------------------------------------------------

    def _line(self) -> Link:
        """Return the connection to the card, opened where there is none."""
        if self._link is None:
            try:
                self._link = self._open_link(self.look)
            except LinkError as error:
                if self.cuts:
                    raise
                # A first line that cannot be made is a wrong address; a later one is tried again by the
                # caller.
                raise NoConnectionError(f"no connection to the card: {error}") from None
            self._is_clear = False
        return self._link

    def _make_again(self) -> None:
        """Make a line again that has broken, within _PATIENCE; raises ConnectionCutError."""
        self.close()
        self.cuts += 1
        began = self._waiting.now()
        while True:
            self._pause(PAUSE)
            try:
                self._line()
            except LinkError as again:
                if self._waiting.now() - began > _PATIENCE:
                    raise ConnectionCutError(f"the line broke: {again.what}") from None
            else:
                return

    def _pause(self, seconds: float) -> None:
        end = self._waiting.now() + seconds
        while (left := end - self._waiting.now()) > 0:
            self.look()
            self._waiting.sleep(min(left, 0.1))
