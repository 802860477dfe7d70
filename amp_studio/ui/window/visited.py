"""The places that were visited in the open files, as in a browser: back, forward, and the menu of them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

from PySide6.QtWidgets import QMenu

from amp_studio.files import describe
from amp_studio.schema import Address, Parameter
from amp_studio.ui.base.translated import Translated
from amp_studio.ui.page.file_page import FilePage

from .studio_window import StudioWindow

_KEPT, _IN_MENU = 60, 9


@dataclass(frozen=True)
class _Visit:
    page: FilePage
    title: str
    parameters: list[Parameter]
    """What the table showed."""
    address: Address
    turned_to: str
    """The page that was in the place of the values; empty for these."""


class VisitedPlaces(Translated):
    """A place is a page, or what the table showed, with the last cell there; moving within it is no new
    place.
    """

    def __init__(self, window: StudioWindow) -> None:
        self._window = window
        self._places: list[_Visit] = []
        self._at = -1
        self._is_going = False
        self.menu = QMenu(self.tr("Recent P&laces"), window)
        self.menu.aboutToShow.connect(self._fill)
        window.tabs.current_changed.connect(self._remember)

    def add(self, page: FilePage) -> None:
        """Follow the selection of a page, and what is shown in its place."""
        page.selected.connect(lambda *_: self._remember(page))
        page.turned.connect(lambda: self._remember(page))

    def forget(self, page: FilePage) -> None:
        """Drop the places of a page that closes: they, and the menu, would keep its whole file."""
        # Counted before they are dropped: as many places as are left up to the present one.
        self._at = sum(place.page is not page for place in self._places[: self._at + 1]) - 1
        self._places = [place for place in self._places if place.page is not page]
        self.menu.clear()

    def _remember(self, page: FilePage | None) -> None:
        if self._is_going or page is None or page is not self._window.page:
            return
        address = page.table_view.address()
        if address is None:
            return
        place = _Visit(page, page.listed_title, page.table.asked, address, page.turned_to)
        if self._at >= 0 and self._is_same(place, self._places[self._at]):
            self._places[self._at] = replace(self._places[self._at], address=address)
            return
        # What lay ahead is dropped, as in a browser.
        self._places = [*self._places[: self._at + 1], place][-_KEPT:]
        self._at = len(self._places) - 1

    @staticmethod
    def _is_same(one: _Visit, other: _Visit) -> bool:
        is_list = not one.turned_to
        return (one.page, one.turned_to) == (other.page, other.turned_to) and (
            not is_list or one.parameters == other.parameters
        )

    def go(self, step: int) -> None:
        """Go one place back (-1) or forward (1); from the page at the control back to the values."""
        if step < 0 and self._window.leave_control():
            return
        at = self._at + step
        if 0 <= at < len(self._places):
            self._go_to(self._places[at])
        elif step < 0:
            self._window.show_status(self.tr("This is the first place that was visited."))
        else:
            self._window.show_status(self.tr("This is the place that was visited last."))

    def _go_to(self, place: _Visit) -> None:
        self._is_going = True
        try:
            self._window.tabs.bring(place.page)
            place.page.show_page(place.turned_to)
            if place.page.turned_to != place.turned_to:
                return  # a page with work that would be lost stays
            if not place.turned_to:
                place.page.show_list(place.title, place.parameters, place.address)
            self._at = self._places.index(place)
        finally:
            self._is_going = False

    def _fill(self) -> None:
        """List the places, the present one first; one that was visited more than once has its last visit."""
        listed: list[_Visit] = []
        for place in reversed(self._places):
            if not any(self._is_same(place, each) for each in listed):
                listed.append(place)
        names = [self._name_of(place) for place in listed[:_IN_MENU]]
        if [action.data() for action in self.menu.actions()] == (names or [""]):
            return
        self.menu.clear()
        for n, (name, place) in enumerate(zip(names, listed, strict=False), 1):
            action = self.menu.addAction(f"&{n} {name.replace('&', '&&')}")
            action.setData(name)
            action.triggered.connect(
                lambda *_, place=place: self._window.guarded(partial(self._go_to, place), self.tr("Go To"))
            )
        if not names:
            none = self.menu.addAction(self.tr("&No place has been visited yet."))
            none.setData("")
            none.setEnabled(False)

    @staticmethod
    def _name_of(place: _Visit) -> str:
        file = place.page.workspace.file
        if place.turned_to:
            front = place.page.pages[place.turned_to]
            return f"{place.page.workspace.path.stem}: {front.accessibleName()}"
        return f"{place.page.workspace.path.stem}: {place.title}, {describe(file, place.address)}"
