"""A program drawn: its path in plan and tilted, by what limits it; speed and contour error over time."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal

import numpy as np
import numpy.typing as npt

from amp_studio.drawing import (
    Curve,
    Dot,
    FilledArea,
    NamedPlace,
    Picture,
    Polyline,
    Scale,
    Scene,
    ShapeSort,
    Text,
    panel_of,
)
from amp_studio.files import ParameterFile
from amp_studio.schema import canonical
from amp_studio.sim.path_rules import Indices, PathRows
from amp_studio.sim.rounding import value_text
from amp_studio.sim.unit_system import length_unit, own_unit, path_error_text, path_error_unit

from .contour import ContourError
from .limits_met import GuardedBox
from .moment import PathMoment
from .planned import PlannedProgram
from .planner import ProgramPlan
from .profiles import path_points
from .program import ProgramRun
from .result import limit_letters, limit_name
from .summing import LAST_BIT, SAMPLE, causes_of, main_cause

MAX_POINTS = 4000
"""Of the rows that are drawn; of more, so many are chosen by chance."""
SEEN = 1e-3
"""Share of the width of a path that is a step of its picture."""
_MAX_ARC_POINTS = 40_000
_WITHIN = 0.01
"""u between an arc and what is drawn of it; more where arcs would have above ``_MAX_ARC_POINTS`` points."""
_SORTS: tuple[ShapeSort, ...] = ("now", "outside", "output", "second", "error", "limit")
"""Colours of the limits beside the programmed feed, the longest first."""
_THIN = 0.2
"""Of the longer side of a path, what its picture is high or wide at least."""
_TILT = ((0.866, 0.5), (-0.5, 0.433), (0.0, 0.75))
"""What a unit of X, Y, Z is in the tilted picture: right, up."""


_MAX_LETTERS, _MAX_LETTERS_OF_ONE, _APART = 14, 3, 0.06
"""Letters on a path, those of one limit, and the share of the width of the path that they are apart at
least."""
_STRIP = 600
"""Parts of the strip at the foot of the contour error."""
NOT_GOOD = "!"
"""Chooses what is not good: alarms, and a contour error above one's own limit."""


PathColours = Literal["limit", "feed", "error"]
"""What colours a path: what limits the feed, its share of the programmed feed, the contour error."""
_FEED_PARTS = (0.98, 0.75, 0.5)
"""Shares of the programmed feed that part its colours."""
_ERROR_PARTS = (0.25, 0.5, 0.75)
"""Shares of the largest contour error that part its colours."""


@dataclass(frozen=True)
class PathChoice:
    """What of a path is seen, and what it is judged by."""

    colours: PathColours = "limit"
    only: str = ""
    """Letter of the one limit that has its colour, `NOT_GOOD`, or "" for all."""
    limit: float = math.inf
    """mm: one's own of the contour error."""


def path_picture(
    file: ParameterFile,
    run: ProgramRun,
    moment: PathMoment | None = None,
    choice: PathChoice = PathChoice(),  # it is frozen
) -> Picture:
    """Return the picture of a program in the unit of the file, with a dot where the axes are at a moment."""
    program, plan, length = run.plan, run.plan.sample.plan, length_unit(file)
    facts = [f"{program.path.blocks} blocks, {value_text(program.time, 's', 4)}"]
    letters = limit_letters(run)
    times = program.time_by_cause
    facts += [
        f"{letter} {limit_name(file, program.causes[n])} {100.0 * times[n] / program.time:.0f} %"
        for n, letter in letters.items()
        if times[n] > 0.0
    ]
    if run.contour is not None:
        facts.append(f"largest contour error {path_error_text(run.contour.largest, length)}")
    panels = [_speed(program, length)]
    if run.contour is not None:
        panels.append(_error_panel(run, run.contour, letters, length, choice.limit))
    moving = np.flatnonzero(plan.geometry.length > 0.0)
    drawn = moving[_chosen(len(moving), SAMPLE)]
    classes = _classes(file, run, letters, choice.colours, drawn)
    points, rows = path_points(plan, _within(plan, drawn), drawn)
    # Four times the class, 1 more in rapid, 2 more where it is not chosen, of the row that ends in each
    # point; the first has none.
    kinds = np.zeros(1, np.int64)
    if len(drawn):
        own = 4 * classes.of_rows + plan.is_rapid[drawn] + 2 * ~_are_chosen(run, letters, choice, drawn)
        kinds = own[np.searchsorted(drawn, rows)]
    flat, space = (
        _path_scene(run, classes, moment, length, (points, kinds), tilted=tilted) for tilted in (False, True)
    )
    return Picture("program", tuple(facts), tuple(panels), flat, space, bool(run.alarms), run.assumptions)


