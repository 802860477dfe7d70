"""German papers word by word: no English word of the program in a report with motion, checks and programs, in
check list, sheet, form and differences; what the control shows stays as it is.
"""

import html
import re
from collections.abc import Iterator
from datetime import UTC, datetime
from io import BytesIO

import pytest
from openpyxl import load_workbook

from amp_studio.dossier import checks_of, machine_tests_of, motion_figures, programs_of
from amp_studio.drawing.svg import measured
from amp_studio.files import ParameterFile, compare, new_file, open_file
from amp_studio.guide import progress
from amp_studio.report import Additions, Contents
from amp_studio.report.build import build_report
from amp_studio.report.chapters import CheckedFigure, CheckedMotion
from amp_studio.report.drawings import drawings
from amp_studio.report.language import language_of
from amp_studio.report.output.everything import render_workbook
from amp_studio.report.output.page import render_html
from amp_studio.report.output.text import render_text
from amp_studio.report.papers.check_list import build_check_list, render_check_list_text
from amp_studio.report.papers.differences import differences_paper
from amp_studio.report.papers.form import form_paper
from amp_studio.report.papers.paper import Paper
from amp_studio.report.papers.sheet import PrintedSheet, text_lines
from amp_studio.scenarios import IDENTIFY, scenario_names
from amp_studio.schema import fact_texts
from amp_studio.sheet import make_sheet
from amp_studio.sim import law_of
from amp_studio.sim.law import simulated_families
from amp_studio.sim.scenarios import SCENARIOS
from amp_studio.validate import Finding, Validator
from tests.campaigns import some
from tests.report.test_german import EXAMPLES

DATE = datetime(2026, 11, 29, tzinfo=UTC)
BOTH = {"was", "rad", "minus", "linear", "motor", "proportional", "docs", "steps"}
"""Words of both languages, a folder, and the name of a unit."""
QUOTED = ("stop motion", "rated torque", "--zero", "exceed limit", "ferror")
"""A command, a name as a manual writes it inside a sentence, an option, a message and a key of LinuxCNC."""
_WORD = re.compile(r"(?<![\w.~/@])[a-z]{3,}(?![\w./=])")
_TEXT = re.compile(r">([^<>]*[a-z][^<>]*)<")
GERMAN = [n for n in EXAMPLES if fact_texts(open_file(EXAMPLES[n]).file.schema.family.family, "de").messages]


def words_of_the_control(file: ParameterFile) -> list[str]:
    """Return names, choices, groups and values that a paper prints as the control shows them."""
    family, parameters = file.schema.family, file.schema.parameters.values()
    words = {family.name, *(machine.name for machine in family.machines)}
    words |= {name for group in file.schema.groups for name in (group.name, group.section)}
    words |= {p.name for p in parameters}
    words |= {choice.label for p in parameters for choice in p.choices or ()}
    words |= {str(v.value) for v in file.values.values() if v is not None and isinstance(v.value, str)}
    words |= {file.machine_schema.instance_label(address) for address in file.values} | {"yes"}
    return sorted((word for word in words if len(word) > 2), key=len, reverse=True)


def printed(file: ParameterFile, name: str, language: str) -> Iterator[str]:
    """Yield the texts of a whole report and of its drawings."""
    contents = Contents(language=language, inactive=True)
    programs = tuple(programs_of(file, tuple(EXAMPLES[name].parent.glob("*.nc"))))
    added = Additions(tuple(motion_figures(file)), checks=tuple(checks_of(file)), programs=programs)
    report = build_report(file, contents, added=added)
    page = re.sub(r"<(script|style|code)\b.*?</\1>", "", render_html(report).decode(), flags=re.DOTALL)
    drawn = language_of(language, file.schema.family.family).drawing
    figures = (*report.motion, *report.pictures, *report.program_figures, *report.check_figures)
    drawings = [drawn(figure.svg) for figure in figures]
    for text in (page, *drawings):
        yield from (html.unescape(" ".join(found.split())) for found in _TEXT.findall(text))


def english_words(german: set[str], english: set[str], own: list[str]) -> list[str]:
    """Return the German texts with a word that the English ones have too, beside those of the control."""
    vocabulary = {word for text in english for word in _WORD.findall(text)} - BOTH
    known = re.compile("|".join(map(re.escape, (*QUOTED, *own))))
    texts = [text for text in german if not text.startswith(": ")]  # a word of bits: labels
    return [text for text in texts if vocabulary & set(_WORD.findall(known.sub("", text)))]


