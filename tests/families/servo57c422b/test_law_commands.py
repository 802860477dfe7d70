"""Tune commands, gearing, cams and backlash compensation of the 57C422B as scenarios,
with the page of the manual.
"""

from collections.abc import Mapping

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.schema import Value
from amp_studio.sim import SimulationError, Trace, simulate
from tests.families.servo57c422b.test_law import file_of

REGISTERS = {
    "command.position": Value(1000, "counts"),
    "setup.overtravel_positive": Value(30_000, "counts"),
    "setup.overtravel_negative": Value(-30_000, "counts"),
    "output.backlash": Value(20, "counts"),
    "command.gear_ratio": Value(0.5, ""),
    "cam.points": Value(4, ""),
    "cam.time": Value(12.5, "ms"),
    "cam.position_increment": Value(1000, "counts"),
}
CAM = (10, 20, 20, 10)


@pytest.fixture(autouse=True)
def plain_python(monkeypatch: pytest.MonkeyPatch) -> None:
    """Short runs: compiling would take longer."""
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")


def module(**changes: Value | None) -> ParameterFile:
    """Return the file of page 5-5 with data for the commands;
    changes by parameter id with ``__`` for the point.
    """
    file = file_of()
    for parameter, value in (REGISTERS | {n.replace("__", "."): v for n, v in changes.items()}).items():
        file.set((parameter, "X"), value)
    for point, travel in enumerate(CAM):
        file.set(("cam.time_points", f"X.{point}"), Value(travel, "counts"))
    return file


def run(file: ParameterFile, scenario: str, **settings: float | str) -> Trace:
    return simulate(
        file, scenario, settings={name.replace("__", "."): value for name, value in settings.items()}
    )


def values(trace: Trace) -> Mapping[str, float | None]:
    return {name: value for name, (value, _) in trace.result.items()}


# -- tune commands ---------------------------------------------------------------------------------


def test_tune_gains_leaves_its_four_registers_near_the_printed_programs() -> None:
    # Page 4-30: registers 3, 4, 5 and 7; the programs end at 18700 and 17595, 1575 and 768, 140 and 78, 27
    # and 28.
    trace = run(module(gain__velocity=Value(25, ""), gain__deadband=Value(0, "")), "procedure")
    left = values(trace)
    assert list(left)[:4] == ["deadband", "velocity_gain", "integral_gain", "proportional_gain"]
    assert left["deadband"] == 27  # the dry friction of the assumed motor
    assert 78 <= left["velocity_gain"] <= 250
    assert 8_000 <= left["proportional_gain"] <= 20_000
    assert 300 <= left["integral_gain"] <= 1600
    assert trace.recommendations == ()  # gains are the solver's
    assert trace.alarms == ()


def test_tune_gains_leaves_the_velocity_gain_of_a_velocity_reference_alone() -> None:
    trace = run(module(gain__velocity=Value(0, "")), "procedure", tune__command="gains")
    assert "velocity_gain" not in values(trace)


def test_tune_gains_needs_its_increment() -> None:
    with pytest.raises(SimulationError, match="R17 Command Position is not set: tune gains moves by it"):
        run(module(command__position=None), "procedure")


@pytest.mark.parametrize(
    ("model", "message"),
    [
        ({"model.coulomb_friction": 20.0}, "its friction is above Maximum Voltage Reference"),
        ({"model.delay": 50.0}, "The shaft vibrates at a Velocity Gain of 25"),
        ({"model.acceleration_per_output": 1.0}, "gains that are not stable"),
    ],
)
def test_a_motor_that_cannot_be_tuned_is_shown_in_a_sentence(model: dict[str, float], message: str) -> None:
    with pytest.raises(SimulationError, match=message):
        simulate(module(), "procedure", settings=model)


