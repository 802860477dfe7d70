"""What of a program is seen: one limit alone, and the block that a person asks for."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QComboBox, QLineEdit

from amp_studio.sim import NOT_GOOD
from amp_studio.ui.base.translated import tr


class LimitFilter(QComboBox):
    """All of a program, one limit by its letter, or what is not good."""

    chosen = Signal(str)
    """The letter, `NOT_GOOD`, or "" for all."""

    def __init__(self) -> None:
        super().__init__()
        self.setAccessibleName(tr("Blocks that are seen"))
        self.setToolTip(tr("What of the path has its colour and is listed; 1 to 6, 7 and 0 do the same"))
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.setMinimumContentsLength(4)
        self.offer(())
        self.currentIndexChanged.connect(lambda _row: self.chosen.emit(self.letter))

    def offer(self, limits: Sequence[tuple[str, str]]) -> None:
        """Offer these limits, each a letter and a name; all blocks are seen."""
        with QSignalBlocker(self):
            self.clear()
            self.addItem(tr("All blocks"), "")
            for letter, name in limits:
                self.addItem(f"{letter} {name}", letter)
            self.addItem(tr("Not good"), NOT_GOOD)

    @property
    def letter(self) -> str:
        """What is chosen."""
        return str(self.currentData() or "")

    def choose(self, row: int) -> None:
        """Choose a row; 0 is all."""
        self.setCurrentIndex(row)

    def turn_to(self, letter: str) -> None:
        """Choose a letter, or all where it is chosen already."""
        row = self.findData(letter)
        if row >= 0:
            self.setCurrentIndex(0 if row == self.currentIndex() else row)


class GoToField(QLineEdit):
    """A line for the number of a block, which is there while it is asked for."""

    text_requested = Signal(str)

    def __init__(self) -> None:
        super().__init__()
        self.setAccessibleName(tr("Go to block or line"))
        self.setPlaceholderText(tr("Block N150, or line 150"))
        self.setMaxLength(20)
        self.returnPressed.connect(self._emit_text)
        self.hide()

    def begin(self) -> None:
        """Ask for a number."""
        self.show()
        self.selectAll()
        self.setFocus()

    def _emit_text(self) -> None:
        self.hide()
        self.text_requested.emit(self.text())
