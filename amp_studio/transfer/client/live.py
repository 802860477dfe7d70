"""Values changed in a control that is connected, one after the other, and put back if they are not to stay.

The parameter file is not touched: what is changed is what the control contains. Everything goes through a download of the
driver, so each change is read back, an error names what the control contains then, and what it contained at first is kept.
"""

from __future__ import annotations

import hashlib
import threading
from collections.abc import Callable, Mapping
from pathlib import Path

from amp_studio.files import Comparison, Notify, ParameterFile, compare
from amp_studio.schema import Address, Value
from amp_studio.transfer.content import decode_content
from amp_studio.transfer.driver import ControlDriver, TakesLiveValues
from amp_studio.transfer.errors import ImageChangedError, TransferError
from amp_studio.transfer.progress import Progress, quiet

from .exchange import Outcome, download, look_at
from .kept import keep_image
from .record import Recording, check_whole


class LiveTuning:
    """One control, from the first look until it is closed. Belongs to one thread at a time."""

    def __init__(
        self,
        driver: ControlDriver,
        folder: Path,
        stem: str,
        *,
        address: str = "",
        record: Path | None = None,
        notify: Notify = lambda _: None,
    ) -> None:
        self._driver, self._folder, self._stem = driver, folder, stem
        self._address, self._record, self._notify = address, record, notify
        self._kept = ""
        self._start = b""
        self._held = b""
        self.file: ParameterFile | None = None
        """What the control contains, as it was last read; None before, and after an error until it was read again."""
        self.start_file: ParameterFile | None = None
        """What it contained at the first look."""

    @property
    def is_live(self) -> bool:
        """Whether single values go into the control while it is at work; else each change is a download of everything."""
        return isinstance(self._driver, TakesLiveValues)

    def look(self, progress: Progress = quiet, cancel: threading.Event | None = None) -> ParameterFile:
        """Read what the control contains, the first time or after an error; raises TransferError, ImageError."""
        _, content, _ = look_at(self._driver, progress, cancel)
        self._held, self.file = content, decode_content(content)
        if self.start_file is None:
            self._start, self.start_file = content, self.file.copy()
        return self.file

    def set(
        self,
        values: Mapping[Address, Value | None],
        progress: Progress = quiet,
        cancel: threading.Event | None = None,
    ) -> Outcome:
        """Change values in the control and read them back; raises RangeError, ImageError and TransferError."""
        wanted = self._present().copy()
        wanted.set_many(values)
        return self._send(lambda held: self._driver.encode(wanted, held), "tune", progress, cancel)

    def put_back(self, progress: Progress = quiet, cancel: threading.Event | None = None) -> Outcome:
        """Have the control contain again what it contained at the first look; raises as ``set``."""
        return self._send(lambda held: self._driver.refit(self._start, held), "restore", progress, cancel)

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

    def _send(
        self, make: Callable[[bytes], bytes], verb: str, progress: Progress, cancel: threading.Event | None
    ) -> Outcome:
        present = self._present()
        family = present.schema.family.family
        recording = Recording(verb, self._record, family, self._address, make, self._notify)
        self.file = None  # whatever happens now: it is read again before anybody relies on it
        try:
            outcome = recording.run(
                lambda: download(
                    self._driver, recording.wanted, self._keep, signature=present.schema.signature,
                    expected=hashlib.sha256(self._held).digest(), known=self._held,
                    what="Change", is_return=verb == "restore", progress=progress, cancel=cancel)
            )  # fmt: skip
        except TransferError as error:
            if error.at_control == "old" and not isinstance(error, ImageChangedError):
                self.file = present
            raise
        try:
            self.look(progress, cancel)
        except TransferError as error:
            error.at_control, error.kept = outcome.at_control, outcome.kept
            raise
        return outcome

    def _keep(self, content: bytes) -> str:
        """Keep what the control contained at the first look; later contents are those of this session."""
        if not self._kept:
            check_whole(self._driver, content, self._record, self._address, self._folder)
            self._kept = str(keep_image(content, self._folder, self._stem))
        return self._kept
