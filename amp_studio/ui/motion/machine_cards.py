"""The pictures of the page Machine: one check with its axes and its fix, the plan of two axes, and the
spindle.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial

from PySide6.QtCore import QRectF, QSize, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QFrame, QLabel, QLineEdit, QPushButton, QSizePolicy, QStackedWidget, QWidget

from amp_studio.drawing import Point, Scene
from amp_studio.files import ParameterFile
from amp_studio.pictures import (
    FilePicture,
    PlaneWay,
    draw_approach,
    draw_homing,
    draw_spindle,
    pictures_of,
    run_way,
    usual_way,
)
from amp_studio.schema import InvalidValueError, read_bare_number, read_number
from amp_studio.sim import NEAR_GRID, MotionCheck, SimulationError, Trace, length_unit, picture_of, simulate
from amp_studio.ui.base.figures import sentence, written
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.places import sentenced_with_letters
from amp_studio.ui.base.plot import Plot
from amp_studio.ui.base.theme import GAP, GAP2, GAP3, HEAD, colour, font, scheme
from amp_studio.ui.base.translated import sentenced
from amp_studio.ui.forms.elided_label import ElidedLabel
from amp_studio.ui.forms.segment import Segment

from .latest_work import LatestWork
from .scene_view import SceneView

_HIGHEST = "highest"
_MIN_FIELD = 56
"""Least width of a field in logical pixels."""


class Card(QFrame):
    """A picture with a head: its title, what it shows, and controls at the right end."""

    def __init__(self, title: str) -> None:
        super().__init__()
        self.setObjectName("card")
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self.title = QLabel(title)
        strong = font("text", own=True)
        strong.setWeight(strong.Weight.DemiBold)
        self.title.setFont(strong)
        self.about = ElidedLabel()
        self.about.setFont(font("small", own=True))
        self.head = in_row(self.title, (self.about, 1), margins=(GAP3, 0, GAP2, 0), gap=GAP2)
        self.optional: QLineEdit | None = None
        """A field in the head that goes first where there is little room."""
        above = self._above = QWidget()
        above.setLayout(self.head)
        above.setMinimumHeight(HEAD)
        # What can go keeps no window wide: only what stays asks for room (see resizeEvent).
        above.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.scene, self.plot, self.reason = SceneView(), Plot(has_cursors=False), QLabel()
        self.plot.setMinimumSize(self.scene.minimumSizeHint())
        self.reason.setWordWrap(True)
        self.reason.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.reason.setMargin(GAP3)
        self.stack = QStackedWidget()
        for each in (self.scene, self.plot, self.reason):
            self.stack.addWidget(each)
        self.column = in_column(above, (self.stack, 1), on=self, margins=0, gap=0)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        parts = (self.head.itemAt(n).widget() for n in range(self.head.count()))
        asking = [each for each in parts if each is not None and each is not self.about]
        staying = [each for each in asking if each is not self.optional and not each.isHidden()]
        room = (self.head.count() + 2) * GAP2
        least = sum(map(_width_of, staying)) + room
        self._above.setMinimumWidth(least)
        if self.optional is not None:
            self.optional.setVisible(least + _width_of(self.optional) <= self.width())

    def show_scene(self, scene: Scene, grips: Mapping[str, tuple[str, Point]] | None = None) -> None:
        """Show a drawing, and what it shows beside the title."""
        self.scene.show_scene(scene, grips)
        self.stack.setCurrentWidget(self.scene)
        self.about.setText(self.scene.scene.subtitle if self.scene.scene else "")

    def show_trace(self, trace: Trace) -> None:
        """Show a motion over its time."""
        picture = picture_of(trace)
        self.plot.draw(picture)
        self.stack.setCurrentWidget(self.plot)
        self.about.setText(" · ".join(sentenced(fact) for fact in picture.facts[:2]))

    def show_reason(self, text: str) -> None:
        """Say why there is nothing to show."""
        self.about.setText("")
        self.reason.setText(text)
        self.stack.setCurrentWidget(self.reason)


def _width_of(widget: QWidget) -> int:
    """Return the width that a widget needs; one of a fixed width hints at another."""
    return min(widget.sizeHint().width(), widget.maximumWidth())


def _field(name: str, tip: str) -> QLineEdit:
    """Return a field that is as wide as its name, which it shows while it is empty."""
    field = QLineEdit()
    field.setAccessibleName(name)
    field.setPlaceholderText(name)
    field.setToolTip(tip)
    field.setFixedWidth(max(field.fontMetrics().horizontalAdvance(name) + 2 * GAP3, _MIN_FIELD))
    return field


def _typed_length(text: str) -> str | None:
    """Return a length as it was typed, None for an empty one; raises InvalidValueError for what is none."""
    if not text.strip():
        return None
    number, unit = read_number(text.strip())
    if not number > 0.0:
        raise InvalidValueError(f"{text} is not above 0")
    # The shortest text that is read as the same number again: no digit is lost on the way to the scenario.
    return f"{number!r} {unit.strip()}".strip()


class _GridBar(QWidget):
    """Where the marker is between two others, in % of a turn, with the part that is sure."""

    def __init__(self) -> None:
        super().__init__()
        self.percent: float | None = None
        self.setFixedSize(QSize(160, 14))
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        scheme().changed.connect(self.update)

    def show_percent(self, percent: float | None) -> None:
        """Show a place; nothing for None."""
        self.percent = percent
        self.setVisible(percent is not None)
        low, high = NEAR_GRID
        if percent is not None:
            text = self.tr("Marker in the grid: {percent} % of a turn, {low} to {high} % is safe")
            self.setAccessibleName(
                text.format(percent=written(f"{percent:.0f}"), low=f"{low:g}", high=f"{high:g}")
            )
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        if self.percent is None:
            return
        low, high = (share / 100.0 * self.width() for share in NEAR_GRID)
        with QPainter(self) as painter:
            painter.fillRect(QRectF(0.0, 4.0, self.width(), 6.0), colour("warnbg"))
            painter.fillRect(QRectF(low, 4.0, high - low, 6.0), colour("line2"))
            at = min(max(self.percent / 100.0, 0.0), 1.0) * self.width()
            painter.fillRect(QRectF(at - 1.0, 0.0, 2.0, 14.0), colour("text"))


class CheckCard(Card):
    """The chosen check: its picture, its axes, the grid of a homing, the control's message and a fix."""

    axis_requested = Signal(str)
    length_given = Signal(object)
    """The length of the switch, as it is given to the scenario; None for none."""
    fix_requested = Signal()

    def __init__(self) -> None:
        super().__init__("")
        self.axes = Segment(self.tr("Axis"))
        self.axes.chosen.connect(self.axis_requested)
        self.length = _field(
            self.tr("switch length"),
            self.tr("How long the switch stays on, which is in no file; Enter homes with it"),
        )
        self.length.returnPressed.connect(self._give_length)
        self.head.addWidget(self.length)
        self.head.addWidget(self.axes)
        self.grid, self.grid_text = _GridBar(), QLabel()
        self.message = ElidedLabel()
        self.fix = QPushButton()
        self.fix.setProperty("primary", "true")
        self.fix.clicked.connect(self.fix_requested)
        self.footer = QWidget()
        parts = (self.grid, self.grid_text, (self.message, 1), self.fix)
        in_row(*parts, on=self.footer, margins=(GAP3, GAP, GAP2, GAP), gap=GAP2)
        self.column.addWidget(self.footer)
        self.fix.hide()

    def _give_length(self) -> None:
        try:
            self.length_given.emit(_typed_length(self.length.text()))
        except InvalidValueError as error:
            self.message.setText(str(error))

    def show_check(
        self, file: ParameterFile, check: MotionCheck, title: str, axes: Sequence[tuple[str, str]]
    ) -> None:
        """Show a check; ``axes`` are those that have its scenario, with their letters."""
        self.title.setText(title)
        self.axes.offer([(axis, letter, "") for axis, letter in axes])
        self.axes.show_choice(check.axis)
        self.axes.setVisible(len(axes) > 1)
        trace, family = check.trace, file.schema.family.family
        self.length.setVisible(bool(trace and trace.course and trace.course.switch))
        if trace is None:
            self.show_reason(sentenced_with_letters(file, check.why))
        elif trace.course is not None:
            self.show_scene(draw_homing(file, trace))
        else:
            self.show_trace(trace)
        grid = check.figures.get("home_grid", (None, ""))[0]
        self.grid.show_percent(grid)
        about = "" if grid is None else self.tr("Marker {percent} % of a turn, {low} to {high} % is safe")
        low, high = (f"{each:g}" for each in NEAR_GRID)
        self.grid_text.setText(about.format(percent=written(f"{grid or 0.0:.0f}"), low=low, high=high))
        words = "; ".join(f"{alarm.code} {sentenced(alarm.message, family)}" for alarm in check.alarms)
        self.message.setText(
            self.tr("The control would say: {message}").format(message=words) if words else ""
        )
        self.footer.setVisible(bool(words or about))

    def offer_fix(self, text: str) -> None:
        """Offer a fix by what it sets; "" for none."""
        self.fix.setText(text)
        self.fix.setVisible(bool(text))
        self.footer.setVisible(bool(text or self.message.text() or self.grid_text.text()))


