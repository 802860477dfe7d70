"""What a paste would change, value by value, and what of it is refused and why, before anything changes."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QBrush
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QHeaderView,
    QLabel,
    QTreeWidget,
    QTreeWidgetItem,
    QWidget,
)

from amp_studio.files import BlockEntry, EnteredCell
from amp_studio.ui.base.figures import show_value
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.theme import GAP2, GAP3, colour, font, icon, severity_icon
from amp_studio.ui.base.workspace import Workspace

_MAX_LISTED = 1_000


class BlockPreview(QDialog):
    """Lists the changes and the refusals; accepted, the values that can be set are to be set."""

    def __init__(
        self, workspace: Workspace, entry: BlockEntry, left_out: list[str], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._workspace = workspace
        self.setWindowTitle(self.tr("Paste from a Spreadsheet"))
        self.resize(640, 420)
        changes, refused = len(entry.changed), len(entry.refused)
        summary = [
            self.tr("%n cells", "", len(entry.cells)) + ": " + self.tr("%n change", "", changes),
            self.tr("%n the same", "", entry.same),
            self.tr("%n refused", "", refused),
        ]
        self.summary = QLabel(", ".join(summary))
        self.summary.setFont(font("title"))
        self.list = QTreeWidget()
        self.list.setHeaderLabels([self.tr("Value"), self.tr("Now"), self.tr("Becomes")])
        self.list.setRootIsDecorated(False)
        self.list.setUniformRowHeights(True)
        self.list.setAccessibleName(self.tr("Changes"))
        # Refusals first: they must not be beyond the end of a list that is cut.
        for cell in [*entry.refused, *(c for c in entry.cells if c.changes)][:_MAX_LISTED]:
            self._add(cell)
        head = self.list.header()
        head.setSectionResizeMode(0, QHeaderView.ResizeMode.ResizeToContents)
        head.setSectionResizeMode(1, QHeaderView.ResizeMode.ResizeToContents)
        head.setSectionResizeMode(2, QHeaderView.ResizeMode.Stretch)
        self.buttons = QDialogButtonBox()
        cancel = self.buttons.addButton(self.tr("Cancel"), QDialogButtonBox.ButtonRole.RejectRole)
        self.paste = self.buttons.addButton(
            self.tr("&Paste %n", "", changes), QDialogButtonBox.ButtonRole.AcceptRole
        )
        self.paste.setEnabled(changes > 0)
        self.paste.setDefault(changes > 0)
        cancel.setAutoDefault(False)
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        layout = in_column(self.summary, on=self, margins=GAP3, gap=GAP2)
        if left_out:
            note = QLabel(" ".join(left_out[:3]) + (" …" if len(left_out) > 3 else ""))
            note.setWordWrap(True)
            layout.addWidget(note)
        layout.addWidget(self.list)
        layout.addWidget(self.buttons)

    def _add(self, cell: EnteredCell) -> None:
        parameter = self._workspace.file.schema.parameters[cell.address[0]]
        secrets = self._workspace.secrets
        was = show_value(parameter, cell.old, secrets=secrets)
        becomes = cell.problem or show_value(parameter, cell.new, secrets=secrets)
        item = QTreeWidgetItem([self._workspace.name_of(cell.address), was, becomes])
        item.setIcon(0, severity_icon("error") if cell.problem else icon("check"))
        item.setToolTip(2, becomes)
        if cell.problem:
            item.setForeground(2, QBrush(colour("error")))
        else:
            item.setFont(2, font("text", own=True))
            item.setForeground(1, QBrush(colour("dim")))
        item.setData(0, Qt.ItemDataRole.UserRole, cell.address)
        self.list.addTopLevelItem(item)
