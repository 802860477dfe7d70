"""The chapter of what check finds in motion: in each format, and only where it is asked for."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from amp_studio import dossier
from amp_studio.files import open_file
from amp_studio.report import CheckedMotion, Contents

FOUND = (
    CheckedMotion("good", "home", "X", "home position 0 mm", ""),
    CheckedMotion("bad", "travel", "Y", "overrun 3 mm", "The axis does not come to rest behind the limit"),
)
BARE = frozenset({"pictures", "motion", "power-up", "exchanges", "signatures"})


@pytest.fixture
def report(checkout: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Return what writes a report of a router in a format, with two checks that are given."""
    monkeypatch.setattr(dossier, "checks_of", lambda _file: iter(FOUND))
    file = open_file(checkout / "examples" / "grblhal-router" / "GRBL_ROUTER.amp").file

    def written(ending: str, **contents) -> str:
        path = tmp_path / f"report.{ending}"
        dossier.write_report(file, path, Contents(without=BARE, changed_only=True, **contents))
        return path.read_text("utf-8")

    return written


@pytest.mark.parametrize("ending", ["html", "txt"])
def test_the_chapter_is_there_where_it_is_asked_for(report, ending: str) -> None:
    text = report(ending, check=True)
    assert "check in motion" in text.lower()
    assert "home position 0 mm" in text
    assert "does not come to rest behind the limit" in " ".join(text.split())
    assert "check in motion" not in report(ending).lower()


def test_a_german_report_has_its_verdicts_in_german(report) -> None:
    text = report("html", check=True, language="de")
    assert "Prüfung in Bewegung" in text
    assert "schlecht" in text


def test_the_data_has_each_check(report) -> None:
    found = json.loads(report("json", check=True))["checks"]
    assert [each["verdict"] for each in found] == ["good", "bad"]
    assert json.loads(report("json"))["checks"] == []


def test_a_real_file_is_checked_in_every_scenario(checkout: Path) -> None:
    file = open_file(checkout / "examples" / "grblhal-router" / "GRBL_ROUTER.amp").file
    found = list(dossier.checks_of(file))
    assert {each.scenario for each in found} >= {"step", "home", "travel"}
    assert all(each.figures for each in found if each.verdict == "good")
