"""Zones of a 9/PC over several axes: the figures of pages 6-2 to 6-9."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.sim import SimulationError, simulate

MILL = Path(__file__).parents[3] / "examples" / "mill-1394" / "MILL_1394.amp"
BOXES = {"1": ("g2", 2.0, 5.0), "2": ("g2", 2.0, 5.0), "3": ("g1", 10.0, 11.0)}
"""X and Y in group 2 from 2 to 5, Z alone in group 1 from 10 to 11 (page 6-4)."""


@pytest.fixture
def mill() -> ParameterFile:
    file = open_file(MILL).file
    for axis, (group, low, high) in BOXES.items():
        file.set(("zone.group", axis), Value(group))
        file.set(("zone.overtravel_used", axis), Value(False))
        for zone in ("2", "3"):
            file.set((f"zone.limit{zone}_min", axis), Value(low, "mm"))
            file.set((f"zone.limit{zone}_max", axis), Value(high, "mm"))
    file.set(("zone.group_count", ""), Value(2))
    file.set(("powerup.zones", ""), Value("g23.1"))  # zone 2 alone
    return file


def codes(file: ParameterFile, start: str, to: str, **more: str) -> list[str]:
    settings = {"move.start": start, "move.to": to, "move.feedrate": "300 mm/min", **more}
    return [alarm.code for alarm in simulate(file, "travel", "1,2,3", settings).alarms]


@pytest.mark.parametrize(
    ("to", "stops"),
    [("3,3,0", True), ("3,6,0", False), ("0,0,10.5", True), ("0,0,9.9", False), ("6,6,0", True)],
)
def test_each_group_is_a_box_over_its_own_axes(mill: ParameterFile, to: str, stops: bool) -> None:
    """Page 6-4: X and Y between 2 and 5 wherever Z is, Z between 10 and 11 wherever the others are;
    a diagonal meets the corner.
    """
    start = "3,7,0" if to == "3,6,0" else "0,0,0"
    assert codes(mill, start, to) == (["ZONE 2"] if stops else [])


@pytest.mark.parametrize(
    ("code", "stopped"), [("g22", True), ("g22.1", False), ("g23", False), ("g23.1", True)]
)
def test_the_zones_of_power_up_are_those_of_524(mill: ParameterFile, code: str, stopped: bool) -> None:
    """Page 16-16: g22 both, g22.1 zone 3, g23 none, g23.1 zone 2; zone 3 lies elsewhere here."""
    mill.set(("powerup.zones", ""), Value(code))
    for axis in ("1", "2", "3"):
        mill.set(("zone.limit3_min", axis), Value(100.0, "mm"))
        mill.set(("zone.limit3_max", axis), Value(200.0, "mm"))
    assert bool(codes(mill, "0,0,0", "3,3,0")) == stopped


def test_no_zone_is_watched_where_their_number_is_0(mill: ParameterFile) -> None:
    """Page 6-6: 0 switches the feature off."""
    mill.set(("zone.group_count", ""), Value(0))
    assert codes(mill, "0,0,0", "3,3,0") == []


def test_zone_3_keeps_the_axes_where_they_were(mill: ParameterFile) -> None:
    """Page 6-2: inside if they are in it when it is switched on, else outside."""
    zone = {"move.zone": "3"}
    assert codes(mill, "0,0,0", "3,3,0", **zone) == ["ZONE 3"]
    inside = simulate(
        mill, "travel", "1,2", {"move.start": "3,3", "move.to": "3,6", "move.feedrate": 300.0, **zone}
    )
    assert inside.result["limit"][0] == pytest.approx(2.0)
    assert inside.result["stop_position_Y"][0] == pytest.approx(5.0, abs=0.5)


def test_an_axis_without_a_group_is_open(mill: ParameterFile) -> None:
    mill.set(("zone.group", "2"), Value("none"))
    assert codes(mill, "0,20,0", "3,20,0") == ["ZONE 2"]


@pytest.mark.parametrize(
    ("axes", "settings", "words"),
    [
        ("1,2", {"move.to": "3"}, "takes 2 figures"),
        ("1,2", {}, "Give where the axes are sent"),
        ("1,2", {"move.to": "3,3", "move.start": "3,4"}, "The start is not allowed"),
        ("1,2", {"move.to": "3,3", "move.zone": "9"}, "Zone 9 is not set"),
        ("1,1", {"move.to": "3,3"}, "given twice"),
        ("1,2", {"move.to": "3,3", "move.mode": "x"}, "jog or program"),
    ],
)
def test_an_impossible_way_is_one_sentence(
    mill: ParameterFile, axes: str, settings: dict[str, str], words: str
) -> None:
    with pytest.raises(SimulationError, match=words):
        simulate(mill, "travel", axes, settings)


def test_the_picture_is_a_plan_of_both_axes_with_the_zones(mill: ParameterFile) -> None:
    from amp_studio.sim import picture_of

    trace = simulate(mill, "travel", "1,2", {"move.to": "3,3", "move.feedrate": 300.0})
    (panel,) = picture_of(trace).panels
    assert next(curve.name for curve in panel.curves).startswith("programmable zone 2")
    assert trace.letter == "X,Y"


def test_an_axis_that_rests_on_its_limit_stops_no_other() -> None:
    """Positive Software Overtravel of Y is 6 mm: a start there is allowed."""
    move = {"move.start": "0,6", "move.to": "3,6", "move.feedrate": 3000.0}
    assert simulate(open_file(MILL).file, "travel", "1,2", move).alarms == ()
