"""A drive that trips, and feedback that is lost: in a scenario, and at an emulated control, with its
words."""

from pathlib import Path

import pytest

from amp_studio.schema import Value
from amp_studio.sim import FileMachine, SimulationError, Trace, bind_axis, law_of, simulate
from tests.families.grblhal.test_emulated_motion import Bench as GrblBench
from tests.families.ninepc.test_emulated_machine_keys import Bench as PanelBench
from tests.families.test_emulated_moves import module_of, press
from tests.programs.test_block import example


def fault(name: str, axis: str, **move: float | str) -> Trace:
    settings = {f"move.{key}": value for key, value in move.items()}
    return simulate(example(name), "fault", axis, settings, advise=False)


@pytest.mark.parametrize(
    ("name", "axis", "kind", "code"),
    [
        ("57c422b-label-press", "X", "drive", "DRIVE FAULT"),
        ("mill-1394", "1", "drive", "SERVO AMPLIFIER FAULT"),
        ("num-1060-mill", "0", "feedback", "210 to 241"),
        ("num-1060-mill", "0", "drive", "40 to 71"),
        ("syntec-mill", "1", "drive", "MOT-019"),
        ("acromill-router", "X", "drive", "NO ALARM"),
        ("grblhal-router", "X", "drive", "ALARM:17"),
    ],
)
def test_a_control_shows_its_own_words(name: str, axis: str, kind: str, code: str) -> None:
    """Informed of it, at once; without a page for that, once the following error is beyond its limit, which
    the router has not set.
    """
    trace = fault(name, axis, fault=kind)
    assert trace.alarms[-1].code == code
    assert trace.result["run_out"][0] > 0.0
    is_informed = not any("shows it" in note for note in trace.assumptions)
    noticed = trace.result["noticed_after"][0]
    assert (noticed is not None and noticed < 0.003) == is_informed


def test_a_control_that_is_informed_lets_the_axis_run_out_as_long_as_one_that_is_not() -> None:
    """It was watched for 0.05 s alone, so that the run-out was the speed times that, whatever the machine."""
    free, braked = (
        fault("mill-1394", "3"),
        simulate(example("mill-1394"), "fault", "3", {"model.brake": 30.0}),
    )
    assert any("still moves 2 s" in note for note in free.assumptions)
    assert not any("still moves 2 s" in note for note in braked.assumptions)
    assert free.columns["time_s"][-1] - free.alarms[0].time_s == pytest.approx(2.0, abs=0.01)
    assert abs(braked.columns["velocity"][-1]) < 0.01 * braked.move["move.feedrate"]


def test_without_its_input_a_module_notices_a_drive_by_its_following_error() -> None:
    """57C422B, 4-37: the bit comes only if the input is enabled in register 2."""
    file = example("57c422b-label-press")
    file.set(("setup.switches", "X"), Value(0))
    trace = simulate(file, "fault", "X", {}, advise=False)
    assert trace.alarms[-1].code in ("POSITION ERROR", "VELOCITY ERROR")


def test_what_no_page_prints_is_refused() -> None:
    with pytest.raises(SimulationError, match="in no manual here"):
        fault("mill-1394", "1", fault="feedback")
    with pytest.raises(SimulationError, match="drive or feedback"):
        fault("mill-1394", "1", fault="warp")
    with pytest.raises(SimulationError, match="behind the end"):
        fault("mill-1394", "1", fault_time=1000.0)


def test_a_servo_alarm_puts_a_9pc_into_e_stop_until_its_reset(tmp_path: Path) -> None:
    """7-20; on the screen with cause, cure, parameters and page."""
    bench = PanelBench(tmp_path / "state")
    try:
        bench.give("jog X+ highest")
        bench.after(0.4)
        assert bench.give("fault drive X") == "fault drive X: SERVO AMPLIFIER FAULT".replace(
            "fault drive", "drive fault of"
        )
        bench.after(0.5)
        status = bench.panel.screen(bench.control)
        assert status.state == "E-STOP"
        assert [(each.code, each.page) for each in status.faults] == [("SERVO AMPLIFIER FAULT", "10-3")]
        assert status.faults[0].causes
        assert status.faults[0].params
        with pytest.raises(ValueError, match="E-stop"):
            bench.give("jog X+ highest")
        bench.control.set_estop(False)
        bench.after(0.1)
        assert not bench.panel.screen(bench.control).faults
        bench.give("jog X+ highest")
        assert "moving" in bench.after(0.3)
    finally:
        bench.control.close()


def test_a_drive_fault_of_a_module_is_bit_3_until_the_loop_is_switched_on_again() -> None:
    file = press()
    file.set(("setup.switches", "X"), Value(0x11C))
    bench = module_of(file, 0)
    bench.module.write(65, 5)
    bench.module.advance(0.2)
    bench.module.trip(0)
    bench.module.advance(0.1)
    assert bench.module.read(73) == 1 << 3 | 1 << 6  # the feedback fault beside it (4-38)
    bench.module.write(65, 0)
    bench.module.write(65, 1)
    assert bench.module.read(73) == 0


def test_a_tripped_drive_has_no_torque_until_it_is_reset() -> None:
    """NUM: nothing is printed of the drive, so that the next move shows it as a following error."""
    file = example("num-1060-mill")
    machine = FileMachine(law_of("num"), bind_axis)
    machine.take(file)
    assert "not noticed" in machine.fail("X", "drive")
    machine.jog("X", 1.0, "normal")
    machine.advance(1.0)
    assert next(machine.axes()).alarm[0] == "40 to 71"
    machine.reset()
    machine.jog("X", 1.0, "normal")
    machine.advance(0.5)
    assert next(machine.axes()).alarm is None
    assert next(machine.axes()).position > 1.0


def test_an_alarm_of_a_grbl_stops_what_moves(tmp_path: Path) -> None:
    bench = GrblBench(tmp_path)
    bench.identity_word("G91 G1 X100 F3000")
    bench.after(0.5)
    bench.firmware.operate("alarm 17")
    state, places = bench.status()
    bench.after(0.5)
    assert (state, bench.status()[0]) == ("Alarm", "Alarm")
    assert bench.status()[1] == pytest.approx(places, abs=0.05)
