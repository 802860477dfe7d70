"""The linear sampled model agrees with python-control, scipy and its own law run step by step."""

import sys
from dataclasses import replace
from types import ModuleType
from typing import Any
from unittest.mock import MagicMock

import numpy as np
import pytest

from amp_studio.sim import SimulationError
from amp_studio.sim.tuning import sampled as matrices
from amp_studio.sim.tuning.linear import LinearModel
from amp_studio.sim.tuning.sampled import Places, Plant, exponential, jacobian, zero_order_hold
from tests.campaigns import some
from tests.sim.tuning_judge import compared

COMMAND, COMMAND_VELOCITY, COMMAND_ACCELERATION, POSITION, MOTOR, OUTPUT = range(6)
PLACES = Places(
    {"command": 2, "command_velocity": 3, "command_acceleration": 4, "position": 5, "motor": 6, "output": 7}
)
"""Two states of the law, then six signals."""

PERIOD = 0.002


def sampled(*parts) -> LinearModel:
    """Join law and machine."""
    return LinearModel(**vars(matrices.sampled(*parts)))


def rigid(gain: float, viscous: float, delay: float = 0.0) -> Plant:
    """A mass with viscous friction: position and speed."""
    return Plant(
        np.array([[0.0, 1.0], [0.0, -viscous]]),
        np.array([[0.0], [gain]]),
        np.array([[1.0, 0.0]]),
        np.array([[1.0, 0.0]]),
        delay,
    )


def pid(kp: float, ki: float, kd: float):
    """A law in one loop: states are the sum of the error and the error before."""

    def sample(z: np.ndarray) -> np.ndarray:
        after = z.copy()
        error = z[2] - z[5]
        after[0] = z[0] + error * PERIOD
        after[1] = error
        after[7] = kp * error + ki * after[0] + kd * (error - z[1]) / PERIOD
        return after

    return jacobian(sample, np.zeros(8))


@pytest.fixture(scope="module")
def control() -> ModuleType:
    """python-control, imported here alone, as every worker reads every module of tests, and without
    matplotlib, of which it asks for nothing that is computed here and which takes four seconds.
    """
    drawing = (
        "matplotlib",
        "matplotlib.projections",
        "matplotlib.pyplot",
        "matplotlib.transforms",
        "mpl_toolkits",
        "mpl_toolkits.axisartist",
        "mpl_toolkits.axisartist.angle_helper",
        "mpl_toolkits.axisartist.grid_helper_curvelinear",
    )
    with pytest.MonkeyPatch.context() as patch:
        for name in drawing:
            patch.setitem(sys.modules, name, MagicMock())
        import control

    return control


def by_control(control: ModuleType, plant: Plant, kp: float, ki: float, kd: float) -> Any:
    """The same open loop by python-control."""
    body = control.sample_system(control.ss(plant.a, plant.b, plant.load, 0.0), PERIOD, "zoh")
    z = control.tf([1, 0], [1], PERIOD)
    law = kp + ki * PERIOD * z / (z - 1) + kd / PERIOD * (z - 1) / z
    return body * control.ss(law)


@pytest.fixture(scope="module")
def model() -> LinearModel:
    """A PID axis."""
    return sampled(rigid(40.0, 3.0), pid(60.0, 200.0, 1.2), None, PLACES, PERIOD, PERIOD)


def test_the_margins_are_those_of_python_control(control: ModuleType, model: LinearModel) -> None:
    gain, phase, at_gain, at_phase = control.margin(by_control(control, rigid(40.0, 3.0), 60.0, 200.0, 1.2))
    found = model.margins()
    assert found.phase == pytest.approx(phase, rel=1e-3)
    assert found.phase_frequency == pytest.approx(at_phase / 2 / np.pi, rel=1e-3)
    assert found.gain == pytest.approx(20 * np.log10(gain), rel=1e-3)
    assert found.gain_frequency == pytest.approx(at_gain / 2 / np.pi, rel=1e-3)


def test_the_poles_are_those_of_python_control(control: ModuleType, model: LinearModel) -> None:
    wanted = control.feedback(by_control(control, rigid(40.0, 3.0), 60.0, 200.0, 1.2)).poles()
    assert sorted(np.abs(model.poles())) == pytest.approx(sorted(np.abs(wanted)), abs=1e-6)
    assert model.is_stable()


