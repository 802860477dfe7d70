"""Messages and questions, each with the answers written on the buttons."""

from __future__ import annotations

from PySide6.QtWidgets import QMessageBox, QPushButton, QWidget

Icon = QMessageBox.Icon


def show_message(parent: QWidget | None, title: str, text: str, icon: Icon = Icon.Warning) -> None:
    """Show a message and wait until it is closed."""
    QMessageBox(icon, title, text, QMessageBox.StandardButton.Ok, parent).exec()


def ask(
    parent: QWidget | None, title: str, text: str, *answers: str, default: int = 0, icon: Icon = Icon.Question
) -> str:
    """Return the text of the clicked button; Escape is the last one."""
    box = QMessageBox(icon, title, text, parent=parent)
    roles = QMessageBox.ButtonRole
    buttons: list[QPushButton] = []
    for n, answer in enumerate(answers):
        role = roles.RejectRole if n == len(answers) - 1 else roles.ActionRole if n else roles.AcceptRole
        buttons.append(QPushButton(answer))
        box.addButton(buttons[-1], role)
    box.setDefaultButton(buttons[default])
    box.setEscapeButton(buttons[-1])
    box.exec()
    clicked = box.clickedButton()
    return next((a for a, b in zip(answers, buttons, strict=True) if b is clicked), answers[-1])