def path_outline(file: ParameterFile, run: ProgramRun, *, tilted: bool) -> tuple[PathRows, Indices]:
    """Return points (n, 2) of the path as they lie in its picture, and the line of the program of each."""
    plan = run.plan.sample.plan
    moving = np.flatnonzero(plan.geometry.length > 0.0)
    drawn = moving[_chosen(len(moving), SAMPLE)]
    points, rows = path_points(plan, _within(plan, drawn), drawn)
    lines = plan.lines[rows] if len(drawn) else np.zeros(len(points), np.int64)
    return _flat(points / canonical(1.0, length_unit(file)), tilted=tilted), lines


def _error_panel(
    run: ProgramRun, contour: ContourError, letters: Mapping[int, str], length: str, limit: float
) -> Scene:
    """Return the contour error over time: its largest value, one's own limit, and what limits at its foot."""
    unit, per_mm = path_error_unit(length)
    error = Curve("contour error", contour.time, per_mm * contour.error, "now", dense=True)
    own = f"own limit {path_error_text(limit, length)}"
    levels = (NamedPlace(own, per_mm * limit, "output"),) if math.isfinite(limit) else ()
    panel = panel_of("contour error", (error,), ("time", "s"), unit, levels=levels)
    largest = (float(contour.time[contour.worst]), per_mm * contour.largest)
    is_over = contour.largest > limit
    return replace(
        panel,
        lines=tuple(_strip(run, letters)),
        dots=(Dot(largest, "point", "error" if is_over else "ink"),),
        texts=(Text(largest, path_error_text(contour.largest, length), sort="error" if is_over else "ink"),),
    )


def _strip(run: ProgramRun, letters: Mapping[int, str]) -> Iterator[Polyline]:
    """Yield the colours of what limits over time."""
    plan = run.plan.sample.plan
    if not len(plan.start):
        return
    edges = np.linspace(0.0, run.plan.time, _STRIP + 1)
    rows = np.clip(np.searchsorted(plan.start, 0.5 * (edges[1:] + edges[:-1]), "right") - 1, 0, None)
    kinds = np.where(plan.is_rapid[rows], -1, main_cause(plan, rows))
    changes = [0, *(np.flatnonzero(np.diff(kinds)) + 1).tolist(), _STRIP]
    for first, last in pairwise(changes):
        letter = "R" if kinds[first] < 0 else letters.get(int(kinds[first]), "")
        ends = ((float(edges[first]), 0.0), (float(edges[last]), 0.0))
        yield Polyline(ends, limit_sort(letter), wide=True)


def not_good_lines(run: ProgramRun, limit: float = math.inf) -> set[int]:
    """Return the lines with an alarm, or with a contour error above one's own limit in mm."""
    found = {alarm.line for alarm in run.alarms}
    if run.contour is not None and math.isfinite(limit):
        rows = np.unique(run.contour.row[np.abs(run.contour.error) > limit])
        found |= set(run.plan.whole.lines[rows].tolist())
    return found