@pytest.mark.parametrize("name", some(GERMAN))
def test_a_report_with_all_chapters_has_no_english_word(name: str) -> None:
    file = open_file(EXAMPLES[name]).file
    german, english = (set(printed(file, name, language)) for language in ("de", "en"))
    assert len(german) > 100
    assert english_words(german, english, words_of_the_control(file)) == []


def test_axes_of_one_letter_and_figures_of_a_manual_are_german() -> None:
    words = language_of("de", "57c422b")
    assert words.text("X, S (axis 7), S (axis 8)") == "X, S (Achse 7), S (Achse 8)"
    assert words.title("Ramps S (axis 12)") == "Rampen S (Achse 12)"
    assert words.label("Gearing Mode (figure 4.28)") == "Gearing Mode (Bild 4.28)"


def paper_texts(paper: Paper) -> str:
    return "\n".join(
        paper.cell(table, row, column)
        for table in paper.tables
        for row, cells in enumerate(table.rows)
        for column in range(len(cells))
    )


def test_the_tests_of_a_check_list_are_german() -> None:
    file = open_file(EXAMPLES["num-1060-mill"]).file
    come = progress(Validator(file), ())
    checks = build_check_list(file, come, date=DATE, language="de", tests=machine_tests_of(file, "0"))
    text = render_check_list_text(checks).decode()
    assert "X: Messung vor der Lageregelung (Seite 5-25)" in text
    assert "(Seite 7-17 bis 7-19)" in text
    assert not re.search(r"\b(the|axis|and|with)\b", text.partition("PRÜFUNGEN AN DER MASCHINE")[2])


@pytest.mark.parametrize("name", some(GERMAN))
def test_the_notes_of_the_tests_at_the_machine_are_german(name: str) -> None:
    file = open_file(EXAMPLES[name]).file
    words = language_of("de", file.schema.family.family)
    notes = [words.sentence(note) for test in machine_tests_of(file) for note in test.notes]
    assert [note for note in notes if re.search(r"\b(the|it|from|within|and|with)\b", note)] == []


def test_a_sheet_has_german_places_units_and_remarks() -> None:
    wanted = open_file(EXAMPLES["57c422b-label-press"]).file
    sheet = make_sheet(
        wanted, new_file("57c422b"), of="A.amp", against="B.amp", message=language_of("de", "57c422b").cited
    )
    lines = "\n".join(text_lines(PrintedSheet(sheet, language="de", date=DATE)))
    assert "Encoder Setup, Achse X" in lines
    assert "1600 Ink/s, gerundet" in lines
    assert "counts" not in lines


@pytest.mark.parametrize(
    ("english", "german"),
    [
        (
            "1 value to key in; 3 are the same already.",
            "1 Wert einzugeben, davon erledigt: 0; 3 sind schon gleich.",
        ),
        (
            "2 values to key in, 1 done; 3 are the same already.",
            "2 Werte einzugeben, davon erledigt: 1; 3 sind schon gleich.",
        ),
    ],
)
def test_one_value_is_no_values(english: str, german: str) -> None:
    """It was ``1 Werte einzugeben``."""
    assert language_of("de").sentence(english) == german


def test_a_picture_has_the_units_of_the_language() -> None:
    """``0.08 V/count`` and ``100 in/min`` were as in English."""
    file = open_file(EXAMPLES["acromill-router"]).file
    printed = " ".join(figure.svg for figure in drawings(file, language_of("de", "acromill")))
    assert "V/Ink" in printed
    assert re.findall(r"\d (?:V/count|in/min|in|counts)\b", printed) == []


def test_differences_in_german_say_what_is_not_set_and_keep_the_controls_words() -> None:
    mill, bare = open_file(EXAMPLES["mill-1394"]).file, new_file("9pc", "mill")
    comparison = compare(mill.schema, mill.values, bare.values)
    texts = paper_texts(differences_paper(mill, comparison, ("A", "B"), language="de"))
    assert "\nnicht gesetzt\n" in texts
    assert "not set" not in texts
    assert "3.4 inch and 4.3 metric" in texts
    assert "\n0,5 mm\n" in texts


def test_a_form_keeps_the_points_of_labels() -> None:
    texts = paper_texts(form_paper(new_file("57c422b"), language="de"))
    assert "Ohne\u00a0Namen\u00a0(Bild\u00a04.1)" in texts.replace(" ", "\u00a0")
    assert "4,1" not in texts
    assert "3.4 inch and 4.3 metric" in paper_texts(form_paper(new_file("9pc", "mill"), language="de"))


