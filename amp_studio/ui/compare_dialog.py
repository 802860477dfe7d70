"""The list of differences between the open file and another one, or a control."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialog, QLabel, QPushButton, QTreeWidget, QTreeWidgetItem, QVBoxLayout, QWidget

from amp_studio.files import Comparison
from amp_studio.schema import Address, show_value

from .workspace import Workspace


class CompareDialog(QDialog):
    """Shows what differs; ticked rows can be taken over as one step."""

    def __init__(self, workspace: Workspace, found: Comparison, other: str, show: Callable[[Address], None],
                 parent: QWidget | None = None) -> None:  # fmt: skip
        super().__init__(parent)
        self.setWindowTitle(f"Compare with {other}")
        self.resize(760, 480)
        self._workspace, self._found, self._show = workspace, found, show
        file = workspace.file
        self.list = QTreeWidget()
        self.list.setHeaderLabels(["Parameter", "Instance", "Open file", other])
        for difference in found.differences:
            parameter = file.schema.parameters[difference.address[0]]
            item = QTreeWidgetItem([
                file.schema.label(difference.address, file.machine),
                file.schema.instance_label(difference.address, file.machine),
                show_value(parameter, difference.a) if difference.a is not None else "absent",
                show_value(parameter, difference.b) if difference.b is not None else "absent",
            ])  # fmt: skip
            item.setData(0, Qt.ItemDataRole.UserRole, difference)
            item.setCheckState(0, Qt.CheckState.Unchecked)
            self.list.addTopLevelItem(item)
        for column, width in enumerate((290, 80, 170, 170)):
            self.list.setColumnWidth(column, width)
        self.list.itemDoubleClicked.connect(lambda item, _: show(item.data(0, Qt.ItemDataRole.UserRole).address))
        take = QPushButton("&Take the ticked values of the other side")
        take.clicked.connect(self.take)
        take.setEnabled(workspace.document.is_locked and bool(found.differences))
        layout = QVBoxLayout(self)
        layout.addWidget(QLabel(
            f"{len(found.differences)} differ, {found.same} are the same, {found.absent_in_a} are absent in the open file, "
            f"{found.absent_in_b} absent in {other}."
        ))  # fmt: skip
        layout.addWidget(self.list)
        layout.addWidget(take)

    def take(self) -> None:
        """Take the ticked values into the open file as one step."""
        ticked = [self.list.topLevelItem(n) for n in range(self.list.topLevelItemCount())]
        wanted = {d.address: d.b for i in ticked if i.checkState(0) == Qt.CheckState.Checked
                  for d in [i.data(0, Qt.ItemDataRole.UserRole)]}  # fmt: skip
        if wanted:
            self._workspace.edit("Take values", wanted)
            self.accept()
