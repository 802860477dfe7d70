"""Inertia, friction and weight out of records that scipy has made of a known machine,
and what such a record must show.
"""

import numpy as np
import pytest

from amp_studio.sim import SimulationError
from amp_studio.sim.identification.friction import FrictionFit, fit_friction
from amp_studio.sim.series import Series

INERTIA, VISCOUS, DRY, WEIGHT = 0.02, 0.03, 2.0, 1.5
TRUE = np.array([INERTIA, VISCOUS, DRY + WEIGHT, WEIGHT - DRY])
SPEEDS, RAMP, CRUISE, REST = (20.0, 60.0, 120.0), 600.0, 0.4, 0.2
PERIOD = 1e-3


def command(speeds: tuple[float, ...]) -> tuple[Series, Series]:
    """Return corners of trapezoids there and back at each speed: time, velocity."""
    corners = [(0.0, 0.0)]
    for speed in speeds:
        for side in (1.0, -1.0):
            for lasts, velocity in (
                (REST, 0.0),
                (speed / RAMP, side * speed),
                (CRUISE, side * speed),
                (speed / RAMP, 0.0),
            ):
                corners.append((corners[-1][0] + lasts, velocity))
    times, velocities = zip(*corners, strict=True)
    return np.array(times), np.array(velocities)


def record(speeds: tuple[float, ...] = SPEEDS, limit: float = np.inf) -> dict[str, Series]:
    """Return what solve_ivp makes of the machine under a PI loop of the velocity."""
    from scipy.integrate import solve_ivp  # here, as it takes long: every worker collects all tests

    corners, velocities = command(speeds)
    gain, rate = 60.0 * INERTIA, 5.0

    def torque(time: Series, velocity: Series, integral: Series) -> Series:
        wanted = gain * (np.interp(time, corners, velocities) - velocity + rate * integral)
        return np.clip(wanted, -limit, limit)

    def motion(time: float, state: Series) -> list[float]:
        _, velocity, integral = state
        pushed = (
            torque(time, velocity, integral) - VISCOUS * velocity - DRY * np.tanh(velocity / 0.05) - WEIGHT
        )
        return [velocity, pushed / INERTIA, np.interp(time, corners, velocities) - velocity]

    times = np.arange(0.0, corners[-1], PERIOD)
    start = [0.0, 0.0, WEIGHT / gain / rate]
    solved = solve_ivp(motion, (0.0, corners[-1]), start, "RK23", times, max_step=PERIOD)
    position, velocity, integral = solved.y
    return {
        "time": times,
        "position": position,
        "velocity": velocity,
        "torque": torque(times, velocity, integral),
    }


@pytest.fixture(scope="module")
def clean() -> dict[str, Series]:
    return record()


def noise(size: float, like: Series, seed: int = 7) -> Series:
    return size * np.random.default_rng(seed).standard_normal(len(like))


def counted(values: Series, count: float) -> Series:
    return np.round(values / count) * count


def errors(fit: FrictionFit) -> Series:
    return np.sqrt(np.diag(fit.covariance))


def refused(**given: Series) -> str:
    with pytest.raises(SimulationError) as caught:
        fit_friction(**given)
    return str(caught.value)


def test_a_clean_record_gives_the_machine_back(clean: dict[str, Series]) -> None:
    fit = fit_friction(clean["time"], clean["torque"], velocity=clean["velocity"])
    assert fit.coefficients == pytest.approx(TRUE, rel=1e-3)
    assert fit.r_squared > 0.9999


@pytest.mark.parametrize("seed", range(5))
def test_noise_moves_the_figures_within_their_standard_errors(clean: dict[str, Series], seed: int) -> None:
    velocity = clean["velocity"] + noise(0.5, clean["time"], seed)
    fit = fit_friction(
        clean["time"], clean["torque"] + noise(0.3, clean["time"], 99 + seed), velocity=velocity
    )
    assert (np.abs(fit.coefficients - TRUE) < 4.0 * errors(fit)).all()
    assert (errors(fit) < (0.0001, 0.001, 0.05, 0.05)).all()


