"""The pictures of the file in front, beside its table or in its place; saving one as a drawing."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, cast

from PySide6.QtCore import QObject, QTimer

from amp_studio.files import check_output, write_atomic
from amp_studio.schema import Address
from amp_studio.ui.base.ask_path import ask_to_save
from amp_studio.ui.base.loading import is_loaded, load, load_beside
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.translated import written_to
from amp_studio.ui.page.file_page import FilePage
from amp_studio.ui.pictures.split import Arrangement, PictureLayout
from amp_studio.ui.window.studio_window import StudioWindow

if TYPE_CHECKING:
    from amp_studio.ui.pictures.page import PicturesPage

PARTS = ("amp_studio.pictures.ramps", "amp_studio.pictures.loop", "amp_studio.ui.pictures.page")
"""What the pictures need; the simulator's pieces take a fifth of a second."""
_LOAD_MS = 1500
"""Milliseconds after a file came to the front until they are loaded, beside the window."""


def _load(family: str) -> None:
    """Load what the pictures of a family need, with the law of its axes. For a thread."""
    load(*PARTS)
    from amp_studio.sim import SimulationError, law_of

    with suppress(SimulationError):  # one that cannot be simulated has pictures too
        law_of(family)


class Pictures(QObject):
    """Shows and hides the pictures of each file, beside its table or in its place."""

    def __init__(self, window: StudioWindow) -> None:
        super().__init__(window)
        self.window = window
        self._loaded: set[str] = set()
        """The families whose pictures have been shown."""
        self._early = single_shot(self, self._prepare, _LOAD_MS)
        window.tabs.current_changed.connect(lambda _: self._early.start())

    def _prepare(self) -> None:
        """Load what pictures need; then show them for a file that comes to the front as
        for the files before it.
        """
        page, layout = self.window.page, self.window.settings.pictures()
        if page is None:
            return
        load_beside(*PARTS)
        is_needed = layout.is_shown and page.pictures is None
        page.middle.arrange(layout)
        if is_needed and page.middle.arrangement != "instead":
            if is_loaded(*PARTS):
                self.show(page, True)
            else:
                self._early.start()

    def pages(self, page: FilePage) -> PicturesPage:
        """Return the pictures of a file, made when they are first asked for."""
        family = page.workspace.file.schema.family.family
        if family not in self._loaded:
            in_background(self.window, self.tr("Loading the simulator"), partial(_load, family))
            self._loaded.add(family)
        if page.pictures is None:  # the timer may have shown them meanwhile
            from amp_studio.ui.pictures.page import PicturesPage

            pictures = PicturesPage(page.workspace)
            pictures.parameter_requested.connect(lambda address: self._to_parameter(page, address))
            pictures.left.connect(lambda: self._focus_table(page))
            pictures.closed.connect(lambda: self._close(page))
            pictures.notified.connect(page.noted)
            pictures.parameter_chosen.connect(lambda address: _select(page, address))
            pictures.head.place_requested.connect(lambda place: self._place(page, place))
            page.table_view.selected.connect(pictures.show_selected)
            page.take_pictures(pictures)
            page.middle.arranged.connect(self._keep)
            page.middle.rearranged.connect(lambda: pictures.head.show_place(page.middle.arrangement))
            return pictures
        return cast("PicturesPage", page.pictures)

    def show(self, page: FilePage, wanted: bool) -> None:
        """Show the pictures of a file, or its table alone."""
        if wanted:
            self.pages(page)
            page.middle.arrange(self.window.settings.pictures())
        page.show_pictures(wanted)
        if not wanted:
            page.table_view.setFocus()
        self.check(self.window.page)

    def check(self, page: FilePage | None) -> None:
        """Press the button where the file in front shows its pictures."""
        self.window.menus["view.pictures"].setChecked(page is not None and page.shows_pictures)

    def toggle(self) -> None:
        """Show the pictures of the file in front, or its table alone."""
        page = self.window.page_in_front
        was_away = self.window.leave_control() or bool(page.turned_to)
        page.show_page("")
        if page.shows_pictures and was_away:
            self.check(page)  # they are there again
            return
        if page.shows_pictures:
            self._close(page)
            return
        self._keep(replace(self.window.settings.pictures(), is_shown=True))
        self.show(page, True)
        if (
            address := page.table_view.address()
        ) is not None:  # once the pictures are painted: to look through all takes a while
            choose = partial(self.pages(page).show_handle_of, address, focus=page.middle.covers)
            QTimer.singleShot(0, page, choose)

    def _close(self, page: FilePage) -> None:
        self._keep(replace(self.window.settings.pictures(), is_shown=False))
        self.show(page, False)

    def _focus_table(self, page: FilePage) -> None:
        """Go back to the table, which is seen already where the pictures are beside it."""
        if page.middle.covers:
            self._close(page)
        page.table_view.setFocus()

    def _keep(self, layout: PictureLayout) -> None:
        self.window.settings.keep_pictures(layout)

    def _place(self, page: FilePage, place: Arrangement) -> None:
        """Put the pictures into a place, or name in the status bar that the window is too small for it."""
        layout = replace(self.window.settings.pictures(), choice=place)
        self._keep(layout)
        page.middle.arrange(layout)
        if page.middle.arrangement != place:
            page.noted.emit(
                self.tr("The window is too small for that; the pictures are there once it is larger")
            )

    def _to_parameter(self, page: FilePage, address: Address) -> None:
        page.go_to(address)
        page.table_view.setFocus()
        self.check(self.window.page)

    def save(self) -> None:
        """Save the picture in front as a drawing."""
        from amp_studio.drawing import scene_svg

        page = self.window.page_in_front
        self.show(page, True)
        card = self.pages(page).chosen_card
        if card is None:
            return
        own = page.workspace.path
        name = own.with_name(f"{own.stem}-{card.picture.name}.svg")
        if path := ask_to_save(self.window, self.tr("Save Picture"), name, "SVG (*.svg)"):
            path = path if path.suffix.lower() == ".svg" else Path(f"{path}.svg")
            check_output(path, own)
            write_atomic(path, scene_svg(card.canvas.scene).encode(), keep_backup=False)
            self.window.show_status(written_to(path))


def _select(page: FilePage, address: Address) -> None:
    """Select the value of a handle in the table; what is selected there already stays."""
    if page.table_view.address() != address:
        page.select(address)
