"""Documents in another language: every word of the frame, and nothing of the manual's."""

import re
import shutil
import subprocess
from collections.abc import Iterator
from html import unescape
from pathlib import Path
from typing import Any

import pytest

from amp_studio.files import ParameterFile, ProjectInfo, compare, new_file, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.files.notes import set_value_note
from amp_studio.guide import steps_of
from amp_studio.languages import language_codes
from amp_studio.report import SORTS, UNIT_CHOICES, Contents, print_report
from amp_studio.report.build import build_report
from amp_studio.report.contents import Sort
from amp_studio.report.drawings import drawings
from amp_studio.report.language import language_of
from amp_studio.report.model import MARKS
from amp_studio.report.papers.differences import differences_paper, machines_paper
from amp_studio.report.papers.form import form_paper
from amp_studio.report.papers.paper import write_paper
from amp_studio.report.templating.templates import TEMPLATES
from amp_studio.schema import Value, database_folder, family_ids, load_schema
from amp_studio.schema.yaml_reader import read_yaml
from amp_studio.validate.plausible import relations, steps
from tests.campaigns import CAMPAIGN, some

EXAMPLES = {
    "9pc": "mill-1394/MILL_1394",
    "num": "num-1060-mill/MILL_1060",
    "syntec": "syntec-mill/SYNTEC_MILL",
    "grblhal": "grblhal-router/GRBL_ROUTER",
    "57c422b": "57c422b-label-press/LABEL_PRESS",
    "acromill": "acromill-router/ROUTER",
}
GERMAN = language_of("de")
LITERAL = re.compile(r'\b_\("([^"]+)"\)')


@pytest.mark.parametrize("code", [code for code in language_codes() if code != "en"])
@pytest.mark.parametrize("template", sorted(path.name for path in TEMPLATES.iterdir()))
def test_a_language_has_every_phrase_of_a_template(code: str, template: str) -> None:
    phrases = set(LITERAL.findall((TEMPLATES / template).read_text("utf-8")))
    assert phrases - set(language_of(code).phrases) == set()


@pytest.mark.parametrize("family", family_ids())
def test_every_fact_of_the_cover_is_in_german(family: str) -> None:
    report = build_report(new_file(family), Contents(without=frozenset({"pictures"})))
    names = [name for name, _ in (*report.machine, *report.facts, *report.counts)]
    assert [name for name in names if name not in GERMAN.phrases] == []
    assert [
        text
        for text in (*MARKS.values(), *SORTS.values(), *UNIT_CHOICES.values())
        if text not in GERMAN.phrases
    ] == []


@pytest.mark.parametrize("family", some(EXAMPLES))
def test_steps_of_commissioning_and_drawings_are_in_german(family: str) -> None:
    words = language_of("de", family)
    steps = [step.title for step in steps_of(load_schema(family)) if step.title.isascii()]
    assert [step for step in steps if words.title(step) == step] in ([], ["DDA"])
    words = [
        unescape(word).strip()
        for figure in drawings(open_file(examples_folder() / f"{EXAMPLES[family]}.amp").file)
        for word in (*re.findall(r"<text[^>]*>([^<>]+)<", figure.svg), figure.title)
    ]
    assert len(words) > 20
    english = r"(over|from|drawn|speed|gain|allowed|Ramps|limits|Home|to|following)"
    names = "|".join(re.escape(p.name) for p in load_schema(family).parameters.values())
    left = [re.sub(names, "", GERMAN.title(word)) for word in words]
    assert [word for word in left if re.search(rf"\b{english}\b", word)] in ([], ["Soft limits"] * 3)


def texts_of_programs(facts: Any, key: str = "") -> Iterator[str]:
    """Yield the texts for a person about codes, words and whole programs."""
    if isinstance(facts, str) and key in {"meaning", "assumed", "cycles_taken_in", "name"}:
        yield " ".join(facts.split())
    for name, below in facts.items() if isinstance(facts, dict) else ():
        yield from texts_of_programs(below, name)
    for each in facts if isinstance(facts, list) else ():
        yield from texts_of_programs(each, key)


@pytest.mark.parametrize(
    "path", sorted(database_folder().glob("*/program.yaml")), ids=lambda p: p.parent.name
)
def test_the_words_of_a_family_for_programs_are_in_german(path: Path) -> None:
    words = language_of("de", path.parent.name)
    texts = sorted(set(texts_of_programs(read_yaml(path.read_text("utf-8"), references=True).data)))
    assert len(texts) > 10
    assert [text for text in texts if words.sentence(text) == text] == []