@pytest.mark.parametrize("count", [0.001, 0.01, 0.1])
def test_a_position_in_whole_counts_is_enough(clean: dict[str, Series], count: float) -> None:
    torque = counted(clean["torque"] + noise(0.2, clean["time"]), 0.1)
    fit = fit_friction(clean["time"], torque, position=1e4 + counted(clean["position"], count))
    assert fit.coefficients == pytest.approx(TRUE, rel=0.03, abs=0.05)


def test_a_velocity_in_coarse_steps_is_filtered(clean: dict[str, Series]) -> None:
    fit = fit_friction(clean["time"], counted(clean["torque"], 0.1), velocity=counted(clean["velocity"], 1.0))
    assert fit.coefficients == pytest.approx(TRUE, rel=0.01, abs=0.02)
    assert fit.window > 0.01


def test_times_that_were_rounded_or_jitter_are_evened_out(clean: dict[str, Series]) -> None:
    times = clean["time"] + np.abs(noise(0.0002, clean["time"]))
    fit = fit_friction(np.sort(times), clean["torque"], velocity=clean["velocity"])
    assert fit.coefficients == pytest.approx(TRUE, rel=0.02, abs=0.02)


@pytest.mark.parametrize("rows", [30, 52, 400])
def test_few_rows_in_a_swing_are_enough(rows: int) -> None:
    """A row beside the turn contains torque of both directions as soon as it is averaged with its
    neighbours.
    """
    time = np.arange(12 * rows) * (1.0 / rows)
    velocity, acceleration = 80.0 * np.sin(2.0 * np.pi * time), 160.0 * np.pi * np.cos(2.0 * np.pi * time)
    torque = INERTIA * acceleration + VISCOUS * velocity + DRY * np.sign(np.round(velocity, 6)) + WEIGHT
    fit = fit_friction(time, torque, velocity=velocity)
    assert fit.coefficients == pytest.approx(TRUE, rel=0.03)


def test_only_rows_of_one_direction_count(clean: dict[str, Series]) -> None:
    """At a standstill the torque is anything up to the static friction."""
    standing = np.abs(clean["velocity"]) < 0.1
    torque = np.where(standing, clean["torque"] + 1.8, clean["torque"])
    fit = fit_friction(clean["time"], torque, velocity=clean["velocity"])
    assert fit.coefficients == pytest.approx(TRUE, rel=2e-3)
    assert fit.used < fit.rows


def test_friction_that_falls_with_the_speed_becomes_dry_friction_alone() -> None:
    time = np.arange(0.0, 4.0, 1e-3)
    velocity = 80.0 * np.sin(6.0 * time) * np.abs(np.sin(0.7 * time))
    torque = INERTIA * np.gradient(velocity, time) - 0.005 * velocity + DRY * np.sign(velocity)
    fit = fit_friction(time, torque, velocity=velocity)
    assert fit.coefficients[1] == 0.0
    assert fit.coefficients[[0, 2, 3]] == pytest.approx([INERTIA, 1.8, -1.8], rel=0.03)


# -- what a record cannot show


def test_a_torque_at_its_limit_is_refused() -> None:
    """The drive was asked for more than it gave, for a third of the record."""
    limited = record(SPEEDS, limit=8.0)
    message = refused(time=limited["time"], torque=limited["torque"], velocity=limited["velocity"])
    assert message.startswith("The torque stays at its largest value in ")
    assert "lower acceleration" in message


def test_a_record_cut_off_by_its_own_range_is_refused(clean: dict[str, Series]) -> None:
    assert "at a limit" in refused(
        time=clean["time"], torque=np.clip(clean["torque"], -9, 9), velocity=clean["velocity"]
    )


