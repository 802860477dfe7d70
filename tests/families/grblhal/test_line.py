"""The line to a Grbl control: what others left on it, what comes unasked, silence and nonsense."""

import threading
from collections.abc import Callable, Iterable
from pathlib import Path

import pytest

from amp_studio.families.grblhal.line import GrblLine, GrblRefusalError, GrblRestartedError
from amp_studio.transfer.errors import (
    CancelledError,
    ControlSilentError,
    NoConnectionError,
    ProtocolMismatchError,
)
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.links.link import Link, LinkError
from amp_studio.transfer.waiting import Waiting
from tests.families.grblhal.bench import Bench, Clock


class Script:
    """A line that gives prepared answers, one to each line that it gets; ``wrote`` are those lines."""

    bytes_per_second = None

    def __init__(self, answers: Iterable[bytes]) -> None:
        self.clock = Clock()
        self.wrote: list[bytes] = []
        self._answers = iter(answers)
        self._out = b""

    def open(self, look: Callable[[], None]) -> Link:
        return self

    def read(self, timeout: float) -> bytes:
        data, self._out = self._out, b""
        if not data:
            self.clock.now += timeout
        return data

    def write(self, data: bytes) -> None:
        if data.endswith(b"\n"):  # not the question for the state alone
            self.wrote.append(data)
            self._out += next(self._answers, b"")

    def close(self) -> None:
        self._out = b""

    def line(self, cancel: threading.Event | None = None, **options: object) -> GrblLine:
        waiting = Waiting(self.clock, self.clock.sleep)
        waiting.begin(Exchange(cancel=cancel, **options))
        return GrblLine(self.open, waiting)


