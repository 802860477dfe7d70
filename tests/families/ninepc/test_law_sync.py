"""Two synchronized spindles (chapter 14): speed, seek and deviation."""

import pytest

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Value
from amp_studio.sim import SimulationError, Trace, simulate
from tests.programs.test_block import example

PAIR: dict[Address, Value] = {
    ("axis.type", "4"): Value("spindle"),
    ("servo.spindle_type", "4"): Value("s2"),
    ("servo.position_counts", "4"): Value(8000, "counts"),
    ("spindle.gear_count", "2"): Value(1),
    ("spindle.min_speed", "1.1"): Value(0, "rpm"),
    ("spindle.max_speed", "1.1"): Value(3000, "rpm"),
    ("spindle.min_speed", "2.1"): Value(0, "rpm"),
    ("spindle.max_speed", "2.1"): Value(3000, "rpm"),
    ("spindle.gain", "1.1"): Value(1),
    ("spindle.gain", "2.1"): Value(1),
    ("sync.controlling_spindle", ""): Value("s1"),
    ("sync.follower_spindle", ""): Value("s2"),
    ("sync.seek_tolerance", ""): Value(1, "deg"),
    ("sync.max_deviation", ""): Value(5, "deg"),
    ("sync.seek_timeout", ""): Value(30, "s"),
}


@pytest.fixture
def lathe() -> ParameterFile:
    """The example lathe with a second spindle."""
    file = example("lathe-ls176")
    for address, value in PAIR.items():
        file.set(address, value)
    return file


def synchronized(file: ParameterFile, **settings: float | str) -> Trace:
    moves = {f"move.{name}": each for name, each in {"speed": 1500.0, **settings}.items()}
    return simulate(file, "synchronize", None, moves, advise=False)


@pytest.mark.parametrize(
    ("first", "second", "asked", "speed"),
    [((1000, 3000), (800, 1500), 1800.0, 1500.0), ((1000, 3000), (1800, 3200), 1500.0, 1800.0)],
)
def test_both_turn_at_the_speed_of_example_14_1(
    lathe: ParameterFile, first: tuple[int, int], second: tuple[int, int], asked: float, speed: float
) -> None:
    for name, (low, high) in (("1.1", first), ("2.1", second)):
        lathe.set(("spindle.min_speed", name), Value(low, "rpm"))
        lathe.set(("spindle.max_speed", name), Value(high, "rpm"))
    trace = synchronized(lathe, speed=asked)
    assert trace.result["speed"][0] == speed
    assert trace.columns["velocity"][-1] == pytest.approx(speed, rel=0.01)
    assert trace.columns["follower_velocity"][-1] == pytest.approx(speed, rel=0.01)
    assert any("with a warning (14-2)" in note for note in trace.assumptions)


def test_gears_without_a_common_speed_are_refused(lathe: ParameterFile) -> None:
    """The first row of example 14.1."""
    lathe.set(("spindle.min_speed", "1.1"), Value(1000, "rpm"))
    lathe.set(("spindle.max_speed", "2.1"), Value(300, "rpm"))
    with pytest.raises(SimulationError, match=r"no speed in common \(14-2\)"):
        synchronized(lathe)


def test_equal_gains_keep_the_angle_at_every_speed(lathe: ParameterFile) -> None:
    trace = synchronized(lathe, then=2000.0)
    assert trace.alarms == ()
    assert trace.result["deviation"][0] <= 1.0 + 1e-9
    assert trace.result["following_error"] == (pytest.approx(0.36 * 1500.0), "deg")  # 12-15


def test_a_change_of_speed_turns_unequal_gains_apart_and_br_syne_is_set(lathe: ParameterFile) -> None:
    """Pages 12-15, 14-7: 500 rpm times 0.36 deg, over gain 0.9 and over 1, are 20 deg apart."""
    lathe.set(("spindle.gain", "2.1"), Value(0.9))
    trace = synchronized(lathe, then=2000.0)
    assert [alarm.code for alarm in trace.alarms] == ["BR_SYNE"]
    assert trace.result["deviation_at_end"][0] == pytest.approx(0.36 * 500.0 * (1.0 / 0.9 - 1.0), abs=1.5)
    lathe.set(("sync.gain", ""), Value(1.0))
    assert synchronized(lathe, then=2000.0).result["deviation_at_end"][0] < 12.0


def test_a_seek_that_takes_longer_than_its_timeout_sets_bw_synto(lathe: ParameterFile) -> None:
    long = synchronized(lathe).result["seek_time"][0]
    assert long is not None
    lathe.set(("sync.seek_timeout", ""), Value(long / 2.0, "s"))
    trace = synchronized(lathe)
    assert [alarm.code for alarm in trace.alarms] == ["BW_SYNTO"]
    assert trace.result["seek_time"][0] is None


def test_a_tighter_seek_takes_longer(lathe: ParameterFile) -> None:
    loose = synchronized(lathe).result["seek_time"][0]
    lathe.set(("sync.seek_tolerance", ""), Value(0.01, "deg"))
    assert synchronized(lathe).result["seek_time"][0] > loose


def test_a_follower_at_the_end_of_its_gear_takes_the_long_way_round(lathe: ParameterFile) -> None:
    """At 3000 rpm it can only turn slower: 90 deg ahead are made 270 deg back."""
    trace = synchronized(lathe, speed=3000.0, phase=90.0)
    assert trace.result["seek_time"][0] is not None
    apart = (trace.columns["follower_velocity"] - trace.columns["velocity"]) * 6.0
    assert float(apart.sum()) * 0.005 == pytest.approx(-270.0, abs=5.0)


@pytest.mark.parametrize(
    ("address", "value", "words"),
    [
        (("sync.follower_spindle", ""), Value("s1"), "SYNCH SPINDLES MISCONFIGURED"),
        (("sync.follower_spindle", ""), Value("none"), "name no pair"),
        (("servo.position_counts", "4"), Value(88000, "counts"), r"1:11 has a side above 10 \(14-1\)"),
        (("spindle.gain", "2.1"), Value(0), "No gain is set for gear 1 of spindle 2"),
    ],
)
def test_what_makes_no_pair_is_refused(
    lathe: ParameterFile, address: Address, value: Value, words: str
) -> None:
    lathe.set(address, value)
    with pytest.raises(SimulationError, match=words):
        synchronized(lathe)


def test_a_reversed_follower_turns_the_other_way(lathe: ParameterFile) -> None:
    """Page 14-4: M03 of the controlling spindle is M04 of the follower."""
    lathe.set(("sync.follower_orientation", ""), Value("reversed"))
    assert synchronized(lathe).columns["follower_velocity"][-1] == pytest.approx(-1500.0, rel=0.01)
