"""An axis of AcroMill bound from a file, and its servo loop sample by sample, with the page of the guide."""

import pytest

from amp_studio.families.acromill import law_sample as loop
from amp_studio.families.acromill.law import LAW
from amp_studio.files import ParameterFile
from amp_studio.schema import Value, load_schema
from amp_studio.sim import SimulationError, simulate, simulated_axes
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.engine.signals import (
    COMMAND,
    COMMAND_ACCELERATION,
    COMMAND_VELOCITY,
    MODE,
    MOTOR,
    OUTPUT,
    OUTPUT_TEST,
    POSITION,
    STOP,
    VELOCITY_LOOP,
)

TUNED = {
    "servo.p_gain": Value(0.01, "V/count"),
    "servo.d_gain": Value(0.0001, "Vs/count"),
    "axes.excess_error_band": Value(6.35, "mm"),
    "axes.inposition_band": Value(0.01, "mm"),
}


@pytest.fixture(autouse=True)
def plain_python(monkeypatch: pytest.MonkeyPatch) -> None:
    """Short runs: compiling would take longer."""
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")


def file_of(**changes: Value | None) -> ParameterFile:
    """Return a new file with axis X tuned; changes by parameter id with ``__`` for the point."""
    file = ParameterFile(load_schema("acromill"))
    for parameter in load_schema("acromill").parameters:
        if parameter.startswith(("servo.", "axes.", "tuning.", "speeds.")):
            instance = "" if parameter.startswith("speeds.") or parameter.endswith("servo_period") else "X"
            file.set((parameter, instance), file.default((parameter, instance)))
    for parameter, value in (TUNED | {n.replace("__", "."): v for n, v in changes.items()}).items():
        file.set(
            (parameter, "" if parameter.startswith(("speeds", "tuning.servo_period", "view")) else "X"), value
        )
    return file


# -- the file --------------------------------------------------------------------------------------


def test_a_new_file_moves_at_the_top_speed_of_the_machine_with_its_rapid_ramp() -> None:
    axis = bind_axis(file_of(), LAW)
    assert axis.servo_period == pytest.approx(0.0005)  # page 113
    assert axis.feedrate == pytest.approx(
        200 * 25.4 / 60
    )  # Max Machine Speed, page 74; Rapid Speed is not set
    assert axis.ramps["linear"].acceleration == pytest.approx(100 * 25.4)
    assert axis.machine.motor_count == pytest.approx(25.4 / 10000)


def test_the_machine_of_the_file_is_named_as_assumed_and_each_figure_can_be_set() -> None:
    trace = simulate(file_of(), "step", settings={"move.distance": 5.0})
    assumed = [line for line in trace.assumptions if line.startswith("ASSUMED")]
    assert len(assumed) == 4
    assert all("test motor of appendix C" in line for line in assumed)
    own = simulate(file_of(), "step", settings={"move.distance": 5.0, "model.delay": 0.2})
    assert not any("model.delay" in line for line in own.assumptions)


def test_the_steady_error_is_the_predicted_one() -> None:
    result = simulate(file_of(), "step").result
    predicted, measured = result["predicted_steady_following_error"][0], result["steady_following_error"][0]
    assert predicted is not None
    assert measured == pytest.approx(predicted, rel=0.01)


def test_with_the_integral_at_work_the_steady_error_is_that_of_the_prediction_none() -> None:
    # Page 128: no error is left; counts that go to and fro around 0 are none.
    file = file_of(servo__i_gain=Value(0.5, "V/count/s"), servo__i_limit=Value(2.0, "V"))
    result = simulate(file, "step", settings={"move.distance": 60.0}).result
    assert result["predicted_steady_following_error"][0] == 0.0
    assert result["steady_following_error"][0] == pytest.approx(0.0, abs=0.2 * 25.4 / 10000)


def test_a_move_is_over_where_dry_friction_keeps_the_axis() -> None:
    trace = simulate(file_of(axes__inposition_band=None), "step")
    assert 1.0 < abs(float(trace.columns["following_error"][-1])) / (25.4 / 10000) < 4.88  # 0.0488 V / 0.01 V
    assert float(trace.columns["time_s"][-1]) < 1.0
    assert trace.result["settle_time"][0] is None


def test_an_axis_beyond_its_excess_error_ends_with_the_alarm() -> None:
    trace = simulate(file_of(axes__excess_error_band=Value(0.01, "mm")), "step")
    assert [alarm.code for alarm in trace.alarms] == ["EXCESS ERROR"]


def test_without_an_excess_error_band_the_result_shows_it() -> None:
    trace = simulate(
        file_of(axes__excess_error_band=Value(0.0, "mm")), "step", settings={"move.distance": 1.0}
    )
    assert trace.alarms == ()
    assert any("ExcessErr Band is 0" in line for line in trace.assumptions)


def test_axes_are_as_many_as_the_number_of_axes_shows() -> None:
    assert simulated_axes(file_of()) == ("X", "Y", "Z", "A", "B", "C", "U", "V")
    assert simulated_axes(file_of(view__number_of_axes=Value(2, ""))) == ("X", "Y")