class TravelCard(Card):
    """The plan of two axes with a way that can be dragged, simulated again wherever it is dropped."""

    failed = Signal(str)

    def __init__(self) -> None:
        super().__init__(self.tr("Travel and zones"))
        self.hard = _field(
            self.tr("stops"),
            self.tr("How far behind the limits the hard stops are, which is in no file; Enter draws them"),
        )
        self.hard.returnPressed.connect(self._draw)
        self.pairs = Segment(self.tr("Axes"), is_tight=True)
        self.pairs.chosen.connect(self._choose)
        self.head.addWidget(self.hard)
        self.optional = self.hard
        self.head.addWidget(self.pairs)
        self.picture: FilePicture | None = None
        self.way: PlaneWay | None = None
        self.trace: Trace | None = None
        self._ways: dict[str, PlaneWay] = {}
        """Where a person has dragged the way of a part."""
        self.latest = LatestWork()
        self.latest.done.connect(self._receive)
        self.scene.moved.connect(self._move)

    def follow(self, file: ParameterFile) -> None:
        """Show the travel of a file, which nothing else changes."""
        self.picture = next((each for each in pictures_of(file) if each.name == "travel"), None)
        if self.picture is None:
            self.hide()
            return
        parts = self.picture.parts
        self.pairs.offer([(key, name, "") for key, name in parts])
        self.pairs.setVisible(len(parts) > 1)
        chosen = self.pairs.choice or parts[0][0]
        self._choose(chosen)

    def show_axis(self, axis: str) -> None:
        """Show a pair with an axis, where another is shown."""
        keys = [key for key, _ in self.picture.parts] if self.picture else []
        if axis and axis not in (self.pairs.choice or "").split("+"):
            found = next((key for key in keys if axis in key.split("+")), None)
            if found is not None:
                self._choose(found)

    @property
    def part(self) -> str:
        """The key of the pair that is shown."""
        return self.pairs.choice or (self.picture.parts[0][0] if self.picture else "")

    def _choose(self, part: str) -> None:
        self.pairs.show_choice(part)
        assert self.picture is not None
        self.way, self.trace = self._ways.get(part) or usual_way(self.picture, part), None
        self._draw()
        self._run()

    def _run(self) -> None:
        if self.picture is not None and self.way is not None:
            self.latest.ask(partial(_way_of, self.picture, self.part, self.way))

    def _move(self, name: str, at: Point) -> None:
        if self.way is None:
            return
        # Rows in place of a second axis: a drag has one direction.
        if self.scene.scene is not None and self.scene.scene.y.rows:
            at = at[0], 0.0
        self.way = self._ways[self.part] = replace(self.way, **{name: at})
        self.trace = None
        self._draw()
        self._run()

    def _receive(self, found: object) -> None:
        if isinstance(found, SimulationError):
            self.trace = None
            self.failed.emit(found.what)
            self.about.setText(sentenced(found.what))
        # Only the motion of the way that is shown: another may have been dragged while it was computed.
        elif isinstance(found, tuple) and found[:2] == (self.part, self.way):
            self.trace = found[2]
            self._draw()

    def _draw(self) -> None:
        if self.picture is None:
            return
        try:
            text = _typed_length(self.hard.text())
            hard = None if text is None else read_bare_number(text, length_unit(self.picture.file))
        except InvalidValueError as error:
            self.about.setText(sentence(str(error)))
            return
        scene = draw_approach(self.picture, self.part, self.way, self.trace, hard)
        grips = {}
        if self.way is not None:
            grips = {"start": (self.tr("start"), self.way.start), "to": (self.tr("target"), self.way.to)}
        self.show_scene(scene, grips)
        if self.trace is not None and self.trace.alarms:
            alarm = self.trace.alarms[-1]
            self.about.setText(
                f"{alarm.code} {sentenced(alarm.message, self.picture.file.schema.family.family)}"
            )


