"""The picture of a trace on the screen: linked panels with cursors, a Bode plot or a ball-bar plot."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QColor, QFont, QKeyEvent

from amp_studio.sim import Curve, Field, Panel, Picture, Ring, Series, ring_levels, shown, unheld
from amp_studio.ui.base.plot_axis import plot_axes
from amp_studio.ui.base.theme import Token, colour, scheme
from amp_studio.ui.base.translated import worded

_INKS: dict[str, Token] = {
    "base": "base", "text": "text", "dim": "dim", "grid": "grid", "error": "error",
    "command": "dim", "actual": "sel", "other": "rec", "output": "warn", "before": "edge",
}  # fmt: skip
"""What is drawn -> its colour."""


class MotionPlot(pg.GraphicsLayoutWidget):
    """One picture; its panels have linked horizontal axes and two cursors through all of them."""

    read = Signal(str)
    """What the cursors read, as HTML; empty without a picture."""

    def __init__(self) -> None:
        pg.setConfigOptions(antialias=True)
        super().__init__()
        self._ink: dict[str, str] = {}
        self.picture: Picture | None = None
        self.panels: list[pg.PlotItem] = []
        self.cursors: list[list[pg.InfiniteLine]] = []
        self._places: tuple[float, float] | None = None
        self._pieces: Iterator[None] = iter(())
        self._turns = QTimer(self)
        """Runs while there is something left to draw."""
        self._turns.timeout.connect(self._draw_piece)
        self._take_colours()
        scheme().changed.connect(self._take_colours)

    # -- drawing -----------------------------------------------------------------

    def _take_colours(self) -> None:
        """Draw in the colours that hold now."""
        self._ink = {name: colour(token).name() for name, token in _INKS.items()}
        self.setBackground(self._ink["base"])
        if self.picture is not None:
            self.draw(self.picture)

    def clear_picture(self) -> None:
        """Show nothing."""
        self._pieces = iter(())
        self.clear()
        self.picture, self.panels, self.cursors = None, [], []
        self.read.emit("")

    def draw(self, picture: Picture) -> None:
        """Draw a picture and remove the previous one: a panel a turn of the event loop, and at the end all is shown at once."""
        same = self.picture is not None and self.picture.x_label == picture.x_label
        self.setUpdatesEnabled(False)
        self.clear()
        self.picture, self.panels, self.cursors = picture, [], []
        self._pieces = self._in_pieces(picture, same)
        self._turns.start()

    @property
    def is_drawn(self) -> bool:
        """Whether the whole picture is there."""
        return not self._turns.isActive()

    def finish(self) -> None:
        """Draw what is left of the picture now."""
        while not self.is_drawn:
            self._draw_piece()

    def _draw_piece(self) -> None:
        if next(self._pieces, self) is self:
            self._turns.stop()
            self.setUpdatesEnabled(True)

    def _in_pieces(self, picture: Picture, same: bool) -> Iterator[None]:
        """Draw a picture; each piece takes a fraction of what the window may be away for."""
        row = 0
        if picture.rings:
            self._draw_rings(picture)
            row = 1
            self.ci.layout.setRowStretchFactor(0, 3)
            yield
        if picture.field is not None:
            self._draw_field(picture.field)
            row = 1
            self.ci.layout.setRowStretchFactor(0, 5)
            yield
        for panel in picture.panels:
            plot = self.addPlot(row=row, col=0, axisItems=plot_axes(), enableMenu=False)
            self.ci.layout.setRowStretchFactor(row, max(1, round(2 * panel.height)))
            yield
            self._draw_panel(plot, panel)
            self.panels.append(plot)
            row += 1
            yield
        self._link(picture)
        yield
        self._finish(picture, same)
        yield
        self.ci.layout.activate()  # or all is painted twice
        self.scene().prepareForPaint()

    def _link(self, picture: Picture) -> None:
        """Link the panels."""
        for plot, (_, below) in zip(self.panels, pairwise([*self.panels, None]), strict=True):
            if below is not None:
                plot.getAxis("bottom").setStyle(showValues=False)
            if plot is not self.panels[0]:
                plot.setXLink(self.panels[0])
        name, unit = _name_and_unit(picture)
        self.panels[-1].setLabel("bottom", f"{name} ({unit})" if unit else name, color=self._ink["dim"])

    def _finish(self, picture: Picture, same: bool) -> None:
        """Set the range of the panels and the cursors."""
        first, last = _extent(picture)
        self._fit(None)
        low, high = (math.log10(first), math.log10(last)) if picture.x_log else (first, last)
        self.panels[0].setXRange(low, high, padding=0.01)
        for _, moment in picture.alarms:
            for plot in self.panels:
                plot.addItem(pg.InfiniteLine(moment, pen=pg.mkPen(self._ink["error"], width=1.5)))
        if not same or self._places is None or not all(low <= place <= high for place in self._places):
            self._places = (low + 0.25 * (high - low), low + 0.75 * (high - low))
        self._add_cursors(*self._places)

    def _draw_panel(self, plot: pg.PlotItem, panel: Panel) -> None:
        plot.setLogMode(x=self.picture is not None and self.picture.x_log, y=False)
        plot.setTitle(self._heading(panel), size="9pt", color=self._ink["text"], justify="left")
        plot.titleLabel.setMinimumWidth(0)  # a long heading is cut, the plot is not
        plot.layout.setRowFixedHeight(0, 18)
        plot.showGrid(x=True, y=True, alpha=0.18)
        plot.hideButtons()
        plot.setClipToView(True)
        for side in ("left", "bottom"):
            axis = plot.getAxis(side)
            axis.enableAutoSIPrefix(False)
            axis.setPen(self._ink["dim"])
            axis.setTextPen(self._ink["dim"])
            axis.setTickFont(_small())
        plot.getAxis("left").setWidth(66)
        plot.getAxis("bottom").logTickStrings = _plain_numbers
        for curve in panel.curves:
            drawn = [(self._item(curve), "peak")]
            if curve.held or curve.dense:
                drawn = [(self._band(curve), "peak"), (self._item(curve), "mean")]
            for item, method in drawn:
                item.opts["autoDownsampleFactor"] = 1.0 if method == "mean" else 3.0  # points for a pixel
                plot.addItem(item)  # which gives it the downsampling of the plot
                item.setDownsampling(auto=True, method=method)
        self._draw_levels(plot, panel)
        if panel.step:
            plot.getAxis("left").setTickSpacing(panel.step, panel.step / 2)

    def _heading(self, panel: Panel) -> str:
        """Return what a panel shows, with its curves in their colours: a legend that hides no curve."""
        unit = f" ({panel.unit})" if panel.unit else ""
        named = [curve for curve in panel.curves if curve.name and len(curve.x)]
        signs = {True: "○", False: "—"}
        legend = "&nbsp;&nbsp;&nbsp; ".join(
            f'<span style="color:{self._ink[c.role]}">{"- -" if c.role == "command" else signs[c.dots]} {worded(c.name)}</span>'
            for c in named
        )
        return f"<b>{worded(panel.label)}{unit}</b>" + (
            f"&nbsp;&nbsp;&nbsp;&nbsp; {legend}" if len(named) > 1 else ""
        )

    def _item(self, curve: Curve) -> pg.PlotDataItem:
        """Return a curve that keeps its peaks on the screen however far it is from it."""
        x, y = unheld(curve.x, curve.y) if curve.held else (curve.x, curve.y)
        colour = self._ink[curve.role]
        if curve.dots:
            return pg.PlotDataItem(
                x, y, pen=None, symbol="o", symbolSize=6, symbolPen=pg.mkPen(colour, width=1.5),
                symbolBrush=self._ink["base"], name=curve.name,
            )  # fmt: skip
        dash = Qt.PenStyle.DashLine if curve.role == "command" else Qt.PenStyle.SolidLine
        return pg.PlotDataItem(
            x, y, pen=pg.mkPen(colour, width=1.6, style=dash), name=curve.name, antialias=True
        )

    def _band(self, curve: Curve) -> pg.PlotDataItem:
        """Return the extremes of a value that ripples from sample to sample, in light ink under its mean."""
        x, y = unheld(curve.x, curve.y) if curve.held else (curve.x, curve.y)
        colour = QColor(self._ink[curve.role])
        colour.setAlpha(80)
        return pg.PlotDataItem(x, y, pen=pg.mkPen(colour, width=1.0), antialias=True)

    def _draw_levels(self, plot: pg.PlotItem, panel: Panel) -> None:
        """Draw the named levels; those that would overlap share one text."""
        pen = pg.mkPen(self._ink["dim"], width=1, style=Qt.PenStyle.DotLine)
        low, high = visible(panel, None)
        lines: list[tuple[float, list[str]]] = []
        for name, level in sorted(panel.levels, key=lambda each: each[1]):
            text = (
                name
                if not name or any(c.isdigit() for c in name)
                else f"{name} {shown(abs(level), panel.unit)}"
            )
            if lines and level - lines[-1][0] < 0.05 * (high - low):
                lines[-1][1].append(text)
                plot.addItem(pg.InfiniteLine(level, angle=0, pen=pen))
            else:
                lines.append((level, [text]))
        for level, texts in lines:
            options = {"position": 0.985, "color": self._ink["dim"], "anchors": [(1.0, 1.0), (1.0, 1.0)]}
            label = ", ".join(text for text in texts if text)
            plot.addItem(pg.InfiniteLine(level, angle=0, pen=pen, label=label or None, labelOpts=options))
        marks = pg.mkPen(self._ink["dim"], width=1, style=Qt.PenStyle.DashLine)
        for n, (name, at) in enumerate(panel.marks):
            log = self.picture is not None and self.picture.x_log
            options = {
                "position": 0.1 + 0.1 * (n % 2),
                "color": self._ink["dim"],
                "anchors": [(1.0, 0.5), (1.0, 0.5)],
            }
            place = math.log10(at) if log else at
            plot.addItem(pg.InfiniteLine(place, pen=marks, label=name if log else None, labelOpts=options))

    def _draw_rings(self, picture: Picture) -> None:
        """Draw the ball-bar plot: rings of equal deviation and the magnified paths."""
        plot = self.addPlot(row=0, col=0, enableMenu=False)
        plot.setAspectLocked(True)
        plot.hideAxis("left")
        plot.hideAxis("bottom")
        plot.hideButtons()
        levels, most = ring_levels(picture.rings)
        scale = 0.5 / most
        turn = np.linspace(0.0, 2.0 * math.pi, 361)
        for level in levels:
            radius, programmed = 1.0 + scale * level, level == 0.0
            pen = pg.mkPen(self._ink["dim" if programmed else "grid"], width=1.4 if programmed else 1.0)
            plot.plot(radius * np.cos(turn), radius * np.sin(turn), pen=pen)
            text = "programmed" if programmed else shown(level, picture.ring_unit, 3)
            label = pg.TextItem(text, color=self._ink["dim"], anchor=(0, 1), fill=self._ink["base"])
            label.setFont(_small())
            label.setPos(radius * math.sin(0.6), radius * math.cos(0.6))
            plot.addItem(label)
        for ring in picture.rings:
            plot.plot(*_path(ring, scale), pen=pg.mkPen(self._ink[ring.role], width=1.8), antialias=True)

    def _draw_field(self, field: Field) -> None:
        """Draw the map: a cell for each pair of values, pale where it is not safe, with the present and the best point."""
        plot = self.addPlot(row=0, col=0, enableMenu=False)
        plot.hideButtons()
        unit = f" ({field.unit})" if field.unit else ""
        plot.setTitle(
            f"<b>{worded(field.label)}{unit}</b>&nbsp;&nbsp; {worded('pale cells are not safe')}",
            size="9pt", color=self._ink["text"], justify="left",
        )  # fmt: skip
        known = np.isfinite(field.values)
        chosen = field.values[known & field.safe] if (known & field.safe).any() else field.values[known]
        least, most = (float(chosen.min()), float(chosen.max())) if chosen.size else (0.0, 1.0)
        share = np.clip((np.nan_to_num(field.values, nan=least) - least) / ((most - least) or 1.0), 0.0, 1.0)
        ends = [np.array(QColor(self._ink[name]).getRgb(), dtype=float) for name in ("base", "actual")]
        colours = ends[0] + (0.15 + 0.85 * share[..., None]) * (ends[1] - ends[0])
        colours[..., 3] = np.where(known, np.where(field.safe, 255.0, 90.0), 0.0)
        image = pg.ImageItem(colours.astype(np.uint8), axisOrder="row-major")
        plot.addItem(image)
        for name, point, ink in (("present", field.present, "error"), ("best", field.best, "other")):
            if point is not None:
                x, y = (
                    float(np.interp(at, side, np.arange(len(side)))) + 0.5
                    for at, side in zip(point, (field.x, field.y), strict=True)
                )
                pen = pg.mkPen(self._ink[ink], width=2.5)
                plot.addItem(pg.ScatterPlotItem([x], [y], symbol="o", size=11, pen=pen, brush=None))
                label = pg.TextItem(worded(name), color=self._ink["text"], anchor=(-0.15, 0.5))
                label.setPos(x, y)
                plot.addItem(label)
        for side, words, values in (("bottom", field.x_label, field.x), ("left", field.y_label, field.y)):
            every = max(1, -(-len(values) // 8))
            plot.getAxis(side).setTicks(
                [[(n + 0.5, shown(float(values[n]), digits=4)) for n in range(0, len(values), every)]]
            )
            plot.setLabel(side, words, color=self._ink["dim"])

    # -- ranges ------------------------------------------------------------------

    def zoom(self, span: tuple[float, float] | None) -> None:
        """Show a part of the horizontal axis, or all of it; the vertical axes follow what is visible."""
        if self.picture is None or not self.panels:
            return
        self.finish()
        first, last = span or _extent(self.picture)
        if self.picture.x_log:
            first, last = math.log10(first), math.log10(last)
        self.panels[0].setXRange(first, last, padding=0.01)
        self._fit((10.0**first, 10.0**last) if self.picture.x_log else (first, last))
        inside = first + 0.25 * (last - first), first + 0.75 * (last - first)
        for number, place in enumerate(inside):
            self._move(number, place)

    def _fit(self, span: tuple[float, float] | None) -> None:
        """Give every panel the vertical range of its curves in a part of the horizontal axis, and of the levels near them."""
        for plot, panel in zip(self.panels, self.picture.panels if self.picture else (), strict=True):
            low, high = visible(panel, span)
            plot.setYRange(low, high, padding=0.1)  # room for the text of the highest line

    # -- cursors -----------------------------------------------------------------

    def _add_cursors(self, *places: float) -> None:
        for number, place in enumerate(places):
            lines: list[pg.InfiniteLine] = []
            for plot in self.panels:
                pen = pg.mkPen(self._ink["dim"], width=1)
                line = pg.InfiniteLine(
                    place,
                    movable=True,
                    pen=pen,
                    hoverPen=pg.mkPen(self._ink["actual"], width=2),
                    label="AB"[number] if plot is self.panels[0] else None,
                    labelOpts={"position": 0.93, "color": self._ink["dim"], "fill": self._ink["base"]},
                )
                line.sigPositionChanged.connect(
                    lambda moved, number=number: self._move(number, moved.value())
                )
                plot.addItem(line, ignoreBounds=True)
                lines.append(line)
            self.cursors.append(lines)
        self._emit_values()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move cursor A with the arrow keys, cursor B with Shift, by a hundredth of what is visible."""
        way = {Qt.Key.Key_Left: -0.01, Qt.Key.Key_Right: 0.01}.get(Qt.Key(event.key()))
        if way is None or not self.cursors:
            super().keyPressEvent(event)
            return
        number = 1 if event.modifiers() & Qt.KeyboardModifier.ShiftModifier else 0
        low, high = self.panels[0].viewRange()[0]
        self._move(number, self.cursors[number][0].value() + way * (high - low))

    def _move(self, number: int, place: float) -> None:
        """Move one cursor in all panels."""
        for line in self.cursors[number]:
            line.blockSignals(True)
            line.setValue(place)
            line.blockSignals(False)
        self._places = (self.cursors[0][0].value(), self.cursors[1][0].value())
        self._emit_values()

    def _emit_values(self) -> None:
        if self.picture is not None and len(self.cursors) == 2:
            places = [10.0**p if self.picture.x_log else p for p in self._places or (0.0, 0.0)]
            self.read.emit("".join(_reading(self.picture, *places)))


