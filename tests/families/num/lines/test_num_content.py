"""The table of a NUM control keeps its form whatever it is, when a file's values are put into it."""

import re

import pytest

from amp_studio.families.num.lines.content import NumTableContent, content_of_table
from amp_studio.files import ParameterFile
from amp_studio.schema import load_schema
from amp_studio.schema.storage import value_of_stored
from amp_studio.transfer.image import ImageError

LINES = (
    "%00000000",
    "P0N0:t6n1",
    "#00000000",
    "P9N0:t0n32",
    "#0 1 2 FF FF FF FF FF FF FF",
    "P13N0:t5n18",
    "#0 0 0 0 0",
)


def measured(*lines: str, end: str = "\n") -> str:
    return "".join(f"{line};{len(line):02X}{end}" for line in lines) + "\x13"


def small_file() -> ParameterFile:
    file = ParameterFile(load_schema("num"))
    for number, word in (("P9N0", 5), ("P13N2", 9)):
        address = file.find(number)
        file.take({address: value_of_stored(file.schema.parameters[address[0]], word, turns=False)})
    return file


@pytest.mark.parametrize(
    "table",
    [
        measured(*LINES),
        measured(*LINES, end="\r\n"),
        measured(*(re.sub(":t.*", "", line) for line in LINES)),
        measured(*LINES, "P200N0:t1n3", "#1 2 3"),
        measured(LINES[0], *LINES[3:5], *LINES[1:3], *LINES[5:]),
        measured(*LINES[:4], "#00 01 02", *LINES[5:]),
        measured("%12345678", *LINES[1:]),
    ],
    ids=[
        "as the control sends it",
        "CR LF",
        "before index K",
        "unknown words",
        "another order",
        "zeros",
        "a reference",
    ],
)
def test_only_the_words_of_the_file_change(table: str) -> None:
    kind, current = NumTableContent(), content_of_table(table)
    content = kind.encode(small_file(), current)
    assert kind.difference(current, content) == "in P9N0, P13N2"
    assert content.count(b"\n") == current.count(b"\n")
    assert kind.encode(small_file(), content) == content
    assert kind.refit(current, content) == current


def test_a_line_end_before_xoff_and_a_remark_make_no_other_content() -> None:
    plain = content_of_table(measured(*LINES))
    assert content_of_table(measured(*LINES).replace("\n\x13", "\x13")) == plain
    assert content_of_table(measured("%00000000 mill 7", *LINES[1:])) == plain
    windows = measured(*LINES, end="\r\n")
    assert content_of_table(windows.replace("\r\n\x13", "\x13")) == content_of_table(windows)


@pytest.mark.parametrize(
    "content", [b"", b"NUM table 2\n", b"NUM table 1\n", b"NUM table 1\n\xff\x13", b"NUM table 1\n%1\x13"]
)
def test_what_is_no_table_is_refused(content: bytes) -> None:
    with pytest.raises(ImageError):
        NumTableContent().decode(content)


def test_a_table_of_the_same_cnc_that_lacks_words_of_the_last_copy_is_short() -> None:
    kind, whole = NumTableContent(), content_of_table(measured(*LINES))
    short = content_of_table(measured(*LINES[:5]))
    assert kind.lacks(short, whole) == "P13N0, P13N1, P13N2, P13N3, P13N4"
    assert kind.lacks(whole, short) == ""
    assert kind.lacks(short, content_of_table(measured("%12345678", *LINES[1:]))) == ""
