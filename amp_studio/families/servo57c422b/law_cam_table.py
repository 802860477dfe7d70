"""Cams in the registers of a 57C422B: made of points, and read back as a profile (pages 4-49 to 4-57)."""

from __future__ import annotations

import itertools
import math

import numpy as np

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Value
from amp_studio.sim import CamForm, CamPoints, CamProfile, SimulationError

from .formulas.cam import WORDS, cam_jump, cam_points, cam_step_time, word_bytes
from .law_facts import ids
from .law_sample import SCAN

_POSITIONS, _BYTES = 956, 3830
"""Positions and bytes that a table has room for (page 4-57)."""
LARGEST = 32767
"""Counts in one step of a table of words (page 4-50)."""
_MAX_INCREMENT = 32767
"""Counts of register 125 (page 4-53)."""
_WORDS_BIT, _CONTINUOUS_BIT, _POSITION_BIT = 0, 3, 8
"""Of register 130 (4-54)."""


def make(file: ParameterFile, axis: str, points: CamPoints, scans: int) -> CamProfile:
    """Return a cam of points: a time cam in words, or a position cam."""
    return (
        _position_cam(file, axis, points) if points.over == "master" else _time_cam(file, axis, points, scans)
    )


def present(file: ParameterFile, axis: str) -> CamProfile:
    """Return the cam that the registers contain."""
    count, mode = _number(file, ids.cam_points, axis), _mode(file, axis)
    if not count:
        raise SimulationError(f"Axis {axis} has no cam: its number of points is 0", ids.cam_points)
    room = _POSITIONS if mode >> _POSITION_BIT & 1 else WORDS if mode >> _WORDS_BIT & 1 else _BYTES
    if not 0 < count <= room:
        raise SimulationError(
            f"Axis {axis} has {count:.0f} points of a cam: its table has room for 1 to {room} (page 4-57)",
            ids.cam_points,
        )
    if mode >> _POSITION_BIT & 1:
        table = [_number(file, ids.position_points, f"{axis}.{k}") for k in range(int(count))]
        increment = _number(file, ids.position_increment, axis)
        if None in table or not increment:
            raise SimulationError(f"The position cam of axis {axis} is not set up whole", ids.position_points)
        values = np.array(table, float)
        return CamProfile("master", np.arange(len(table), dtype=float) * float(increment), values - values[0])
    steps = _steps(file, axis, int(count), mode)
    scans = round((_number(file, ids.cam_time, axis) or SCAN * 1000.0) / 1000.0 / SCAN)
    return _profile(file, axis, steps, max(scans, 1), {})


