"""One unit of length everywhere in a simulation: that of the file."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from amp_studio.cli import run
from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.sim import SimulationError, listing, plot_svg, simulate
from amp_studio.sim.unit_system import described, in_text
from amp_studio.sim.write import trace_csv

EXAMPLES = Path(__file__).parents[2] / "examples"
ROUTER = EXAMPLES / "acromill-router" / "ROUTER.amp"


@pytest.fixture(scope="module")
def mill() -> ParameterFile:
    """Return the example mill, in metric units."""
    return open_file(EXAMPLES / "mill-1394" / "MILL_1394.amp").file


def test_a_file_in_inches_gives_the_same_motion_in_inches(mill: ParameterFile) -> None:
    move = {"move.distance": "50.8 mm"}
    metric, inch = simulate(mill, "step", "1", move), simulate(mill, "step", "1", move, "inch")
    assert metric.result["distance"] == (50.8, "mm")
    assert inch.result["distance"] == (2.0, "in")
    assert inch.result["feedrate"] == (pytest.approx(10000.0 / 25.4), "in/min")
    assert inch.units["velocity"] == "in/min"
    assert np.allclose(inch.columns["position"] * 25.4, metric.columns["position"], rtol=1e-15)
    assert inch.columns["time_s"] is not None
    assert np.array_equal(inch.columns["torque"], metric.columns["torque"])
    assert inch.result["peak_torque"] == metric.result["peak_torque"]


def test_no_millimetre_is_left_where_a_file_is_in_inches() -> None:
    file = open_file(ROUTER).file
    trace = simulate(file, "step", "X")
    assert "[in]" in trace_csv(trace).partition("\n")[0]
    written = [trace_csv(trace).partition("\n")[0], plot_svg(trace), *trace.assumptions, repr(trace.result)]
    assert not [text for text in written if "mm" in text.replace("command", "").replace("summed", "")]
    known = listing(file)
    texts = [*known.model.values(), *(text for each in known.scenarios for text in each.settings.values())]
    assert not [text for text in texts if re.search(r"\bmm\b", text)]


def test_a_bare_number_of_a_setting_is_in_the_unit_of_the_file(mill: ParameterFile) -> None:
    # The step at 2 is 2 in of a linear axis and 2 deg of one that turns, also in inches.
    linear = simulate(mill, "step", "1", {"move.distance": 2.0, "move.feedrate": "100"}, "inch")
    assert linear.result["distance"] == (2.0, "in")
    assert linear.result["feedrate"] == (pytest.approx(100.0, rel=1e-15), "in/min")
    turning = simulate(mill, "step", "4", {"move.distance": 2.0}, "inch")
    assert turning.result["distance"] == (2.0, "deg")
    backlash = simulate(mill, "step", "1", {"move.distance": "1 mm", "model.backlash": 0.001}, "inch")
    assert np.array_equal(
        backlash.columns["torque"],
        simulate(mill, "step", "1", {"move.distance": 1.0, "model.backlash": 0.0254}).columns["torque"],
    )


def test_an_alarm_and_a_recommendation_are_in_inches_too(mill: ParameterFile) -> None:
    tight = mill.copy()
    tight.set(("servo.excess_error", "1"), Value(5.08, "mm"))
    trace = simulate(tight, "step", "1", system="inch")
    assert "above 0.2 in (1750 Excess Error)" in trace.alarms[0].message
    wanted = next(each for each in trace.recommendations if each.parameter == "servo.excess_error")
    assert wanted.unit == "in"
    assert wanted.value == pytest.approx(11.0 / 25.4, rel=1e-5)
    assert "mm" not in wanted.why.replace("command", "")
    applied = tight.copy()
    applied.set(("servo.excess_error", "1"), Value(wanted.value, wanted.unit))
    assert not simulate(applied, "step", "1", system="inch").alarms


def test_the_command_line_follows_the_file_or_what_is_asked_for(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["simulate", str(ROUTER), "step", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["result"]["distance"]["unit"] == "in"
    assert run(["simulate", str(ROUTER), "step", "--units", "metric", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["result"]["distance"]["unit"] == "mm"
    assert run(["simulate", str(ROUTER), "step", "--units", "furlong"]) == 2
    assert "Unknown unit system 'furlong'. Known: metric, inch" in capsys.readouterr().err


def test_a_family_without_inches_has_none(mill: ParameterFile) -> None:
    num = open_file(EXAMPLES / "num-1060-mill" / "MILL_1060.amp").file
    with pytest.raises(SimulationError, match="Unknown unit system 'inch'"):
        simulate(num, "step", system="inch")


@pytest.mark.parametrize(
    ("metric", "inch"),
    [
        (
            "Following error above 25.4 mm (servo.excess_error@1)",
            "Following error above 1 in (servo.excess_error@1)",
        ),
        ("at 254 mm/min, 2.54 mm/s2.", "at 10 in/min, 0.1 in/s2."),
        ("printed in mm and inches only (7-67)", "printed in mm and inches only (7-67)"),
        ("5 mm/sample and 3 mmol, v5 mm", "0.19685 in/sample and 3 mmol, v5 mm"),
    ],
)
def test_lengths_in_a_sentence_are_converted(metric: str, inch: str) -> None:
    assert in_text(metric, "mm") == metric
    assert in_text(metric, "in") == inch


def test_a_description_names_the_unit_of_the_file() -> None:
    assert described("radius (mm or deg); default: 25.4 mm", "in") == "radius (in or deg); default: 1 in"
    assert described("speed (mm/min or deg/min)", "in") == "speed (in/min or deg/min)"
