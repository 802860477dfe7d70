"""Ramps, jog speeds, gears, gains and tables: what is drawn, and what a handle does to the values."""

import math

import pytest

from amp_studio.pictures import draw, pictures_of
from amp_studio.pictures.ramps import ramp_of
from amp_studio.schema import Value
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.law import law_of


def handle(scene, *parameters):
    (found,) = [h for h in scene.handles if [d.address for d in h.drags] == list(parameters)]
    return found


def moved(handle, at):
    return handle.drags[0].value_at(at)


def curves(scene):
    return [line.points for line in scene.lines if not line.dashed]


def notes(scene):
    return [note.text for note in scene.notes]


# -- ramps -----------------------------------------------------------------------------------------


def test_a_linear_ramp_reaches_rapid_in_v_by_a_seconds(example):
    """Page 10-8: 10000 mm/min at 694.4 mm/s² are 0.24 s, and as much down."""
    scene = draw(example("9pc"), "ramps", "X")
    start, top, fast, end, *_ = dict.fromkeys(curves(scene)[0])
    assert (start, top) == ((0.0, 0.0), (pytest.approx(0.2400154), pytest.approx(10000.0)))
    assert end[0] - fast[0] == pytest.approx(0.2400154)
    assert handle(scene, ("accdec.linear_acceleration", "1")).at == (
        pytest.approx(0.2400154),
        pytest.approx(10000.0),
    )


def test_a_jerk_out_of_its_bounds_and_the_one_that_is_drawn_have_one_unit(example):
    scene = draw(example("9pc"), "ramps", "S")
    (note,) = [text for text in notes(scene) if "scans" in text]
    assert note == "5214 Axis Jerk, S: 5.08 deg/s³ is outside 2 to 60 scans, drawn with 35.2778 deg/s³"


def test_the_end_of_a_ramp_dragged_in_time_gives_the_acceleration(example):
    """0.2 s to 10000 mm/min are 833 mm/s²; the resolution follows the picture."""
    scene = draw(example("9pc"), "ramps", "X")
    assert moved(handle(scene, ("accdec.linear_acceleration", "1")), 0.2) == Value(834.0, "mm/s2")
    jerk = handle(scene, ("accdec.jerk", "1"))
    assert jerk.at[0] == pytest.approx(694.4 / 7233.0)
    assert moved(jerk, 0.1).value == pytest.approx(6944.0, abs=20.0)


@pytest.mark.parametrize("drag", [0.15, 0.4, 0.7])
def test_a_dragged_ramp_ends_where_the_handle_was_dropped(example, drag):
    for parameter in ("accdec.linear_acceleration", "accdec.scurve_acceleration"):
        file = example("9pc")
        before = draw(file, "ramps", "X")
        value = moved(handle(before, (parameter, "1")), drag)
        file.set((parameter, "1"), value)
        picture = next(p for p in pictures_of(file) if p.name == "ramps")
        after = handle(picture.scene("X", before), (parameter, "1"))
        fastest = 2.0 * math.sqrt(10000.0 / 60.0 / 7233.0)
        assert after.at[0] == pytest.approx(drag if "linear" in parameter else max(drag, fastest), rel=0.02)


@pytest.mark.parametrize("name", ["9pc", "lathe", "num", "syntec", "57c422b", "acromill"])
def test_ramps_are_those_of_the_simulator(example, name):
    file = example(name)
    law = law_of(file.schema.family.family)
    bound = bind_axis(file, law, law.axes(file)[0])
    own = {ramp.kind: ramp for ramp in bound.ramps.values()}
    compared = 0
    for role in file.schema.pictures.ramps.kinds:
        ramp = ramp_of(file, role, bound.axis, bound.feedrate, bound.unit)
        if ramp is None:
            continue
        there = own[role.kind]
        assert (ramp.acceleration, ramp.jerk, ramp.time, ramp.velocity_step) == pytest.approx(
            (there.acceleration, there.jerk, there.time, there.velocity_step)
        )
        assert ramp.deceleration == pytest.approx(there.deceleration or there.acceleration)
        compared += 1
    assert compared


def test_grbl_draws_its_s_curve_only_where_jerk_is_set(example):
    file = example("grblhal")
    assert "$800 Jerk, X: not set" in notes(draw(file, "ramps", "X"))
    file.set(("axis.jerk", "X"), Value(5000.0, "mm/s3"))
    assert len(curves(draw(file, "ramps", "X"))) == 2


