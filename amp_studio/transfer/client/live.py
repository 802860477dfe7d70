"""Values changed in a control that is connected, one after the other, and put back if they are not to stay.

The parameter file is not touched: what is changed is what the control contains. Everything goes through a
download of the driver, so each change is read back, an error names what the control contains then,
and what it contained at first is kept.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

from amp_studio.files import Comparison, ParameterFile, compare
from amp_studio.schema import Address, Value
from amp_studio.transfer.content import decode_content
from amp_studio.transfer.driver import ControlDriver, TakesLiveValues
from amp_studio.transfer.errors import ImageChangedError, TransferError
from amp_studio.transfer.exchange import QUIET, Exchange

from .exchange import Outcome, WantedContent, look_at
from .kept import keep_image
from .recording import Recording


class LiveTuning:
    """One control, from the first look until it is closed. Belongs to one thread at a time."""

    def __init__(
        self, driver: ControlDriver, keep: Path, *, address: str = "", record: Path | None = None
    ) -> None:
        """``keep`` and ``record`` are as those of an exchange, and hold for all of this session."""
        self._driver, self._place = driver, keep
        self._address, self._record = address, record
        self.path = record or keep
        """The parameter file that belongs to the control."""
        self._backup = ""
        self._start = b""
        self._current = b""
        self.file: ParameterFile | None = None
        """What the control contains, as it was last read; None before,
        and after an error until it was read again."""
        self.start_file: ParameterFile | None = None
        """What it contained at the first look."""

    @property
    def is_live(self) -> bool:
        """Whether single values go into the control while it is at work;
        else each change is a download of everything.
        """
        return isinstance(self._driver, TakesLiveValues)

    def look(self, exchange: Exchange = QUIET) -> ParameterFile:
        """Read what the control contains, the first time or after an error; raises TransferError,
        ImageError.
        """
        _, content, _ = look_at(self._driver, exchange)
        self._current, self.file = content, decode_content(content)
        if self.start_file is None:
            self._start, self.start_file = content, self.file.copy()
        return self.file

    def set(self, values: Mapping[Address, Value | None], exchange: Exchange = QUIET) -> Outcome:
        """Change values in the control and read them back; raises RangeError, ImageError and
        TransferError.
        """
        wanted = self._present().copy()
        wanted.set_checked(values)
        return self._send(lambda current: self._driver.encode(wanted, current), "tune", exchange)

    def put_back(self, exchange: Exchange = QUIET) -> Outcome:
        """Have the control contain again what it contained at the first look; raises as ``set``."""
        return self._send(lambda current: self._driver.refit(self._start, current), "restore", exchange)

    @property
    def content(self) -> bytes:
        """What the control contains, as it was last read."""
        return self._current

    def changes(self) -> Comparison:
        """Return what differs in the control from the first look, as it was last read."""
        present, start = self._present(), self.start_file
        assert start is not None
        return compare(present.schema, start.values, present.values)

    def close(self) -> None:
        """Hang up; the control keeps what it contains."""
        self._driver.close()

    def _present(self) -> ParameterFile:
        if self.file is None:
            raise TransferError("what the control contains is not known: read it again", "unknown")
        return self.file

    def _send(self, make: Callable[[bytes], bytes], verb: str, exchange: Exchange) -> Outcome:
        present = self._present()
        recording = Recording(
            verb, present.schema.family.family, self._address, replace(exchange, record=self._record)
        )
        wanted = WantedContent(
            make,
            present.schema.signature,
            expected=hashlib.sha256(self._current).digest(),
            known=self._current,
            is_return=verb == "restore",
            what="Change",
        )
        self.file = None  # whatever happens now: it is read again before it is relied on
        try:
            outcome = recording.run(self._driver, wanted, lambda content: self._keep(recording, content))
        except TransferError as error:
            if error.at_control == "old" and not isinstance(error, ImageChangedError):
                self.file = present
            raise
        try:
            self.look(exchange)
        except TransferError as error:
            error.at_control, error.kept = outcome.at_control, outcome.kept
            raise
        return outcome

    def _keep(self, recording: Recording, content: bytes) -> str:
        """Keep what the control contained at the first look; later contents are those of this session."""
        if not self._backup:
            recording.check_whole(self._driver, content, self._place.parent)
            self._backup = str(keep_image(content, self._place.parent, self._place.stem))
        return self._backup
