"""Moves of a program: straight lines, arcs and dwells as rows of its path, with the feed that is active."""

from __future__ import annotations

import math

from amp_studio.files import ParameterFile
from amp_studio.schema import ProgramPath

from .arcs import Arc, arc_by_center, arc_by_radius
from .coordinates import ProgramCoordinates
from .modal import ModalState
from .toolpath import ARC, DWELL, EXACT, LINE, PLANES, Rounding, RowsWriter
from .word_numbers import BlockNumbers
from .words import ProgramBlockError as BlockError


class PathMoves:
    """Writes the rows; lengths in mm or deg."""

    def __init__(self, file: ParameterFile, path: ProgramPath, at: ProgramCoordinates) -> None:
        self._file, self._path, self.at = file, path, at
        self.rows = RowsWriter(tuple(at.letters), at.position)
        self.line = 0
        """Of the program, from 1."""
        self._planes: dict[int, tuple[int, int]] = {}
        self._feed: float | None = None
        self.speed = 0.0
        self._centers = "incremental_positive"
        self._shift_waits = False
        if path.shift_waits is not None:
            param, bit = path.shift_waits
            value = file.evaluation.canonical((param, ""))
            self._shift_waits = isinstance(value, float | int) and bool(int(value) >> bit & 1)
        if path.centers is not None:
            self._centers = str(file.evaluation.canonical((path.centers, "")) or "absolute")

    def keep(self, roles: dict[str, float]) -> None:
        """Take the words that stay active: feed and speed of the spindle."""
        feed = roles.get("feed")
        if roles.get("move-time", 0.0) > 0.0:
            feed = 60.0 / roles["move-time"]  # as moves a minute, in which other controls count it
        if feed is not None:
            self._feed = feed
        self.speed = roles.get("spindle", self.speed)

    def forget_feed(self) -> None:
        """Have no feed: the kind of feed was switched to or from inverse time."""
        self._feed = 0.0

    def need_feed(self, modal: ModalState) -> None:
        """Refuse a code that moves at the feed, with no place beside it, where there is no feed."""
        self._feed_of(0.0, modal)

    def round_corners(self, roles: dict[str, float]) -> None:
        """Round corners by the words of a block; without them as far as the control likes."""
        corner, points = roles.get("blend-tolerance"), roles.get("join-tolerance")
        self.rows.round_by(Rounding(corner or 0.0, corner or 0.0 if points is None else points))

    def read_centers(self, mode: str) -> None:
        """Read centers of arcs in another way: as the choice of the file has it."""
        self._centers = mode

    def go(self, target: list[float], kind: int, corner: int, modal: ModalState) -> None:
        """Go in a straight line to a programmed point."""
        end = self.at.to_machine(target)
        self.at.programmed = target
        feed = 0.0
        if kind == LINE:
            way = math.dist(end, self.at.position) if modal.is_inverse else 0.0
            feed = self._feed_of(way, modal)
        # A block to where the axes are is no row: without a length it has no direction for its corners.
        if end == self.at.position:
            return
        self.rows.add(end, kind, self.line, feed, corner, modal.free)
        self.at.position = end

    def _feed_of(self, way: float, modal: ModalState) -> float:
        """Return the programmed feed in u/s."""
        if modal.is_inverse:
            if not self._feed:
                raise BlockError("A block of G93 has no F", "no-feed")
            feed = self._feed
            # Each block of inverse time needs its own F, for it is the time of this block.
            self._feed = None
            return way * feed / 60.0
        if self._feed is None and self._path.feed:
            value = self._file.evaluation.canonical((self._path.feed, ""))
            if isinstance(value, float | int) and value > 0.0:
                self._feed = float(value)
        if self._feed is None:
            raise BlockError("No feed is programmed, and the file has none", "no-feed")
        if not self._feed:
            raise BlockError("F0 is no feed: it must be above 0", "no-feed")
        if modal.is_per_turn:
            if not self.speed:
                raise BlockError("A feed for a turn of the spindle, and no S before it", "no-spindle")
            return self._feed * self.speed / 60.0
        return self._feed / 60.0

    def arc(
        self, words: BlockNumbers, target: list[float], corner: int, modal: ModalState, *, clockwise: bool
    ) -> None:
        """Go along an arc of the plane to a programmed point."""
        first, second = self._places_of(modal.plane)
        scale = self.at.scale_of(first, second)
        # In the machine's coordinates: a scale or a turn may lie between both.
        begin, end = self.at.position, self.at.to_machine(target)
        ends = begin[first], begin[second], end[first], end[second]
        if words.roles.get("turns", 1.0) != 1.0:
            raise BlockError("An arc of several turns is not simulated")
        if "radius" in words.roles:
            if not self._path.arcs_by_radius:
                raise BlockError("No page prints arcs by R for this control")
            if words.centers:
                raise BlockError("An arc with R and with a center", "unused-words")
            arc = arc_by_radius(
                *ends, words.roles["radius"] * scale, self._path.arc_tolerance, clockwise=clockwise
            )
        else:
            if not self._path.arcs_by_radius and "level" in words.roles:
                raise BlockError("No page prints arcs by R for this control: give the center")
            arc = self._arc_by_center(words, ends, first, second, clockwise=clockwise)
        along = 0.0
        if modal.is_inverse:  # of no other feed
            beside = (end[n] - begin[n] for n in range(len(end)) if n not in (first, second))
            along = math.hypot(arc.radius * arc.sweep, *beside)
        self.at.programmed = target
        feed = self._feed_of(along, modal)
        center = (arc.first, arc.second, arc.sweep)
        self.rows.add(end, ARC, self.line, feed, corner, modal.free, center, modal.plane)
        self.at.position = end

    def _places_of(self, plane: int) -> tuple[int, int]:
        """Return the places of the two axes of a plane."""
        if plane not in self._planes:
            first, second, _ = (self.at.axis("XYZ"[n]) for n in PLANES[plane])
            self._planes[plane] = first, second
        return self._planes[plane]

    def _arc_by_center(
        self,
        words: BlockNumbers,
        ends: tuple[float, float, float, float],
        first: int,
        second: int,
        *,
        clockwise: bool,
    ) -> Arc:
        """Return an arc in the plane of two axes by I, J and K, which are distances or coordinates by the
        family.
        """
        if not {first, second} & set(words.centers):
            raise BlockError("An arc without its center in the plane", "no-center")
        if set(words.centers) - {first, second} and not self._path.centers_beside:
            raise BlockError("The center of an arc is outside of its plane", "unused-words")
        given = [words.centers.get(place, 0.0) for place in (first, second)]
        if self._centers == "absolute":
            point = list(self.at.programmed)
            for place in {first, second} & set(words.centers):
                point[place] = words.centers[place]
            machine = self.at.to_machine(point)
            center = machine[first], machine[second]
        else:
            sign = -1.0 if self._centers == "incremental_negative" else 1.0
            point = list(self.at.programmed)
            point[first] += sign * given[0]
            point[second] += sign * given[1]
            machine = self.at.to_machine(point)
            center = machine[first], machine[second]
        return arc_by_center(*ends, *center, self._path.arc_tolerance, clockwise=clockwise)

    def rest(self, pauses: tuple[str, ...]) -> None:
        """End the moves so far before the next one begins, and rest for the times of these parameters;
        without one it is a dwell without time.
        """
        times = [self._file.evaluation.canonical((param, "")) for param in pauses]
        seconds = 1e-3 * sum(time for time in times if isinstance(time, float | int))
        # Behind a dwell, or before the first move, everything is at rest already.
        if seconds or self.rows.last_kind not in (-1, DWELL):
            self.dwell(seconds)

    def rest_at_shift(self) -> None:
        """End the moves so far before other work coordinates are active, where the control does."""
        if self._shift_waits:
            self.rest(())

    def dwell(self, seconds: float) -> None:
        if seconds < 0.0:
            raise BlockError("A dwell cannot be negative", "negative")
        if step := self._path.dwell_step:
            seconds = step * math.ceil(round(seconds / step, 6))  # 10.0000001 steps are ten
        self.rows.add(self.at.position, DWELL, self.line, 0.0, EXACT, 1, seconds=seconds)
