"""The result of a simulation as a document: what a person signs beside the machine."""

import re
from math import copysign, cos, sin
from pathlib import Path

import pytest

from amp_studio import cli
from amp_studio.files import open_file
from amp_studio.motion_paper import motion_paper
from amp_studio.report import Paper
from amp_studio.sim import Trace, simulate

MILL = Path(__file__).parents[1] / "examples" / "num-1060-mill" / "MILL_1060.amp"


@pytest.fixture(scope="module")
def tuned() -> Trace:
    return simulate(open_file(MILL).file, "tune", "0", {"model.delay": "1 ms"})


def table(paper: Paper, title: str) -> tuple[tuple[str, ...], ...]:
    return next(each.rows for each in paper.tables if each.title == title)


def test_a_tuning_record_has_gains_figures_and_machine_before_and_after(tuned: Trace) -> None:
    given = [("model.delay", "1 ms", "machine.yaml")]
    paper = motion_paper(open_file(MILL).file, "MILL_1060.amp", tuned, machine=given)
    assert paper.kind == "Tuning record"
    facts = dict(paper.facts)
    assert facts["Axis"] == "0 (X)"
    assert facts["Made by"]
    first = table(paper, "Recommended")[0]
    assert first[:3] == ("P21N0", "Servo-System Loop Gain Coefficient", "4915")
    figures = {row[0]: row[1:] for row in table(paper, "Figures")}
    assert {"Ms", "phase margin", "gain margin", "stiffness"} <= figures.keys()
    assert figures["Ms"][0] != figures["Ms"][1]
    assert table(paper, "Given of the machine") == tuple(given)
    assert any(row[0].startswith("ASSUMED") for row in table(paper, "Machine and assumptions"))
    assert paper.signed


def test_its_picture_has_the_push_on_the_load_and_ms_over_the_inertia(tuned: Trace) -> None:
    (figure,) = motion_paper(open_file(MILL).file, "MILL_1060.amp", tuned).figures
    words = re.findall(r">([^<>]+)</text>", figure.svg)
    assert {"Ms over the inertia", "present", "recommended"} <= set(words)


def test_a_friction_fit_is_a_document(tmp_path: Path) -> None:
    record, page = tmp_path / "drive.csv", tmp_path / "fit.html"
    rows = ((n / 50, 80.0 * sin(0.12 * n), 9.6 * cos(0.12 * n)) for n in range(300))
    lines = (f"{t},{v:.3f},{i + 0.03 * v + copysign(2.0, v):.3f}\n" for t, v, i in rows)
    record.write_text("time (s),velocity (mm/s),torque (%)\n" + "".join(lines))
    mill = MILL.parents[1] / "mill-1394" / "MILL_1394.amp"
    assert cli.run(["simulate", str(mill), "identify", str(record), "--axis", "X", "-o", str(page)]) == 0
    written = page.read_text(encoding="utf-8")
    assert "Machine from a record" in written
    assert "Coulomb friction" in written
    assert "data:image/svg+xml;base64," in written
