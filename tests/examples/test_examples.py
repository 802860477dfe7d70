"""Every example is a machine that runs: complete, sound, explained, and unharmed by the program."""

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.files import Document, ParameterFile, Project, fitted_axes, open_file
from amp_studio.files.axes import axis_type
from amp_studio.report import Contents, print_report
from amp_studio.schema import Address, read_address
from amp_studio.sim import simulate, simulated_axes
from amp_studio.sim.law import simulated_families
from tests.campaigns import CAMPAIGN

SOURCE = re.compile(
    r"\b(?:page (?:(?:\d{1,2}|[AB])(?:-\d{1,2}|(?:\.\d{1,2})+)|\d{1,3})|ours)\b|^printed default\b"
)

"""A page of the manual, or the example's own choice."""


def entries(path: Path) -> list[tuple[str, str]]:
    """Return (key, comment) of every value as it is written: the comment beside it,
    else that above its parameter's block.

    A block is the lines of one parameter; what is between two blocks belongs to the one below.
    """
    found: list[tuple[str, str]] = []
    above, parameter = "", ""
    _, _, lines = path.read_text(encoding="utf-8").partition("\nvalues:\n")
    for line in lines.splitlines():
        text = line.strip()
        if text.startswith("#"):
            above, parameter = above + text.lstrip("# ") + " ", ""
        elif text and text != "...":
            entry, _, beside = text.partition("  # ")
            key = entry.partition(":")[0]
            if parameter not in ("", read_address(key)[0]):
                above = ""
            parameter = read_address(key)[0]
            found.append((key, beside or above))
        else:
            above = ""
    return found


def in_force(file: ParameterFile) -> list[Address]:
    return [a for a in file.addresses() if file.evaluation.state(a).state == "in-force"]


def test_nothing_is_found_wrong(example: Path, capsys: pytest.CaptureFixture[str]) -> None:
    # A recommendation that an example keeps on purpose would be in its README; at present there is none.
    assert run(["validate", str(example)]) == 0
    assert capsys.readouterr().out == f"{example}: 0 errors, 0 warnings, 0 recommendations\n"


def test_every_parameter_in_force_has_a_value(example: Path) -> None:
    file = open_file(example).file
    asked = [
        a for a in in_force(file) if not a[1] or (a[0], "") not in file.values
    ]  # what speaks for processes
    needed = [a for a in asked if not file.schema.parameters[a[0]].optional]
    assert [a for a in needed if a not in file.values] == []


def test_nothing_is_in_it_that_the_control_would_not_look_at(example: Path) -> None:
    file = open_file(example).file
    active = set(in_force(file))
    idle = {a for a in file.values if a not in active and not file.is_default(a)}
    assert {a for a in idle if a[1] in fitted_axes(file) or not a[1]} == set()
    assert file.unknown == {}
    assert file.forced == {}


def test_a_value_that_is_not_the_printed_default_shows_where_it_comes_from(example: Path) -> None:
    file = open_file(example).file
    reported = entries(example)
    assert len(reported) == len(file.values)
    silent = [
        key
        for key, comment in reported
        if not SOURCE.search(comment) and not file.is_default(read_address(key))
    ]
    assert silent == []


def test_the_project_shows_the_same_of_the_machine_as_the_file(example: Path) -> None:
    project, file = Project.open(example.parent), open_file(example).file
    assert [example] == project.files()
    assert (file.schema.family.family, file.machine, file.header.application) == (
        project.info.family,
        project.info.machine,
        project.info.application,
    )
    assert example.stem == file.header.name == project.info.name
    assert (example.parent / "README.md").is_file()


def test_its_linear_and_rotary_axes_make_their_rapid_moves_without_alarm(example: Path) -> None:
    file = open_file(example).file
    if file.schema.family.family not in simulated_families():
        pytest.skip("this family has no simulation")
    profiled = file.schema.family.axes is not None
    moving = [a for a in simulated_axes(file) if not (profiled and axis_type(file, a) == "spindle")]
    assert moving
    for axis in moving:
        trace = simulate(file, "step", axis)
        assert trace.alarms == ()
        assert trace.result.get("time_in_feedrate_suppression", (0.0, "s"))[0] == 0.0
        past = trace.result["overshoot"][0]
        assert past is not None
        # An integral part goes past the end by some micrometres, or by less than a count.
        assert past < {"counts": 1.0}.get(trace.result["overshoot"][1], 0.01)


