"""An emulated NUM control refuses what the control refuses, and shows the messages of pages 13-10 to
13-13.
"""

from pathlib import Path

import pytest

from amp_studio.families.num.emulated.control import FILE_ERROR, NumControl
from amp_studio.transfer.emulated.line_device import DeviceSetup
from amp_studio.transfer.emulated.memory import Memory

XON, XOFF = b"\x11", b"\x13"


class Bench:
    """A control without a line: what its screen has shown, and its keys."""

    def __init__(self, folder: Path) -> None:
        self.screen: list[str] = []
        self.control = NumControl(DeviceSetup("num", Memory(folder), self.screen.append))
        self.control.operate("parity none")

    def press(self, *keys: str) -> None:
        for key in keys:
            self.screen.append(self.control.operate(key))

    def unload(self, *keys: str) -> bytes:
        self.press("unload", "enter", *keys, "start")
        table = b""
        while piece := self.control.answer():
            table += piece
        return table

    def send(self, table: bytes) -> bytes:
        """Send a table in pieces, and wait where the control stops it; returns what it has sent."""
        message = b""
        for at in range(0, len(table), 200):
            self.control.receive(table[at : at + 200])
            message += self.control.answer()
        return message


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path)


def line(text: str) -> bytes:
    return f"{text};{len(text):02X}\n".encode()


def test_an_unload_shows_the_job_reference_and_ends_with_xoff_in_the_menu(bench: Bench) -> None:
    table = bench.unload()
    assert table.startswith(b"%00000000;09\nP0N0:t6n1;09\n#00000000;09\nP1N0:t6n2;09\n")
    assert table.endswith(b"\n" + XOFF)
    assert bench.screen == [
        "dialogue line: READY?",
        "dialogue line: %00000000",
        "(sending)",
        "MACHINE SETUP DATA",
    ]


def test_the_operator_may_edit_the_job_reference_and_add_a_comment(bench: Bench) -> None:
    assert bench.unload("reference 12345678", "comment mill 7").startswith(b"%12345678 mill 7;10\n")


def test_what_was_unloaded_is_loaded_verified_and_outlasts_the_power(bench: Bench, tmp_path: Path) -> None:
    table = bench.unload().replace(line("#00000000"), line("#00000007"), 1)
    bench.press("load", "enter")
    assert bench.send(table).startswith(XON)
    assert bench.screen[-1] == "MACHINE SETUP DATA"
    after = Bench(tmp_path)
    assert after.unload() == table
    after.press("verify", "enter")
    after.send(table)
    assert [displayed for displayed in after.screen if "(VERI)" in displayed][:2] == [
        "(VERI) P0",
        "(VERI) P1",
    ]
    assert after.screen[-1] == "MACHINE SETUP DATA"


def test_another_identification_number_stops_the_load_until_it_is_the_job_reference(bench: Bench) -> None:
    table = b"%00000001;09\n" + bench.unload().partition(b"\n")[2]
    bench.press("load", "enter")
    bench.control.receive(table[:100])
    assert bench.control.answer() == XON + XOFF
    assert bench.screen[-1] == "dialogue line: %00000001"
    bench.press("reference 00000002")
    assert bench.screen[-1] == "dialogue line: %00000002"
    assert bench.control.answer() == b"", "it is still held"
    bench.press("reference 00000000")
    assert bench.control.answer() == XON
    bench.send(table[100:])
    assert bench.screen[-1] == "MACHINE SETUP DATA"


@pytest.mark.parametrize(
    ("table", "fault"),
    [
        (b"%00000000;0A\n", "[line 1: 9 characters, 0A given]"),
        (b"%0000000;08\n", "[line 1: the table does not begin with % and eight digits]"),
        (b"%00000000\n", "[line 1: no length at the end of the line]"),
        (line("%00000000") + line("P200N0:t0n1"), "[line 2: this control has no P200]"),
        (line("%00000000") + line("P9N0:t6n32"), "[line 2: P9 is t0n32 here]"),
        (line("%00000000") + line("P9N32:t0n32"), "[line 2: P9 has 32 words]"),
        (line("%00000000") + line("#0"), "[line 2: a data line without a header]"),
        (line("%00000000") + line("P9N30:t0n32") + line("#0 0 0"), "[line 3: P9 has 32 words]"),
        (line("%00000000") + line("P9N0:t0n32") + line("#0 100"), "[line 3: 100 is no word of type 0]"),
        (
            line("%00000000") + line("P9N0:t0n32") + line("#" + " ".join("0" * 11)),
            "[line 3: more than 10 values]",
        ),
        (
            line("%00000000") + line("P9N0:t0n32") + line("P10N0:t0n32"),
            "[P9: P9N0:t0n32 without its data line]",
        ),
        (line("%00000000") + line("P9N0:t0n32") + XOFF, "[P9: the table ends within a line]"),
        (b"%" + b"0" * 400, "[line 1: a line without an end]"),
    ],
)
def test_a_bad_line_stops_the_load_with_file_error(bench: Bench, table: bytes, fault: str) -> None:
    bench.press("load", "enter")
    assert bench.send(table).endswith(XOFF)
    assert bench.screen[-1] == f"dialogue line: {FILE_ERROR}  {fault}"