@pytest.mark.parametrize(
    ("parameter", "value", "message"),
    [
        ("servo__p_gain", Value(0.0, "V/count"), "P Gain of axis X is 0: the loop is open"),
        ("axes__pulses_per_unit", Value(0.0, "counts/mm"), "it can be simulated from 0.001"),
        ("tuning__servo_period", Value(0.0, "us"), "it can be simulated from 0.01"),
        ("tuning__notch_width", Value(50.0, "Hz"), "NOTCH takes a frequency and a width"),
        ("servo__torque_limits", Value(0.0, "V"), "Torque Limits of axis X is 0"),
        ("tuning__dac_gain", Value(0.0, ""), "the output has no use"),
        ("speeds__rapid_acc_dec", Value(-1.0, "mm/s2"), "Master Rapid ACC/DEC of axis X is -1"),
        ("servo__p_gain", Value(1e300, "V/count"), "it can be simulated from"),
        ("view__number_of_axes", Value(0, ""), "Number of Axes .* is 0"),
        ("servo__d_gain", None, "^D Gain is not set for axis X"),
    ],
)
def test_what_cannot_be_simulated_is_shown_in_a_sentence(
    parameter: str, value: Value | None, message: str
) -> None:
    with pytest.raises(SimulationError, match=message):
        simulate(file_of(**{parameter: value}), "step")


def test_advice_gives_the_feed_forward_of_the_printed_equation() -> None:
    # Page 115: P Gain × error / speed.
    file = file_of()
    trace = simulate(file, "step", settings={"model.coulomb_friction": 0.0})
    (advice,) = (each for each in trace.recommendations if each.parameter == "servo.vel_ffwd")
    assert advice.value == pytest.approx(0.0000015, rel=0.01)  # the viscous friction of the plant


def test_the_advice_is_the_same_for_a_move_in_the_negative_direction() -> None:
    trace = simulate(file_of(), "step", settings={"move.distance": -14.0})
    (advice,) = (each for each in trace.recommendations if each.parameter == "servo.vel_ffwd")
    assert advice.value == pytest.approx(0.00000296, rel=0.01)  # dry friction too: 0.099 V at 33333 pulses/s


def test_a_loop_without_d_gain_is_advised_one_that_stops_its_ringing() -> None:
    # Page 115: the ringing is due to not enough DGAIN in relation to the PGAIN.
    file = file_of(servo__d_gain=Value(0.0, "Vs/count"))
    before = simulate(file, "step", settings={"move.distance": 10.0})
    assert "servo.d_gain" in {each.parameter for each in before.recommendations}
    for each in before.recommendations:
        file.set((each.parameter, "X"), Value(each.value, each.unit))
    after = simulate(file, "step", settings={"move.distance": 10.0})
    assert before.alarms
    assert after.alarms == ()
    assert after.result["overshoot"][0] < 0.02 * 10.0


# -- the loop, one sample at a time ----------------------------------------------------------------


def volts(io: dict[int, float], s: list[float] | None = None, **p: float) -> float:
    """Return the output of one servo period of 1 ms; 1 pulse is 1 u."""
    parameters = [0.0] * loop.PARAMETERS
    parameters[loop.PULSES] = parameters[loop.DAC_SHARE] = parameters[loop.D_PERIODS] = 1.0
    parameters[loop.PERIOD], parameters[loop.TORQUE_LIMIT] = 0.001, 10.0
    parameters[loop.FILTERS] = parameters[loop.FILTERS + 5] = 1.0
    for name, value in p.items():
        parameters[getattr(loop, name)] = value
    signals = [0.0] * 24
    for place, value in io.items():
        signals[place] = value
    loop.position_sample(parameters, [0.0] * loop.STATE if s is None else s, signals)
    return signals[OUTPUT] if signals[STOP] == 0.0 else -99.0


def test_a_new_file_shows_that_nothing_damps_it_and_that_d_gain_does() -> None:
    # Page 59: D Gain is delivered as 0; page 115 sets it before P Gain.
    file = file_of(servo__d_gain=Value(0.0, "Vs/count"), servo__p_gain=Value(0.00244, "V/count"))
    unstable = simulate(file, "step", "X", system="metric")
    assert unstable.alarms[0].code == "UNSTABLE"
    assert "D Gain is 0, as in a new file (page 59)" in unstable.alarms[0].message
    for scenario in ("frequency", "circle"):
        assert "Set D Gain first" in simulate(file, scenario, "X").alarms[0].message
    wanted = {each.parameter: each for each in unstable.recommendations}
    assert wanted["servo.d_gain"].price.startswith("Every count")
    assert "your choice" in wanted["servo.d_gain"].price  # nothing else damps it, and the machine is assumed
    assert not any("No gains within their bounds" in text for text in unstable.assumptions)
    for each in wanted.values():
        file.set((each.parameter, "X"), Value(each.value, each.unit))
    assert not simulate(file, "step", "X").alarms


