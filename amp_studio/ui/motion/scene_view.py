"""A drawing in the window that is no picture of values: with places that are dragged, by mouse and keys."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QPointF, QRectF, QSize, QSizeF, Qt, Signal
from PySide6.QtGui import QMouseEvent, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from amp_studio.drawing import Placement, Point, Scene, scene_in_words
from amp_studio.schema import Address
from amp_studio.ui.base.scene_painter import ScenePainter
from amp_studio.ui.base.theme import colour, scheme
from amp_studio.ui.base.translated import sentenced, unit_in_words
from amp_studio.ui.forms.handle_spot import REACH, HandleSpot

STEPS = 200.0
"""Steps of a key over the picture."""
_HALF = 4.5
"""Half the side of a grip in logical pixels."""


class SceneView(QWidget):
    """Shows one scene; ``moved`` is where a grip is dragged to."""

    moved = Signal(str, object)
    """Name of a grip, and its place in the units of the scene."""
    parameter_requested = Signal(object)
    """The address of a name that was clicked."""

    def __init__(self) -> None:
        super().__init__()
        self.scene: Scene | None = None
        self.grips: dict[str, tuple[str, Point]] = {}
        """Name -> what a person calls it, and where it is."""
        self._spots: dict[str, HandleSpot] = {}
        self._dragged = ""
        self._names: list[tuple[QRectF, Address]] = []
        self.setMouseTracking(True)
        # Every pixel is painted here: Qt need not clear them before.
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        scheme().changed.connect(self.update)

    def sizeHint(self) -> QSize:
        return QSize(400, 240)

    def minimumSizeHint(self) -> QSize:
        return QSize(160, 90)

    def show_scene(self, scene: Scene | None, grips: Mapping[str, tuple[str, Point]] | None = None) -> None:
        """Show a scene in the language of the window, with what can be dragged in it."""
        self.scene = None if scene is None else scene_in_words(scene, sentenced, unit_in_words)
        self.grips = dict(grips or {})
        if self.scene is not None:
            notes = ". ".join(note.text for note in self.scene.notes)
            self.setAccessibleName(f"{self.scene.title}, {self.scene.subtitle}")
            self.setAccessibleDescription(notes)
        self._arrange()
        self.update()

    @property
    def place(self) -> Placement | None:
        """Where the scene lies."""
        if self.scene is None:
            return None
        return Placement.within(self.scene, float(self.width()), float(self.height()))

    def _arrange(self) -> None:
        place = self.place
        for name in [*self._spots]:
            if name not in self.grips:
                # Later: it may be the one whose event is being handled.
                self._spots.pop(name).deleteLater()
        for name, (called, at) in self.grips.items():
            spot = self._spots.get(name)
            if spot is None:
                spot = self._spots[name] = HandleSpot(self)
                spot.stepped.connect(lambda x, y, times, name=name: self._step(name, x, y, times))
                spot.show()
            spot.setAccessibleName(f"{called}: {at[0]:.6g}, {at[1]:.6g}")
            if place is not None:
                x, y = place.at(at)
                spot.move(int(x - REACH), int(y - REACH))

    def _step(self, name: str, right: int, up: int, times: int) -> None:
        if self.scene is None or name not in self.grips:
            return
        x, y = self.grips[name][1]
        wide, high = (scale.high - scale.low for scale in (self.scene.x, self.scene.y))
        self._move(name, (x + right * times * wide / STEPS, y + up * times * high / STEPS))

    def _move(self, name: str, at: Point) -> None:
        scene = self.scene
        if scene is None:
            return
        # A grip that was dragged out of the picture could not be taken back.
        inside = min(max(at[0], scene.x.low), scene.x.high), min(max(at[1], scene.y.low), scene.y.high)
        self.grips[name] = self.grips[name][0], inside
        self._arrange()
        self.update()
        self.moved.emit(name, inside)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._arrange()

    def paintEvent(self, event: QPaintEvent) -> None:
        with QPainter(self) as painter:
            painter.fillRect(self.rect(), colour("base"))
            if (place := self.place) is None:
                return
            shapes = ScenePainter(painter, place, QSizeF(self.size()))
            shapes.paint()
            self._names = list(shapes.named)
            for name, (_, at) in self.grips.items():
                x, y = place.at(at)
                painter.setPen(QPen(colour("sel"), 1.5))
                painter.setBrush(colour("sel" if name == self._dragged else "base"))
                painter.drawRect(QRectF(x - _HALF, y - _HALF, 2.0 * _HALF, 2.0 * _HALF))

    def _near(self, at: QPointF) -> str:
        place = self.place
        if place is None:
            return ""
        far = {}
        for name, (_, point) in self.grips.items():
            x, y = place.at(point)
            far[name] = ((x - at.x()) ** 2 + (y - at.y()) ** 2) ** 0.5
        nearest = min(far, key=lambda name: far[name], default="")
        return nearest if nearest and far[nearest] <= REACH else ""

    def _name_at(self, at: QPointF) -> Address | None:
        return next((address for box, address in self._names if box.contains(at)), None)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.LeftButton:
            return
        self._dragged = self._near(event.position())
        if self._dragged:
            # So that the arrow keys go on from where the mouse has dragged it.
            self._spots[self._dragged].setFocus(Qt.FocusReason.MouseFocusReason)
            self.update()
        elif (address := self._name_at(event.position())) is not None:
            self.parameter_requested.emit(address)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        place = self.place
        if self._dragged and place is not None:
            self._move(self._dragged, place.world(event.position().x(), event.position().y()))
            return
        at = event.position()
        over = bool(self._near(at)) or self._name_at(at) is not None
        self.setCursor(Qt.CursorShape.PointingHandCursor if over else Qt.CursorShape.ArrowCursor)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self._dragged = ""
        self.update()
