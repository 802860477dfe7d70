"""The machine alone: closed equations, energy that never appears from nowhere,
and a physics step that does not show.
"""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from amp_studio.sim import Machine, Ramp, SimulationError
from amp_studio.sim.axis.motion import RunEnd, run_axis
from amp_studio.sim.command.ramps import blocks, end_of, move
from amp_studio.sim.engine.arrays import Vector
from amp_studio.sim.engine.machine import COULOMB, KEEP, KICK, SIZE, STATIC, machine_array
from amp_studio.sim.engine.plant import PlantState, advance, speed_after
from amp_studio.sim.engine.signals import OUTPUT_TEST
from amp_studio.sim.law import AxisLaw
from tests.campaigns import examples
from tests.sim.tiny import tiny

H = 0.00025
REST: PlantState = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def moved(
    machine: Machine, steps: int, output: float = 0.0, state: PlantState = REST, h: float = H
) -> list[PlantState]:
    """Return the states of a machine under a constant output, the first of them too."""
    m: Vector = machine_array(machine, h)
    states = [state]
    for _ in range(steps):
        state = advance(m, *state, output, h)
        states.append(state)
    return states


def energies(machine: Machine, state: PlantState) -> tuple[float, float, float, float]:
    """Return the energies of a state, in torque times u: of motion, of the coupling, in the weight,
    in the spring.
    """
    motor_position, motor, load_position, load, *_ = state
    weight, spring = machine.gravity * load_position, 0.5 * machine.spring * load_position**2
    if not machine.two_masses:
        return 0.5 * motor**2 / machine.acceleration_per_output, 0.0, weight, spring
    frequency, _, ratio = machine.coupling
    total = machine.acceleration_per_output * (1.0 + ratio)
    stiffness = (2.0 * math.pi * frequency) ** 2 / (total + total / ratio)
    stretch = max(abs(motor_position - load_position) - 0.5 * machine.backlash, 0.0)
    return 0.5 * (motor**2 + ratio * load**2) / total, 0.5 * stiffness * stretch**2, weight, spring


def gained(machine: Machine, states: list[PlantState], output: float = 0.0) -> tuple[Vector, float]:
    """Return the energy that came from nowhere up to each state, and what the scheme may leave open of it.

    That is a hundredth of the most energy that was anywhere, each kind by itself: the sum may stay near zero
    while a falling mass gains as much in motion as it loses in height. And what the forces of one step bring
    from rest: an axis that friction stops within a step went half of that step at its old speed,
    be it ever so small.
    """
    parts = np.array([energies(machine, state) for state in states])
    work = np.cumsum([0.0, *(output * (b[0] - a[0]) for a, b in pairwise(states))])
    have = parts.sum(axis=1)
    most = float(np.abs(parts).max(axis=0).sum() + np.abs(work).max())
    force = abs(output) + abs(machine.gravity) + machine.coulomb_friction
    _, _, ratio = machine.coupling
    lighter = machine.acceleration_per_output * (1.0 + max(ratio, 1.0 / ratio) if machine.two_masses else 1.0)
    return have - have[0] - work, 0.01 * most + 0.5 * lighter * (H * force) ** 2


def test_a_rigid_mass_under_a_constant_torque_moves_by_the_book() -> None:
    last = moved(Machine(50.0), 400, output=2.0)[-1]
    assert last[1] == pytest.approx(10.0)
    assert last[0] == pytest.approx(0.5)


def test_viscous_friction_ends_at_the_speed_that_takes_all_torque() -> None:
    states = moved(Machine(50.0, viscous_friction=0.2), 4000, output=2.0)
    assert states[-1][1] == pytest.approx(10.0, rel=1e-3)
    assert states[400][1] == pytest.approx(10.0 * (1.0 - math.exp(-1.0)), rel=1e-4)


def test_an_axis_at_rest_stays_there_until_the_torque_is_above_the_static_friction() -> None:
    machine = Machine(50.0, coulomb_friction=2.0, static_friction=3.0)
    assert moved(machine, 100, output=2.9)[-1][1] == 0.0
    assert moved(machine, 100, output=3.1)[-1][1] == pytest.approx(50.0 * 1.1 * 0.025)