def _steps(file: ParameterFile, axis: str, count: int, mode: int) -> list[int]:
    """Return the travel of each step of a time cam, of words or of bytes."""
    found: list[float | None]
    if mode >> _WORDS_BIT & 1:
        found = [_number(file, ids.time_points, f"{axis}.{k}") for k in range(count)]
    else:
        words = [_number(file, ids.byte_points, f"{axis}.{k}") for k in range((count + 1) // 2)]
        found = [each for word in words if word is not None for each in word_bytes(word)]
        # An odd number of bytes leaves half of the last word over.
        del found[count:]
    if None in found or len(found) < count:
        raise SimulationError(f"The cam of axis {axis} has points that are not set", ids.time_points)
    return [int(each) for each in found if each is not None]


def _time_cam(file: ParameterFile, axis: str, points: CamPoints, scans: int) -> CamProfile:
    """Return a time cam of as many steps as its cycle has, of ``scans`` scans each; as few as a table of
    words allows without (5-10).
    """
    cycle = float(points.x[-1])
    scans = scans or cam_step_time(cycle)
    count = cam_points(cycle, scans)
    if count < 1 or (scans * count + scans) * SCAN < cycle:
        raise SimulationError(
            f"A cycle of {cycle:g} s has more than {WORDS} steps of {scans} scans: take more scans"
        )
    # The last step may be shorter than the others: it ends with the cycle.
    at = np.minimum(np.arange(count + 1) * scans * SCAN, cycle)
    rounded = np.round(np.interp(at, points.x, points.position))  # the sum is exact: nothing drifts away
    steps = [int(each) for each in np.diff(rounded)]
    if (most := max(map(abs, steps))) > LARGEST:
        raise SimulationError(
            f"A step has {most} counts; a word has {LARGEST} at most (page 4-50): take fewer scans or a"
            " slower cam",
            ids.time_points,
        )
    # Only these two bits: direction, mirror and the others of register 130 stay as they are.
    mode = (_mode(file, axis) | 1 << _WORDS_BIT) & ~(1 << _POSITION_BIT)
    settings: dict[Address, Value | None] = {
        (ids.cam_points, axis): Value(count),
        (ids.cam_time, axis): Value(scans * SCAN * 1000.0, "ms"),
        (ids.cam_mode, axis): Value(mode),
        **_table(file, axis, ids.time_points, steps),
    }
    # A loop back point beyond the new table would be no point of it.
    if _number(file, ids.loop_back, axis) is None or (_number(file, ids.loop_back, axis) or 0.0) >= count:
        settings[ids.loop_back, axis] = Value(0)
    return _profile(file, axis, steps, scans, settings)


def _position_cam(file: ParameterFile, axis: str, points: CamPoints) -> CamProfile:
    """Return a position cam: points one increment of the master apart, as many as there is room for."""
    span = round(float(points.x[-1]))
    least = max(math.ceil(span / (_POSITIONS - 1)), 1)
    # The least that fits whole into the cycle: the most points that the table has room for.
    increment = next((n for n in range(least, _MAX_INCREMENT + 1) if span % n == 0), None)
    if increment is None or increment > span:
        raise SimulationError(
            f"No increment of {least} to {_MAX_INCREMENT} counts divides {span} counts of the master"
            " (page 4-53)",
            ids.position_increment,
        )
    at = np.arange(0, span + 1, increment)
    table = np.round(np.interp(at, points.x, points.position))
    settings: dict[Address, Value | None] = {
        (ids.cam_points, axis): Value(len(at)),
        (ids.position_increment, axis): Value(int(increment), "counts"),
        (ids.cam_mode, axis): Value(_mode(file, axis) | 1 << _POSITION_BIT),
        **_table(file, axis, ids.position_points, [int(each) for each in table]),
    }
    figures = {"points": (float(len(at)), ""), "increment": (float(increment), "counts")}
    return CamProfile("master", at.astype(float), table, figures=figures, settings=settings)


def _table(file: ParameterFile, axis: str, parameter: str, values: list[int]) -> dict[Address, Value | None]:
    """Return the registers of a table; those of the table before that are beyond it are not set."""
    old = {
        address: None
        for address in file.values
        if address[0] in (ids.time_points, ids.byte_points, ids.position_points)
        and address[1].partition(".")[0] == axis
    }
    return {**old, **{(parameter, f"{axis}.{k}"): Value(v, "counts") for k, v in enumerate(values)}}


def _profile(
    file: ParameterFile, axis: str, steps: list[int], scans: int, settings: dict[Address, Value | None]
) -> CamProfile:
    """Return a time cam with what is doubtful about it."""
    step = scans * SCAN
    rises = [_number(file, each, axis) for each in (ids.command_acceleration, ids.command_deceleration)]
    most = min((each for each in rises if each), default=None)
    limits = {} if most is None else {"acceleration": most}
    figures = {"points": (float(len(steps)), ""), "scans": (float(scans), ""), "step": (step, "s")}
    return CamProfile(
        "time",
        np.arange(len(steps) + 1, dtype=float) * step,
        np.concatenate(([0.0], np.cumsum(steps))),
        limits,
        figures,
        tuple(_doubts(file, axis, steps, step, most, settings)),
        settings,
    )


def _doubts(
    file: ParameterFile,
    axis: str,
    steps: list[int],
    step: float,
    most: float | None,
    settings: dict[Address, Value | None],
) -> list[str]:
    """Return where a table asks for more than the ramps allow, or a cycle does not end where it began."""
    doubts = []
    inside = max((abs(cam_jump(a, b, step * 1000.0)) for a, b in itertools.pairwise(steps)), default=0.0)
    if most is not None and inside > most:
        doubts.append(
            f"The cam asks for {inside:g} counts/s2; registers 21 to 24 allow {most:g} for other moves (4-14)"
        )
    if _mode(file, axis) >> _CONTINUOUS_BIT & 1:
        given = settings.get((ids.loop_back, axis))
        back = int(given.value) if given else int(_number(file, ids.loop_back, axis) or 0.0)
        jump = abs(cam_jump(steps[-1], steps[min(back, len(steps) - 1)], step * 1000.0))
        if most is not None and jump > most:
            doubts.append(
                f"From the last point to loop back point {back} the speed jumps with {jump:g} counts/s2;"
                f" registers 21 to 24 allow {most:g} (4-56)"
            )
        if sum(steps):
            doubts.append(f"The axis is {sum(steps):+d} counts further after each cycle (4-56)")
    return doubts


def _number(file: ParameterFile, parameter: str, instance: str) -> float | None:
    value = file.evaluation.canonical((parameter, instance))
    return float(value) if isinstance(value, (int, float)) else None


def _mode(file: ParameterFile, axis: str) -> int:
    return int(_number(file, ids.cam_mode, axis) or 0.0)


CAM = CamForm(present, make)
