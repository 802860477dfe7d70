"""The project in the left panel: its machines with marks, backups, copies of controls, rules and notes.
It follows the disk.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QFileSystemWatcher, QObject, QPoint, Qt
from PySide6.QtGui import QDragEnterEvent, QDropEvent, QHideEvent, QKeyEvent, QShowEvent
from PySide6.QtWidgets import QMenu, QPushButton, QTreeWidgetItem, QWidget

from amp_studio.guide import FileSummary
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.modal import pop_up
from amp_studio.ui.base.places import family_name
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.task import Task
from amp_studio.ui.base.theme import GAP, GAP2
from amp_studio.ui.base.time_words import in_words
from amp_studio.ui.forms.folder_view import show_in_folder
from amp_studio.ui.forms.place_tree import COUNTS, KEY, PICTURE, RIGHT, TOKEN, PlaceTree
from amp_studio.ui.page.file_page import FilePage

from .files import ProjectFiles

if TYPE_CHECKING:
    from amp_studio.transfer.client import FolderContent, FolderFile

_SETTLE_MS = 300
"""Milliseconds to wait, as a program may write several files."""
_SEVERITIES = ("error", "warning", "advice")


class ProjectTree(QWidget):
    """One folder as a tree. Enter or a double click opens; the rest is in the menu of a row."""

    def __init__(self, page: FilePage, files: ProjectFiles) -> None:
        super().__init__()
        self._page, self._files, self._window = page, files, files.window
        self.folder = page.workspace.path.parent
        self._content: FolderContent | None = None
        self._by_key: dict[object, QTreeWidgetItem] = {}
        self._marked: dict[object, object] = {}
        """What each file's row shows: a folder may have a thousand of them, and most stay as they are."""
        self._reading: Task | None = None
        self.tree = PlaceTree()
        self.tree.setAccessibleName(self.tr("Project"))
        self.tree.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.tree.setExpandsOnDoubleClick(False)
        self.setFocusProxy(self.tree)
        self.tree.installEventFilter(self)
        self.setAcceptDrops(True)
        self._watcher = QFileSystemWatcher([str(self.folder)], self)
        self._settle = single_shot(self, self.refresh, _SETTLE_MS)
        self._lay_out()
        self._watcher.directoryChanged.connect(lambda _: self._settle.start())
        self.tree.itemActivated.connect(lambda item, _: self._activate(item))
        self.tree.customContextMenuRequested.connect(self._menu_at)
        self._window.summaries.summary_read.connect(self._mark_path)
        self._window.tabs.current_changed.connect(self._mark_all)
        page.workspace.changed.connect(self._mark_own)
        page.workspace.saved.connect(self._mark_own)

    def _lay_out(self) -> None:
        buttons = []
        for text, act in ((self.tr("Add File…"), self._add), (self.tr("Check All"), self._check)):
            button = QPushButton(text)
            button.clicked.connect(act)
            buttons.append(button)
        row = in_row(*buttons, 0, margins=GAP2, gap=GAP)
        in_column((self.tree, 1), row, on=self, margins=0, gap=0)

    # -- reading ------------------------------------------------------------------------

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self.refresh()

    def hideEvent(self, event: QHideEvent) -> None:
        super().hideEvent(event)
        self._settle.stop()

    def refresh(self) -> None:
        """Read the folder again, in the background; what is hidden is read once it is shown."""
        if self._reading is not None:
            self._settle.start()  # it may have read what has changed since
            return
        if not self.isVisible():
            return
        self._reading = task = Task(partial(_content_of, self.folder))
        task.done.connect(self._show)
        task.finished.connect(self._done)
        task.begin()

    def _done(self) -> None:
        self._reading = None

    def _show(self, content: FolderContent) -> None:
        """Show the content; what was selected and folded out stays so."""
        if content == self._content:
            self._mark_all()
            return
        self._content = content
        selected = (
            self.tree.currentItem().data(0, KEY)
            if self.tree.currentItem()
            else ("file", self._page.workspace.path)
        )
        opened = {key for key, item in self._by_key.items() if item.isExpanded()}
        self.tree.clear()
        self._by_key, self._marked = {}, {}
        top = self._top_item(content)
        self._mark_all()
        # With all its rows: in the tree each of their texts and marks would be a change to be painted.
        self.tree.addTopLevelItem(top)
        self._add_projects()
        for key in (top.data(0, KEY), *(opened & self._by_key.keys())):
            self._by_key[key].setExpanded(True)
        if selected in self._by_key:
            self.tree.setCurrentItem(self._by_key[selected])
        self._window.summaries.want(
            file.path for file in content.files if self._window.page_of(file.path) is None
        )

    def _top_item(self, content: FolderContent) -> QTreeWidgetItem:
        """Return the row of the folder with those of its files, rules, notes and deleted files below it."""
        project = self._files.project_of(self.folder)
        top = self._item(
            None, ("folder", self.folder), project.info.name if project else self.folder.name, "folder-simple"
        )
        top.setToolTip(0, str(self.folder))
        if project:
            top.setData(0, RIGHT, family_name(project.info.family))
        for file in content.files:
            self._add_file(top, file)
        if content.rules:
            self._item(top, ("rules", content.rules), self.tr("Own rules"), "clipboard-text")
        if project:
            notes = self._item(top, ("notes", self.folder), self.tr("Notes and control"), "note-pencil")
            notes.setToolTip(0, project.info.notes)
            notes.setData(0, RIGHT, project.info.control_name or None)
        for path in content.deleted:
            gone = self._item(top, ("deleted", path), path.name.removesuffix(".bak"), "trash")
            gone.setData(0, RIGHT, self.tr("deleted"))
            gone.setData(0, TOKEN, "dim")
        return top

    def _item(
        self, above: QTreeWidgetItem | PlaceTree | None, key: object, text: str, name: str
    ) -> QTreeWidgetItem:
        item = QTreeWidgetItem([text]) if above is None else QTreeWidgetItem(above, [text])
        item.setData(0, KEY, key)
        item.setData(0, PICTURE, (name, "dim"))
        self._by_key[key] = item
        return item

    def _add_file(self, top: QTreeWidgetItem, file: FolderFile) -> None:
        item = self._item(top, ("file", file.path), file.path.stem, "file")
        if file.exchange is not None:
            text = self.tr("Last {verb}: {control}, {when}")
            when = _words(datetime.fromisoformat(file.exchange.when)) if file.exchange.when else "?"
            item.setData(0, RIGHT, file.exchange.control.rpartition("//")[2])
            item.setToolTip(0, text.format(verb=file.exchange.verb, control=file.exchange.control, when=when))
        if file.backup:
            backup = self._item(item, ("backup", file.backup), self.tr("Backup"), "clock-counter-clockwise")
            backup.setData(0, RIGHT, _changed(file.backup))
        for copy in file.copies:
            row = self._item(item, ("copy", copy), self.tr("Control before the download"), "cpu")
            row.setData(0, RIGHT, _changed(copy))
            row.setToolTip(0, copy.name)

    def _add_projects(self) -> None:
        others = [p for p in self._files.recent_projects() if p != self.folder]
        if others:
            head = self._item(
                self.tree, ("recent", None), self.tr("Recent projects"), "clock-counter-clockwise"
            )
            for folder in others:
                self._item(head, ("project", folder), folder.name, "folder-simple").setToolTip(0, str(folder))

    # -- marks --------------------------------------------------------------------------

    def _mark_all(self, *_: object) -> None:
        if self.isVisible():
            for item in self._by_key.values():
                self._mark(item)

    def _mark_path(self, path: Path) -> None:
        if self.isVisible() and (item := self._by_key.get(("file", path))) is not None:
            self._mark(item)

    def _mark_own(self, *_: object) -> None:
        self._mark_path(self._page.workspace.path)

    def _mark(self, item: QTreeWidgetItem) -> None:
        """Show of a file whether it is open and saved, its findings,
        and the control it was last exchanged with.
        """
        kind, path = item.data(0, KEY)
        if kind != "file":
            return
        page, summary = self._window.page_of(path), self._window.summaries.of(path)
        counts = _counts_of(page, summary)
        unsaved, tone = page is not None and page.workspace.is_dirty, "dim" if page is None else "text"
        state = (counts, unsaved, tone, summary if isinstance(summary, str) else "")
        if self._marked.get(path) == state:
            return
        self._marked[path] = state
        item.setData(0, PICTURE, ("circle-fill", "chg") if unsaved else ("file", tone))
        item.setData(0, COUNTS, counts)
        item.setData(0, TOKEN, tone)
        words = [
            item.text(0),
            self.tr("open") if page else "",
            self.tr("not saved") if unsaved else "",
            *(f"{count} {severity}" for severity, count in counts),
        ]
        if isinstance(summary, str) and page is None:
            item.setData(0, RIGHT, self.tr("cannot be read"))
            item.setToolTip(0, summary)
            words.append(summary)
        item.setData(0, Qt.ItemDataRole.AccessibleTextRole, ", ".join(filter(None, words)))

    # -- what is done -------------------------------------------------------------------

    def _activate(self, item: QTreeWidgetItem) -> None:
        kind, path = item.data(0, KEY)
        if kind in ("folder", "recent"):
            item.setExpanded(not item.isExpanded())
            return
        acts: dict[str, Callable[[], object]] = {
            "file": partial(self._files.open, path),
            "backup": partial(self._files.compare, self._page, path),
            "copy": partial(self._files.compare, self._page, path),
            "rules": partial(self._files.open_text, path),
            "notes": self._files.information,
            "deleted": partial(self._files.recover, path),
            "project": partial(self._files.open_project, path),
        }
        self._window.guarded(acts[kind], self.tr("Project"))

    def _add(self) -> None:
        self._window.guarded(partial(self._files.add, self.folder), self.tr("Add file"))
        self.refresh()

    def _check(self) -> None:
        self._window.guarded(partial(self._files.check, self.folder), self.tr("Check all"))

    def _remove(self, path: Path) -> None:
        self._window.guarded(partial(self._files.remove, path), self.tr("Remove"))
        self.refresh()

    def menu_of(self, item: QTreeWidgetItem) -> QMenu:
        """Return the menu of a row."""
        kind, path = item.data(0, KEY)
        menu, guarded = QMenu(self), self._window.guarded
        if kind in ("file", "project", "rules", "notes", "deleted"):
            text = self.tr("Rec&over") if kind == "deleted" else self.tr("&Open")
            menu.addAction(text, partial(self._activate, item))
        if kind in ("file", "backup", "copy") and path != self._page.workspace.path:
            text = self.tr("&Compare With {file}").format(file=self._page.workspace.path.stem)
            menu.addAction(text, partial(guarded, partial(self._files.compare, self._page, path)))
        if kind in ("file", "backup", "copy", "deleted"):
            menu.addAction(self.tr("&Move to the Trash…"), partial(self._remove, path))
        if kind == "folder":
            menu.addAction(self.tr("&Add File…"), self._add)
            menu.addAction(self.tr("Chec&k All"), self._check)
        if isinstance(path, Path):
            menu.addAction(self.tr("&Show in the File Manager"), partial(show_in_folder, path))
        return menu

    def _menu_at(self, place: QPoint) -> None:
        item = self.tree.itemAt(place)
        if item is None:
            return
        menu = self.menu_of(item)
        if menu.actions():
            pop_up(menu, self.tree.viewport().mapToGlobal(place))
        else:
            menu.deleteLater()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Keep Delete from the action of the table, which has the same key, while the tree has the focus."""
        is_override = event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent)
        if is_override and event.key() == Qt.Key.Key_Delete:  # type: ignore[attr-defined]  # a key event
            event.accept()
            return True
        return super().eventFilter(watched, event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Delete moves to the trash, after a question."""
        item = self.tree.currentItem()
        if (
            event.key() == Qt.Key.Key_Delete
            and item is not None
            and item.data(0, KEY)[0] in ("file", "backup", "copy")
        ):
            self._remove(item.data(0, KEY)[1])
            return
        super().keyPressEvent(event)

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Take parameter files."""
        if any(url.isLocalFile() for url in event.mimeData().urls()):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        """Copy files that are dropped into the folder; those of the folder itself are opened."""
        event.acceptProposedAction()
        for url in event.mimeData().urls():
            if url.isLocalFile():
                path = Path(url.toLocalFile())
                self._window.guarded(partial(self._files.take, path, self.folder), self.tr("Add file"))
        self.refresh()


def _content_of(folder: Path, *_: object) -> FolderContent:
    from amp_studio.transfer.client import folder_content  # a start does without

    return folder_content(folder)


def _words(moment: datetime) -> str:
    return in_words(moment.astimezone(), datetime.now(UTC).astimezone())


def _changed(path: Path) -> str:
    try:
        return _words(datetime.fromtimestamp(path.stat().st_mtime, UTC))
    except (OSError, OverflowError, ValueError):
        return ""


def _counts_of(page: FilePage | None, summary: FileSummary | str | None) -> tuple[tuple[str, int], ...]:
    """Return how many findings an open file has now, another one when it was last checked."""
    counts: Mapping[str, int] = summary.counts if isinstance(summary, FileSummary) else {}
    if page is not None:
        counts = {severity: page.workspace.count(severity) for severity in _SEVERITIES}
    return tuple((severity, counts[severity]) for severity in _SEVERITIES if counts.get(severity))
