"""The control's answers, request by request, to clients that keep to the protocol and others."""

import errno
import hashlib
from collections.abc import Callable
from typing import Any

import pytest

from amp_studio.transfer.emulated.responder import Responder
from amp_studio.transfer.house.frame import Frame, FrameDecoder, encode_frame
from amp_studio.transfer.house.message import (
    Abort,
    Aborted,
    Ack,
    Code,
    Commit,
    Committed,
    Data,
    Gap,
    Hello,
    Message,
    OpenDownload,
    OpenUpload,
    Read,
    Ready,
    Refused,
    UploadReady,
    Welcome,
    pack,
    unpack,
)

OLD, NEW = b"old image\n", b"0123456789" * 8
TRANSFER = bytes(16)


def sha(image: bytes) -> bytes:
    return hashlib.sha256(image).digest()


@pytest.fixture
def responder(new_control: Callable[..., Any]) -> Responder:
    return Responder(new_control(initial=OLD), window=3, chunk=10)


def ask(responder: Responder, message: Message, number: int = 7) -> Message:
    (frame,) = FrameDecoder().feed(responder.receive(encode_frame(pack(message, number))))
    assert frame.sequence == number, "an answer carries the number of its request"
    return unpack(frame)


def refusal(responder: Responder, message: Message) -> int:
    answer = ask(responder, message)
    assert isinstance(answer, Refused)
    assert answer.text
    return answer.code


def open_download(responder: Responder) -> Message:
    return ask(responder, OpenDownload(TRANSFER, len(NEW), sha(NEW), sha(OLD), "s1"))


def piece(at: int) -> Data:
    return Data(at, NEW[at : at + 10])


def test_a_hello_is_answered_with_its_nonce_and_a_version_both_know(responder: Responder) -> None:
    welcome = ask(responder, Hello(9, b"\x01\x02\x03\x04", "a later program"))
    assert isinstance(welcome, Welcome)
    assert (welcome.version, welcome.nonce, welcome.window, welcome.chunk) == (1, b"\x01\x02\x03\x04", 3, 10)
    assert refusal(responder, Hello(0, bytes(4), "")) == Code.VERSION


def test_pieces_may_come_early_twice_and_late(responder: Responder) -> None:
    assert open_download(responder) == Ready(0)
    assert ask(responder, piece(20)) == Ack(0), "kept until what stands before it has come"
    assert ask(responder, piece(10)) == Ack(0)
    assert ask(responder, piece(0)) == Ack(30)
    assert ask(responder, piece(10)) == Ack(30), "what is staged is acknowledged again"
    assert ask(responder, Data(25, NEW[25:40])) == Ack(40), "what is new in a piece is taken"


def test_pieces_that_come_too_early_are_not_kept(responder: Responder) -> None:
    open_download(responder)
    for at in (20, 30, 40):
        assert ask(responder, piece(at)) == Ack(0)
    assert ask(responder, piece(50)) == Gap(0)
    assert ask(responder, piece(30)) == Ack(0)


def test_an_early_piece_that_is_overtaken_is_forgotten(responder: Responder) -> None:
    open_download(responder)
    ask(responder, piece(10))
    assert ask(responder, Data(0, NEW[:25])) == Ack(25)
    assert ask(responder, Data(25, NEW[25:])) == Ack(80)
    assert isinstance(ask(responder, Commit(TRANSFER, sha(NEW))), Committed)


def test_what_belongs_to_no_download_or_upload_is_refused(responder: Responder) -> None:
    assert refusal(responder, piece(0)) == Code.UNKNOWN_TRANSFER
    assert refusal(responder, Commit(TRANSFER, sha(NEW))) == Code.UNKNOWN_TRANSFER
    assert refusal(responder, Read(0, 1)) == Code.NO_UPLOAD
    open_download(responder)
    assert refusal(responder, Data(75, b"123456")) == Code.OUT_OF_RANGE
    other = OpenDownload(TRANSFER, 3, sha(b"abc"), sha(OLD), "s1")
    assert refusal(responder, other) == Code.MALFORMED, "one id, two images"
    ask(responder, Hello(1, bytes(4), ""))
    assert refusal(responder, piece(0)) == Code.UNKNOWN_TRANSFER, "a Hello starts again"
    ask(responder, OpenUpload())
    ask(responder, Hello(1, bytes(4), ""))
    assert refusal(responder, Read(0, 1)) == Code.NO_UPLOAD


def test_an_upload_is_of_one_image_whatever_happens_meanwhile(responder: Responder) -> None:
    assert ask(responder, OpenUpload()) == UploadReady(len(OLD), sha(OLD))
    responder.control.patch(lambda image: image.upper())
    assert ask(responder, Read(4, 6)) == Data(4, b"image\n")
    assert refusal(responder, Read(5, 6)) == Code.OUT_OF_RANGE
    assert refusal(responder, Read(0, 11)) == Code.OUT_OF_RANGE
    ask(responder, OpenUpload())
    assert ask(responder, Read(4, 6)) == Data(4, b"IMAGE\n")


def test_an_abort_may_be_repeated_and_can_come_too_late(responder: Responder) -> None:
    open_download(responder)
    assert ask(responder, Abort(TRANSFER)) == Aborted(TRANSFER)
    assert ask(responder, Abort(TRANSFER)) == Aborted(TRANSFER)
    open_download(responder)
    ask(responder, Data(0, NEW))
    committed = ask(responder, Commit(TRANSFER, sha(NEW)))
    assert committed == Committed(TRANSFER, sha(NEW), 1, True)
    responder.restart_due = False
    assert refusal(responder, Abort(TRANSFER)) == Code.ALREADY_COMMITTED


def test_after_a_commit_the_control_hangs_up(responder: Responder) -> None:
    open_download(responder)
    ask(responder, Data(0, NEW))
    commit = encode_frame(pack(Commit(TRANSFER, sha(NEW)), 8))
    answers = FrameDecoder().feed(responder.receive(commit * 2))
    assert len(answers) == 1
    assert responder.restart_due


def test_what_is_no_request_is_refused(responder: Responder) -> None:
    assert refusal(responder, Ack(0)) == Code.UNSUPPORTED
    for frame, code in ((Frame(0x55, 3), Code.UNSUPPORTED), (Frame(0x07, 3, b"\x01"), Code.MALFORMED)):
        (answer,) = FrameDecoder().feed(responder.receive(encode_frame(frame)))
        message = unpack(answer)
        assert isinstance(message, Refused)
        assert message.code == code


def test_damaged_frames_get_no_answer(responder: Responder) -> None:
    assert responder.receive(b"\x00garbage\x00\x03\x02\x01\x05\x3d\x3c\xde\xe4\x00") == b""


def test_a_memory_that_cannot_be_written_is_a_refusal(responder: Responder) -> None:
    def fail(step: str) -> None:
        raise OSError(errno.EIO, "Input/output error")

    responder.control.memory.on_step = fail
    answer = ask(responder, OpenDownload(TRANSFER, len(NEW), sha(NEW), sha(OLD), "s1"))
    assert answer == Refused(Code.STORAGE, "the control cannot store the image (Input/output error)")
