"""The tick that what can be dangerous was checked, for the changes that were shown when it was made."""

from __future__ import annotations

from PySide6.QtWidgets import QCheckBox

from .differences import DifferenceTable


class DangerCheck(QCheckBox):
    """It is taken back where a change can be dangerous that was not there when it was made."""

    def __init__(self, table: DifferenceTable) -> None:
        super().__init__()
        self._table = table
        self._about: frozenset[object] = frozenset()
        """The dangerous changes that the tick is about."""
        self.toggled.connect(self._tick)

    def _tick(self, is_on: bool) -> None:
        self._about = self._table.dangerous_changes() if is_on else frozenset()

    def forget_others(self) -> None:
        """Take the tick back where it is not about all that is listed."""
        if self.isChecked() and not self._table.dangerous_changes() <= self._about:
            self.setChecked(False)

    def show_count(self, count: int, *, can_send: bool) -> None:
        """Show how many statements of danger there are; nothing without one."""
        self.setVisible(count > 0 and can_send)
        self.setText(self.tr("I have checked what can be dangerous: %n", "", count))
