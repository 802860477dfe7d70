"""Spindles, solid tapping and probing of a 9/PC: the figures of chapters 9, 12, 21, 27 and 29."""

from pathlib import Path

import numpy as np
import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.sim import SimulationError, simulate

MILL = Path(__file__).parents[3] / "examples" / "mill-1394" / "MILL_1394.amp"


@pytest.fixture
def mill() -> ParameterFile:
    """Two gears that overlap, a ramp of 0.5 s to 500 rpm."""
    file = open_file(MILL).file
    values = {
        ("spindle.gear_count", "1"): Value(2),
        ("spindle.dac_ramping", "1"): Value(True),
        ("spindle.deviation_tolerance", "1"): Value(20, "%"),
        ("spindle.deviation_filter_time", "1"): Value(200, "ms"),
    }
    for gear, low, high, volts in (("1.1", 0.0, 1500.0, 10.0), ("1.2", 1000.0, 6000.0, 8.0)):
        values |= {
            ("spindle.min_speed", gear): Value(low, "rpm"),
            ("spindle.max_speed", gear): Value(high, "rpm"),
            ("spindle.voltage_at_max", gear): Value(volts, "V"),
            ("spindle.gain", gear): Value(1.0),
            ("tapping.acceleration_time", gear): Value(0.5, "s"),
            ("tapping.max_speed", gear): Value(500.0, "rpm"),
        }
    file.set_checked(values, force="test")
    return file


@pytest.mark.parametrize(
    ("speed", "gear", "volts"),
    [(750.0, 1, 5.0), (3000.0, 2, 4.0), (6000.0, 2, 8.0), (-750.0, 1, -5.0), (1200.0, 1, 8.0)],
)
def test_an_s_word_has_a_gear_and_its_share_of_the_voltage(
    mill: ParameterFile, speed: float, gear: int, volts: float
) -> None:
    """Page 12-5; which gear is taken in an overlap is not printed."""
    trace = simulate(mill, "spindle", None, {"move.speed": speed})
    assert trace.result["gear"][0] == gear
    assert trace.result["output"] == (pytest.approx(volts), "V")
    assert any("overlap" in note or "all have this speed" in note for note in trace.assumptions) == (
        speed == 1200.0
    )


def test_in_an_overlap_the_present_gear_stays(mill: ParameterFile) -> None:
    assert simulate(mill, "spindle", None, {"move.speed": 1200.0, "move.gear": 2.0}).result["gear"][0] == 2


def test_the_ramp_takes_the_acceleration_time_to_the_tapping_speed_in_steps_of_an_iteration(
    mill: ParameterFile,
) -> None:
    """Page 12-3, with the tapping option; without it Dev. Detection Filter Time to Max. Spindle Speed."""
    trace = simulate(mill, "spindle", None, {"move.speed": 1000.0})
    assert trace.result["ramp_time"] == (pytest.approx(1.0), "s")
    assert len(set(np.diff(trace.columns["command_velocity"]))) > 1
    for gear in ("1.1", "1.2"):
        mill.set(("tapping.acceleration_time", gear), None)
    shorter = simulate(mill, "spindle", None, {"move.speed": 1500.0})
    assert shorter.result["ramp_time"] == (pytest.approx(0.2), "s")


def test_the_emergency_stop_takes_the_output_away_at_once(mill: ParameterFile) -> None:
    """Page 12-4."""
    trace = simulate(mill, "spindle", None, {"move.speed": 1000.0, "move.estop_time": 0.5})
    after = trace.columns["time_s"] >= 0.5
    assert not trace.columns["output"][after].any()
    assert trace.columns["output"][~after].any()


def test_20_percent_of_1000_rpm_are_flagged_below_800_and_above_1200(mill: ParameterFile) -> None:
    """Page 12-5."""
    flags = {}
    for reached in (790.0, 810.0, 1190.0, 1210.0):
        trace = simulate(mill, "spindle", None, {"move.speed": 1000.0, "move.reached": reached})
        flags[reached] = trace.result["deviation_at_end"][0]
        assert (trace.result["deviation_low"][0], trace.result["deviation_high"][0]) == (800.0, 1200.0)
    assert flags == {790.0: 1.0, 810.0: 0.0, 1190.0: 0.0, 1210.0: 1.0}


def test_a_gear_without_legal_values_means_that_none_is_requested(mill: ParameterFile) -> None:
    """Pages 12-8 and 27-2."""
    mill.set(("spindle.max_speed", "1.2"), None)
    trace = simulate(mill, "spindle", None, {"move.speed": 500.0})
    assert trace.result["gear"][0] is None
    assert "never requests" in trace.alarms[0].message


