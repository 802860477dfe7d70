"""The exchange with controls: drivers and the client that uses them, over TCP and serial lines;
emulated controls.

``links`` carry bytes, ``house`` is the protocol of the emulated controls over them, ``client`` puts files
into controls and compares them, ``emulated`` is the other end. An image is bytes for all of them; ``image``
knows what they mean.
``docs/protocols`` specifies the wire.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .break_state import state_after_break
    from .content import TakesAllOrRefuses, decode_content
    from .driver import Abilities, ControlDriver, ControlIdentity, Receipt, Recognised, TakesLiveValues
    from .errors import (
        AtControl,
        CancelledError,
        ConnectionCutError,
        ControlFullError,
        ControlSilentError,
        ImageChangedError,
        ImageDamagedError,
        ImageRejectedError,
        MovingError,
        NoConnectionError,
        NotInEmergencyStopError,
        ProtocolMismatchError,
        Remains,
        TransferError,
        WrongFamilyError,
    )
    from .exchange import QUIET, Exchange, Replacement
    from .image import ImageError, decode_image, encode_image, patch_image
    from .interruption import interrupts
    from .line_driver import LineDriver
    from .progress import Progress, Stop, quiet
    from .sent_values import SentValues
    from .status import ActiveFault, AxisStatus, ControlStatus, known_fault
    from .waiting import OpenLink, Waiting
else:
    __getattr__ = front_page(__name__)
