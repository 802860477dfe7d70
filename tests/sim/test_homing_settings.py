"""Settings of a homing that its sequence has no use for are refused, not ignored."""

import pytest

from amp_studio.schema import Value
from amp_studio.sim import SimulationError, simulate
from tests.programs.test_block import example


@pytest.mark.parametrize(
    ("name", "axis", "parameter", "value"),
    [
        ("lathe-ls176", "1", "", None),  # distance-coded markers, 5-5
        ("num-1060-mill", "0", "travel.switch_not_tested", Value(1)),  # P15N1, 7-8
        ("57c422b-label-press", "X", "", None),  # marker alone, 4-29
        ("syntec-mill", "1", "home.search_method", Value("index-only")),  # 2.2
    ],
)
@pytest.mark.parametrize(
    ("setting", "given"), [("move.switch", 5.0), ("move.dog", "stuck"), ("move.switch_length", 2.0)]
)
def test_a_setting_of_a_switch_is_refused_where_there_is_none(
    name: str, axis: str, parameter: str, value: Value | None, setting: str, given: float | str
) -> None:
    file = example(name)
    if value is not None:
        file.set((parameter, axis if parameter.startswith("home") else ("")), value)
    with pytest.raises(SimulationError, match=rf"without a switch .*leave out {setting}"):
        simulate(file, "home", axis, {setting: given})
