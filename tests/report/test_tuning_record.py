"""The tuning record: kept beside the file, only ever added to, and a chapter of the report in each format."""

import json
import re
import subprocess
from dataclasses import replace
from pathlib import Path
from shutil import copy, which

import pytest
from jsonschema import Draft7Validator

from amp_studio import cli, dossier
from amp_studio.files import SaveError, atomic, check_output, open_file
from amp_studio.report import Contents
from amp_studio.sim import add_tuning, read_tunings, recorded_tuning, simulate

BARE = frozenset({"pictures", "motion", "power-up", "exchanges", "signatures"})


@pytest.fixture
def press(checkout: Path, tmp_path: Path) -> Path:
    """Return a file of a 57C422B in a folder of its project."""
    place = tmp_path / "LABEL_PRESS.amp"
    copy(checkout / "examples" / "57c422b-label-press" / "LABEL_PRESS.amp", place)
    return place


@pytest.fixture
def tuned(press: Path) -> Path:
    """Return it with a tuning of X in its record, of which the first gain was applied."""
    given = ["--keep", "warm machine", "--set", "model.delay=2 ms", "--for", "quiet"]
    assert cli.run(["simulate", str(press), "tune", "--axis", "X", *given]) == 0
    (entry,) = read_tunings(press)
    number, _, _, after = entry.gains[0]
    assert cli.run(["set", str(press), f"{number}={after}"]) == 0
    return press


def written(path: Path, ending: str, **contents: object) -> Path:
    made = path.with_name(f"report.{ending}")
    dossier.write_report(
        open_file(path).file, made, Contents(without=BARE, changed_only=True, **contents), source=path
    )
    return made


def test_a_tuning_records_gains_loop_machine_and_user(tuned: Path) -> None:
    (entry,) = read_tunings(tuned)
    assert (entry.file, entry.aim, entry.note) == ("LABEL_PRESS.amp", "quiet", "warm machine")
    assert entry.who
    assert {name for name, *_ in entry.figures} >= {"Ms", "phase_margin", "gain_margin", "stiffness"}
    assert ("model.delay", "2 ms", "--set") in entry.plant
    assert any(how.startswith("assumed: ") for _, _, how in entry.plant)


def test_the_chapter_compares_gains_with_the_file(tuned: Path, checkout: Path) -> None:
    schema = json.loads((checkout / "docs/report.schema.json").read_text("utf-8"))
    data = json.loads(written(tuned, "json").read_text("utf-8"))
    Draft7Validator(schema).validate(data)
    (entry,) = data["tunings"]
    assert entry["gains"][0]["in_file"] is True
    assert not all(gain["in_file"] for gain in entry["gains"])
    for ending in ("html", "txt"):
        text = written(tuned, ending).read_text("utf-8")
        assert "warm machine" in text
        assert "another in the file" in text
    assert "ABSTIMMPROTOKOLL" in written(tuned, "txt", language="de").read_text("utf-8")


@pytest.mark.skipif(not which("pdftotext"), reason="there is no pdftotext")
def test_a_pdf_has_the_chapter(tuned: Path) -> None:
    text = subprocess.run(
        ["pdftotext", "-layout", written(tuned, "pdf"), "-"], capture_output=True, text=True, check=True
    ).stdout
    assert "Tuning record" in text
    assert "Aim: quiet" in text
    assert "warm machine" in text


def test_the_chapter_can_be_left_out(tuned: Path) -> None:
    made = tuned.with_name("without.txt")
    dossier.write_report(open_file(tuned).file, made, Contents(without=BARE | {"tuning"}), source=tuned)
    assert "TUNING RECORD" not in made.read_text("utf-8")


def test_foreign_lines_of_a_record_stay(tuned: Path) -> None:
    record = tuned.with_name("tunings.jsonl")
    foreign = '{"when": "yesterday"}\nnot a line of JSON\n{"gains": [[1]], "figures": [[true, "x", 1, 2]]}'
    record.write_text(record.read_text("utf-8") + foreign, "utf-8")  # and it is cut off
    file = open_file(tuned).file
    add_tuning(tuned, recorded_tuning(file, tuned, simulate(file, "tune", "X"), "normal"))
    assert [entry.aim for entry in read_tunings(tuned)] == ["quiet", "normal"]
    assert foreign in record.read_text("utf-8")


def test_keep_belongs_to_tune_and_no_output_replaces_the_record(
    tuned: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.run(["simulate", str(tuned), "step", "--keep", "x"]) == 2
    assert "--keep belongs to tune" in capsys.readouterr().err
    record = tuned.with_name("tunings.jsonl")
    before = record.read_text("utf-8")
    with pytest.raises(SaveError):
        check_output(record, tuned)
    assert record.read_text("utf-8") == before


@pytest.mark.skipif(which("pdftotext") is None, reason="poppler is not installed")
def test_a_full_disk_leaves_the_figures_and_names_the_record(
    tuned: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Nothing was printed but "the results cannot be written"."""

    def full(_handle: int, _content: bytes) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(atomic, "write_all", full)
    assert cli.run(["simulate", str(tuned), "tune", "--keep", "x"]) == 2
    printed = capsys.readouterr()
    assert "tune, axis X" in printed.out
    why = "the tuning could not be recorded in tunings.jsonl: No space left on device"
    assert printed.err == f"amp-studio: {why}\n"


def test_a_german_chapter_is_german_and_a_note_ends_before_the_next_tuning(tuned: Path) -> None:
    """The note ran into ``== Achse Y``; reasons, units and decimal signs of the record were English."""
    add_tuning(tuned, replace(read_tunings(tuned)[0], axis="Y", note="kalt"))
    made = written(tuned, "pdf", language="de")
    printed = subprocess.run(["pdftotext", "-layout", made, "-"], capture_output=True, text=True, check=True)
    chapter = printed.stdout[printed.stdout.rindex("Abstimmprotokoll") :]
    assert "==" not in chapter
    assert [line.strip() for line in chapter.splitlines() if "warm machine" in line] == ["warm machine"]
    assert "angenommen: " in chapter
    assert not re.search(r"assumed|[0-9] deg\b|(?<![0-9A-Z-])[0-9]+\.[0-9]+ (?:V|ms|%|counts)", chapter)