def _name_and_unit(picture: Picture) -> tuple[str, str]:
    """Return what is along the x axis, in the language of the window."""
    name, _, unit = picture.x_label.partition(" (")
    return worded(name), unit.rstrip(")")


def _reading(picture: Picture, one: float, two: float) -> Iterator[str]:
    """Yield a table: a row for each curve with its value at both cursors and the difference."""
    name, unit = _name_and_unit(picture)
    cell = "<td align=right>&nbsp;&nbsp;{}</td>"
    yield "<table cellspacing=0 cellpadding=1><tr><td></td>"
    yield "".join(cell.format(f"<b>{head}</b>") for head in ("A", "B", "B − A")) + "</tr>"
    rows: list[tuple[str, str, float, float]] = [(name, unit, one, two)]
    for panel in picture.panels:
        for curve in panel.curves:
            if len(curve.x) and curve.role != "before":
                words = (
                    worded(panel.label)
                    if curve.name in (panel.label, "actual", "")
                    else f"{worded(panel.label)}, {worded(curve.name)}"
                )
                at_one, at_two = (float(np.interp(at, curve.x, curve.y)) for at in (one, two))
                rows.append((words, panel.unit, at_one, at_two))
    for words, shown_unit, a, b in rows:
        values = "".join(cell.format(shown(value, digits=5).replace("-", "−")) for value in (a, b, b - a))
        yield f"<tr><td>{words}</td>{values}<td>&nbsp;{shown_unit}</td></tr>"
    yield "</table>"


