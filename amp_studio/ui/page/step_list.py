"""The steps that were made since the file was opened, in words; a click goes back to one, or forward
again.
"""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QDialog, QLabel, QUndoView, QWidget

from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.theme import GAP, GAP2, GAP3, SMALL_ICON, icon
from amp_studio.ui.base.workspace import Workspace


class StepList(QDialog):
    """The undo stack of a file; it closes with the file."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(self.tr("Steps: {name}").format(name=workspace.path.name))
        self.resize(460, 420)
        self.view = QUndoView(workspace.undo_stack)
        self.view.setEmptyLabel(self.tr("As opened"))
        self.view.setCleanIcon(icon("floppy-disk"))
        self.view.setIconSize(QSize(SMALL_ICON, SMALL_ICON))
        self.view.setUniformItemSizes(True)
        self.view.setSpacing(GAP // 2)
        self.view.setAccessibleName(self.tr("Steps"))
        self.view.setEnabled(workspace.may_edit)
        in_column(
            QLabel(self.tr("Select a step to go back to it, or forward again.")),
            self.view,
            on=self,
            margins=GAP3,
            gap=GAP2,
        )
        workspace.closed.connect(self.close)