@pytest.mark.parametrize("name", ["acromill-router", "grblhal-router"])
def test_a_group_has_the_name_that_the_control_shows(name: str) -> None:
    file = open_file(EXAMPLES[name]).file
    report = build_report(file, Contents(language="de", without=frozenset({"pictures"})))
    assert {section.title for section in report.sections} <= {g.name for g in file.schema.groups}
    by_axis = build_report(file, Contents(language="de", sort="axis", without=frozenset({"pictures"})))
    assert "Parameter ohne Achse" in {section.title for section in by_axis.sections}


def test_places_in_a_list_are_german_each() -> None:
    file = open_file(EXAMPLES["num-1060-mill"]).file
    text = render_text(build_report(file, Contents(language="de"))).decode()
    assert "X, Y, Z, B, Achse 24, 28 0x00" in text.replace("\n ", "")
    assert "Axis 24," not in text


def test_signs_units_and_powers_are_german() -> None:
    sentence = language_of("de", "57c422b").sentence
    german = {
        "position (counts)": "Position (Ink)",
        "phase (°)": "Phase (°)",
        "frequency, Hz": "Frequenz, Hz",
        "X, in": "X, Zoll",
        "contour error (in)": "Bahnfehler (Zoll)",
        "above the plot: excess error 11 mm, feedrate suppression 11.5 mm": (
            "über dem Bild: Schleppfehlergrenze 11 mm, Vorschubabsenkung 11,5 mm"
        ),
        "above the plot: ferror 1 mm, min_ferror 0.1 mm": "über dem Bild: ferror 1 mm, min_ferror 0,1 mm",
        "1.5e-06 V·s/count": "1,5e-06 V·s/Ink",
        "7.4 counts/V": "7,4 Ink/V",
    }
    assert {text: sentence(text) for text in german} == german


def test_the_names_of_curves_have_room_in_german() -> None:
    """A plot is laid out in English, with 30 % more room for another language."""
    sentence = language_of("de").sentence
    names = [f"{loop} loop, {kind}" for loop in ("closed", "open") for kind in ("model", "swept")]
    names += ["gain (dB)", "phase (°)", "command", "actual", "before"]
    wide = {text: measured(sentence(text), False) / measured(text, False) for text in names}
    assert {text: share for text, share in wide.items() if share > 1.3} == {}


def test_the_figures_of_motions_have_german_names() -> None:
    sentence = language_of("de").sentence
    figures = (
        "step rate",
        "increments per sample",
        "pulses per interpolation time",
        "time constant following error",
    )
    assert [name for name in figures if sentence(name) == name] == []
    assert sentence("phase margin p5") == "Phasenreserve, 5. Perzentil"
    assert (
        sentence(
            "With the other gains as they are none is safe: here servo.a_gain is 92.5, "
            "servo.b_gain is 3, as tune recommends."
        ).count(" ist ")
        == 3
    )


def test_a_sheet_keeps_the_name_of_a_parameter_that_is_a_word_of_the_program_too() -> None:
    wanted = open_file(EXAMPLES["linuxcnc-mill"]).file
    sheet = make_sheet(wanted, new_file("linuxcnc"))
    lines = [*text_lines(PrintedSheet(sheet, language="de", date=DATE))]
    assert any("Axes (" in line for line in lines), "[TRAJ]COORDINATES"
    assert not any("Achsen (" in line for line in lines)


@pytest.mark.parametrize("family", simulated_families())
def test_a_scenario_and_its_settings_have_german(family: str) -> None:
    german, law = language_of("de", family), law_of(family)
    scenarios = [*(SCENARIOS[name] for name in law.motion.scenarios), *law.own().values()]
    english = [text for each in scenarios for text in (each.title, *each.settings.values())]
    assert [text for text in english if german.sentence(text) == text] == []


@pytest.mark.parametrize("name", [*scenario_names(), IDENTIFY])
def test_the_title_of_a_picture_names_its_scenario_in_german(name: str) -> None:
    german = language_of("de", "9pc")
    named = german.scenario(name)
    assert named.lower() != name
    assert (
        german.sentence(f"{name.capitalize()}, axis 1 (X)") == f"{named[0].upper()}{named[1:]}, Achse 1 (X)"
    )


