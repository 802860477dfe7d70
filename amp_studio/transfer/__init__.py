"""The exchange with controls: download, upload and verify over TCP and serial lines, and emulated controls.

The layers, from the cable up: ``address``, ``link`` (``tcp``, ``serial_line``,
``pseudo_terminal``, ``null_modem``), ``frame``, ``message``; then the client's
``conversation``, ``streaming``, ``line``, ``sending``, ``session`` and
``exchange``, and the control's ``memory``, ``record``, ``staging``,
``control``, ``responder`` and ``emulator``. An image is bytes for all of them;
``image`` says what they mean, ``verification`` compares two, and ``kept`` keeps
what a control held. ``docs/protocols`` specifies the wire.
"""

from .address import Address, parse_address
from .control import Control
from .emulator import Emulator, serve
from .errors import (
    Cancelled,
    ControlBusy,
    ControlFull,
    ControlSilent,
    Held,
    ImageChanged,
    ImageDamaged,
    ImageRejected,
    KeepFailed,
    LineCut,
    NoConnection,
    NotInEmergencyStop,
    ProtocolMismatch,
    SignatureMismatch,
    TransferError,
    WrongFamily,
)
from .exchange import Outcome, Verification, download, first_difference, upload, verify
from .faults import Faults, read_faults
from .link import LinkError, connect, listen
from .message import Flags, Welcome
from .progress import Progress
from .record import Identity, StateFault
from .sending import Sent
from .session import Session

__all__ = [
    "Address",
    "Cancelled",
    "Control",
    "ControlBusy",
    "ControlFull",
    "ControlSilent",
    "Emulator",
    "Faults",
    "Flags",
    "Held",
    "Identity",
    "ImageChanged",
    "ImageDamaged",
    "ImageRejected",
    "KeepFailed",
    "LineCut",
    "LinkError",
    "NoConnection",
    "NotInEmergencyStop",
    "Outcome",
    "Progress",
    "ProtocolMismatch",
    "Sent",
    "Session",
    "SignatureMismatch",
    "StateFault",
    "TransferError",
    "Verification",
    "Welcome",
    "WrongFamily",
    "connect",
    "download",
    "first_difference",
    "listen",
    "parse_address",
    "read_faults",
    "serve",
    "upload",
    "verify",
]
