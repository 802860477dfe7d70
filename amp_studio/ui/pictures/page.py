"""The page of pictures of one file: all at once, or one large; under it the value of the chosen handle."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QSize, Qt, QTimer, Signal
from PySide6.QtGui import QFocusEvent, QResizeEvent
from PySide6.QtWidgets import QGridLayout, QLabel

from amp_studio.drawing import Handle, Scene
from amp_studio.files import RangeError
from amp_studio.pictures import drawn_in, pictures_of
from amp_studio.schema import Address, InvalidValueError
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.theme import GAP2, HEAD
from amp_studio.ui.base.translated import worded
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.handle_footer import HandleFooter

from .card import PictureCard
from .head import PicturesHead
from .split import SidePage

ALL = "all"
TWO_COLUMNS = 760
"""Width from which pictures are side by side."""
LOW = 420
"""Height below which they are in one row."""
MIN_CARD = 370, 230
"""Width and height from which a picture has its place in a row or in a column."""
AROUND = 2 * HEAD + 24
"""Height of head and footer, about."""
TEXT_ROW, AROUND_CARD = 13, HEAD + 44
"""Height of a line of text of a diagram, and of what is around the diagram in its frame."""
SELECTION_MS = 200
"""Milliseconds until the other views show the parameter of a handle;
passing by on the way to another one costs nothing."""
MARK_MS = 60
"""Milliseconds until the handle of a value that was selected elsewhere is shown; likewise."""
SIDE = 3
"""Pictures beside the first one, at most."""


class PicturesPage(SidePage):
    """Every picture of a file; it follows the file while it is seen."""

    parameter_requested = Signal(object)
    left = Signal()
    """Esc: back to the table."""
    closed = Signal()
    notified = Signal(str)
    parameter_chosen = Signal(object)
    """The address of a handle that has had the focus for a moment and is not dragged."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self.workspace = workspace
        self.setAccessibleName(self.tr("Pictures"))
        self.setFocusPolicy(Qt.FocusPolicy.ClickFocus)
        self._pictures = {picture.name: picture for picture in pictures_of(workspace.file)}
        self.cards: dict[str, PictureCard] = {}
        """Those that were seen already."""
        self._active: PictureCard | None = None
        self._placed = (0, False)
        self._stale = False
        self._selection_timer = single_shot(self, self._emit_parameter, SELECTION_MS)
        self._seen: list[PictureCard] = []
        self._selected: Address | None = None
        """The value that is selected elsewhere."""
        self._front = ""
        """The picture that must be seen among all: the one of the selected value."""
        self._mark = single_shot(self, self._mark_selected, MARK_MS)
        self.head = PicturesHead()
        self.head.chosen.connect(self.show_picture)
        self.head.closed.connect(self.closed)
        self._filter = ALL
        self.grid = QGridLayout()
        self.grid.setContentsMargins(GAP2, 0, GAP2, GAP2)
        self.grid.setSpacing(GAP2)
        self._nothing = QLabel(self.tr("This family has no pictures."))
        self._nothing.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.grid.addWidget(self._nothing, 0, 0)
        self.footer = HandleFooter(workspace)
        in_column(self.head, (self.grid, 1), self.footer, on=self, margins=0, gap=0)
        self.footer.entered.connect(self._enter)
        self.footer.left.connect(self._to_handle)
        self._build()
        workspace.changed.connect(self._follow)

    # -- which pictures --------------------------------------------------------------

    def _build(self) -> None:
        options = [(name, worded(picture.title), "") for name, picture in self._pictures.items()]
        self.head.offer([(ALL, self.tr("All"), ""), *options])
        self._nothing.setVisible(not self._pictures)
        self.show_picture(self._filter if self._filter in self._pictures else ALL)

    def card(self, name: str) -> PictureCard:
        """Return the card of a picture, made when it is first seen."""
        if name not in self.cards:
            card = self.cards[name] = PictureCard(self.workspace, self._pictures[name])
            card.parameter_requested.connect(self.parameter_requested)
            card.enlarged.connect(self.show_picture)
            card.canvas.handle_chosen.connect(partial(self._choose, card))
            card.canvas.typed.connect(self.footer.type)
            card.canvas.left.connect(self.left)
            card.canvas.notified.connect(self.notified)
        return self.cards[name]

    @property
    def chosen_card(self) -> PictureCard | None:
        """The picture of the chosen handle, or the first one that is seen; None where the family has none."""
        return self._active if self._active in self._seen else next(iter(self._seen), None)

    @property
    def filter_name(self) -> str:
        """The name of the picture that is shown, or ``all``."""
        return self._filter

    def show_picture(self, name: str) -> None:
        """Show one picture large, or all of them."""
        self._filter = name
        self.head.show_choice(name)
        self._arrange()
        self.least_changed.emit()

    @property
    def least_height(self) -> int:
        """The height below which the texts of the one picture that is shown overlap; 0 for any height."""
        rows = self._seen[0].canvas.scene.rows if self._filter != ALL and self._seen else 0
        return AROUND + AROUND_CARD + rows * TEXT_ROW if rows else 0

    def _shape(self) -> tuple[int, bool]:
        """Return how many pictures there is room for, and whether the first one is larger than the others."""
        if self._filter != ALL:
            return 1, False
        across, down = self.width() // MIN_CARD[0], (self.height() - AROUND) // MIN_CARD[1]
        if self.width() >= TWO_COLUMNS and self.height() >= LOW:
            return 1 + min(max(down, 1), SIDE), True
        return min(max(across if self.height() < LOW else down, 1), 1 + SIDE), False

    def _names_for(self, count: int) -> list[str]:
        """Return the pictures for so many places, that of the selected value among them."""
        names = list(self._pictures)
        if self._filter in names:
            return [self._filter]
        first = names[:count]
        return first if self._front in ("", *first) else [*first[:-1], self._front]

    def _arrange(self) -> None:
        """Put the cards into the grid: the first one large and others beside it, in a row or a column,
        or one alone.
        """
        self._placed = count, is_large = self._shape()
        names = self._names_for(count)
        several = len(names) > 1
        hidden = [card for card in self.cards.values() if card not in self._seen]
        seen = [self.card(each) for each in names]
        for card in seen:
            if card in hidden:  # it did not follow the file meanwhile
                card.follow(self._pictures[card.picture.name])
        for card in self.cards.values():
            self.grid.removeWidget(card)
        is_row = self.height() < LOW
        for n, card in enumerate(seen):
            card.small = several
            self.grid.addWidget(card, *_place_in_grid(n, len(seen), is_large=is_large, is_row=is_row))
            card.show_notes()
        self._stretch(len(seen), is_large=is_large, is_row=is_row)
        for card in self.cards.values():
            card.setVisible(card in seen)
        self._seen = seen

    def _stretch(self, count: int, *, is_large: bool, is_row: bool) -> None:
        """Divide the room among the cards of a row or a column, or the large one and those beside it."""
        for column in range(1 + SIDE):
            self.grid.setColumnStretch(column, int(column < count if is_row else column == 0))
            self.grid.setRowStretch(column, int(column < count - is_large and not is_row))
        if is_large:
            self.grid.setColumnStretch(0, 6)
            self.grid.setColumnStretch(1, 5 if count > 1 else 0)

    def minimumSizeHint(self) -> QSize:
        """Return room for one picture: more of them go where there is no room."""
        return QSize(240, 200)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if self._shape() != self._placed:
            QTimer.singleShot(0, self, self._arrange)  # not while the layout is at work

    # -- following the file ------------------------------------------------------------

    def _follow(self, addresses: list[Address]) -> None:
        if not self.isVisible():
            self._stale = True
            return
        if any(card.canvas.is_dragging for card in self._seen):  # the rest follows when the handle is dropped
            self._follow_drag(addresses)
            return
        names = list(self._pictures)
        self._pictures = {picture.name: picture for picture in pictures_of(self.workspace.file)}
        if names != list(self._pictures):  # axes came or went
            self._drop_cards()
            self._build()
        for card in self._seen:
            card.follow(self._pictures[card.picture.name])
        self.footer.show_handle(self._active.canvas.handle if self._active else None)

    def _follow_drag(self, addresses: list[Address]) -> None:
        """Draw again what shows the value that is dragged elsewhere."""
        for card in self._seen:
            if card.canvas.is_dragging:
                card.canvas.mark_findings()
            elif set(addresses) & set(card.canvas.scene.drawn_from):
                card.canvas.draw_again()

    def _drop_cards(self) -> None:
        """Remove the cards of pictures that there are no longer."""
        self._front = self._front if self._front in self._pictures else ""
        for name in [name for name in self.cards if name not in self._pictures]:
            card = self.cards.pop(name)
            self.grid.removeWidget(card)
            card.hide()
            card.deleteLater()
            self._seen = [each for each in self._seen if each is not card]
            self._active = None if self._active is card else self._active

    def showEvent(self, event: object) -> None:
        super().showEvent(event)  # type: ignore[arg-type]  # Qt gives the event of this kind
        if self._stale:
            self._follow([])
            self._stale = False

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Give the focus to the first handle."""
        super().focusInEvent(event)
        if self._seen:
            self._seen[0].canvas.setFocus()

    # -- the chosen handle ---------------------------------------------------------------

    def show_handle_of(self, address: Address, *, focus: bool = True) -> None:
        """Choose the handle of a value, in its picture; nothing where no picture has one."""
        self._selected = address
        inner = sorted(self._pictures.values(), key=lambda each: each.name not in self._seen_names())
        found = drawn_in(inner, address)
        if found is None:
            self._choose_alone(None)
            return
        name, part = found
        self._front = name
        if self.card(name) not in self._seen:
            self._arrange() if self._filter == ALL and not focus else self.show_picture(name)
        card = self.card(name)
        if card.part != part:
            card.show_part(part)
        own = _handle_of(card.canvas.scene, address)
        if own is not None:
            self._choose_alone(card)
            card.canvas.choose(own)
            if focus:
                card.canvas.focus_handle()
            else:
                self._selection_timer.stop()  # who selected the value knows it

    def _seen_names(self) -> set[str]:
        return {card.picture.name for card in self._seen}

    def _choose_alone(self, card: PictureCard | None) -> None:
        """Let one card have the chosen handle."""
        for each in self.cards.values():
            if each is not card:
                each.canvas.choose(None)

    def show_selected(self, address: Address | None) -> None:
        """Mark the handle of a value that was selected elsewhere, without taking the focus."""
        is_same = address == self._selected  # the table comes and goes: what a person has chosen stays
        self._selected = address
        if self.isVisible() and not is_same:
            self._mark.start()

    def _mark_selected(self) -> None:
        handle = self._active.canvas.handle if self._active in self._seen and self._active else None
        known = () if handle is None else [drag.address for drag in handle.drags]
        is_dragging = any(card.canvas.is_dragging for card in self._seen)
        if self._selected is not None and self._selected not in known and not is_dragging:
            self.show_handle_of(self._selected, focus=False)

    def _emit_parameter(self) -> None:
        handle = self._active.canvas.handle if self._active else None
        if handle is not None and self._active is not None:
            if self._active.canvas.is_dragging:
                self._selection_timer.start()
            else:
                self.parameter_chosen.emit(handle.drags[0].address)

    def _choose(self, card: PictureCard, handle: Handle | None) -> None:
        self._active = card if handle is not None else self._active
        if card is self._active:
            self.footer.show_handle(handle)
        if handle is not None and not card.canvas.is_dragging:
            self._mark.stop()  # what was selected before is of the past
            self._selection_timer.start()

    def _enter(self, text: str) -> None:
        """Set the value that was typed for the chosen handle."""
        card = self._active
        if card is None or card.canvas.handle is None:
            return
        address = card.canvas.handle.drags[0].address
        try:
            value = self.workspace.read(address, text)
            if value is not None:
                self.workspace.edit(
                    self.tr("Set {name}").format(name=card.canvas.handle.label), {address: value}
                )
        except (RangeError, InvalidValueError) as error:
            self.footer.refuse(str(error))
            return
        self._to_handle()

    def _to_handle(self) -> None:
        if self._active is not None:
            self.footer.show_handle(self._active.canvas.handle)
            self._active.canvas.focus_handle()


def _handle_of(scene: Scene, address: Address) -> int | None:
    """Return the place of the handle that moves one value alone."""
    owns = ([drag.address for drag in handle.drags] for handle in scene.handles)
    return next((n for n, own in enumerate(owns) if own == [address]), None)


def _place_in_grid(n: int, count: int, *, is_large: bool, is_row: bool) -> tuple[int, int, int, int]:
    """Return row, column and their numbers for the ``n``-th card."""
    if is_large:
        return (0, 0, max(count - 1, 1), 1) if n == 0 else (n - 1, 1, 1, 1)
    return (0, n, 1, 1) if is_row else (n, 0, 1, 1)
