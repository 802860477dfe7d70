"""Messages: each comes back as it was sent, and what is no message is refused with a code."""

import dataclasses

import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.transfer.house.frame import Frame
from amp_studio.transfer.house.message import (
    LAYOUTS,
    MESSAGES,
    Ack,
    Code,
    Hello,
    Message,
    Read,
    RefusalError,
    Welcome,
    pack,
    shorten,
    unpack,
)

VALUES = {
    "u8": st.integers(0, 0xFF),
    "u16": st.integers(0, 0xFFFF),
    "u32": st.integers(0, 0xFFFF_FFFF),
    "bytes4": st.binary(min_size=4, max_size=4),
    "bytes16": st.binary(min_size=16, max_size=16),
    "bytes32": st.binary(min_size=32, max_size=32),
    "text": st.text(max_size=60),
    "flag": st.booleans(),
    "rest": st.binary(max_size=300),
}
messages = st.sampled_from(list(MESSAGES)).flatmap(
    lambda number: st.builds(MESSAGES[number], *(VALUES[kind] for _, kind in LAYOUTS[number]))
)


@given(messages, st.integers(0, 65_535))
def test_a_message_comes_back_as_it_was_sent(message: Message, sequence: int) -> None:
    frame = pack(message, sequence)
    assert (frame.type, frame.sequence) == (message.TYPE, sequence)
    assert unpack(frame) == message


@given(messages, st.integers(1, 40))
def test_a_payload_of_another_length_is_malformed(message: Message, missing: int) -> None:
    payload = pack(message, 1).payload
    kinds = [kind for _, kind in LAYOUTS[message.TYPE]]
    if "rest" in kinds:
        return
    for changed in (payload[:-missing], payload + bytes(missing)):
        if changed == payload:
            continue
        with pytest.raises(RefusalError) as caught:
            unpack(Frame(message.TYPE, 1, changed))
        assert caught.value.code == Code.MALFORMED


def test_little_endian_and_text_on_the_line() -> None:
    assert pack(Read(0x01020304, 0x0506), 9).payload == bytes.fromhex("04 03 02 01 06 05")
    assert pack(Hello(1, b"abcd", "Öl"), 9).payload == b"\x01abcd\x03" + "Öl".encode()


def test_an_unknown_type_is_unsupported() -> None:
    with pytest.raises(RefusalError, match="0x7e") as caught:
        unpack(Frame(0x7E, 1))
    assert caught.value.code == Code.UNSUPPORTED


@pytest.mark.parametrize(
    "frame",
    [
        Frame(0x01, 1, b"\x01abcd\x02\xff\xfe"),  # text that is not UTF-8
        Frame(0x86, 1, bytes(16 + 32 + 4) + b"\x02"),  # a flag that is neither 0 nor 1
        Frame(0x01, 1, b"\x01abcd\x05abc"),  # text that ends too early
    ],
)
def test_fields_that_cannot_be_are_malformed(frame: Frame) -> None:
    with pytest.raises(RefusalError) as caught:
        unpack(frame)
    assert caught.value.code == Code.MALFORMED


@pytest.mark.parametrize(
    "message",
    [Ack(-1), Ack(1 << 32), Hello(256, b"abcd", ""), Hello(1, b"abc", ""), Hello(1, b"abcd", "x" * 256)],
)
def test_a_value_that_does_not_fit_its_field_is_not_sent(message: Message) -> None:
    with pytest.raises(ValueError, match=r"."):
        pack(message, 1)


def test_types_are_one_byte_and_used_once() -> None:
    kinds = [kind for kind in Message.__subclasses__() if dataclasses.is_dataclass(kind)]
    assert sorted(MESSAGES) == sorted(kind.TYPE for kind in kinds)
    assert Welcome.TYPE >= 0x80 > Hello.TYPE


def test_a_text_is_cut_between_characters() -> None:
    assert shorten("ö" * 200) == "ö" * 127