def test_tune_dynamics_finds_what_the_axis_can_do_up_to_its_registers() -> None:
    # Page 4-30: registers 19 to 24 limit what is found and then contain it.
    at_limit = run(module(), "procedure", tune__command="dynamics")
    assert values(at_limit)["command_velocity"] == 40_000
    free = module()
    for name, unit in (
        ("velocity", "counts/s"),
        ("acceleration", "counts/s2"),
        ("deceleration", "counts/s2"),
    ):
        free.set((f"command.{name}", "X"), Value(1e8 if unit == "counts/s2" else 1e6, unit))
    found = values(run(free, "procedure", tune__command="dynamics"))
    assert 40_000 < found["command_velocity"] < 1e6
    assert 200_000 < found["command_acceleration"] < 1e8
    assert 0.2 <= found["command_deceleration"] / found["command_acceleration"] <= 5.0  # page 4-14


def test_tune_feedforward_nulls_the_error_at_speed() -> None:
    # Page 4-31; the programs end at 8256 and 8320, the assumed motor stops between both.
    trace = run(module(gain__feedforward=Value(0, "")), "procedure", tune__command="feedforward")
    assert values(trace)["feedforward_gain"] == pytest.approx(8260, abs=10)


def test_tune_feedforward_refuses_travel_that_is_too_short() -> None:
    with pytest.raises(SimulationError, match="does not reach 40000 counts/s within 500 counts"):
        run(module(setup__overtravel_positive=Value(500, "counts")), "procedure", tune__command="feedforward")
    with pytest.raises(SimulationError, match="Unknown tune command 'all'"):
        run(module(), "procedure", tune__command="all")


def test_tuned_in_the_printed_order_an_axis_moves_and_rests_within_its_tolerance() -> None:
    # Page 4-29: gains, dynamics, feedforward; what each leaves is applied before the next.
    file = module(gain__velocity=Value(25, ""), gain__deadband=Value(0, ""), gain__feedforward=Value(0, ""))
    for command in ("gains", "dynamics", "feedforward"):
        trace = run(file, "procedure", tune__command=command)
        for left in trace.recommendations:
            file.set((left.parameter, "X"), Value(left.value, left.unit))
        for name in ("deadband", "velocity_gain", "integral_gain", "proportional_gain", "feedforward_gain"):
            if name in trace.result:
                register = f"gain.{name.removesuffix('_gain')}"
                file.set((register, "X"), Value(int(values(trace)[name] or 0), ""))
    trace = run(file, "step", move__distance=20_000.0)
    assert trace.alarms == ()
    assert trace.result["settle_time"][0] is not None
    assert trace.result["peak_following_error"][0] < 15.0


# -- backlash --------------------------------------------------------------------------------------


def test_backlash_compensation_moves_as_the_manual_prints_it() -> None:
    # Page 4-21: +20; a move of 100 counts and a stop; one of -100 goes to -120, then +20.
    assert values(run(module(), "backlash", move__distance=100.0))["move_1"] == 100
    trace = run(module(), "backlash", move__distance=-100.0)
    assert [values(trace)[name] for name in ("move_1", "move_2")] == [-120, 20]
    command = trace.columns["command_position"]
    assert float(command.min()) == pytest.approx(-120.0)
    assert float(command[-1]) == pytest.approx(-100.0)


# -- gearing ---------------------------------------------------------------------------------------


def test_a_geared_axis_comes_to_the_speed_of_its_master_with_the_acceleration_of_register_21() -> None:
    # Page 4-21: ramp velocity control, register 38 bit 3.
    found = values(run(module(gearing__modes=Value(8, "")), "gear"))
    assert found["speed"] == 40_000 * 60
    assert found["lost_in_ramp"] == pytest.approx(40_000**2 / (2 * 200_000), rel=0.01)


def test_without_ramp_velocity_control_the_axis_trips_on_a_moving_master() -> None:
    trace = run(module(), "gear")  # page 4-24: in current limit
    assert [alarm.code for alarm in trace.alarms] == ["VELOCITY ERROR"]
    assert "R9 Maximum Velocity Error" in trace.alarms[0].message
    found = values(trace)
    assert (found["time"], found["stop_position"], "lost_in_ramp" in found) == (None, None, False)
    with pytest.raises(SimulationError, match="gearing is not enabled"):
        run(module(command__gear_ratio=Value(0.0, "")), "gear")


# -- cams ------------------------------------------------------------------------------------------


