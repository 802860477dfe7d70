"""An axis driven by a handwheel: NUM by P12 to P14 (4-28 to 5-12), Syntec by Pr661 and Pr2001 to 2041
(4.1)."""

import pytest

from amp_studio.files import ParameterFile
from amp_studio.schema import Value
from amp_studio.sim import SimulationError, Trace, simulate
from tests.programs.test_block import example


def turned(file: ParameterFile, axis: str, **settings: float | str) -> Trace:
    moves = {f"move.{name}": value for name, value in settings.items()}
    return simulate(file, "handwheel", axis, moves, advise=False)


@pytest.fixture
def num() -> ParameterFile:
    return example("num-1060-mill")


@pytest.fixture
def syntec() -> ParameterFile:
    return example("syntec-mill")


def test_100_lines_times_4_times_1_over_4_are_100_internal_units(num: ParameterFile) -> None:
    """Page 5-12: movement = lines x 4 x MULTI / DIVI, here of 1 um."""
    trace = turned(num, "X", marks=100.0)
    assert trace.result["distance"] == (pytest.approx(0.1), "mm")
    assert trace.result["step"] == (pytest.approx(0.001), "mm")
    assert trace.columns["position"][-1] == pytest.approx(0.1, abs=0.02)


def test_a_wheel_mounted_the_other_way_moves_the_axis_back(num: ParameterFile) -> None:
    """Page 5-10: a bit of P12 reverses the measurement."""
    num.set(("measure.handwheel_direction", ""), Value(1))
    assert turned(num, "X").columns["position"][-1] < -0.08


def test_an_axis_that_turns_has_the_second_pair_unless_it_is_0(num: ParameterFile) -> None:
    """Page 5-12, words N10 to N17."""
    assert turned(num, "B").result["distance"] == (pytest.approx(0.01), "deg")
    for name in ("multi", "divi"):
        num.set((f"measure.handwheel_rotary_{name}", "1"), Value({"multi": 100, "divi": 4}[name]))
    assert turned(num, "B").result["distance"] == (pytest.approx(1.0), "deg")


def test_only_wheels_that_p14_declares_move_anything(num: ParameterFile) -> None:
    with pytest.raises(SimulationError, match="declares no handwheel 2, but 1"):
        turned(num, "X", wheel="2")
    num.set(("axes.handwheels", ""), Value(0))
    with pytest.raises(SimulationError, match="declares no handwheel"):
        turned(num, "X")


def test_a_wheel_that_is_turned_faster_than_the_axis_may_go_leaves_it_behind(syntec: ParameterFile) -> None:
    """Section 4.1: 100 LIU a pulse and 100 pulses a turn are 10 mm; Pr661 is 2000 mm/min, 3.3 turns a
    second.
    """
    slow, fast = turned(syntec, "X", turns=10.0, rate=1.0), turned(syntec, "X", turns=10.0, rate=10.0)
    assert slow.result["distance"] == fast.result["distance"] == (pytest.approx(100.0), "mm")
    assert slow.result["feedrate"][0] == pytest.approx(600.0)
    assert fast.result["feedrate"][0] == pytest.approx(2000.0)
    assert slow.result["behind"][0] < 1.0
    assert fast.result["behind"][0] == pytest.approx(100.0 - 2000.0 / 60.0, abs=3.0)
    assert fast.result["runs_on"][0] == pytest.approx(2.0, abs=0.5)


def test_without_its_own_feedrate_the_wheel_has_that_of_jog(syntec: ParameterFile) -> None:
    """Section 4.1: Pr661 = 0 is Pr521, here 3000 mm/min."""
    syntec.set(("mpg.feedrate", ""), Value(0, "mm/min"))
    assert turned(syntec, "X", rate=50.0).result["feedrate"][0] == pytest.approx(3000.0)


def test_a_longer_mpg_acceleration_time_starts_the_axis_later(syntec: ParameterFile) -> None:
    quick = turned(syntec, "X", turns=5.0, rate=3.0).result["behind"][0]
    syntec.set(("mpg.acceleration_time", ""), Value(1000, "ms"))
    late = turned(syntec, "X", turns=5.0, rate=3.0).result["behind"][0]
    assert quick is not None
    assert late is not None
    assert late > quick + 5.0


def test_a_wheel_that_belongs_to_another_axis_is_refused(syntec: ParameterFile) -> None:
    """Section 4.1: Pr2031 gives the wheel to one axis, whatever the PLC selects."""
    syntec.set(("mpg.axis", ""), Value("y"))
    with pytest.raises(SimulationError, match="to the Y axis alone"):
        turned(syntec, "X")
    assert turned(syntec, "Y").result["distance"][0] == pytest.approx(10.0)
