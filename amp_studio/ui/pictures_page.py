"""The page of pictures of one file: all at once, or one large; under it the value of the chosen handle."""

from __future__ import annotations

from functools import partial
from html import escape

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QFocusEvent, QPalette, QResizeEvent
from PySide6.QtWidgets import (
    QComboBox,
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from amp_studio.files import RangeError
from amp_studio.pictures import FilePicture, Handle, Scene, pictures_of
from amp_studio.schema import (
    Address,
    InvalidValueError,
    Value,
    convert,
    dimension,
    show_value,
    shown,
    write_figure,
    write_value,
)

from .picture_canvas import PictureCanvas
from .segment import Segment
from .theme import CONTROL, GAP2, GAP3, HEAD, colour, font, icon, scheme
from .workspace import Workspace

ALL = "all"
TWO_COLUMNS = 760
"""Width from which pictures are side by side."""
SIDE = 3
"""Pictures beside the first one."""
MOST_PARTS = 6
"""Parts that are buttons; more of them are a list."""
MOST_NOTES = {True: 1, False: 4}
"""Notes under a picture: beside others, alone."""


class PictureCard(QFrame):
    """One picture with its head, the choice of its part, and its notes."""

    parameter_wanted = Signal(object)

    def __init__(self, workspace: Workspace, picture: FilePicture) -> None:
        super().__init__()
        self._workspace, self.picture = workspace, picture
        self.part = picture.parts[0][0]
        self.small = True
        """Whether it is beside others."""
        self.canvas = PictureCanvas(workspace, self._draw)
        self.title, self.subtitle = QLabel(), QLabel()
        self.title.setFont(font("text", own=True))
        self.subtitle.setFont(font("small"))
        self.subtitle.setForegroundRole(QPalette.ColorRole.PlaceholderText)
        self.subtitle.setMinimumWidth(20)
        self.parts = Segment(self.tr("Part of {name}").format(name=picture.title))
        self.parts.chosen.connect(self.show_part)
        self.more_parts = QComboBox()
        self.more_parts.setAccessibleName(self.parts.accessibleName())
        self.more_parts.activated.connect(lambda n: self.show_part(self.more_parts.itemData(n)))
        self.notes = QLabel()
        self.notes.setFont(font("small"))
        self.notes.setWordWrap(True)
        self.notes.setTextInteractionFlags(Qt.TextInteractionFlag.LinksAccessibleByMouse)
        self.notes.setContentsMargins(GAP3, 2, GAP3, GAP2)
        self.notes.linkActivated.connect(self._follow)
        head = QHBoxLayout()
        head.setContentsMargins(GAP3, 0, GAP2, 0)
        head.setSpacing(GAP2)
        for widget, stretch in ((self.title, 0), (self.subtitle, 1), (self.parts, 0), (self.more_parts, 0)):
            head.addWidget(widget, stretch)
        bar = QWidget()
        bar.setFixedHeight(HEAD)
        bar.setLayout(head)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(1, 0, 1, 1)
        layout.setSpacing(0)
        layout.addWidget(bar)
        layout.addWidget(self.canvas, 1)
        layout.addWidget(self.notes)
        self.canvas.parameter_wanted.connect(self.parameter_wanted)
        scheme().changed.connect(self.show_notes)
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self._offer_parts()
        self._describe()

    def _draw(self, like: Scene | None) -> Scene:
        return self.picture.scene(self.part, like)

    def show_part(self, key: str) -> None:
        """Draw another part."""
        self.part = key
        self.canvas.show_drawn(self._draw)
        self._describe()

    def follow(self, picture: FilePicture) -> None:
        """Draw again after a change; a part that is no longer offered stays while it can be drawn."""
        self.picture = picture
        try:
            picture.key(self.part.replace("+", " "))
        except KeyError:
            self.part = picture.parts[0][0]
        self._offer_parts()
        self.canvas.draw_again()
        if not self.canvas.is_dragging:  # a note more or less would move the picture under the pointer
            self._describe()

    def _offer_parts(self) -> None:
        options = [(key, name or key, "") for key, name in self.picture.parts]
        few = len(options) <= MOST_PARTS
        self.parts.setVisible(len(options) > 1 and few)
        self.more_parts.setVisible(not few)
        if few:
            self.parts.offer(options)
        elif [self.more_parts.itemData(n) for n in range(self.more_parts.count())] != [
            key for key, _, _ in options
        ]:
            self.more_parts.clear()
            for key, name, _ in options:
                self.more_parts.addItem(name, key)

    def _describe(self) -> None:
        scene = self.canvas.scene
        self.title.setText(scene.title)
        self.subtitle.setText(scene.subtitle)
        self.parts.show_choice(self.part)
        self.more_parts.setCurrentIndex(self.more_parts.findData(self.part))
        self.show_notes()

    def show_notes(self) -> None:
        """Show what is not drawn and why, what is wrong first; each leads to its parameter."""
        notes = sorted(self.canvas.scene.notes, key=lambda note: not note.wrong)
        most = MOST_NOTES[self.small]
        lines = []
        for note in notes[:most]:
            ink = colour("error" if note.wrong else "dim").name()
            text = escape(note.text)
            if note.address is not None:
                link = f"{note.address[0]}@{note.address[1]}"
                text = f'<a href="{link}" style="color: {ink}; text-decoration: none">{text}</a>'
            lines.append(f'<span style="color: {ink}">{text}</span>')
        if len(notes) > most:
            more = self.tr("%n more", "", len(notes) - most)
            lines.append(f'<span style="color: {colour("dim").name()}">{escape(more)}</span>')
        self.notes.setVisible(bool(lines))
        self.notes.setText("<br>".join(lines) if not self.small else " · ".join(lines))
        self.notes.setToolTip("\n".join(note.text for note in notes))

    def _follow(self, link: str) -> None:
        parameter, _, instance = link.partition("@")
        self.parameter_wanted.emit((parameter, instance))


class PicturesPage(QWidget):
    """Every picture of a file; it follows the file while it is seen."""

    parameter_wanted = Signal(object)
    left = Signal()
    """Esc: back to the table."""
    told = Signal(str)

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self.workspace = workspace
        self.setAccessibleName(self.tr("Pictures"))
        self.setFocusPolicy(Qt.FocusPolicy.ClickFocus)
        self._pictures = {picture.name: picture for picture in pictures_of(workspace.file)}
        self.cards: dict[str, PictureCard] = {}
        """Those that were seen already."""
        self._active: PictureCard | None = None
        self._stale = False
        self._seen: list[PictureCard] = []
        self.names = Segment(self.tr("Pictures"))
        self.names.chosen.connect(self.show_picture)
        self.close_button = QToolButton()
        self.close_button.setIcon(icon("x"))
        self.close_button.setToolTip(self.tr("Back to the table (Esc)"))
        self.close_button.setAccessibleName(self.tr("Back to the table"))
        self.close_button.clicked.connect(self.left)
        heading = QLabel(self.tr("Pictures"))
        heading.setFont(font("title"))
        head = QHBoxLayout()
        head.setContentsMargins(GAP3, 0, GAP2, 0)
        head.addWidget(heading)
        head.addStretch(1)
        head.addWidget(self.names)
        head.addWidget(self.close_button)
        bar = QWidget()
        bar.setFixedHeight(HEAD + 6)
        bar.setLayout(head)
        self.grid = QGridLayout()
        self.grid.setContentsMargins(GAP2, 0, GAP2, GAP2)
        self.grid.setSpacing(GAP2)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(bar)
        layout.addLayout(self.grid, 1)
        self.footer = HandleFooter(workspace)
        layout.addWidget(self.footer)
        self.footer.entered.connect(self._enter)
        self.footer.left.connect(self._to_handle)
        self._build()
        workspace.changed.connect(self._follow)

    # -- which pictures --------------------------------------------------------------

    def _build(self) -> None:
        options = [(name, picture.title, "") for name, picture in self._pictures.items()]
        self.names.offer([(ALL, self.tr("All"), ""), *options])
        self.show_picture(ALL)

    def card(self, name: str) -> PictureCard:
        """Return the card of a picture, made when it is first seen."""
        if name not in self.cards:
            card = self.cards[name] = PictureCard(self.workspace, self._pictures[name])
            card.parameter_wanted.connect(self.parameter_wanted)
            card.canvas.handle_chosen.connect(partial(self._choose, card))
            card.canvas.typed.connect(self.footer.type)
            card.canvas.left.connect(self.left)
            card.canvas.told.connect(self.told)
        return self.cards[name]

    @property
    def chosen_card(self) -> PictureCard:
        """The picture of the chosen handle, or the first one that is seen."""
        return self._active if self._active in self._seen and self._active else self._seen[0]

    @property
    def shown(self) -> str:
        """The name of the picture that is shown, or ``all``."""
        return self.names.choice or ALL

    def show_picture(self, name: str) -> None:
        """Show one picture large, or all of them."""
        self.names.show_choice(name)
        self._arrange()

    def _arrange(self) -> None:
        """Put the cards into the grid: the first one large and others beside it, or one alone."""
        name, names = self.shown, list(self._pictures)
        two = name == ALL and self.width() >= TWO_COLUMNS and len(names) > 1
        wanted = names[: 1 + SIDE] if two else [name] if name in self._pictures else names[:1]
        hidden = [card for card in self.cards.values() if card not in self._seen]
        seen = [self.card(each) for each in wanted]
        for card in seen:
            if card in hidden:  # it did not follow the file meanwhile
                card.follow(self._pictures[card.picture.name])
        for card in self.cards.values():
            self.grid.removeWidget(card)
        for n, card in enumerate(seen):
            card.small = two
            if n == 0:
                self.grid.addWidget(card, 0, 0, max(len(seen) - 1, 1), 1)
            else:
                self.grid.addWidget(card, n - 1, 1)
            card.show_notes()
        self.grid.setColumnStretch(0, 6)
        self.grid.setColumnStretch(1, 5 if two else 0)
        for card in self.cards.values():
            card.setVisible(card in seen)
        self._seen = seen

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        two = self.width() >= TWO_COLUMNS
        if self.shown == ALL and two != (len(self._seen) > 1) and len(self._pictures) > 1:
            QTimer.singleShot(0, self, self._arrange)  # not while the layout is at work

    # -- following the file ------------------------------------------------------------

    def _follow(self, addresses: list[Address]) -> None:
        if not self.isVisible():
            self._stale = True
            return
        if any(card.canvas.is_dragging for card in self._seen):  # the rest follows when the handle is dropped
            for card in self._seen:
                if card.canvas.is_dragging:
                    card.canvas.mark_findings()
                elif set(addresses) & set(card.canvas.scene.drawn_from):
                    card.canvas.draw_again()
            return
        self._pictures = {picture.name: picture for picture in pictures_of(self.workspace.file)}
        for card in self._seen:
            card.follow(self._pictures.get(card.picture.name, card.picture))
        self.footer.show_handle(self._active.canvas.handle if self._active else None)

    def showEvent(self, event: object) -> None:
        super().showEvent(event)  # type: ignore[arg-type]
        if self._stale:
            self._follow([])
            self._stale = False

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Give the focus to the first handle."""
        super().focusInEvent(event)
        if self._seen:
            self._seen[0].canvas.setFocus()

    # -- the chosen handle ---------------------------------------------------------------

    def _choose(self, card: PictureCard, handle: Handle | None) -> None:
        self._active = card if handle is not None else self._active
        if card is self._active:
            self.footer.show_handle(handle)

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


class HandleFooter(QFrame):
    """Name, value and step of the chosen handle; the value can be typed."""

    entered = Signal(str)
    left = Signal()

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self._workspace = workspace
        self.name, self.more, self.keys = QLabel(), QLabel(), QLabel()
        self.name.setFont(font("text", own=True))
        self.field = QLineEdit()
        self.field.setFixedWidth(150)
        self.field.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.field.returnPressed.connect(lambda: self.entered.emit(self.field.text()))
        self.field.installEventFilter(self)
        for label in (self.more, self.keys):
            label.setFont(font("small"))
            label.setForegroundRole(QPalette.ColorRole.PlaceholderText)
        for label in (self.name, self.more, self.keys):
            label.setMinimumWidth(1)  # a long name never widens the page
        row = QHBoxLayout(self)
        row.setContentsMargins(GAP3, 4, GAP3, 4)
        row.setSpacing(GAP3)
        row.addWidget(self.name)
        row.addWidget(self.field)
        row.addWidget(self.more, 1)
        row.addWidget(self.keys)
        self.setFixedHeight(CONTROL + 14)  # the same with a handle and without, or the picture would move
        self.show_handle(None)

    def show_handle(self, handle: Handle | None) -> None:
        """Show a handle; without one what can be done."""
        self.more.setForegroundRole(QPalette.ColorRole.PlaceholderText)
        has_one = handle is not None and len(handle.drags) == 1
        self.field.setVisible(has_one)
        self.keys.setVisible(handle is not None)
        if handle is None:
            self.name.setText("")
            self.more.setText(self.tr("Drag a handle, or go to it with Tab and use the arrow keys"))
            return
        self.name.setText(handle.label)
        drag = handle.drags[0]
        step = f"{drag.step:g} {shown(drag.unit)}".strip()
        self.keys.setText(self.tr("← → {step}, Shift 10").format(step=step))
        if has_one and not self.field.hasFocus():
            self.field.setText(self._typed(drag.address))
            self.field.setAccessibleName(handle.label)
        self.more.setText(self._default(drag.address) if has_one else handle.value)

    def _typed(self, address: Address) -> str:
        """Return a value as it would be typed, in the unit of the file."""
        file = self._workspace.file
        value, unit = file.get(address), self._workspace.typed_unit(address)
        if (
            value is not None
            and not isinstance(value.value, (str, bool))
            and dimension(value.unit) == dimension(unit)
        ):
            value = (
                Value(float(write_figure(convert(float(value.value), value.unit, unit))), unit)
                if unit != value.unit
                else value
            )
        return write_value(file.schema.parameters[address[0]], value)

    def _default(self, address: Address) -> str:
        file = self._workspace.file
        default = file.default(address)
        if default is None:
            return self.tr("No default")
        return self.tr("Default {value}").format(
            value=show_value(file.schema.parameters[address[0]], default)
        )

    def type(self, text: str) -> None:
        """Take a value from the keyboard, beginning with what was typed."""
        if not self.field.isVisible():
            return
        self.field.setFocus()
        if text:
            self.field.setText(text)
        else:
            self.field.selectAll()

    def refuse(self, reason: str) -> None:
        """Say why a value is not taken; it stays in the field."""
        self.more.setText(reason)
        self.more.setForegroundRole(QPalette.ColorRole.BrightText)

    def eventFilter(self, watched: object, event: object) -> bool:
        """Esc in the field gives the value up."""
        if event.type() == event.Type.KeyPress and event.key() == Qt.Key.Key_Escape:  # type: ignore[attr-defined]
            self.field.clearFocus()
            self.left.emit()
            return True
        return False