def test_half_a_line_of_a_lost_client_is_erased_and_stores_nothing(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    bench.firmware.receive(b"$130=3")
    line = GrblLine(bench.open, Waiting(bench.clock, bench.clock.sleep))
    assert line.ask("$130") == ["$130=200.000"]


def test_a_grbl_that_knows_no_delete_refuses_the_half_line_as_too_long(tmp_path: Path) -> None:
    bench = Bench(tmp_path, "grbl-1.1")
    bench.firmware.receive(b"$130=3")
    line = GrblLine(bench.open, Waiting(bench.clock, bench.clock.sleep))
    assert "$130=200.000" in line.ask("$$")


def test_a_program_goes_on_after_a_question(tmp_path: Path) -> None:
    """A grblHAL that has refused a line refuses all G-code until a command is taken."""
    bench = Bench(tmp_path)
    while bench.firmware.answer():
        pass
    bench.firmware.receive(b"$NOTHING\nG21\n")
    assert bench.firmware.answer() == b"error:3\r\nerror:3\r\n"
    GrblLine(bench.open, Waiting(bench.clock, bench.clock.sleep)).report()
    while bench.firmware.answer():
        pass
    bench.firmware.receive(b"G21\n")
    assert bench.firmware.answer() == b"ok\r\n"


def test_a_late_answer_to_the_empty_line_is_none_to_the_next_command() -> None:
    script = Script([b"error:3\r\n", b"ok\r\n[VER:1]\r\nok\r\n", b"$0=5.0\r\nok\r\n"])
    line = script.line()
    assert [line.ask("$I"), line.ask("$0")] == [["[VER:1]"], ["$0=5.0"]]


def test_what_was_asked_by_another_client_is_no_answer_to_this_one() -> None:
    script = Script([b"$0=5.0\r\nok\r\n$1=25\r\nok\r\nerror:3\r\n", b"[VER:1.1f.20260817:]\r\nok\r\n"])
    assert script.line().ask("$I") == ["[VER:1.1f.20260817:]"]


def test_a_start_with_lost_settings_is_noticed_before_the_first_answer() -> None:
    script = Script(
        [b"error:7\r\n\r\nGrblHAL 1.1f ['$' or '$HELP' for help]\r\nerror:3\r\n", b"[VER:1]\r\nok\r\n"]
    )
    line = script.line()
    assert (line.has_lost_memory, line.ask("$I")) == (True, ["[VER:1]"])


def test_a_board_that_restarts_when_its_port_is_opened_is_asked_again() -> None:
    script = Script([b"", b"\r\nGrbl 1.1h ['$' for help]\r\nerror:3\r\n", b"[VER:1.1h]\r\nok\r\n"])
    assert script.line().ask("$I") == ["[VER:1.1h]"]
    assert len(script.wrote) == 3


def test_late_answers_to_a_first_line_that_was_sent_twice_are_none_to_the_next_command() -> None:
    script = Script([b"", b"error:3\r\n", b"error:3\r\n[VER:1]\r\nok\r\n", b"error:3\r\n"])
    line = script.line()
    assert line.ask("$I") == ["[VER:1]"]
    with pytest.raises(GrblRefusalError):
        line.ask("$Q")


def test_pushed_lines_are_no_answers_and_are_remembered() -> None:
    pushed = (
        b"ALARM:1\r\n[MSG:Caution:"
        b" Unlocked]\r\n<Alarm|MPos:0.000,0.000,0.000>\r\n$0=5.0\r\n[MSG:\x1b[2J]\r\nok\r\n"
    )
    line = Script([b"error:3\r\n", pushed]).line()
    assert line.ask("$0") == ["$0=5.0"]
    assert (line.alarm, line.messages) == (1, ["Caution: Unlocked", "\\u001b[2J"])


def test_an_error_is_the_answer_with_its_command() -> None:
    with pytest.raises(GrblRefusalError) as caught:
        Script([b"error:3\r\n", b"error:53\r\n"]).line().ask("$999=1")
    assert (caught.value.code, caught.value.command) == (53, "$999=1")


def test_a_greeting_in_an_answer_is_a_restart() -> None:
    with pytest.raises(GrblRestartedError):
        Script([b"error:3\r\n", b"$0=5.0\r\nGrblHAL 1.1f ['$' or '$HELP' for help]\r\n"]).line().ask("$$")


@pytest.mark.parametrize("answer", [b"", b"$0=5.0\r\n", b"o", b"<Idle>\r\n" * 3])
def test_silence_ends_every_wait_and_is_shown(answer: bytes) -> None:
    reported: list[tuple[str, int]] = []
    script = Script([b"error:3\r\n", answer])
    line = script.line(progress=lambda stage, done, total: reported.append((stage, done)))
    began = script.clock.now
    with pytest.raises(ControlSilentError, match="the control has not answered for 8 s"):
        line.ask("$$")
    assert script.clock.now - began < 9
    assert ("silent", 2) in reported


@pytest.mark.parametrize("answer", [b"x" * 20_000, b"[x]\r\n" * 300_000])
def test_an_answer_without_an_end_is_cut_off(answer: bytes) -> None:
    with pytest.raises(ProtocolMismatchError, match="without an end"):
        Script([b"error:3\r\n", answer]).line().ask("$$")


def test_nothing_answers_at_all() -> None:
    script = Script([])
    with pytest.raises(ControlSilentError):
        script.line()
    assert script.clock.now < 13


def test_no_line_is_no_connection() -> None:
    def fails(look: Callable[[], None]) -> Link:
        raise LinkError("tcp://127.0.0.1:1", "nothing listens there")

    with pytest.raises(NoConnectionError, match="nothing listens there"):
        GrblLine(fails, Waiting())


def test_who_stops_waits_no_longer_than_a_moment() -> None:
    cancel = threading.Event()
    script = Script([b"error:3\r\n"])
    line = script.line(cancel=cancel)
    cancel.set()
    began = script.clock.now
    with pytest.raises(CancelledError):
        line.ask("$$")
    assert script.clock.now == began, "nothing is sent any more"


def test_a_setting_under_way_is_seen_through_for_a_moment_and_no_longer() -> None:
    cancel = threading.Event()
    script = Script([b"error:3\r\n", b""])
    line = script.line(cancel=cancel)
    original = script.write
    script.write = lambda data: (original(data), cancel.set())
    began = script.clock.now
    with pytest.raises(CancelledError):
        line.ask("$130=5", writes=True)
    assert script.clock.now - began == pytest.approx(0.2, abs=0.06)
