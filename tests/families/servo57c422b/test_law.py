"""An axis of the 57C422B bound from its registers, and its control loop scan by scan,
with the page of the manual.
"""

import pytest

from amp_studio.families.servo57c422b import law_sample as loop
from amp_studio.families.servo57c422b.law import LAW
from amp_studio.families.servo57c422b.law_plant import VISCOUS
from amp_studio.files import ParameterFile
from amp_studio.schema import Value, load_schema
from amp_studio.sim import AxisLaw, SimulationError, simulate, simulated_axes
from amp_studio.sim.axis.motion import RunEnd, run_axis
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.command.ramps import end_of, move
from amp_studio.sim.engine.signals import (
    COMMAND,
    COMMAND_VELOCITY,
    MODE,
    MOTOR,
    OUTPUT,
    OUTPUT_TEST,
    STOP,
    VELOCITY_LOOP,
)

PAGE_5_5 = {
    "gain.proportional": Value(18700, ""),
    "gain.integral": Value(1575, ""),
    "gain.velocity": Value(140, ""),
    "gain.feedforward": Value(8256, ""),
    "gain.deadband": Value(27, ""),
    "setup.max_position_error": Value(1000, "counts"),
    "setup.max_velocity_error": Value(6400.0, "counts/s"),
    "setup.in_position_tolerance": Value(40, "counts"),
    "output.max_voltage": Value(10.0, "V"),
    "command.velocity": Value(40_000.0, "counts/s"),
    "command.acceleration": Value(200_000.0, "counts/s2"),
    "command.deceleration": Value(200_000.0, "counts/s2"),
}
"""The setup of the printed program, and a move."""
PAGE_4_48 = {
    "gain__proportional": 17595,
    "gain__integral": 768,
    "gain__velocity": 78,
    "gain__feedforward": 8320,
}


@pytest.fixture(autouse=True)
def plain_python(monkeypatch: pytest.MonkeyPatch) -> None:
    """Short runs: compiling would take longer."""
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")


def file_of(axis: str = "X", **changes: float | None) -> ParameterFile:
    """Return a file with the registers of page 5-5; changes by parameter id with ``__`` for the point."""
    file = ParameterFile(load_schema("57c422b"))
    for parameter, value in PAGE_5_5.items():
        file.set((parameter, axis), value)
    for name, figure in changes.items():
        parameter = name.replace("__", ".")
        unit = PAGE_5_5[parameter].unit if parameter in PAGE_5_5 else ""
        file.set((parameter, axis), None if figure is None else Value(figure, unit))
    return file


def axis_of(**changes: float | None) -> AxisLaw:
    return bind_axis(file_of(**changes), LAW)


# -- the file --------------------------------------------------------------------------------------


def test_a_new_file_shows_in_one_sentence_every_register_that_has_to_be_set() -> None:
    with pytest.raises(SimulationError) as caught:
        simulate(ParameterFile(load_schema("57c422b")), "step", "Y")
    assert "R2051 Proportional Gain, R2052 Integral Gain, R2053 Velocity Gain" in str(caught.value)
    assert "R2079 Maximum Voltage Reference, R2067 Command Velocity" in str(caught.value)


def test_the_axes_are_those_with_a_proportional_gain() -> None:
    assert simulated_axes(file_of("Y")) == ("Y",)
    assert simulated_axes(ParameterFile(load_schema("57c422b"))) == ("X", "Y")


@pytest.mark.parametrize("other", [{}, PAGE_4_48], ids=["page 5-5", "page 4-48"])
def test_both_printed_programs_rest_within_their_tolerance(other: dict[str, float]) -> None:
    result = simulate(file_of(**other), "step").result
    assert result["settle_time"][0] is not None
    assert result["peak_following_error"][0] < 40.0


def test_the_lost_scales_are_named_with_the_result_and_can_be_set() -> None:
    trace = simulate(file_of(gain__integral=0), "step")
    assert "model.feedforward_scale = 8192" in trace.assumptions[0]
    other = simulate(file_of(gain__integral=0), "step", settings={"model.feedforward_scale": 16384.0})
    assert "model.feedforward_scale = 16384" in other.assumptions[0]
    assert other.result["peak_following_error"][0] > 10.0 * trace.result["peak_following_error"][0]
    with pytest.raises(
        SimulationError, match=r"model.velocity_scale of axis X is 0; it can be simulated from"
    ):
        simulate(file_of(), "step", settings={"model.velocity_scale": 0.0})


