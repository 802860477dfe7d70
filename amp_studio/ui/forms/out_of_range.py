"""Questions about values out of range that came from a control."""

from __future__ import annotations

from PySide6.QtWidgets import QMessageBox, QWidget

from amp_studio.files import ParameterFile, RangeDecision
from amp_studio.schema import Address, write_value
from amp_studio.ui.base.questions import ask, show_message, type_text
from amp_studio.ui.base.translated import Translated


class AskInDialogs(Translated):
    """A person who decides about each value in a dialog."""

    def __init__(self, parent: QWidget) -> None:
        self._parent = parent

    def decide(self, problem: str) -> RangeDecision:
        """Ask whether to keep the value, to edit it or to quit."""
        answers: dict[str, RangeDecision] = {
            self.tr("&Continue checking"): "keep",
            self.tr("&Edit parameter"): "edit",
            self.tr("&Quit checking"): "quit",
        }
        icon = QMessageBox.Icon.Warning
        return answers[ask(self._parent, self.tr("Out of range"), f"{problem}.", *answers, icon=icon)]

    def new_value(self, file: ParameterFile, address: Address, problem: str) -> str | None:
        """Ask for another value; a secret is not shown."""
        parameter = file.schema.parameters[address[0]]
        old = "" if parameter.secret else write_value(parameter, file.get(address))
        title = self.tr("Edit parameter")
        return type_text(self._parent, title, problem, title, old, is_secret=parameter.secret)

    def refused(self, problem: str) -> None:
        """Show why the other value cannot be taken either."""
        show_message(self._parent, self.tr("Edit parameter"), f"{problem}.")