def test_the_bandwidth_is_that_of_python_control(control: ModuleType, model: LinearModel) -> None:
    closed = control.feedback(by_control(control, rigid(40.0, 3.0), 60.0, 200.0, 1.2))
    w = np.linspace(1.0, 2 * np.pi * 249.0, 20_001)
    response = closed(np.exp(1j * w * PERIOD))
    wanted = w[np.flatnonzero(np.abs(response) < np.sqrt(0.5))[0]] / 2 / np.pi
    assert model.bandwidth() == pytest.approx(wanted, rel=1e-3)


def test_the_matrix_exponential_is_that_of_scipy() -> None:
    import scipy.linalg  # here, as it takes long: every worker collects all tests

    matrix = np.array([[0.0, 1.0, 0.0], [-9e4, -6.0, 9e4], [3.0, 0.0, -2000.0]])
    assert exponential(matrix * 0.001) == pytest.approx(
        scipy.linalg.expm(matrix * 0.001), rel=1e-9, abs=1e-12
    )


def test_a_kept_input_moves_the_machine_as_scipy_discretises_it() -> None:
    import scipy.signal

    plant = rigid(40.0, 3.0)
    a, b, *_ = scipy.signal.cont2discrete((plant.a, plant.b, plant.load, np.zeros((1, 1))), PERIOD)
    for found, wanted in zip(zero_order_hold(plant.a, plant.b, PERIOD), (a, b), strict=True):
        assert found == pytest.approx(wanted, rel=1e-9, abs=1e-15)


@pytest.mark.parametrize("delay", [0.0, 0.0007, 0.002, 0.0033])
def test_a_delay_costs_its_phase_at_every_frequency(delay: float) -> None:
    """A delayed output that stays constant moves the machine as late: e^(-j w d) of the continuous machine,
    not of its samples.
    """
    frequencies = np.array([1.0, 10.0, 40.0])
    prompt = sampled(rigid(40.0, 3.0), pid(60.0, 0.0, 1.2), None, PLACES, PERIOD, PERIOD)
    late = sampled(rigid(40.0, 3.0, delay), pid(60.0, 0.0, 1.2), None, PLACES, PERIOD, PERIOD)
    lag = np.angle(late.loop(frequencies) / prompt.loop(frequencies))
    assert lag == pytest.approx(-2 * np.pi * frequencies * delay, rel=2e-2)


def test_a_faster_velocity_loop_is_joined_as_it_runs() -> None:
    """Four velocity periods a servo period: the matrices move as the functions and the machine do,
    step by step.
    """
    loops, plant = 4, rigid(500.0, 2.0, 0.0002)
    velocity_period = PERIOD / loops

    def position(z: np.ndarray) -> np.ndarray:
        after = z.copy()
        after[1] = 30.0 * (z[2] - z[5]) + 0.5 * z[3]
        return after

    def velocity(z: np.ndarray) -> np.ndarray:
        after = z.copy()
        after[7] = 0.3 * (z[1] - (z[6] - z[0]) / velocity_period)
        after[0] = z[6]
        return after

    rest = np.zeros(8)
    period, both = velocity_period, (jacobian(position, rest), jacobian(velocity, rest))
    model = sampled(plant, *both, PLACES, PERIOD, period)

    x, z, waiting = np.zeros((2, 1)), np.zeros(8), 0.0
    fine = velocity_period / 5 * 2  # the delay is two fifths of a velocity period
    found, wanted, state = [], [], np.zeros(len(model.open))
    for k in range(60):
        command = np.sin(60.0 * k * PERIOD)
        found.append((model.position @ state)[0])
        wanted.append(x[0, 0])
        state = model.closed @ state + model.command @ np.array([command, 7.0, 0.0])
        z[2], z[3], z[5], z[6] = command, 7.0, x[0, 0], x[0, 0]
        z = position(z)
        for _ in range(loops):
            z[6] = x[0, 0]
            z = velocity(z)
            for time, output in ((fine, waiting), (velocity_period - fine, z[7])):
                phi, gamma = zero_order_hold(plant.a, plant.b, time)
                x = phi @ x + gamma * output
            waiting = z[7]
    assert found == pytest.approx(wanted, rel=1e-9, abs=1e-12)


def test_the_answer_to_a_sine_is_the_frequency_response() -> None:
    model = sampled(rigid(40.0, 3.0), pid(60.0, 200.0, 1.2), None, PLACES, PERIOD, PERIOD)
    frequency, state, found = 12.5, np.zeros(len(model.open)), []
    for k in range(4000):  # 40 samples a cycle
        found.append((model.position @ state)[0])
        turn = 2 * np.pi * frequency * k * PERIOD
        state = model.closed @ state + model.command @ np.array([np.sin(turn), 0.0, 0.0])
    tail = np.array(found[2000:])
    turn = 2 * np.pi * frequency * np.arange(2000, 4000) * PERIOD
    answer = 2.0 * np.mean(tail * np.exp(-1j * turn)) * 1j
    assert answer == pytest.approx(complex(model.follows(np.array([frequency]))[0]), rel=1e-6)


