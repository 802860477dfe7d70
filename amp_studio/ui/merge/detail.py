"""Below the tree of a comparison: the selected value with every choice there is,
and what each of them would bring.
"""

from __future__ import annotations

import html
from collections.abc import Callable, Iterable

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFont, QFontMetrics, QPainter, QPaintEvent, QPalette
from PySide6.QtWidgets import (
    QButtonGroup,
    QFrame,
    QGridLayout,
    QLabel,
    QLineEdit,
    QSizePolicy,
    QToolButton,
    QWidget,
)

from amp_studio.files import MergeChoice, Row, Side, Typed
from amp_studio.ui.base.figures import finding_in_words
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.theme import Token, colour, font, icon, scheme
from amp_studio.ui.motion.tuning_target import effect_words
from amp_studio.validate import SEVERITIES, Finding

from .columns import BASE, RESULT, A, B
from .model import MergeModel

Judge = Callable[[Row, MergeChoice], Iterable[Finding] | None]
"""Returns the findings about a row if that were chosen; None while it is not known."""
_COLUMNS: dict[Side, int] = {"base": BASE, "a": A, "b": B}


class ChoiceButton(QToolButton):
    """One of several choices, with the circle that the tree has."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.setText(text)
        self.setCheckable(True)
        self.setProperty("choice", True)
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.toggled.connect(self._show)
        self._show(False)

    def _show(self, on: bool) -> None:
        self.setIcon(icon("check-circle-fill", "sel") if on else icon("circle", "dim"))


class Line(QLabel):
    """A text of one line that is elided where there is no room; the whole is its tool tip."""

    def __init__(self, face: QFont) -> None:
        super().__init__()
        self.setFont(face)
        # It asks for no width: a long value must not make the window wider.
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._colour_name: Token = "dim"

    def show_text(self, text: str, colour_name: Token = "dim", more: str = "") -> None:
        """Show a text in an ink."""
        self._colour_name = colour_name
        self.setToolTip(more or text)
        self.setText(text)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setPen(colour(self._colour_name))
        elided = QFontMetrics(self.font()).elidedText(self.text(), Qt.TextElideMode.ElideRight, self.width())
        painter.drawText(self.rect(), Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, elided)


_TOKENS: dict[str, Token] = {"error": "error", "warning": "warn", "advice": "rec"}


class MergeDetail(QFrame):
    """Shows one row; a side is taken or a value typed here as well."""

    chosen = Signal(object, object)
    """A row and a choice."""

    def __init__(self, model: MergeModel, judge: Judge) -> None:
        super().__init__()
        self._model, self._judge = model, judge
        self._row: Row | None = None
        self.setAccessibleName(self.tr("Selected value"))
        self.setAutoFillBackground(True)
        self.setBackgroundRole(QPalette.ColorRole.AlternateBase)
        self.title, self.words = QLabel(), QLabel()
        self.title.setFont(font("text", own=True))
        self.words.setWordWrap(True)
        self.words.setFont(font("small"))
        left = in_column(self.title, self.words, 0, gap=6)
        self._group = QButtonGroup(self)
        self.buttons: dict[str, ChoiceButton] = {}
        self.notes: dict[str, Line] = {}
        grid = QGridLayout()
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(4)
        for n, (key, name) in enumerate(
            (("base", "&0"), ("a", "&A"), ("b", "&B"), ("typed", self.tr("&Other")))
        ):
            button, note = ChoiceButton(name), Line(font("small"))
            self.buttons[key], self.notes[key] = button, note
            self._group.addButton(button)
            grid.addWidget(button, n, 0)
            grid.addWidget(note, n, 2)
        self.other = QLineEdit()
        self.other.setFixedWidth(150)
        self.other.setAccessibleName(self.tr("Other value"))
        self.other.returnPressed.connect(self._typed)
        self.values = {key: Line(font("text")) for key in _COLUMNS}
        for n, key in enumerate(_COLUMNS):
            grid.addWidget(self.values[key], n, 1)
        grid.addWidget(self.other, 3, 1)
        grid.setColumnMinimumWidth(1, 150)
        grid.setColumnStretch(1, 1)
        grid.setColumnStretch(2, 2)
        self._group.buttonClicked.connect(lambda _: self._clicked())
        self.facts = QLabel()
        self.facts.setFont(font("small"))
        self.facts.setAlignment(Qt.AlignmentFlag.AlignTop)
        self._row_of_parts = in_row(
            (left, 2), (grid, 5), (self.facts, 1), on=self, margins=(12, 10, 12, 8), gap=24
        )
        scheme().changed.connect(self._write_again)
        self.show_row(None)

    def _write_again(self) -> None:
        self.show_row(self._row)

    def show_row(self, row: Row | None) -> None:
        """Show a row, or that none is selected."""
        self._row = row
        can = row is not None and row.kind != "same"
        widgets: list[QWidget] = [
            *self.buttons.values(),
            *self.values.values(),
            *self.notes.values(),
            self.other,
        ]
        for widget in widgets:
            widget.setVisible(can)
        self._row_of_parts.setStretch(1, 5 if can else 0)  # else a text alone would be narrow beside nothing
        if row is None:
            self.title.setText("")
            self.words.setText(
                self.tr("Keys: 0, A, B take a source, F2 types a value, C goes to the next conflict.")
            )
            self.facts.setText("")
            return
        model = self._model
        self.title.setText(" ".join(t for t in (model.text(row, 0), model.axis(row)) if t))
        self.words.setText(self._words(row))
        self.facts.setText(self._facts(row))
        if can:
            self._show_choices(row)

    def _show_choices(self, row: Row) -> None:
        model, choice = self._model, self._model.merge.choice(row)
        has_base = model.merge.base is not None
        for widget in (self.buttons["base"], self.values["base"], self.notes["base"]):
            widget.setVisible(has_base)
        # An exclusive group always has a checked button; a row without a choice has none.
        self._group.setExclusive(False)
        for side, column in _COLUMNS.items():
            self.buttons[side].setChecked(choice == side)
            self.values[side].show_text(model.cell(row, column).whole, "text")
            self._show_verdict(
                self.notes[side], self._judge(row, side) if side != "base" or has_base else None
            )
        self.buttons["typed"].setChecked(isinstance(choice, Typed))
        self._group.setExclusive(True)
        self.other.setEnabled(model.may_type(row))
        self.buttons["typed"].setEnabled(model.may_type(row))
        self.other.setText(model.cell(row, RESULT).whole if isinstance(choice, Typed) else "")
        self.notes["typed"].show_text("")

    def _show_verdict(self, label: Line, found: Iterable[Finding] | None) -> None:
        """Say what a choice brings: the worst finding, or that there is none."""
        if found is None:
            label.show_text("")
            return
        worst = sorted(found, key=lambda finding: SEVERITIES.index(finding.severity))
        if not worst:
            label.show_text(self.tr("no finding"))
            return
        more = "\n".join(finding_in_words(finding) for finding in worst)
        label.show_text(finding_in_words(worst[0]), _TOKENS[worst[0].severity], more)

    def _words(self, row: Row) -> str:
        """Return in a sentence who changed the value."""
        sentences = {
            "same": self.tr("The same in all sources."),
            "both": self.tr("Both sides changed it to the same."),
            "conflict": self.tr("Both sides changed it, and not to the same."),
            "different": self.tr("The sources differ."),
        }
        if row.kind in sentences:
            return sentences[row.kind]
        side = row.kind.upper()
        if self._model.merge.base is None:
            return self.tr("Set in {side} only.").format(side=side)
        return self.tr("Only {side} changed it.").format(side=side)

    def _facts(self, row: Row) -> str:
        if row.id.part != "value":
            return ""
        file = self._model.merge.a
        parameter = file.schema.parameters[row.address[0]]
        effect = effect_words(file.schema, row.address)
        state = file.evaluation.state(row.address) if row.address in file.machine_schema.places else None
        lines = [(self.tr("Takes effect"), effect), (self.tr("Page"), parameter.page)]
        # A value of another machine type stays in the file, and has no state on this one.
        if state is None:
            lines.append((self.tr("Here"), self.tr("not on this machine type")))
        elif not state.is_active:
            lines.append((self.tr("Inactive"), state.why))
        shade = colour("dim").name()
        cells = "".join(
            f'<tr><td style="color:{shade};padding-right:12px">{html.escape(name)}</td>'
            f"<td>{html.escape(str(text))}</td></tr>"
            for name, text in lines
        )
        return f"<table>{cells}</table>"

    def _clicked(self) -> None:
        row = self._row
        if row is None:
            return
        for side in _COLUMNS:
            if self.buttons[side].isChecked():
                self.chosen.emit(row, side)
                return
        # "Other" without a text is no choice yet: the field is where to go on.
        if self.other.text().strip():
            self._typed()
        else:
            self.other.setFocus()

    def _typed(self) -> None:
        if self._row is None:
            return
        try:
            self.chosen.emit(self._row, self._model.read(self._row, self.other.text()))
        except ValueError as error:
            self.notes["typed"].show_text(str(error), "error")