def _plain_numbers(values: Sequence[float], scale: float, _spacing: float | None) -> list[str]:
    """Return 1, 2 and 5 times the powers of ten as numbers, the others without text."""
    numbers = [float(10.0**value * scale) for value in values]
    return [shown(number, digits=3) if f"{number:e}"[0] in "125" else "" for number in numbers]


def _extent(picture: Picture) -> tuple[float, float]:
    xs = [curve.x for panel in picture.panels for curve in panel.curves if len(curve.x)]
    first, last = min(float(x[0]) for x in xs), max(float(x[-1]) for x in xs)
    return first, last if last > first else first + 1e-9


def visible(panel: Panel, span: tuple[float, float] | None) -> tuple[float, float]:
    """Return least and greatest value of a panel between two places (None: everywhere), with the levels that are near."""
    low, high = math.inf, -math.inf
    for curve in panel.curves:
        inside = curve.y if span is None else curve.y[(curve.x >= span[0]) & (curve.x <= span[1])]
        if len(inside):
            low, high = min(low, float(inside.min())), max(high, float(inside.max()))
    if low > high:
        low, high = 0.0, 1.0
    room = 1.0 * (high - low)
    near = [level for _, level in panel.levels if span is None or low - room <= level <= high + room]
    low, high = min([low, *near]), max([high, *near])
    return (low, high) if high > low else (low - 1.0, high + 1.0)


def _path(ring: Ring, scale: float) -> tuple[Series, Series]:
    radius = 1.0 + scale * ring.deviation
    return radius * np.cos(ring.angle), radius * np.sin(ring.angle)


def _small() -> QFont:
    font = QFont()
    font.setPointSizeF(max(font.pointSizeF() - 1.5, 6.0))
    return font
