"""The verbs between a file and a control, over any driver: download, upload, restore.

Words as the manuals use them: a download goes from here to the control, an
upload from the control to here. A restore is the download of what a control
has contained.
"""

from __future__ import annotations

import contextlib
import hashlib
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

from amp_studio.transfer.driver import ControlDriver, ControlIdentity, ReadsBackPartly, Receipt
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
from amp_studio.transfer.progress import Progress, quiet

RESTART_WAIT = 60.0  # seconds a control may take to come back

Keep = Callable[[bytes], str]
Wanted = Callable[[bytes], bytes]
"""What a control shall contain, of what it contains; raises ImageError."""


@dataclass(frozen=True)
class Outcome:
    """How a download ended.

    ``at_control``  what the control contains now: the "old" content, the "new" one, "mixed", or "unknown"
    ``verified``    whether the new content was read back and is equal: all of it, or on a slow line its digest and some of it
    ``written``     whether the control had to take anything
    ``kept``        where the image before it is kept, byte for byte; None when nothing was replaced or it was empty
    ``restart``     "not needed"; "done" (the image is current); "needed" (by hand); "missed" (not come back)
    ``sha256``      of the image, in hexadecimal
    ``text``        all of it in one sentence or two
    """

    at_control: AtControl
    verified: bool
    written: bool
    kept: str | None
    restart: Literal["not needed", "done", "needed", "missed"]
    sha256: str
    text: str


def upload(driver: ControlDriver, progress: Progress = quiet, cancel: threading.Event | None = None) -> bytes:
    """Return the image the control contains; raises TransferError."""
    with _only_looking():
        driver.identify(progress, cancel)
        return driver.fetch(progress, cancel)


def look_at(
    driver: ControlDriver, progress: Progress = quiet, cancel: threading.Event | None = None
) -> tuple[ControlIdentity, bytes, str]:
    """Return who the control is, what it contains, and the SHA-256 of that in hexadecimal; raises TransferError."""
    with _only_looking():
        control = driver.identify(progress, cancel)
        content = driver.fetch(progress, cancel)
    return control, content, hashlib.sha256(content).hexdigest()


@contextlib.contextmanager
def _only_looking() -> Iterator[None]:
    """Leave out of an error what the control contains: who only looks replaces nothing, and an earlier download may have."""
    try:
        yield
    except TransferError as error:
        error.at_control = ""
        raise


def download(
    driver: ControlDriver,
    wanted: bytes | Wanted,
    keep: Keep,
    *,
    signature: str,
    expected: bytes | None = None,
    known: bytes | None = None,
    is_return: bool = False,
    what: str = "Download",
    meanwhile: Callable[[], None] = lambda: None,
    progress: Progress = quiet,
    cancel: threading.Event | None = None,
    restart_wait: float = RESTART_WAIT,
) -> Outcome:
    """Put a content into a control, and prove it.

    Fetches what the control contains, of which ``wanted`` makes what it shall contain, and hands it to ``keep``, which
    returns where it has kept it, before anything is replaced; when one of them raises, nothing is written. Then sends,
    waits up to ``restart_wait`` seconds for the restart, reads everything back and compares. ``signature`` is the
    schema's under which the content was made. ``expected`` is the SHA-256 of what may be replaced; None
    for whatever is there. ``known`` was fetched from this control before: it is not fetched again if the control states
    its digest, as it must for the commit too. ``is_return`` means that the control has contained this image before: one that remembers
    what it contained decides by itself whether it takes it. ``what`` is the first word of the result. ``meanwhile`` is done while the control restarts. Raises TransferError, whose ``at_control`` and ``kept`` give what the control contains and
    where its old image is.
    """
    make: Wanted = wanted if callable(wanted) else lambda _: wanted
    if not driver.abilities.can_send:
        raise TransferError("nothing can be downloaded over this protocol")
    control = driver.identify(progress, cancel)
    if not (driver.abilities.maps_numbers or (is_return and driver.abilities.remembers)):
        _check_signature(control, signature)
    _check_expected(expected, control.sha256)
    _check_stop(control, make)
    is_known = known is not None and control.sha256 == hashlib.sha256(known).digest()
    old = known if known is not None and is_known else driver.fetch(progress, cancel, "keep")
    _check_expected(expected, hashlib.sha256(old).digest())
    content = make(old)
    if content == old:
        return _nothing_to_do(control, hashlib.sha256(content).hexdigest())
    kept = _keep(keep, old) if old else None
    try:
        receipt = driver.send(
            content,
            signature=signature,
            expected=hashlib.sha256(old).digest(),
            held=old,
            progress=progress,
            cancel=cancel,
        )
    except TransferError as error:
        error.kept = kept
        raise
    try:
        if receipt.restarting:
            meanwhile()
        return _prove(driver, content, old, receipt, kept, progress, cancel, restart_wait, what)
    except TransferError as error:
        # Without a commit, what was taken last may not have reached the memory of a control that is gone.
        is_new = driver.abilities.all_or_nothing or (
            receipt.is_answered and isinstance(error, CancelledError)
        )
        error.at_control, error.kept = "new" if is_new else "unknown", kept
        raise
    except KeyboardInterrupt:
        raise CancelledError("stopped", "new" if receipt.is_answered else "unknown", kept) from None
    except Exception as error:  # no memory, no handle: the commit has happened anyway
        now: AtControl = "new" if receipt.is_answered else "unknown"
        raise TransferError(f"it was not read back ({unforeseen(error)})", now, kept) from error


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
            f"the control contains something else than what was approved to be replaced "
            f"(sha256 {short(found)}…, approved {short(expected)}…)"
        )


