"""What breaks while an ACR card saves (ESAVE): what is then reported of the card, and what is set and saved
again."""

import threading
from collections.abc import Callable
from pathlib import Path

import pytest

from amp_studio.files import ParameterFile
from amp_studio.transfer.errors import (
    CancelledError,
    Confirmed,
    ConnectionCutError,
    ControlSilentError,
    TransferError,
)
from amp_studio.transfer.links.link import Link, LinkError

from .bench import CardBench
from .test_terminal_driver import send, small_file

NOT_KNOWN = "whether the card has saved it is not known"


@pytest.fixture
def bench(tmp_path: Path) -> CardBench:
    return CardBench(tmp_path)


def two_values_and_a_table() -> ParameterFile:
    return small_file(pgain="0.08", ppu="4096", table="X0E.00325 X1E-.00100")


def at_line(bench: CardBench, line: str, event: Callable[[int, Callable[[], None]], None]) -> None:
    """Have ``event`` happen where the card is to obey a line: it gets how often that was, and what the card
    does.
    """
    count = 0

    def wrapped(link: Link) -> Link:
        card, execute = bench.card, bench.card._execute
        if "_execute" in vars(card):  # since an earlier line to it
            return link

        def executed() -> None:
            nonlocal count
            if card._line.decode() != line:
                return execute()
            count += 1
            return event(count, execute)

        card._execute = executed
        return link

    bench.wrap = wrapped


def test_a_card_that_loses_its_power_in_its_save_is_set_again_with_its_table_and_saved(
    bench: CardBench,
) -> None:
    def power_fails(count: int, execute: Callable[[], None]) -> None:
        if count == 1:
            bench.switch_on()
            bench.lines[-1].close()
        else:
            execute()

    at_line(bench, "ESAVE", power_fails)
    assert send(bench, two_values_and_a_table(), []).verified
    saved = bench.switch_on().settings
    assert (saved.values["PPU X"], saved.values["PGAIN X"]) == ("4096", "0.08")
    assert dict(bench.driver._ballscrew("X")) == {"BSC X0": ".00325", "BSC X1": "-.00100"}


def test_a_line_that_breaks_at_each_save_leaves_it_unknown(bench: CardBench) -> None:
    def breaks(count: int, execute: Callable[[], None]) -> None:
        execute()
        if count % 2:
            bench.lines[-1].close()

    at_line(bench, "ESAVE", breaks)
    with pytest.raises(
        ConnectionCutError, match=f"breaks each time the card is to save; {NOT_KNOWN}"
    ) as caught:
        send(bench, small_file(pgain="0.08", ppu="4096"), [])
    assert (caught.value.at_control, caught.value.confirmed) == ("unknown", Confirmed(2, 2))


def test_a_save_that_is_not_answered_is_reported_beside_what_the_card_contains(bench: CardBench) -> None:
    at_line(bench, "ESAVE", lambda count, execute: bench.card._line.clear())
    with pytest.raises(ControlSilentError, match=f"does not take 'ESAVE'.*; {NOT_KNOWN}") as caught:
        send(bench, small_file(pgain="0.08", ppu="4096"), [])
    assert (caught.value.at_control, caught.value.confirmed) == ("new", Confirmed(2, 2))


def test_ctrl_c_in_the_save_does_not_say_that_nothing_is_saved(bench: CardBench) -> None:
    cancel = threading.Event()
    at_line(bench, "ESAVE", lambda count, execute: (execute(), cancel.set(), bench.card._out.clear()))
    with pytest.raises(CancelledError, match=NOT_KNOWN) as caught:
        send(bench, small_file(ppu="4096"), [], cancel)
    assert caught.value.at_control == "new"
    assert "nothing of it is saved" not in str(caught.value)


def test_a_save_may_take_longer_than_a_setting(bench: CardBench) -> None:
    def slowly(count: int, execute: Callable[[], None]) -> None:
        saves.append(count)
        execute()
        answer, end = bench.card.answer, bench.clock.now + 25
        bench.card.answer = lambda: answer() if bench.clock.now >= end else b""

    saves: list[int] = []
    at_line(bench, "ESAVE", slowly)
    assert send(bench, small_file(ppu="4096"), []).verified
    assert saves == [1], "it is not sent again while the card saves"


def test_a_line_that_breaks_under_a_command_names_the_setting_that_may_be_there(bench: CardBench) -> None:
    """The write fails and has reached the card: a driver that takes notice after it knows of nothing sent."""

    class BreaksBehind:
        bytes_per_second = None

        def __init__(self, link: Link) -> None:
            self._link, self._last = link, b""
            self.read, self.close = link.read, link.close

        def write(self, data: bytes) -> None:
            self._link.write(data)
            if self._last == b"PPU X4096":
                bench.is_up = False
                raise LinkError("bench", "the line is cut")
            self._last = data

    bench.wrap = BreaksBehind
    with pytest.raises(TransferError) as caught:
        send(bench, small_file(pgain="0.08", ppu="4096"), [])
    assert bench.card.settings.values["PPU X"] == "4096"
    assert (caught.value.at_control, caught.value.confirmed) == ("unknown", Confirmed(0, 2, "PPU X"))
    assert "the card loses it with its power" in str(caught.value)
