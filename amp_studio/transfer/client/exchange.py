"""The verbs between a file and a control, over any driver: download, upload, restore.

Words as the manuals use them: a download goes from here to the control, an upload from the control to here. A
restore is the download of what a control has contained.
"""

from __future__ import annotations

import contextlib
import hashlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

from amp_studio.transfer.driver import (
    ControlDriver,
    ControlIdentity,
    ReadsBackPartly,
    Receipt,
    RestartsItself,
)
from amp_studio.transfer.errors import (
    AT_CONTROL_TEXT,
    AtControl,
    CancelledError,
    ImageChangedError,
    KeepFailedError,
    NotInEmergencyStopError,
    SignatureMismatchError,
    TransferError,
    unforeseen,
)
from amp_studio.transfer.exchange import QUIET, Exchange, Replacement

RESTART_WAIT = 60.0  # seconds a control may take to come back
RestartState = Literal["not needed", "done", "needed", "missed"]

Keep = Callable[[bytes], str]
"""Keeps what a control contains and returns where; nothing is replaced where it raises."""


@dataclass(frozen=True)
class WantedContent:
    """What is to be put into a control.

    ``content``    its bytes, or what makes them of those that the control contains; raises ImageError
    ``signature``  of the schema under which it was made
    ``expected``   the SHA-256 of what may be replaced; None for whatever is there
    ``known``      was fetched from this control before: it is not fetched again if the control states its
                   digest, as it must
                   for the commit too
    ``is_return``  the control has contained it before: one that remembers what it contained decides by itself
                   whether it takes it
    ``what``       the first word of the result
    """

    content: bytes | Callable[[bytes], bytes]
    signature: str
    expected: bytes | None = None
    known: bytes | None = None
    is_return: bool = False
    what: str = "Download"

    def of(self, current: bytes) -> bytes:
        """Return what a control that contains ``current`` shall contain; raises ImageError."""
        return self.content(current) if callable(self.content) else self.content


@dataclass(frozen=True)
class Outcome:
    """How a download ended.

    ``at_control``  what the control contains now: the "old" content, the "new" one, "mixed", or "unknown"
    ``verified``    whether the new content was read back and is equal: all of it, or on a slow line its
                    digest and some of it
    ``written``     whether the control had to take anything
    ``kept``        where the image before it is kept, byte for byte; None when nothing was replaced or it was
                    empty
    ``restart``     "not needed"; "done" (the image is current); "needed" (by hand); "missed" (not come back)
    ``sha256``      of the image, in hexadecimal
    ``text``        all of it in one sentence or two
    ``content``     what was read back; empty where it was not
    """

    at_control: AtControl
    verified: bool
    written: bool
    kept: str | None
    restart: RestartState
    sha256: str
    text: str
    content: bytes = b""


def upload(driver: ControlDriver, exchange: Exchange = QUIET) -> bytes:
    """Return the image the control contains; raises TransferError."""
    with _only_looking():
        driver.identify(exchange)
        return driver.fetch(exchange)


def look_at(driver: ControlDriver, exchange: Exchange = QUIET) -> tuple[ControlIdentity, bytes, str]:
    """Return who the control is, what it contains, and the SHA-256 of that in hexadecimal;
    raises TransferError.
    """
    with _only_looking():
        control = driver.identify(exchange)
        content = driver.fetch(exchange)
    return control, content, hashlib.sha256(content).hexdigest()


@contextlib.contextmanager
def _only_looking() -> Iterator[None]:
    """Leave out of an error what the control contains: who only looks replaces nothing,
    and an earlier download may have.
    """
    try:
        yield
    except TransferError as error:
        error.at_control = ""
        raise


def download(
    driver: ControlDriver,
    wanted: WantedContent,
    keep: Keep,
    exchange: Exchange = QUIET,
    *,
    meanwhile: Callable[[], None] = lambda: None,
    restart_wait: float = RESTART_WAIT,
) -> Outcome:
    """Put a content into a control, and prove it.

    Fetches what the control contains, of which ``wanted`` makes what it shall contain, and hands it to
    ``keep`` before anything is replaced; when one of them raises, nothing is written. Then sends, waits up to
    ``restart_wait`` seconds for the restart, reads everything back and compares. ``meanwhile`` is done while
    the control restarts. Raises TransferError, whose
    ``at_control`` and ``kept`` give what the control contains and where its old image is.
    """
    if not driver.abilities.can_send:
        raise TransferError("nothing can be downloaded over this protocol")
    control = driver.identify(exchange)
    old = _replaceable(driver, control, wanted, exchange)
    content = wanted.of(old)
    if content == old:
        return _nothing_to_do(control, content)
    if control.notice:
        exchange.notify(control.notice)
    # From here on the old content may be lost: not a byte goes out before its copy is on the disk.
    kept = _keep(keep, old) if old else None
    try:
        receipt = driver.send(Replacement(content, old, wanted.signature), exchange)
    except TransferError as error:
        error.kept = kept
        raise
    proof = _Proof(driver, content, old, receipt, kept, wanted.what)
    try:
        if receipt.restarting:
            meanwhile()
        return proof.outcome(exchange, restart_wait)
    except TransferError as error:
        # Without a commit, what was taken last may not have reached the memory of a control that is gone.
        is_new = driver.abilities.all_or_nothing or (
            receipt.is_answered and isinstance(error, CancelledError)
        )
        error.at_control, error.kept = "new" if is_new else "unknown", kept
        raise
    except KeyboardInterrupt:
        raise CancelledError("stopped", proof.at_control, kept) from None
    except Exception as error:  # no memory, no handle: the commit has happened anyway
        raise TransferError(f"it was not read back ({unforeseen(error)})", proof.at_control, kept) from error