def test_friction_stops_an_axis_and_never_pushes_it_back() -> None:
    machine = Machine(50.0, coulomb_friction=2.0)
    speeds = [state[1] for state in moved(machine, 1000, state=(0.0, 10.0, 0.0, 10.0, 0.0, 0.0, 0.0))]
    assert speeds[-1] == 0.0
    assert min(speeds) == 0.0
    assert speeds.index(0.0) == pytest.approx(0.1 / H, abs=1)


def test_the_resonance_is_at_the_frequency_that_is_given() -> None:
    machine = Machine(50.0, inertia_ratio=2.0, resonance=80.0, damping=0.0)
    states = moved(machine, 4000, state=(0.1, 0.0, -0.05, 0.0, 0.0, 0.0, 0.0))
    twist = np.array([state[0] - state[2] for state in states])
    up = np.flatnonzero((twist[:-1] < 0.0) & (twist[1:] >= 0.0))
    assert (len(up) - 1) / ((up[-1] - up[0]) * H) == pytest.approx(80.0, rel=2e-3)
    assert np.max(np.abs(twist[-200:])) == pytest.approx(0.15, rel=2e-3), "nothing is lost without damping"


def test_a_reversal_crosses_the_backlash_before_the_load_moves() -> None:
    machine = Machine(50.0, backlash=0.2, coulomb_friction=1.0, damping=1.0)
    there = moved(machine, 800, output=2.0)
    turned = [state for state in moved(machine, 4000, output=-3.0, state=there[-1]) if state[3] < 0.0]
    assert there[-1][0] - there[-1][2] == pytest.approx(0.1, abs=0.005)
    assert turned[0][0] - turned[0][2] == pytest.approx(-0.1, abs=0.005)


def test_a_drive_with_a_velocity_loop_is_a_first_order_lag_whatever_the_step_is() -> None:
    machine = Machine(50.0, velocity_per_output=10.0, velocity_bandwidth=20.0)
    for h in (H, 4.0 * H):
        after = moved(machine, round(0.02 / h), output=1.0, h=h)[-1][1]
        assert after == pytest.approx(10.0 * (1.0 - math.exp(-2.0 * math.pi * 20.0 * 0.02)), rel=1e-9)


def test_a_delay_is_kept_to_the_fraction_of_a_step() -> None:
    def at(delay: float) -> float:
        axis = tiny(delay=delay, position_count=0.0)
        motion = run_axis(axis, [0.0, math.inf, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0], RunEnd(0.02), mode=OUTPUT_TEST)
        return float(motion.columns["velocity"][-1])

    full = at(0.0)
    for delay in (0.0001, 0.00025, 0.0006, 0.003):
        assert at(delay) == pytest.approx(full - 100.0 * delay)


figures = st.fixed_dictionaries(
    {
        "acceleration_per_output": st.floats(1.0, 500.0),
        "inertia_ratio": st.floats(0.2, 10.0),
        "viscous_friction": st.floats(0.0, 0.05),
        "coulomb_friction": st.floats(0.0, 5.0),
        "static_friction": st.floats(0.0, 8.0),
        "motor_friction": st.floats(0.0, 1.0),
        "backlash": st.sampled_from([0.0, 0.01, 0.1]),
        "resonance": st.sampled_from([0.0, 20.0, 150.0]),
        "damping": st.floats(0.0, 1.0),
        "gravity": st.floats(-3.0, 3.0),
        "spring": st.floats(0.0, 0.5),
    }
)


LEFT_TO_FALL = {"acceleration_per_output": 334.0, "gravity": -2.0}
SLIDING_INTO_A_SPRING = {"acceleration_per_output": 1.0, "gravity": 1.0, "spring": 0.5}
"""Found by chance: the sum of energies is near or below zero all the time."""


@given(figures, st.floats(-10.0, 10.0), st.floats(-50.0, 50.0))
@settings(max_examples=examples(40))
@example({"acceleration_per_output": 50.0, "backlash": 0.1, "gravity": 3.0, "damping": 0.0}, 0.0, 20.0)
@example(SLIDING_INTO_A_SPRING, 0.0, 0.0)
@example(LEFT_TO_FALL, 0.0, 1e-5)
@example({"acceleration_per_output": 1.0, "coulomb_friction": 1.0, "gravity": 1.0}, 0.0, 1e-300)
def test_energy_never_appears_from_nowhere(values: dict[str, float], output: float, speed: float) -> None:
    machine = Machine(**values)
    start: PlantState = (0.0, speed, 0.0, speed, output, 0.0, 0.0)
    more, slack = gained(machine, moved(machine, 600, output, start), output)
    # The leapfrog scheme lets the energy of a spring go to and fro within its own order, and never lets it
    # drift.
    assert np.max(more) <= slack


