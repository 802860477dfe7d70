"""The path of a program: its picture with what of it is seen, a moment on it, and where its time goes."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import cast

import numpy as np
import numpy.typing as npt
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QLabel, QWidget

from amp_studio.files import ParameterFile
from amp_studio.sim import (
    PathChoice,
    PathColours,
    PathMoment,
    ProgramRun,
    length_unit,
    path_outline,
    path_picture,
    path_place,
)
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.plot import Plot
from amp_studio.ui.base.theme import GAP2, font
from amp_studio.ui.forms.segment import Segment

from .block import error_now, moment_name
from .choosing import LimitFilter
from .play import TimeBar


class PathView(QWidget):
    """A picture of one run."""

    line_picked = Signal(int)
    """A piece of the path was clicked: its line."""
    time_picked = Signal(float)
    """A moment was clicked below the path, s."""
    stepped = Signal(int)
    """So many blocks on, by the arrow keys."""
    only_changed = Signal(str)
    """Letter of what is seen alone, "" for all."""

    def __init__(self) -> None:
        super().__init__()
        self.own_limit = math.inf
        """mm, of the contour error."""
        self._run: tuple[ParameterFile, ProgramRun] | None = None
        self._now: tuple[PathMoment, float, str] | None = None
        self._outline: tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]] | None = None
        self.title = QLabel()
        self.title.setFont(font("title", own=True))
        self.title.setWordWrap(True)
        self.view = Segment(
            self.tr("Path"), (("plan", self.tr("Plan"), ""), ("tilted", self.tr("Tilted"), ""))
        )
        self.view.show_choice("plan")
        self.colours = Segment(
            self.tr("Colour of the path"),
            (("limit", self.tr("Limit"), ""), ("feed", self.tr("Feed"), ""), ("error", self.tr("Error"), "")),
        )
        self.colours.show_choice("limit")
        for segment in (self.view, self.colours):
            segment.chosen.connect(lambda _key: self.draw_again())
        self.filter = LimitFilter()  # who shows the limits places it
        self.filter.chosen.connect(self._choose)
        self.plot = Plot(has_cursors=False, is_pointed=True)
        self.plot.pointed.connect(self._point)
        self.plot.timed.connect(self.time_picked)
        self.plot.stepped.connect(lambda right, up: self.stepped.emit(right or -up))
        self.bar = TimeBar()
        in_column(
            self.title,
            in_row(self.view, self.colours, 0, gap=GAP2),
            self.plot,
            self.bar,
            on=self,
            margins=(GAP2, 0, GAP2, 0),
            gap=GAP2,
        )

    def _choose(self, letter: str) -> None:
        self.draw_again()
        self.only_changed.emit(letter)

    def show_run(self, file: ParameterFile, run: ProgramRun) -> None:
        """Draw a run under a file."""
        self._run, self._now = (file, run), None
        self.draw_again()

    def draw_again(self) -> None:
        """Draw with what is chosen now."""
        if self._run is None:
            return
        file, run = self._run
        colours = cast("PathColours", self.colours.choice or "limit")
        picture = path_picture(file, run, None, PathChoice(colours, self.filter.letter, self.own_limit))
        above = picture.close if self.view.choice == "tilted" else picture.above
        self._outline = None
        self.plot.draw(replace(picture, above=above, close=None))
        if self._now is not None:
            self.show_moment(*self._now)

    def show_moment(self, moment: PathMoment, time: float, block: str) -> None:
        """Mark where the axes are, in the text of a block; the rest stays as it is painted."""
        if self._run is None:
            return
        file, run = self._run
        self._now = moment, time, block
        length = length_unit(file)
        place = path_place(file, moment, tilted=self.view.choice == "tilted")
        self.plot.show_now(moment_name(block, moment, length), place, time, error_now(run, time, length))

    def _point(self, x: float, y: float) -> None:
        """Report the line of the piece that is nearest to a place of the picture."""
        if self._run is None:
            return
        if self._outline is None:
            self._outline = path_outline(*self._run, tilted=self.view.choice == "tilted")
        points, lines = self._outline
        self.line_picked.emit(int(lines[int(np.argmin(np.hypot(points[:, 0] - x, points[:, 1] - y)))]))
