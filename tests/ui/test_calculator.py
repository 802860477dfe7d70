"""The published formulas as calculators."""

import ast
import inspect
import re
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtWidgets import QComboBox

from amp_studio.report import language_of
from amp_studio.schema import NO_TEXTS, Value, fact_texts, family_ids
from amp_studio.ui.dialogs.calculator_dialog import CalculatorDialog
from amp_studio.ui.main_window import MainWindow
from amp_studio.validate import calculators
from amp_studio.validate.functions import formulas

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


@pytest.mark.parametrize("family", [each for each in family_ids() if fact_texts(each, "de") is not NO_TEXTS])
def test_every_formula_and_what_it_asks_for_has_a_german_title_and_no_title_is_of_another_formula(
    family: str,
) -> None:
    known = calculators(family)
    names = set(known) | {a.name for each in known.values() for a in each.arguments}
    assert sorted(names ^ fact_texts(family, "de").formulas.keys()) == []


@pytest.mark.usefixtures("german")
def test_a_german_calculator_asks_answers_and_refuses_in_german(
    open_window: Callable[..., MainWindow], path: Path
) -> None:
    window = open_window(path)
    window.go_to(GAIN_BREAK)
    action(window, "Rechner").trigger()
    dialog = window.findChild(CalculatorDialog)
    formula = dialog.form.editor("formula", QComboBox)
    formula.setCurrentText("Knickpunkt der Verstärkung")
    dialog.form.set_answer("argument.max_contouring", "4100")
    assert dialog.form.answer("outcome") == "Noch nötig: Verstärkung"
    dialog.form.set_answer("argument.gain", "1")
    assert dialog.form.answer("outcome") == "4,1"
    formula.setCurrentText("Drehzahl der Synchronspindeln")
    dialog.form.set_answer("argument.requested", "schnell")
    dialog.form.set_answer("argument.controlling", "1000, 3000")
    dialog.form.set_answer("argument.follower", "800, 1500")
    assert dialog.form.answer("outcome").startswith("„schnell“ passt nicht zu")
    formula.setCurrentText("Knickpunkt der Verstärkung")
    dialog.form.set_answer("argument.max_contouring", "4100")
    dialog.form.set_answer("argument.gain", "-1,5")
    assert dialog.form.answer("outcome") == "Verstärkung muss größer als null sein, nicht −1,5."
    assert window.page.detail.page.toPlainText().count("englisch") == 1


ENGLISH = re.compile(r"\b(?:the|not|is|must|has|have|no|than|below|above)\b")


@pytest.mark.parametrize("family", [each for each in family_ids() if fact_texts(each, "de") is not NO_TEXTS])
def test_every_refusal_of_a_formula_is_german_in_a_german_window(family: str) -> None:
    texts = set[str]()
    for module in {sys.modules[each.__module__] for each in formulas(family).values()}:
        for node in ast.walk(ast.parse(inspect.getsource(module))):
            if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call):
                match node.exc.args:
                    case [ast.Constant(str(text))]:
                        texts.add(text)
                    case [ast.JoinedStr(parts)]:
                        texts.add("".join(p.value if isinstance(p, ast.Constant) else "7" for p in parts))
    german = language_of("de", family)
    assert [text for text in texts if ENGLISH.search(german.sentence(text))] == []
