"""The machine behind an emulated Grbl: blocks, jogs, $H and its alarms come over its protocol."""

import re
from pathlib import Path

import pytest

from amp_studio.families.grblhal.emulated.firmware import Firmware
from amp_studio.transfer.emulated.line_device import DeviceSetup
from amp_studio.transfer.emulated.memory import Memory

SETTINGS = "$22=3 $20=1 $23=0 $24=120 $25=1200 $27=2 $44=4 $45=3 " + " ".join(
    f"${first + n}={value}"
    for first, value in ((100, 80), (110, 6000), (120, 500), (130, 300))
    for n in range(3)
)


class Bench:
    """A control and the clock of its machine."""

    def __init__(self, folder: Path, machine: str | None = None) -> None:
        self.firmware = Firmware(DeviceSetup("grblhal", Memory(folder), print, machine))
        self.read()
        for line in SETTINGS.split():
            self.identity_word(line)

    def read(self) -> str:
        return b"".join(iter(self.firmware.answer, b"")).decode()

    def identity_word(self, line: str) -> str:
        self.firmware.receive(line.encode() + b"\n")
        return self.read().strip()

    def after(self, seconds: float) -> str:
        for _ in range(round(seconds / 0.1)):
            self.firmware.advance(0.1)
        return self.read().strip()

    def status(self) -> tuple[str, list[float]]:
        self.firmware.receive(b"?")
        found = re.search(r"<([^|]+)\|MPos:([-0-9.,]+)", self.read())
        assert found is not None
        return found[1], [float(each) for each in found[2].split(",")]


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path)


def test_a_block_moves_the_axes_in_a_line_and_the_state_follows(bench: Bench) -> None:
    assert bench.identity_word("G91 G1 X30 Y-40 F3000") == "ok"
    bench.after(0.5)
    state, (x, y, _) = bench.status()
    assert state == "Run"
    assert 0.0 < x < 30.0
    assert y == pytest.approx(-x * 4.0 / 3.0, abs=0.2)
    bench.after(3.0)
    assert bench.status() == ("Idle", [pytest.approx(30.0, abs=0.02), pytest.approx(-40.0, abs=0.02), 0.0])


def test_a_setting_is_not_taken_while_it_moves(bench: Bench) -> None:
    bench.identity_word("G0 X50")
    assert bench.identity_word("$110=100") == "error:8"


def test_homing_is_answered_at_its_end_and_gives_the_machine_its_place(bench: Bench) -> None:
    """machine_limits.c: seek, pull-off, locate, pull-off; -$27 where the switch is at the plus end."""
    assert bench.identity_word("$H") == ""
    bench.after(0.2)
    assert bench.status()[0] == "Home"
    assert bench.after(60.0) == "ok"
    assert bench.status() == ("Idle", [pytest.approx(-2.0, abs=0.02)] * 3)


def test_a_switch_that_is_too_far_off_is_alarm_9(bench: Bench) -> None:
    bench.identity_word("$H")
    bench.after(60.0)
    bench.identity_word("G91 G0 X-50 Y-50 Z-50")
    bench.after(60.0)
    for axis in range(3):
        bench.identity_word(f"${130 + axis}=2")  # 1.5 times the travel is searched
    bench.identity_word("$H")
    assert bench.after(30.0) == "ALARM:9\r\nerror:9"
    assert bench.status()[0] == "Alarm"


def test_a_move_beyond_the_travel_of_a_homed_axis_is_alarm_2_and_a_jog_is_refused(bench: Bench) -> None:
    bench.identity_word("$H")
    bench.after(60.0)
    assert bench.identity_word("$J=G91 X-400 F1000") == "error:15"
    assert bench.identity_word("G90 G0 X-400") == "error:15", "G-code waits until a command is taken"
    bench.identity_word("$X")
    assert bench.identity_word("G90 G0 X-400").startswith("ALARM:2")
    assert bench.status()[0] == "Alarm"


def test_a_jog_is_cancelled_and_a_hold_is_taken_up_again(bench: Bench) -> None:
    assert bench.identity_word("$J=G91 X200 F3000") == "ok"
    bench.after(1.0)
    bench.firmware.receive(b"\x85")
    bench.after(1.0)
    state, places = bench.status()
    assert state == "Idle"
    assert 20.0 < places[0] < 80.0
    bench.identity_word("G91 G0 X50")
    bench.after(0.3)
    bench.firmware.receive(b"!")
    bench.after(1.0)
    current = bench.status()
    assert current[0] == "Hold:0"
    bench.firmware.receive(b"~")
    bench.after(3.0)
    assert bench.status() == ("Idle", [pytest.approx(places[0] + 50.0, abs=0.02), 0.0, 0.0])
    assert current[1][0] < bench.status()[1][0]


@pytest.mark.parametrize(
    ("line", "answer"),
    [
        ("$J=G91 X10", "error:22"),
        ("$J=F100", "error:16"),
        ("G1 X10", "error:22"),
        ("G1 X1.52.25 F100", "error:20"),
        ("G10 L2 P1 X1.52.25", "error:20"),
        ("$J=G91 X-2..25 F100", "error:20"),
    ],
)
def test_a_move_that_lacks_something_is_refused(bench: Bench, line: str, answer: str) -> None:
    assert bench.identity_word(line) == answer


def test_homing_that_is_off_is_refused(bench: Bench) -> None:
    bench.identity_word("$22=0")
    assert bench.identity_word("$H") == "error:5"


@pytest.mark.parametrize(("alarm", "answer"), [("2", "error:79"), ("17", "error:79"), ("9", "ok")])
def test_a_critical_alarm_is_ended_by_a_reset_alone(bench: Bench, alarm: str, answer: str) -> None:
    """alarms.h, and measured on the firmware after G0X500 beyond its soft limits: $X gives error:79, $$ its
    settings.
    """
    bench.firmware.operate(f"alarm {alarm}")
    bench.read()
    assert bench.identity_word("$X") == answer
    assert bench.identity_word("$$").endswith("ok")
    bench.firmware.receive(b"\x18")
    bench.read()
    assert bench.identity_word("$X").endswith("ok")
    assert bench.status()[0] == "Idle"


def test_a_grbl_1_1_takes_nothing_after_a_critical_alarm_until_its_reset(tmp_path: Path) -> None:
    """protocol.c of Grbl 1.1 waits for the reset in a loop that reads no line and reports nothing."""
    bench = Bench(tmp_path, "grbl-1.1")
    bench.firmware.operate("alarm 2")
    assert bench.read() == "ALARM:2\r\n[MSG:Reset to continue]\r\n"
    assert bench.identity_word("$X") == bench.identity_word("$$") == bench.identity_word("?") == ""
    bench.firmware.receive(b"\x18")
    assert "Grbl 1.1" in bench.read()
    assert bench.status()[0] == "Alarm"
    assert (bench.identity_word("G0 X1"), bench.identity_word("$X")) == ("error:9", "ok")


def test_a_block_that_goes_on_after_a_hold_is_a_run_and_no_setting_is_taken_in_it(bench: Bench) -> None:
    """As the real firmware shows after ``~``; it was Idle, in which a moving axis got other settings."""
    bench.identity_word("G91 G1 X200 F3000")
    bench.after(1.0)
    bench.firmware.receive(b"!")
    bench.after(1.0)
    assert bench.status()[0] == "Hold:0"
    bench.firmware.receive(b"~")
    bench.after(0.2)
    assert bench.status()[0] == "Run"
    assert bench.identity_word("$120=50") == "error:8"
    bench.after(5.0)
    assert bench.status() == ("Idle", [pytest.approx(200.0, abs=0.02), 0.0, 0.0])
