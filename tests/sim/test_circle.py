"""Two axes on a circle: the radius error is that of the linear model, and reversals leave their spikes."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from amp_studio.files import open_file
from amp_studio.schema import Value
from amp_studio.sim import SimulationError, Trace, simulate
from amp_studio.sim.scenarios import SCENARIOS
from tests.campaigns import some
from tests.sim.tiny import changed, tiny

EXAMPLES = Path(__file__).parents[2] / "examples"
SETTINGS = {"move.radius": 20.0, "move.feedrate": 3000.0}


@cache
def alike() -> Trace:
    """Return the circle of two axes that are the same."""
    return SCENARIOS["circle"].run(tiny(), SETTINGS)


def test_the_radius_error_is_that_of_the_linear_model_and_near_the_first_order_figure() -> None:
    trace = alike()
    result = {name: value for name, (value, _) in trace.result.items()}
    assert result["predicted_radius_error"] == pytest.approx(
        20.0 * (1.0 - abs(_lag(20.0, 200.0, 2.5))), rel=0.03
    )
    assert result["radius_error"] == pytest.approx(result["predicted_radius_error"], rel=2e-3)
    assert result["first_order_radius_error"] == pytest.approx(50.0**2 / (2 * 20.0 * 20.0**2))
    assert result["reversal_spike"] < 2e-3


def _lag(gain: float, velocity_rate: float, rate: float) -> complex:
    """A first-order velocity loop in a proportional position loop."""
    s = 1j * rate
    loop = gain / s * velocity_rate / (s + velocity_rate)
    return loop / (1.0 + loop)


def test_the_measured_turn_is_one_turn_from_angle_0() -> None:
    trace = alike()
    angle = trace.columns["angle_deg"]
    assert angle[0] == pytest.approx(0.0, abs=0.1)
    assert angle[-1] == pytest.approx(360.0, abs=0.1)
    assert np.all(np.diff(angle) > 0)
    assert trace.columns["position"][0] == pytest.approx(20.0, abs=0.3)


def test_backlash_and_friction_leave_a_spike_at_a_reversal() -> None:
    rough = changed(tiny(), backlash=0.02, coulomb_friction=3.0, static_friction=5.0, load_sensor=False)
    trace = SCENARIOS["circle"].run(rough, SETTINGS)
    assert trace.result["reversal_spike"][0] > 0.008
    assert trace.result["reversal_spike_angle"][0] % 90.0 < 40.0


def test_two_unequal_gains_make_an_ellipse() -> None:
    trace = SCENARIOS["circle"].run(tiny(gain=20.0), SETTINGS, tiny(gain=25.0))
    assert trace.result["circularity"][0] > 10 * alike().result["circularity"][0]


@pytest.mark.parametrize("gain", some([25.0, 40.0], 2))
def test_unequal_axes_without_friction_have_the_predicted_radius_and_no_spike(gain: float) -> None:
    result = SCENARIOS["circle"].run(tiny(), SETTINGS, tiny(gain=gain)).result
    assert result["radius_error"][0] == pytest.approx(result["predicted_radius_error"][0], rel=1e-3)
    assert result["circularity"][0] > 0.4, "an ellipse, and not a departure from it"
    assert result["reversal_spike"][0] < 5e-4


def test_a_second_axis_that_is_not_given_is_named_as_assumed() -> None:
    assert any("second axis" in note for note in alike().assumptions)
    assert not any(
        "second axis" in note for note in SCENARIOS["circle"].run(tiny(), SETTINGS, tiny()).assumptions
    )


def test_an_unstable_axis_is_called_so_and_gets_no_radius_error() -> None:
    trace = SCENARIOS["circle"].run(tiny(gain=2500.0), SETTINGS)
    assert [alarm.code for alarm in trace.alarms] == ["UNSTABLE"]
    assert trace.result["radius_error"][0] is None
    assert trace.result["predicted_radius_error"][0] is None


def test_an_open_position_loop_closes_no_circle_and_is_not_called_unstable() -> None:
    mill = open_file(EXAMPLES / "mill-1394" / "MILL_1394.amp").file
    mill.set(("servo.position_loop_type", "1"), Value("open"))
    with pytest.raises(SimulationError, match="position loop of axis 1 is open: it closes no circle"):
        simulate(mill, "circle", "1")


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"move.radius": 0.0}, "above 0"),
        ({"move.radius": float("inf")}, "finite"),
        ({"move.radius": 1e-6, "move.feedrate": 3000.0}, "turns until"),
        ({"move.distance": 5.0}, "Unknown setting"),
    ],
)
def test_an_impossible_circle_is_one_sentence(settings: dict[str, float], words: str) -> None:
    with pytest.raises(SimulationError, match=words):
        SCENARIOS["circle"].run(tiny(), settings)
