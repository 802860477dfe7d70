"""An emulated control: what it contains, when it takes something else, and what is left after a crash.

Its memory:
    active.img            the image it works with after the next start
    previous.img          the one before
    control.json          E-stop, autostart, incarnation, the last committed transfer
    staged-ID.json .part  a download that has begun: what it is to become, and as much of it as has come
    commit.json           a commit under way: the digest it leads to, and its answer
    outgoing.img          what becomes previous.img when that commit has happened

The one moment a commit happens in is the rename of the staged file to active.img. After a crash, commit.json
and the digest of active.img show on which side of it the control stopped.
"""

from __future__ import annotations

import contextlib
import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

from amp_studio.files import EditLock, InUseError
from amp_studio.transfer.house import Code, Commit, Committed, Flags, OpenDownload, RefusalError

from .memory import Memory
from .record import Identity, StateError, is_answer, load_json, load_record, to_json, written
from .staging import PendingDownload, Staging

_ACTIVE, _PREVIOUS, _OUTGOING, _INTENT = ("active.img", "previous.img", "outgoing.img", "commit.json")
_CAPACITY = 1 << 20  # bytes


class Control:
    """One control with its memory in a folder.

    A new folder begins with the image ``initial``. ``estop`` and ``autostart`` are as remembered when not
    given, at first on. ``accept`` raises, best ValueError, for an image the control does not take. Raises
    StateError when the folder is another control's, damaged or in use. Requests raise RefusalError and then
    have changed nothing.
    """

    def __init__(
        self,
        folder: Path,
        identity: Identity,
        initial: bytes = b"",
        *,
        estop: bool | None = None,
        autostart: bool | None = None,
        capacity: int = _CAPACITY,
        accept: Callable[[bytes], object] | None = None,
    ) -> None:
        self.identity = identity
        self.memory = Memory(folder)
        self.is_committing = False
        self._estop_reason = ""
        self._capacity = capacity
        self._accept = accept
        self._lock = EditLock(folder / "control")
        try:
            self._lock.take()
        except InUseError as error:
            raise StateError(f"{folder}: {error}") from None
        try:
            self._boot(initial, estop, autostart)
        except BaseException:
            self._lock.release()
            raise

    def close(self) -> None:
        """Leave the folder to others."""
        self._lock.release()

    # -- what it contains --------------------------------------------------------------------------

    @property
    def image(self) -> bytes:
        """The active image."""
        return self._active

    @property
    def sha256(self) -> bytes:
        """The digest of the active image."""
        return self._digest

    @property
    def boot_count(self) -> int:
        """Counts the starts of the control."""
        return self._record.incarnation

    @property
    def flags(self) -> Flags:
        """The state."""
        return self._record.flags()

    @property
    def is_as_delivered(self) -> bool:
        """Whether nothing was ever downloaded to it or changed at it."""
        return self._record.committed is None and not self._record.changed_at_control

    @property
    def staged_size(self) -> int:
        """How many bytes of the open download are staged."""
        return self._staging.size

    # -- at the operator's panel -------------------------------------------------------------------

    def set_estop(self, on: bool) -> None:
        """Press or release the emergency stop; raises StateError where the control does not come out of
        it.
        """
        if self._estop_reason and not on:
            raise StateError(f"the control stays in E-stop: {self._estop_reason}")
        self._remember(estop=on)

    def keep_in_estop(self, reason: str) -> None:
        """Keep the control in E-stop for a reason; "" lets it out again when the operator releases it."""
        self._estop_reason = reason
        if reason and not self._record.estop:
            self._remember(estop=True)

    def set_autostart(self, on: bool) -> None:
        """Choose whether the control restarts by itself after a download."""
        self._remember(autostart=on)

    def restart(self) -> None:
        """Start again: the active image becomes current."""
        self._remember(incarnation=self.boot_count + 1, running=True, restart_needed=False)

    def patch(self, change: Callable[[bytes], bytes]) -> None:
        """Change the image at the control itself; raises RefusalError, OSError, and what ``change``
        raises.
        """
        self._need_estop("change its image")
        changed = change(self._active)
        self.memory.replace(_ACTIVE, changed)
        self._activate(changed)
        self._record.remember(self._digest)
        self._remember(restart_needed=True, changed_at_control=True)

    def tune(self, change: Callable[[bytes], bytes], *, in_estop: bool) -> None:
        """Change the image on line, where it counts at once; raises RefusalError, OSError,
        and what ``change`` raises.
        """
        if in_estop:
            self._need_estop("change it on line")
        changed = change(self._active)
        self.memory.replace(_ACTIVE, changed)
        self._activate(changed)
        self._record.remember(self._digest)
        self._remember()

    # -- requests ----------------------------------------------------------------------------------

    def open_download(self, request: OpenDownload) -> int:
        """Begin a download or take it up again; return the offset to go on from."""
        # The answer to the commit was lost: the client goes on to it and gets it again, with nothing to
        # send.
        if self._record.answer_to(request.transfer, request.sha256) is not None:
            return request.size
        if request.signature != self.identity.signature and not self._record.has_contained(request.sha256):
            raise RefusalError(
                Code.SIGNATURE,
                "the control numbers its parameters by another schema and has not contained this image",
            )
        self._need_estop("download")
        self._need_expected(request.expected)
        if request.size > self._capacity:
            raise RefusalError(
                Code.TOO_LARGE,
                f"the image has {request.size} bytes, and the control has room for {self._capacity}",
            )
        pending = PendingDownload(request.transfer, request.size, request.sha256, request.expected)
        begun = self._staging.pending
        if begun != pending:
            # Half of one image and half of another would have the right length.
            if begun is not None and begun.transfer == pending.transfer:
                raise RefusalError(Code.MALFORMED, "this transfer was begun with another image")
            with _storing():
                self._staging.begin(pending)
        return self._staging.size

    def stage(self, transfer: bytes, content: bytes) -> None:
        """Add to the end of what is staged."""
        pending = self._pending(transfer)
        if self._staging.size + len(content) > pending.size:
            raise RefusalError(Code.OUT_OF_RANGE, f"the image was to have {pending.size} bytes")
        with _storing():
            self._staging.add(pending, content)

    def commit(self, request: Commit) -> Committed:
        """Put what is staged in the place of the active image; asked again, answer the same again."""
        answered = self._record.answer_to(request.transfer, request.sha256)
        if answered is not None:
            return answered
        pending = self._pending(request.transfer)
        self._need_estop("download")
        self._need_expected(pending.expected)
        self._check_whole(pending, request.sha256)
        record = self._record
        answer = Committed(pending.transfer, pending.sha256, record.incarnation, record.autostart)
        self.is_committing = True
        try:
            self._replace_active(pending, {"to": pending.sha256.hex(), "answer": written(answer)})
        finally:
            self.is_committing = False
        return answer

    def abort(self, transfer: bytes) -> None:
        """Throw a download away."""
        committed = self._record.committed
        if committed is not None and committed["transfer"] == transfer.hex():
            raise RefusalError(Code.ALREADY_COMMITTED, "this download is committed and cannot be taken back")
        if self._staging.pending is not None and self._staging.pending.transfer == transfer:
            self._staging.drop()

    # -- the parts of a commit ---------------------------------------------------------------------

    def _check_whole(self, pending: PendingDownload, sha256: bytes) -> None:
        if self._staging.size < pending.size:
            raise RefusalError(Code.INCOMPLETE, f"{self._staging.size} of {pending.size} bytes have come")
        content = self._staging.content(pending) if sha256 == pending.sha256 else None
        if content is None:
            self._staging.drop()
            raise RefusalError(Code.DIGEST, "what has come does not have the digest that was stated")
        if self._accept is not None and not self._record.has_contained(sha256):
            try:
                self._accept(content)
            except Exception as error:  # an image is a stranger's: whatever it upsets, it is not taken
                self._staging.drop()
                message = str(error) if isinstance(error, ValueError) else type(error).__name__
                raise RefusalError(
                    Code.REJECTED, f"the control has not contained this image and does not take it: {message}"
                ) from None

    def _replace_active(self, pending: PendingDownload, intent: dict[str, Any]) -> None:
        """Rename the staged file to active.img, with everything that must be on the disk before."""
        fault = "unknown reason"
        try:
            self.memory.sync(pending.part)
            self.memory.replace(_OUTGOING, self._active)
            self.memory.replace(_INTENT, to_json(intent))
            self.memory.move(pending.part, _ACTIVE)
        except OSError as error:
            fault = error.strerror or str(error)
        # Whatever went wrong above: what is now in active.img is what the control contains.
        self._activate(self.memory.read(_ACTIVE) or b"")
        if self._digest != pending.sha256:
            self._forget_intent()
            raise RefusalError(Code.STORAGE, f"the control cannot store the image ({fault})")
        self._finish(intent)
        self._staging.drop()

    def _finish(self, intent: dict[str, Any]) -> None:
        """Write down a commit that has happened; what cannot be written now, the next start writes."""
        record = self._record
        record.running, record.restart_needed, record.changed_at_control = False, True, False
        record.committed = intent["answer"]
        record.remember(self._digest)
        with contextlib.suppress(OSError):
            record.save(self.memory)
            if _OUTGOING in self.memory.names():
                self.memory.move(_OUTGOING, _PREVIOUS)
            self._forget_intent()

    def _forget_intent(self) -> None:
        # One that cannot be removed does no harm: the digest of active.img decides.
        with contextlib.suppress(OSError):
            self.memory.remove(_INTENT)

    # -- small parts -------------------------------------------------------------------------------

    def _boot(self, initial: bytes, estop: bool | None, autostart: bool | None) -> None:
        """Read the memory, finish or forget a commit that was under way, and start; raises StateError."""
        # All is read before anything is written: a memory that is refused stays as it is.
        active = self.memory.read(_ACTIVE)
        self._record = load_record(self.memory, self.identity)
        intent = load_json(self.memory, _INTENT)
        if intent is not None and not (isinstance(intent.get("to"), str) and is_answer(intent.get("answer"))):
            raise StateError(f"{self.memory.folder / _INTENT} is damaged")
        self._staging = Staging(self.memory)
        self.memory.clear_temporaries()
        if active is None:
            self.memory.replace(_ACTIVE, initial)
            active = initial
        self._activate(active)
        self._record.remember(self._digest)
        # The rename had happened when the power went: what was left to write is written now.
        if intent is not None and intent["to"] == self._digest.hex():
            self._finish(intent)
        elif intent is not None:
            self._forget_intent()
        self._staging.tidy()
        pending = self._staging.pending
        # Of a committed download nothing needs to be staged any more.
        if pending is not None and self._record.answer_to(pending.transfer, pending.sha256) is not None:
            self._staging.drop()
        self._record.estop = self._record.estop if estop is None else estop
        self._record.autostart = self._record.autostart if autostart is None else autostart
        self.restart()

    def _activate(self, image: bytes) -> None:
        self._active = image
        self._digest = hashlib.sha256(image).digest()

    def _remember(self, **changes: Any) -> None:
        for name, value in changes.items():
            setattr(self._record, name, value)
        self._record.save(self.memory)

    def _pending(self, transfer: bytes) -> PendingDownload:
        pending = self._staging.pending
        if pending is None or pending.transfer != transfer:
            raise RefusalError(Code.UNKNOWN_TRANSFER, "the control knows nothing of this download")
        return pending

    def _need_estop(self, what: str) -> None:
        if not self._record.estop:
            raise RefusalError(Code.NOT_IN_ESTOP, f"please place the control in E-stop to {what}")

    def _need_expected(self, expected: bytes) -> None:
        if expected != self._digest:
            raise RefusalError(
                Code.IMAGE_CHANGED, "the control's image was changed by somebody else in the meantime"
            )


@contextlib.contextmanager
def _storing() -> Any:
    """Turn a fault of the disk into a refusal."""
    try:
        yield
    except OSError as error:
        raise RefusalError(
            Code.STORAGE, f"the control cannot store the image ({error.strerror or error})"
        ) from None
