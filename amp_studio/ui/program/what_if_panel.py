"""A program with other values: what each change brings, and what those that are ticked bring together."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QLabel, QPushButton, QTableWidgetItem, QWidget

from amp_studio.schema import Address, Value
from amp_studio.sim import path_error_text, path_error_unit, value_text
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.theme import GAP, GAP2, font
from amp_studio.ui.base.translated import unit_in_words

from .tables import TableLook, fill, read_table

Values = Mapping[Address, Value]


_ABOVE = "\u26a0 "
"""Before an error that is above one's own limit."""


def effect(found: Mapping[str, Any], length: str, limit: float = math.inf) -> tuple[str, str, str]:
    """Return time, its change and that of the largest contour error of a try, as they are shown."""
    error = found.get("contour_error_change", {}).get("value")
    mark = _ABOVE if found.get("contour_error", {}).get("value", 0.0) > limit else ""
    return (
        written(f"{found['time']['value']:.4g}"),
        written(f"{100.0 * found['time_change']:+.1f}"),
        "" if error is None else mark + written(f"{path_error_unit(length)[1] * error:+.3g}"),
    )


class WhatIfPanel(QWidget):
    """Rows of changes; the ones that are ticked are computed together by who listens to ``ticked``."""

    ticked = Signal()
    applied = Signal()

    def __init__(self) -> None:
        super().__init__()
        self._length = "mm"
        self._limit = math.inf
        self._values: list[Values | None] = []
        self._found: list[Mapping[str, Any]] = []
        self.table = read_table(
            self.tr("What if"),
            (self.tr("What if"), self.tr("s"), self.tr("%"), ""),
            TableLook(figures=(1, 2, 3)),
        )
        self.table.itemChanged.connect(self._changed)
        self.show_lengths_in("mm")
        self.together = QLabel()
        self.together.setFont(font("text", own=True))
        self.together.setWordWrap(True)
        self.limits_button = QPushButton(self.tr("Try What Li&mits"))
        self.limits_button.setToolTip(
            self.tr("Compute the program with 20 % more of each parameter that limits it")
        )
        self.earlier_button = QPushButton(self.tr("&Earlier Versions"))
        self.earlier_button.setToolTip(
            self.tr("Compute the program under the file as it was before its last saves")
        )
        self.apply_button = QPushButton(self.tr("&Apply to File"))
        self.apply_button.setToolTip(self.tr("Take the ticked values into the file, as one step"))
        self.apply_button.clicked.connect(self.applied)
        self.clear_button = QPushButton(self.tr("C&lear"))
        self.clear_button.clicked.connect(self.clear)
        pairs = (self.limits_button, self.earlier_button), (self.apply_button, self.clear_button)
        rows = (in_row(*pair, 1, gap=GAP) for pair in pairs)
        in_column((self.table, 1), self.together, *rows, on=self, margins=0, gap=GAP2)
        self._show_buttons()

    # -- rows ------------------------------------------------------------------------

    def add(self, change: str, values: Values | None, found: Mapping[str, Any], *, is_ticked: bool) -> None:
        """Add a change with its effect; one without values, an earlier version, is not ticked."""
        # Qt emits itemChanged for each cell that is filled: the first ones come before the row has its
        # values.
        with QSignalBlocker(self.table):
            fill(self.table, [(change, *effect(found, self._length, self._limit))], add=True)
            self._values.append(values)
            self._found.append(found)
            if values is not None:
                item = self.table.item(self.table.rowCount() - 1, 0)
                item.setFlags(item.flags() | Qt.ItemFlag.ItemIsUserCheckable)
                item.setCheckState(Qt.CheckState.Checked if is_ticked else Qt.CheckState.Unchecked)
        self._show_buttons()

    def show_lengths_in(self, length: str) -> None:
        """Show the errors of the tries to come in the unit of a file, whose length is in ``mm`` or ``in``."""
        self._length = length
        unit = unit_in_words(path_error_unit(length)[0])
        self.table.horizontalHeaderItem(3).setText(self.tr("Error, {unit}").format(unit=unit))

    def judge_by(self, limit: float) -> None:
        """Mark the tries whose largest contour error is above one's own limit in mm."""
        self._limit = limit
        with QSignalBlocker(self.table):
            for row, found in enumerate(self._found):
                self.table.item(row, 3).setText(effect(found, self._length, limit)[2])

    def clear(self) -> None:
        """Forget all changes."""
        self._values, self._found = [], []
        self.table.setRowCount(0)
        self.together.clear()
        self._show_buttons()

    def chosen(self) -> Sequence[Values]:
        """Return the values of the ticked rows; a later one of the same parameter counts."""
        return [values for n, values in enumerate(self._values) if values is not None and self._is_ticked(n)]

    def values(self) -> Values:
        """Return the ticked values together."""
        return {address: value for values in self.chosen() for address, value in values.items()}

    def show_together(self, found: Mapping[str, Any]) -> None:
        """Show what the ticked changes bring together."""
        time = written(value_text(found["time"]["value"], "s", 4))
        text = self.tr("Ticked together: {time}, {share} %").format(
            time=time, share=effect(found, self._length)[1]
        )
        if "contour_error" in found:
            error = written(path_error_text(found["contour_error"]["value"], self._length))
            text += "; " + self.tr("largest contour error {error}").format(error=error)
        self.together.setText(text)

    def _is_ticked(self, row: int) -> bool:
        return self.table.item(row, 0).checkState() == Qt.CheckState.Checked

    def _changed(self, _item: QTableWidgetItem) -> None:
        self.together.clear()
        self._show_buttons()
        self.ticked.emit()

    def _show_buttons(self) -> None:
        count = len(self.values())
        text = self.tr("&Apply %n to File", "", count) if count else self.tr("&Apply to File")
        self.apply_button.setText(text)
        self.apply_button.setEnabled(bool(count))
        self.clear_button.setEnabled(bool(self._values))
