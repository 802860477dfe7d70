"""What the page Live is made of: its widgets and where they lie. What they do is in the page."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QComboBox, QLabel, QPushButton, QSizePolicy, QWidget

from amp_studio.files import ParameterFile
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.theme import COLUMN_HEAD, GAP2, HEAD, ROW, font
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.control.rows import side_by_side
from amp_studio.ui.forms.elided_label import ElidedLabel
from amp_studio.ui.forms.message_bar import MessageBar
from amp_studio.ui.forms.segment import Segment
from amp_studio.ui.page.page_of_file import PageOfFile

from .recorder import LiveRecording
from .rows import LiveRows
from .sign import LiveSign
from .status_panel import NARROW, WIDE, LiveStatusPanel
from .write_frame import WriteFrame

_ROOMY = 1200
"""Width of a window with room for all words."""
FEW_ROWS, MIN_ROWS, MAX_ROWS, LOW = 4, 5, 8, 680
"""Rows that have room at least, at most in a page below so many pixels, and in a higher one."""


class LivePageParts(PageOfFile):
    """The values with the frame that writes one, the recorder below, and the status at the right."""

    def __init__(self, workspace: Workspace, present: Callable[[], ParameterFile | None]) -> None:
        """``present`` gives what the control contains, None while that is not known."""
        super().__init__()
        self._workspace = workspace
        self.setAccessibleName(self.tr("Live"))
        self.groups = QComboBox()
        self.groups.setAccessibleName(self.tr("Values that are listed"))
        self.groups.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.groups.setMinimumContentsLength(18)
        lock = LiveSign("lock-simple-fill", "dim")
        only = QLabel(self.tr("the table reads only"))
        only.setFont(font("small"))
        self.axes = Segment(self.tr("Axis"))
        self.bar = MessageBar()
        self.rows = LiveRows(workspace)
        self.reason = ElidedLabel()
        self.reason.setFont(font("small"))
        self.read = QPushButton(self.tr("&Read Values"))
        self.reason_row = side_by_side(HEAD, self.reason, None, self.read)
        self.frame = WriteFrame(workspace)
        self.panel = LiveStatusPanel(workspace.file.schema.family.family)
        self.recorder = LiveRecording(workspace, present)
        self.framed = QWidget()
        in_column(self.frame, on=self.framed, margins=GAP2)
        self.column = in_column(
            side_by_side(HEAD, self.groups, lock, only, None, self.axes),
            self.bar,
            (self.rows, 2),
            self.reason_row,
            self.framed,
            (self.recorder, 5),
            margins=0,
            gap=0,
        )
        in_row((self.column, 1), self.panel, on=self, margins=0, gap=0)
        self.setFocusProxy(self.rows)
        # Else a long name would keep the window wide.
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Ignored)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Leave the rows the room of the words in a small window."""
        super().resizeEvent(event)
        is_narrow = self.window().width() < _ROOMY
        rows = MAX_ROWS if self.height() > LOW else MIN_ROWS
        self.rows.setMaximumHeight(COLUMN_HEAD + rows * ROW + 2)
        self.rows.setMinimumHeight(COLUMN_HEAD + FEW_ROWS * ROW)
        self.panel.setFixedWidth(NARROW if is_narrow else WIDE)
        self.rows.show_short_words(is_narrow)
