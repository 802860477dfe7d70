"""Boxes for a number with arrows, which read as every other field does: Qt's own take 0.5 for 5 in German
and 0,5 for 5 in English, because the sign of the other language parts groups or is swallowed.
"""

from PySide6.QtGui import QValidator
from PySide6.QtWidgets import QDoubleSpinBox, QSpinBox

from amp_studio.schema import InvalidValueError, read_number

_State = QValidator.State


def _read(box: QSpinBox | QDoubleSpinBox, text: str) -> float | None:
    """Return the number of a text with the suffix of its box or without; None for what it does not take."""
    try:
        number, rest = read_number(text.removesuffix(box.suffix()))
    except InvalidValueError:
        return None
    is_taken = not rest.strip() and box.minimum() <= number <= box.maximum()
    return number if is_taken and (isinstance(box, QDoubleSpinBox) or number.is_integer()) else None


class NumberBox(QDoubleSpinBox):
    """A box for a number with decimals, with either decimal sign."""

    def validate(self, text: str, at: int) -> tuple[QValidator.State, str, int]:
        # Never Invalid: Qt would swallow the key, and 0,5 be 05.
        return _State.Intermediate if _read(self, text) is None else _State.Acceptable, text, at

    def valueFromText(self, text: str) -> float:
        number = _read(self, text)
        return self.value() if number is None else round(number, self.decimals())


class WholeBox(QSpinBox):
    """A box for a whole number: what has decimals is not taken, and the number before stays."""

    def __init__(self) -> None:
        super().__init__()
        # Else 0 would be the number before 0,5, and each digit that is typed a step of Undo.
        self.setKeyboardTracking(False)

    def validate(self, text: str, at: int) -> tuple[QValidator.State, str, int]:
        return _State.Intermediate if _read(self, text) is None else _State.Acceptable, text, at

    def fixup(self, text: str) -> str:
        return text  # Qt's would take the sign out: 0.5 and 05

    def valueFromText(self, text: str) -> int:
        number = _read(self, text)
        return self.value() if number is None else int(number)
