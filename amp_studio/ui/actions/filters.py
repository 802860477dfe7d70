"""Filters and bookmarks: what the chips above the table do, by the keyboard and from the find box."""

from __future__ import annotations

from functools import partial

from amp_studio.find import FilterName
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.translated import tr
from amp_studio.ui.page.file_page import FilePage
from amp_studio.ui.table.filter_bar import filter_titles
from amp_studio.ui.window.studio_window import StudioWindow

_LETTERS: dict[FilterName, str] = {
    "not-set": "n",
    "changed": "c",
    "findings": "f",
    "axes-differ": "x",
    "unsaved": "s",
    "since-download": "d",
    "restart": "r",
    "recent": "e",
    "bookmarked": "b",
    "noted": "w",
}
"""The letter that is underlined in the name of each filter, as far as its language has it."""


def add(window: StudioWindow, page: FilePage) -> None:
    """Know the bookmarks of a file, and read its last download when that is asked for."""
    page.filters.set_bookmarks(window.settings.bookmarks(page.workspace.path))
    page.filters.download_requested.connect(lambda: window.guarded(partial(_read_download, window, page)))


def toggle(window: StudioWindow, mark: FilterName) -> None:
    """Switch a filter on or off."""
    filters = window.page_in_front.filters
    filters.choose(mark, mark not in filters.active)


def show_all_rows(window: StudioWindow) -> None:
    """Take all filters off."""
    window.page_in_front.filters.clear()


def _read_download(window: StudioWindow, page: FilePage) -> None:
    """Read what the last download was, in the background; where there is none the page has the reason."""
    from amp_studio.transfer.client import NoDownloadError, last_download

    file, path = page.workspace.file, page.workspace.path
    try:
        last = in_background(window, tr("Reading the last download"), lambda: last_download(file, path))
    except NoDownloadError as error:
        page.bar.say(str(error))
        return
    page.filters.take_download(last.file.values)


def toggle_bookmark(window: StudioWindow) -> None:
    """Bookmark the parameter of the current cell, or take its bookmark away; bookmarks are a person's,
    not the file's.
    """
    page = window.page_in_front
    address = page.table_view.address()
    if address is None:
        raise ValueError(tr("Select a value in the table first."))
    kept = window.settings.bookmarks(page.workspace.path)
    kept ^= {address[0]}
    window.settings.keep_bookmarks(page.workspace.path, kept)
    page.filters.set_bookmarks(kept)
    name = page.workspace.file.schema.parameters[address[0]].name
    text = tr("{name} is bookmarked.") if address[0] in kept else tr("{name} is no longer bookmarked.")
    window.show_status(text.format(name=name))


def listed() -> list[tuple[FilterName, str, str]]:
    """Return each filter of the menu with its name, in which a letter is marked, and its tip."""
    names = {mark: name for mark, (name, _) in filter_titles().items()} | {"findings": tr("With findings")}
    return [(mark, _lettered(names[mark], _LETTERS[mark]), tip) for mark, (_, tip) in filter_titles().items()]


def _lettered(name: str, letter: str) -> str:
    """Return a name with its letter marked for the menu."""
    at = name.casefold().find(letter)
    return f"{name[:at]}&{name[at:]}" if at >= 0 else name
