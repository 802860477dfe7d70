"""Homing, jogs and overtravels of a 9/PC axis, by chapters 5, 6, 8 and 10."""

from pathlib import Path

import numpy as np
import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.sim import SimulationError, simulate

MILL = Path(__file__).parents[3] / "examples" / "mill-1394" / "MILL_1394.amp"
HOME = {
    "servo.lead_screw_pitch": Value(10.0, "mm"),
    "home.g28_direction": Value("plus"),
    "home.g28_speed": Value(2500.0, "mm/min"),
    "home.direction_off_switch": Value("negative"),
    "home.speed_off_switch": Value(254.0, "mm/min"),
    "home.calibration": Value(0.0, "mm"),
    "home.position": Value(6.0, "mm"),
}


def mill(**changes: Value | None) -> ParameterFile:
    """Return the example mill, axis 1 with the homing above;
    changes by parameter id with ``__`` for the point.
    """
    file = open_file(MILL).file
    for parameter, value in (
        HOME | {name.replace("__", "."): value for name, value in changes.items()}
    ).items():
        file.set((parameter, "1"), value)
    return file


def test_the_home_position_is_the_marker_nearest_to_the_switch_and_the_calibration_from_there() -> None:
    # Steps 3 to 10 of 5-3 and 5-4: off the switch at 40 mm, a marker 2 mm from it, one turn of the screw is
    # 10 mm.
    move = {"move.switch": 40.0, "move.marker": 2.0}
    plain = simulate(mill(), "home", "1", move).result
    assert plain["home_from_start"] == (pytest.approx(38.0), "mm")
    assert plain["home_position"] == (6.0, "mm")  # Axis Position after Homing, 5-11
    assert plain["stop_position"][0] == pytest.approx(6.0, abs=0.0254)
    for calibration in (3.5, -12.0):  # in either direction
        moved = simulate(mill(home__calibration=Value(calibration, "mm")), "home", "1", move).result
        assert moved["home_from_start"][0] == pytest.approx(38.0 + calibration)
        assert moved["home_position"] == (6.0, "mm")


