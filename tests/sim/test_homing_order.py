"""In which step of a homing of all axes an axis is: priority, phase, HOME_SEQUENCE."""

import pytest

from amp_studio.schema import Value
from amp_studio.sim import SimulationError, simulate
from tests.programs.test_block import example


@pytest.mark.parametrize(
    ("machine", "address", "value", "order"),
    [
        ("acromill-router", ("home.priority", "X"), Value(2), 2.0),
        ("grblhal-router", ("homing.phase_2", ""), Value(1), 2.0),
        ("linuxcnc-mill", ("joint.home_sequence", "0"), Value(-3), 3.0),
    ],
)
def test_the_step_of_an_axis_is_a_figure_of_its_homing(machine, address, value, order) -> None:
    """AcroMill page 65, grblHAL $44 to $49, LinuxCNC HOME_SEQUENCE, whose sign is for its last move."""
    file = example(machine)
    if machine == "grblhal-router":
        file.set(("homing.phase_1", ""), Value(4))
    file.set(address, value)
    assert simulate(file, "home", "X", {}).result["home_order"] == (order, "")


def test_an_axis_of_priority_0_is_not_homed() -> None:
    """AcroMill, page 65."""
    file = example("acromill-router")
    file.set(("home.priority", "X"), Value(0))
    with pytest.raises(SimulationError, match="not homed"):
        simulate(file, "home", "X", {})
