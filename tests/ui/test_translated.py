"""The window in another language: no key of the program is a word that a translation changes."""

import re
from collections.abc import Iterator

import pytest
from PySide6.QtCore import QTranslator
from PySide6.QtWidgets import QApplication, QDockWidget
from pytestqt.qtbot import QtBot

from amp_studio.ui.main_window import MainWindow

EXCESS = ("servo.excess_error", "1")
_KEYS = re.compile(r"(Ctrl|Alt|Shift|F\d|Del|Esc|Enter|Return)\b")


class Marked(QTranslator):
    """A language in which every text ends with a mark; keys of the keyboard stay."""

    def translate(self, context: str, text: str, disambiguation: str | None = None, n: int = -1) -> str:
        return "" if not text or _KEYS.match(text) else f"{text}°"

    def isEmpty(self) -> bool:  # noqa: N802  # Qt's own name
        return False


@pytest.fixture
def other_language(qapp: QApplication) -> Iterator[None]:
    """Install the language for one test."""
    language = Marked()
    qapp.installTranslator(language)
    yield
    qapp.removeTranslator(language)


def test_panels_work_in_another_language(other_language: None, open_window, path, qtbot: QtBot) -> None:
    window: MainWindow = open_window(path)
    for name, panel in (("Groups", "groups"), ("Parameter", "detail"), ("Findings", "findings")):
        dock = window.findChild(QDockWidget, name)
        assert dock.windowTitle() == f"{name}°"
        dock.close()
        window.show_panel(name)
        assert getattr(window, panel).isVisible(), name
    for action in window.menus.menu("places").actions():
        action.trigger()
    window.resize(820, 600)
    QApplication.processEvents()
    window.show_panel("Parameter")
    assert window.detail.isVisible()
    window.resize(1300, 700)
    QApplication.processEvents()
    assert window.findings.isVisible()


def test_unsaved_work_is_discarded_in_another_language(other_language: None, open_window, path, user) -> None:
    window: MainWindow = open_window(path)
    before = path.read_bytes()
    window.edits.commit(EXCESS, "3 mm")
    user.answers("Discard°")
    window.files.close()
    assert window.page is None
    assert path.read_bytes() == before


def test_findings_and_units_work_in_another_language(other_language: None, open_window, path) -> None:
    window: MainWindow = open_window(path)
    window.tools.units.buttons["inch"].click()
    assert window.workspace.file.header.units == "inch"
    window.edits.commit(EXCESS, "0.1 in")
    window.go_to(EXCESS)
    window.findings.show_all()
    window.findings.scope.buttons["axis"].click()
    assert window.findings.model.groups
    window.findings.view.setCurrentIndex(window.findings.model.index(0, 0))
    window.findings.fix()
    assert window.workspace.file.get(EXCESS).value != 0.1
    assert "°" in window.detail.page.toPlainText()
