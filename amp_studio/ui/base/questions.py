"""Messages and questions, each with the answers written on the buttons."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QInputDialog, QLineEdit, QMessageBox, QPushButton, QWidget

from .modal import run_dialog
from .theme import icon, severity_icon
from .translated import tr, without_number

Icon = QMessageBox.Icon
_SIDE = 24
"""Width and height of the icon of a box, in logical pixels."""


def show_message(parent: QWidget | None, title: str, text: str, kind: Icon = Icon.Warning) -> None:
    """Show a message and wait until it is closed."""
    box = QMessageBox(kind, title, without_number(text), QMessageBox.StandardButton.Close, parent)
    _show_icon(box, kind)
    run_dialog(box)


def _show_icon(box: QMessageBox, kind: Icon) -> None:
    """Show the icon of the same hand as in the window."""
    severity = {Icon.Critical: "error", Icon.Warning: "warning"}.get(kind, "information")
    box.setIconPixmap(
        (icon("question", "dim") if kind == Icon.Question else severity_icon(severity)).pixmap(_SIDE, _SIDE)
    )


def ask(
    parent: QWidget | None, title: str, text: str, *answers: str, default: int = 0, icon: Icon = Icon.Question
) -> str:
    """Return the text of the clicked button; Escape is the last one."""
    box = QMessageBox(icon, title, text, parent=parent)
    _show_icon(box, icon)
    roles = QMessageBox.ButtonRole
    buttons: list[QPushButton] = []
    for n, answer in enumerate(answers):
        role = roles.RejectRole if n == len(answers) - 1 else roles.ActionRole if n else roles.AcceptRole
        buttons.append(QPushButton(answer))
        box.addButton(buttons[-1], role)
    box.setDefaultButton(buttons[default])
    box.setEscapeButton(buttons[-1])
    run_dialog(box)
    clicked = box.clickedButton()
    return next((a for a, b in zip(answers, buttons, strict=True) if b is clicked), answers[-1])


def choose(
    parent: QWidget, title: str, label: str, names: Sequence[str], does: str, present: int = 0
) -> int | None:
    """Return which of some names is chosen, None where the person cancels; ``does`` is on the button."""
    box = _input_box(parent, title, label, does)
    box.setComboBoxItems(names)
    box.setTextValue(names[present])
    return names.index(box.textValue()) if run_dialog(box) else None


def type_text(
    parent: QWidget, title: str, label: str, does: str, text: str = "", *, is_secret: bool = False
) -> str | None:
    """Return what is typed, None where the person cancels; ``does`` is on the button."""
    box = _input_box(parent, title, label, does)
    box.setTextEchoMode(QLineEdit.EchoMode.Password if is_secret else QLineEdit.EchoMode.Normal)
    box.setTextValue(text)
    return box.textValue() if run_dialog(box) else None


def _input_box(parent: QWidget, title: str, label: str, does: str) -> QInputDialog:
    box = QInputDialog(parent)
    box.setWindowTitle(title)
    box.setLabelText(label)
    box.setOkButtonText(does)
    box.setCancelButtonText(tr("Cancel"))
    return box
