"""The window in German: every text has a translation, and the right one is shown."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QCoreApplication
from PySide6.QtWidgets import QMenu

from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.translated import FOLDER, LANGUAGES, FileTranslator, language_in_use, speak, tr

ROOT = Path(__file__).parents[2]
FILES = [FOLDER / f"amp_studio_{code}.ts" for code in LANGUAGES if code != "en"]
HOLE = re.compile(r"\{[^}]*\}|%n")


@pytest.fixture
def german(qapp: QCoreApplication) -> Iterator[None]:
    assert speak("de") == "de"
    yield
    speak("en")


def test_every_text_of_the_window_is_translated() -> None:
    done = subprocess.run(
        [sys.executable, ROOT / "scripts" / "translations.py", "--check"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_translation_has_the_same_holes_and_an_alt_letter_where_the_text_has_one(path: Path) -> None:
    words = FileTranslator(path)
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


def test_the_language_is_that_of_the_choice_or_of_the_system() -> None:
    assert language_in_use("de") == "de"
    assert language_in_use("system") in LANGUAGES
    assert language_in_use("xx") in LANGUAGES