def _are_chosen(
    run: ProgramRun, letters: Mapping[int, str], choice: PathChoice, rows: Indices
) -> npt.NDArray[np.bool_]:
    """Return which rows have their colour."""
    plan = run.plan.sample.plan
    if choice.only == NOT_GOOD:
        return np.isin(plan.lines[rows], list(not_good_lines(run, choice.limit)))
    if not choice.only:
        return np.ones(len(rows), bool)
    if choice.only == "R":
        return plan.is_rapid[rows]
    bits = sum(1 << min(n, LAST_BIT) for n, letter in letters.items() if letter == choice.only)
    chosen: npt.NDArray[np.bool_] = (causes_of(plan, rows) & np.uint32(bits)) > 0
    return chosen


def _speed(program: PlannedProgram, length: str) -> Scene:
    time, speed = program.speed.points
    curve = Curve("speed", time, 60.0 * speed / canonical(1.0, length), "now")
    return panel_of("speed along the path", (curve,), ("time", "s"), own_unit("mm/min", length))


@dataclass(frozen=True)
class _Classes:
    """What colours the rows of a plan that are drawn."""

    of_rows: Indices
    """(rows,)"""
    letters: Mapping[int, str]
    names: Mapping[str, str]
    """Letter -> what it is."""


def _classes(
    file: ParameterFile, run: ProgramRun, letters: dict[int, str], colours: PathColours, rows: Indices
) -> _Classes:
    """Return what some rows of a path are coloured by, with the letters and names of the colours."""
    plan = run.plan.sample.plan
    if colours == "limit":
        names = {letter: limit_name(file, run.plan.causes[n]) for n, letter in letters.items()}
        return _Classes(main_cause(plan, rows), letters, names)
    if colours == "feed":
        wanted = plan.path.feed[plan.geometry.row[rows]]
        time = np.maximum(plan.times[rows].sum(axis=1), 1e-12)
        shares = np.where(wanted > 0.0, plan.geometry.length[rows] / time / np.maximum(wanted, 1e-12), 1.0)
        # digitize needs rising edges, and shares fall from colour to colour: both with a minus.
        by = np.digitize(-shares, [-part for part in _FEED_PARTS])
        texts = _parts(_FEED_PARTS, "from {} % of the feed on", "below {} % of the feed")
    else:
        largest = np.zeros(max(len(plan.entry), 1))
        if run.contour is not None:
            np.maximum.at(largest, run.contour.row, np.abs(run.contour.error))
        whole = float(largest.max())
        by = np.digitize(largest[rows] / (whole or 1.0), _ERROR_PARTS)
        whole_text = path_error_text(whole, length_unit(file))
        texts = _parts(_ERROR_PARTS, f"below {{}} % of {whole_text}", f"from {{}} % of {whole_text} on")
    found = dict(enumerate("ABCD"))
    return _Classes(by.astype(np.int64), found, dict(zip(found.values(), texts, strict=True)))


def _parts(parts: Sequence[float], text: str, last: str) -> list[str]:
    return [*(text.format(f"{100.0 * part:g}") for part in parts), last.format(f"{100.0 * parts[-1]:g}")]


def _chosen(count: int, most: int) -> Indices:
    """Return places below ``count`` in their order, at most so many, with the first and the last."""
    if count <= most:
        return np.arange(count)
    chance = np.random.default_rng(0).choice(np.arange(1, count - 1), most - 2, replace=False)
    return np.concatenate([[0], np.sort(chance), [count - 1]])


def _within(plan: ProgramPlan, rows: Indices) -> float:
    """Return how far off the arcs of some rows are drawn: their points are bounded."""
    arcs = rows[plan.geometry.is_arc[rows]]
    # A chord for each w of the arcs takes their angles times the root of r/(8 w).
    turns = np.abs(plan.path.sweep[plan.geometry.row[arcs]]) * np.sqrt(plan.geometry.radius[arcs])
    return max(_WITHIN, (float(turns.sum()) / _MAX_ARC_POINTS) ** 2 / 8.0)


