"""The published formulas as calculators; a result that is a number can become the value of a parameter."""

from __future__ import annotations

import re
from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialog, QPushButton, QWidget

from amp_studio.schema import Address, quoted
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.translated import (
    facts_in_words,
    help_language,
    message_in_words,
    sentenced,
    tr,
    unit_in_words,
    worded,
)
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.form import Field, FieldForm
from amp_studio.validate import Argument, Calculator, calculate, calculators, shown_result

_REFUSAL = re.compile(
    r".+?( must (?:be (?:at most|a finite|greater than|0 to 100 %|a whole)|not be negative).*, not (\S+)\.)"
)
"""A refusal of any formula, after the words for what it refuses; with the figure."""


class CalculatorDialog(QDialog):
    """Evaluates a formula while its arguments are typed."""

    def __init__(
        self,
        workspace: Workspace,
        address: Address | None,
        commit: Callable[[Address, str], bool],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(self.tr("Calculator"))
        self.setMinimumWidth(520)
        self._workspace, self._address, self._commit = workspace, address, commit
        self._family = workspace.file.schema.family.family
        self._known = calculators(self._family)
        self._titles = facts_in_words(workspace.file.schema).of_formula
        own = workspace.file.schema.parameters[address[0]].formulas if address else ()
        # The formulas of the parameter come first, as its page names them; then all others by title.
        others = sorted((self._titles(each), name) for name, each in self._known.items() if name not in own)
        formulas = [(name, self._titles(self._known[name])) for name in (*own, *(name for _, name in others))]
        self._above = (
            Field("formula", self.tr("&Formula"), "choice", formulas[0][0], formulas),
            Field("description", help_language().capitalize(), "words"),
        )
        self._below = (Field("outcome", self.tr("Result"), "words"),)
        self.form = FieldForm((*self._above, *self._below))
        self.use = QPushButton()
        self.use.clicked.connect(self._use)
        in_column(self.form, self.use, on=self)
        self.form.changed.connect(self._change)
        workspace.closed.connect(self.close)
        self._choose()

    @property
    def _formula(self) -> Calculator:
        return self._known[self.form.answer("formula")]

    def _change(self, key: str) -> None:
        if key == "formula":
            self._choose()
        else:
            self._work_out()

    def _choose(self) -> None:
        arguments = (
            Field(f"argument.{a.name}", self._titles(a), hint=worded(a.default or a.example))
            for a in self._formula.arguments
        )
        self.form.offer((*self._above, *arguments, *self._below))
        self.form.set_answer("description", self._formula.description)
        self._work_out()

    def _work_out(self) -> None:
        arguments = self._formula.arguments
        texts = {a.name: self.form.answer(f"argument.{a.name}") for a in arguments}
        # Off until there is a result: the one before was of other arguments.
        self.use.setEnabled(False)
        self.use.setText(self.tr("Use the result as a value"))
        missing = [self._titles(a) for a in arguments if a.default is None and not texts[a.name]]
        if missing:
            self.form.set_answer("outcome", self.tr("Still needed: {names}").format(names="; ".join(missing)))
            return
        try:
            for argument in arguments:
                _refuse_two_ways(argument, texts[argument.name])
            result = calculate(self._family, self._formula.name, texts)
        except ValueError as error:
            self.form.set_answer("outcome", self._titled(str(error)))
            return
        self.form.set_answer("outcome", sentenced(shown_result(result)))
        # True is an int in Python, and no figure.
        if self._address and isinstance(result, (int, float)) and not isinstance(result, bool):
            self._offer_as_value(self._address)

    def _offer_as_value(self, address: Address) -> None:
        """Offer the result as the value of a parameter, in the unit in which it would be typed."""
        unit = unit_in_words(self._workspace.typed_unit(address))
        text = self.tr("Use the result as the value of {label}{what}").format(
            label=self._workspace.file.machine_schema.label(address), what=f", in {unit}" if unit else ""
        )
        self.use.setText(text)
        self.use.setEnabled(self._workspace.may_edit)

    def _titled(self, text: str) -> str:
        """Return a message with the titles of the formula and of its arguments for their names."""
        text = sentenced(self._with_title(text), self._family)
        parts: tuple[Calculator | Argument, ...] = (self._formula, *self._formula.arguments)
        for part in parts:
            text = re.sub(rf"\b{part.name}\b", self._titles(part), text) if "_" in part.name else text
        return f"{text}.".replace("..", ".")

    def _with_title(self, text: str) -> str:
        """Return a refusal with the title of the argument that has the refused figure: what a formula calls
        it has no words in another language.
        """
        match = _REFUSAL.fullmatch(text)
        if match is None or not help_language():
            return text
        like = [
            self._titles(a)
            for a in self._formula.arguments
            if _figure(self.form.answer(f"argument.{a.name}")) == _figure(match[2])
        ]
        return (like[0] if len(like) == 1 else self.tr("A value")) + match[1]

    def _use(self) -> None:
        if self._address and self._commit(self._address, self.form.answer("outcome")):
            self.close()


def _refuse_two_ways(argument: Argument, text: str) -> None:
    """Refuse a comma between digits of several values where the language has a decimal one: ``0,5`` would
    be 0 and 5. Raises ValueError.
    """
    has_comma = tr(".", "decimal sign") == "," and ";" not in text and re.search(r"\d,\d", text)
    if has_comma and argument.is_several:
        message = f"{quoted(text)} can be read two ways: put semicolons between the values"
        raise ValueError(message_in_words(message))


def _figure(text: str) -> float | None:
    try:
        return float(text.replace(",", "."))
    except ValueError:
        return None