def test_a_register_counts_speed_times_65_536() -> None:
    # Page 4-13; the program of page 4-48 commands 160000 counts/s.
    schema = load_schema("57c422b").parameters["command.velocity"]
    assert schema.storage is not None
    assert 160_000 * schema.storage.scale == 10_485_760
    assert axis_of(command__velocity=160_000.0).feedrate == 160_000.0


def test_a_velocity_gain_of_0_is_a_drive_with_velocity_reference() -> None:
    axis = axis_of(gain__velocity=0, gain__feedforward=0, gain__integral=0)
    assert axis.machine.velocity_per_output == 100_000.0  # counts/s for 1 V; pages 5-3 and A-1
    trace = simulate(file_of(gain__velocity=0, gain__integral=0, setup__max_velocity_error=None), "step")
    assert trace.alarms == ()
    assert any(
        "a velocity reference is simulated because Velocity Gain is 0" in line for line in trace.assumptions
    )
    slow = simulate(
        file_of(gain__velocity=0, gain__integral=0, setup__max_velocity_error=None),
        "step",
        settings={"model.velocity_per_output": 25_000.0},
    )
    assert slow.result["peak_output"][0] == pytest.approx(4.0 * trace.result["peak_output"][0], rel=0.05)


@pytest.mark.parametrize(
    ("parameter", "value", "message"),
    [
        ("command__acceleration", 0.0, "illegal command fault"),
        ("command__deceleration", -1.0, "illegal command fault"),
        ("gain__proportional", 0.0, "without it the axis does not follow"),
        ("setup__max_position_error", -1.0, "it can be simulated from 0"),
        ("output__max_voltage", 0.0, "it can be simulated from 0.005 to 10"),
        ("output__max_voltage", None, "R31 Maximum Voltage Reference"),
    ],
)
def test_what_cannot_be_simulated_is_shown_in_a_sentence(
    parameter: str, value: float | None, message: str
) -> None:
    with pytest.raises(SimulationError, match=message):
        simulate(file_of(**{parameter: value}), "step")


# -- faults ----------------------------------------------------------------------------------------


def test_a_following_error_beyond_register_8_switches_the_loop_off() -> None:
    changes = {"gain__proportional": 100, "gain__integral": 0, "gain__velocity": 25, "gain__feedforward": 0}
    trace = simulate(file_of(**changes, setup__max_velocity_error=None), "step")
    assert [alarm.code for alarm in trace.alarms] == [
        "POSITION ERROR"
    ]  # step 3 of page 5-3: the gain is too low


def test_a_velocity_error_beyond_register_9_switches_the_loop_off() -> None:
    trace = simulate(file_of(setup__max_velocity_error=400.0), "step")  # half a count a scan
    assert [alarm.code for alarm in trace.alarms] == ["VELOCITY ERROR"]


def test_without_registers_8_and_9_there_is_no_fault_and_the_result_shows_it() -> None:
    trace = simulate(
        file_of(gain__feedforward=0, setup__max_position_error=None, setup__max_velocity_error=None), "step"
    )
    assert trace.alarms == ()
    assert sum("simulated without this fault" in line for line in trace.assumptions) == 2


# -- manual tuning, page 5-3 ------------------------------------------------------------------------


def test_doubling_the_proportional_gain_ends_the_following_error_fault() -> None:
    # Step 3: from 100 on, doubled until the drive runs; gains of 0, 25, 0 beside it.
    gain, faults = 100, 0
    while _stop(gain__proportional=gain, gain__integral=0, gain__velocity=25, gain__feedforward=0):
        gain, faults = 2 * gain, faults + 1
    assert 5 <= faults <= 8
    assert gain < 18_700