def test_the_point_in_the_number_of_a_page_stays() -> None:
    words = language_of("de", "syntec")
    assert words.sentence("No limit of the travel is active in the way of axis X (page 3.2)") == (
        "Auf dem Weg der Achse X ist keine Endlage aktiv (Seite 3.2)"
    )


def test_what_a_user_wrote_is_in_no_language(mill: ParameterFile) -> None:
    mill.header.name, mill.header.revision = "Values", "Date"
    set_value_note(mill, ("home.calibration", "1"), "Values")
    report = build_report(mill, Contents(language="de"), project=ProjectInfo("Values", "9pc", builder="none"))
    assert report.fact("Machine", "Values", GERMAN.text) == "Values"
    assert report.fact("Builder", "none", GERMAN.text) == "none"
    assert report.fact("Axes", "5 of 8 fitted", GERMAN.text) == "5 von 8 vorhanden"
    row = next(r for r in report.rows() if r.anchor == "home.calibration@1")
    assert row.small_print_in(GERMAN.text) == "Notiz: Values"


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


def test_a_comparison_and_a_form_in_german(tmp_path: Path, mill: ParameterFile) -> None:
    other = mill.copy()
    other.set(("home.calibration", "1"), Value(13.0, "mm"))
    found = compare(mill.schema, mill.values, other.values)
    papers = [
        differences_paper(mill, found, ("Values.amp", "b"), language="de"),
        machines_paper([mill, other], ["Values", "b"], language="de"),
        form_paper(mill, language="de"),
    ]
    for paper in papers:
        for ending in (".html", ".csv"):
            write_paper(paper, tmp_path / f"p{ending}")
        page = (tmp_path / "p.html").read_text("utf-8")
        assert '<html lang="de">' in page
        assert ("<span>Geprüft von</span>" in page) is bool(paper.signed)
        assert ("Erlaubt" if paper is papers[2] else "Gehört zu") in page
        assert not re.search(r">(Number|Belongs to|Differ|The same|Allowed)<|no bounds| to …", page)
        assert "Parameter" in (tmp_path / "p.csv").read_text("utf-8")
    assert "Values.amp" in papers[0].fact("A", "Values.amp")
    assert papers[1].fact("Differ", "1 value") == "1 Wert"


@pytest.mark.parametrize("sort", some(list(SORTS)[:: 1 if CAMPAIGN else 3], 2))
def test_a_german_report(tmp_path: Path, mill: ParameterFile, sort: Sort) -> None:
    print_report(mill, tmp_path / "r.html", Contents(sort, language="de"))
    page = (tmp_path / "r.html").read_text("utf-8")
    assert '<html lang="de">' in page
    assert "Unterschriften" in page
    assert "Set up by" not in page
    print_report(mill, tmp_path / "r.txt", Contents(sort, language="de"))
    plain = (tmp_path / "r.txt").read_text("utf-8")
    assert "UNTERSCHRIFTEN" in plain
    assert not re.search(r"\b(SIGNATURES|FINDINGS|NOT SET|FORCED|recommendations?|Suggested|fitted)\b", plain)
    assert max(map(len, plain.splitlines())) <= 100
    if sort == "axis" and shutil.which("pdftotext"):  # a page has the same words in every order
        print_report(mill, tmp_path / "r.pdf", Contents(sort, changed_only=True, language="de"))
        text = subprocess.run(
            ["pdftotext", tmp_path / "r.pdf", "-"], capture_output=True, text=True, check=True
        ).stdout
        assert "Freigegeben von" in text
        assert "Seite 2 von" in text
        assert not re.search(r"\b(Signatures|Contents|Findings|Belongs to)\b", text)


def test_what_experience_finds_and_why_is_german_in_a_german_report() -> None:
    """Sentences of the program about values that belong together, and their reasons."""
    german = language_of("de")
    one, two = "Homing Speed (X) is 5 mm/min", "Rapid (X) is 2 mm/min"
    found = [
        f"{one} and {two}; as a rule they are equal. Is it meant?",
        f"{one} beside {two} and {two}: the others rise by one factor. Is it meant?",
        f"{one} beside {two}: the others rise by one factor. Is it meant?",
        f"{one}, and {two}: beside it usual is 3 to 4 mm/min. Is it meant?",
        f"{one}, and {two}: it is faster than a rapid move. Is it meant?",
        f"{one}, and Rapid (X) is not set. Is it meant?",
        f"{one}: the only step of its table in that direction. Is it meant?",
    ]
    for sentence in map(german.message, found):
        assert " is " not in sentence
        assert sentence.endswith("Ist das so gewollt?")
    reasons = [getattr(relations, name) for name in vars(relations) if name.endswith("_REASON")]
    assert len(reasons) == 5
    assert [t for t in (*reasons, steps.REASON) if german.title(t) == t] == []
