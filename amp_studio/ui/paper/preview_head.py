"""The head of the preview: which page, how large, what the report contains, and the ways out of it."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QIntValidator
from PySide6.QtWidgets import QLabel, QLineEdit, QMenu, QToolButton, QWidget, QWidgetAction

from amp_studio.report import Contents
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.theme import GAP, GAP2, GAP3, HEAD, ICON, font
from amp_studio.ui.forms.form import FieldForm
from amp_studio.ui.forms.icon_button import icon_button
from amp_studio.ui.window.report_options import contents_of, report_fields


class PreviewHead(QWidget):
    """Buttons in a row of the height of every panel's head."""

    page_requested = Signal(int)
    contents_requested = Signal(object)
    """What the report shall contain."""

    def __init__(self, contents: Contents) -> None:
        super().__init__()
        self.setFixedHeight(HEAD)
        self._row = in_row(on=self, margins=(GAP3, 0, GAP, 0), gap=2)
        title = QLabel(self.tr("Report"))
        title.setFont(font("text", own=True))
        self.page = QLineEdit()
        self.page.setAccessibleName(self.tr("Page"))
        self.page.setToolTip(self.tr("Page"))
        self.page.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.page.setFixedWidth(44)
        self.page.setValidator(QIntValidator(1, 99_999, self.page))
        self.page.returnPressed.connect(lambda: self.page_requested.emit(int(self.page.text())))
        self._of = QLabel()
        self._of.setFont(font("small"))
        self._row.addWidget(title)
        self._row.addStretch(1)
        self._row.addWidget(self.page)
        self._row.addWidget(self._of)
        self._row.addStretch(1)
        self.options = FieldForm(report_fields(contents))
        self.options.entered.connect(
            lambda _: self.contents_requested.emit(contents_of(self.options.answers()))
        )
        self.show_count(0)

    def add_button(
        self, icon_name: str, name: str, act: Callable[[], object], *, is_switch: bool = False
    ) -> QToolButton:
        """Add a button; its name is its tip."""
        button = icon_button(icon_name, name, spoken=name.split(" (", maxsplit=1)[0].rstrip("…"))
        button.setIconSize(QSize(ICON, ICON))
        button.setCheckable(is_switch)
        button.clicked.connect(lambda *_: act())
        self._row.addWidget(button)
        return button

    def add_options(self) -> QToolButton:
        """Add the button that opens the fields of what the report contains;
        they stay open while several are changed.
        """
        self.menu = QMenu(self)
        holder = QWidget()
        in_column(self.options, on=holder, margins=(GAP3, GAP2, GAP3, GAP2))
        action = QWidgetAction(self.menu)
        action.setDefaultWidget(holder)
        self.menu.addAction(action)
        button = self.add_button("sliders-horizontal", self.tr("Contents of the report"), lambda: None)
        button.setMenu(self.menu)
        button.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        return button

    def show_count(self, count: int) -> None:
        """Show how many pages there are."""
        self._of.setText(f"/ {count}")
        self.page.setEnabled(count > 0)

    def show_page(self, page: int) -> None:
        """Show which page is at the top."""
        self.page.setText(str(page) if page else "")