def test_a_ramp_without_a_speed_to_ramp_to_is_not_drawn(example):
    file = example("9pc")
    file.set(("feedrate.rapid", "1"), None)
    scene = draw(file, "ramps", "X")
    assert (scene.lines, scene.handles) == ((), ())
    assert notes(scene) == ["1203 Rapid Feedrate for Positioning, X: not set"]


# -- jog -------------------------------------------------------------------------------------------


def test_jog_speeds_rise_from_low_to_high_on_each_axis(example):
    """Pages 8-2 to 8-5."""
    scene = draw(example("9pc"), "jog")
    assert scene.x.log
    x = [h.at[0] for h in scene.handles if h.drags[0].address[1] == "1"]
    assert x == [10.0, 50.0, 250.0, 1000.0, 5000.0, 10000.0]
    assert [(name, unit) for _, name, unit in scene.y.rows][:4] == [
        ("X", "mm/min"),
        ("Y", "mm/min"),
        ("Z", "mm/min"),
        ("B", "deg/min"),
    ]
    assert moved(handle(scene, ("jog.speed_second", "1")), 61.83) == Value(62.0, "mm/min")


def test_a_jog_speed_above_rapid_is_drawn_and_marked(example):
    file = example("9pc")
    file.set(("jog.speed_highest", "3"), Value(12000.0, "mm/min"))
    scene = draw(file, "jog")
    assert any(h.at[0] == 12000.0 for h in scene.handles)
    assert any(note.wrong and "is above 3203 Rapid" in note.text for note in scene.notes)


def test_num_jog_speeds_are_of_the_control_and_have_one_handle_each(example):
    """Page 6-8: P31 is one for all axes; the bars are P30."""
    scene = draw(example("num"), "jog")
    assert [h.drags[0].address for h in scene.handles] == [
        ("servo.jog_slow", ""),
        ("servo.jog_normal", ""),
        ("servo.jog_fast", ""),
    ]
    assert len({dot.at[1] for dot in scene.dots}) == len(scene.y.rows)


def test_increments_of_the_router_are_inches(example):
    """Page 67: 1 to 0.0001."""
    file = example("acromill")
    file.header.units = "inch"
    x = [h.at[0] for h in draw(file, "increments").handles if h.drags[0].address[1] == "X"]
    assert x == [0.0001, 0.001, 0.01, 0.1, 1.0]


def test_zero_has_no_place_on_a_scale_of_powers_of_ten(example):
    file = example("num")
    file.set(("servo.jog_slow", ""), Value(0, "mm/min"))
    assert "P31N0 Slow JOG Speed: 0 mm/min has no place on this scale" in notes(draw(file, "jog"))


# -- gears -----------------------------------------------------------------------------------------


def test_num_ranges_reach_ten_volts_at_their_highest_speed_and_overlap(example):
    """Page 8-16: M40 10 to 100, M41 80 to 500, M42 400 to 2000 rpm; ranges of zeros do not exist."""
    scene = draw(example("num"), "gears", "1")
    assert [line.points for line in scene.lines if not line.dashed] == [
        ((10.0, 1.0), (100.0, 10.0)),
        ((80.0, 1.6), (500.0, 10.0)),
        ((400.0, 2.0), (2000.0, 10.0)),
    ]
    assert [(a.left, a.right) for a in scene.areas] == [(80.0, 100.0), (400.0, 500.0)]
    assert moved(handle(scene, ("spindle.range_max", "1.41")), 551.0) == Value(550, "rpm")


def test_speeds_that_no_gear_has_are_shown(example):
    file = example("num")
    file.set(("spindle.range_min", "1.41"), Value(120, "rpm"))
    assert "No gear has the speeds from 100 to 120 rpm" in notes(draw(file, "gears", "1"))


def test_a_9pc_spindle_has_as_many_gears_as_are_used(example):
    """Pages 12-5 to 12-8; the voltage is dragged on the line of its gear."""
    file = example("9pc")
    for parameter, value in (
        ("gear_count@1", Value(2)),
        ("min_speed@1.2", Value(500.0, "rpm")),
        ("max_speed@1.2", Value(4000.0, "rpm")),
        ("voltage_at_max@1.2", Value(8.0, "V")),
    ):
        name, _, instance = parameter.partition("@")
        file.set((f"spindle.{name}", instance), value)
    scene = draw(file, "gears", "1")
    assert [line.points for line in scene.lines if not line.dashed][1] == ((500.0, 1.0), (4000.0, 8.0))
    volts = handle(scene, ("spindle.voltage_at_max", "1.2"))
    assert volts.at == (2250.0, 4.5)
    assert moved(volts, 5.625).value == pytest.approx(10.0)


