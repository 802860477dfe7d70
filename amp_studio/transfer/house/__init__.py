"""The house protocol: frames, messages, transactions and whole transfers between the studio and a control.

Bottom up: ``frame``, ``message``; then the client's ``transaction``, ``window``, ``streaming``,
``connection``, ``download_transfer`` and ``upload_transfer``, ``session``. ``docs/protocols/exchange.md``
specifies it; it is frozen.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .frame import Frame, FrameDecoder, encode_frame
    from .message import (
        PROTOCOL_VERSION,
        Abort,
        Aborted,
        Ack,
        Code,
        Commit,
        Committed,
        Data,
        Flags,
        Gap,
        Hello,
        Message,
        OpenDownload,
        OpenUpload,
        Read,
        Ready,
        RefusalError,
        Refused,
        UploadReady,
        Welcome,
        pack,
        shorten,
        unpack,
    )
else:
    __getattr__ = front_page(__name__)