@pytest.mark.parametrize(
    ("settings", "turn"),
    [
        ({"move.position": 350.0, "move.orient": 90.0}, 100.0),
        ({"move.position": 90.0, "move.orient": 350.0}, -100.0),
        ({"move.position": 40.0, "move.orient": 0.0, "move.marker": "unknown"}, -40.0),
    ],
)
def test_an_orient_goes_the_shortest_way_once_the_marker_is_known(
    mill: ParameterFile, settings: dict[str, float | str], turn: float
) -> None:
    """Page 12-13; before it is known the direction is that of 851, here counterclockwise."""
    trace = simulate(mill, "spindle", None, settings)
    assert trace.result["orient_turn"][0] == pytest.approx(turn)
    assert trace.columns["position"][-1] == pytest.approx(float(settings["move.position"]) + turn, abs=0.2)


def test_the_following_error_of_an_orient_is_0_36_degrees_for_each_rpm_and_gain(mill: ParameterFile) -> None:
    """Page 12-15: 0.36 x rpm / gain, at 60 rpm and gain 1."""
    assert simulate(mill, "spindle", None, {"move.orient": "yes"}).result["following_error"] == (
        pytest.approx(21.6),
        "deg",
    )


def test_tapping_is_worst_at_the_reversal_and_less_with_a_faster_drive(mill: ParameterFile) -> None:
    move = {"move.pitch": 1.0, "move.speed": 400.0}
    slow, fast = (simulate(mill, "tap", None, {**move, "move.drive_time": lag}) for lag in (0.05, 0.005))
    errors = [trace.result["reversal_error"][0] or 0.0 for trace in (slow, fast)]
    assert errors[0] > 2.0 * errors[1] > 0.0
    assert slow.result["reversal_error"][0] == pytest.approx(slow.result["largest_error"][0], rel=0.01)
    assert slow.letter == "Z"


def test_a_speed_above_that_of_the_gear_is_an_alarm_of_tapping(mill: ParameterFile) -> None:
    trace = simulate(mill, "tap", None, {"move.pitch": 1.0, "move.speed": 600.0})
    assert [alarm.code for alarm in trace.alarms] == ["TAPPING SPEED"]


def test_the_lower_acceleration_is_that_of_both(mill: ParameterFile) -> None:
    """Page 27-2: 500 rpm in 0.5 s are 16.67 revolutions/s2, with a pitch of 1 mm below the axis."""
    trace = simulate(mill, "tap", None, {"move.pitch": 1.0, "move.speed": 400.0})
    assert trace.result["acceleration"] == (pytest.approx(16.6667, rel=1e-4), "mm/s2")


def test_a_probe_is_wrong_by_speed_times_latency(mill: ParameterFile) -> None:
    settings = {"move.speed": 600.0, "move.latency": 0.002}
    trace = simulate(mill, "probe", "3", settings)
    assert trace.result["probe_error"] == (pytest.approx(0.02), "mm")
    assert (trace.result["overrun"][0] or 0.0) > 0.0


@pytest.mark.parametrize(
    ("touch", "code"), [("expected", None), ("off", "PROBE ERROR"), ("none", "PROBE ERROR")]
)
def test_g38_is_an_error_outside_of_its_band(mill: ParameterFile, touch: str, code: str | None) -> None:
    """Page 29-6: D on both sides of the expected firing point."""
    mill.set(("probing.tolerance_band", ""), Value(1.0, "mm"))
    place = {"expected": {}, "off": {"move.touch": 28.5}, "none": {"move.touch": "none"}}[touch]
    trace = simulate(mill, "probe", "3", {"move.cycle": "G38", "move.expected": 30.0, **place})
    assert [alarm.code for alarm in trace.alarms] == ([code] if code else [])


@pytest.mark.parametrize(
    ("cycle", "speed"), [("G31", 250.0), ("G31.2", 1000.0), ("G37.3", 100.0), ("G31.4", 50.0)]
)
def test_skip_cycles_have_their_own_feedrate_where_4_is_yes(
    mill: ParameterFile, cycle: str, speed: float
) -> None:
    """Page 9-8: parameters 5, 2, 6 and 7."""
    mill.set(("feedrate.use_skip_feedrate", ""), Value(True))
    assert simulate(mill, "probe", "3", {"move.cycle": cycle}).result["speed"][0] == pytest.approx(speed)
    mill.set(("feedrate.use_skip_feedrate", ""), Value(False))
    with pytest.raises(SimulationError, match="Give the speed"):
        simulate(mill, "probe", "3", {"move.cycle": cycle})


def test_the_spindle_taps_with_the_zero_following_error_of_its_axis(mill: ParameterFile) -> None:
    """Page 27-1: both get the loop and the feed-forward of the axis, so that the reversal error is
    smaller.
    """
    move = {"move.pitch": 1.0, "move.speed": 400.0}
    closed = simulate(mill, "tap", None, move, advise=False)
    mill.set(("servo.position_loop_type", "3"), Value("zfe"))
    mill.set(("servo.feed_forward", "3"), Value(95, "%"))
    forced = simulate(mill, "tap", None, move, advise=False)
    assert any("forced to the same loop and feed-forward (27-1)" in note for note in forced.assumptions)
    assert forced.result["peak_following_error"][0] < 0.5 * closed.result["peak_following_error"][0]
