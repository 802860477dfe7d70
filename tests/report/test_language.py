"""Documents in another language: every word of the frame, and nothing of the manual's."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, new_file
from amp_studio.report import SORTS, UNIT_CHOICES, Contents, Sort, build_report, write_report
from amp_studio.report.language import language_codes, language_of
from amp_studio.report.model import MARKS
from amp_studio.report.templating import TEMPLATES
from amp_studio.schema import family_ids, load_schema

GERMAN = language_of("de")
LITERAL = re.compile(r'\b_\("([^"]+)"\)')


@pytest.mark.parametrize("code", [code for code in language_codes() if code != "en"])
@pytest.mark.parametrize("template", ["report.typ.j2", "report.html.j2"])
def test_a_language_has_every_phrase_of_a_template(code: str, template: str) -> None:
    phrases = set(LITERAL.findall((TEMPLATES / template).read_text("utf-8")))
    assert len(phrases) > 30
    assert phrases - set(language_of(code).phrases) == set()


@pytest.mark.parametrize("family", family_ids())
def test_every_fact_of_the_cover_is_in_german(family: str) -> None:
    report = build_report(new_file(family))
    names = [name for name, _ in (*report.machine, *report.facts, *report.counts)]
    assert [name for name in names if name not in GERMAN.phrases] == []
    assert [
        text
        for text in (*MARKS.values(), *SORTS.values(), *UNIT_CHOICES.values())
        if text not in GERMAN.phrases
    ] == []


def test_phrases_with_a_part_that_changes() -> None:
    assert GERMAN.text("5 of 8 fitted") == "5 von 8 vorhanden"
    assert GERMAN.text("Axis X (1 linear)") == "Achse X (1 linear)"
    assert GERMAN.text("2 errors, 1 warning") == "2 Fehler, 1 Warnung"
    assert GERMAN.counted(2, "advice") == "2 Empfehlungen"
    assert GERMAN.text("Home Calibration") == "Home Calibration", "a name is that of the manual"
    assert GERMAN.title("Home Calibration") == "Referenzpunktverschiebung", "the title of a page is ours"
    with pytest.raises(ValueError, match="Unknown language 'fr'"):
        language_of("fr")


@pytest.mark.parametrize("family", family_ids())
def test_a_group_keeps_the_name_that_the_manual_prints(family: str) -> None:
    names = [g.section or g.name for g in load_schema(family).groups]
    assert [name for name in names if GERMAN.text(name) != name and name not in GERMAN.phrases] == []


@pytest.mark.parametrize("sort", SORTS)
def test_a_german_report(tmp_path: Path, mill: ParameterFile, sort: Sort) -> None:
    for ending in (".html", ".pdf"):
        write_report(mill, tmp_path / f"r{ending}", Contents(sort, language="de"))
    page = (tmp_path / "r.html").read_text("utf-8")
    assert '<html lang="de">' in page
    assert "Unterschriften" in page
    assert "Set up by" not in page
    if shutil.which("pdftotext"):
        text = subprocess.run(
            ["pdftotext", tmp_path / "r.pdf", "-"], capture_output=True, text=True, check=True
        ).stdout
        assert "Freigegeben von" in text
        assert "Seite 2 von" in text
        assert not re.search(r"\b(Signatures|Contents|Findings|Belongs to)\b", text)