def test_it_runs_onto_the_switch_waits_and_comes_off_at_the_slow_speed() -> None:
    trace = simulate(mill(), "home", "1", {"move.switch": 40.0, "move.marker": 2.0})
    velocity, position = trace.columns["velocity"], trace.columns["position"]
    assert velocity.max() == pytest.approx(2500.0, rel=0.01)  # G28 Home Speed, 5-16
    assert velocity.min() == pytest.approx(-254.0, rel=0.01)  # Home Speed from Limit Switch, 5-12
    first_back = int(np.flatnonzero(trace.columns["command_velocity"] < 0.0)[0])
    # Steps 4 and 7: until the following error is inside of the Inposition Band.
    assert abs(trace.columns["following_error"][first_back - 1]) <= 0.0254
    assert position[:first_back].max() - 40.0 == pytest.approx(trace.result["switch_overrun"][0])
    # Homing is exponential whatever Manual ACC./DEC Mode is (10-14): the first change of the speed is the
    # steepest.
    command = trace.columns["command_velocity"][: first_back // 3]
    assert np.argmax(np.diff(command)) < 10


def test_a_marker_on_the_other_side_of_half_a_turn_is_the_nearest_one() -> None:
    # The caution of 5-4: at half a turn the home position is another one.
    near, far = (
        simulate(mill(), "home", "1", {"move.switch": 40.0, "move.marker": marker}) for marker in (4.7, 5.3)
    )
    assert near.result["home_from_start"][0] == pytest.approx(35.3)
    assert far.result["home_from_start"][0] == pytest.approx(44.7)
    for trace in (near, far):
        assert any("may be another one each time (page 5-4)" in text for text in trace.assumptions)
    quiet = simulate(mill(), "home", "1", {"move.switch": 40.0, "move.marker": 2.0})
    assert not any("may be another one" in text for text in quiet.assumptions)


def test_an_axis_that_passes_a_short_switch_is_jogged_home_too_fast() -> None:
    # 5-3: off in the direction of the approach, and the switch is off again before the axis has stopped.
    through = mill(home__direction_off_switch=Value("positive"))
    trace = simulate(through, "home", "1", {"move.switch": 40.0, "move.switch_length": 5.0})
    assert [alarm.code for alarm in trace.alarms] == ["JOGGED HOME TOO FAST: X"]
    assert trace.result["home_position"] == (None, "mm")
    slow = simulate(
        through, "home", "1", {"move.switch": 40.0, "move.switch_length": 20.0, "move.marker": 1.0}
    )
    assert not slow.alarms
    assert slow.result["home_from_start"][0] == pytest.approx(61.0)  # off at 60, the marker behind it
    with pytest.raises(SimulationError, match=r"give move\.switch_length"):
        simulate(through, "home", "1")


def test_a_coded_scale_is_homed_by_three_markers_and_goes_to_the_home_position() -> None:
    """5-5 to 5-7, 5-14: no switch; three markers of 20 and 20.02 mm are passed within 30 mm,
    whatever the start.
    """
    lathe = open_file(MILL.parents[1] / "lathe-ls176" / "LATHE_LS176.amp").file
    for start in (100.5, 104.0, 119.9):
        trace = simulate(lathe, "home", "1", {"move.scale": start})
        assert trace.result["home_position"][0] == lathe.evaluation.canonical(("home.position", "1"))
        assert trace.result["time"][0] is not None
        slow = trace.columns["command_velocity"]
        assert not trace.alarms
        assert np.abs(slow).max() == pytest.approx(
            lathe.evaluation.canonical(("home.g28_speed", "1")), rel=1e-3
        )
    assert any("7-31 and B-1" in note for note in trace.assumptions)


def test_what_is_not_homed_by_a_sequence_is_shown() -> None:
    opened = mill(servo__position_loop_type=Value("open"))  # 5-1
    with pytest.raises(SimulationError, match="not homed"):
        simulate(opened, "home", "1")
    with pytest.raises(SimulationError, match=r"1011 G28 Home Speed is not set for axis 1"):
        simulate(mill(home__g28_speed=None), "home", "1")


def test_an_overtravel_is_passed_by_the_following_error() -> None:
    # 10-18: all commands stop at once, and the axis moves past it by the amount of its following error.
    file = mill(
        zone__overtravel_used=Value(True),
        zone__overtravel_positive=Value(100.0, "mm"),
        zone__overtravel_negative=Value(-50.0, "mm"),
    )
    for feedrate, behind in ((10000.0, 10.0), (5000.0, 5.0)):
        trace = simulate(file, "travel", "1", {"move.feedrate": feedrate})
        assert trace.result["overrun"][0] == pytest.approx(behind, rel=0.01)
        assert trace.result["stop_position"][0] == pytest.approx(100.0 + behind, rel=0.01)
        assert trace.alarms[0].code == "OVERTRAVEL"
    back = simulate(file, "travel", "1", {"move.direction": "minus", "move.start": 0.0})
    assert back.result["limit"] == (-50.0, "mm")
    assert back.result["stop_position"][0] < -50.0
    with pytest.raises(SimulationError, match="No limit of the travel is active"):
        simulate(mill(zone__overtravel_used=Value(False)), "travel", "1")
    with pytest.raises(SimulationError, match="No limit of the travel is active"):
        simulate(file, "travel", "1", {"move.start": 200.0})


def test_an_incremental_jog_goes_at_the_third_speed() -> None:
    # 8-2; a continuous one at the lowest unless another is chosen.
    file = mill(
        jog__speed_third=Value(600.0, "mm/min"),
        jog__speed_lowest=Value(100.0, "mm/min"),
        jog__increment_largest=Value(25.0, "mm"),
    )
    jog = simulate(file, "jog", "1", {"move.increment": "largest", "move.direction": "minus"})
    assert jog.result["feedrate"] == (600.0, "mm/min")
    assert jog.result["stop_position"][0] == pytest.approx(-25.0, abs=0.0254)
    current = simulate(file, "jog", "1", {"move.hold": "2 s"})
    assert current.result["feedrate"] == (100.0, "mm/min")
    # With an exponential ramp the axis goes on by what it has not been given yet: 2 s at the full speed in
    # all.
    assert current.result["distance"][0] == pytest.approx(100.0 / 60.0 * 2.0)
    with pytest.raises(SimulationError, match=r"leave out move\.speed"):
        simulate(file, "jog", "1", {"move.increment": "largest", "move.speed": "highest"})
    with pytest.raises(SimulationError, match="Unknown jog speed 'warp'"):
        simulate(file, "jog", "1", {"move.speed": "warp"})


def test_odd_settings_of_the_switch_get_a_sentence() -> None:
    with pytest.raises(SimulationError, match=r"move\.marker is 1e\+300"):
        simulate(mill(), "home", "1", {"move.marker": 1e300})
    with pytest.raises(SimulationError, match=r"move\.switch_length is -1; it must be above 0"):
        simulate(mill(), "home", "1", {"move.switch_length": -1.0})
    short = simulate(mill(), "home", "1", {"move.switch": 40.0, "move.switch_length": 1.0})
    assert any("comes back over it" in text for text in short.assumptions)


def test_a_programmable_zone_stops_the_axis_on_either_side() -> None:
    # 6-4: an axis alone in its group is not allowed between the limits of zone 2.
    file = mill(zone__limit2_min=Value(100.0, "mm"), zone__limit2_max=Value(110.0, "mm"))
    for direction, edge, sign in (("plus", 100.0, 1.0), ("minus", 110.0, -1.0)):
        trace = simulate(
            file, "travel", "1", {"move.zone": "2", "move.direction": direction, "move.feedrate": 3000.0}
        )
        assert trace.result["limit"] == (edge, "mm")
        assert trace.result["stop_position"][0] == pytest.approx(edge + sign * 3.0, rel=0.01)
        assert "programmable zone 2" in trace.alarms[0].message
        assert "(page 6-3 and 6-7)" in trace.alarms[0].message
    with pytest.raises(SimulationError, match="Zone 7 of this axis is not set"):
        simulate(file, "travel", "1", {"move.zone": 7.0})


def test_the_stop_at_an_overtravel_is_printed_for_manual_motion_and_assumed_elsewhere() -> None:
    file = mill(
        zone__overtravel_used=Value(True),
        zone__overtravel_positive=Value(100.0, "mm"),
        zone__overtravel_negative=Value(-50.0, "mm"),
    )
    trace = simulate(file, "travel", "1", {"move.feedrate": 3000.0})
    (note,) = [text for text in trace.assumptions if text.startswith("A software overtravel stops")]
    assert "manual motion" in note
    assert "ASSUMED: a programmed move" in note


def test_an_external_deceleration_takes_the_speed_away_before_the_limit() -> None:
    """Page 9-6: behind the switch the axis goes at External Decel Speed (Posit.),
    and passes the overtravel by less.
    """
    file = mill(
        zone__overtravel_used=Value(True),
        zone__overtravel_positive=Value(100.0, "mm"),
        zone__overtravel_negative=Value(-50.0, "mm"),
        feedrate__external_decel_positioning=Value(500.0, "mm/min"),
    )
    fast = simulate(file, "travel", "1", {"move.start": 0.0}).result
    slow = simulate(file, "travel", "1", {"move.start": 0.0, "move.slow_from": 50.0}).result
    assert slow["speed_at_limit"][0] == pytest.approx(500.0, rel=0.02)
    assert 0.0 < (slow["overrun"][0] or 0.0) < 0.2 * (fast["overrun"][0] or 0.0)
    with pytest.raises(SimulationError, match="between the start and the limit"):
        simulate(file, "travel", "1", {"move.start": 0.0, "move.slow_from": 120.0})


def test_a_hard_stop_that_is_too_near_to_the_limit_is_met_with_a_speed() -> None:
    """The axis passes the overtravel by its following error (10-18),
    which must be less than the way to the hard stop.
    """
    file = mill(zone__overtravel_used=Value(True), zone__overtravel_positive=Value(100.0, "mm"))
    far = simulate(file, "travel", "1", {"move.start": 0.0, "move.hard_stop": 120.0})
    assert (far.result["hard_stop_margin"][0] or 0.0) > 0.0
    near = simulate(file, "travel", "1", {"move.start": 0.0, "move.hard_stop": 101.0})
    assert [alarm.code for alarm in near.alarms] == ["HARD STOP", "OVERTRAVEL"]
    assert (near.result["hard_stop_margin"][0] or 0.0) < 0.0