def _path_scene(
    run: ProgramRun,
    classes: _Classes,
    moment: PathMoment | None,
    length: str,
    outline: tuple[PathRows, Indices],
    *,
    tilted: bool,
) -> Scene:
    """Return the path in plan (the first two axes) or tilted (three), in the colours of its classes;
    ``outline`` are its points with the kind of row that ends in each.
    """
    path, size = run.plan.path, canonical(1.0, length)
    points, kinds = outline
    flat = _flat(points / size, tilted=tilted)
    kept = _thinned(flat, kinds)
    flat, kinds = flat[kept], kinds[kept]
    lines: list[Polyline] = []
    pieces: list[tuple[str, PathRows]] = []
    for first, last in _stretches(kinds):
        kind = int(kinds[last])
        letter = "R" if kind % 2 else classes.letters.get(kind // 4, "")
        part = tuple(map(tuple, flat[first : last + 1].tolist()))
        is_chosen = kind % 4 < 2
        lines.append(Polyline(part, limit_sort(letter) if is_chosen else "before", letter == "R"))
        if letter and is_chosen:
            pieces.append((letter, flat[first : last + 1]))
    # What is chosen lies on the rest.
    lines.sort(key=lambda line: line.sort != "before")
    texts = _letters(pieces, float(np.ptp(flat, axis=0).max()))
    seen = {letter for letter, _ in pieces}
    names = {**classes.names, "R": "rapid"}
    title = "in space" if tilted else "in plan"
    key = ", ".join(f"{letter} {names[letter]}" for letter in sorted(seen))
    (left, right), (low, high) = _spans(flat)
    axes = path.axes
    return Scene(
        name=f"path-{'tilted' if tilted else 'plan'}",
        part="program",
        title=f"path {title}",
        subtitle=key,
        x=Scale("" if tilted else axes[0], length, left, right, is_written=not tilted),
        y=Scale("" if tilted else axes[min(1, len(axes) - 1)], length, low, high, is_written=not tilted),
        equal=True,
        areas=() if tilted else tuple(_zones(run, axes, size, (left, right), (low, high))),
        lines=(*lines, *(() if tilted else _limits(run, axes, size, (left, right), (low, high)))),
        dots=() if moment is None else (_dot(moment, size, tilted=tilted),),
        texts=texts,
        share=2.2,
    )


def _letters(pieces: Sequence[tuple[str, PathRows]], width: float) -> tuple[Text, ...]:
    """Return the letters beside the pieces of a path: the longest ones, none near another of its kind."""
    ways = [float(np.hypot(*np.diff(points, axis=0).T).sum()) for _, points in pieces]
    placed: dict[str, list[PathRows]] = {}
    texts: list[Text] = []
    order = sorted(range(len(pieces)), key=lambda n: -ways[n])
    # The longest piece of each kind first, so that no kind is without its letter.
    first = {pieces[n][0]: n for n in reversed(order)}
    for n in dict.fromkeys([*first.values(), *order]):
        letter, points = pieces[n]
        own = placed.setdefault(letter, [])
        at = _middle(points)
        is_near = any(float(np.hypot(*(at - each))) < _APART * width for each in own)
        if len(texts) >= _MAX_LETTERS or len(own) >= _MAX_LETTERS_OF_ONE or (own and is_near):
            continue
        own.append(at)
        texts.append(
            Text((float(at[0]), float(at[1])), letter, anchor="above", sort=limit_sort(letter), chip=True)
        )
    return tuple(texts)


def _middle(points: PathRows) -> PathRows:
    """Return the place half of the way along a piece."""
    gone = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    half = 0.5 * gone[-1]
    return np.array([np.interp(half, gone, points[:, n]) for n in (0, 1)])


def path_place(file: ParameterFile, moment: PathMoment, *, tilted: bool) -> tuple[float, float]:
    """Return where a moment lies in the picture of a path."""
    return _dot(moment, canonical(1.0, length_unit(file)), tilted=tilted).at


def _dot(moment: PathMoment, size: float, *, tilted: bool) -> Dot:
    x, y = _flat(moment.place[None, :] / size, tilted=tilted)[0].tolist()
    return Dot((x, y))


def _sides(box: GuardedBox, axes: Sequence[str], size: float) -> list[tuple[float, float]]:
    """Return the sides of a box along the first two axes, in units of the picture."""
    everywhere = (-math.inf, math.inf)
    found = (box.sides.get(axis, everywhere) for axis in axes[:2])
    return [(low / size, high / size) for low, high in found]


def _zones(
    run: ProgramRun, axes: Sequence[str], size: float, wide: tuple[float, float], tall: tuple[float, float]
) -> Iterator[FilledArea]:
    """Yield the zones in the plane of the first two axes that reach into the picture."""
    for box in run.guarded:
        if not box.keeps_in and set(box.sides) & set(axes[:2]):
            (left, right), (low, high) = _sides(box, axes, size)
            # Zones and limits do not widen the picture: in a large machine the path would be a dot.
            if left < wide[1] and right > wide[0] and low < tall[1] and high > tall[0]:
                yield FilledArea(left, low, right, high, "outside", box.name)


def _limits(
    run: ProgramRun, axes: Sequence[str], size: float, wide: tuple[float, float], tall: tuple[float, float]
) -> Iterator[Polyline]:
    """Yield the limits of travel that lie in the picture."""
    for box in run.guarded:
        sides = _sides(box, axes, size) if box.keeps_in else []
        for edge in sides[0] if sides else ():
            if wide[0] < edge < wide[1]:
                yield Polyline(((edge, tall[0]), (edge, tall[1])), "limit", True)
        for edge in sides[1] if sides[1:] else ():
            if tall[0] < edge < tall[1]:
                yield Polyline(((wide[0], edge), (wide[1], edge)), "limit", True)


def _flat(points: PathRows, *, tilted: bool) -> PathRows:
    """Return points on paper, (n, 2)."""
    wide = np.zeros((len(points), 3))
    count = min(points.shape[1], 3)
    wide[:, :count] = points[:, :count]
    rows: PathRows = wide @ np.array(_TILT) if tilted else wide[:, :2]
    return rows


def _spans(flat: PathRows) -> list[tuple[float, float]]:
    """Return what is seen of both axes."""
    lows, highs = flat.min(axis=0), flat.max(axis=0)
    # A path in a straight line has no extent across it, and both axes have one scale.
    most = float((highs - lows).max())
    found = []
    for low, high in zip(lows.tolist(), highs.tolist(), strict=True):
        room = max(0.06 * (high - low), 0.5 * (_THIN * most - (high - low))) or 1.0
        found.append((low - room, high + room))
    return found


def limit_sort(letter: str) -> ShapeSort:
    """Return the colour of a limit by its letter."""
    if letter == "R":
        return "dim"
    place = ord(letter) - ord("B") if letter else -1
    # More limits than colours: the last colour is shared by those with the least time.
    return _SORTS[min(place, len(_SORTS) - 1)] if place >= 0 else "ink"


def _thinned(flat: PathRows, kinds: Indices) -> Indices:
    """Return the points (n,) of a path that are drawn: where its picture goes on or its colour changes,
    at most `MAX_POINTS` of them.
    """
    if len(flat) <= MAX_POINTS:
        return np.arange(len(flat))
    steps = np.floor(flat / (SEEN * float(np.ptp(flat, axis=0).max()) or 1.0))
    changes = (steps[1:] != steps[:-1]).any(axis=1)
    changes[:-1] |= kinds[1:-1] != kinds[2:]
    kept = np.unique(np.concatenate([[0], np.flatnonzero(changes) + 1, [len(flat) - 1]]))
    chosen: Indices = kept[_chosen(len(kept), MAX_POINTS)]
    return chosen


def _stretches(kinds: Indices) -> Sequence[tuple[int, int]]:
    """Return (first, last) point of each part of the path with one cause and one kind of move."""
    if len(kinds) < 2:
        return ()
    edges = [0, *(np.flatnonzero(kinds[2:] != kinds[1:-1]) + 1).tolist(), len(kinds) - 1]
    return list(pairwise(edges))
