"""The docks around the tabs: they stay while files come and go, and show the panels of the file in front.

A window that becomes narrow or low keeps the room of the table: the parameter comes beside the findings, the
left panel goes, the findings fold to their head. It all comes back with the room.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from PySide6.QtCore import QByteArray, QSize, Qt
from PySide6.QtWidgets import QDockWidget, QLabel, QMainWindow, QStackedWidget, QWidget

from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.theme import GAP2, HEAD, font
from amp_studio.ui.base.translated import Translated, tr
from amp_studio.ui.findings.panel import FindingsPanel
from amp_studio.ui.forms.segment import Segment
from amp_studio.ui.page.file_page import FilePage

from .settings import UserSettings

_PANELS = (
    ("Groups", Qt.DockWidgetArea.LeftDockWidgetArea, 248),
    ("Parameter", Qt.DockWidgetArea.RightDockWidgetArea, 292),
    ("Findings", Qt.DockWidgetArea.BottomDockWidgetArea, 202),
)
"""Name of a dock, where it is and how wide or high, until the user arranges them."""
_NARROW = {"Groups": 212, "Parameter": 240}
"""The same in a window under 1400 pixels."""
_ROOMY = 1400
_PREVIEW = "Preview"
"""Name of the dock of the report, which is closed until the user opens it."""
_PREVIEW_SHARE, _PREVIEW_LEAST, _PREVIEW_MOST = 0.36, 384, 560
"""Its share of the window's width, and the least and most pixels."""
_PREVIEW_WIDEST = 0.45
"""The largest share that it keeps when the window becomes narrower."""
_MIN_TABLE = 320
"""Width in pixels that a kept arrangement must leave to the table."""
WIDE, LEFT_WIDE, LOW = 1200, 900, 620
"""Width from which the parameter has a separate side, width from which there is a left panel,
height below which findings fold."""


class _Heads(QStackedWidget):
    """The heads of the panels of a dock, of which one is seen."""

    def __init__(self) -> None:
        super().__init__()
        self.setFixedHeight(HEAD)

    def sizeHint(self) -> QSize:
        """Return what a dock gives its title bar, whatever is in it."""
        return QSize(super().sizeHint().width(), HEAD)

    def minimumSizeHint(self) -> QSize:
        """Return no width, so that a head never keeps a dock wide."""
        return QSize(0, HEAD)


