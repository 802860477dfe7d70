"""Homing, jogs and stroke limits of a Syntec axis (2.2, 3.2)."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.sim import SimulationError, simulate

MILL = Path(__file__).parents[3] / "examples" / "syntec-mill" / "SYNTEC_MILL.amp"
SWITCH = {"move.switch": 20.0, "move.marker": 1.0}


def mill(**changes: Value) -> ParameterFile:
    """Return the example mill with axis 1 homed in the positive direction;
    changes by parameter id with ``__`` for the point.
    """
    file = open_file(MILL).file
    given = {"home.direction": Value("positive"), "home.grid": Value(False), "home.offset": Value(0)}
    for parameter, value in (
        given | {name.replace("__", "."): value for name, value in changes.items()}
    ).items():
        file.set((parameter, "1"), value)
    return file


@pytest.mark.parametrize(
    ("method", "home", "coordinate"),
    [
        ("offset", 21.0, 0.0),  # on the index 1 mm off the dog, and 2 mm on; there it is 0
        ("stay", 19.0, 2.0),  # on the index, which is called 2
        ("dog-only", 22.0, 0.0),  # 2 mm from the end of the dog
    ],
)
def test_the_methods_end_where_the_slides_say(method: str, home: float, coordinate: float) -> None:
    file = mill(home__search_method=Value(method), home__offset=Value(2000))
    found = simulate(file, "home", "1", SWITCH).result
    assert found["home_from_start"][0] == pytest.approx(home, abs=0.01)
    assert found["home_position"] == (coordinate, "mm")
    assert found["stop_position"][0] == pytest.approx(coordinate, abs=0.005)


def test_index_only_goes_to_the_first_index() -> None:
    found = simulate(mill(home__search_method=Value("index-only")), "home", "1", {"move.marker": 3.0}).result
    assert found["home_from_start"][0] == pytest.approx(3.0)
    assert "switch_overrun" not in found


def test_home_grid_passes_an_index_over_that_is_nearer_than_half_a_turn() -> None:
    near = simulate(mill(), "home", "1", SWITCH).result
    grid = simulate(mill(home__grid=Value(True)), "home", "1", SWITCH).result
    assert near["home_from_start"][0] == pytest.approx(19.0)
    turn = near["home_from_start"][0] - grid["home_from_start"][0]
    assert turn == pytest.approx(5.0)  # the pitch of the example


def test_beyond_a_stroke_limit_the_axis_runs_on_by_its_following_error() -> None:
    trace = simulate(mill(), "travel", "1", {"move.feedrate": 6000.0})
    assert trace.result["limit"] == (400.0, "mm")
    assert trace.alarms[0].code == "MOT-017"
    assert trace.result["overrun"][0] == pytest.approx(
        6000.0 / 60.0 / 30.0, rel=0.1
    )  # speed / loop gain, 1.5.3
    assert any("the slides print the alarm alone" in text for text in trace.assumptions)


def test_a_jog_goes_at_its_speed_and_has_no_increment() -> None:
    trace = simulate(mill(jog__feedrate=Value(1200, "mm/min")), "jog", "1", {"move.hold": 0.5})
    assert trace.result["feedrate"] == (1200.0, "mm/min")
    with pytest.raises(SimulationError, match="No jog increment of this axis is set"):
        simulate(mill(), "jog", "1", {"move.increment": "1"})


def test_a_first_speed_whose_following_error_is_more_than_two_turns_finds_the_dog() -> None:
    # 20 m/min at a loop gain of 30/s are 11 mm of following error, two turns of 5 mm: the command ended
    # before the axis was there.
    file = mill(home__first_speed=Value(20000, "mm/min"), home__zero_speed_window=Value(1000))
    trace = simulate(file, "home", "1")
    overrun = trace.result["switch_overrun"][0]
    assert overrun is not None
    # It stops so far beyond the edge that 5 pitches back do not leave the dog (2.2, alarms).
    assert overrun > 5.0 * 5.0
    assert [alarm.code for alarm in trace.alarms] == ["MOT-036"]


FAST = 3000.0


@pytest.mark.parametrize(
    ("move", "values", "code"),
    [
        ({"move.marker": "none"}, {}, "MOT-029"),
        ({"move.dog": "stuck"}, {}, "MOT-036"),
        ({"move.homings": 5.0, "move.scatter": 2.0}, {}, "MOT-022"),
        ({}, {"home__zero_speed_window": Value(1)}, "MOT-030"),
    ],
)
def test_a_homing_fails_as_the_slides_print_it(
    move: dict[str, float | str], values: dict[str, Value], code: str
) -> None:
    """Chapter 2, alarms: no index in 5 pitches, dog not left, home grids 0.1 turn apart,
    not at rest 0.1 s after the stop.
    """
    found = simulate(mill(home__first_speed=Value(FAST, "mm/min"), **values), "home", "1", move)
    assert [alarm.code for alarm in found.alarms] == [code]
    assert found.result["home_position"] == (None, "mm")


def test_the_protective_revolution_replaces_the_5_pitches() -> None:
    file = mill(home__first_speed=Value(FAST, "mm/min"), home__protective_turns=Value(2))
    stuck = simulate(file, "home", "1", {"move.dog": "stuck"})
    assert "2 turns" in stuck.alarms[0].message
    travelled = stuck.columns["command_position"]
    assert abs(travelled[-1] - travelled.max()) == pytest.approx(2.0 * 5.0, abs=5.0)


@pytest.mark.parametrize(
    ("marker", "grid", "passed"), [(1.0, 20.0, 6.0), (1.75, 35.0, 6.75), (4.5, 90.0, 4.5)]
)
def test_home_grid_is_shown_and_an_index_below_half_a_turn_is_passed(
    marker: float, grid: float, passed: float
) -> None:
    """Home grid (2.2): 35 becomes 135 with Pr941; recommended below 20 and above 80."""
    plain = simulate(mill(home__first_speed=Value(FAST, "mm/min")), "home", "1", {"move.marker": marker})
    assert plain.result["home_grid"][0] == pytest.approx(grid, abs=0.1)
    advised = [each for each in plain.recommendations if each.parameter == "home.grid"]
    assert bool(advised) == (plain.result["home_grid"][0] < 20.0 or grid > 80.0)
    with_grid = mill(home__first_speed=Value(FAST, "mm/min"), home__grid=Value(True))
    gone = simulate(with_grid, "home", "1", {"move.marker": marker}).result["home_grid"][0]
    assert gone == pytest.approx(passed / 5.0 * 100.0, abs=0.1)


def test_repeatability_over_the_scatter_of_the_dog() -> None:
    file = mill(home__first_speed=Value(FAST, "mm/min"))
    near = simulate(file, "home", "1", {"move.homings": 6.0, "move.scatter": 0.2, "move.marker": 1.5}).result
    assert near["repeatability"][0] == 0.0  # the same index each time


def test_a_zone_is_not_called_not_set_where_zones_are_not_simulated() -> None:
    with pytest.raises(SimulationError, match="Programmable zones of this family are not simulated"):
        simulate(mill(), "travel", "1", {"move.zone": "2"})
