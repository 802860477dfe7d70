"""The one place of Live that writes to a machine: a single value, turned by steps and written by a click."""

from __future__ import annotations

import math
from typing import NamedTuple

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QCompleter, QFrame, QLabel, QLineEdit, QPushButton, QWidget

from amp_studio.files import RangeError, in_one_unit
from amp_studio.report import takes_effect
from amp_studio.schema import Address, InvalidValueError, Value, same_value, write_value
from amp_studio.ui.base.figures import sentence, show_value, typed
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.theme import CONTROL, GAP, GAP2, GAP3, colour, font, scheme
from amp_studio.ui.base.translated import sentenced, unit_in_words, worded
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.elided_label import ElidedLabel
from amp_studio.ui.table.value_delegate import allowed_text

from .sign import LiveSign

_FIELD = 104
"""Width of the field in logical pixels."""
_COARSE = 10
"""Steps of one with Shift."""


class ShownValue(NamedTuple):
    """What the frame is about: a value in the control, and what it was before it was turned here."""

    address: Address
    now: Value | None
    before: Value | None
    is_turned: bool


class _ValueField(QLineEdit):
    """A value to be written: arrows turn it, Ctrl+Enter writes it, Ctrl+Backspace puts it back."""

    stepped = Signal(int)
    write_requested = Signal()
    back_requested = Signal()

    def event(self, event: QEvent) -> bool:
        """Keep Ctrl+Backspace, which would delete a word."""
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.ShortcutOverride and _is_back(event):
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Take the keys that turn, write and put back."""
        way = {Qt.Key.Key_Up: 1, Qt.Key.Key_Down: -1}.get(Qt.Key(event.key()))
        modifiers = event.modifiers()
        if way is not None:
            self.stepped.emit(way * (_COARSE if modifiers & Qt.KeyboardModifier.ShiftModifier else 1))
        elif _is_back(event):
            self.back_requested.emit()
        elif event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and (
            modifiers & Qt.KeyboardModifier.ControlModifier
        ):
            self.write_requested.emit()
        else:
            super().keyPressEvent(event)


def _is_back(event: QKeyEvent) -> bool:
    with_control = event.modifiers() & Qt.KeyboardModifier.ControlModifier
    return bool(with_control) and event.key() == Qt.Key.Key_Backspace


class WriteFrame(QFrame):
    """Off with its reason while the control does not take the value."""

    write_requested = Signal(object, object)
    """Address and value that are to be written now."""
    back_requested = Signal(object)
    """The address whose value is to be as it was."""
    take_requested = Signal(object)
    """The address whose value in the control is to go into the file."""

    def __init__(self, workspace: Workspace, *, is_emulated: bool = False) -> None:
        super().__init__()
        self._workspace = workspace
        self._about: ShownValue | None = None
        self._why_off = ""
        self._wanted: Value | None = None
        self.setObjectName("live-write")
        self.setAccessibleName(self.tr("Writes to the machine"))
        sign = LiveSign("pencil-simple", "chg")
        self.head, self.name = QLabel(), ElidedLabel()
        self.head.setFont(font("small", own=True))
        self.field = _ValueField()
        self.field.setFixedWidth(_FIELD)
        self.field.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.field.setAccessibleName(self.tr("Value to be written"))
        self.less, self.more = QPushButton("−"), QPushButton("+")
        for button, way in ((self.less, -1), (self.more, 1)):
            button.setFixedSize(CONTROL, CONTROL)
            button.setStyleSheet("padding: 0;")
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # the arrows of the field do the same
            button.clicked.connect(lambda *_, way=way: self.step(way))
        self.less.setAccessibleName(self.tr("One step less"))
        self.more.setAccessibleName(self.tr("One step more"))
        self.unit, self.now = QLabel(), ElidedLabel()
        self.back, self.write = QPushButton(), QPushButton()
        self.write.setProperty("primary", True)
        self.hint = ElidedLabel()
        self.take = QPushButton(self.tr("&Take into the File"))
        for label in (self.now, self.hint, self.unit):
            label.setFont(font("small"))
        self.hint.setTextFormat(Qt.TextFormat.PlainText)
        self._lay_out(sign)
        self.use(is_emulated=is_emulated)
        self.field.stepped.connect(self.step)
        self.field.textEdited.connect(lambda _: self._read())
        self.field.write_requested.connect(self.press)
        self.field.back_requested.connect(self.put_back)
        self.write.clicked.connect(self.press)
        self.back.clicked.connect(self.put_back)
        self.take.clicked.connect(self._ask_file)
        scheme().changed.connect(self._colour)
        self._colour()
        self.hide()

    def _lay_out(self, sign: QLabel) -> None:
        upper = in_row(
            (in_column(in_row(sign, self.head, 1, gap=GAP), self.name, gap=0), 1),
            self.less,
            self.field,
            self.more,
            self.unit,
            (self.now, 1),
            gap=GAP,
        )
        upper.addSpacing(GAP2)
        upper.addWidget(self.back)
        upper.addWidget(self.write)
        in_column(upper, in_row((self.hint, 1), self.take), on=self, margins=(GAP3, GAP, GAP3, GAP), gap=GAP)
        QWidget.setTabOrder(self.field, self.write)
        QWidget.setTabOrder(self.write, self.back)
        QWidget.setTabOrder(self.back, self.take)

    def _colour(self) -> None:
        shade = colour("chg").name()
        self.setStyleSheet(
            f"QFrame#live-write {{ border: 1px solid {shade}; border-left: 3px solid {shade}; }}"
        )
        self.head.setStyleSheet(f"color: {shade};")
        self._show_state()

    def use(self, *, is_emulated: bool) -> None:
        """Say to what is written."""
        self._is_emulated = is_emulated
        self.head.setText(
            self.tr("Writes to the emulated control") if is_emulated else self.tr("Writes to the machine")
        )

    # -- what is about -----------------------------------------------------------

    def show_value(self, about: ShownValue | None) -> None:
        """Show a value of the control; what is typed of the same value stays. None hides the frame."""
        is_same = self._about is not None and about is not None and self._about.address == about.address
        was = self._about
        self._about = about
        self.setVisible(about is not None)
        if about is None:
            return
        parameter = self._workspace.file.schema.parameters[about.address[0]]
        self.name.setText(self._workspace.name_of(about.address))
        self.unit.setText(unit_in_words(self._workspace.typed_unit(about.address)))
        self.unit.setVisible(bool(self.unit.text()) and not parameter.choices)
        # Only where the control has another value now: a reading must not replace what is being typed.
        if not is_same or (was is not None and not same_value(was.now, about.now)):
            self._why_off = ""
            self._wanted = about.now
            self._fill()
            self._offer_choices()
        self._show_state()

    def _offer_choices(self) -> None:
        assert self._about is not None
        labels = self._workspace.file.schema.parameters[self._about.address[0]].choices
        made = QCompleter([each.label for each in labels or ()], self.field)
        made.setCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)
        self.field.setCompleter(made)

    def refuse(self, why: str) -> None:
        """Be off with the reason of the control, until the value or its state is another one."""
        self._why_off = why
        self._show_state()

    def allow(self) -> None:
        """Be on again: the state of the control is another one."""
        if self._why_off:
            self._why_off = ""
            self._show_state()

    def _text(self, value: Value | None) -> str:
        assert self._about is not None
        parameter = self._workspace.file.schema.parameters[self._about.address[0]]
        return show_value(parameter, self._in_unit(value), secrets=False) if value else self.tr("not set")

    def _number(self, value: Value | None) -> str:
        """Return a value for a button, without its unit: that is beside the field."""
        found = self._in_unit(value)
        if found is None or not _is_number(found):
            return self._text(value)
        assert self._about is not None
        parameter = self._workspace.file.schema.parameters[self._about.address[0]]
        return typed(write_value(parameter, found).partition(" ")[0])

    def _in_unit(self, value: Value | None) -> Value | None:
        assert self._about is not None
        (found,) = in_one_unit((value,), self._workspace.typed_unit(self._about.address))
        return found

    def _fill(self) -> None:
        assert self._about is not None
        parameter = self._workspace.file.schema.parameters[self._about.address[0]]
        found = self._in_unit(self._wanted)
        text = write_value(parameter, found) if found is not None else ""
        # The unit is beside the field, where it is not deleted by mistake.
        self.field.setText(text.partition(" ")[0] if _is_number(found) else text)

    def _read(self) -> None:
        """Take what is typed; what is no value is refused below."""
        if self._about is None:
            return
        try:
            self._wanted = self._workspace.read(self._about.address, self.field.text())
        except InvalidValueError as error:
            self._wanted = None
            self._show_state(sentence(str(error)))
        else:
            self._show_state()

    def _problem(self) -> str:
        """Return why the value in the field cannot be written; empty where it can."""
        if self._why_off:
            return self._why_off
        assert self._about is not None
        if self._wanted is None:
            return self.tr("No value")
        try:
            # On a copy: the range may depend on other values, and the file itself is not what is written to.
            self._workspace.file.copy().set_checked({self._about.address: self._wanted})
        except RangeError as error:
            return sentence(str(error))
        return ""

    def _show_state(self, problem: str = "") -> None:
        about = self._about
        if about is None:
            return
        problem = problem or self._problem()
        family = self._workspace.file.schema.family.family
        allowed = allowed_text(self._workspace, about.address)
        now = self.tr("now {value}").format(value=self._number(about.now))
        self.now.setText(f"{now}, {self.tr('allowed {range}').format(range=allowed)}" if allowed else now)
        self.write.setText(self.tr("&Write {value} Now").format(value=self._number(self._wanted)))
        self.write.setEnabled(not problem and not same_value(self._wanted, about.now))
        self.back.setVisible(about.is_turned)
        self.back.setText(self.tr("Put {value} &Back").format(value=self._number(about.before)))
        self.back.setEnabled(not self._why_off and about.before is not None)
        own = self._workspace.file.get(about.address)
        self.take.setEnabled(self._workspace.may_edit and not same_value(own, about.now))
        shade = colour("error" if problem else "dim").name()
        self.hint.setStyleSheet(f"color: {shade};")
        schema = self._workspace.file.schema
        effect = worded(takes_effect(schema, schema.parameters[about.address[0]]))
        keeps = self.tr("The file keeps {value}.").format(value=self._text(own))
        text = self.tr("One value, one click: read back and recorded; {effect}. {keeps}").format(
            effect=effect, keeps=keeps
        )
        self.hint.setText(sentenced(problem, family) if problem else text)

    # -- turning and writing -----------------------------------------------------

    def step(self, steps: int) -> None:
        """Turn the value by some steps, within what is allowed."""
        if self._about is None:
            return
        found = self._in_unit(self._wanted if self._wanted is not None else self._about.now)
        if found is None or not _is_number(found):
            return
        number = float(found.value)
        by = step_of(found)
        # To the next multiple of the step: 0.13 and a step of 0.1 are 0.2.
        turned = (
            round((number + steps * by) / by) * by if not isinstance(found.value, int) else number + steps
        )
        # Nine digits: a multiple of 0.1 without the last digits of its binary fraction.
        value: float | int = int(turned) if isinstance(found.value, int) else float(f"{turned:.9g}")
        self._wanted = Value(value, found.unit)
        self._fill()
        self._show_state()

    def press(self) -> None:
        """Want the value of the field in the control, where it can be written."""
        # Ctrl+Enter comes past the button, and must be off when it is.
        if self._about is not None and self._wanted is not None and self.write.isEnabled():
            self.write_requested.emit(self._about.address, self._wanted)

    def _ask_file(self) -> None:
        if self._about is not None:
            self.take_requested.emit(self._about.address)

    def put_back(self) -> None:
        """Want the value that was in the control before it was turned."""
        if self._about is not None and self._about.is_turned and self.back.isEnabled():
            self.back_requested.emit(self._about.address)


def _is_number(value: Value | None) -> bool:
    return value is not None and isinstance(value.value, (int, float)) and not isinstance(value.value, bool)


def step_of(value: Value) -> float:
    """Return by how much one step turns a number: a unit of its second digit; a whole number by 1."""
    number = abs(float(value.value))
    if isinstance(value.value, int):
        return 1.0
    return 10.0 ** (math.floor(math.log10(number)) - 1) if number > 0.0 else 0.1
