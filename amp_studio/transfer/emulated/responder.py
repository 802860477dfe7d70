"""The control's side of the protocol: bytes of a line in, bytes out; opens nothing and waits for nothing."""

from __future__ import annotations

from amp_studio.transfer.house import (
    PROTOCOL_VERSION,
    Abort,
    Aborted,
    Ack,
    Code,
    Commit,
    Data,
    Frame,
    FrameDecoder,
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
    encode_frame,
    pack,
    shorten,
    unpack,
)

from .control import Control

WINDOW = 16  # pieces a client may have under way
CHUNK = 512  # bytes a piece


class Responder:
    """Answers the requests of one line on behalf of a control.

    When ``restart_due`` is set, the owner of the line hangs up once the answers are out, and restarts the
    control.
    """

    def __init__(self, control: Control, *, window: int = WINDOW, chunk: int = CHUNK) -> None:
        self.control = control
        self.restart_due = False
        self._window = window
        self._chunk = chunk
        self._decoder = FrameDecoder()
        self._transfer: bytes | None = None
        self._size = 0
        self._early: dict[int, bytes] = {}  # pieces that came before the ones in front of them
        self._copy: bytes | None = None

    def receive(self, data: bytes) -> bytes:
        """Take what came on the line and return what is to be sent; damaged frames get no answer."""
        return b"".join(self.answer(frame) for frame in self.frames(data) if not self.restart_due)

    def frames(self, data: bytes) -> list[Frame]:
        """Return the whole frames that end in what came on the line."""
        return self._decoder.feed(data)

    def answer(self, frame: Frame) -> bytes:
        """Do what a frame asks for and return what is to be sent."""
        return encode_frame(pack(self._answer(frame), frame.sequence))

    def _answer(self, frame: Frame) -> Message:
        try:
            return self._do(unpack(frame))
        except RefusalError as refusal:
            return Refused(refusal.code, shorten(refusal.text))
        except OSError as error:
            return Refused(
                Code.STORAGE, shorten(f"the control cannot write its memory ({error.strerror or error})")
            )

    def _do(self, request: Message) -> Message:
        """Return the answer to a request; raises RefusalError."""
        match request:
            case Hello():
                return self._welcome(request)
            case OpenDownload():
                return self._open_download(request)
            case Data():
                return self._data(request)
            case Commit():
                return self._commit(request)
            case OpenUpload():
                self._copy = self.control.image
                return UploadReady(len(self._copy), self.control.sha256)
            case Read():
                return self._read(request)
            case Abort():
                self.control.abort(request.transfer)
                self._forget()
                return Aborted(request.transfer)
        raise RefusalError(Code.UNSUPPORTED, f"a {type(request).__name__} is no request")

    def _welcome(self, hello: Hello) -> Welcome:
        """Begin a session and return who answers; raises RefusalError for another version."""
        if hello.version < 1:
            raise RefusalError(Code.VERSION, f"the control speaks version {PROTOCOL_VERSION} of the protocol")
        self._forget()
        self._copy = None
        control = self.control
        who = control.identity
        return Welcome(
            min(hello.version, PROTOCOL_VERSION),
            hello.nonce,
            who.family,
            who.signature,
            shorten(who.name),
            shorten(who.revision),
            control.flags,
            control.boot_count,
            len(control.image),
            control.sha256,
            self._window,
            self._chunk,
        )

    def _open_download(self, request: OpenDownload) -> Ready:
        offset = self.control.open_download(request)
        self._transfer, self._size = request.transfer, request.size
        self._early.clear()
        return Ready(offset)

    def _data(self, data: Data) -> Message:
        """Stage a piece, or keep one that came early; the answer is up to where the image is whole."""
        if self._transfer is None:
            raise RefusalError(Code.UNKNOWN_TRANSFER, "no download is open on this line")
        staged = self.control.staged_size
        end = data.offset + len(data.content)
        if end > self._size:
            raise RefusalError(Code.OUT_OF_RANGE, f"the image was to have {self._size} bytes")
        if data.offset > staged:
            if len(self._early) >= self._window and data.offset not in self._early:
                return Gap(staged)
            self._early[data.offset] = data.content
            return Ack(staged)
        if end > staged:
            self.control.stage(self._transfer, data.content[staged - data.offset :])
            self._catch_up(self._transfer)
        return Ack(self.control.staged_size)

    def _catch_up(self, transfer: bytes) -> None:
        """Stage the early pieces that now follow what is staged."""
        while (content := self._early.pop(self.control.staged_size, None)) is not None:
            self.control.stage(transfer, content)
        for offset in [at for at in self._early if at < self.control.staged_size]:
            del self._early[offset]

    def _commit(self, request: Commit) -> Message:
        committed = self.control.commit(request)
        self._forget()
        # Asked again after the restart, the answer is the same, and there is nothing left to restart.
        if committed.restarting and committed.incarnation == self.control.boot_count:
            self.restart_due = True
        return committed

    def _read(self, request: Read) -> Data:
        if self._copy is None:
            raise RefusalError(Code.NO_UPLOAD, "no upload is open on this line")
        if request.length > self._chunk or request.offset + request.length > len(self._copy):
            raise RefusalError(
                Code.OUT_OF_RANGE, f"the image has {len(self._copy)} bytes, and a piece {self._chunk}"
            )
        return Data(request.offset, self._copy[request.offset : request.offset + request.length])

    def _forget(self) -> None:
        self._transfer = None
        self._early.clear()