def test_the_scaling_of_the_router_reaches_its_ten_volts(example):
    """Page 77: 10 V / 3000 rpm."""
    file = example("acromill")
    file.set(("spindle.scaling", ""), Value(0.0025, "V/rpm"))
    scene = draw(file, "gears")
    assert handle(scene, ("spindle.scaling", "")).at == (4000.0, 10.0)
    assert moved(handle(scene, ("spindle.scaling", "")), 5000.0).value == pytest.approx(0.002)
    file.set(("spindle.scaling", ""), Value(0.0, "V/rpm"))
    assert any("puts nothing out" in text for text in notes(draw(file, "gears")))


def test_grbl_puts_out_percent_between_its_speeds(example):
    file = example("grblhal")
    file.set(("spindle.pwm_min", ""), Value(10.0, "%"))
    scene = draw(file, "gears")
    assert curves(scene)[0] == ((6000.0, 10.0), (24000.0, 100.0))
    assert moved(handle(scene, ("spindle.pwm_min", "")), 20.0).value == pytest.approx(0.0)


# -- gain ------------------------------------------------------------------------------------------


def test_the_gain_breaks_at_its_break_point(example):
    """Pages 7-22 and 7-27: beyond Gain Break Point the gain is Initial Gain times the ratio."""
    file = example("9pc")
    file.set(("servo.gain_break_ratio", "1"), Value(0.5))
    scene = draw(file, "error", "X")
    (line,) = [line.points for line in scene.lines if not line.dashed]
    assert line[1:3] == ((5.0, 1.0), (5.0, 0.5))
    assert moved(handle(scene, ("servo.gain_break_ratio", "1")), 0.25) == Value(0.25, "")
    assert moved(handle(scene, ("servo.gain_break_point", "1")), 6.0) == Value(6.0, "mm")


@pytest.mark.parametrize(
    ("name", "limit"),
    [
        ("num", "servo.max_following_error"),
        ("57c422b", "setup.max_position_error"),
        ("acromill", "axes.excess_error_band"),
    ],
)
def test_limits_of_the_error_stand_over_one_gain(example, name, limit):
    scene = draw(example(name), "error")
    (line,) = [line.points for line in scene.lines if not line.dashed]
    assert line[0][1] == line[-1][1]
    assert [h for h in scene.handles if h.drags[0].address[0] == limit]


# -- tables ----------------------------------------------------------------------------------------


@pytest.fixture
def table(example):
    """Return a router with the ballscrew table of page 107."""
    file = example("acromill")
    file.set(("ballscrew.table", "X"), Value("X0E.00000 X1E.00625 X2E.00325 X3E.00175 X4E-.00250"))
    return file


def test_a_ballscrew_table_is_a_curve(table):
    scene = draw(table, "calibration", "X")
    assert scene.lines[-1].points == (
        (0.0, 0.0),
        (1.0, 0.00625),
        (2.0, 0.00325),
        (3.0, 0.00175),
        (4.0, -0.0025),
    )


def test_its_points_are_dragged_put_in_and_taken_out(table):
    scene = draw(table, "calibration", "X")
    address = ("ballscrew.table", "X")
    assert moved(scene.handles[2], 0.004) == Value("X0E.00000 X1E.00625 X2E.00400 X3E.00175 X4E-.00250")
    assert scene.with_point((5.2, 0.001)) == (
        address,
        Value("X0E.00000 X1E.00625 X2E.00325 X3E.00175 X4E-.00250 X5E.00100"),
    )
    assert scene.handles[-1].without == (address, Value("X0E.00000 X1E.00625 X2E.00325 X3E.00175"))
    assert scene.handles[1].without is None
    with pytest.raises(ValueError, match="already"):
        scene.with_point((2.5, 0.001))


def test_a_text_that_is_no_table_is_shown_and_not_drawn(table):
    table.set(("ballscrew.table", "X"), Value("X0E.1 X5E.2"))
    scene = draw(table, "calibration", "X")
    assert [note.wrong for note in scene.notes] == [True]
    assert not scene.handles
