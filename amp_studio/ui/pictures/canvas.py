"""One picture on the screen: painted from its scene, with handles for the mouse, the keys and screen
readers.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from PySide6.QtCore import QPointF, QRect, QSize, QSizeF, Qt, Signal
from PySide6.QtGui import QHideEvent, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from amp_studio.drawing import Handle, Placement, Scene
from amp_studio.files import RangeError
from amp_studio.pictures import dragged, stepped
from amp_studio.schema import Address, Value
from amp_studio.ui.base.figures import with_groups
from amp_studio.ui.base.places import finding_text
from amp_studio.ui.base.scene_painter import ScenePainter
from amp_studio.ui.base.theme import colour
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.handle_spot import REACH, HandleSpot
from amp_studio.ui.table.value_drag import ValueDrag
from amp_studio.validate import Finding

from .paint import Tag, empty_text, paint_handles, paint_tag

_TOGETHER = 2
"""Handles so much farther away than the nearest one lie on it, in logical pixels;
a click goes on to the next."""
DrawScene = Callable[[Scene | None], Scene]
"""Draws the scene again, in the scales of another one while a handle is dragged."""


class PictureCanvas(QWidget):
    """Shows one scene and edits the file through its handles."""

    parameter_requested = Signal(object)
    """The address of a name that was clicked."""
    handle_chosen = Signal(object)
    """The handle that has the focus, or None."""
    typed = Signal(str)
    """The value of the chosen handle is to be typed, beginning so."""
    notified = Signal(str)
    """A short text for the status bar."""
    left = Signal()
    """Esc while nothing is dragged."""

    def __init__(self, workspace: Workspace, drawn: DrawScene) -> None:
        super().__init__()
        self._workspace, self._drawn = workspace, drawn
        self.scene = drawn(None)
        self.place = Placement.within(self.scene, 100.0, 100.0)
        """Where the scene lies in the widget."""
        self._spots: list[HandleSpot] = []
        self._active: int | None = None
        self._drag: ValueDrag | None = None
        self._start: Scene | None = None
        self._dragged: Handle | None = None
        """The handle that is dragged, as it was when the drag began."""
        self._offset = QPointF(0, 0)
        self._again = self._moved = False
        """Whether the pressed handle was chosen already, and whether it has been dragged since."""
        self._refused = ""
        self._causes: dict[Address, Finding] = {}
        """The worst finding that each value of the picture causes."""
        self._about: dict[Address, Finding] = {}
        """Likewise, or was compared in."""
        self._names: list[tuple[object, Address]] = []
        self._left_out: tuple[tuple[tuple[float, float], str], ...] = ()
        """Where a text has no room, and the text."""
        self.setMouseTracking(True)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setFocusPolicy(Qt.FocusPolicy.ClickFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self._arrange()

    def sizeHint(self) -> QSize:
        return QSize(480, 320)

    def minimumSizeHint(self) -> QSize:
        return QSize(160, 80)

    def hideEvent(self, event: QHideEvent) -> None:
        """Give the old values back where the picture goes while a handle is dragged."""
        self.end_drag(cancel=True)
        super().hideEvent(event)

    # -- what is shown -----------------------------------------------------------

    def show_drawn(self, drawn: DrawScene) -> None:
        """Show another part; the focus goes."""
        self.end_drag()
        self._drawn = drawn
        self._active = None
        self.draw_again()
        self.handle_chosen.emit(None)

    def draw_again(self) -> None:
        """Follow the file."""
        chosen = self._dragged or self.handle
        # On the scales of the scene in which a drag began: else the picture would move under the pointer.
        self.scene = self._drawn(self._start)
        if chosen is not None:
            self._active = self._place_of(chosen)
        self._arrange()
        if self._drag is None:
            self.mark_findings()
        self.update()

    def _place_of(self, handle: Handle) -> int | None:
        """Return where a handle is among those of the scene; None where its value leaves it no place."""
        moved = [[drag.address for drag in each.drags] for each in self.scene.handles]
        own, before = [drag.address for drag in handle.drags], self._active
        if before is not None and before < len(moved) and moved[before] == own:
            return before  # the points of a table move one value
        return moved.index(own) if own in moved else None

    def mark_findings(self) -> None:
        """Follow the findings, worst first."""
        drawn = set(self.scene.drawn_from)
        self._causes, self._about = {}, {}
        for finding in self._workspace.listed:
            for address in drawn.intersection(finding.addresses):
                self._about.setdefault(address, finding)
                if address in finding.causes:
                    self._causes.setdefault(address, finding)
        self.update()

    def _finding(self, handle: Handle, known: dict[Address, Finding]) -> Finding | None:
        return next((known[drag.address] for drag in handle.drags if drag.address in known), None)

    def _arrange(self) -> None:
        """Put a spot on each handle, with its name and value for screen readers."""
        self.place = Placement.within(self.scene, float(self.width()), float(self.height()))
        handles = self.scene.handles
        while len(self._spots) > len(handles):
            self._spots.pop().deleteLater()
        while len(self._spots) < len(handles):
            # A widget on each handle, though it paints nothing: Tab and screen readers know widgets only.
            self._spots.append(self._new_spot(len(self._spots)))
        for spot, handle in zip(self._spots, handles, strict=True):
            x, y = self.place.at(handle.at)
            spot.move(int(x - REACH), int(y - REACH))
            name = f"{handle.label}: {handle.value}"
            # Only where it is another one: Qt announces each change, and a drag has hundreds.
            if spot.accessibleName() != name:
                spot.setAccessibleName(name)
        title = f"{self.scene.title}, {self.scene.subtitle}"
        if self.accessibleName() != title:
            self.setAccessibleName(title)

    def _new_spot(self, index: int) -> HandleSpot:
        spot = HandleSpot(self)
        spot.stepped.connect(self._step)
        spot.typed.connect(self.typed)
        spot.removed.connect(self._remove_point)
        spot.left.connect(self._cancel)
        spot.focused.connect(lambda: self.choose(index))
        spot.setAccessibleDescription(
            self.tr("Handle of the picture: arrow keys change the value, Shift by ten steps")
        )
        spot.show()
        return spot

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._arrange()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.fillRect(self.rect(), colour("base"))
        if empty := empty_text(self.scene):
            painter.setPen(colour("dim"))
            inner = self.rect().adjusted(16, 16, -16, -16)
            painter.drawText(QRect(inner), Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap, empty)
            return
        shapes = ScenePainter(painter, self.place, QSizeF(self.size()))
        shapes.paint()
        self._names, self._left_out = list(shapes.named), shapes.labels.left_out
        chosen = self.handle
        # The chosen one over the others.
        corners_last = sorted(self.scene.handles, key=lambda handle: handle is chosen)
        found = ((handle, self._finding(handle, self._causes)) for handle in corners_last)
        paint_handles(
            painter,
            self.place,
            ((h, h is chosen, finding.severity if finding else "") for h, finding in found),
        )
        if chosen is not None and (self._drag or self._has_focus()):
            paint_tag(painter, self.place, chosen.at, self.tag(chosen))

    def tag(self, handle: Handle) -> Tag:
        """Return what is shown beside a handle: its value,
        and while it is dragged the old one and what is wrong.
        """
        finding, old = self._finding(handle, self._about), ""
        if self._dragged is not None:
            before = self._dragged.value
            old = "" if before == handle.value else self.tr("was {value}").format(value=with_groups(before))
        reason = self._refused or (finding_text(self._workspace.file, finding) if finding else "")
        severity = "error" if self._refused else finding.severity if finding else ""
        return Tag(handle.label, with_groups(handle.value), old, reason, severity)

    def _has_focus(self) -> bool:
        return self.hasFocus() or any(spot.hasFocus() for spot in self._spots)

    @property
    def is_dragging(self) -> bool:
        """Whether a handle follows the pointer."""
        return self._drag is not None

    # -- the handle with the focus -------------------------------------------------

    @property
    def handle(self) -> Handle | None:
        """The chosen handle."""
        return self.scene.handles[self._active] if self._active is not None else None

    def choose(self, index: int | None) -> None:
        """Choose a handle by its place in the scene."""
        if index != self._active:
            self._refused = ""
        self._active = index
        self.update()
        self.handle_chosen.emit(self.handle)

    def focus_handle(self) -> None:
        """Give the chosen handle the keyboard, or the picture where there is none."""
        (self._spots[self._active] if self._active is not None else self).setFocus()

    def _step(self, right: int, up: int, times: int) -> None:
        if self.handle is not None and self._drag is None:
            try:
                wanted = stepped(self._workspace.file, self.handle, right, up, times)
            except ValueError as error:
                self._refuse(str(error))
                return
            self.set_values(wanted)

    def _refuse(self, reason: str) -> None:
        self._refused = reason
        self.update()

    def set_values(self, wanted: Mapping[Address, Value]) -> bool:
        """Set values of the chosen handle as one undo step; a value out of range is refused,
        with the reason in the tag.
        """
        if not wanted or self.handle is None or not self._workspace.may_edit:
            return False
        self._refused = ""
        try:
            done = self._workspace.edit(self.tr("Move {name}").format(name=self.handle.label), wanted)
        except RangeError as error:
            self._refused = str(error)
            done = False
        self.handle_chosen.emit(self.handle)
        self.update()
        return done

    def _remove_point(self) -> None:
        """Take the point of the chosen handle out of its table."""
        if self.handle is not None and self.handle.without is not None:
            self.set_values(dict([self.handle.without]))
        elif self.scene.with_point is not None:
            self.notified.emit(self.tr("This point cannot be taken out: the table would have a gap"))

    def _cancel(self) -> None:
        if self._drag is not None:
            self.end_drag(cancel=True)
        else:
            self.left.emit()

    # -- the mouse ----------------------------------------------------------------

    def nearest(self, at: QPointF) -> int | None:
        """Return the handle within reach of a place: the chosen one of several that lie on each other,
        else the nearest.
        """
        found = self._within_reach(at)
        return self._active if self._active in found else found[0] if found else None

    def _within_reach(self, at: QPointF) -> list[int]:
        """Return the handles that lie as near to a place as the nearest one does, about."""
        found = []
        for n, handle in enumerate(self.scene.handles):
            x, y = self.place.at(handle.at)
            far = ((x - at.x()) ** 2 + (y - at.y()) ** 2) ** 0.5
            if far <= REACH:
                # At one place the handle that moves more values comes first: a corner before its edges.
                found.append((round(far), -len(handle.drags), n))
        found.sort()
        return [n for far, _, n in found if far <= found[0][0] + _TOGETHER]

    def _name_at(self, at: QPointF) -> Address | None:
        return next((address for box, address in self._names if box.contains(at)), None)  # type: ignore[attr-defined]  # the boxes are rectangles of Qt

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.LeftButton or self._drag is not None:
            return
        index = self.nearest(event.position())
        if index is None:
            address = self._name_at(event.position())
            self.choose(None)
            self.setFocus()
            if address is not None:
                self.parameter_requested.emit(address)
            return
        self._again = index == self._active
        self._moved = False
        self.choose(index)
        self._spots[index].setFocus(Qt.FocusReason.MouseFocusReason)
        handle = self.scene.handles[index]
        if not self._workspace.may_edit:
            self._refused = self.tr("The file is read-only")
            self.update()
            return
        self._start, self._dragged = self.scene, handle
        # The handle does not jump to the pointer: pressing alone changes no value.
        self._offset = QPointF(*self.place.at(handle.at)) - event.position()
        self._drag = ValueDrag(self._workspace, tuple(drag.address for drag in handle.drags))
        # So that Escape ends the drag, whatever has the focus.
        self.grabKeyboard()
        self.notified.emit(self.tr("Dragging {name}: one undo step").format(name=handle.label))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._drag is None:
            over_handle = self.nearest(event.position()) is not None
            link = not over_handle and self._name_at(event.position()) is not None
            self.setCursor(
                Qt.CursorShape.PointingHandCursor if over_handle or link else Qt.CursorShape.ArrowCursor
            )
            return
        self.drag_to(event.position() + self._offset)

    def drag_to(self, at: QPointF) -> None:
        """Let the dragged handle follow to a place."""
        if self._drag is None or self._dragged is None:
            return
        # The functions of the scene in which the drag began: they know what stays the same.
        try:
            wanted = dragged(self._dragged, self.place.world(at.x(), at.y()))
        except ValueError as error:  # a table does not take the point
            self._refuse(str(error))
            return
        changed = self._drag.move(wanted)
        self._refused = self._drag.refused
        self._moved = True
        if changed:
            self.draw_again()
            self.handle_chosen.emit(self.handle)
        else:
            self.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton and self._drag is not None:
            self.end_drag()
            found = self._within_reach(event.position())
            # A second click without a drag goes on to the next of the handles that lie on each other.
            if self._again and not self._moved and self._active in found:
                self.choose(found[(found.index(self._active) + 1) % len(found)])
                self.focus_handle()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Put a point into a table."""
        if self.scene.with_point is None or self.nearest(event.position()) is not None:
            return
        at = self.place.world(event.position().x(), event.position().y())
        try:
            point = self.scene.with_point(at)
        except ValueError as error:
            self.notified.emit(str(error))
            return
        if point is not None and self._workspace.may_edit:
            self._workspace.edit(self.tr("Put in a point"), dict([point]))

    def end_drag(self, *, cancel: bool = False) -> None:
        """Drop the dragged values as one undo step, or give the old ones back."""
        drag, dragged = self._drag, self._dragged
        if drag is None or dragged is None:
            return
        self._drag = self._start = self._dragged = None
        self.releaseKeyboard()
        if cancel:
            self._refused = ""
            drag.cancel()
        else:
            drag.drop(self.tr("Drag {name}").format(name=dragged.label))
        self.draw_again()
        self.handle_chosen.emit(self.handle)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """While a handle is dragged Esc gives the old value back, and no other key does anything."""
        if event.key() == Qt.Key.Key_Escape:
            self._cancel()
        elif self._drag is None:
            super().keyPressEvent(event)

    def tip(self, at: QPointF) -> str:
        """Return what a tip shows at a place: the value of its handle, and texts that have no room there."""
        lines = [text for (x, y), text in self._left_out if max(abs(x - at.x()), abs(y - at.y())) <= REACH]
        if (index := self.nearest(at)) is not None:
            handle = self.scene.handles[index]
            lines.insert(0, f"{handle.label}: {handle.value}")
        return "\n".join(lines)

    def event(self, event: object) -> bool:
        """Show tips; keep menu keys away from a value that is being dragged."""
        if event.type() == event.Type.ToolTip:  # type: ignore[attr-defined]  # Qt gives the event of this kind
            tip = "" if self._drag is not None else self.tip(QPointF(event.pos()))  # type: ignore[attr-defined]  # Qt gives the event of this kind
            QToolTip.showText(event.globalPos(), tip, self)  # type: ignore[attr-defined]  # Qt gives the event of this kind
            return True
        if self._drag is not None and event.type() == event.Type.ShortcutOverride:  # type: ignore[attr-defined]  # Qt gives the event of this kind
            event.accept()  # type: ignore[attr-defined]  # Qt gives the event of this kind
            return True
        return super().event(event)  # type: ignore[arg-type]  # Qt gives the event of this kind
