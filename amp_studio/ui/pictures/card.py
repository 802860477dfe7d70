"""One picture in a frame: its head with the choice of its part, and its notes."""

from __future__ import annotations

from html import escape

from PySide6.QtCore import QLocale, Qt, Signal
from PySide6.QtGui import QPalette, QResizeEvent
from PySide6.QtWidgets import QComboBox, QFrame, QLabel, QWidget

from amp_studio.drawing import Scene, scene_in_words
from amp_studio.pictures import FASTEST, FilePicture
from amp_studio.ui.base.figures import unbroken
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.theme import GAP2, GAP3, HEAD, colour, font, scheme
from amp_studio.ui.base.translated import language_of_window, sentenced, unit_in_words, worded
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.elided_label import ElidedLabel
from amp_studio.ui.forms.icon_button import icon_button
from amp_studio.ui.forms.number_box import NumberBox
from amp_studio.ui.forms.segment import Segment

from .canvas import PictureCanvas

MAX_PARTS = 6
"""Parts that are buttons; more of them are a list."""
MAX_NOTES = {True: 1, False: 4}
"""Notes under a picture: beside others, alone."""

_MORE = 110
"""Width of what follows an elided note."""
_TITLE_ROOM, _PART = 190, 50
"""Width of the head without its parts, and of a part, about."""
_LOW = 330
"""Height from which a picture alone has room for several lines of notes."""