def test_a_velocity_gain_far_above_the_printed_ones_makes_the_shaft_vibrate() -> None:
    # Step 4: raised until the shaft vibrates.
    gains = {"gain__proportional": 6400, "gain__integral": 0, "gain__feedforward": 0, "gain__deadband": 0}
    assert _vibration(gain__velocity=140, **gains) < 1.0
    assert _vibration(gain__velocity=700, **gains) > 5.0


def test_the_integral_gain_brings_the_rest_position_to_zero_error() -> None:
    # Step 6: with gravity on the axis.
    for integral, at_least, at_most in ((0, 3.0, 30.0), (1575, 0.0, 1.0)):
        trace = simulate(file_of(gain__integral=integral), "step", settings={"model.gravity": 1.0})
        error = abs(float(trace.columns["following_error"][-1]))
        assert at_least <= error <= at_most


def test_feed_forward_takes_the_following_error_at_speed_away_and_too_much_turns_it_over() -> None:
    # Step 7: as small as possible without going negative.
    errors = [
        _error_at_speed(gain__feedforward=forward, gain__integral=0) for forward in (0, 4096, 8256, 9000)
    ]
    assert errors[0] > errors[1] > errors[2] > errors[3]
    assert errors[0] == pytest.approx(175.0, abs=3.0)  # 50 counts a scan / (18700 / 65536)
    assert errors[2] == pytest.approx(0.0, abs=1.0)
    assert errors[3] < -10.0


def test_the_s_curve_takes_twice_the_time_of_the_trapezoid_to_accelerate_and_decelerate() -> None:
    ramps = axis_of(command__deceleration=100_000.0).ramps  # page 4-25
    ends = {name: end_of(move(60_000.0, 40_000.0, ramps[name])) for name in ("none", "linear", "s-curve")}
    assert ends["linear"] - ends["none"] == pytest.approx(0.5 * (0.2 + 0.4))  # 40000 counts/s with each rate
    assert ends["s-curve"] - ends["none"] == pytest.approx(0.2 + 0.4)


def test_the_viscous_friction_is_what_both_programs_feed_forward_above_8192() -> None:
    first, second = 140 * (8256 / 8192 - 1), 78 * (8320 / 8192 - 1)
    assert (first, second) == pytest.approx((1.094, 1.219), abs=0.001)
    assert (first + second) / 2 == pytest.approx(VISCOUS * 198.4 / 0.00125, rel=0.01)


def test_advice_gives_the_feed_forward_that_leaves_no_error() -> None:
    file = file_of(gain__feedforward=4096, gain__integral=0)
    (advice,) = LAW.advise(bind_axis(file, LAW), simulate(file, "step"))
    assert advice.parameter == "gain.feedforward"
    assert advice.value == pytest.approx(8256, abs=25)


def _stop(**changes: float | None) -> int:
    axis = axis_of(**changes, setup__max_velocity_error=None)
    return run_axis(axis, move(60_000.0, 40_000.0, axis.ramps["linear"]), RunEnd(1.4), engine="plain").stop


def _vibration(**changes: float | None) -> float:
    """Return the swing in counts at rest, after a small move."""
    axis = axis_of(**changes, setup__max_velocity_error=None, setup__max_position_error=None)
    motion = run_axis(axis, move(500.0, 40_000.0, axis.ramps["linear"]), RunEnd(0.6), engine="plain")
    position = motion.columns["position"][motion.columns["time_s"] > 0.4]
    return float(position.max() - position.min())


def _error_at_speed(**changes: float | None) -> float:
    axis = axis_of(**changes)
    profile = move(30_000.0, 40_000.0, axis.ramps["linear"])
    motion = run_axis(axis, profile, RunEnd(end_of(profile)), engine="plain")
    time = motion.columns["time_s"]
    at_speed = (time > end_of(profile) - 0.3) & (time < end_of(profile) - 0.2)
    return float(motion.columns["following_error"][at_speed].mean())


# -- the loop, one scan at a time -------------------------------------------------------------------


