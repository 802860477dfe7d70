"""An emulated ACR card parses and answers as the guide shows: prompt, echo, the commands of pages 113 to
135.
"""

from pathlib import Path

import pytest

from amp_studio.families.acromill.emulated.card import AcrCard
from amp_studio.transfer.emulated.line_device import DeviceSetup
from amp_studio.transfer.emulated.memory import Memory


class Terminal:
    """A terminal at a card."""

    def __init__(self, folder: Path) -> None:
        self.card = AcrCard(DeviceSetup("acromill", Memory(folder), print))

    def type(self, text: str) -> str:
        self.card.receive(text.encode())
        displayed = b""
        while piece := self.card.answer():
            displayed += piece
        return displayed.decode()

    def execute(self, line: str) -> str:
        """Return what the card shows between the echo and the prompt."""
        displayed = self.type(line + "\r")
        assert displayed.startswith(line + "\r\n"), displayed
        assert displayed.endswith("P00>"), displayed
        return displayed[len(line) + 2 : -4]


@pytest.fixture
def terminal(tmp_path: Path) -> Terminal:
    return Terminal(tmp_path)


@pytest.mark.parametrize(
    ("line", "query", "displayed"),
    [
        ("PPU X4096 Y4096", "PPU Y", "4096\r\n"),
        ("EXC AXIS0 4 AXIS1 4 AXIS2 4", "EXC AXIS2", "4\r\n"),
        ("MULT X-4", "MULT X", "-4\r\n"),
        ("DAC0 GAIN -3276.8", "DAC0 GAIN", "-3276.8\r\n"),
        ("TLM X 2", "TLM X", "2\r\n"),
        ("TLM X4", "TLM X", "4\r\n"),
        ("LOPASS X1000", "LOPASS X", "1000\r\n"),
        ("NOTCH X(500, 50)", "NOTCH X", "500, 50\r\n"),
        ("NOTCH X(100,100)", "NOTCH X", "100, 100\r\n"),
        ("pgain v.08", "PGAIN V", "0.08\r\n"),
        ("FFACC X0.000000199", "FFACC X", "1.99E-07\r\n"),
        ("PGAIN X0.00244140625", "PGAIN X", "0.002441406\r\n"),
        ("BSC X0E.00325", "BSC X", "X0E.00325\r\n"),
        ("P12341=5", "PRINT P12341", "5\r\n"),
        ("P12341=P12336", "? P12341", "0\r\n"),
        ("REM This sets up one of the BiQuads", "PPU X", "10000\r\n"),
    ],
)
def test_a_command_sets_and_its_word_without_a_figure_shows(
    terminal: Terminal, line: str, query: str, displayed: str
) -> None:
    assert terminal.execute(line) == ""
    assert terminal.execute(query) == displayed


@pytest.mark.parametrize(
    ("line", "displayed"),
    [
        ("PPX X4", "Unknown command\r\n"),
        ("X4", "Unknown command\r\n"),
        ("X0E.00325", "Unknown command\r\n"),
        ("GOTO 10", "Not in this emulated card\r\n"),
        ("PPU", "Axis expected\r\n"),
        ("PPU Q4", "Syntax error\r\n"),
        ("PPU X4x", "Syntax error\r\n"),
        ("PPU X1E99", "Number out of range\r\n"),
        ("EXC X4", "Syntax error\r\n"),
        ("NOTCH X(500 50)", "Syntax error\r\n"),
        ("BSC X1E.00325", "Position out of range\r\n"),
        ("BSC X0E0.00325", "Syntax error\r\n"),
        ("P99999=1", "Number out of range\r\n"),
    ],
)
def test_what_the_card_does_not_execute_it_answers_in_words(
    terminal: Terminal, line: str, displayed: str
) -> None:
    assert terminal.execute(line) == displayed


def test_every_sign_is_echoed_and_a_line_is_obeyed_at_its_end(terminal: Terminal) -> None:
    assert terminal.type("PPU X40") == "PPU X40"
    assert terminal.type("\n\x00\x1b") == "", "what is no sign of a line is neither taken nor echoed"
    assert terminal.type("96\r") == "96\r\nP00>"
    assert terminal.execute("PPU X") == "4096\r\n"


def test_half_a_line_of_a_lost_client_is_glued_to_the_next_ones(terminal: Terminal) -> None:
    terminal.type("PPU X40")
    terminal.card.connected()
    assert terminal.type("96\r") == "96\r\nP00>"
    assert terminal.execute("PPU X") == "4096\r\n"


def test_backspaces_take_a_line_back(terminal: Terminal) -> None:
    assert terminal.type("AB\b\b\b\r") == "AB\b \b\b \b\r\nP00>"


def test_a_line_takes_only_so_many_signs(terminal: Terminal) -> None:
    assert len(terminal.type("REM " + "x" * 10_000)) == 128


def test_what_is_not_saved_is_lost_with_the_power(terminal: Terminal, tmp_path: Path) -> None:
    terminal.execute("PPU X4096")
    terminal.execute("BSC X0E.00325")
    terminal.execute("ESAVE")
    terminal.execute("PPU X5000")
    terminal.execute("P3=5")
    assert Terminal(tmp_path).execute("PPU X") == "4096\r\n"
    terminal.card.operate("power")
    assert (terminal.execute("PPU X"), terminal.execute("PRINT P3")) == ("4096\r\n", "0\r\n")
    assert terminal.execute("BSC X") == "X0E.00325\r\n"


def test_a_save_that_is_cut_off_keeps_the_settings_it_came_to(terminal: Terminal, tmp_path: Path) -> None:
    terminal.execute("PPU X4096 Y4096 Z4096")
    steps = iter(range(100))

    def step(_: str) -> None:
        if next(steps) == 2:
            raise KeyboardInterrupt

    terminal.card.settings._memory.on_step = step
    with pytest.raises(KeyboardInterrupt):
        terminal.type("ESAVE\r")
    after = Terminal(tmp_path)
    assert [after.execute(f"PPU {axis}") for axis in "XYZ"] == ["4096\r\n", "4096\r\n", "10000\r\n"]


def test_a_full_memory_is_reported(terminal: Terminal) -> None:
    terminal.card.settings._memory.full_at = 10
    terminal.execute("PPU X4096")
    assert terminal.execute("ESAVE") == "EEPROM failure (No space left on device)\r\n"


def test_the_version_and_the_prompt_of_another_program(terminal: Terminal) -> None:
    assert terminal.execute("VER") == "ACR8000 (c) 1993-1998 by AMCS Inc.\r\nVersion 1.17.08 CARD 0\r\n"
    assert "Commands: ? ABS ACC" in terminal.execute("HELP")
    assert terminal.type("PROG3\r") == "PROG3\r\nP03>"
