"""Peers that want to hurt: bounded time and memory at both ends, and an end that reports the truth."""

import random
import tracemalloc
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from amp_studio.transfer.client.exchange import WantedContent, download
from amp_studio.transfer.emulated.responder import Responder
from amp_studio.transfer.errors import (
    ControlSilentError,
    ImageDamagedError,
    ImageRejectedError,
    ProtocolMismatchError,
    TransferError,
)
from amp_studio.transfer.house.driver import HouseDriver
from amp_studio.transfer.house.frame import encode_frame
from amp_studio.transfer.house.message import (
    Ack,
    Code,
    Commit,
    Hello,
    Message,
    OpenDownload,
    OpenUpload,
    Ready,
    Refused,
    UploadReady,
    pack,
    unpack,
)
from amp_studio.transfer.house.session import Session
from amp_studio.transfer.house.window import Window
from amp_studio.transfer.links.link import LinkError
from tests.transfer import hostile_clients
from tests.transfer.hostile_clients import OLD as STORED
from tests.transfer.hostile_clients import Room, clients_beside_hostile_ones
from tests.transfer.hostile_controls import exchange_with_hostile_control
from tests.transfer.images import NEW, OLD, send


@pytest.mark.parametrize("seed", range(4))
def test_a_hostile_control_costs_a_client_little_and_is_not_believed(seed: int, tmp_path: Path) -> None:
    assert exchange_with_hostile_control(seed, tmp_path) == []


@pytest.mark.parametrize("seed", range(31, 34))
def test_hostile_clients_do_not_keep_a_control_from_others(seed: int, tmp_path: Path) -> None:
    assert clients_beside_hostile_ones(seed, tmp_path) == []


# -- a control that is not what it claims ----------------------------------------------------------


class Liar(Responder):
    """Answers otherwise than it should: ``answers`` gets each request and the true answer."""

    @staticmethod
    def answers(request: Message, answer: Message) -> Message:
        return answer

    def _answer(self, frame: Any) -> Message:
        return self.answers(unpack(frame), super()._answer(frame))


Lie = Callable[[Message, Message], Message]