def test_every_gain_has_its_printed_unit() -> None:
    # Pages 59 and 113: volts for a pulse, a pulse/s, a pulse/s².
    assert volts({COMMAND: 8.0, POSITION: 5.0}, P_GAIN=0.5) == pytest.approx(1.5)
    assert volts({COMMAND: 3.0}, D_GAIN=0.001) == pytest.approx(3.0)  # 3 pulses in 1 ms are 3000 pulses/s
    assert volts({COMMAND_VELOCITY: 2000.0}, VEL_FFWD=0.001) == pytest.approx(2.0)
    assert volts({COMMAND_ACCELERATION: 500.0}, ACC_FFWD=0.002) == pytest.approx(1.0)
    assert volts({MOTOR: 2.0}, FBVEL=0.001) == pytest.approx(-2.0)  # taken off the output, page 135


def test_the_integral_rises_by_its_gain_a_second_up_to_its_limit() -> None:
    s = [0.0] * loop.STATE
    seen = [volts({COMMAND: 10.0}, s, I_GAIN=100.0, I_LIMIT=2.5) for _ in range(4)]
    assert seen == pytest.approx([1.0, 2.0, 2.5, 2.5])  # 10 pulses × 100 V/s/pulse × 1 ms


def test_the_integral_waits_until_the_axis_has_not_been_commanded_for_its_delay() -> None:
    s, gains = [0.0] * loop.STATE, {"I_GAIN": 100.0, "I_LIMIT": 9.0, "I_DELAY": 0.0025}
    assert volts({COMMAND: 10.0, COMMAND_VELOCITY: 1.0}, s, **gains) == 0.0
    assert [volts({COMMAND: 10.0}, s, **gains) for _ in range(4)] == pytest.approx([0.0, 0.0, 1.0, 2.0])


def test_the_derivative_is_sampled_every_derivative_width_and_kept() -> None:
    s = [0.0] * loop.STATE
    seen = [volts({COMMAND: each}, s, D_GAIN=0.001, D_PERIODS=2.0) for each in (2.0, 3.0, 6.0, 7.0)]
    assert seen == pytest.approx([1.0, 1.0, 2.0, 2.0])  # (2 - 0) and (6 - 2) pulses in 2 ms


def test_the_torque_limit_is_behind_gains_and_filters() -> None:
    assert volts({COMMAND: 50.0}, P_GAIN=1.0, TORQUE_LIMIT=4.0) == 4.0
    assert volts({COMMAND: -50.0}, P_GAIN=1.0, TORQUE_LIMIT=4.0) == -4.0


def test_the_filters_are_the_printed_difference_equation() -> None:
    # (a0 + a1/z + a2/z²) / (1 - b1/z - b2/z²) by hand: 1, 0.5 + 0.5, 0.25 + 0.5·1 + 0.1·1 ... of an impulse.
    s = [0.0] * loop.STATE
    parameters = [0.0] * loop.PARAMETERS
    parameters[loop.PULSES] = parameters[loop.DAC_SHARE] = parameters[loop.D_PERIODS] = 1.0
    parameters[loop.PERIOD], parameters[loop.TORQUE_LIMIT], parameters[loop.P_GAIN] = 0.001, 10.0, 1.0
    parameters[loop.FILTERS : loop.FILTERS + 6] = [1.0, 0.5, 0.25, 0.5, 0.1, 1.0]
    seen = []
    for command in (1.0, 0.0, 0.0, 0.0):
        signals = [0.0] * 24
        signals[COMMAND] = command
        loop.position_sample(parameters, s, signals)
        seen.append(signals[OUTPUT])
    assert seen == pytest.approx([1.0, 1.0, 0.85, 0.525])


def test_the_output_is_in_words_of_the_converter() -> None:
    assert volts({COMMAND: 1.0}, P_GAIN=0.0005, DAC_WORDS=3276.8) == pytest.approx(2 / 3276.8)  # page 114
    assert volts({COMMAND: 1.0}, P_GAIN=3.0, DAC_SHARE=2.0) == pytest.approx(6.0)


def test_d_gain_alone_resists_a_push_and_never_brings_the_axis_back() -> None:
    # Steps 8 and 9 of page 115: open loop, the shaft resists but does not correct.
    s = [0.0] * loop.STATE
    assert volts({POSITION: 5.0}, s, D_GAIN=0.001) == pytest.approx(-5.0)
    assert volts({POSITION: 5.0}, s, D_GAIN=0.001) == 0.0


def test_the_modes_of_the_scenarios() -> None:
    assert volts({MODE: OUTPUT_TEST, COMMAND: 3.0}) == 3.0
    assert volts({MODE: OUTPUT_TEST, COMMAND: 30.0}) == 10.0
    assert volts({MODE: VELOCITY_LOOP, COMMAND_VELOCITY: 2000.0}, P_GAIN=9.0, D_GAIN=0.001) == pytest.approx(
        2.0
    )


def test_an_error_beyond_the_excess_error_stops_the_run() -> None:
    assert volts({COMMAND: 3.0}, EXCESS=3.0) == 0.0
    assert volts({COMMAND: 3.1}, EXCESS=3.0) == -99.0
