"""Frames: literal bytes, any cutting into pieces, any damage."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.transfer.house.frame import (
    MAX_ENCODED,
    MAX_PAYLOAD,
    Frame,
    FrameDecoder,
    cobs_decode,
    cobs_encode,
    encode_frame,
)

frames = st.builds(
    Frame,
    st.integers(0, 255),
    st.integers(0, 65_535),
    st.binary(max_size=600) | st.binary(max_size=3).map(lambda b: b * 200),
)

TABLE = [
    (Frame(0x02, 1), "03 02 01 05 3d 3c de e5 00"),
    (Frame(0x07, 3, bytes.fromhex("00 00 00 00 04 00")), "03 07 03 01 01 01 01 02 04 05 80 bb 8b 68 00"),
    (Frame(0x84, 5, bytes.fromhex("04 00 00 00")), "03 84 05 02 04 01 01 05 7b 17 9a 3e 00"),
    (Frame(0x00, 0), "01 01 01 05 12 d9 41 ff 00"),
]


@pytest.mark.parametrize(("frame", "line"), TABLE)
def test_a_frame_on_the_line(frame: Frame, line: str) -> None:
    assert encode_frame(frame).hex(" ") == line
    assert FrameDecoder().feed(bytes.fromhex(line)) == [frame]


@pytest.mark.parametrize(
    ("data", "encoded"),
    [
        (b"", b"\x01"),
        (b"\x00", b"\x01\x01"),
        (b"\x11\x22\x00\x33", b"\x03\x11\x22\x02\x33"),
        (bytes(range(1, 255)), b"\xff" + bytes(range(1, 255))),
        (bytes(range(255)), b"\x01\xff" + bytes(range(1, 255))),
        (bytes(range(1, 256)), b"\xff" + bytes(range(1, 255)) + b"\x02\xff"),
        (bytes(range(2, 256)) + b"\x00", b"\xff" + bytes(range(2, 256)) + b"\x01\x01"),
        (b"\x07" * 508, (b"\xff" + b"\x07" * 254) * 2),
    ],
)
def test_cobs_takes_the_zeros_out(data: bytes, encoded: bytes) -> None:
    assert cobs_encode(data) == encoded
    assert cobs_decode(encoded) == data


@given(st.binary(max_size=1_200))
def test_cobs_gives_back_what_it_got_and_holds_no_zero(data: bytes) -> None:
    encoded = cobs_encode(data)
    assert 0 not in encoded
    assert len(encoded) <= len(data) + len(data) // 254 + 1
    assert cobs_decode(encoded) == data


@pytest.mark.parametrize("encoded", [b"\x03\x11", b"\xff", b"\x02\x11\x05"])
def test_a_code_that_points_past_the_end_is_damage(encoded: bytes) -> None:
    assert cobs_decode(encoded) is None


@given(st.lists(frames, max_size=6), st.data())
def test_frames_survive_any_cutting_into_pieces(sent: list[Frame], data: st.DataObject) -> None:
    stream = b"".join(map(encode_frame, sent))
    decoder, received = FrameDecoder(), []
    while stream:
        length = data.draw(st.integers(1, len(stream)))
        received += decoder.feed(stream[:length])
        stream = stream[length:]
    assert received == sent
    assert decoder.bad_frames == 0


@given(st.lists(frames, min_size=1, max_size=6), st.data())
def test_damage_never_gives_a_frame_that_was_not_sent(sent: list[Frame], data: st.DataObject) -> None:
    stream = bytearray(b"".join(map(encode_frame, sent)))
    for _ in range(data.draw(st.integers(1, 5))):
        at = data.draw(st.integers(0, len(stream) - 1))
        match data.draw(st.sampled_from(["change", "lose", "add"])):
            case "change":
                stream[at] = data.draw(st.integers(0, 255))
            case "lose" if len(stream) > 1:
                del stream[at]
            case _:
                stream.insert(at, data.draw(st.integers(0, 255)))
    received = FrameDecoder().feed(bytes(stream))
    left = iter(sent)
    assert all(frame in left for frame in received), "what arrives is what was sent, in that order"


@given(st.binary(max_size=400), frames)
def test_after_garbage_and_one_zero_the_next_frame_is_read(garbage: bytes, frame: Frame) -> None:
    decoder = FrameDecoder()
    decoder.feed(garbage + b"\x00")
    assert decoder.feed(encode_frame(frame)) == [frame]


def test_bad_frames_are_counted_and_empty_ones_are_none() -> None:
    decoder = FrameDecoder()
    assert decoder.feed(b"\x00\x00\x02\x11\x00\x09\x11\x00") == []
    assert decoder.bad_frames == 2


def test_a_stream_without_an_end_is_not_kept() -> None:
    decoder = FrameDecoder()
    for _ in range(1_000):
        assert decoder.feed(b"\x55" * 100) == []
    assert len(decoder._buffer) <= MAX_ENCODED
    assert decoder.feed(b"\x00") == []
    assert decoder.bad_frames == 1
    frame = Frame(1, 2, b"\xff" * MAX_PAYLOAD)
    assert decoder.feed(encode_frame(frame)) == [frame], "the longest frame fits"


def test_a_payload_that_is_too_long_is_not_sent() -> None:
    with pytest.raises(ValueError, match="4161 bytes"):
        encode_frame(Frame(1, 2, bytes(MAX_PAYLOAD + 1)))
