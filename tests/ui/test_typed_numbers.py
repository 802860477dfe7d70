"""A number that a person types is read with either decimal sign: 0,5 is never 5 and never 0."""

import re
from pathlib import Path

import pytest
from PySide6.QtCore import QLocale
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox

from amp_studio.schema import InvalidValueError, read_bare_number
from amp_studio.ui.dialogs.calculator_dialog import CalculatorDialog
from amp_studio.ui.forms.number_box import NumberBox, WholeBox
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.motion.settings import _read

from .conftest import action


@pytest.mark.parametrize("language", ["en", "de"])
@pytest.mark.parametrize(
    ("text", "number", "whole"),
    [("0,5", 0.5, 7), ("0.5", 0.5, 7), ("1,5", 1.5, 7), ("12.5 %", 12.5, 7), ("x5", 7.0, 7), ("3", 3.0, 3)],
)
def test_a_box_with_arrows_takes_either_sign(
    qapp: QApplication, language: str, text: str, number: float, whole: int
) -> None:
    """Qt's own boxes made 5 of 0.5 in German and of 0,5 in English."""
    found = []
    for box in (NumberBox(), WholeBox()):
        box.setLocale(QLocale(language))
        box.setRange(0, 100)
        box.setSuffix(" %")
        box.setValue(7)
        box.selectAll()
        QTest.keyClicks(box.lineEdit(), text.removesuffix(" %") if isinstance(box, WholeBox) else text)
        box.interpretText()
        found.append(box.value())
    assert found == [number, whole]


def test_no_page_has_a_box_of_qt_itself(checkout: Path) -> None:
    own = re.compile(r"\bQ(Double)?SpinBox\(\)|\btoDouble\(|QDoubleValidator")
    pages = (checkout / "amp_studio" / "ui").rglob("*.py")
    assert [path.name for path in pages if own.search(path.read_text("utf-8"))] == []


def test_several_values_of_a_calculator_have_semicolons_in_german(german: None, window: MainWindow) -> None:
    """``0,5`` was 0 and 5."""
    action(window, "Rechner").trigger()
    dialog = window.findChild(CalculatorDialog)
    formula = dialog.form.editor("formula", QComboBox)
    formula.setCurrentIndex(formula.findData("vector_feedrate_limit"))
    for name, text in (("distances", "3;4"), ("limits", "1,5;2,5")):
        dialog.form.set_answer(f"argument.{name}", text)
    assert dialog.form.answer("outcome") == "2,5"
    dialog.form.set_answer("argument.limits", "1,5")
    assert dialog.form.answer("outcome").startswith("„1,5“ kann zweierlei bedeuten")


@pytest.mark.parametrize("text", ["0,5", "0.5", " 0,50 ", "0,5 mm"])
def test_a_setting_of_a_simulation_has_its_decimals(text: str) -> None:
    assert _read("move.distance", text, "mm") == "0.5 mm"


def test_a_number_with_another_unit_than_its_field_is_refused() -> None:
    """A trigger above ``5 in`` fired at 5 mm."""
    assert read_bare_number("0,5 s", "s") == 0.5
    with pytest.raises(InvalidValueError, match="'5 in' is no bare number"):
        read_bare_number("5 in", "mm")
