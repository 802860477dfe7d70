"""Spindles, tapping, probes and zones of NUM, Syntec, AcroMill, Grbl and the 57C422B:
the figures that their manuals print.
"""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.sim import SimulationError, simulate

EXAMPLES = Path(__file__).parents[2] / "examples"
NUM = "num-1060-mill/MILL_1060.amp"
SYNTEC = "syntec-mill/SYNTEC_MILL.amp"


def example(name: str) -> ParameterFile:
    return open_file(EXAMPLES / name).file


@pytest.mark.parametrize(
    ("name", "speed", "more", "gear", "output"),
    [
        (
            NUM,
            90.0,
            {},
            40,
            9.0,
        ),  # ranges of page 8-16: 10 to 100, 80 to 500, 400 to 2000, 10 V at the end of each
        (NUM, 90.0, {"move.gear": 41.0}, 41, 1.8),
        (NUM, 2000.0, {}, 42, 10.0),
        ("acromill-router/ROUTER.amp", 1500.0, {}, 1, 4.995),  # page 77: 0.00333 V for 1 rpm
        ("grblhal-router/GRBL_ROUTER.amp", 50000.0, {}, 1, 100.0),  # clipped to $30
    ],
)
def test_an_s_word_becomes_an_output(
    name: str, speed: float, more: dict[str, float], gear: int, output: float
) -> None:
    result = simulate(example(name), "spindle", None, {"move.speed": speed, **more}).result
    assert (result["gear"][0], result["output"][0]) == (gear, pytest.approx(output))


def test_a_speed_above_the_limit_of_the_programmed_range_is_error_29() -> None:
    """Page 8-16: above the limit and below the highest speed of the range it is refused
    where the range is programmed.
    """
    file = example(NUM)
    file.set(("spindle.limit_speed", "1.41"), Value(450, "rpm"))
    programmed = simulate(file, "spindle", None, {"move.speed": 480.0, "move.gear": 41.0})
    assert [alarm.code for alarm in programmed.alarms] == ["ERROR 29"]
    assert simulate(file, "spindle", None, {"move.speed": 480.0}).result["gear"][0] == 42


def test_an_indexing_of_a_num_is_clipped_to_p43_and_ends_in_p44() -> None:
    """Pages 8-5 and 8-6: at most 100 rpm, gain 200 rpm for a revolution, a window of 11 of 4096 units."""
    result = simulate(example(NUM), "spindle", None, {"move.orient": 90.0}).result
    assert result["speed"][0] == pytest.approx(100.0)
    assert result["in_position_band"] == (pytest.approx(11 * 360 / 4096), "deg")
    assert result["following_error"] == (pytest.approx(100.0 / 200.0 * 360.0), "deg")


def test_a_tap_of_a_num_slows_down_in_pitch_times_s2_over_2a() -> None:
    """Page 8-32: D = pitch x S2 / (2 x A x 60 x 60), here of 500 rpm with 10 revolutions/s2;
    100 mV are 5 of 500 rpm.
    """
    move = {"move.pitch": 1.0, "move.speed": 400.0, "move.gear": 41.0}
    result = simulate(example(NUM), "tap", None, move).result
    assert result["deceleration_distance_at_limit"][0] == pytest.approx(500.0**2 / (2 * 10 * 3600))
    assert result["hole_bottom_speed"][0] == pytest.approx(5.0)
    assert 0.0 < (result["reversal_error"][0] or 0.0) < 0.1


@pytest.mark.parametrize(
    ("bits", "depth", "words"), [(0, 9.0, "turns the tap back"), (16, 15.0, "no effect")]
)
def test_a_feed_stop_while_tapping_is_that_of_bit_4_of_p7n1(bits: int, depth: float, words: str) -> None:
    """Page 8-9: detapping before the hole bottom, or inhibited until the end of the cycle."""
    file = example(NUM)
    file.set(("misc.functions_more", ""), Value(bits))
    move = {"move.pitch": 1.0, "move.speed": 400.0, "move.feed_stop": 1.0}
    trace = simulate(file, "tap", None, move)
    assert words in trace.assumptions[0]
    assert trace.result["depth"][0] < depth + 0.2
    assert (trace.result["depth"][0] > 14.0) == (bits == 16)