@given(figures)
@settings(max_examples=examples(15))
@example(LEFT_TO_FALL)
def test_a_machine_left_alone_ends_with_less_energy_than_it_had(values: dict[str, float]) -> None:
    machine = Machine(**values)
    start = (
        (0.3, 20.0, 0.2, -10.0, 0.0, 0.0, 0.0)
        if machine.two_masses
        else (0.3, 20.0, 0.3, 20.0, 0.0, 0.0, 0.0)
    )
    more, slack = gained(machine, moved(machine, 1000, 0.0, start))
    assert more[-1] <= slack


FULL = {
    "inertia_ratio": 2.0,
    "viscous_friction": 0.01,
    "coulomb_friction": 1.0,
    "static_friction": 1.5,
    "motor_friction": 0.3,
    "resonance": 80.0,
    "gravity": 1.5,
    "spring": 0.01,
    "bandwidth": 300.0,
    "delay": 0.0003,
    "torque_limit_positive": 15.0,
    "torque_limit_negative": 12.0,
    "position_count": 0.0,
}


@pytest.mark.parametrize(
    ("axis", "visible"),
    [(tiny(**FULL), 0.002), (tiny(**FULL, backlash=0.02), 0.004), (tiny(**FULL, load_sensor=True), 0.002)],
    ids=["all but backlash", "with backlash", "with a scale"],
)
def test_halving_the_step_changes_nothing_that_can_be_seen(axis: AxisLaw, visible: float) -> None:
    profile = move(20.0, 100.0, Ramp("s-curve", 1500.0, jerk=30000.0))
    coarse, fine = (run_axis(axis, profile, RunEnd(0.5), refine=refine).columns for refine in (1, 2))
    for column in ("position", "following_error"):
        assert np.max(np.abs(coarse[column] - fine[column][::2])) < visible, column


def test_without_dry_friction_the_step_is_exact_to_a_hundredth_of_a_micrometre() -> None:
    axis = tiny(inertia_ratio=2.0, resonance=60.0, bandwidth=200.0, viscous_friction=0.02, position_count=0.0)
    profile = move(10.0, 50.0, Ramp("s-curve", 1000.0, jerk=20000.0))
    runs = [
        run_axis(axis, profile, RunEnd(0.4), refine=refine).columns["position"][::refine]
        for refine in (1, 2, 16)
    ]
    first, second = (float(np.max(np.abs(run - runs[2]))) for run in runs[:2])
    assert second < 0.5 * first < 5e-6


def test_an_axis_without_output_runs_out_by_its_friction_after_an_alarm() -> None:
    axis = tiny(coulomb_friction=2.0, excess=4.0, position_count=0.0)
    motion = run_axis(axis, move(80.0, 100.0, Ramp("linear", 500.0)), RunEnd(5.0), coast=3.0)
    assert motion.stop == 1
    assert motion.alarm_row is not None
    speed = float(motion.columns["velocity"][motion.alarm_row])
    gone = float(motion.columns["position"][-1] - motion.columns["position"][motion.alarm_row])
    assert gone == pytest.approx(speed**2 / (2.0 * 50.0 * 2.0), rel=0.02)
    assert motion.columns["velocity"][-1] == 0.0
    assert np.all(motion.columns["output"][motion.alarm_row + 1 :] == 0.0)


def test_a_brake_shortens_the_way_after_an_alarm_and_holds_the_weight() -> None:
    machine = {"gravity": 3.0, "coulomb_friction": 1.0, "excess": 4.0, "position_count": 0.0}
    falls, held = (
        run_axis(
            tiny(**machine, brake=brake), move(80.0, 100.0, Ramp("linear", 500.0)), RunEnd(5.0), coast=2.0
        )
        for brake in (0.0, 10.0)
    )
    assert falls.columns["velocity"][-1] < -100.0, "without a brake a vertical axis falls"
    assert held.columns["velocity"][-1] == 0.0