EDITS = {
    "acromill": {"axes.inposition_band@X": "0.05 mm", "axes.soft_limit_plus@Y": "0.07 in"},
    "57c422b": {"setup.in_position_tolerance@X": "12 counts", "command.velocity@Y": "100000 counts/s"},
    "9pc": {
        "servo.inposition_band@1": "0.05 mm",
        "servo.excess_error@1": "20 mm",
        "home.g30_position@1": "1 in",
    },
    "num": {
        "servo.in_position_window@1": "25 iu",
        "axes.handwheels": "0x03",
        "comm.plctool_line": "Line $4 of the IT/serial line cards",
    },
    "grblhal": {"homing.pull_off": "2.5 mm", "axis.max_rate@Y": "7500 mm/min", "general.mode": "Lathe mode"},
    "syntec": {"jog.feedrate@1": "2500 mm/min", "home.grid@1": "ON"},
    "linuxcnc": {"joint.ferror@0": "0.8 mm", "display.program": "gmoccapy", "joint.home_use_index@2": "NO"},
}
"""Values of each family that its examples do not have."""


def edits(example: Path) -> list[str]:
    """Return changes as ``set`` takes them."""
    return [f"{name}={value}" for name, value in EDITS[open_file(example).file.schema.family.family].items()]


def test_a_save_touches_only_the_line_of_the_value(example: Path) -> None:
    before = example.read_text(encoding="utf-8").splitlines()
    edit = edits(example)[0]
    assert run(["set", str(example), edit]) == 0
    after = example.read_text(encoding="utf-8").splitlines()
    assert len(before) == len(after)
    changed = [new for old, new in zip(before, after, strict=True) if old != new and "signature:" not in new]
    assert [line.partition("  #")[0].rstrip() for line in changed] == [f"  {edit.replace('=', ': ')}"]


def test_a_value_put_back_leaves_the_file_as_it_was(example: Path) -> None:
    with Document.open(example) as document:
        document.save()  # the signature is that of the schema now
    before = example.read_bytes()
    assert run(["set", str(example), *edits(example)[1:]]) == 0
    assert before != example.read_bytes()
    with Document.open(example) as document:
        earlier = {entry.param: entry.old for entry in document.history()}
    assert run(["set", str(example), *(f"{param}={old}" for param, old in earlier.items())]) == 0
    assert before == example.read_bytes()


def test_what_is_changed_in_it_can_be_printed(
    example: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "example.pdf"
    if not CAMPAIGN and example.parent.name != "grblhal-router":
        monkeypatch.setattr("amp_studio.report.output.pdf.set_pdf", lambda source, options: (b"%PDF-", ""))
    print_report(open_file(example).file, path, Contents(changed_only=True), source=example)
    assert path.read_bytes().startswith(b"%PDF-")


def test_nothing_but_the_file_its_project_and_what_its_readme_names_is_shipped(example: Path) -> None:
    shipped = {p.name for p in example.parent.iterdir() if not p.name.startswith(".")}  # not: open just now
    others = shipped - {example.name, "project.yaml", "README.md"}
    assert {"project.yaml", "README.md"} <= shipped
    assert {Path(name).suffix for name in others} <= {".csv", ".nc"}
    readme = (example.parent / "README.md").read_text("utf-8")
    assert [name for name in others if name not in readme] == []


def test_the_measured_points_of_the_mill_give_back_the_lost_motion_they_were_made_with(
    checkout: Path, capsys
) -> None:
    example = checkout / "examples" / "mill-1394" / "MILL_1394.amp"
    points = example.parent / "laser-x.csv"
    line = [
        "calibrate",
        str(example),
        "--axis",
        "X",
        "--from",
        str(points),
        "--sign",
        "measured-target",
        "--dry-run",
    ]
    assert run([*line, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["figures"]["mean_reversal"] == pytest.approx(-0.0042, abs=0.0001)
    assert found["residual"]["after"] < 0.0005
    assert found["residual"]["before"] > 0.015


def test_the_press_runs_its_cam_without_a_fault(machine: Callable[[str], ParameterFile]) -> None:
    # Its points change the speed by 31 counts in a scan, below the 40 of R2057 (4-9).
    trace = simulate(machine("57c422b-label-press"), "cam", "Y")
    assert not trace.alarms
    assert trace.result["points"][0] == 32.0
