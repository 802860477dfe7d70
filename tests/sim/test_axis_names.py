"""An axis is named by itself or by its letter, and a result shows both."""

from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.files import open_file
from amp_studio.sim import SimulationError, listing, plot_svg, simulate, trace_summary, trace_text

EXAMPLES = Path(__file__).parents[2] / "examples"
NUM = EXAMPLES / "num-1060-mill" / "MILL_1060.amp"


def test_an_axis_of_a_num_shows_its_letter() -> None:
    # P9 assigns address 1 to Y (4-24).
    file = open_file(NUM).file
    trace = simulate(file, "step", "y")
    assert (trace.axis, trace.letter) == ("1", "Y")
    assert trace_text(trace).startswith("step, axis 1 (Y): ")
    assert ">Step, axis 1 (Y): " in plot_svg(trace)
    assert [trace_summary(trace)[key] for key in ("axis", "letter")] == ["1", "Y"]
    assert listing(file).letters == ("X", "Y", "Z", "B")


def test_the_list_of_axes_has_letters_where_an_axis_has_another_name(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run(["simulate", str(NUM), "--list"]) == 0
    assert capsys.readouterr().out.startswith("axes: 0 (X), 1 (Y), 2 (Z), 3 (B)\n")
    assert run(["simulate", str(EXAMPLES / "acromill-router" / "ROUTER.amp"), "--list"]) == 0
    assert capsys.readouterr().out.startswith("axes: X, Y, Z\n")


def test_the_second_axis_of_a_circle_is_named_by_its_letter_and_is_another_one() -> None:
    file = open_file(NUM).file
    assert simulate(file, "circle", "X", {"move.second_axis": "Z"}).model.endswith("circle of axes 0 and 2")
    with pytest.raises(SimulationError, match="Axis 0 makes no circle with itself"):
        simulate(file, "circle", "X", {"move.second_axis": "0"})
