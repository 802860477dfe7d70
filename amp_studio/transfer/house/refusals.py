"""What a refusal of the control means to the caller who asked for the exchange."""

from __future__ import annotations

from amp_studio.transfer.errors import (
    ControlBusyError,
    ControlFullError,
    ImageChangedError,
    ImageDamagedError,
    ImageRejectedError,
    NotInEmergencyStopError,
    ProtocolMismatchError,
    SignatureMismatchError,
    TransferError,
)

from .message import Code, RefusalError

_BY_CODE: dict[int, type[TransferError]] = {
    Code.VERSION: ProtocolMismatchError,
    Code.BUSY: ControlBusyError,
    Code.NOT_IN_ESTOP: NotInEmergencyStopError,
    Code.SIGNATURE: SignatureMismatchError,
    Code.IMAGE_CHANGED: ImageChangedError,
    Code.TOO_LARGE: ControlFullError,
    Code.STORAGE: ControlFullError,
    Code.REJECTED: ImageRejectedError,
    Code.DIGEST: ImageDamagedError,
}


def error_of(refusal: RefusalError) -> TransferError:
    """Return the error that a control's refusal means; the control's own words are its text."""
    kind = _BY_CODE.get(refusal.code, ProtocolMismatchError)
    what = refusal.text or f"the control refuses (code {refusal.code})"
    return kind(what, "old")
