"""The page shown while no file is open: families, examples, recent files, and what was open the last time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from functools import partial
from itertools import pairwise
from pathlib import Path

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QHideEvent, QKeySequence, QResizeEvent, QShortcut, QShowEvent
from PySide6.QtWidgets import (
    QBoxLayout,
    QFrame,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QListWidgetItem,
    QMenu,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from amp_studio.files import ENDING, Example, examples, examples_folder
from amp_studio.schema import family_ids, load_schema
from amp_studio.ui.actions.control import ControlDesk
from amp_studio.ui.actions.file import Files
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.modal import pop_up
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.task import Task
from amp_studio.ui.base.theme import CONTROL, GAP, GAP2, GAP3, GAP4, GAP6, font
from amp_studio.ui.base.time_words import in_words
from amp_studio.ui.base.translated import worded
from amp_studio.ui.forms.folder_view import show_in_folder
from amp_studio.ui.forms.message_bar import MessageBar
from amp_studio.ui.window.recent_files import changed_at, folder_of
from amp_studio.ui.window.studio_window import StudioWindow

from .controls import WelcomeControls, welcome_button
from .list import KEY, ROW, WelcomeList, WelcomeRow

_WIDEST, _NARROW = 1130, 860
"""Width of the content at most, and the width of the page below which the two columns are one."""
_REST_MS = 200
"""Milliseconds that the page is shown before anything is read for it."""


@dataclass(frozen=True)
class _Family:
    key: str
    name: str
    short: str
    what: str
    parameters: int


class WelcomePage(QWidget):
    """Everything on it is reached by Tab and the arrow keys; Enter opens."""

    def __init__(
        self,
        window: StudioWindow,
        files: Files,
        control: ControlDesk,
        open_project: Callable[[], object],
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self.setAccessibleName(self.tr("Welcome"))
        self._window, self._files, self._open_project = window, files, open_project
        self._summaries = window.summaries
        self._reading: Task | None = None
        self.has_facts = False
        """Whether it is known what the families and the examples are."""
        self._pause = single_shot(self, self._read, _REST_MS)
        self._summaries.summary_read.connect(self._describe_path)
        self.message = MessageBar()
        self.families = WelcomeList(self.tr("New file"))
        self.examples = WelcomeList(self.tr("Examples"))
        self.list = WelcomeList(self.tr("Recent files"))
        self.controls = WelcomeControls(window, control)
        self.filter = QLineEdit()
        self._lay_out()
        self._list_names()
        self._connect()
        self.setFocusProxy(self.list)

    # -- building ----------------------------------------------------------------------

    def _lay_out(self) -> None:
        left, right = QVBoxLayout(), QVBoxLayout()
        for column in (left, right):
            column.setSpacing(0)
        left.addLayout(self._head(self.tr("New file"), self._small(self.tr("parameters"))))
        left.addWidget(self.families)
        left.addSpacing(GAP2)
        left.addLayout(self._buttons())
        left.addSpacing(GAP6)
        self._examples_head = self._small("")
        left.addLayout(self._head(self.tr("Examples"), self._examples_head))
        left.addWidget(self.examples)
        left.addStretch()
        self.filter.setPlaceholderText(self.tr("Filter"))
        self.filter.setAccessibleName(self.tr("Filter the recent files"))
        self.filter.setClearButtonEnabled(True)
        self.filter.setFixedWidth(200)
        right.addLayout(self._head(self.tr("Recent files"), self.filter))
        right.addWidget(self.list)
        self.none = self._small("")
        self.none.setWordWrap(True)
        right.addSpacing(GAP2)
        right.addWidget(self.none)
        right.addSpacing(GAP6)
        right.addWidget(self.controls)
        right.addSpacing(GAP4)
        right.addWidget(
            self._small(
                self.tr(
                    "Drop files or a project folder anywhere in this window. Ctrl+Shift+P finds every command"
                    " by its name."
                )
            )
        )
        right.addStretch()
        self._columns = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        self._columns.setSpacing(GAP6 * 2)
        self._columns.addLayout(left, 12)
        self._columns.addLayout(right, 15)
        inner = QWidget()
        inner.setMaximumWidth(_WIDEST)
        inner.setLayout(self._columns)
        page = QWidget()
        page.setAutoFillBackground(False)
        in_row(1, (inner, 1000), 1, on=page, margins=(GAP6, GAP6 + GAP3, GAP6, GAP6))
        scroll = QScrollArea()
        scroll.setWidget(page)
        scroll.setWidgetResizable(True)
        scroll.setFrameShape(QFrame.Shape.NoFrame)
        # No stop of Tab: everything in it is one itself.
        scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setBackgroundRole(self.palette().ColorRole.Base)
        self.setAutoFillBackground(True)
        scroll.viewport().setAutoFillBackground(False)
        in_column(self.message, (scroll, 1), on=self, margins=0, gap=0)
        control = self.controls
        # By hand: else Tab goes by the order in which they were made, which is not that on the screen.
        order = [self.families, *self._beside_families, self.examples, self.filter, self.list]
        order += [control.connect_button, control.upload_button, control.list]
        for before, after in pairwise(order):
            QWidget.setTabOrder(before, after)

    def _head(self, text: str, beside: QWidget) -> QHBoxLayout:
        label = QLabel(text)
        bold = font("text")
        bold.setWeight(bold.Weight.DemiBold)
        label.setFont(bold)
        label.setFixedHeight(CONTROL)
        return in_row(label, 0, beside, margins=(0, 0, 0, GAP))

    def _small(self, text: str) -> QLabel:
        label = QLabel(text)
        label.setFont(font("small"))
        label.setForegroundRole(self.palette().ColorRole.PlaceholderText)
        label.setWordWrap(len(text) > 40)
        return label

    def _buttons(self) -> QHBoxLayout:
        row = in_row(gap=GAP2)
        self._beside_families: list[QWidget] = []
        for text, name, act in (
            (self.tr("Open…"), "folder-open", self._files.open),
            (self.tr("Open Project…"), "folder-simple", self._open_project),
        ):
            title = text.replace("&", "").rstrip("…")
            button = welcome_button(text, name, partial(self._window.guarded, act, title))
            row.addWidget(button)
            self._beside_families.append(button)
        row.addStretch()
        return row

    def _connect(self) -> None:
        self.families.itemActivated.connect(self._new)
        self.examples.itemActivated.connect(self._open_example)
        self.list.itemActivated.connect(lambda item: self._open(item.data(KEY)))
        self.list.star_clicked.connect(lambda item: self._pin(item.data(KEY)))
        self.filter.textChanged.connect(self._filter)
        self.filter.returnPressed.connect(self.list.setFocus)
        for view, menu in ((self.list, self._recent_menu), (self.families, self._family_menu)):
            view.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
            view.customContextMenuRequested.connect(menu)
        for keys, act in (("Del", self._forget), ("Ctrl+B", self._pin)):
            short = QShortcut(QKeySequence(keys), self.list)
            # In the list alone: in the filter Del deletes a letter.
            short.setContext(Qt.ShortcutContext.WidgetShortcut)
            short.activated.connect(lambda act=act: self._on_current(act))

    # -- what is shown -----------------------------------------------------------------

    def _list_names(self) -> None:
        """List families and examples by what their files are called, until what they are has been read."""
        for family in family_ids():
            self.families.add(family, WelcomeRow(family, second="…", opens=True))
        for path in sorted(examples_folder().glob(f"*/*{ENDING}")):
            self.examples.add(Example(path, "", path.stem, ""), WelcomeRow(path.stem))
        for view in (self.families, self.examples):
            view.fit()

    def show_recent(self, recent: list[Path]) -> None:
        """List the recent files, the pinned ones first; their findings are counted once the page is at
        rest.
        """
        pinned, now, current = (
            set(self._window.settings.pinned()),
            datetime.now(UTC).astimezone(),
            self.list.currentRow(),
        )
        self.list.clear()
        for path in recent:
            # With an ellipsis in the second line: the row has its height before its file is read.
            item = self.list.add(
                path, WelcomeRow(path.name, second="…", middle=folder_of(path), star=path in pinned)
            )
            moment = changed_at(path)
            if moment is not None:
                self.list.show_row(
                    item, replace(item.data(ROW), right=in_words(moment, now), words=(str(path),))
                )
            self._describe(item)
        self.list.setCurrentRow(max(0, min(current, self.list.count() - 1)))
        self._filter(self.filter.text())
        self.controls.show_controls()
        self._offer_session()
        self.setFocus()

    def _describe(self, item: QListWidgetItem) -> None:
        """Show what is known of a file: its machine and its findings."""
        path, row = item.data(KEY), item.data(ROW)
        found = self._summaries.of(path)
        if found is None:
            return
        if isinstance(found, str):
            self.list.show_row(item, replace(row, second=found, status=self.tr("cannot be read")))
            return
        # The name in the file is shown only where it is not that of the file.
        name = found.name if found.name.casefold() != path.stem.casefold() else ""
        machine = [name, found.family_name, found.machine, " ".join(found.axes[:12])]
        status = "" if found.counts else self.tr("no findings")
        self.list.show_row(
            item, replace(row, second=", ".join(filter(None, machine)), counts=found.counts, status=status)
        )

    def _filter(self, text: str) -> None:
        """Show the recent files whose name, folder or machine has the text."""
        for n in range(self.list.count()):
            item = self.list.item(n)
            item.setHidden(
                text.casefold() not in f"{item.data(ROW).accessible_text()} {item.data(KEY)}".casefold()
            )
        is_any_listed = any(not self.list.item(n).isHidden() for n in range(self.list.count()))
        self.filter.setVisible(self.list.count() > 0)
        self.none.setVisible(not is_any_listed)
        self.none.setText(
            self.tr("No recent file has '{text}' in its name, folder or machine.").format(text=text)
            if self.list.count()
            else self.tr("No file has been opened yet. Begin with an example, or with a new file.")
        )
        self.list.setVisible(is_any_listed)
        self.list.fit()

    def _offer_session(self) -> None:
        """Offer the files of the last time, where they have not been opened again."""
        paths = [p for p in self._files.last_session if p.is_file()]
        if not paths:
            self.message.hide()
            return
        names = ", ".join(p.stem for p in paths)
        text = self.tr("These files were open the last time: {names}.").format(names=names)
        self.message.say(text, "information", (self.tr("Open All"), self._open_session))

    def _open_session(self) -> None:
        for path in self._files.last_session:
            self._open(path)

    # -- what is read for it -----------------------------------------------------------

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self._pause.start()

    def hideEvent(self, event: QHideEvent) -> None:
        super().hideEvent(event)
        self._pause.stop()
        # Nothing is read for a page that is hidden: the processor belongs to the file that was opened.
        self._summaries.want([])

    def _read(self) -> None:
        """Read in the background what is still to be known."""
        if not self.isVisible():
            return
        # Families first: who has no files yet begins there, and the controls are listed by their names.
        if not self.has_facts and self._reading is None:
            self._reading = task = Task(lambda *_: (_all_families(), _worded_examples()))
            task.done.connect(self._show_facts)
            task.finished.connect(self._done_reading)
            task.begin()
        elif self._reading is None:
            self._summaries.want(self.list.item(n).data(KEY) for n in range(self.list.count()))

    def _done_reading(self) -> None:
        self._reading = None
        self._read()

    def _describe_path(self, path: Path) -> None:
        for n in range(self.list.count()):
            if self.list.item(n).data(KEY) == path:
                self._describe(self.list.item(n))

    def _show_facts(self, found: tuple[list[_Family], tuple[Example, ...]]) -> None:
        """Show what the families and the examples are, each in its row."""
        self.has_facts = True
        families, machines = found
        names = {family.key: family.short for family in families}
        self.controls.names = names
        self.controls.show_controls()
        rows = [
            (f.key, WelcomeRow(f.name, second=f.what, right=str(f.parameters), opens=True)) for f in families
        ]
        self.families.show_rows(rows)
        self.examples.show_rows(
            (
                each,
                WelcomeRow(each.title, right=names.get(each.family, each.family), words=(each.description,)),
            )
            for each in machines
        )
        self._examples_head.setText(self.tr("a copy is opened"))

    # -- what is done ------------------------------------------------------------------

    def _on_current(self, act: object) -> None:
        item = self.list.currentItem()
        if item is not None and not item.isHidden():
            act(item.data(KEY))  # type: ignore[operator]  # a method of this page

    def _open(self, path: Path) -> None:
        self._window.guarded(partial(self._files.open_path, path), self.tr("Open"))

    def _new(self, item: QListWidgetItem) -> None:
        self._window.guarded(partial(self._files.new, item.data(KEY)), self.tr("New"))

    def _open_example(self, item: QListWidgetItem) -> None:
        self._window.guarded(partial(self._files.open_example, item.data(KEY).path), self.tr("Example"))

    def _pin(self, path: Path) -> None:
        self._files.recent.pin(path)
        self.show_recent(self._files.recent.paths())

    def _forget(self, path: Path) -> None:
        self._files.recent.forget(path)
        self.show_recent(self._files.recent.paths())

    def _recent_menu(self, place: QPoint) -> None:
        item = self.list.itemAt(place)
        if item is None:
            return
        path, menu = item.data(KEY), QMenu(self)
        menu.addAction(self.tr("&Open"), partial(self._open, path))
        is_pinned = path in self._window.settings.pinned()
        menu.addAction(
            self.tr("Un&pin") if is_pinned else self.tr("&Pin to the Top"), partial(self._pin, path)
        )
        menu.addAction(self.tr("&Remove from the List"), partial(self._forget, path))
        menu.addAction(self.tr("&Show in Its Folder"), partial(show_in_folder, path))
        pop_up(menu, self.list.viewport().mapToGlobal(place))

    def _family_menu(self, place: QPoint) -> None:
        item = self.families.itemAt(place)
        if item is None:
            return
        menu = QMenu(self)
        menu.addAction(self.tr("&New File…"), partial(self._new, item))
        for each in examples():
            if each.family == item.data(KEY):
                text = self.tr("Copy of {title}…").format(title=worded(each.title, each.family))
                menu.addAction(
                    text, partial(self._window.guarded, partial(self._files.open_example, each.path))
                )
        pop_up(menu, self.families.viewport().mapToGlobal(place))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Put both columns into one in a narrow window."""
        super().resizeEvent(event)
        narrow = self.width() < _NARROW
        # From the bottom up, so that the right column, the recent files, is the upper one.
        wanted = QBoxLayout.Direction.BottomToTop if narrow else QBoxLayout.Direction.LeftToRight
        if self._columns.direction() != wanted:
            self._columns.setDirection(wanted)


def _worded_examples() -> tuple[Example, ...]:
    """Return the examples in the language of the window, in a thread: the facts of every family are read."""
    return tuple(
        replace(
            each, title=worded(each.title, each.family), description=worded(each.description, each.family)
        )
        for each in examples()
    )


def _all_families() -> list[_Family]:
    loaded = map(load_schema, family_ids())
    families = [(schema.family, len(schema.parameters)) for schema in loaded]
    return [
        _Family(s.family, s.name, s.short or s.name, worded(s.what, s.family), count) for s, count in families
    ]
