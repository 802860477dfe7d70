"""The recorded exchanges of a file: who put what into which control, and what that changed."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialog, QHeaderView, QLabel, QTreeWidget, QTreeWidgetItem, QVBoxLayout, QWidget

from amp_studio.files import day_and_time, real_path, text_of_name
from amp_studio.ui.base.translated import counted, worded
from amp_studio.ui.base.workspace import Workspace


class ExchangesDialog(QDialog):
    """Lists the exchanges, the newest first; under each the parameters that it changed."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        from amp_studio.transfer.client import read_exchanges

        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(self.tr("Exchanges — {name}").format(name=workspace.path.name))
        self.resize(980, 480)
        path = real_path(workspace.path)
        found = read_exchanges(path.parent, text_of_name(path.name))
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
        for each in reversed(found):
            digests = (each.before[:12], each.after[:12])
            item = QTreeWidgetItem(
                [
                    day_and_time(each.when),
                    each.who,
                    worded(each.verb),
                    each.control,
                    *digests,
                    worded(each.text),
                ]
            )
            kept = self.tr("\nKept copy: {kept}").format(kept=each.kept) if each.kept else ""
            item.setToolTip(6, each.text + kept)
            for param, old, new in each.changes:
                item.addChild(
                    QTreeWidgetItem(["", "", "", param, old or self.tr("not set"), new or self.tr("not set")])
                )
            self.tree.addTopLevelItem(item)
        for column in range(6):
            self.tree.header().setSectionResizeMode(column, QHeaderView.ResizeMode.ResizeToContents)
        count = counted(len(found), "exchange", none="no")
        text = QLabel(self.tr("{upper}{what} recorded in {parent}. Control > Restore Control From Backup puts a kept copy back.").format(upper=count[:1].upper(), what=count[1:], parent=path.parent))  # fmt: skip
        text.setWordWrap(True)
        layout = QVBoxLayout(self)
        layout.addWidget(text)
        layout.addWidget(self.tree)
        workspace.closed.connect(self.close)