def _way_of(picture: FilePicture, part: str, way: PlaneWay) -> tuple[str, PlaneWay, Trace]:
    return part, way, run_way(picture, part, way)


class SpindleCard(Card):
    """The spindle: gears over speed with a typed speed, orient, tapping."""

    def __init__(self) -> None:
        super().__init__(self.tr("Spindle"))
        self.views = Segment(
            self.tr("View of the spindle"),
            (
                ("spindle", self.tr("Gears"), ""),
                ("orient", self.tr("Orient"), ""),
                ("tap", self.tr("Tapping"), ""),
            ),
            is_tight=True,
        )
        self.views.chosen.connect(self.show_view)
        self.speed = _field("S", self.tr("A programmed speed in rpm; Enter shows gear, output and time"))
        self.speed.returnPressed.connect(self._run)
        self.head.addWidget(self.speed)
        self.head.addWidget(self.views)
        self.picture: FilePicture | None = None
        self._file: ParameterFile | None = None
        self.latest = LatestWork()
        self.latest.done.connect(self._receive)

    def follow(self, file: ParameterFile, has_spindle: bool) -> None:
        """Show the spindle of a file, which nothing else changes; hidden where there is none."""
        self.picture = next((each for each in pictures_of(file) if each.name == "gears"), None)
        self._file = file
        self.setVisible(self.picture is not None and has_spindle)
        if self.picture is not None and has_spindle:
            self.show_view(self.views.choice or "spindle")

    def show_view(self, view: str) -> None:
        """Show speed, orient or tapping."""
        self.views.show_choice(view)
        self.speed.setVisible(view != "orient")
        self._run()

    def _run(self) -> None:
        if self._file is None:
            return
        speed: float | str = _HIGHEST
        # S1500 as in a program, or the figure alone.
        if text := self.speed.text().strip().lstrip("Ss"):
            try:
                speed = read_bare_number(text, "rpm", "1/min")
            except InvalidValueError as error:
                self.about.setText(sentence(str(error)))
                return
        view = self.views.choice or "spindle"
        settings: dict[str, dict[str, float | str]] = {
            "spindle": {"move.speed": speed},
            "orient": {"move.orient": "yes"},
            # The pitch belongs to the program and is in no file: 1 mm.
            "tap": {"move.speed": speed, "move.pitch": 1.0},
        }
        scenario = "tap" if view == "tap" else "spindle"
        self.latest.ask(partial(_spindle_of, self._file, view, scenario, settings[view]))

    def _receive(self, found: object) -> None:
        if isinstance(found, SimulationError):
            self.show_reason(sentenced(found.what))
        # Only for the view that is chosen now: the answer may be that of the one before.
        elif isinstance(found, tuple) and found[0] == self.views.choice:
            if found[0] != "spindle":
                self.show_trace(found[1])
            elif self.picture is not None:
                self.show_scene(draw_spindle(self.picture, found[1]))
                alarms = "; ".join(f"{each.code} {sentenced(each.message)}" for each in found[1].alarms)
                if alarms:
                    self.about.setText(alarms)


def _spindle_of(
    file: ParameterFile, view: str, scenario: str, settings: Mapping[str, float | str]
) -> tuple[str, Trace]:
    return view, simulate(file, scenario, None, settings, advise=False)
