"""The tuning story of appendix C (from page 113 on), step by step,
on the motor that its own figures identify.

Its traces are lost; what the text has about each of them is tested. Each step runs with the ramps as they are
printed, ACC 500 (17 ms), and with ramps of the 100 ms that the story has verified (erratum of the index).
"""

from dataclasses import replace

import numpy as np
import pytest

from amp_studio.families.acromill import formulas as acromill
from amp_studio.families.acromill import law_plant as plant
from amp_studio.sim.tuning.linear import linear_model
from tests.families.acromill.appendix_c import PRINTED, TURN, VERIFIED, Scope, axis_of, index, trace

BOTH_RAMPS = pytest.mark.parametrize("ramp", [PRINTED, VERIFIED], ids=["ACC 500", "100 ms"])

# -- the identification ----------------------------------------------------------------------------


def largest_pole(p_gain: float, d_gain: float, delay: float = plant.DELAY) -> float:
    """Return the size of the largest pole of the sampled loop: double integrator with viscous friction,
    delay, PD.
    """
    from scipy.linalg import expm  # here, as it takes long: every worker collects all tests

    period = plant.SERVO_PERIOD
    a = np.array([[0.0, 1.0], [0.0, -plant.ACCELERATION * plant.VISCOUS]])
    b = np.array([[0.0], [plant.ACCELERATION]])

    def moved(time: float) -> tuple[np.ndarray, np.ndarray]:
        both = expm(np.block([[a, b], [np.zeros((1, 3))]]) * time)
        return both[:2, :2], both[:2, 2:]

    whole, part = int(delay // period), delay % period
    all_of_it, after, before = moved(period)[0], moved(period - part), moved(part)
    size = 2 + whole + 1 + 1  # position and speed, the outputs under way, the error before
    volts = np.zeros(size)
    volts[0], volts[-1] = -p_gain - d_gain / period, d_gain / period
    outputs = [volts, *np.eye(size)[2:-1]]
    step = np.zeros((size, size))
    step[:2, :2] = all_of_it
    step[:2] += after[1] * outputs[whole] + (after[0] @ before[1]) * outputs[whole + 1]
    step[2:-1] = outputs[:-1]
    step[-1, 0] = 1.0
    return float(abs(np.linalg.eigvals(step)).max())


def test_acceleration_and_friction_come_from_three_printed_figures() -> None:
    # FFACC, FFVEL and PGAIN times pulses: lines 2941, 2940, 2827 and 2837 of the guide's text.
    assert pytest.approx(0.000000199) == 1.0 / plant.ACCELERATION
    assert plant.VISCOUS == 0.0000015
    friction = plant.COULOMB + plant.VISCOUS * plant.SPEED
    assert friction == pytest.approx(0.001 * 100)


def test_the_dry_friction_that_is_left_is_the_pulse_of_error_at_rest() -> None:
    # A figure that the identification did not use: 1 pulse at the right end of the trace, PGAIN 0.05.
    error = plant.COULOMB / 0.05
    assert error == pytest.approx(1.0, abs=0.05)


def test_the_delay_puts_the_limit_of_stability_between_0_08_and_one_step_more() -> None:
    from scipy.optimize import brentq

    limit = brentq(lambda p_gain: largest_pole(p_gain, 0.00021) - 1.0, 0.05, 0.2)
    assert limit == pytest.approx(0.0968, abs=0.0001)
    shortest = brentq(lambda delay: largest_pole(0.11, 0.00021, delay) - 1.0, 0.0005, 0.0007)
    longest = brentq(lambda delay: largest_pole(0.05, 0.00005, delay) - 1.0, 0.0005, 0.0007999)
    assert shortest == pytest.approx(0.000593, abs=0.000001)
    assert longest == pytest.approx(0.000691, abs=0.000001)


@pytest.mark.parametrize(("run", "p_gain"), [(4, 0.05), (11, 0.08), (11, 0.11)])
def test_the_linear_model_of_the_law_has_the_same_largest_pole(run: int, p_gain: float) -> None:
    model = linear_model(axis_of(run, servo__p_gain=p_gain))
    d_gain = 0.00005 if run == 4 else 0.00021
    assert abs(model.poles()[0]) == pytest.approx(largest_pole(p_gain, d_gain), abs=1e-6)
    assert model.is_stable() == (p_gain < 0.097)


# -- the steps -------------------------------------------------------------------------------------


@BOTH_RAMPS
def test_step_1_rings_in_both_ramps_and_has_a_steady_error_at_speed_and_at_rest(ramp: float) -> None:
    scope = trace(1, ramp)
    assert reversals(starting(scope), beyond=5.0) >= 6
    assert reversals(stopping(scope), beyond=5.0) >= 2
    assert scope.at_speed == pytest.approx(100.0, abs=1.0)
    assert 1.0 <= abs(scope.error[-1]) <= plant.COULOMB / 0.001  # as far as dry friction lets it


@BOTH_RAMPS
def test_step_2_rings_less_and_keeps_the_error_at_speed(ramp: float) -> None:
    first, second = trace(1, ramp), trace(2, ramp)
    assert reversals(starting(second), beyond=5.0) < reversals(starting(first), beyond=5.0)
    assert peak(starting(second)) < 0.85 * peak(starting(first))
    assert second.at_speed == pytest.approx(first.at_speed, abs=0.5)


@BOTH_RAMPS
def test_step_3_has_no_ringing_and_about_100_pulses_at_speed(ramp: float) -> None:
    scope = trace(3, ramp)
    assert reversals(starting(scope), beyond=5.0) == 1  # up in the ramp, and down to the error at speed
    assert scope.at_speed == pytest.approx(100.0, abs=0.5)


@BOTH_RAMPS
def test_step_4_all_but_takes_the_error_away_but_for_a_blip_in_both_ramps(ramp: float) -> None:
    scope = trace(4, ramp)
    assert scope.at_speed == pytest.approx(2.0, abs=0.1)  # a fiftieth: PGAIN is fifty times as much
    assert peak(scope.between(0.0, scope.ramp) - scope.at_speed) > 1.2
    assert peak(scope.between(scope.end - scope.ramp, scope.end) - scope.at_speed) > 1.2


@BOTH_RAMPS
def test_step_5_rests_within_a_pulse_of_its_target(ramp: float) -> None:
    scope = trace(5, ramp)
    assert abs(scope.error[-1]) <= 1.0
    assert (
        scope.at_speed == trace(4, ramp).at_speed
    )  # IDELAY 0.01: the integral waits for the end of the move


@BOTH_RAMPS
def test_step_6_turns_the_error_at_speed_over_with_too_much_feed_forward(ramp: float) -> None:
    assert trace(6, ramp).at_speed == pytest.approx(2.0 - 0.00001 * plant.SPEED / 0.05, abs=0.05)
    assert trace(6, ramp).at_speed < -4.0


@BOTH_RAMPS
def test_step_7_is_good_but_for_the_ramps(ramp: float) -> None:
    scope = trace(7, ramp)
    assert scope.at_speed == pytest.approx(1.0, abs=0.05)  # what is dry friction stays
    assert peak(scope.between(0.0, scope.ramp + 0.02)) > 4.0 * scope.at_speed


@BOTH_RAMPS
def test_steps_8_and_9_take_the_spikes_out_of_the_ramps(ramp: float) -> None:
    without, some, right = (peak(in_ramp(run, ramp)) for run in (7, 8, 9))
    assert right < some < without
    assert right < 0.65 * without


@BOTH_RAMPS
def test_step_10_settles_faster_with_more_derivative(ramp: float) -> None:
    # With ramps of 100 ms single pulses decide.
    assert peak(in_ramp(10, ramp)) < peak(in_ramp(9, ramp)) + (0.5 if ramp == VERIFIED else 0.0)
    assert peak(trace(10, ramp).error) <= 3.0


@BOTH_RAMPS
def test_step_11_is_stable_at_0_08_and_unstable_further_up(ramp: float) -> None:
    good = trace(11, ramp)
    assert good.at_speed == pytest.approx(plant.COULOMB / 0.08, abs=0.05)
    assert good.ringing(0.8, 0.2) < 5.5  # pulses, the same with physics steps of 0.4 ms as of 0.025 ms
    assert index(axis_of(11, servo__p_gain=0.11), ramp=ramp).ringing(0.8, 0.2) > 30.0


@BOTH_RAMPS
def test_step_12_has_no_error_left_once_the_integral_works_all_the_time(ramp: float) -> None:
    assert trace(12, ramp).at_speed == pytest.approx(0.0, abs=0.1)


@pytest.mark.parametrize(("rpm", "turns"), [(500, 10), (2000, 30), (4000, 60)])
def test_the_tuned_motor_stays_within_five_pulses_at_every_speed(rpm: float, turns: float) -> None:
    # Line 2678: "less than +/- 5 encoder counts for the entire range"; line 3085: at 4000 turns a minute too.
    assert peak(index(axis_of(12), turns=turns, rpm=rpm, tail=0.1).error) < 5.0


# -- equations of the story ------------------------------------------------------------------------


def test_the_printed_equation_gives_the_feed_forward_that_leaves_nothing() -> None:
    # FFVel = Pgain × FE / v (line 2894): all friction of this speed, dry friction too.
    scope = trace(4, VERIFIED)
    forward = acromill.velocity_feedforward(0.05, scope.at_speed, plant.SPEED)
    better = index(axis_of(4, servo__vel_ffwd=forward), ramp=VERIFIED)
    assert better.at_speed == pytest.approx(0.0, abs=0.1)


@pytest.mark.parametrize("run", [3, 4, 6, 7, 11, 12])
def test_the_predicted_error_is_the_one_at_speed(run: int) -> None:
    axis = axis_of(run)
    predicted = axis.predict(500.0 / 60.0)["steady_following_error"].value
    assert predicted is not None
    assert predicted * TURN == pytest.approx(abs(trace(run, PRINTED).at_speed), abs=0.15)


def test_feedback_of_the_motors_speed_calms_an_axis_with_its_encoder_on_a_soft_load() -> None:
    # Page 135: dual feedback; FBVEL dampens the loop in addition to the PID.
    def swing(fbvel: float) -> float:
        axis = axis_of(11, servo__p_gain=0.02, servo__d_gain=0.00005, tuning__fbvel=fbvel)
        soft = replace(axis.machine, load_sensor=True, resonance=60.0, inertia_ratio=1.0, damping=0.02)
        return index(replace(axis, machine=soft), ramp=VERIFIED, turns=5.0).ringing(0.4, 0.2)

    assert swing(0.0003) < 0.05 * swing(0.0)


def reversals(error: np.ndarray, beyond: float) -> int:
    """Return how often the error turns round by more than ``beyond`` pulses."""
    turns, way, last = 0, 0.0, float(error[0])
    for each in error.tolist():
        if way == 0.0:
            way = float(np.sign(each - last)) if abs(each - last) > beyond else 0.0
        elif (each - last) * way > 0.0:
            last = each
        elif (last - each) * way > beyond:
            turns, way, last = turns + 1, -way, each
    return turns


def starting(scope: Scope) -> np.ndarray:
    return scope.between(0.0, scope.ramp + 0.4)


def stopping(scope: Scope) -> np.ndarray:
    return scope.between(scope.end - scope.ramp, scope.end + 0.2)


def peak(error: np.ndarray) -> float:
    return float(np.abs(error).max())


def in_ramp(run: int, ramp: float) -> np.ndarray:
    scope = trace(run, ramp)
    return scope.between(0.0, scope.ramp + 0.02)
