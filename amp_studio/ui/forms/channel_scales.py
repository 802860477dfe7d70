"""The channels of a recorder in a table: which are drawn, how much a division is, and what is half way up."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import replace

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QHeaderView, QTableWidget

from amp_studio.drawing import Picture, Scene, figure_text, linked, on_divisions, round_divisions
from amp_studio.schema import read_bare_number, unit_text
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.translated import unit_in_words, worded

from .table_items import item_at

_NAME, _PER, _MIDDLE, _UNIT = range(4)


class ChannelScales(QTableWidget):
    """What is ticked and typed of a channel stays while the others change."""

    rescaled = Signal()
    """The picture is the same on other scales."""

    def __init__(
        self,
        *,
        is_divided: bool = False,
        unticked: Callable[[Collection[str]], Collection[str]] = lambda _: (),
    ) -> None:
        """``is_divided`` is a channel without a scale on round divisions too; ``unticked`` gives those of the
        channels that are not drawn at first.
        """
        super().__init__(0, 4)
        self._is_divided, self._unticked = is_divided, unticked
        self.setAccessibleName(self.tr("Channels"))
        self.setHorizontalHeaderLabels(
            [self.tr("Channel"), self.tr("Per division"), self.tr("Middle"), self.tr("Unit")]
        )
        self.setTabKeyNavigation(False)  # Tab leaves the table, arrows go through it
        self.verticalHeader().hide()
        self.horizontalHeader().setSectionResizeMode(_NAME, QHeaderView.ResizeMode.Stretch)
        self.itemChanged.connect(lambda _: self.rescaled.emit())

    def scaled(self, picture: Picture) -> Picture:
        """Return a picture with the channels that are ticked, each on its scale, which is in its title; the
        table follows the picture.
        """
        self._offer([(panel.title, panel.y.unit) for panel in picture.panels])
        rows = range(len(picture.panels))
        panels = [self._on_scale(row, picture.panels[row]) for row in rows if self._is_ticked(row)]
        # With no channel ticked there is still one: an empty picture has no scale to come back from.
        return replace(picture, panels=linked(panels or picture.panels[:1]))

    def _on_scale(self, row: int, panel: Scene) -> Scene:
        unit = unit_text(self._channel(row)[1])
        per, middle = (_number(item_at(self, row, n).text(), unit) for n in (_PER, _MIDDLE))
        if not per and not self._is_divided:
            return panel
        drawn = on_divisions(panel, per, middle or 0.0) if per else round_divisions(panel)
        figure = " ".join(filter(None, (written(figure_text(drawn.y.step)), unit_in_words(panel.y.unit))))
        return replace(drawn, subtitle=self.tr("{figure} per division").format(figure=figure))

    def _is_ticked(self, row: int) -> bool:
        return item_at(self, row, _NAME).checkState() == Qt.CheckState.Checked

    def _offer(self, channels: list[tuple[str, str]]) -> None:
        # The same channels: what the user ticked and typed stays.
        here = range(self.rowCount())
        if [self._channel(row) for row in here] == channels:
            return
        ticks = {self._channel(row): item_at(self, row, _NAME).checkState() for row in here}
        scales = {self._channel(row): [item_at(self, row, n).text() for n in (_PER, _MIDDLE)] for row in here}
        # Qt emits itemChanged for what the program writes too: each cell would draw the picture again.
        with QSignalBlocker(self):
            self.setRowCount(len(channels))
            unticked = self._unticked([title for title, _ in channels])
            for row, (title, unit) in enumerate(channels):
                usual = Qt.CheckState.Unchecked if title in unticked else Qt.CheckState.Checked
                name = item_at(self, row, _NAME)
                name.setText(worded(title))
                name.setData(Qt.ItemDataRole.UserRole, title)
                name.setFlags(
                    Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable | Qt.ItemFlag.ItemIsUserCheckable
                )
                name.setCheckState(ticks.get((title, unit), usual))
                texts = scales.get((title, unit), ["", ""])
                for column, text in zip((_PER, _MIDDLE), texts, strict=True):
                    item_at(self, row, column).setText(text)
                of_unit = item_at(self, row, _UNIT)
                of_unit.setText(unit_in_words(unit))
                of_unit.setData(Qt.ItemDataRole.UserRole, unit)
                of_unit.setFlags(Qt.ItemFlag.ItemIsEnabled)

    def _channel(self, row: int) -> tuple[str, str]:
        role = Qt.ItemDataRole.UserRole
        return str(item_at(self, row, _NAME).data(role)), str(item_at(self, row, _UNIT).data(role))


def _number(text: str, unit: str) -> float | None:
    """Return the number of a cell; None where there is none."""
    try:
        return read_bare_number(text, unit) if text.strip() else None
    except ValueError:
        return None