@pytest.mark.parametrize(
    "words",
    [
        "radius error 3 µm",
        "reversal spike 3 µm",
        "home position 3 mm",
        "dry friction 3 %",
        "gravity 3 %",
        "after 3 s",
        "measured less predicted, where used (%)",
        "radius deviation (µm)",
        "sensitivity (dB)",
        "way of the load per torque (mm/%)",
        "axis less spindle (mm)",
        "machine less simulation (mm)",
        "distance from the end (mm)",
        "variations below (%)",
        "simulated",
        "imaginary part",
    ],
)
def test_what_is_written_into_a_picture_of_motion_is_german(words: str) -> None:
    own = language_of("de", "9pc").sentence(words)
    kept = {"s", "mm", "µm", "dB"}
    assert not (set(re.findall(r"[a-zµ]+", words, re.IGNORECASE)) - kept) & set(
        re.findall(r"[a-zµ]+", own, re.IGNORECASE)
    )


@pytest.mark.parametrize(
    ("family", "english", "german"),
    [
        ("9pc", "speed, in/min", "Geschwindigkeit, Zoll/min"),
        ("9pc", "position from the switch, in", "Position ab dem Schalter, Zoll"),
        ("9pc", "position from the start", "Position ab dem Start"),
        ("num", "P16N3 at 1000 deg/min", "P16N3 bei 1000 °/min"),
        ("num", "4 % at 1000 deg/min", "4 % bei 1000 °/min"),
    ],
)
def test_the_scales_and_speeds_of_a_homing_are_german(family: str, english: str, german: str) -> None:
    """A pattern for the friction at 1000 of a unit took every speed of 1000 deg/min."""
    assert language_of("de", family).sentence(english) == german


def test_a_section_that_is_a_source_keeps_its_point() -> None:
    """It was ``Seite 3,2``."""
    alarm = (
        "The axis has passed the 1st software stroke limit, 400.5 mm (page 3.2): the command stops at once"
    )
    assert language_of("de", "syntec").sentence(alarm) == (
        "Die Achse hat die 1. Softwareendlage bei 400,5 mm überfahren (Seite 3.2): der Sollwert hält sofort"
    )


def test_the_speed_of_a_spindle_is_a_drehzahl() -> None:
    figures = (
        CheckedFigure("speed", 1000.0, "rpm", "1000 rpm"),
        CheckedFigure("speed", 5.0, "mm/min", "5 mm/min"),
    )
    check = CheckedMotion("good", "spindle", "", figures, "")
    printed = check.printed(language_of("de", "9pc"))[1].replace("\u00a0", " ")
    assert printed == "Drehzahl 1000 1/min, Geschwindigkeit 5 mm/min"


def test_a_masked_value_is_german_in_a_paper_of_differences() -> None:
    mill, lathe = (open_file(EXAMPLES[name]).file for name in ("mill-1394", "lathe-ls176"))
    comparison = compare(mill.schema, mill.values, lathe.values)
    paper = differences_paper(mill, comparison, ("A", "B"), language="de")
    assert "(geheim)" in paper_texts(paper)
    assert "(secret)" not in paper_texts(paper)


def test_units_and_joints_of_a_sheet_are_german() -> None:
    words = language_of("de", "linuxcnc")
    assert [words.unit(unit) for unit in ("hexadecimal", "steps/mm")] == ["hexadezimal", "Schritte/mm"]
    assert words.text("Joint 0") == "Gelenk 0", "as the messages of its rules call it"


def test_a_finding_that_names_a_unit_alone_has_it_in_german() -> None:
    """``gehört hier in deg/min angegeben``: a unit was taken behind a number only."""
    words = language_of("de", "num")
    english = "Approach Speed 3000 mm/min should be in deg/min here."
    found = words.finding(Finding("", "error", (), english))
    assert "°/min" in found
    assert "deg/min" not in found


def test_a_workbook_has_german_units() -> None:
    """``deg/min`` and ``rpm`` were beside German words; the English one has them as the file."""
    file = open_file(EXAMPLES["mill-1394"]).file

    def units(language: str) -> set[str]:
        book = load_workbook(BytesIO(render_workbook(build_report(file, Contents(language=language)))))
        return {str(row[7]) for row in book.worksheets[0].iter_rows(min_row=2, values_only=True)}

    assert {"deg/min", "rpm", "counts"} <= units("en")
    assert {"°/min", "1/min", "Ink"} <= units("de")
    assert {"deg/min", "rpm", "counts"} & units("de") == set()
