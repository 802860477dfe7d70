"""Raw text is punched with leader and %, and read back without them."""

import pytest

from amp_studio.transfer.plain.line import ByteLine, Patience, PlainFileError
from amp_studio.transfer.plain.raw import Tape, punch, punched, read_tape

from .ends import both, pair

PROGRAM = b"O1234\r\nG0 X0\r\nM30\r\n"


@pytest.mark.parametrize(
    ("content", "tape", "expected"),
    [
        (PROGRAM, Tape(), PROGRAM),
        (PROGRAM, Tape(percent=True), b"%\r\n" + PROGRAM + b"%\r\n"),
        (b"%1\nN1\n%\n", Tape(percent=True), b"%1\nN1\n%\n"),
        (b"N1", Tape(percent=True), b"%\nN1\n%\n"),
        (b"N1 10%\n", Tape(percent=True), b"%\nN1 10%\n%\n"),
        (b"", Tape(percent=True), b"%\n%\n"),
        (b"N1\n", Tape(3, b" ", percent=False), b"   N1\n   "),
        (b"N1\n", Tape(2), b"\0\0N1\n\0\0"),
    ],
)
def test_a_tape_has_its_leader_and_its_marks(content: bytes, tape: Tape, expected: bytes) -> None:
    assert punched(content, tape) == expected


@pytest.mark.parametrize(
    ("came", "tape", "expected"),
    [
        (b"\0\0" + PROGRAM + b"\0\x7f", Tape(), PROGRAM),
        (b"  N1\n   ", Tape(2, b" "), b"N1\n"),
        (b"  N1\n ", Tape(), b"  N1\n "),
        (
            b"noise\0\0%\r\n" + PROGRAM + b"%\r\n and what comes after",
            Tape(percent=True),
            b"%\r\n" + PROGRAM + b"%\n",
        ),
        (b"%12\nN1\n%  \0\0\0", Tape(percent=True), b"%12\nN1\n%\n"),
        (b"%\nN1 10%\nN2\n%\n", Tape(percent=True), b"%\nN1 10%\nN2\n%\n"),
        (b"%1\nN1\n%2\nN2\n%", Tape(percent=True), b"%1\nN1\n%2\nN2\n%\n"),
    ],
)
def test_what_a_punch_sends_is_read_without_leader_and_trailer(
    came: bytes, tape: Tape, expected: bytes
) -> None:
    near, far = pair()
    for at in range(0, len(came), 5):
        near.write(came[at : at + 5])
    assert read_tape(ByteLine(far), tape, 0.02) == expected


@pytest.mark.parametrize(
    ("came", "tape", "message"),
    [
        (b"", Tape(), "nothing has come"),
        (b"\0\0\0", Tape(), "nothing has come"),
        (b"N1\nN2\n", Tape(percent=True), "no % has come"),
        (b"%\nN1\nN2 10%", Tape(percent=True), "it may have been cut off"),
    ],
)
def test_a_text_that_is_cut_off_is_no_text(came: bytes, tape: Tape, message: str) -> None:
    near, far = pair()
    near.write(came)
    with pytest.raises(PlainFileError, match=message):
        read_tape(ByteLine(far, Patience(start=0.05)), tape, 0.02)


def test_punch_and_reader_understand_each_other() -> None:
    tape = Tape(50, percent=True)
    got = both(lambda line: punch(line, PROGRAM * 200, tape, None), lambda line: read_tape(line, tape, 60))
    assert got == b"%\r\n" + PROGRAM * 200 + b"%\n"