@pytest.fixture
def lying(
    rig: Callable[..., Any], new_control: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> Callable[..., Any]:
    """Give a function that connects a session with a control that lies."""

    def make(lie: Lie, initial: bytes = OLD, **options: Any) -> Any:
        monkeypatch.setattr("tests.transfer.null_modem.Responder", Liar)
        monkeypatch.setattr(Liar, "answers", staticmethod(lie))
        return rig(control=new_control(initial=initial), **options)

    return make


def test_an_image_in_too_many_pieces_is_refused_before_any_is_asked_for(lying: Callable[..., Any]) -> None:
    """67 million pieces of one byte took 5 GB."""

    def lie(request: Message, answer: Message) -> Message:
        if isinstance(answer, UploadReady):
            return replace(answer, size=1 << 22)
        return replace(answer, chunk=1) if isinstance(request, Hello) else answer

    made = lying(lie)
    session = made.session()
    tracemalloc.start()
    with pytest.raises(ProtocolMismatchError, match="only 1 at a time: 65536 pieces are the most"):
        session.fetch()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 1_000_000


@pytest.mark.parametrize("size", [(1 << 22) + 1, 1 << 26, (1 << 32) - 1])
def test_an_image_larger_than_any_can_be_is_refused(lying: Callable[..., Any], size: int) -> None:
    made = lying(lambda _, answer: replace(answer, size=size) if isinstance(answer, UploadReady) else answer)
    with pytest.raises(ProtocolMismatchError, match=f"an image of {size} bytes, which cannot be"):
        made.session().fetch()


def test_a_window_of_an_image_takes_memory_for_what_is_under_way_only() -> None:
    tracemalloc.start()
    window = Window(0, 1 << 26, 1, 16)
    for number in range(1_000):
        while (piece := window.next_piece()) is not None:
            window.sent(number, *piece, 0.0)
            break
        window.arrived(number)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 500_000


def test_acknowledging_piece_by_piece_takes_time_in_proportion() -> None:
    """Each answer rebuilt a set of all pieces: 100,000 pieces took hours."""
    window = Window(0, 20_000, 1, 255)
    number = 0
    while not window.is_done:
        while (piece := window.next_piece()) is not None:
            number += 1
            window.sent(number, *piece, 0.0)
        window.reached(min(window.size, number))
    assert number == 20_000


def test_a_control_cannot_offer_a_window_that_fills_the_line_for_good(lying: Callable[..., Any]) -> None:
    """255 pieces of 4096 bytes would be a megabyte on the line before the first answer."""
    made = lying(lambda _, answer: answer, window=255, chunk=4_096)
    session = made.session()
    session.hello()
    assert session._line.sizes(session._line._transaction) == (4_096, 16)


def test_more_staged_than_there_is_cannot_be(lying: Callable[..., Any]) -> None:
    made = lying(lambda _, answer: Ready((1 << 32) - 1) if isinstance(answer, Ready) else answer)
    with pytest.raises(ProtocolMismatchError, match="staged 4294967295 bytes of 175") as caught:
        send(made.session())
    assert caught.value.at_control == "old"
    assert made.control.image == OLD


def test_an_acknowledgement_past_the_end_is_none(lying: Callable[..., Any]) -> None:
    reported: list[tuple[str, int, int]] = []
    made = lying(lambda _, answer: Ack((1 << 32) - 1) if isinstance(answer, Ack) else answer)
    send(made.session(), progress=lambda *step: reported.append(step))
    assert all(0 <= done <= total for stage, done, total in reported if stage != "silent")
    assert 3 < made.clock.now < 20, "it had to ask on another line how much is staged"
    assert made.control.image == NEW


def test_a_control_that_loses_again_and_again_what_it_was_sent_is_given_up(lying: Callable[..., Any]) -> None:
    def lie(request: Message, answer: Message) -> Message:
        if isinstance(request, Commit):
            return Refused(Code.INCOMPLETE, "some of it is gone")
        return Ready(0) if isinstance(request, OpenDownload) else answer

    made = lying(lie)
    with pytest.raises(TransferError) as caught:
        send(made.session())
    assert caught.value.at_control == "old"
    assert made.clock.now < 25


def test_a_byte_every_few_seconds_does_not_keep_a_client_for_ever(lying: Callable[..., Any]) -> None:
    """One byte more each time would hold it for days: patience starts again only after a step of some
    size.
    """
    made = lying(lambda _, answer: answer, chunk=1, window=1)
    image = bytes(range(256)) * 40
    slow = made.modem.connect

    def open_slowly() -> Any:
        link = slow()
        write = link.write

        def late(data: bytes) -> None:
            made.clock.sleep(3.0)
            write(data)

        link.write = late
        return link

    made.modem.connect = open_slowly
    with pytest.raises(ControlSilentError):
        send(made.session(), image)
    assert made.clock.now < 60


def test_an_image_that_is_another_each_time_is_not_read_for_ever(lying: Callable[..., Any]) -> None:
    count = iter(range(10_000))

    def lie(request: Message, answer: Message) -> Message:
        if isinstance(answer, UploadReady):
            return replace(answer, sha256=next(count).to_bytes(32, "big"))
        return answer

    made = lying(lie, OLD * 10)
    connect = made.modem.connect

    def cut_soon() -> Any:
        link = connect()
        left = [400]
        read = link.read

        def reading(timeout: float) -> bytes:
            data = read(timeout)
            left[0] -= len(data)
            if left[0] < 0:
                raise LinkError("null modem", "cut")
            return data

        link.read = reading
        return link

    made.modem.connect = cut_soon
    with pytest.raises(ImageDamagedError, match="changes again and again"):
        made.session().fetch()


def test_traffic_that_answers_nothing_is_silence(
    rig: Callable[..., Any], new_control: Callable[..., Any]
) -> None:
    """A whole frame every 50 ms, with the right number even: patience is about progress."""

    made = rig(control=new_control(initial=OLD))
    connect = made.modem.connect
    session = made.session()
    session.hello()

    def chatty() -> Any:
        link = connect()
        read = link.read
        asked = [0]
        write = link.write

        def writing(data: bytes) -> None:
            asked[0] += 1
            if asked[0] <= 2:
                write(data)

        def reading(timeout: float) -> bytes:
            if asked[0] <= 2:
                return read(timeout)
            made.clock.sleep(min(timeout, 0.05))
            return b"".join(encode_frame(pack(UploadReady(2, bytes(32)), n)) for n in range(1, 40))

        link.write, link.read = writing, reading
        return link

    session.close()
    made.modem.connect = chatty
    before = made.clock.now
    with pytest.raises(ControlSilentError):
        send(session)
    assert made.clock.now - before < 21


def test_the_words_of_a_control_steer_no_terminal(lying: Callable[..., Any]) -> None:
    made = lying(
        lambda request, answer: (
            Refused(99, "\x1b]0;owned\x07\u202ecod") if isinstance(request, OpenUpload) else answer
        )
    )
    with pytest.raises(TransferError) as caught:
        made.session().fetch()
    assert str(caught.value).isprintable()
    assert "owned" in str(caught.value)


# -- a client that means no good -------------------------------------------------------------------


def test_bytes_that_are_no_frame_hold_no_line(tmp_path: Path) -> None:
    """One byte of garbage a second kept the control from everybody else for good."""
    room = Room(tmp_path, [])
    room.add(hostile_clients.trickler, random.Random(1))
    for _ in range(300):
        room.turn()
    wire = room.call()
    wire.to_control.append(b"\x00" + encode_frame(pack(OpenUpload(), 9)))
    room.turn()
    room.turn()
    assert wire.to_client
    assert wire.to_client[0] != b""
    assert not wire.is_cut
    room.close()


def test_whole_frames_hold_the_line_and_another_client_is_refused(tmp_path: Path) -> None:
    room = Room(tmp_path, [])
    first, second = room.call(), room.call()
    for _ in range(10):
        first.to_control.append(encode_frame(pack(OpenUpload(), 1)))
        for _ in range(80):
            room.turn()
    second.to_control.append(encode_frame(pack(OpenUpload(), 5)))
    room.turn()
    assert second.to_client[0] == encode_frame(pack(Refused(Code.BUSY, "another client has the control"), 5))
    assert second.is_cut
    assert not first.is_cut
    room.close()


def test_open_lines_are_counted(tmp_path: Path) -> None:
    room = Room(tmp_path, [])
    wires = [room.call() for _ in range(100)]
    for _ in range(120):
        room.turn()
    assert sum(not wire.is_cut for wire in wires) <= 8
    room.close()


def test_an_error_of_the_control_itself_costs_one_client_its_line(tmp_path: Path) -> None:
    room = Room(tmp_path, [])
    room.control.open_download = lambda request: 1 // 0
    wire, other = room.call(), room.call()
    wire.to_control.append(encode_frame(pack(OpenDownload(bytes(16), 1, bytes(32), bytes(32), "s1"), 1)))
    for _ in range(3):
        room.turn()
    assert wire.is_cut
    assert room.said == ["a client was cut off: ZeroDivisionError: integer division or modulo by zero"]
    other.to_control.append(encode_frame(pack(OpenUpload(), 1)))
    room.turn()
    assert other.to_client
    room.close()


@pytest.mark.parametrize(
    "error", [OverflowError("inf"), RecursionError(), MemoryError(), KeyError("x"), ValueError("no")]
)
def test_an_image_that_upsets_the_control_is_not_taken(
    rig: Callable[..., Any], new_control: Callable[..., Any], error: Exception
) -> None:
    """An integer 1e999 ended the control."""

    def accept(image: bytes) -> None:
        raise error

    made = rig(control=new_control(initial=OLD, accept=accept))
    with pytest.raises(ImageRejectedError) as caught:
        send(made.session())
    assert caught.value.at_control == "old"
    assert made.control.image == OLD


def test_no_word_of_the_operator_ends_the_control(tmp_path: Path) -> None:
    room = Room(tmp_path, [])
    for line in ("patch 1300=1e999", "y" * 5_000, "\x1b[2J", "status"):
        room.emulator.operate(line)
    for _ in range(4):
        room.turn()
    assert room.said[0] == "refused: OverflowError: cannot convert float infinity to integer"
    assert room.said[1] == "refused: a command has 4096 bytes at most"
    assert all(line.isprintable() for line in room.said)
    assert room.said[3].startswith("status estop=on")
    assert room.control.image == STORED
    room.close()


def test_a_download_goes_through_where_nothing_is_hostile(tmp_path: Path) -> None:
    """What the seeded tests rest on."""
    room = Room(tmp_path, [])
    session = Session(room.open_link, clock=room.clock, sleep=hostile_clients._turns(room))
    outcome = download(HouseDriver(session), WantedContent(NEW, "s1"), lambda image: "kept.amp")
    assert (outcome.at_control, outcome.verified) == ("new", True)
    assert room.control.image == NEW
    room.close()
