"""The open files as tabs, on one side or on two beside each other."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

from PySide6.QtCore import QEvent, QPoint, Qt, Signal
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication, QMenu, QSplitter, QStackedWidget, QTabBar, QTabWidget, QWidget

from amp_studio.ui.base.modal import pop_up
from amp_studio.ui.page.file_page import FilePage

from .tab_end import TabEnd

_RIGHT = QTabBar.ButtonPosition.RightSide


_LONGEST_NAME = 28
"""Characters of a name that a tab shows."""


class _Side(QTabWidget):
    """One row of tabs with its pages. Whenever anything in a page has another size, Qt lays a tab widget out
    and paints all of it: here only where its own parts have another size.
    """

    def __init__(self) -> None:
        super().__init__()
        self._laid_out: object = None

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.LayoutRequest:
            corner = self.cornerWidget()
            sizes = (self.minimumSizeHint(), self.tabBar().sizeHint(), corner and corner.sizeHint())
            if sizes == self._laid_out:
                return True
            self._laid_out = sizes
        return super().event(event)


class FileTabs(QSplitter):
    """Two rows of tabs, of which the second is there only while it has a file. One page of all is in front:
    the current one.
    """

    current_changed = Signal(object)
    """The page that is now in front, or None."""
    close_requested = Signal(object)
    """A page is to be closed, after the question about its unsaved work."""

    def __init__(self) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self.setChildrenCollapsible(False)
        self.sides = [self._side(self.tr("Open files")), self._side(self.tr("Open files beside"))]
        self._active = self.sides[0]
        self._front: FilePage | None = None
        self.sides[1].hide()
        QApplication.instance().focusChanged.connect(self._follow_focus)

    def _side(self, name: str) -> QTabWidget:
        side = _Side()
        side.setDocumentMode(True)
        side.setMovable(True)
        side.setElideMode(Qt.TextElideMode.ElideNone)  # Qt would leave nothing of a name; the row scrolls
        side.setUsesScrollButtons(True)
        side.setAccessibleName(name)
        bar = side.tabBar()
        bar.setDrawBase(False)  # its line and that of the corner are not at one height
        bar.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        bar.customContextMenuRequested.connect(partial(self._menu, side))
        side.currentChanged.connect(partial(self._turn, side))
        self.addWidget(side)
        return side

    def take_corner(self, corner: QWidget) -> None:
        """Show buttons at the end of the tabs of the first side."""
        self.sides[0].setCornerWidget(corner, Qt.Corner.TopRightCorner)

    def to_choose(self) -> list[tuple[str, Callable[[], object]]]:
        """Return the name of each open file, and what brings it to the front."""
        return [(page.title, partial(self.bring, page)) for page in self.pages()]

    # -- pages -----------------------------------------------------------------

    def pages(self) -> list[FilePage]:
        """Return the pages, those of the left side first."""
        return [page for side in self.sides for page in _pages(side)]

    def pages_of(self, side: int) -> list[FilePage]:
        """Return the pages of one side, 0 or 1."""
        return list(_pages(self.sides[side]))

    @property
    def current(self) -> FilePage | None:
        """The page in front."""
        found = self._active.currentWidget()
        return found if isinstance(found, FilePage) else None

    def place_of(self, before: FilePage | None = None) -> QWidget:
        """Return the widget that shows a new page, in the tabs of another page if one is given."""
        side = self._side_of(before) if before else self._active
        pages = side.findChild(QStackedWidget, options=Qt.FindChildOption.FindDirectChildrenOnly)
        assert pages is not None
        return pages

    def add(self, page: FilePage, before: FilePage | None = None) -> None:
        """Show a page in a new tab, at the place of another page if one is given."""
        side = self._side_of(before) if before else self._active
        place = side.indexOf(before) if before else side.count()
        self._insert(side, place, page)

    def _insert(self, side: QTabWidget, place: int, page: FilePage) -> None:
        side.insertTab(place, page, "")
        self.rename(page)
        self._active = side
        side.setCurrentWidget(page)
        self._emit_front()

    def remove(self, page: FilePage) -> None:
        """Take a page out; the one beside it comes to the front."""
        side = self._side_of(page)
        side.removeTab(side.indexOf(page))
        self._settle()

    def bring(self, page: FilePage) -> None:
        """Bring a page to the front."""
        self._active = self._side_of(page)
        self._active.setCurrentWidget(page)
        self._emit_front()

    def rename(self, page: FilePage) -> None:
        """Update the name on a tab."""
        side = self._side_of(page)
        place = side.indexOf(page)
        name, bar = _short(page.workspace.path.stem), side.tabBar()
        if side.tabText(place) != name.replace("&", "&&"):
            side.setTabText(place, name.replace("&", "&&"))
        family = page.workspace.file.schema.family
        side.setTabToolTip(place, f"{page.workspace.path}\n{family.name}")
        end = bar.tabButton(place, _RIGHT)
        if not isinstance(end, TabEnd):
            end = TabEnd(family.short or family.name)
            end.close_clicked.connect(partial(self.close_requested.emit, page))
            bar.setTabButton(place, _RIGHT, end)
        end.show_unsaved(page.workspace.is_dirty)
        state = self.tr("{name}, not saved") if page.workspace.is_dirty else "{name}"
        bar.setAccessibleTabName(place, state.format(name=page.workspace.path.name))

    def turn(self, step: int) -> None:
        """Bring the next tab to the front, or the one before."""
        pages = self.pages()
        if self.current is not None and len(pages) > 1:
            self.bring(pages[(pages.index(self.current) + step) % len(pages)])

    def move_across(self, page: FilePage | None = None) -> None:
        """Show a page on the other side, so that two files are seen at once."""
        page = page or self.current
        if page is None:
            return
        here = self._side_of(page)
        there = self.sides[1 - self.sides.index(here)]
        here.removeTab(here.indexOf(page))
        there.show()
        self._insert(there, there.count(), page)
        self._settle()
        self.setSizes([1, 1])

    def _side_of(self, page: FilePage) -> QTabWidget:
        return next(side for side in self.sides if side.indexOf(page) >= 0)

    def _settle(self) -> None:
        """Leave the second side only while it has a page, and the first never empty."""
        left, right = self.sides
        if not left.count() and right.count():
            for page in _pages(right):
                right.removeTab(right.indexOf(page))
                left.addTab(page, page.title)
                self.rename(page)
        right.setVisible(right.count() > 0)
        if not self._active.count():
            self._active = left if left.count() else right
        if not self._active.isVisibleTo(self):
            self._active = left
        self._emit_front()

    # -- which one is in front ---------------------------------------------------

    def _turn(self, side: QTabWidget, _: int) -> None:
        if side is self._active or self._front is None:
            self._emit_front()

    def _follow_focus(self, _: QWidget | None, now: QWidget | None) -> None:
        if now is None:
            return
        for side in self.sides:
            if side is not self._active and side.count() and side.isAncestorOf(now):
                self._active = side
                self._emit_front()

    def _emit_front(self) -> None:
        page = self.current
        # Several paths lead here for one change: the window follows each page once.
        if page is not self._front:
            self._front = page
            self.current_changed.emit(page)

    def _menu(self, side: QTabWidget, place: QPoint) -> None:
        index = side.tabBar().tabAt(place)
        page = side.widget(index)
        if not isinstance(page, FilePage):
            return
        menu = QMenu(self)
        menu.addAction(self.tr("&Close"), partial(self.close_requested.emit, page))
        others = menu.addAction(self.tr("Close &Others"), partial(self._close_others, page))
        others.setEnabled(len(self.pages()) > 1)
        menu.addSeparator()
        beside = menu.addAction(self.tr("Show &Beside"), partial(self.move_across, page))
        beside.setEnabled(len(self.pages()) > 1)
        menu.addAction(
            self.tr("Copy &Path"), partial(QGuiApplication.clipboard().setText, str(page.workspace.path))
        )
        pop_up(menu, side.tabBar().mapToGlobal(place))

    def _close_others(self, page: FilePage) -> None:
        for other in self.pages():
            if other is not page:
                self.close_requested.emit(other)


def _short(name: str) -> str:
    """Return a name that a tab has room for."""
    return (
        name if len(name) <= _LONGEST_NAME else f"{name[: _LONGEST_NAME // 2]}…{name[-_LONGEST_NAME // 2 :]}"
    )


def _pages(side: QTabWidget) -> Iterator[FilePage]:
    for n in range(side.count()):
        page = side.widget(n)
        if isinstance(page, FilePage):
            yield page
