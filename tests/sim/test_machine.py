"""A machine that cannot be computed with is refused before anything is computed."""

import pytest

from amp_studio.sim import SimulationError
from amp_studio.sim.engine.machine import Machine


@pytest.mark.parametrize(
    ("figure", "value", "sentence"),
    [
        ("inertia_ratio", 1e300, "Inertia ratio of the machine is 1e+300; at most 10000 is simulated"),
        ("gravity", -1e300, "Gravity of the machine is -1e+300; at most 1e+09 is simulated"),
        ("delay", 2.0, "Delay of the machine is 2; at most 1 is simulated"),
        ("damping", 11.0, "Damping of the machine is 11; at most 10 is simulated"),
        ("viscous_friction", 1e300, "The machine is too stiff to simulate (1e+300 1/s)"),
        ("velocity_integral", 1e300, "The machine is too stiff to simulate (1.77245e+151 1/s)"),
        ("backlash", float("nan"), "Backlash of the machine is nan; it must be finite"),
    ],
)
def test_a_figure_that_no_machine_has_is_refused(figure: str, value: float, sentence: str) -> None:
    figures = {"acceleration_per_output": 1.0, "velocity_per_output": 1.0, "velocity_bandwidth": 50.0}
    with pytest.raises(SimulationError) as raised:
        Machine(**{**figures, figure: value})
    assert raised.value.what == sentence
