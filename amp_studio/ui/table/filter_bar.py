"""Filters above the table: chips with counts, and a funnel for the rest;
they combine with the list and with each other.

A row that passed stays until the filter or the list is chosen again,
so nothing moves while one works through it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

from PySide6.QtCore import QSize, Signal
from PySide6.QtGui import QAction, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QHBoxLayout, QLayout, QMenu, QToolButton, QWidget

from amp_studio.find import FILTER_NAMES, FilterName, ValueFilters, noted
from amp_studio.schema import Address, Value
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.theme import GAP, GAP2, SMALL_ICON, icon
from amp_studio.ui.base.translated import tr
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.list_title import ListTitle
from amp_studio.ui.forms.segment import chip

from .parameter_table import ParameterTable, TableRow

_CHIPS: tuple[FilterName, ...] = ("not-set", "changed", "findings", "axes-differ")
"""The marks that have a chip where there is room; the others are in the funnel alone."""
_RECENT = 50
"""Values that are remembered as edited lately."""
_TITLE = 200
"""Least width in pixels of the bar."""


def filter_titles() -> dict[FilterName, tuple[str, str]]:
    """Return each mark by its name and what it lists."""
    return {
        "not-set": (tr("Not set"), tr("Active values that are not set")),
        "changed": (tr("Changed"), tr("Values that are not the printed default")),
        "findings": (tr("Findings"), tr("Values that cause a finding")),
        "axes-differ": (tr("Axes differ"), tr("Parameters whose axes have different values")),
        "unsaved": (tr("Not saved"), tr("Values that are not as on disk")),
        "since-download": (
            tr("Changed since download"),
            tr("Values that are not as in the last recorded download"),
        ),
        "restart": (tr("Takes effect after restart"), tr("Values that take effect after a restart")),
        "recent": (tr("Recently edited"), tr("The last values that were edited here")),
        "bookmarked": (tr("Bookmarked"), tr("Parameters that you have bookmarked (Ctrl+B)")),
        "noted": (tr("With a note"), tr("Values with a note")),
    }


class FilterBar(QWidget):
    """The head of the table: its title, and which of its rows are shown."""

    changed = Signal()
    """Other filters are on."""
    download_requested = Signal()
    """The filter for what changed since the last download is asked for; ``take_download`` answers."""

    def __init__(self, title: ListTitle, table: ParameterTable) -> None:
        """Make the bar of a table; ``title`` is shown at its left."""
        super().__init__()
        self.setAccessibleName(self.tr("Filters of the table"))
        self._table, self._workspace = table, table.workspace
        workspace: Workspace = table.workspace
        self.marks = ValueFilters(workspace.file)
        self.active: set[FilterName] = set()
        self._recent: dict[Address, None] = {}
        self.marks.recent = self._recent
        self._passed: set[tuple[str, str]] = set()
        """Rows that passed since the filter or the list was chosen."""
        self._list: object = None
        self._is_stale = True
        self._is_narrow = False
        self._build(title)
        self._later = single_shot(self, self._count)
        workspace.changed.connect(self._follow)
        workspace.saved.connect(self._follow_saved)
        table.modelReset.connect(self._count_later)
        self._follow_saved()

    def _build(self, title: ListTitle) -> None:
        row = QHBoxLayout(self)
        row.setSizeConstraint(QLayout.SizeConstraint.SetNoConstraint)  # it is cut before it widens the window
        row.setContentsMargins(0, 0, GAP2, 0)
        row.setSpacing(GAP)
        self._title = title
        row.addWidget(title, 1)
        self.all = chip(self.tr("All"), self.tr("Every row of this list"))
        self.all.clicked.connect(self.clear)
        self.chips: dict[FilterName, QToolButton] = {}
        self.actions_of: dict[FilterName, QAction] = {}
        """FilterName -> its entry in the funnel."""
        self._menu = QMenu(self)
        for mark, (name, tip) in filter_titles().items():
            action = QAction(name, self)
            action.setCheckable(True)
            action.setToolTip(tip)
            action.triggered.connect(lambda on, mark=mark: self.choose(mark, on))
            self.actions_of[mark] = action
            self._menu.addAction(action)
            if mark in _CHIPS:
                button = self.chips[mark] = chip(name, tip)
                button.clicked.connect(lambda on, mark=mark: self.choose(mark, on))
        for button in (self.all, *self.chips.values()):
            row.addWidget(button)
        self.funnel = chip("", self.tr("More filters"))
        self.funnel.setAccessibleName(self.tr("More filters"))
        self.funnel.setIcon(icon("funnel"))
        self.funnel.setIconSize(QSize(SMALL_ICON, SMALL_ICON))
        self.funnel.setMenu(self._menu)
        self.funnel.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        row.addWidget(self.funnel)
        self._show_choice()

    # -- choosing --------------------------------------------------------------------------

    def choose(self, mark: FilterName, on: bool) -> None:
        """Add a filter to those that are on, or take it away."""
        if mark == "since-download" and on and self.marks.downloaded is None:
            self._show_choice()
            self.download_requested.emit()
            return
        self._set(self.active | {mark} if on else self.active - {mark})

    def clear(self) -> None:
        """Show every row of the list."""
        self._set(set())

    def take_download(self, values: Mapping[Address, Value]) -> None:
        """Filter by what is not as in these values of the last download."""
        self.marks.downloaded = values
        self._set(self.active | {"since-download"})

    def _set(self, active: set[FilterName]) -> None:
        if "since-download" not in active:
            self.marks.downloaded = None  # another download may come; it is read again when it is asked for
        self.active = active
        self._passed.clear()
        self._take_state()
        self._table.filter_rows(self._passes if active else None)
        self._show_choice()
        self.changed.emit()

    def _passes(self, row: TableRow, addresses: list[Address]) -> bool:
        """Return whether a row has all the filters, or had them when they or the list were chosen."""
        if self._list is not self._table.asked:
            self._list = self._table.asked
            self._passed.clear()
        key = (row.parameter.id, row.instance)
        if key not in self._passed and self.marks.passing(self.active, addresses):
            self._passed.add(key)
        return key in self._passed

    # -- following the file --------------------------------------------------------------------

    def _follow(self, addresses: list[Address]) -> None:
        """Forget what an edit changed; the table filters its rows in the same moment, the counts follow
        it.
        """
        self.marks.forget(addresses)
        for address in addresses:
            # Taken out first: so it comes to the end, as the latest.
            self._recent.pop(address, None)
            self._recent[address] = None
        for old in list(self._recent)[: -_RECENT or None]:
            del self._recent[old]
        self._take_state()
        self._count_later()

    def _follow_saved(self) -> None:
        self._take_state()
        self._count_later()

    def _take_state(self) -> None:
        self.marks.take_findings(self._workspace.listed)
        self.marks.saved = self._workspace.document.saved
        self.marks.noted = noted(self._workspace.file)

    def set_bookmarks(self, ids: Collection[str]) -> None:
        """Know which parameters are bookmarked."""
        self.marks.bookmarked = frozenset(ids)
        self._count_later()

    def _count_later(self) -> None:
        self._is_stale = True
        # A bar that is not seen counts when it is shown: every page has one, and counting takes time.
        if self.isVisible():
            self._later.start(0)

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        if self._is_stale:
            self._later.start(0)

    def _count(self) -> None:
        """Write the counts of the present list on the chips."""
        self._is_stale = False
        rows = self._table.unfiltered()
        names = filter_titles()
        counts = {mark: self.marks.counted(mark, rows) for mark in _CHIPS}
        for mark, button in self.chips.items():
            text = f"{names[mark][0]} {counts[mark]}"
            button.setText(text)
            button.setEnabled(counts[mark] > 0 or mark in self.active)
        for mark, action in self.actions_of.items():
            action.setText(f"{names[mark][0]}  {counts[mark]}" if mark in counts else names[mark][0])
        self.fit()

    def _show_choice(self) -> None:
        self.all.setChecked(not self.active)
        for mark, button in self.chips.items():
            button.setChecked(mark in self.active)
        for mark, action in self.actions_of.items():
            action.setChecked(mark in self.active)
        self._name_funnel()

    def _name_funnel(self) -> None:
        """Name on the funnel the filters that have no chip there."""
        names = filter_titles()
        own = [
            mark for mark in FILTER_NAMES if mark in self.active and (self._is_narrow or mark not in _CHIPS)
        ]
        nothing = self.tr("All") if self._is_narrow else ""
        self.funnel.setText(", ".join(names[mark][0] for mark in own) or nothing)
        self.funnel.setChecked(bool(own))

    def minimumSizeHint(self) -> QSize:
        return QSize(_TITLE, super().minimumSizeHint().height())

    # -- room --------------------------------------------------------------------------------------

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.fit()

    def fit(self) -> None:
        """Show chips where there is room for them; a narrow bar has all filters in the funnel."""
        chips = [self.all, *self.chips.values()]
        wide = sum(button.sizeHint().width() + GAP for button in chips) + 60
        is_narrow = self.width() < wide + self._title.needed
        for mark in _CHIPS:
            self.actions_of[mark].setVisible(is_narrow)
        for button in chips:
            button.setVisible(not is_narrow)
        if is_narrow != self._is_narrow:
            self._is_narrow = is_narrow
            self._name_funnel()