def volts(io: dict[int, float], s: list[float] | None = None, **p: float) -> float:
    """Return the output of one scan; -99 where the loop is switched off."""
    parameters = [0.0] * loop.PARAMETERS
    parameters[loop.VELOCITY], parameters[loop.CLAMP], parameters[loop.CURRENT_REFERENCE] = 1.0, 1984.0, 1.0
    parameters[loop.POSITION_ERROR] = parameters[loop.VELOCITY_ERROR] = -1.0
    for name, value in p.items():
        parameters[getattr(loop, name)] = value
    signals = [0.0] * 24
    for place, value in io.items():
        signals[place] = value
    loop.whole_sample(parameters, [0.0] * loop.STATE if s is None else s, signals)
    return signals[OUTPUT] if signals[STOP] == 0.0 else -99.0


def test_1984_words_are_10_volts_either_way_and_the_clamp_cuts_there() -> None:
    # Pages 4-16 and 4-17.
    assert volts({COMMAND: 1984.0}, PROPORTIONAL=1.0) == pytest.approx(10.0)
    assert volts({COMMAND: -1984.0}, PROPORTIONAL=1.0) == pytest.approx(-10.0)
    assert volts({COMMAND: 9999.0}, PROPORTIONAL=1.0) == pytest.approx(10.0)
    assert volts({COMMAND: 9999.0}, PROPORTIONAL=1.0, CLAMP=992.0) == pytest.approx(5.0)


def test_the_output_is_a_whole_word() -> None:
    assert volts({COMMAND: 1.4}, PROPORTIONAL=1.0, WHOLE_WORDS=1.0) == pytest.approx(1 / 198.4)
    assert volts({COMMAND: -1.6}, PROPORTIONAL=1.0, WHOLE_WORDS=1.0) == pytest.approx(-2 / 198.4)


def test_feed_forward_and_velocity_are_in_counts_a_scan_of_1_25_ms() -> None:
    # Pages 4-9 and A-2: 80000 counts/s are 100 counts a scan.
    assert volts({COMMAND_VELOCITY: 80_000.0}, FEED_FORWARD=1.0) == pytest.approx(100 / 198.4)
    assert volts({MOTOR: 100.0}, VELOCITY=2.0) == pytest.approx(-200 / 198.4)
    assert volts({MOTOR: 100.0}, CURRENT_REFERENCE=0.0) == 0.0  # the module's velocity loop is off, page 5-3


def test_the_integral_sums_the_error_scan_by_scan_and_waits_while_the_output_is_clamped() -> None:
    s = [0.0] * loop.STATE
    assert [volts({COMMAND: 10.0}, s, INTEGRAL=0.5) * 198.4 for _ in range(3)] == pytest.approx(
        [5.0, 10.0, 15.0]
    )
    for _ in range(3):
        assert volts({COMMAND: 10.0}, s, INTEGRAL=0.5, CLAMP=12.0) * 198.4 == pytest.approx(12.0)
    assert s[loop.SUM] == 40.0


def test_the_deadband_is_added_in_the_direction_of_the_output() -> None:
    words = [volts({COMMAND: each}, PROPORTIONAL=1.0, DEADBAND=27.0) * 198.4 for each in (5.0, 0.0, -5.0)]
    assert words == pytest.approx([32.0, 0.0, -32.0])


def test_faults_come_beyond_their_limit_not_at_it() -> None:
    assert volts({COMMAND: 8.0}, POSITION_ERROR=8.0) == 0.0
    assert volts({COMMAND: 8.1}, POSITION_ERROR=8.0) == -99.0
    assert volts({MOTOR: 8.0}, VELOCITY_ERROR=8.0) == pytest.approx(-8 / 198.4)
    assert volts({MOTOR: 8.1}, VELOCITY_ERROR=8.0) == -99.0


def test_the_modes_of_the_scenarios() -> None:
    assert volts({MODE: OUTPUT_TEST, COMMAND: 3.0}) == pytest.approx(
        3.0
    )  # register 28 puts out volts, page 4-16
    assert volts({MODE: OUTPUT_TEST, COMMAND: 30.0}, CLAMP=992.0) == pytest.approx(5.0)
    assert volts({MODE: VELOCITY_LOOP, COMMAND_VELOCITY: 80_000.0, MOTOR: 90.0}) == pytest.approx(10 / 198.4)