def test_a_gain_beyond_the_margin_is_unstable_and_has_a_negative_margin(model: LinearModel) -> None:
    factor = 10 ** (model.margins().gain / 20)
    for share, stable in ((0.99, True), (1.01, False)):
        k = factor * share
        louder = sampled(rigid(40.0, 3.0), pid(60.0 * k, 200.0 * k, 1.2 * k), None, PLACES, PERIOD, PERIOD)
        assert louder.is_stable() is stable
        assert louder.margins().gain == pytest.approx(-20 * np.log10(share), abs=0.01)


def test_signals_that_the_law_does_not_use_add_no_poles(model: LinearModel) -> None:
    assert len(model.open) == 4  # position and speed, the sum of the error and the error before


@pytest.mark.parametrize("delay", [0.0, 0.0045, 0.04, 0.1999])
def test_the_response_by_modes_is_that_of_the_matrices(delay: float) -> None:
    model = sampled(rigid(40.0, 3.0, delay), pid(20.0, 40.0, 0.6), None, PLACES, PERIOD, PERIOD)
    frequencies = np.geomspace(0.05, 249.0, 40)
    z = np.exp(2j * np.pi * frequencies * PERIOD)
    size = np.eye(len(model.open))
    direct = [-(model.sensed @ np.linalg.solve(each * size - model.open, model.measured))[0, 0] for each in z]
    assert model.loop(frequencies) == pytest.approx(np.array(direct), rel=1e-6)


def test_the_way_under_a_push_is_that_of_scipy() -> None:
    from scipy import signal

    plant = replace(rigid(40.0, 3.0, 0.03), push=np.array([[0.0], [40.0]]))
    model = sampled(plant, pid(20.0, 40.0, 0.6), None, PLACES, PERIOD, PERIOD)
    system = model.closed, model.pushed, model.position, np.zeros((1, 1)), model.period
    for steps in (1, 2, 7, 64, 500):
        way = signal.dlsim(system, np.ones((steps + 1, 1)))[1][1:, 0]
        assert model.pushed_way(steps) == pytest.approx(way, rel=1e-9)


def test_a_delay_beyond_any_loop_is_one_sentence() -> None:
    with pytest.raises(SimulationError, match="at most 100 are simulated"):
        sampled(rigid(40.0, 3.0, 0.5), pid(20.0, 40.0, 0.6), None, PLACES, PERIOD, PERIOD)


@pytest.mark.parametrize("seed", range(5))
def test_the_loop_of_a_random_axis_is_that_of_python_control_to_nine_digits(
    control: ModuleType, seed: int
) -> None:
    """Open loop, closed loop and largest sensitivity at the same frequencies,
    and the slowest poles of the closed loop.
    """
    dice = np.random.default_rng(seed)
    plant = rigid(float(dice.uniform(10.0, 80.0)), float(dice.uniform(0.5, 6.0)))
    gains = dice.uniform(20.0, 80.0), dice.uniform(50.0, 300.0), dice.uniform(0.5, 1.5)
    found, peer = (
        sampled(plant, pid(*gains), None, PLACES, PERIOD, PERIOD),
        by_control(control, plant, *gains),
    )
    frequencies = np.geomspace(0.5, 240.0, 60)
    loop = peer(np.exp(2j * np.pi * frequencies * PERIOD))
    assert found.loop(frequencies) == pytest.approx(loop, rel=1e-9)
    assert found.feedback(frequencies) == pytest.approx(loop / (1.0 + loop), rel=1e-9)
    poles = control.feedback(peer).poles()
    assert sorted(np.abs(found.poles()))[-3:] == pytest.approx(sorted(np.abs(poles))[-3:], rel=1e-9)
    largest, at = found.sensitivity()
    there = peer(np.exp(2j * np.pi * at * PERIOD))
    assert largest == pytest.approx(abs(1.0 / (1.0 + there)), rel=1e-9)


@pytest.mark.parametrize("number", some(range(5), 2))  # of each family with gains
def test_the_figures_of_tune_are_those_of_python_control(number: int, control: ModuleType) -> None:
    assert list(compared(number, control)) == []
