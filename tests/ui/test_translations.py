"""The window in German: every text has a translation, and the right one is shown."""

import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QCoreApplication
from PySide6.QtWidgets import QMenu

from amp_studio.drawing import scene_in_words
from amp_studio.files import open_file
from amp_studio.guide import steps_of
from amp_studio.pictures import pictures_of
from amp_studio.ui.base.translated import (
    LANGUAGES,
    CatalogueTranslator,
    counted,
    language_in_use,
    set_language,
    tr,
    worded,
)
from amp_studio.ui.main_window import MainWindow

ROOT = Path(__file__).parents[2]
CODES = [code for code in LANGUAGES if code != "en"]
HOLE = re.compile(r"\{[^}]*\}|%n")


@pytest.fixture
def german(qapp: QCoreApplication) -> Iterator[None]:
    assert set_language("de") == "de"
    yield
    set_language("en")


def test_every_text_of_the_window_is_translated() -> None:
    done = subprocess.run(
        [sys.executable, ROOT / "scripts" / "translations.py", "--check"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("code", CODES)
def test_a_translation_has_the_same_holes_and_an_alt_letter_where_the_text_has_one(code: str) -> None:
    words = CatalogueTranslator(code)
    assert len(words.words) > 800
    for source, translation in words.words.items():
        assert sorted(HOLE.findall(source)) == sorted(HOLE.findall(translation)), source
        assert bool(re.search(r"&\w", source)) == bool(re.search(r"&\w", translation)), source
    for source, forms in words.plurals.items():
        assert len(forms) == 2, source
        for form in forms:
            assert sorted(HOLE.findall(source)) == sorted(HOLE.findall(form)), source


@pytest.mark.usefixtures("german")
def test_menus_are_in_german_and_their_alt_letters_differ(
    open_window: Callable[..., MainWindow], path: Path
) -> None:
    window = open_window(path)
    titles = [action.text() for action in window.menuBar().actions()]
    assert "&Datei" in titles
    assert "&Hilfe" in titles
    menus = [window.menuBar(), *(menu for menu in window.findChildren(QMenu) if menu.actions())]
    for menu in menus:
        letters = [
            found.group(1).casefold()
            for action in menu.actions()
            if action.isVisible() and (found := re.search(r"&(\w)", action.text()))
        ]
        twice = sorted({letter for letter in letters if letters.count(letter) > 1})
        assert twice == [], (getattr(menu, "title", str)(), [action.text() for action in menu.actions()])


@pytest.mark.usefixtures("german")
def test_numbers_have_their_form_and_what_has_no_translation_stays() -> None:
    assert tr("%n axes", "", 1) == "1 Achse"
    assert tr("%n axes", "", 3) == "3 Achsen"
    assert tr("Not a text of the window") == "Not a text of the window"


def test_english_numbers_have_their_form_too() -> None:
    set_language("en")
    assert tr("%n axes", "", 1) == "1 axis"
    assert tr("%n axes", "", 3) == "3 axes"
    assert tr("%n conflicts left", "", 1) == "1 conflict left"
    assert tr("&File") == "&File"


def test_a_text_within_an_f_string_has_a_translation_too() -> None:
    assert CatalogueTranslator("de").words["Allowed here:"] == "Hier erlaubt:"


@pytest.mark.usefixtures("german")
def test_what_is_made_below_the_window_is_in_the_words_of_reports_and_facts_stay() -> None:
    assert worded("Zones and overtravel", "9pc") == "Zonen und Endlagen"
    assert worded("page 7-20") == "Seite 7-20"
    assert worded("-9.999 to 9.999 mm") == "-9.999 bis 9.999 mm"
    assert worded("Axis 3") == "Achse 3"
    assert worded("Axis Calibration, X: not set") == "Axis Calibration, X: nicht gesetzt"
    assert worded("Excess Error") == "Excess Error"


@pytest.mark.usefixtures("german")
def test_counts_are_german_with_their_form_and_nothing_is_shown_in_words() -> None:
    assert counted(1, "change") == "1 Änderung"
    assert counted(2, "advice") == "2 Empfehlungen"
    assert counted(0, "parameter", none="no") == "keine Parameter"
    assert counted(0, "file") == "0 Dateien"
    assert worded("no printed range") == "kein gedruckter Bereich"
    assert worded("at least 5 mm") == "mindestens 5 mm"


@pytest.mark.usefixtures("german")
def test_every_step_and_every_picture_of_every_family_has_a_german_name(checkout: Path) -> None:
    for path in sorted((checkout / "examples").glob("*/*.amp")):
        file = open_file(path).file
        for step in steps_of(file.schema):
            title = worded(step.title, file.schema.family.family)
            assert title != step.title or title == "DDA"
        for picture in pictures_of(file):
            assert worded(picture.title) != picture.title, picture.title
            scene = picture.scene()
            assert scene_in_words(scene, worded).subtitle != scene.subtitle or len(scene.subtitle) < 3


@pytest.mark.usefixtures("german")
def test_the_page_of_a_parameter_has_no_english_frame(
    open_window: Callable[..., MainWindow], path: Path
) -> None:
    window = open_window(path)
    window.go_to(("servo.excess_error", "1"))
    text = window.page.detail.page.toPlainText()
    for english in ("Allowed", "What it does", ", page", "Calculate", "Formulas", "Facts"):
        assert english not in text, english
    assert window.page.table.titles[0] == "X 1 linear"
    assert "X-Achse" in window.status.value.text()


def test_the_language_is_that_of_the_choice_or_of_the_system() -> None:
    assert language_in_use("de") == "de"
    assert language_in_use("system") in LANGUAGES
    assert language_in_use("xx") in LANGUAGES
