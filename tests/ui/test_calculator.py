"""The published formulas as calculators."""

from __future__ import annotations

from PySide6.QtWidgets import QComboBox

from amp_studio.schema import Value
from amp_studio.ui.dialogs.calculator_dialog import CalculatorDialog
from amp_studio.ui.main_window import MainWindow

from .conftest import User, action

GAIN_BREAK = ("servo.gain_break_point", "1")


def calculator(window: MainWindow) -> CalculatorDialog:
    """Open the calculators and return the dialog."""
    action(window, "Calculator").trigger()
    return window.findChild(CalculatorDialog)


def test_the_formulas_of_the_parameter_come_first_and_the_result_can_be_used(window: MainWindow) -> None:
    """5000 mm/min at gain 1 follow 5 mm behind (page 7-22)."""
    window.go_to(GAIN_BREAK)
    dialog = calculator(window)
    own = window.workspace.file.schema.parameters[GAIN_BREAK[0]].formulas
    formula = dialog.form.editor("formula", QComboBox)
    assert tuple(formula.itemData(n) for n in range(len(own))) == own
    formula.setCurrentText("Gain break point")
    dialog.form.set_answer("argument.max_contouring", "4000")
    assert dialog.form.answer("outcome") == "Still needed: Gain"
    assert not dialog.use.isEnabled()
    dialog.form.set_answer("argument.gain", "1")
    assert dialog.form.answer("outcome") == "4"
    assert dialog.use.text() == "Use the result as the value of 1730 Gain Break Point, in mm"
    dialog.use.click()
    assert window.workspace.file.get(GAIN_BREAK) == Value(4.0, "mm")


def test_another_formula_asks_for_its_own_arguments(window: MainWindow, user: User) -> None:
    """Page 14-2, example 14.1: 1000 to 3000 with 800 to 1500, asked for 1800."""
    dialog = calculator(window)
    dialog.form.editor("formula", QComboBox).setCurrentText("Synchronized speed")
    names = [f"argument.{name}" for name in ("requested", "controlling", "follower")]
    assert [key for key in dialog.form.editors if key in names] == names
    for name, text in (("requested", "1800"), ("controlling", "1000, 3000"), ("follower", "800, 1500")):
        dialog.form.set_answer(f"argument.{name}", text)
    assert dialog.form.answer("outcome") == "1500"
    dialog.form.set_answer("argument.follower", "fast")
    assert dialog.form.answer("outcome").startswith("'fast' is no follower")
