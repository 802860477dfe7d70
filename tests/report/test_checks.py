"""The chapter of what check finds in motion: in each format, and only where it is asked for."""

import json
from pathlib import Path

import pytest
from openpyxl import load_workbook

from amp_studio import dossier
from amp_studio.files import open_file
from amp_studio.report import CheckedFigure, CheckedMotion, Contents

FOUND = (
    CheckedMotion("good", "home", "X", (CheckedFigure("home position", 0.5, "mm", "0.5 mm"),), ""),
    CheckedMotion("bad", "velocity", "Y", (), "The phase margin is 26 deg, below 30", (("1", "Hard limit"),)),
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
        return path.read_text("utf-8", errors="replace")

    return written


@pytest.mark.parametrize("ending", ["html", "txt"])
def test_the_chapter_is_there_where_it_is_asked_for(report, ending: str) -> None:
    text = report(ending, check=True)
    assert "check in motion" in text.lower()
    assert "home position 0.5 mm" in text.replace("\u00a0", " ")
    assert "The phase margin is 26 deg, below 30; 1: Hard limit" in " ".join(text.split())
    assert "check in motion" not in report(ending).lower()


def test_a_german_report_has_its_checks_in_german(report) -> None:
    text = " ".join(report("txt", check=True, language="de").split())
    assert "PRÜFUNG IN BEWEGUNG" in text
    assert "gut Referenzfahrt X Referenzposition 0,5 mm" in text
    assert "schlecht Geschwindigkeit Y Phasenreserve: 26°, unter 30; 1: Hardwareendschalter" in text


def test_a_german_workbook_has_german_heads(report, tmp_path: Path) -> None:
    report("xlsx", check=True, language="de")
    sheet = load_workbook(tmp_path / "report.xlsx")["Prüfung in Bewegung"]
    rows = [[cell.value for cell in row] for row in sheet.rows]
    assert rows[0] == ["Urteil", "Szenario", "Achse", "Kennwert", "Wert", "Einheit", "Warum"]
    assert rows[1][:6] == ["gut", "Referenzfahrt", "X", "Referenzposition", 0.5, "mm"]


def test_the_data_has_each_check(report) -> None:
    found = json.loads(report("json", check=True))["checks"]
    assert [each["verdict"] for each in found] == ["good", "bad"]
    assert found[0]["figures"] == [{"name": "home position", "value": 0.5, "unit": "mm"}]
    assert json.loads(report("json"))["checks"] == []


def test_a_real_file_is_checked_in_every_scenario(checkout: Path) -> None:
    file = open_file(checkout / "examples" / "grblhal-router" / "GRBL_ROUTER.amp").file
    found = list(dossier.checks_of(file))
    assert {each.scenario for each in found} >= {"step", "home", "travel"}
    assert all(each.figures for each in found if each.verdict == "good")
