"""The verb check and `validate --motion`: every scenario that a file allows, as one list."""

import json
import shutil
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.sim.scenarios import SCENARIOS

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture
def router(tmp_path: Path) -> Path:
    """Return a copy of the router with stepper motors, the cheapest machine to move."""
    return Path(shutil.copy(EXAMPLES / "grblhal-router" / "GRBL_ROUTER.amp", tmp_path))


def test_every_scenario_of_every_axis_has_a_verdict_in_validate_too(
    router: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["validate", str(router), "--motion", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["motion"]
    asked = {(check["scenario"], check["axis"]) for check in found["checks"]}
    of_axes = ("step", "home", "jog", "travel", "probe")
    assert asked == {(scenario, axis) for scenario in of_axes for axis in "XYZ"} | {("spindle", "")}
    assert (found["good"], found["doubtful"], found["bad"]) == (16, 0, 0)
    home = next(check for check in found["checks"] if check["scenario"] == "home")
    assert home["figures"]["home_position"] == {"value": -787.0, "unit": "mm"}
    assert any("ASSUMED" in note for note in home["assumptions"])


def test_a_machine_that_does_not_home_is_bad_and_exits_with_1(
    router: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("amp_studio.sim.motion_check.SCENARIOS", {"home": SCENARIOS["home"]})
    mill = Path(shutil.copy(EXAMPLES / "syntec-mill" / "SYNTEC_MILL.amp", router.parent))
    assert run(["set", str(mill), "Pr901=1"]) == 0
    capsys.readouterr()
    assert run(["check", str(mill), "--axis", "1", "--json"]) == 1
    bad = [check for check in json.loads(capsys.readouterr().out)["checks"] if check["verdict"] == "bad"]
    assert [(check["scenario"], check["alarms"][0]["code"]) for check in bad] == [("home", "MOT-030")]


def test_what_cannot_be_run_is_not_possible_and_gives_the_parameter(
    router: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["set", str(router), "$22=0", "$20=0"]) == 0
    capsys.readouterr()
    assert run(["check", str(router), "--axis", "X", "--json"]) == 0
    home = next(c for c in json.loads(capsys.readouterr().out)["checks"] if c["scenario"] == "home")
    assert (home["verdict"], home["params"]) == ("not possible", ["$22"])


@pytest.mark.parametrize("ending", [".html", ".pdf"])
def test_a_check_is_written_as_a_paper(router: Path, ending: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("amp_studio.sim.motion_check.SCENARIOS", {"home": SCENARIOS["home"]})
    paper = router.with_suffix(ending)
    assert run(["check", str(router), "--axis", "X", "-o", str(paper), "--language", "de"]) == 0
    if ending == ".pdf":
        assert paper.read_bytes().startswith(b"%PDF")
    else:
        page = paper.read_text("utf-8")
        assert 'lang="de"' in page
        assert "Prüfung in Bewegung" in page
        assert "Referenzposition −787\u00a0mm" in page


def test_another_ending_is_refused_before_anything_runs(
    router: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["check", str(router), "-o", "motion.xyz"]) == 2
    assert ".pdf or .html" in capsys.readouterr().err


def test_validate_adds_the_motion_in_words(router: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["set", str(router), "$22=0", "$20=0"]) == 0  # neither homing nor limits: the least motion
    assert run(["validate", str(router), "--motion"]) == 1, "what depends on homing is wrong now"
    assert "10 good, 0 doubtful, 0 bad" in capsys.readouterr().out
    assert run(["validate", str(router), "--motion", "--format", "sarif"]) == 2


def test_what_is_not_good_has_the_numbers_and_names_to_look_at(
    router: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("amp_studio.sim.motion_check.SCENARIOS", {"home": SCENARIOS["home"]})
    mill = Path(shutil.copy(EXAMPLES / "mill-1394" / "MILL_1394.amp", router.parent))
    assert run(["set", str(mill), "1010=minus"]) == 0
    assert run(["check", str(mill), "--axis", "X"]) == 0
    assert "1010 G28 Direction to Home, 1011 G28 Home Speed" in capsys.readouterr().out
