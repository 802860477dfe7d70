"""The published formulas as calculators."""

from __future__ import annotations

from amp_studio.schema import Value
from amp_studio.ui.dialogs.calculator_dialog import CalculatorDialog
from amp_studio.ui.main_window import MainWindow

from .conftest import Person, action

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
    assert tuple(dialog.formula.itemData(n) for n in range(len(own))) == own
    dialog.formula.setCurrentText("Gain break point")
    dialog.fields["max_contouring"].setText("4000")
    assert dialog.outcome.text() == "Still needed: Gain"
    assert not dialog.use.isEnabled()
    dialog.fields["gain"].setText("1")
    assert dialog.outcome.text() == "4"
    assert dialog.use.text() == "Use the result as the value of 1730 Gain Break Point, in mm"
    dialog.use.click()
    assert window.workspace.file.get(GAIN_BREAK) == Value(4.0, "mm")


def test_another_formula_asks_for_its_own_arguments(window: MainWindow, person: Person) -> None:
    """Page 14-2, example 14.1: 1000 to 3000 with 800 to 1500, asked for 1800."""
    dialog = calculator(window)
    dialog.formula.setCurrentText("Synchronized speed")
    assert list(dialog.fields) == ["requested", "controlling", "follower"]
    for name, text in (("requested", "1800"), ("controlling", "1000, 3000"), ("follower", "800, 1500")):
        dialog.fields[name].setText(text)
    assert dialog.outcome.text() == "1500"
    dialog.fields["follower"].setText("fast")
    assert dialog.outcome.text().startswith("'fast' is no follower")