def test_a_drive_that_is_off_at_rest_is_at_no_limit(clean: dict[str, Series]) -> None:
    """The brake of a heavy axis is closed before it moves and afterwards: torque 0,
    which is the smallest there is.
    """
    torque = np.concatenate([np.zeros(800), clean["torque"] + 40.0, np.zeros(800)])
    velocity = np.concatenate([np.zeros(800), clean["velocity"], np.zeros(800)])
    fit = fit_friction(PERIOD * np.arange(len(torque)), torque, velocity=velocity)
    assert fit.coefficients == pytest.approx(TRUE + np.array([0.0, 0.0, 40.0, 40.0]), rel=2e-3)


def test_one_direction_is_refused(clean: dict[str, Series]) -> None:
    there = clean["velocity"] > -0.01
    given = {name: clean[name][there] for name in ("torque", "velocity")}
    message = refused(time=PERIOD * np.arange(there.sum()), **given)
    assert (
        message
        == "The axis moves in one direction only: dry friction and weight look the same. Record moves in both"
        " directions"
    )


def test_one_speed_is_refused() -> None:
    made = record((60.0, 60.0))
    message = refused(
        time=made["time"], torque=made["torque"] + noise(0.1, made["time"]), velocity=made["velocity"]
    )
    assert message.startswith("The axis moves at one speed only")


def test_a_sine_of_one_amplitude_has_many_speeds() -> None:
    time = np.arange(0.0, 4.0, 1e-3)
    velocity = 80.0 * np.sin(6.0 * time)
    torque = INERTIA * 480.0 * np.cos(6.0 * time) + VISCOUS * velocity + DRY * np.sign(velocity) + WEIGHT
    fit = fit_friction(time, torque + noise(0.3, time), velocity=velocity + noise(0.5, time, 8))
    assert fit.coefficients == pytest.approx(TRUE, rel=0.05)


def test_constant_speeds_without_ramps_are_refused(clean: dict[str, Series]) -> None:
    """Each speed alone, cut out of the record: the inertia is in none of it."""
    time = np.arange(0.0, 3.0, PERIOD)
    velocity = np.repeat([20.0, -20.0, 60.0, -60.0, 120.0, -120.0], 500)
    torque = VISCOUS * velocity + DRY * np.sign(velocity)
    message = refused(time=time, torque=torque + noise(0.2, time), velocity=velocity + noise(2.0, time))
    assert "acceleration" in message


@pytest.mark.parametrize("rows", [0, 1, 2, 99])
def test_too_few_rows_are_refused(clean: dict[str, Series], rows: int) -> None:
    given = {name: clean[name][:rows] for name in ("time", "torque", "velocity")}
    assert refused(**given) == f"The record has too few rows: {rows} of at least 100"


def test_a_standing_axis_is_refused() -> None:
    time = np.arange(0.0, 1.0, PERIOD)
    assert "too few rows" in refused(time=time, torque=noise(1.0, time), velocity=np.zeros(1000))
    assert (
        refused(time=time, torque=np.ones(1000), velocity=np.sin(time))
        == "The torque is the same in every row"
    )


def test_torque_of_the_other_sign_is_refused(clean: dict[str, Series]) -> None:
    message = refused(time=clean["time"], torque=-clean["torque"], velocity=clean["velocity"])
    assert message.startswith("Torque and acceleration have opposite signs")


def test_a_torque_that_belongs_to_another_axis_is_refused(clean: dict[str, Series]) -> None:
    torque = np.abs(clean["torque"]) + noise(5.0, clean["time"])
    message = refused(time=clean["time"], torque=torque, velocity=clean["velocity"])
    assert "explain only" in message or "opposite signs" in message or "too little acceleration" in message


def test_times_that_go_back_stand_still_or_leave_a_gap_are_refused(clean: dict[str, Series]) -> None:
    for place, change, words in ((500, -0.01, "goes back after"), (2000, 2.0, "has a gap after")):
        time = clean["time"].copy()
        time[place:] += change
        assert words in refused(time=time, torque=clean["torque"], velocity=clean["velocity"])
    still = np.zeros(len(clean["time"]))
    assert "same in every row" in refused(time=still, torque=clean["torque"], velocity=clean["velocity"])
