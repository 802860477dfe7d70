"""The status bar: the selected cells at the left; findings,
open values and the state of the file at the right.
"""

from __future__ import annotations

from PySide6.QtCore import QObject, QRect, QSize, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QLabel, QStatusBar, QToolButton, QWidget

from amp_studio.files import fitted_axes
from amp_studio.report import severity_name
from amp_studio.ui.base.theme import GAP2, GAP3, SMALL_ICON, STATUS, font, icon, severity_icon
from amp_studio.ui.base.translated import worded
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.elided_label import ElidedLabel
from amp_studio.validate import SEVERITIES, addresses_not_set

_INDENT = 6
"""Pixels left and right of a message."""


class StatusBar(QStatusBar):
    """A status bar whose message ends with … where there is no room; the tooltip has the whole."""

    def __init__(self) -> None:
        super().__init__()
        self.messageChanged.connect(self.setToolTip)

    @property
    def _room(self) -> QRect:
        # The message is in the place of what is hidden while it is there: up to what stays at the right.
        staying = self.findChildren(QWidget, options=Qt.FindChildOption.FindDirectChildrenOnly)
        right = min((each.x() for each in staying if each.isVisible()), default=self.width())
        return self.rect().adjusted(_INDENT, 0, right - self.width() - _INDENT, 0)

    def elided(self) -> str:
        """Return the message as it is painted."""
        line = self.currentMessage().replace("\n", " ")
        return self.fontMetrics().elidedText(line, Qt.TextElideMode.ElideRight, self._room.width())

    def paintEvent(self, event: QPaintEvent) -> None:
        if not self.currentMessage():
            super().paintEvent(event)
            return
        painter = QPainter(self)
        painter.setPen(self.palette().color(self.foregroundRole()))
        painter.drawText(
            self._room, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, self.elided()
        )


class StatusLine(QObject):
    """The state of the file in front, in words and icons; a click on a count shows the findings."""

    findings_requested = Signal()
    """A count was clicked."""
    not_set_requested = Signal()
    """The count of the values that are not set was clicked."""

    def __init__(self, bar: QStatusBar) -> None:
        super().__init__(bar)
        bar.setMinimumHeight(STATUS)
        bar.setSizeGripEnabled(False)
        bar.setContentsMargins(GAP3, 0, GAP3, 0)
        self.value, self.file, self.changes, self.control = QLabel(), ElidedLabel(), QLabel(), QLabel()
        self.value.setAccessibleName(self.tr("Selected values"))
        self.file.setAccessibleName(self.tr("File"))
        self.changes.setAccessibleName(self.tr("Unsaved changes"))
        self.control.setAccessibleName(self.tr("Control"))
        bar.addWidget(self.value, 1)
        self.counts = {
            severity: self._count(icon_of)
            for severity, icon_of in [(s, severity_icon(s)) for s in SEVERITIES]
        }
        self.not_set = self._count(icon("circle-dashed", "dim"))
        self.not_set.clicked.disconnect(self.findings_requested)
        self.not_set.clicked.connect(self.not_set_requested)
        for widget in (*self.counts.values(), self.not_set, self.changes, self.file, self.control):
            widget.setFont(font("small"))
            bar.addPermanentWidget(widget)
            if isinstance(widget, QLabel):
                widget.setContentsMargins(GAP2, 0, GAP2, 0)
        self.value.setFont(font("small"))

    def _count(self, picture: object) -> QToolButton:
        button = QToolButton()
        button.setIcon(picture)  # type: ignore[arg-type]  # an icon
        button.setIconSize(QSize(SMALL_ICON, SMALL_ICON))
        button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        button.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # Ctrl+4 goes there
        button.clicked.connect(self.findings_requested)
        return button

    def show_control(self, control: str) -> None:
        """Show the control of the file and its state in words; nothing for none."""
        self.control.setText(control)
        self.control.setVisible(bool(control))

    def show_file(self, workspace: Workspace | None) -> None:
        """Show the state of a file, or nothing."""
        # Each label that comes or goes has the bar laid out again: none is shown only to be hidden.
        if workspace is None:
            for widget in (*self.counts.values(), self.not_set, self.changes, self.file):
                widget.hide()
            self.file.clear()
            return
        self.file.show()
        for severity, button in self.counts.items():
            number = workspace.count(severity)
            self._show(button, number, worded(severity_name(severity)))
        self._show(self.not_set, len(addresses_not_set(workspace.findings)), self.tr("not set"))
        self.not_set.setText(
            self.tr("{number} not set").format(number=len(addresses_not_set(workspace.findings)))
        )
        file = workspace.file
        count = workspace.changes()
        self.changes.setText(self.tr("%n unsaved changes", "", count) if count else "")
        self.changes.setVisible(bool(count))
        units = self.tr("as entered") if workspace.as_entered else worded(file.header.units)
        parts = [file.schema.family.name, file.schema.family.machine_name(file.machine)]
        if file.schema.family.axes is not None:
            parts.append(self.tr("%n axes", "", len(fitted_axes(file))))
        state = self.tr("not saved") if workspace.is_dirty else self.tr("saved")
        parts += [units, state if workspace.may_edit else self.tr("read-only")]
        self.file.setText(", ".join(parts))

    def _show(self, button: QToolButton, number: int, noun: str) -> None:
        text = self.tr("{number} {noun}").format(number=number, noun=noun)
        button.setText(str(number))
        button.setVisible(number > 0)
        button.setToolTip(text)
        button.setAccessibleName(text)