def _check_stop(control: ControlIdentity, wanted: Wanted) -> None:
    """Ask for E-stop before anything is moved; an image that is there already needs none."""
    if control.in_estop is False and control.sha256 != hashlib.sha256(wanted(b"")).digest():
        raise NotInEmergencyStopError("please place the control in E-stop to download")


def _nothing_to_do(control: ControlIdentity, digest: str) -> Outcome:
    waiting = control.restart_needed
    text = "The control contains exactly this image already; nothing was written."
    if waiting:
        text += " Restart the control to make it current."
    return Outcome("new", True, False, None, "needed" if waiting else "not needed", digest, text)


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


def _prove(
    driver: ControlDriver,
    content: bytes,
    old: bytes,
    receipt: Receipt,
    kept: str | None,
    progress: Progress,
    cancel: threading.Event | None,
    restart_wait: float,
    what: str,
) -> Outcome:
    """Wait for the restart, read back, compare; ``what`` was done."""
    digest = hashlib.sha256(content).hexdigest()
    before = f" What it contained before is kept in {kept}." if kept else " It was empty before."
    before = "".join(f" {note}" for note in receipt.notes) + before
    restart: Literal["done", "needed", "not needed"] = "needed" if receipt.restart_needed else "not needed"
    if receipt.restarting:
        if not driver.wait_restarted(receipt, restart_wait, progress, cancel):
            text = f"{what} complete, but the control has not come back from its restart "
            text += f"within {restart_wait:g} s."
            return Outcome("new", False, True, kept, "missed", digest, text + before)
        restart = "done"
    fetched = driver.fetch(progress, cancel, "verify")
    where = driver.difference(content, fetched)
    if where and fetched == old and not driver.abilities.all_or_nothing:
        text = f"The control has taken nothing of it: {AT_CONTROL_TEXT['old']}."
        return Outcome("old", False, True, kept, restart, digest, text)
    if where:
        at_control: AtControl = "unknown" if driver.abilities.all_or_nothing else "mixed"
        rest = AT_CONTROL_TEXT["unknown"] if driver.abilities.all_or_nothing else "the rest is as it was sent"
        text = f"The control took the image, but what it contains differs {where}; {rest}."
        return Outcome(at_control, False, True, kept, restart, digest, text + before)
    partly = driver.read_back if isinstance(driver, ReadsBackPartly) else ""
    proof = f"complete: {partly}" if partly else "complete and read back equal"
    text = f"{what} {proof}{_RESTART_TEXT[restart]}"
    return Outcome("new", True, True, kept, restart, digest, text + before)
