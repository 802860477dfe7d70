"""What a move of a Syntec axis recommends, and that the recommended value ends its cause."""

from pathlib import Path

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.sim import Trace, simulate

EXAMPLE = Path(__file__).parents[3] / "examples" / "syntec-mill" / "SYNTEC_MILL.amp"


def mill(rapid: int, time: int = 2000) -> ParameterFile:
    file = open_file(EXAMPLE).file
    file.set(("feed.rapid", "3"), Value(rapid, "mm/min"))
    file.set(("dda.interpolation_time", ""), Value(time))
    return file


def moved(file: ParameterFile, **model: float) -> Trace:
    return simulate(file, "step", "3", {f"model.{name}": value for name, value in model.items()})


def test_the_example_needs_nothing() -> None:
    assert moved(mill(24000)).recommendations == ()


def test_too_many_pulses_lower_the_rapid_feedrate_to_62_472_m_a_minute() -> None:
    trace = moved(mill(70000))
    assert [alarm.code for alarm in trace.alarms] == ["MOT-005"]
    (found,) = trace.recommendations
    assert (found.parameter, found.value) == ("feed.rapid", 62472.0)  # 1.4.2
    assert moved(mill(int(found.value))).alarms == ()


def test_a_long_interpolation_time_is_shortened_before_the_feedrate_is_lowered() -> None:
    (found,) = moved(mill(40000, 4000)).recommendations
    assert (found.parameter, found.value) == ("dda.interpolation_time", 3123.0)
    assert moved(mill(40000, int(found.value))).alarms == ()


def test_a_ramp_beyond_a_known_torque_is_made_longer() -> None:
    (found,) = moved(mill(24000), acceleration_per_output=10.0).recommendations
    assert (found.parameter, found.value) == ("motion.axis_acceleration", 250.0)


def test_an_assumed_torque_lengthens_no_ramp() -> None:
    assert moved(mill(24000), coulomb_friction=150.0).recommendations == ()