class PictureCard(QFrame):
    """One picture with its head, the choice of its part, and its notes."""

    parameter_requested = Signal(object)
    enlarged = Signal(str)
    """The name of the picture: it is to be shown alone."""

    def __init__(self, workspace: Workspace, picture: FilePicture) -> None:
        super().__init__()
        self._workspace, self.picture = workspace, picture
        self.part = picture.parts[0][0]
        self.small = True
        """Whether it is beside others."""
        self.canvas = PictureCanvas(workspace, self._draw)
        self.title, self.subtitle = ElidedLabel(), ElidedLabel()
        self.title.setFont(font("text", own=True))
        self.subtitle.setFont(font("small"))
        self.subtitle.setForegroundRole(QPalette.ColorRole.PlaceholderText)
        self.parts = Segment(self.tr("Part of {name}").format(name=worded(picture.title)))
        self.parts.chosen.connect(self.show_part)
        self.more_parts = QComboBox()
        self.more_parts.setAccessibleName(self.parts.accessibleName())
        self.more_parts.activated.connect(lambda n: self.show_part(self.more_parts.itemData(n)))
        self.speed = NumberBox()
        self.speed.setDecimals(1)
        self.speed.setRange(0.1, FASTEST)
        self.speed.setValue(FASTEST)
        self.speed.setLocale(QLocale(language_of_window()))
        self.speed.setSuffix(" %")
        self.speed.setToolTip(self.tr("Speed of the signals, in % of the rapid feedrate"))
        self.speed.setAccessibleName(self.speed.toolTip())
        self.speed.valueChanged.connect(lambda _: self.show_part(self._axis))
        self.notes = QLabel()
        self.notes.setFont(font("small"))
        self.notes.setMinimumWidth(1)
        self.notes.setTextInteractionFlags(Qt.TextInteractionFlag.LinksAccessibleByMouse)
        self.notes.setContentsMargins(GAP3, 2, GAP3, GAP2)
        self.notes.linkActivated.connect(self._follow)
        spoken = self.tr("Show {name} alone").format(name=worded(picture.title))
        self.enlarge = icon_button("arrows-out-simple", self.tr("Show this picture alone"), spoken=spoken)
        self.enlarge.clicked.connect(lambda: self.enlarged.emit(self.picture.name))
        bar = QWidget()
        bar.setFixedHeight(HEAD)
        in_row(
            self.title,
            (self.subtitle, 1),
            self.parts,
            self.more_parts,
            self.speed,
            self.enlarge,
            on=bar,
            margins=(GAP3, 0, GAP2, 0),
            gap=GAP2,
        )
        in_column(bar, (self.canvas, 1), self.notes, on=self, margins=(1, 0, 1, 1), gap=0)
        self.canvas.parameter_requested.connect(self.parameter_requested)
        scheme().changed.connect(self.show_notes)
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self._offer_parts()
        self._describe()

    def _draw(self, like: Scene | None) -> Scene:
        return scene_in_words(self.picture.scene(self.part, like), self._words, unit_in_words)

    def _words(self, text: str) -> str:
        return sentenced(text, self._workspace.file.schema.family.family)

    def show_part(self, key: str) -> None:
        """Draw another part, at the chosen speed where there is one."""
        at = self.speed.value()
        self.part = f"{key}@{at:g}" if self.picture.has_speed and at < FASTEST else key
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
        few = len(options) <= MAX_PARTS and not self._is_crowded(len(options))
        self.parts.setVisible(len(options) > 1 and few)
        self.more_parts.setVisible(not few)
        if few:
            self.parts.offer(options)
        # Filled again only when it is another list: an open one would close under the pointer.
        elif [self.more_parts.itemData(n) for n in range(self.more_parts.count())] != [
            key for key, _, _ in options
        ]:
            self.more_parts.clear()
            for key, name, _ in options:
                self.more_parts.addItem(name, key)

    @property
    def _axis(self) -> str:
        """The part without the speed at which it is drawn."""
        return self.part.partition("@")[0] if self.picture.has_speed else self.part

    def _is_crowded(self, count: int) -> bool:
        """Return whether so many buttons would leave the title no room."""
        return self.isVisible() and self.width() < _TITLE_ROOM + _PART * count

    def _describe(self) -> None:
        scene = self.canvas.scene
        self.title.setText(scene.title)
        self.subtitle.setText(scene.subtitle)
        self.parts.show_choice(self._axis)
        self.more_parts.setCurrentIndex(self.more_parts.findData(self._axis))
        self.show_notes()

    def show_notes(self) -> None:
        """Show what is not drawn and why, what is wrong first; each leads to its parameter."""
        self.enlarge.setVisible(self.small)
        self.speed.setVisible(self.picture.has_speed and not self.small)
        is_brief = self._is_brief
        self.notes.setWordWrap(not is_brief)
        # What is wrong comes first: a card beside others shows one line.
        notes = sorted(self.canvas.scene.notes, key=lambda note: note.order)
        most = MAX_NOTES[is_brief]
        lines = []
        for note in notes[:most]:
            shade = colour("error" if note.wrong else "dim").name()
            text = escape(self._room_for(note.text))
            if note.address is not None:
                link = f"{note.address[0]}@{note.address[1]}"
                text = f'<a href="{link}" style="color: {shade}; text-decoration: none">{text}</a>'
            lines.append(f'<span style="color: {shade}">{text}</span>')
        if len(notes) > most:
            more = self.tr("%n more", "", len(notes) - most)
            lines.append(f'<span style="color: {colour("dim").name()}">{escape(more)}</span>')
        self.notes.setVisible(bool(lines))
        self.notes.setText(unbroken("<br>".join(lines) if not is_brief else " · ".join(lines)))
        self.notes.setToolTip("\n".join(note.text for note in notes))

    @property
    def _is_brief(self) -> bool:
        """Whether notes have one line: beside other pictures, and in a low room."""
        return self.small or self.height() < _LOW

    def _room_for(self, text: str) -> str:
        """Return a note in one line where the picture is beside others: a second line would take its room."""
        if not self._is_brief:
            return text
        return self.notes.fontMetrics().elidedText(text, Qt.TextElideMode.ElideRight, self.width() - _MORE)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._offer_parts()
        self.parts.show_choice(self._axis)
        self.more_parts.setCurrentIndex(self.more_parts.findData(self._axis))
        self.show_notes()

    def _follow(self, link: str) -> None:
        parameter, _, instance = link.partition("@")
        self.parameter_requested.emit((parameter, instance))