def test_a_check_stops_at_the_word_that_differs(bench: Bench) -> None:
    bench.press("verify", "enter")
    bench.send(line("%00000000") + line("P9N0:t0n32") + line("#0 1"))
    assert bench.screen[-2:] == ["(VERI) P9", f"dialogue line: {FILE_ERROR}  [line 3: P9N1 differs]"]


def test_bytes_before_the_control_is_ready_are_not_read(bench: Bench) -> None:
    bench.send(line("%00000000"))
    bench.press("load")
    bench.send(line("%00000000"))
    assert bench.screen == ["dialogue line: READY?"]
    bench.press("enter")
    bench.send(b"\0\0\r\n" + line("%00000000") + XOFF)
    assert bench.screen[-1] == "MACHINE SETUP DATA"


def test_a_character_of_the_other_parity_is_refused(bench: Bench) -> None:
    bench.press("parity even", "load", "enter")
    assert bench.send(b"\xa5\x30\x30\x31") == b"\x11\x93"
    assert bench.screen[-1] == f"dialogue line: {FILE_ERROR}  [line 1: a character with a parity error]"
    assert bench.unload()[:3] == b"\xa5\x30\x30", "% has three ones: with even parity it is A5"


@pytest.mark.parametrize(
    ("baud", "stop", "is_read"), [(9_600, 2, True), (9_600, 1, False), (4_800, 2, False)]
)
def test_another_rate_and_fewer_stop_bits_make_no_characters(
    bench: Bench, baud: int, stop: int, is_read: bool
) -> None:
    bench.press("line 9600 2", "load", "enter")
    bench.control.line_set(baud, stop)
    bench.send(line("%00000000") + XOFF)
    assert (bench.screen[-1] == "MACHINE SETUP DATA") is is_read
    assert ("without its stop bits" in bench.screen[-1]) is not is_read


def test_the_peripheral_stops_an_unload_with_xoff(bench: Bench) -> None:
    bench.press("unload", "enter", "start")
    first = bench.control.answer()
    bench.control.receive(XOFF)
    assert bench.control.answer() == b""
    bench.control.receive(XON)
    assert bench.control.answer() not in (b"", first)


def test_what_comes_while_the_control_has_stopped_the_peripheral_is_kept_up_to_its_buffer(
    bench: Bench,
) -> None:
    bench.press("load", "enter")
    bench.control.answer()
    bench.control.receive(line("%00000001") + b"\0" * 100_000)
    assert len(bench.control._later) == 4_096


def test_a_cut_load_leaves_the_lines_that_came_whole(bench: Bench, tmp_path: Path) -> None:
    bench.press("load", "enter")
    bench.send(line("%00000000") + line("P9N0:t0n32") + line("#7 8") + b"P9N10:t0n32;0B\n#5 5")
    words = Bench(tmp_path).control._parameters.words[9]
    assert words[:3] == ["7", "8", "0"]
    assert words[10] == "0"


def test_a_full_memory_stops_the_load(bench: Bench) -> None:
    bench.control._parameters._memory.full_at = 10
    bench.press("load", "enter")
    bench.send(line("%00000000") + line("P9N0:t0n32") + line("#7 8"))
    assert bench.screen[-1].endswith("[line 3: the memory takes nothing more: No space left on device]")


def test_a_folder_of_something_else_is_refused(tmp_path: Path) -> None:
    (tmp_path / "table").write_bytes(b"no table\n")
    with pytest.raises(ValueError, match="is not what an emulated control writes"):
        Bench(tmp_path)