def test_an_exact_stop_waits_until_the_axis_is_in_position() -> None:
    profile = blocks([(20.0, 100.0), (20.0, 100.0)], Ramp("linear", 500.0), exact_stop=True, check=0.001)
    motion = run_axis(tiny(position_count=0.0), profile, RunEnd(3.0))
    assert motion.command_end is not None
    # ln(5 mm / 0.01 mm) time constants of 50 ms, less what went before the end of the ramp.
    assert 0.15 < motion.command_end - end_of(profile) < 0.4


def test_a_feed_share_that_a_law_lowers_stretches_the_command() -> None:
    axis = tiny(position_count=0.0)

    def hold(p: Vector, s: Vector, io: Vector) -> None:
        io[7] = 0.5

    motion = run_axis(replace(axis, position_sample=hold), move(10.0, 100.0, Ramp()), RunEnd(1.0))
    assert motion.command_end == pytest.approx(0.2, abs=0.0021)


@pytest.mark.parametrize(
    ("figure", "value"),
    [("acceleration_per_output", 0.0), ("backlash", -1.0), ("delay", math.nan), ("motor_friction", 1.5)],
)
def test_an_impossible_machine_is_refused_in_a_sentence(figure: str, value: float) -> None:
    with pytest.raises(
        SimulationError, match=figure.partition("_")[0].capitalize()[:5] + "|motor|acceleration"
    ):
        Machine(**{"acceleration_per_output": 50.0, figure: value})


def test_contact_across_a_gap_takes_up_and_gives_back_the_same_energy() -> None:
    machine = Machine(1.0, backlash=0.01, coulomb_friction=5.0, gravity=-3.0, spring=0.5, damping=0.0)
    states = moved(machine, 1000, 0.0, (0.3, 20.0, 0.2, -10.0, 0.0, 0.0, 0.0))
    have = [sum(energies(machine, state)) for state in states]
    assert max(b - a for a, b in pairwise(have)) < 0.02 * have[0]
    assert have[-1] <= have[0]


def drive(step: float, seconds: float, **changes: float) -> list[float]:
    """Return the speeds at the end of each ms of a drive of 50 Hz that is asked for 10 u/s,
    with physics steps of ``step`` s.
    """
    figures = {"velocity_per_output": 1.0, "velocity_bandwidth": 50.0, **changes}
    machine = Machine(10.0, **figures)
    states = moved(machine, round(seconds / step), 10.0, h=step)
    every = round(1e-3 / step)
    return [state[1] for state in states[every::every]]


def test_a_velocity_drive_gives_way_to_a_load_as_much_as_its_loop_says_at_any_step() -> None:
    # 20 % of 10 u/s2 for 1 % are 200 u/s2, kept by 2 pi x 50 1/s: 0.637 u/s less.
    for step in (1e-3, 0.5e-3, 0.125e-3):
        assert drive(step, 0.2, gravity=20.0)[-1] == pytest.approx(10.0 - 200.0 / (2.0 * math.pi * 50.0))
        assert drive(step, 0.01)[4] == pytest.approx(10.0 * (1.0 - math.exp(-2.0 * math.pi * 50.0 * 0.005)))


def test_halving_the_step_hardly_changes_a_drive_with_an_integral() -> None:
    speeds = [
        np.array(drive(step, 0.05, velocity_integral=60.0, viscous_friction=0.5))
        for step in (0.5e-3, 0.25e-3, 0.125e-3)
    ]
    first, second = (float(np.max(np.abs(a - b))) for a, b in pairwise(speeds))
    assert first < 0.003 * 10.0
    assert second < 0.5 * first


@pytest.mark.parametrize(("push", "after"), [(-3.0, 0.0), (-5.0, -6.5 * 3.0 / 7.0)])
def test_a_mass_that_turns_rests_below_its_static_friction(push: float, after: float) -> None:
    """Coulomb friction 2, static friction 4: a push of 3 turns it no more, though it would keep it going."""
    m = np.zeros(SIZE)
    m[COULOMB], m[STATIC], m[KEEP], m[KICK] = 2.0, 4.0, 1.0, 1.0
    assert speed_after(m, 0, 0.5, push) == pytest.approx(after)
