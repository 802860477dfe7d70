"""The filter menu and bookmarks: what the chips above the table do, by the keyboard and from the find box."""

from __future__ import annotations

from functools import partial

from PySide6.QtWidgets import QMenu

from amp_studio.find import Mark
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.translated import Translated, tr
from amp_studio.ui.page.file_page import FilePage
from amp_studio.ui.table.filter_bar import mark_names
from amp_studio.ui.window.studio_window import StudioWindow

_LETTERS: dict[Mark, str] = {
    "not-set": "n", "changed": "c", "findings": "f", "axes-differ": "x", "unsaved": "s", "since-download": "d",
    "restart": "r", "recent": "e", "bookmarked": "b", "noted": "w",
}  # fmt: skip
"""The letter that is underlined in the name of each filter, as far as its language has it."""


class FilterActions(Translated):
    """Filters and bookmarks of the file in front."""

    def __init__(self, window: StudioWindow, into: QMenu) -> None:
        self.window = window
        menu = into.addMenu(tr("Filte&r"))
        names = {mark: name for mark, (name, _) in mark_names().items()} | {"findings": tr("With findings")}
        for mark, (_, tip) in mark_names().items():
            action = window.action(_lettered(names[mark], _LETTERS[mark]), partial(self._toggle, mark))
            action.setToolTip(tip)
            menu.addAction(action)
        menu.addSeparator()
        menu.addAction(window.action(tr("&All Rows"), self._clear, "Ctrl+0"))
        self.bookmark = window.action(
            tr("Boo&kmark"), self.toggle_bookmark, "Ctrl+B", "file", "bookmark-simple"
        )

    def add(self, page: FilePage) -> None:
        """Know the bookmarks of a file, and read its last download when that is asked for."""
        page.filters.set_bookmarks(self.window.settings.bookmarks(page.workspace.path))
        page.filters.download_wanted.connect(lambda: self.window.guarded(partial(self._read_download, page)))

    def _page(self) -> FilePage:
        page = self.window.page
        assert page is not None
        return page

    def _toggle(self, mark: Mark) -> None:
        filters = self._page().filters
        filters.choose(mark, mark not in filters.active)

    def _clear(self) -> None:
        self._page().filters.clear()

    def _read_download(self, page: FilePage) -> None:
        """Read what the last download was, in the background; where there is none the page has the reason."""
        from amp_studio.transfer.client import NoDownloadError, last_download

        file, path = page.workspace.file, page.workspace.path
        try:
            last = in_background(
                self.window, tr("Reading the last download"), lambda: last_download(file, path)
            )
        except NoDownloadError as error:
            page.bar.say(str(error))
            return
        page.filters.take_download(last.file.values)

    def toggle_bookmark(self) -> None:
        """Bookmark the parameter of the current cell, or take its bookmark away; bookmarks are a person's, not the file's."""
        page = self._page()
        address = page.table_view.address()
        if address is None:
            raise ValueError(tr("Select a value in the table first."))
        kept = self.window.settings.bookmarks(page.workspace.path)
        kept ^= {address[0]}
        self.window.settings.keep_bookmarks(page.workspace.path, kept)
        page.filters.set_bookmarks(kept)
        name = page.workspace.file.schema.parameters[address[0]].name
        text = tr("{name} is bookmarked.") if address[0] in kept else tr("{name} is no longer bookmarked.")
        self.window.show_status(text.format(name=name))


def _lettered(name: str, letter: str) -> str:
    """Return a name with its letter marked for the menu."""
    at = name.casefold().find(letter)
    return f"{name[:at]}&{name[at:]}" if at >= 0 else name
