"""The recorded exchanges of a file: who put what into which control, what that changed,
and the backup to go back to.
"""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import QHeaderView, QPushButton, QSizePolicy, QTreeWidget, QTreeWidgetItem, QWidget

from amp_studio.files import real_path, text_of_name
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.theme import ROW
from amp_studio.ui.base.time_words import in_words
from amp_studio.ui.base.translated import counted, message_in_words, worded
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.elided_label import ElidedLabel

from .rows import FOOT, side_by_side

_KEPT = Qt.ItemDataRole.UserRole


class ExchangeHistory(QWidget):
    """Lists the exchanges, the newest first; under each the parameters that it changed."""

    restore_requested = Signal(Path)
    """The backup that an exchange made is to be put back."""

    def __init__(self) -> None:
        super().__init__()
        self.tree = QTreeWidget()
        self.tree.setHeaderLabels(
            [
                self.tr("When"),
                self.tr("Who"),
                self.tr("Exchange"),
                self.tr("Control"),
                self.tr("Before"),
                self.tr("After"),
                self.tr("How it ended"),
            ]
        )
        self.tree.setUniformRowHeights(True)
        self.tree.setAccessibleName(self.tr("Recorded exchanges"))
        for column in range(6):
            self.tree.header().setSectionResizeMode(column, QHeaderView.ResizeMode.ResizeToContents)
        self.tree.currentItemChanged.connect(self._follow)
        self.text = ElidedLabel()
        self.text.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        self.restore = QPushButton(self.tr("Restore What It Replaced…"))
        self.restore.clicked.connect(self._restore)
        in_column((self.tree, 1), side_by_side(FOOT, self.text, self.restore), on=self, margins=0, gap=0)
        self.setFocusProxy(self.tree)

    def show_file(self, workspace: Workspace) -> None:
        """List what is recorded beside a file."""
        from amp_studio.transfer.client import read_exchanges

        path = real_path(workspace.path)
        found = read_exchanges(path.parent, text_of_name(path.name))
        self.tree.clear()
        for each in reversed(found):
            item = QTreeWidgetItem(
                [
                    _when(each.when),
                    each.who,
                    worded(each.verb),
                    each.control,
                    each.before[:12],
                    each.after[:12],
                    _ending(each.text),
                ]
            )
            # In one column: rows of a tree are as high as their highest cell.
            item.setSizeHint(6, QSize(0, ROW))
            kept = self.tr("\nKept copy: {kept}").format(kept=each.kept) if each.kept else ""
            item.setToolTip(6, _ending(each.text) + kept)
            item.setData(0, _KEPT, str(path.parent / each.kept) if each.kept else "")
            for param, old, new in each.changes:
                sides = [old or self.tr("not set"), new or self.tr("not set")]
                item.addChild(QTreeWidgetItem(["", "", "", param, *sides]))
            self.tree.addTopLevelItem(item)
        count = counted(len(found), "exchange", none="no")
        self.text.setText(
            self.tr("{upper}{what} recorded in {parent}.").format(
                upper=count[:1].upper(), what=count[1:], parent=path.parent
            )
        )
        if (first := self.tree.topLevelItem(0)) is not None:
            self.tree.setCurrentItem(first)
        self._follow()

    def _backup(self) -> str:
        """Return the path of the backup of the selected exchange; empty for none that is still there."""
        item = self.tree.currentItem()
        # A changed parameter is below its exchange, whose backup it is.
        item = item.parent() or item if item is not None else None
        kept: str = item.data(0, _KEPT) or "" if item is not None else ""
        # It may have been deleted since: the button is off then.
        return kept if kept and Path(kept).is_file() else ""

    def _follow(self, *_: object) -> None:
        self.restore.setEnabled(bool(self._backup()))

    def _restore(self) -> None:
        if kept := self._backup():
            self.restore_requested.emit(Path(kept))


def _when(stamp: str) -> str:
    """Return a recorded time in words; what is no time stays as it is."""
    try:
        moment = datetime.fromisoformat(stamp).astimezone()
    except (ValueError, OverflowError, OSError):
        return stamp
    return in_words(moment, datetime.now(UTC).astimezone())


def _ending(text: str) -> str:
    """Return how an exchange ended, which a title or a message words."""
    return worded(message_in_words(text))