class Docks(Translated):
    """One dock for each kind of panel. Nothing is docked while no file is open."""

    def __init__(self, window: QMainWindow, settings: UserSettings) -> None:
        self._window, self._settings = window, settings
        self._stacks: dict[str, QStackedWidget] = {}
        self._heads: dict[str, QStackedWidget] = {}
        self._arranged: QByteArray | None = None
        """How the docks were when the last file was closed; None while they are there."""
        self._size = QSize(WIDE, LOW)
        self._is_moving = False
        self._asked_size: QSize | None = None
        """Size that the window got while panels were moved."""
        self._is_first = True
        self._width_before = _PANELS[1][2]
        """Width of the parameter before the preview came beside it."""
        self._closed_for_room: set[str] = set()
        """Docks that a small window has taken away."""
        self._is_low = self._is_folded = False
        """Whether the window has no room for the findings,
        and whether their head is all that is wanted of them."""
        self._open_sizes: dict[str, int] = {}
        """Size of each panel before it was closed."""
        self.docks: list[QDockWidget] = []
        for title, area, _ in _PANELS:
            dock, stack, head = QDockWidget(_name(title), window), QStackedWidget(), _Heads()
            # Qt keeps arrangements by object names: they are the same in every language.
            dock.setObjectName(title)
            dock.setWidget(stack)
            head.setAccessibleName(_name(title))
            dock.setTitleBarWidget(head)
            window.addDockWidget(area, dock)
            dock.hide()
            self.docks.append(dock)
            self._stacks[title], self._heads[title] = stack, head
        self._share_the_bottom()
        self.preview = QDockWidget(tr("Report Preview"), window)
        self.preview.setObjectName(_PREVIEW)
        self._place_preview()
        self.preview.hide()

    def _place_preview(self) -> None:
        """Put the preview at the right edge, beside the parameter."""
        self._window.addDockWidget(Qt.DockWidgetArea.RightDockWidgetArea, self.preview)
        self._window.splitDockWidget(self._dock("Parameter"), self.preview, Qt.Orientation.Horizontal)

    def take_preview(self, panel: QWidget, head: QWidget) -> None:
        """Put the preview into its dock, once it is wanted."""
        self.preview.setWidget(panel)
        self.preview.setTitleBarWidget(head)
        head.setAccessibleName(tr("Report Preview"))

    @property
    def _preview_width(self) -> int:
        return min(max(int(self._size.width() * _PREVIEW_SHARE), _PREVIEW_LEAST), _PREVIEW_MOST)

    def show_preview(self, wanted: bool) -> None:
        """Show or hide the preview; the other panels make room as in a small window,
        and are as before when it is hidden.
        """
        parameter = self._dock("Parameter")
        if wanted and self.preview.isHidden():
            self._width_before = self._width_before if parameter.isHidden() else parameter.width()
        self.preview.setVisible(wanted)
        self.fit(self._size)
        if not wanted and not parameter.isHidden():
            self._window.resizeDocks([parameter], [self._width_before], Qt.Orientation.Horizontal)
        if wanted and not self.preview.isFloating():
            beside = [] if self._dock("Parameter").isHidden() else [(self._dock("Parameter"), _PANELS[1][2])]
            docks, widths = zip(*beside, (self.preview, self._preview_width), strict=True)
            self._window.resizeDocks(docks, widths, Qt.Orientation.Horizontal)

    def _share_the_bottom(self) -> None:
        """Make room for the parameter in the dock of the findings, with a segment that chooses between
        them.
        """
        below = self._dock("Findings")
        self._bottom = QStackedWidget()
        self._bottom.addWidget(self._stacks["Findings"])
        inside = QWidget()  # stays when its content is hidden: a dock with nothing in it has no width
        in_column(self._bottom, on=inside, margins=0)
        inside.setFocusProxy(self._bottom)
        below.setWidget(inside)
        head = QWidget()
        row = in_row(on=head, margins=0, gap=0)
        self.chooser = Segment(
            self.tr("Panel"), [(title, _name(title), "") for title in ("Findings", "Parameter")]
        )
        self.chooser.layout().setContentsMargins(GAP2, 0, GAP2, 0)
        self.chooser.chosen.connect(self.show)
        self.chooser.hide()
        self._bottom_heads = _Heads()
        self._bottom_heads.addWidget(self._heads["Findings"])
        row.addWidget(self.chooser)
        row.addWidget(self._bottom_heads, 1)
        head.setFixedHeight(HEAD)
        below.setTitleBarWidget(head)

    @property
    def places(self) -> dict[str, QWidget]:
        """Name of a dock -> the widget that shows the panels of all pages there."""
        return dict(self._stacks)

    def _dock(self, title: str) -> QDockWidget:
        return next(dock for dock in self.docks if dock.objectName() == title)

    def add(self, page: FilePage) -> None:
        """Take the panels of a page in, each with its head."""
        page.findings.fold_requested.connect(self.fold)
        page.listed.connect(lambda: self.fold(True) if not page.findings.has_findings else None)
        for title, panel in page.panels.items():
            self._stacks[title].addWidget(panel)
            self._heads[title].addWidget(_head_of(panel, title))

    def remove(self, page: FilePage) -> None:
        """Let the panels of a page go."""
        for title, panel in page.panels.items():
            if (head := self._heads[title].widget(self._stacks[title].indexOf(panel))) is not None:
                self._heads[title].removeWidget(head)
                head.deleteLater()
            self._stacks[title].removeWidget(panel)
            panel.deleteLater()

    def show_page(self, page: FilePage | None) -> None:
        """Show the panels of a page; without one the docks leave until there is one again."""
        if page is None:
            self._hide_all()
            return
        page.findings.follow_fold(self._is_folded)
        for title, panel in page.panels.items():
            self._stacks[title].setCurrentWidget(panel)
            self._heads[title].setCurrentIndex(self._stacks[title].indexOf(panel))
            self._stacks[title].setFocusProxy(panel)
        self._bottom.setFocusProxy(self._bottom.currentWidget() or self._stacks["Findings"])
        if self._is_first or self._arranged is not None:
            self._show_again(is_folded=not page.findings.has_findings)
        elif not page.findings.has_findings:
            self.fold(True)

    def _hide_all(self) -> None:
        """Hide the docks and remember how they were arranged."""
        if not self._is_first and self._arranged is None:
            self._widen()
            self._arranged = self._window.saveState()
        for dock in (*self.docks, self.preview):
            dock.hide()

    def _show_again(self, *, is_folded: bool) -> None:
        """Arrange the docks as they were before the last page went, or in the last session."""
        kept = self._settings.arrangement() if self._is_first else self._arranged
        was_folded = not self._is_first and self._is_folded
        self._is_first, self._arranged = False, None
        self.reset()
        if kept is not None:
            self._restore(kept)
        self.fold(was_folded or is_folded)
        self.fit(self._size)

    def _restore(self, kept: QByteArray) -> None:
        """Arrange the docks as they were, unless that leaves the table no room
        or hides everything off the screen.
        """
        self._widen()  # as it was when this arrangement was kept
        if not self._window.restoreState(kept):
            return
        self._settings.bring_back((*self.docks, self.preview))
        centre = self._window.centralWidget()
        if not self.preview.isHidden():  # it has its room from the other panels (fit), not from the table
            width = min(self.preview.width(), self._preview_width)
            self._window.resizeDocks([self.preview], [width], Qt.Orientation.Horizontal)
        elif self._window.isVisible() and centre.width() < min(_MIN_TABLE, self._window.width() // 3):
            self.reset()

    def reset(self) -> None:
        """Dock everything in its place, in its size; the preview is closed."""
        self._widen()
        self.preview.setFloating(False)
        self.preview.hide()
        for dock, (_, area, _) in zip(self.docks, _PANELS, strict=True):
            dock.setFloating(False)
            self._window.addDockWidget(area, dock)
            dock.show()
        self._place_preview()
        for dock, (_, area, size) in zip(self.docks, _PANELS, strict=True):
            below = area == Qt.DockWidgetArea.BottomDockWidgetArea
            self._window.resizeDocks(
                [dock],
                [size if below else self._width_of(dock.objectName())],
                Qt.Orientation.Vertical if below else Qt.Orientation.Horizontal,
            )
        self.fit(self._size)

    def _width_of(self, title: str) -> int:
        """Return how wide a panel at the side is until the user arranges it."""
        wide = next(size for name, _, size in _PANELS if name == title)
        return wide if self._size.width() >= _ROOMY else _NARROW[title]

    def keep(self) -> None:
        """Store the arrangement for the next start."""
        if not self._is_first:
            self._widen()
            self._settings.keep_arrangement(self._arranged or self._window.saveState())

    # -- small windows -----------------------------------------------------------

    def fit(self, size: QSize) -> None:
        """Keep the table usable in a window of this size; what was taken away for room comes back with it."""
        if self._is_moving:
            self._asked_size = size
            return
        is_narrower, self._size = size.width() < self._size.width(), size
        if self._is_first or self._arranged is not None:
            return
        with self._moving():
            self._make_room(is_narrower)

    @contextmanager
    def _moving(self) -> Iterator[None]:
        """Let panels be moved and turned whole. A widget that is shown lays the window out, which can resize
        it at once: what fits that size is made when the move is over.
        """
        self._is_moving, was_moving = True, self._is_moving
        try:
            yield
        finally:
            self._is_moving = was_moving
        if not was_moving and self._asked_size is not None:
            size, self._asked_size = self._asked_size, None
            self.fit(size)

    def _make_room(self, is_narrower: bool) -> None:
        size = self._size
        is_beside = not self.preview.isHidden() and not self.preview.isFloating()
        width = size.width() - (self._preview_width if is_beside else 0)
        if is_beside and is_narrower and self.preview.width() > size.width() * _PREVIEW_WIDEST:
            self._window.resizeDocks([self.preview], [self._preview_width], Qt.Orientation.Horizontal)
        self._set_small("Parameter", width < WIDE)
        self._set_small("Groups", width < LEFT_WIDE)
        self._is_low = size.height() < LOW
        self._fold()

    def show(self, title: str) -> None:
        """Show a panel, wherever a small window has put it, and give it the focus."""
        dock = self._dock(title)
        if title == "Parameter" and title in self._closed_for_room:
            self.chooser.show_choice(title)
            self._turn_bottom(title)
            dock = self._dock("Findings" if title in self._closed_for_room else title)
        elif title == "Findings":
            self.chooser.show_choice(title)
            self._turn_bottom(title)
        if dock.objectName() == "Findings":
            self.fold(False)
        if dock.isHidden():
            dock.show()
            if (
                title in self._closed_for_room and dock.isHidden()
            ):  # the window is too small for a separate side: it is below now
                self.show(title)
                return
            self._resize(dock)
        dock.raise_()
        dock.widget().setFocus()

    def toggle(self, title: str) -> None:
        """Show a panel with the focus; close the one that has it.
        A panel that opens again is as large as it was.
        """
        dock = self._dock("Findings" if title == "Parameter" and title in self._closed_for_room else title)
        inside, focused = dock.widget(), self._window.focusWidget()
        if dock.isHidden() or focused is None or not (inside is focused or inside.isAncestorOf(focused)):
            self.show(title)
        elif dock.objectName() == "Findings":
            self.fold(True)
            self._window.centralWidget().setFocus()
        else:
            self._open_sizes[title] = dock.width()
            dock.hide()
            self._window.centralWidget().setFocus()

    def _resize(self, dock: QDockWidget) -> None:
        title = dock.objectName()
        width = self._open_sizes.get(title)
        if width and not dock.isFloating():
            self._window.resizeDocks([dock], [width], Qt.Orientation.Horizontal)

    def fold(self, wanted: bool) -> None:
        """Show the head of the findings alone, or all of them in the height they had;
        only the user opens them.
        """
        below = self._dock("Findings")
        # The height of a folded dock is no height to come back to.
        if wanted and not self._is_folded and below.height() > HEAD + 2:
            self._open_sizes["Findings"] = below.height()
        self._is_folded = wanted
        if not wanted:
            self._is_low = False
        self._fold()
        if not wanted and not below.isFloating():
            height = self._open_sizes.get("Findings", _PANELS[2][2])
            self._window.resizeDocks([below], [height], Qt.Orientation.Vertical)

    def _set_small(self, title: str, is_small: bool) -> None:
        if is_small != (title in self._closed_for_room):
            with self._moving():
                self._make_way(title) if is_small else self._put_back(title)

    def _make_way(self, title: str) -> None:
        """Take a dock away that is seen; the parameter comes beside the findings."""
        dock = self._dock(title)
        # What the user has closed or taken out takes no room from the table.
        if dock.isHidden() or dock.isFloating():
            return
        # Before it is hidden: hiding lays the window out, which asks again what there is room for.
        self._closed_for_room.add(title)
        dock.hide()
        if title == "Parameter":
            self._move_parameter(self._bottom, self._bottom_heads)

    def _put_back(self, title: str) -> None:
        """Show a dock again where it was."""
        dock = self._dock(title)
        self._closed_for_room.discard(title)
        if title == "Parameter":
            self._move_parameter(None, None)
        dock.show()
        if title == "Parameter" and not self.preview.isHidden() and not self.preview.isFloating():
            widths = [self._width_of(title), self._preview_width]  # else Qt leaves it a strip
            self._window.resizeDocks([dock, self.preview], widths, Qt.Orientation.Horizontal)

    def _move_parameter(self, into: QStackedWidget | None, heads: QStackedWidget | None) -> None:
        """Put the panel of the parameter beside the findings, or back into its own dock."""
        stack, head, dock = (self._stacks["Parameter"], self._heads["Parameter"], self._dock("Parameter"))
        if into is not None and heads is not None:
            into.addWidget(stack)
            heads.addWidget(head)
        else:
            self._bottom.removeWidget(stack)
            self._bottom_heads.removeWidget(head)
            dock.setWidget(stack)
            dock.setTitleBarWidget(head)
            stack.show()
            head.show()
        self.chooser.setVisible(into is not None)
        for title in self._heads["Findings"].findChildren(QLabel, "title"):
            title.setVisible(into is None)  # the chooser has the word
        self.chooser.show_choice("Findings")
        self._turn_bottom("Findings")

    def _turn_bottom(self, title: str) -> None:
        if self._bottom.indexOf(self._stacks[title]) < 0:
            return
        with self._moving():
            self._bottom.setCurrentWidget(self._stacks[title])
            self._bottom_heads.setCurrentWidget(self._heads[title])
            self._bottom.setFocusProxy(self._stacks[title])

    def _fold(self) -> None:
        """Show the head of the findings alone, or all of them."""
        is_folded = self._is_low or self._is_folded
        self._bottom.setVisible(not is_folded)
        self._dock("Findings").setMaximumHeight(HEAD if is_folded else 16_777_215)
        panel = self._stacks["Findings"].currentWidget()
        if isinstance(panel, FindingsPanel):
            panel.follow_fold(is_folded)

    def _widen(self) -> None:
        """Put back what a small window has taken away, so that an arrangement is that of a large one."""
        for title in tuple(self._closed_for_room):
            self._set_small(title, False)
        self._is_low = False
        self._fold()


def _name(title: str) -> str:
    """Return the name of a dock for a person; its key stays the same in every language."""
    names = {"Groups": tr("Groups"), "Parameter": tr("Parameter"), "Findings": tr("Findings")}
    return names[title]


def _head_of(panel: QWidget, title: str) -> QWidget:
    """Return the head that a panel brings, or its name."""
    own = getattr(panel, "head", None)
    if isinstance(own, QWidget):
        return own
    label = QLabel(_name(title))
    label.setFont(font("text", own=True))
    label.setContentsMargins(12, 0, 12, 0)
    return label
