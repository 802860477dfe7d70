"""Notices when another program changes an open file on disk,
and offers what can be done without losing anything.
"""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QFileSystemWatcher, QObject
from PySide6.QtWidgets import QApplication

from amp_studio.files import is_write_protected
from amp_studio.ui.base.questions import ask
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.translated import message_in_words
from amp_studio.ui.page.file_page import FilePage

from .settings import is_there

_SETTLE_MS = 250
"""Milliseconds to wait, as a program may write a file in several steps."""


class DiskWatch(QObject):
    """Watches the file of one page, and its folder,
    because a rename over a file ends the watch of the file itself.

    ``compare`` shows the file on disk beside the open one; ``reload`` opens it in place of the open one.
    """

    def __init__(
        self, page: FilePage, compare: Callable[[FilePage], object], reload: Callable[[FilePage], object]
    ) -> None:
        super().__init__(page)
        self._page, self._compare, self._reload = page, compare, reload
        self._refused: str | None = None
        self._watcher = QFileSystemWatcher(self)
        path = page.workspace.path
        self._watcher.addPaths([str(path), str(path.parent)])
        self._timer = single_shot(self, self._check_disk)
        self._watcher.fileChanged.connect(self._wait)
        self._watcher.directoryChanged.connect(self._wait)
        page.conflict.connect(self.offer)
        page.workspace.unsaved_at_risk.connect(self._warn_unkept)
        if page.workspace.may_edit and is_write_protected(path):
            text = self.tr("{name} is write-protected: changes can be saved under another name.")
            page.bar.say(text.format(name=path.name), "warning")

    def _warn_unkept(self, why: str) -> None:
        text = self.tr(
            "Unsaved work of {name} cannot be kept beside it ({why}): if the program is killed, it is lost."
        )
        name = self._page.workspace.path.name
        self._page.bar.say(text.format(name=name, why=message_in_words(why)), "warning")

    def _wait(self, _: str) -> None:
        self._timer.start(_SETTLE_MS)

    def _check_disk(self) -> None:
        workspace = self._page.workspace
        # Own saves are no news, and under a question the bar could not be answered: later.
        if workspace.is_saving or QApplication.activeModalWidget() is not None:
            self._timer.start(4 * _SETTLE_MS)
            return
        if is_there(workspace.path) and str(workspace.path) not in self._watcher.files():
            # A file that was replaced by renaming is another one: Qt has stopped to watch its name.
            self._watcher.addPath(str(workspace.path))
        state = workspace.disk_state()
        if state is None or state == self._refused:
            return
        self._refused = state  # offered once for each change
        if state == "removed":
            self._page.bar.say(
                self.tr(
                    "{name} was removed or renamed by another program. Your work is still open: save it under"
                    " a new name."
                ).format(name=workspace.path.name),
                "warning",
            )
        else:
            self.offer()

    def offer(self) -> None:
        """Say that the file on disk is another one now, with a button for each way on."""
        name, dirty = self._page.workspace.path.name, self._page.workspace.is_dirty
        compare, reload = (
            (self.tr("Co&mpare…"), lambda: self._compare(self._page)),
            (self.tr("&Reload"), self._ask_reload),
        )
        if dirty:
            text = self.tr(
                "{name} was changed by another program while you have unsaved changes. Compare both, then"
                " save."
            ).format(name=name)
            self._page.bar.say(text, "warning", compare, reload)
        else:
            self._page.bar.say(
                self.tr("{name} was changed by another program.").format(name=name),
                "warning",
                reload,
                compare,
            )

    def _ask_reload(self) -> None:
        workspace = self._page.workspace
        if workspace.is_dirty:
            question = self.tr("Reload {name}? Your unsaved changes will be lost.").format(
                name=workspace.path.name
            )
            if ask(
                self._page, self.tr("Reload"), question, self.tr("&Reload"), self.tr("Cancel"), default=1
            ) != self.tr("&Reload"):
                return
        self._reload(self._page)
