"""A trace as CSV, SVG, PNG and JSON."""

import json
import struct
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from amp_studio.sim import (
    Recommendation,
    SimulationError,
    Trace,
    plot_svg,
    trace_summary,
    trace_text,
    write_trace,
)
from amp_studio.sim.rounding import rounded_down, rounded_up, value_text
from amp_studio.sim.scenarios.step import run_step
from amp_studio.sim.write import trace_csv

from .tiny import tiny

MOVE = {"move.distance": 60.0, "move.feedrate": 6000.0}


@pytest.fixture(scope="module")
def trace() -> Trace:
    return run_step(tiny(excess=7.0), MOVE)


@pytest.fixture(scope="module")
def stopped() -> Trace:
    advice = Recommendation("excess_error", 5.5, "mm", "The following error reaches 5 mm.")
    return replace(run_step(tiny(excess=1.0), MOVE), recommendations=(advice,))


def test_csv_gives_back_every_number_exactly(trace: Trace) -> None:
    heading, *lines = trace_csv(trace).splitlines()
    assert (
        heading
        == "time_s,command_position [mm],command_velocity [mm/min],position [mm],measured_position [mm],"
        "following_error [mm],velocity [mm/min],output [%],torque [%],wanted_velocity [mm/s]"
    )
    read = np.array([[float(cell) for cell in line.split(",")] for line in lines]).T
    assert all(np.array_equal(a, b) for a, b in zip(read, trace.columns.values(), strict=True))


def test_the_plot_is_wellformed_and_names_axes_units_and_limits(trace: Trace) -> None:
    root = ET.fromstring(plot_svg(trace))
    texts = ["".join(node.itertext()) for node in root.iter("{http://www.w3.org/2000/svg}text")]
    for words in (
        "Step, axis 1: 60 mm at 6000 mm/min",
        "position (mm)",
        "following error (mm)",
        "velocity (mm/min)",
        "torque (%)",
        "settling (mm)",
        "time, s",
    ):
        assert words in texts
    assert any("excess error 7 mm" in text for text in texts)
    curves = [node.get("points", "") for node in root.iter("{http://www.w3.org/2000/svg}polyline")]
    assert len(curves) == 7
    for points in curves:
        xy = np.array([[float(v) for v in point.split(",")] for point in points.split()])
        assert xy[:, 0].min() >= 84
        assert xy[:, 0].max() <= 930
        assert xy[:, 1].min() >= 76
        assert xy[:, 1].max() <= float(root.get("height", "0"))


def test_an_alarm_is_in_the_plot(stopped: Trace) -> None:
    assert "EXCESS ERROR at " in plot_svg(stopped)


def test_a_motion_of_one_row_can_be_drawn() -> None:
    still = run_step(tiny(), {**MOVE, "move.duration": 1e-5})
    assert still.rows == 1
    ET.fromstring(plot_svg(still))


def test_the_file_is_written_by_its_ending(trace: Trace, tmp_path: Path) -> None:
    for name in ("a.csv", "b.SVG", "c.png"):
        write_trace(trace, tmp_path / name)
    assert (tmp_path / "a.csv").read_text(encoding="utf-8") == trace_csv(trace)
    assert (tmp_path / "b.SVG").read_text(encoding="utf-8") == plot_svg(trace)
    png = (tmp_path / "c.png").read_bytes()
    assert png.startswith(b"\x89PNG\r\n\x1a\n")
    width, height = struct.unpack(">II", png[16:24])
    assert width == 1440
    assert 1300 < height < 1700
    with pytest.raises(SimulationError, match=r"\.csv, \.svg, \.png"):
        write_trace(trace, tmp_path / "d.pdf")
    with pytest.raises(OSError, match="gone"):
        write_trace(trace, tmp_path / "gone" / "a.csv")


def test_the_summary_has_the_promised_keys_and_is_json(trace: Trace) -> None:
    reported = json.loads(json.dumps(trace_summary(trace), allow_nan=False))
    assert {"scenario", "axis", "model", "result", "alarms", "advice", "trace"} <= set(reported)
    assert reported["trace"] == {"columns": list(trace.columns), "rows": trace.rows}
    assert reported["result"]["steady_following_error"].keys() == {"value", "unit"}
    for advice in reported["advice"]:
        assert advice.keys() >= {"param", "value", "why"}


def test_an_alarm_and_its_advice_stand_in_summary_and_text(stopped: Trace) -> None:
    reported = trace_summary(stopped)
    assert reported["alarms"][0].keys() == {"code", "time_s", "message"}
    assert reported["advice"][0]["param"] == "excess_error"
    assert reported["advice"][0]["value"] == "5.5 mm"
    text = trace_text(stopped)
    assert f"ALARM {reported['alarms'][0]['code']} at " in text
    assert "excess_error = 5.5 mm: " in text
    assert "Assumptions" in text


def test_numbers_are_rounded_to_the_safe_side_and_written_short() -> None:
    assert (rounded_up(10.16999), rounded_down(352.78), rounded_up(11.0), rounded_up(0.0)) == (
        10.2,
        352.0,
        11.0,
        0.0,
    )
    assert rounded_up(0.1 + 0.2, 3) == 0.301
    assert (value_text(10160.0, "mm"), value_text(0.0254), value_text(1e-7), value_text(1e7)) == (
        "10160 mm",
        "0.0254",
        "0.0000001",
        "10000000",
    )
    assert value_text(1.2e-13, "mm") == "0 mm", "the rounding of the calculation is no figure"
