"""The pictures of the file in front, in the place of its table; saving one as a drawing."""

from __future__ import annotations

import sys
import threading
from importlib import import_module
from pathlib import Path

from PySide6.QtCore import QObject, QTimer
from PySide6.QtWidgets import QFileDialog

from amp_studio.files import check_output, write_atomic
from amp_studio.pictures import scene_svg

from .file_page import FilePage
from .pictures_page import PicturesPage
from .studio_window import StudioWindow

KEY = "F12"
RAMPS = "amp_studio.pictures.ramps"
LOAD_MS = 1500
"""Milliseconds after a file came to the front until what ramps need is loaded, beside the window."""


def _load_early() -> None:
    """Load the simulator's pieces, which take a fifth of a second, before somebody asks for pictures."""
    if RAMPS not in sys.modules:
        threading.Thread(target=import_module, args=(RAMPS,), daemon=True).start()


class PictureActions(QObject):
    """Shows and hides the page of pictures of each file."""

    def __init__(self, window: StudioWindow) -> None:
        super().__init__(window)
        self.window = window
        name = self.tr("&Pictures")
        self.action = window.action(name, self._toggle, KEY, "file", "frame-corners", self.tr("Pictures"))
        self.action.setCheckable(True)
        self._early = QTimer(self)
        self._early.setSingleShot(True)
        self._early.setInterval(LOAD_MS)
        self._early.timeout.connect(_load_early)
        window.tabs.current_changed.connect(lambda _: self._early.start())
        self.save = window.action(self.tr("Save P&icture As SVG…"), self._save)

    def pages(self, page: FilePage) -> PicturesPage:
        """Return the pictures of a file, made when they are first asked for."""
        if page.pictures is None:
            pictures = PicturesPage(page.workspace)
            pictures.parameter_wanted.connect(lambda address: self._to_parameter(page, address))
            pictures.left.connect(lambda: self.show(page, False))
            pictures.told.connect(page.noted)
            pictures.parameter_chosen.connect(page.detail.show_address)
            page.take_pictures(pictures)
            return pictures
        assert isinstance(page.pictures, PicturesPage)
        return page.pictures

    def show(self, page: FilePage, wanted: bool) -> None:
        """Show the pictures of a file, or its table."""
        if wanted:
            self.pages(page)
        page.show_pictures(wanted)
        self.check(self.window.page)

    def check(self, page: FilePage | None) -> None:
        """Press the button where the file in front shows its pictures."""
        self.action.setChecked(page is not None and page.shows_pictures)

    def _toggle(self) -> None:
        page = self.window.page
        assert page is not None
        address = page.table_view.address()
        self.show(page, not page.shows_pictures)
        if page.shows_pictures and address is not None:
            self.pages(page).show_handle_of(address)

    def _to_parameter(self, page: FilePage, address: object) -> None:
        self.show(page, False)
        page.go_to(address)  # type: ignore[arg-type]
        page.table_view.setFocus()

    def _save(self) -> None:
        page = self.window.page
        assert page is not None
        self.show(page, True)
        card = self.pages(page).chosen_card
        if card is None:
            return
        own = page.workspace.path
        name = own.with_name(f"{own.stem}-{card.picture.name}.svg")
        text, _ = QFileDialog.getSaveFileName(self.window, self.tr("Save Picture"), str(name), "SVG (*.svg)")
        if text:
            path = Path(text if text.lower().endswith(".svg") else f"{text}.svg")
            check_output(path, own)
            write_atomic(path, scene_svg(card.canvas.scene).encode(), keep_backup=False)
            self.window.show_status(self.tr("{path} written").format(path=path))
