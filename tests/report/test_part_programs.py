"""The chapter of part programs: in each format, and only where they are given."""

import dataclasses
import json
import re
from pathlib import Path

import pytest

from amp_studio import dossier
from amp_studio.files import open_file
from amp_studio.programs import ProgramBlockError
from amp_studio.report import Contents, PrintedProgram, ProgramLimit

from .test_pdf import output_of, poppler

LIMITS = (
    ProgramLimit("B", "Rapid Speed", "speeds.rapid", 1.5, 0.75),
    ProgramLimit("A", "dwell", "", 0.5, 0.25),
)
FOUND = PrintedProgram(
    "plate.nc",
    21,
    2.0,
    LIMITS,
    "Contour error: at most 9 µm in line 3",
    ("Line 4: beyond X",),
    "",
    ("No load.",),
)
BARE = frozenset({"pictures", "motion", "power-up", "exchanges", "signatures"})


@pytest.fixture
def report(checkout: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Return what writes a report of a router in a format, with a program that is given."""
    monkeypatch.setattr(dossier, "programs_of", lambda _file, paths: iter([FOUND] if paths else ()))
    file = open_file(checkout / "examples" / "acromill-router" / "ROUTER.amp").file

    def written(ending: str, *programs: Path, **contents) -> str:
        path = tmp_path / f"report.{ending}"
        chapters = Contents(without=BARE, changed_only=True, programs=programs, **contents)
        dossier.write_report(file, path, chapters)
        return path.read_text("utf-8")

    return written


@pytest.mark.parametrize("ending", ["html", "txt"])
def test_the_chapter_is_there_where_a_program_is_given(report, ending: str) -> None:
    text = report(ending, Path("plate.nc"))
    for words in ("plate.nc", "21 blocks, 2 s", "at most 9 µm in line 3", "beyond X", "75.0", "speeds.rapid"):
        assert words in text
    assert "plate.nc" not in report(ending)


def test_a_german_chapter_has_its_limits_and_notes_in_german(report) -> None:
    text = " ".join(report("txt", Path("plate.nc"), language="de").split())
    assert "TEILEPROGRAMM plate.nc" in text
    assert "B 1,500 s 75,0 % Rapid Speed" in text
    assert "A 0,500 s 25,0 % Verweilzeit" in text
    assert "21 Sätze, 2 s" in text


def test_the_data_has_what_limits_each_program(report) -> None:
    found = json.loads(report("json", Path("plate.nc")))["part_programs"]
    assert [limit["share"] for limit in found[0]["limits"]] == [0.75, 0.25]
    assert json.loads(report("json"))["part_programs"] == []


def test_a_real_program_has_its_path_and_its_time(checkout: Path, tmp_path: Path) -> None:
    file = open_file(checkout / "examples" / "grblhal-router" / "GRBL_ROUTER.amp").file
    path = tmp_path / "a.nc"
    path.write_text("G21 G90\nG1 X-60 F600\n")
    (found,) = dossier.programs_of(file, [path])
    assert found.time_s > 6.0
    assert found.svg.startswith("<svg")
    assert sum(limit.share for limit in found.limits) == pytest.approx(1.0, abs=0.01)
    path.write_bytes(bytes(4))
    with pytest.raises(ProgramBlockError):
        list(dossier.programs_of(file, [path]))


def test_the_notes_of_a_program_are_in_the_unit_of_its_file(checkout: Path, tmp_path: Path) -> None:
    """They were in mm in a report of a file in inches, and some did not begin by what they are."""
    file = open_file(checkout / "examples" / "acromill-router" / "ROUTER.amp").file
    (tmp_path / "a.nc").write_text("G20 G90 G1 X-1 F60\nG2 X-3 I-1 J-0.5\n")
    (found,) = dossier.programs_of(file, [tmp_path / "a.nc"])
    assert all(note.startswith("ASSUMED: ") for note in found.assumptions)
    assert any("in/s2 for 1 V" in note for note in found.assumptions)
    assert not any(" mm" in note for note in (*found.assumptions, *found.alarms))


@poppler
def test_what_a_picture_leaves_no_room_for_is_on_the_next_page(
    checkout: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All notes of a program were printed over each other at the foot of the page of its path."""
    svg = '<svg xmlns="http://www.w3.org/2000/svg" width="640" height="900"><path d="M0 0H640V900H0Z"/></svg>'
    notes = tuple(f"Note{n} is one of many." for n in range(20))
    given = dataclasses.replace(FOUND, svg=svg, assumptions=notes)
    monkeypatch.setattr(dossier, "programs_of", lambda _file, _paths: iter([given]))
    file = open_file(checkout / "examples" / "acromill-router" / "ROUTER.amp").file
    contents = Contents(without=BARE, changed_only=True, programs=(Path("plate.nc"),))
    dossier.write_report(file, tmp_path / "r.pdf", contents)
    boxes = output_of("pdftotext", "-bbox", tmp_path / "r.pdf", "-")
    tops = [float(top) for top in re.findall(r'yMin="([0-9.]+)"[^>]*>Note[0-9]+<', boxes)]
    assert len(tops) == 20
    assert len(set(tops)) == 20


@poppler
def test_a_pdf_has_it_too(checkout: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dossier, "programs_of", lambda _file, _paths: iter([FOUND]))
    file = open_file(checkout / "examples" / "acromill-router" / "ROUTER.amp").file
    contents = Contents(without=BARE, changed_only=True, programs=(Path("plate.nc"),))
    dossier.write_report(file, tmp_path / "r.pdf", contents)
    text = output_of("pdftotext", "-layout", tmp_path / "r.pdf", "-")
    assert re.search(r"plate\.nc\n+.*What limits the feed", text)
    assert re.search(r"B +Rapid Speed", text)
