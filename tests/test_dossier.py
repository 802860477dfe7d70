"""The documentation with what the simulator and the record of exchanges add to it."""

import shutil
import subprocess
from dataclasses import replace
from datetime import UTC, datetime
from itertools import islice
from pathlib import Path

import pytest

from amp_studio.dossier import exchanges_of, motion_apart, motion_figures, write_report
from amp_studio.files import open_file
from amp_studio.report import CHAPTERS, Contents
from amp_studio.transfer.client.record import add_exchange, exchange_now

EXAMPLES = Path(__file__).parents[1] / "examples"
MILL = EXAMPLES / "mill-1394" / "MILL_1394.amp"


@pytest.fixture
def mill(tmp_path: Path) -> Path:
    return Path(shutil.copy(MILL, tmp_path / "mill.amp"))


def test_each_axis_has_its_responses_and_what_they_assume_is_shown_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("amp_studio.sim.scenarios.frequency.POINTS", 2)
    lathe = EXAMPLES / "lathe-ls176" / "LATHE_LS176.amp"  # it has the fewest axes
    figures = tuple(motion_figures(open_file(lathe).file))
    assert [f.title for f in figures[:2]] == ["Step, axis 1 (X)", "Frequency, axis 1 (X)"]
    assert figures[-1].title == "What was assumed"
    assert len(set(figures[-1].notes)) == len(figures[-1].notes) > 0
    assert all(f.svg.startswith("<svg") for f in figures if not f.notes)


def test_an_axis_without_a_servo_loop_shows_its_steps_and_no_frequency_response() -> None:
    file = open_file(EXAMPLES / "grblhal-router" / "GRBL_ROUTER.amp").file
    figures = tuple(motion_figures(file))
    assert motion_apart(file) == figures
    assert [f.title for f in figures] == [*(f"Step, axis {axis}" for axis in "XYZ"), "What was assumed"]


def test_a_format_gets_of_the_motion_what_it_prints() -> None:
    file = open_file(EXAMPLES / "grblhal-router" / "GRBL_ROUTER.amp").file
    whole = tuple(motion_figures(file))
    page, data = tuple(motion_figures(file, data=False)), tuple(motion_figures(file, drawings=False))
    assert all(figure.svg and figure.run for figure in whole[:-1])
    assert [replace(figure, run=None) for figure in whole] == list(page)
    assert [replace(figure, svg="") for figure in whole] == list(data)


def test_exchanges_are_in_every_kind_of_document(mill: Path, tmp_path: Path) -> None:
    add_exchange(
        mill,
        exchange_now(
            "download", mill, "9pc", "tcp://10.0.0.1:9600", after="ab" * 32, state="new", text="9 values sent"
        ),
    )
    assert [(e.verb, e.control, e.after, e.text) for e in exchanges_of(mill)] == [
        ("download", "tcp://10.0.0.1:9600", "abababababab", "9 values sent")
    ]
    for ending in (".html", ".txt"):
        out = tmp_path / f"r{ending}"
        write_report(open_file(mill).file, out, Contents(without=frozenset({"motion"})), source=mill)
        assert "9 values sent" in out.read_text("utf-8")
        write_report(open_file(mill).file, out, Contents(without=frozenset(CHAPTERS)), source=mill)
        assert "9 values sent" not in out.read_text("utf-8")
        assert "Released by" not in out.read_text("utf-8")


@pytest.mark.skipif(shutil.which("pdftotext") is None, reason="needs poppler's tools")
def test_the_contents_have_the_page_of_each_chapter(
    mill: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("amp_studio.dossier._SCENARIOS", ("step",))
    out, contents = tmp_path / "r.pdf", Contents(changed_only=True)
    write_report(
        open_file(mill).file,
        out,
        contents,
        source=mill,
        date=datetime(2026, 7, 1, tzinfo=UTC),
        motion=lambda file: islice(motion_figures(file), 1),
    )
    done = subprocess.run(["pdftotext", "-layout", out, "-"], capture_output=True, text=True, check=True)
    pages = done.stdout.split("\f")
    first = next(n for n, page in enumerate(pages) if "Marks" in page)
    contents = "\n".join(pages[1:first])
    reported = dict(
        line.strip().rsplit(None, 1)
        for line in contents.splitlines()
        if line.strip() and line.split()[-1].isdigit()
    )
    reported = {title: number for title, number in reported.items() if not title.startswith("AMP Studio")}
    assert {"Machine", "Findings", "Pictures", "Home Parameters", "Motion, simulated", "Signatures"} <= set(
        reported
    )
    for title, number in reported.items():
        assert title in " ".join(pages[int(number) - 1].split()), (title, number)