def test_a_time_cam_ends_where_its_travels_add_up() -> None:
    # Pages 4-49 and 4-54; word format, once: 4 points of 12.5 ms.
    trace = run(module(cam__mode=Value(1, "")), "cam")
    assert values(trace)["time"] == pytest.approx(0.05)
    assert float(trace.columns["command_position"][-1]) == sum(CAM)


def test_a_time_cam_in_bytes_takes_the_low_byte_of_each_register_first() -> None:
    # Page 4-49: two values a register, -128 to 127.
    file = module(cam__mode=Value(0, ""), cam__points=Value(3, ""))
    for pair, word in enumerate((0xFB0A, 0x0007)):
        file.set(("cam.byte_points", f"X.{pair}"), Value(word, ""))
    command = run(file, "cam").columns["command_position"]
    assert [float(command.max()), float(command[-1])] == [12.0, 12.0]  # 10, then -5, then 7


def test_a_continuous_time_cam_returns_to_the_loop_back_point() -> None:
    trace = run(module(cam__mode=Value(9, ""), cam__loop_back=Value(2, "")), "cam", cam__cycles=2.0)
    assert float(trace.columns["command_position"][-1]) == 10 + 20 + 20 + 10 + 20 + 10 + 20 + 10


def test_the_velocity_error_of_a_cam_is_what_register_9_has_to_be_above() -> None:
    """Page 4-9: beyond register 9, in steps of 800 counts/s, the loop is switched off."""
    press = open_file(examples_folder() / "57c422b-label-press" / "LABEL_PRESS.amp").file
    predicted = simulate(press, "cam", "Y", advise=False).result["peak_velocity_error"]
    assert predicted[1] == "counts/s"
    assert predicted[0] is not None
    for limit, tripped in ((predicted[0] * 0.9, True), (predicted[0] + 800.0, False)):
        press.set(("setup.max_velocity_error", "Y"), Value(limit, "counts/s"))
        assert bool(simulate(press, "cam", "Y", advise=False).alarms) is tripped


def test_a_position_cam_follows_its_master() -> None:
    file = module(cam__mode=Value(256, ""), cam__points=Value(3, ""))
    for point, position in enumerate((0, 250, 100)):
        file.set(("cam.position_points", f"X.{point}"), Value(position, "counts"))
    trace = run(file, "cam", cam__speed=10_000.0)
    assert values(trace)["time"] == pytest.approx(0.2, abs=0.002)  # 2 increments of 1000 counts
    assert float(trace.columns["command_position"].max()) == pytest.approx(250.0, abs=5.0)
    assert float(trace.columns["command_position"][-1]) == pytest.approx(100.0)


@pytest.mark.parametrize(
    ("scenario", "setting", "value", "message"),
    [
        ("cam", "cam.cycles", 1.5, "it must be a whole number"),
        ("cam", "cam.cycles", 1e9, "at most 60 s are simulated"),
        ("cam", "cam.mirror", "maybe", "it must be yes or no"),
        ("gear", "gear.speed", 1e300, "are simulated"),
        ("gear", "gear.time", 1e9, "at most 60 s are simulated"),
        ("backlash", "move.distance", 0.0, "it must be 1 count"),
        ("backlash", "move.distance", 1e300, "it must be 1 count"),
        ("procedure", "tune.gains", 1.0, "Unknown setting 'tune.gains'"),
    ],
)
def test_an_absurd_setting_is_answered_in_a_sentence(
    scenario: str, setting: str, value: float | str, message: str
) -> None:
    with pytest.raises(SimulationError, match=message):
        simulate(module(cam__mode=Value(1, "")), scenario, settings={setting: value})


def test_a_cam_with_a_missing_point_names_it() -> None:
    with pytest.raises(SimulationError, match="Point 4 of the cam is not set, and R128"):
        run(module(cam__mode=Value(1, ""), cam__points=Value(5, "")), "cam")
    with pytest.raises(SimulationError, match="has 1 to 1915 points"):
        run(module(cam__mode=Value(1, ""), cam__points=Value(2_000_000_000, "")), "cam")
    with pytest.raises(SimulationError, match="Point 0 of the cam is not set"):
        run(
            module(cam__mode=Value(0, ""), cam__points=Value(2, "")), "cam"
        )  # in bytes, of which there are none