def _replaceable(
    driver: ControlDriver, control: ControlIdentity, wanted: WantedContent, exchange: Exchange
) -> bytes:
    """Return what the control contains, after everything that forbids to replace it."""
    if not (driver.abilities.maps_numbers or (wanted.is_return and driver.abilities.remembers)):
        _check_signature(control, wanted.signature)
    _check_expected(wanted.expected, control.sha256)
    _check_stop(control, wanted)
    # The preview has just fetched it; where the control states its digest a slow line need not carry it
    # again.
    is_known = wanted.known is not None and control.sha256 == hashlib.sha256(wanted.known).digest()
    old = wanted.known if wanted.known is not None and is_known else driver.fetch(exchange, "keep")
    _check_expected(wanted.expected, hashlib.sha256(old).digest())
    return old


def short(digest: bytes) -> str:
    """Return the beginning of a digest, enough for a person to distinguish two."""
    return digest.hex()[:12]


def _check_signature(control: ControlIdentity, signature: str) -> None:
    if control.signature != signature:
        raise SignatureMismatchError(
            f"the control '{control.name}' (revision {control.revision}) numbers its parameters "
            "by another schema"
        )


def _check_expected(expected: bytes | None, found: bytes | None) -> None:
    if expected is not None and found is not None and expected != found:
        raise ImageChangedError(
            "the control contains something else than what was approved to be replaced "
            f"(sha256 {short(found)}…, approved {short(expected)}…)"
        )


def _check_stop(control: ControlIdentity, wanted: WantedContent) -> None:
    """Ask for E-stop before anything is moved; an image that is there already needs none."""
    if control.in_estop is False and control.sha256 != hashlib.sha256(wanted.of(b"")).digest():
        raise NotInEmergencyStopError("please place the control in E-stop to download")


def _nothing_to_do(control: ControlIdentity, content: bytes) -> Outcome:
    waiting = control.restart_needed
    text = "The control contains exactly this image already; nothing was written."
    if waiting:
        text += " Restart the control to make it current."
    restart: RestartState = "needed" if waiting else "not needed"
    return Outcome("new", True, False, None, restart, hashlib.sha256(content).hexdigest(), text, content)


def _keep(keep: Keep, old: bytes) -> str:
    try:
        return keep(old)
    except Exception as error:  # whatever goes wrong there, the old image is not kept
        message = str(error)
        if isinstance(error, OSError) and error.filename and error.strerror:
            message = f"{error.filename}: {error.strerror}"
        raise KeepFailedError(f"what the control contains could not be kept ({message})") from error


_RESTART_TEXT = {
    "done": "; the control has restarted with it.",
    "needed": ". Restart the control to make it current.",
    "not needed": ".",
}


@dataclass(frozen=True)
class _Proof:
    """A download that the control has taken: ``content`` in the place of ``old``, which is ``kept``;
    ``what`` was done.
    """

    driver: ControlDriver
    content: bytes
    old: bytes
    receipt: Receipt
    kept: str | None
    what: str

    @property
    def at_control(self) -> AtControl:
        """What the control contains as long as it was not read back."""
        return "new" if self.receipt.is_answered else "unknown"

    def outcome(self, exchange: Exchange, restart_wait: float) -> Outcome:
        """Wait for the restart, read back, compare; raises TransferError."""
        restart: RestartState = "needed" if self.receipt.restart_needed else "not needed"
        if self.receipt.restarting and isinstance(self.driver, RestartsItself):
            if not self.driver.wait_restarted(self.receipt, restart_wait, exchange):
                text = f"{self.what} complete, but the control has not come back from its restart "
                text += f"within {restart_wait:g} s."
                return self._ended("new", "missed", text + self._before())
            restart = "done"
        fetched = self.driver.fetch(exchange, "verify")
        if where := self.driver.difference(self.content, fetched):
            return self._differs(where, fetched, restart)
        partly = self.driver.read_back if isinstance(self.driver, ReadsBackPartly) else ""
        proof = f"complete: {partly}" if partly else "complete and read back equal"
        text = f"{self.what} {proof}{_RESTART_TEXT[restart]}"
        return self._ended("new", restart, text + self._before(), fetched, is_verified=True)

    def _differs(self, where: str, fetched: bytes, restart: RestartState) -> Outcome:
        """Return the outcome of a download after which the control contains something else."""
        is_whole = self.driver.abilities.all_or_nothing
        # A control that commits all or nothing has answered that it did: the old content then is a
        # contradiction.
        if fetched == self.old and not is_whole:
            text = f"The control has taken nothing of it: {AT_CONTROL_TEXT['old']}."
            return self._ended("old", restart, text, fetched)
        rest = AT_CONTROL_TEXT["unknown"] if is_whole else "the rest is as it was sent"
        text = f"The control took the image, but what it contains differs {where}; {rest}."
        state: AtControl = "unknown" if is_whole else "mixed"
        return self._ended(state, restart, text + self._before(), fetched)

    def _before(self) -> str:
        """Return what the user has to know, and where the old content is."""
        before = f"What it contained before is kept in {self.kept}." if self.kept else "It was empty before."
        return "".join(f" {text}" for text in (*self.receipt.notes, before))

    def _ended(
        self,
        state: AtControl,
        restart: RestartState,
        text: str,
        fetched: bytes = b"",
        *,
        is_verified: bool = False,
    ) -> Outcome:
        """Return the outcome of a download that has reached the control."""
        digest = hashlib.sha256(self.content).hexdigest()
        return Outcome(state, is_verified, True, self.kept, restart, digest, text, fetched)
