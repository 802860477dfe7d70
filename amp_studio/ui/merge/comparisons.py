"""Opens the comparison: of the open file with anything, with a control,
or with the file on disk that another program changed.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from amp_studio.files import (
    ENDING,
    Document,
    backup_path,
    check_output,
    file_content,
    is_there,
    open_file,
    readable_content,
    text_of_name,
    write_atomic,
)
from amp_studio.ui.base.ask_path import ask_to_open
from amp_studio.ui.base.side_windows import bring
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.translated import tr
from amp_studio.ui.window.studio_window import StudioWindow

from .columns import BASE, B

if TYPE_CHECKING:
    from amp_studio.files import ParameterFile
    from amp_studio.ui.base.workspace import Workspace
    from amp_studio.ui.page.file_page import FilePage

    from .sources import MergeSources, ReadSource
    from .window import MergeWindow


def parameter_files() -> str:
    """Return what a dialog for files offers."""
    return tr("Parameter files (*.amp);;All files (*)")


_COPIES = "Copies of a control (*.img *.before-*.amp);;All files (*)"
AskPath = Callable[[str, Path], Path | None]
WriteNew = Callable[[Path, Callable[[], Document]], None]


class Comparisons(QObject):
    """One window for every comparison."""

    def __init__(self, window: StudioWindow, ask_path: AskPath, write_new: WriteNew) -> None:
        super().__init__(window)
        self.window, self._ask_path, self._write_new = window, ask_path, write_new
        self.address_of: Callable[[], str | None] = lambda: None
        """Asks for the address of a control; set by who knows the controls."""

    # -- what opens it ---------------------------------------------------------------

    def compare(self) -> None:
        """Compare the file in front: with what is saved where there is unsaved work, else with its backup,
        else its defaults. A comparison in which something was chosen is brought back instead.
        """
        page = self.window.page_in_front
        workspace = page.workspace
        if begun := self._with_choices(workspace):
            bring(begun[-1])
            return
        opened = self.open(page)
        if workspace.is_dirty:
            opened.use(B, opened.sources.as_saved())
        elif backup_path(workspace.path).is_file():
            opened.start(B, opened.sources.backup)
        else:
            opened.start(B, opened.sources.defaults)

    def with_disk(self, page: FilePage) -> None:
        """Merge with the file on disk, which another program has changed, from what was saved before;
        a save may then replace it.
        """
        self.window.guarded(partial(self._with_disk, page), self.tr("Compare"))

    def _with_disk(self, page: FilePage) -> None:
        workspace = page.workspace
        on_disk = in_background(self.window, self.tr("Opening"), lambda: open_file(workspace.path))
        opened = self.open(page)
        try:
            base, disk = opened.sources.as_saved(), opened.sources.on_disk(on_disk.file)
        except ValueError:
            opened.close()
            raise
        workspace.acknowledge(on_disk)
        chosen = {**opened.chosen, B: disk}
        opened.show_merge({**chosen, BASE: base} if workspace.is_dirty else chosen)

    def with_path(self, page: FilePage, path: Path) -> None:
        """Compare with another file, or with a backup or a copy of what a control contained."""
        opened = self.open(page)
        make = opened.sources.other_file if path.suffix.lower() == ENDING else opened.sources.kept_copy
        opened.start(B, lambda: opened.sources.from_copy(make, path))

    def with_control(self, page: FilePage, image: bytes, address: str) -> None:
        """Compare with what was just read from a control; raises ImageError, ValueError."""
        opened = self.open(page)
        opened.use(B, opened.sources.of_content(page.workspace.file.copy(), image, address))

    def open(self, page: FilePage) -> MergeWindow:
        """Open the window on a file, which is both of its sources at first, in the place of those in which
        nothing was chosen.
        """
        from .sources import MergeSources
        from .window import MergeWindow

        begun = self._with_choices(page.workspace)
        for older in self.window.beside.of(MergeWindow, page.workspace):
            if older not in begun:
                older.close()
        sources = MergeSources(page.workspace)
        others = partial(self._others, page)
        opened = MergeWindow(
            page.workspace,
            sources,
            lambda: sources.offers(
                others(),
                partial(self._ask_file, sources),
                partial(self._ask_control, sources),
                partial(self._ask_copy, sources),
            ),
            partial(self._save_result, page),
            self.window,
        )
        opened.went_to.connect(page.go_to)
        opened.merged.connect(partial(self._merged, page))
        self.window.beside.show_too(opened, page.workspace)
        return opened

    def _with_choices(self, workspace: Workspace) -> list[MergeWindow]:
        """Return the open windows of a file in which something was chosen, the oldest first."""
        from .window import MergeWindow

        return [each for each in self.window.beside.of(MergeWindow, workspace) if each.merge.choices]

    def _others(self, page: FilePage) -> list[Workspace]:
        return [each.workspace for each in self.window.tabs.pages() if each is not page]

    # -- what is asked for -------------------------------------------------------------

    def _ask_file(self, sources: MergeSources) -> ReadSource | None:
        path = ask_to_open(self.window, self.tr("Compare with"), sources.folder, parameter_files())
        return None if path is None else sources.from_copy(sources.other_file, path)

    def _ask_copy(self, sources: MergeSources) -> ReadSource | None:
        path = ask_to_open(self.window, self.tr("Compare with a copy"), sources.folder, _COPIES)
        return None if path is None else sources.from_copy(sources.kept_copy, path)

    def _ask_control(self, sources: MergeSources) -> ReadSource | None:
        address = self.address_of()
        return None if address is None else sources.control_now(address)

    # -- what becomes of it ------------------------------------------------------------

    def _merged(self, page: FilePage, other: str, changed: int) -> None:
        text = self.tr("Merged with {source}. %n values changed.", "", changed).format(source=other)
        undo = (self.tr("&Undo"), page.workspace.undo_stack.undo)
        page.bar.say(text, "information", undo)

    def _save_result(self, page: FilePage, file: ParameterFile) -> None:
        self.window.guarded(partial(self._save, page, file), self.tr("Save result as"))

    def _save(self, page: FilePage, file: ParameterFile) -> None:
        path = self._ask_path(self.tr("Save result as"), Path("merged"))
        if path is not None:
            file.header.name = text_of_name(path.stem)
            self._write_new(path, lambda: _written(file, path, page.workspace.path))


def _written(file: ParameterFile, path: Path, like: Path) -> Document:
    """Write a new file with the remarks and the order of another one, as far as that is on disk;
    returns it opened.
    """
    check_output(path)
    file.header.signature = file.schema.signature
    previous = file_content(like) if is_there(like) else None
    write_atomic(path, readable_content(file, path, previous), None, keep_backup=False)
    return Document.open(path)
