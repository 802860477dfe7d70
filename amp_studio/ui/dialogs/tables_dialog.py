"""The manual's printed tables: alarms with cause and remedy, motors, ports, G-codes;
each links to its parameters.
"""

from __future__ import annotations

from PySide6.QtCore import Qt, QUrl, Signal
from PySide6.QtWidgets import (
    QDialog,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QSplitter,
    QTextBrowser,
    QWidget,
)

from amp_studio.report import cells_of
from amp_studio.schema import Address, Table
from amp_studio.ui.base.figures import unbroken
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.screen_room import fit_to_screen
from amp_studio.ui.base.theme import scheme
from amp_studio.ui.base.translated import facts_in_words, help_language, worded
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.pages import LINK, drawn, link


class TablesDialog(QDialog):
    """All tables of the family; those of the selected parameter come first."""

    linked = Signal(str)
    """A parameter id that was clicked."""

    def __init__(self, workspace: Workspace, address: Address | None, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(" · ".join(filter(None, (self.tr("Tables of the Manual"), help_language()))))
        fit_to_screen(self, 900, 560)
        self._schema = workspace.file.schema
        own = address[0] if address else ""
        self._tables = sorted(self._schema.tables.values(), key=lambda table: own not in table.params)
        self.search = QLineEdit()
        self.search.setPlaceholderText(
            self.tr("Search all tables, for example an alarm, a motor or a number")
        )
        self.search.setClearButtonEnabled(True)
        self.list, self.page = QListWidget(), QTextBrowser()
        self.search.setAccessibleName(self.tr("Search all tables"))
        self.list.setAccessibleName(self.tr("Tables"))
        self.page.setAccessibleName(self.tr("Table"))
        self.list.setMaximumWidth(330)
        self.list.setWordWrap(True)
        self.page.setOpenLinks(False)
        split = QSplitter()
        split.addWidget(self.list)
        split.addWidget(self.page)
        in_column(self.search, split, on=self)
        self.search.textChanged.connect(self._list)
        self.list.currentItemChanged.connect(self._show)
        self.page.anchorClicked.connect(self._follow)
        workspace.closed.connect(self.close)
        scheme().changed.connect(self._show_again)
        self._list()

    def _list(self, *_: object) -> None:
        """List the tables that contain every search word."""
        words = self.search.text().casefold().split()
        self.list.clear()
        for table in self._tables:
            text = " ".join(
                (table.title, table.note, *(c for row in cells_of(table) for c in row))
            ).casefold()
            if all(word in text for word in words):
                item = QListWidgetItem(f"{table.title}  ({table.page})")
                item.setData(Qt.ItemDataRole.UserRole, table.id)
                self.list.addItem(item)
        self.list.setCurrentRow(0)
        if not self.list.count():
            self.page.setPlainText(self.tr("No table contains these words."))

    def _show(self, item: QListWidgetItem | None, *_: object) -> None:
        if item is not None:
            self.page.setHtml(unbroken(self._html(self._schema.tables[item.data(Qt.ItemDataRole.UserRole)])))

    def _show_again(self) -> None:
        """Write the page again: its links keep the colour in which they were written."""
        self._show(self.list.currentItem())

    def _html(self, table: Table) -> str:
        links = ", ".join(link(self._schema, p) for p in table.params)
        return drawn(table, facts_in_words(self._schema)) + (
            f"<p>{worded('Parameters')}: {links}</p>" if links else ""
        )

    def _follow(self, url: QUrl) -> None:
        self.linked.emit(url.toString().removeprefix(LINK))