def test_a_feed_stop_while_tapping_is_printed_of_no_other_control() -> None:
    with pytest.raises(SimulationError, match="not printed"):
        simulate(
            example("mill-1394/MILL_1394.amp"),
            "tap",
            None,
            {"move.pitch": 1.0, "move.speed": 400.0, "move.feed_stop": 1.0},
        )


def test_anticipation_of_p63_takes_most_of_the_error_away() -> None:
    """Page 8-35: word 1 puts the command of the axis ahead by the time constant of its loop."""
    file = example(NUM)
    move = {"move.pitch": 1.0, "move.speed": 400.0}
    ahead = simulate(file, "tap", None, move).result["largest_error"][0]
    file.set(("spindle.position_anticipation", "1"), Value(0))
    assert (simulate(file, "tap", None, move).result["largest_error"][0] or 0.0) > 10.0 * (ahead or 1.0)


def test_the_registration_of_a_module_is_printed_twice() -> None:
    """Pages 2-4 and A-2: 25 and 50 µs; at 100000 counts/s they are 2.5 and 5 counts."""
    result = simulate(
        example("57c422b-label-press/LABEL_PRESS.amp"), "probe", "X", {"move.speed": 6e6}
    ).result
    assert result["probe_error"][0] == pytest.approx(5.0)
    assert result["probe_error_2_4"][0] == pytest.approx(2.5)
    assert result["overrun"][0] is None  # it goes on


def test_g31_of_acromill_returns_to_where_the_signal_came() -> None:
    """Page 29."""
    trace = simulate(example("acromill-router/ROUTER.amp"), "probe", "Z", {"move.speed": 2000.0}, "metric")
    captured, stop = (trace.result[name][0] for name in ("captured_position", "stop_position"))
    assert captured == pytest.approx(stop, abs=0.02)
    assert (trace.result["overrun"][0] or 0.0) > abs((captured or 0.0) - (stop or 0.0))


def syntec(sides: dict[str, tuple[float, float]], scope: str = "inside") -> ParameterFile:
    file = example(SYNTEC)
    for axis, (low, high) in sides.items():
        file.set(("limit.second_negative", axis), Value(round(low * 1000), "BLU"))
        file.set(("limit.second_positive", axis), Value(round(high * 1000), "BLU"))
    file.set(("limit.second_scope", ""), Value(scope))
    file.set(("limit.second_at_start", ""), Value("yes"))
    return file


BOX = {"1": (10.0, 25.0), "2": (30.0, 15.0), "3": (0.0, 20.0)}
"""Pr2501 to Pr2506 of the printed example, one pair in the opposite order."""


@pytest.mark.parametrize(
    ("sides", "scope", "more", "codes"),
    [
        (BOX, "inside", {}, ["MOT-044"]),
        (BOX, "inside", {"move.mode": "program"}, ["COR-040"]),  # read ahead: not begun
        (BOX, "inside", {"move.zone": "none"}, []),
        ({**BOX, "3": (100.0, 200.0)}, "inside", {}, []),  # Z is not in it: X and Y are not protected
        (
            {"1": (10.0, 10.0), "2": (0.0, 0.0), "3": (0.0, 0.0)},
            "inside",
            {},
            [],
        ),  # equal values switch it off
        ({"1": (-5.0, 12.0)}, "outside", {}, ["MOT-037"]),
    ],
)
def test_the_second_stroke_limit_of_a_syntec(
    sides: dict[str, tuple[float, float]], scope: str, more: dict[str, str], codes: list[str]
) -> None:
    """Section 3.2: inside and outside, pairs in either order, all axes together, messages of each."""
    settings = {"move.start": "0,20,5", "move.to": "20,20,5", "move.feedrate": 3000.0, **more}
    trace = simulate(syntec(sides, scope), "travel", "1,2,3", settings)
    assert [alarm.code for alarm in trace.alarms] == codes


def test_what_a_family_does_not_print_is_refused_in_a_sentence() -> None:
    with pytest.raises(SimulationError, match="has no scenario 'tap'"):
        simulate(example(SYNTEC), "tap", None, {"move.pitch": 1.0, "move.speed": 100.0})
    with pytest.raises(SimulationError, match="Give the programmed speed"):
        simulate(example(NUM), "spindle", None, {})
