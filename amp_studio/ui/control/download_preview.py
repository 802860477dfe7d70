"""What a download or a restore changes in the control, shown before it starts."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import (
    QDialog,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QScrollArea,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from amp_studio.files import Comparison, ParameterFile
from amp_studio.report import dangers_of_change
from amp_studio.report.model import Danger
from amp_studio.ui.base.figures import show_value
from amp_studio.ui.base.hazard import hazard_html
from amp_studio.ui.base.translated import tr, worded


class DifferenceList(QTreeWidget):
    """One row for each value that differs: parameter, axis, kind of difference and both values."""

    def __init__(self, file: ParameterFile, found: Comparison, *, secrets: bool) -> None:
        super().__init__()
        self.setHeaderLabels(
            [
                self.tr("Parameter"),
                self.tr("Axis"),
                self.tr("Difference"),
                self.tr("This file"),
                self.tr("The control"),
            ]
        )
        self.setAccessibleName(self.tr("Differences"))
        self.setRootIsDecorated(False)
        self.setUniformRowHeights(True)
        self.setAlternatingRowColors(True)
        schema, machine = file.schema, file.machine
        self.items = [
            QTreeWidgetItem([
                schema.on(machine).label(difference.address),
                worded(schema.on(machine).instance_label(difference.address)),
                self.tr("not in this file") if difference.a is None else self.tr("only in this file") if difference.b is None else self.tr("different"),
                *(show_value(schema.parameters[difference.address[0]], v, secrets=secrets)
                  for v in difference.in_one_unit()),
            ])
            for difference in found.differences
        ]  # fmt: skip
        self.addTopLevelItems(self.items)
        for column, width in enumerate((290, 70, 105, 190, 190)):
            self.setColumnWidth(column, width)


def counts(found: Comparison) -> str:
    """Return the counts of a comparison with a control in a sentence."""
    different = len(found.differences) - found.not_set_in_a - found.not_set_in_b
    not_set = tr("{a} not set in this file, {b} not set in the control").format(
        a=found.not_set_in_a, b=found.not_set_in_b
    )
    return tr("{different} different, {same} the same, {not_set}.").format(
        different=different, same=found.same, not_set=not_set
    )


class DownloadPreview(QDialog):
    """Shows what a download or a restore changes in the control, and asks before it starts."""

    def __init__(
        self,
        file: ParameterFile,
        found: Comparison,
        parent: QWidget | None = None,
        *,
        secrets: bool = False,
        title: str = "",
    ) -> None:
        super().__init__(parent)
        title = title or self.tr("Download")
        self.setWindowTitle(title)
        self.resize(900, 500)
        text = QLabel(self.tr("{counts} The download replaces all parameters in the control. Values that are not set in this file are not sent. The control's present parameters are saved beside the file first.\n\nThe control must be in E-stop.").format(counts=counts(found)))  # fmt: skip
        text.setWordWrap(True)
        self.list = DifferenceList(file, found, secrets=secrets)
        self.send, cancel = QPushButton(f"&{title}"), QPushButton(self.tr("Cancel"))
        self.send.setDefault(True)
        self.send.clicked.connect(self.accept)
        cancel.clicked.connect(self.reject)
        buttons = QHBoxLayout()
        buttons.addStretch()
        buttons.addWidget(self.send)
        buttons.addWidget(cancel)
        layout = QVBoxLayout(self)
        layout.addWidget(text)
        layout.addWidget(self.list, 2)
        if dangers := dangers_of_change(file, found.differences):
            layout.addWidget(self._dangers(dangers), 1)
        layout.addLayout(buttons)

    def _dangers(self, dangers: Sequence[Danger]) -> QWidget:
        """Return what the manual calls dangerous about the values that change, one line each; it scrolls where they are many."""
        self.dangers = QLabel(hazard_html("danger", *(danger.line for danger in dangers)))
        self.dangers.setWordWrap(True)
        self.dangers.setAccessibleName(self.tr("Dangers of the values that change"))
        area = QScrollArea()
        area.setWidgetResizable(True)
        area.setFrameShape(QScrollArea.Shape.NoFrame)
        area.setWidget(self.dangers)
        area.setAccessibleName(self.tr("Dangers of the values that change"))
        return area
