"""Files of every size come through both protocols byte for byte, also where the line changes some of them."""

import random

import pytest

from amp_studio.transfer.plain.blocks import decode_block, encode_block
from amp_studio.transfer.plain.line import ByteLine, PlainFileError
from amp_studio.transfer.plain.receiver import BlockReceiver
from amp_studio.transfer.plain.sender import BlockSender
from amp_studio.transfer.plain.ymodem import PlainFile, file_name, read_header, receive_batch, send_batch

from .ends import QUICK, Wild, both, pair

SIZES = (0, 1, 127, 128, 129, 896, 897, 1023, 1024, 1025, 40_000)


def content(size: int) -> bytes:
    """Return any bytes that do not end like padding."""
    return random.Random(size).randbytes(size)[:-1] + b"x" if size else b""


def send_one(line: ByteLine, data: bytes, *, long_blocks: bool) -> None:
    sender = BlockSender(line, long_blocks=long_blocks)
    sender.await_start()
    sender.send(data)


def receive_one(line: ByteLine, *, crc: bool = True) -> bytes:
    receiver = BlockReceiver(line, crc=crc)
    data = receiver.receive(None)
    receiver.finish()
    return data


def test_a_block_is_as_the_standard_has_it() -> None:
    assert encode_block(1, b"123456789", crc=True)[:12] == b"\x01\x01\xfe123456789"
    assert encode_block(1, b"123456789", crc=True)[12:131] == b"\x1a" * 119
    assert decode_block(1, b"\x01\xfe" + bytes(128) + b"\0\0", crc=True) == (1, bytes(128)), (
        "CRC of zeros is 0"
    )
    assert encode_block(257, b"A" * 128, crc=False) == b"\x01\x01\xfe" + b"A" * 128 + bytes(
        [0x41 * 128 & 0xFF]
    )
    assert encode_block(2, b"A" * 129, crc=True)[:3] == b"\x02\x02\xfd", "STX begins a block of 1024"
    # CRC-16 of XMODEM over "123456789" is 31C3h; one block has it with the padding that cancels nothing.
    assert encode_block(0, b"\0" * 119 + b"123456789", crc=True)[-2:] == b"\x31\xc3"


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize(("long_blocks", "crc"), [(False, False), (False, True), (True, True)])
def test_xmodem_carries_a_file_of_any_size(size: int, long_blocks: bool, crc: bool) -> None:
    data = content(size)
    got = both(
        lambda line: send_one(line, data, long_blocks=long_blocks), lambda line: receive_one(line, crc=crc)
    )
    assert got.rstrip(b"\x1a") == data
    assert len(got) % 128 == 0


def test_a_receiver_without_crc_gets_short_blocks_even_of_a_sender_of_long_ones() -> None:
    got = both(
        lambda line: send_one(line, content(3000), long_blocks=True),
        lambda line: receive_one(line, crc=False),
    )
    assert got.rstrip(b"\x1a") == content(3000)


def test_a_sender_that_knows_no_crc_is_asked_for_checksums_in_the_end() -> None:
    def old_sender(line: ByteLine) -> None:
        while line.get(1, 5) != b"\x15":
            pass
        sender = BlockSender(line, long_blocks=False)
        sender.send(b"old control")

    assert both(old_sender, receive_one).startswith(b"old control\x1a")


def test_ymodem_carries_names_and_exact_sizes_of_many_files() -> None:
    files = [PlainFile(f"file {size}.txt", content(size) + b"\x1a" * (size == 129)) for size in SIZES]
    got = both(lambda line: send_batch(BlockSender(line, long_blocks=True), files), receive_batch)
    assert got == files, "a file that ends in 1Ah too"


@pytest.mark.parametrize("seed", range(6))
def test_a_noisy_line_changes_no_byte_of_a_file(seed: int) -> None:
    files = [PlainFile("a", content(3_000)), PlainFile("b", content(0))]
    got = both(
        lambda line: send_batch(BlockSender(line, long_blocks=True), files),
        receive_batch,
        noise=1_500,
        seed=seed,
    )
    assert got == files


def test_a_lost_acknowledgement_doubles_nothing() -> None:
    lost = 0

    def send(line: ByteLine) -> None:
        nonlocal lost
        get = line.get

        def lossy(count: int, seconds: float) -> bytes:
            nonlocal lost
            came = get(count, seconds)
            if came == b"\x06" and lost < 3:
                lost += 1
                return b""
            return came

        line.get = lossy
        send_one(line, content(1025), long_blocks=False)

    assert both(send, receive_one).rstrip(b"\x1a") == content(1025)
    assert lost == 3


@pytest.mark.parametrize(
    ("sent", "message"),
    [
        (b"\x18\x18", "given the transfer up"),
        (encode_block(5, b"x", crc=True), "block 5 has come, and block 1 was to come"),
        (b"\x04", "announced once and not confirmed"),
        (b"", "has not begun within"),
    ],
)
def test_what_goes_wrong_is_shown_in_a_sentence(sent: bytes, message: str) -> None:
    near, far = pair()
    near.write(sent)
    patience = type(QUICK)(start=0.3, answer=0.05, ask=0.05, gap=0.05, noise=0.05, quiet=0.02, stall=0.3)
    with pytest.raises(PlainFileError, match=message):
        receive_one(ByteLine(far, patience))


def test_a_receiver_that_gives_up_ends_the_sending_at_once() -> None:
    near, far = pair()
    near.write(b"C")
    near.write(b"\x18\x18")
    sender = BlockSender(ByteLine(far, QUICK), long_blocks=False)
    sender.await_start()
    with pytest.raises(PlainFileError, match="given the transfer up"):
        sender.send(b"data")
    assert sender.accepted_bytes == 0


@pytest.mark.parametrize(
    ("block", "expected"),
    [
        (b"plan.txt\x0012 14562 0\0", ("plan.txt", 12)),
        (b"plan.txt\x0012\0" + bytes(100), ("plan.txt", 12)),
        (b"plan.txt", ("plan.txt", None)),
        (b"plan.txt\0-5", ("plan.txt", None)),
        (b"plan.txt\x009999999999999999", ("plan.txt", None)),
        (b"\0" * 128, ("", None)),
        (b"\xff\0", ("�", None)),
    ],
)
def test_the_header_of_a_file_is_read_with_what_it_has(
    block: bytes, expected: tuple[str, int | None]
) -> None:
    assert read_header(block) == expected


@pytest.mark.parametrize(
    ("name", "saved"),
    [
        ("plan.txt", "plan.txt"),
        ("../../etc/passwd", "passwd"),
        ("C:\\windows\\win.ini", "win.ini"),
        ("/", "file"),
        ("..", "file"),
        (".bashrc", "bashrc"),
        ("a\x1b[2Jb\n", "a_[2Jb_"),
        ("x" * 300, "x" * 100),
    ],
)
def test_a_strangers_name_leads_nowhere_else(name: str, saved: str) -> None:
    assert file_name(name) == saved


@pytest.mark.parametrize("seed", range(20))
def test_whatever_the_other_end_shows_it_ends(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("amp_studio.transfer.plain.receiver.LARGEST", 5_000)
    wild = Wild(seed)
    line = ByteLine(wild, clock=wild.clock)
    try:
        if seed % 2:
            receive_batch(line)
        else:
            send_batch(BlockSender(line, long_blocks=True), [PlainFile("x", bytes(3_000))])
    except PlainFileError:
        pass
    assert wild.now < 1_500
