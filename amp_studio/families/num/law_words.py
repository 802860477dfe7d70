"""The words of one NUM axis that its position loop needs, in mm or deg and s.

Values that are not set are asked for in one sentence; what the control takes in their place,
where it is printed, is noted.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from amp_studio.sim import AxisParameters, SimulationError

from . import law_sample as sample
from .formulas import (
    axis_time_constant,
    axis_turns,
    axis_unit,
    effective_anticipation,
    sampling_period_in_force,
)
from .law_facts import MOTION, ids

VOLTAGE, FILTER = "model.drive_voltage", "model.filter"
_UC_SII = "1060 UCSII"
"""The application with that processor."""

_OF_CONTROL = (ids.axes_measured, ids.axes_servoed, ids.sampling_period)
_OF_AXIS = (
    ids.axes_assignment,
    ids.measure_multi,
    ids.measure_divi,
    ids.max_speed,
    ids.acceleration_fast,
    ids.loop_gain,
    ids.in_position_window,
    ids.max_following_error,
)


@dataclass(frozen=True)
class Words:
    """What the words of one axis say, in u and s."""

    unit: str
    length: float
    """u: the internal unit."""
    turns: bool
    period: float
    gain: float
    """Points for 1 u."""
    constant: float
    top: float
    """u/s"""
    share: float
    terms: int
    voltage: float
    acceleration: float
    """u/s2: the fast one."""
    work_acceleration: float
    """u/s2: that of work rates; 0 where it is not set."""
    curve_constant: float
    """s: of the group, which speeds on curves go by (6-40); 0 for none."""
    curve_error: float
    """um: servo-loop error tolerated on circles; 0 for no limit."""

    @property
    def rate(self) -> float:
        """Return u/s for 1 u of following error: the gain of the loop in 1/s."""
        return self.gain * 10.0 / sample.FULL_POINTS * self.top / self.voltage

    @property
    def anticipated(self) -> float:
        """Return the following error that the speed reference takes away, in s of its speed."""
        return self.share * self.constant


def read_words(read: AxisParameters, notes: list[str]) -> Words:
    """Return the words of an axis; what is taken for a word that is not set goes to ``notes``."""
    read.require([*((name, "") for name in _OF_CONTROL), *((name, read.axis) for name in _OF_AXIS)])
    address, assignment = float(read.axis), read.number(ids.axes_assignment)
    bits = [read.optional(name, everywhere=True) for name in (ids.axes_modulo, ids.limited_excursion)]
    if None in bits:
        notes.append("P1 is not set: only an axis with the name A, B or C is taken to turn (4-12).")
    modulo, limited = (each or 0.0 for each in bits)
    turns = axis_turns(address, modulo, limited, assignment)
    length = axis_unit(address, modulo, limited, assignment, *_dividers(read, turns, notes))
    # P9 has the group in its high four bits, from 0 on; 15 is no group (4-24).
    group = int(assignment) >> 4
    named = str(group + 1) if group < 8 else None
    constant, of_group = _time_constants(read, named)
    acceleration = read.number(ids.acceleration_fast)
    above(acceleration, ids.acceleration_fast, "Maximum Permissible Acceleration, fast speed (P32)")
    top, gain = read.number(ids.max_speed) / 60.0, read.number(ids.loop_gain)
    above(top, ids.max_speed, f"Maximum Axis Traverse Rate (P30N{read.axis})")
    above(gain, ids.loop_gain, f"KVAR (P21N{read.axis}), which is in the drive with DISC NT,")
    terms, share = _anticipation(read, named, notes)
    return Words(
        unit="deg" if turns else "mm",
        length=length,
        turns=turns,
        period=_period(read, notes),
        gain=gain / 1000.0 / length,
        constant=constant,
        top=top,
        share=share,
        terms=terms,
        voltage=_drive_voltage(read),
        acceleration=acceleration,
        work_acceleration=read.optional(ids.acceleration_work) or 0.0,
        curve_constant=of_group,
        curve_error=_curve_error(read, turns, notes),
    )


def _time_constants(read: AxisParameters, group: str | None) -> tuple[float, float]:
    """Return the time constants of the axis and of its group in s; 0 for a group that has none (P56, P66)."""
    own = read.optional(ids.axis_time_constant)
    of_group = None if group is None else read.optional(ids.group_time_constant, at=group)
    constant = axis_time_constant(own or 0.0, of_group or 0.0) / 1000.0
    if group is None and not constant:
        raise SimulationError(
            f"P9N{read.axis} gives the axis no group, and so no time constant of P56 (or P66)",
            ids.axes_assignment,
        )
    if not constant and of_group is None:
        read.require([(ids.group_time_constant, str(group))])
    above(constant, ids.group_time_constant, "The time constant of P56 (or P66)")
    return constant, (of_group or 0.0) / 1000.0


def _drive_voltage(read: AxisParameters) -> float:
    """Return the speed reference at the top speed in V."""
    voltage = read.optional(VOLTAGE)
    voltage = MOTION.value("drive_voltage") if voltage is None else voltage
    if not 0.0 < voltage <= 10.0:
        raise SimulationError(f"{VOLTAGE} is {voltage:g} V; it must be above 0 and at most 10", VOLTAGE)
    return voltage


def _curve_error(read: AxisParameters, turns: bool, notes: list[str]) -> float:
    """Return the error tolerated on circles in um (6-32), 0 for no limit of the speed."""
    if turns:
        return 0.0  # a length, for linear axes
    error = read.optional(ids.circle_error, everywhere=True)
    if not error:
        notes.append(
            f"P52N0 is {'not set' if error is None else '0, which by 6-32 leaves no speed'}: the speed on"
            " circles is not limited."
        )
    return (error or 0.0) * 1000.0


def _dividers(read: AxisParameters, turns: bool, notes: list[str]) -> tuple[float, float]:
    """Return the internal units in a mm and in a degree; 0 for the one that an axis does not have."""
    if not turns:
        read.require([(ids.internal_unit, "")])
        return read.number(ids.internal_unit, everywhere=True), 0.0
    divider = read.optional(ids.rotary_unit, everywhere=True)
    if divider is None:
        notes.append(
            "P4N4 is not set: the internal unit is deg/10000, as in software before index LA (4-18)."
        )
    return 0.0, divider or 0.0


def above(figure: float, parameter: str, what: str) -> None:
    """Raise SimulationError for a figure that is not above 0."""
    if not (math.isfinite(figure) and figure > 0.0):
        raise SimulationError(f"{what} is {figure:g}; a simulated axis needs one above 0", parameter)


def _period(read: AxisParameters, notes: list[str]) -> float:
    """Return the active sampling period in s (9-10)."""
    # In whole µs: a period in ms is not exact as a float, and would be rounded down to the step below.
    given = round(read.number(ids.sampling_period, everywhere=True) * 1000.0, 6)
    taken = sampling_period_in_force(given, read.application == _UC_SII)
    if taken != given:
        notes.append(f"P50N0 is {given:g} us: the control takes {taken:g} us (9-10).")
    elif not read.application and taken % 2000.0:
        notes.append("A UC SII would round the sampling period down to a multiple of 2 ms (9-10).")
    return taken * 1e-6


def _anticipation(read: AxisParameters, group: str | None, notes: list[str]) -> tuple[int, float]:
    """Return (references averaged, share of the speed reference 0 to 1) of the axis' group (6-26)."""
    percent = None if group is None else read.optional(ids.speed_anticipation, at=group)
    terms = None if group is None else read.optional(ids.filter_terms, at=group)
    for value, word in ((percent, "Speed Anticipation Coefficient"), (terms, "Number of Filtered Terms")):
        if value is None:
            notes.append(
                f"{word} (P55) of the axis' group is not set: 0 is taken, which does nothing (6-26)."
            )
    works = read.optional(FILTER)
    if works is not None and works not in (0.0, 1.0):
        raise SimulationError(f"{FILTER} is {works:g}; it is 0 or 1", FILTER)
    if not terms or works == 0.0:
        return 1, effective_anticipation(percent or 0.0) / 100.0
    if terms % 2.0 != 1.0 or terms > sample.MAX_TERMS:
        raise SimulationError(
            f"The filter (P55) averages {terms:g} references; it takes an odd number, 2j+1 (6-26), below 14"
            " (6-26)",
            ids.filter_terms,
        )
    notes.append(
        f"ASSUMED: E11012 has the filter of {terms:g} references work (6-26), of which the file knows"
        f" nothing; set {FILTER} to 0 where it does not. With it the speed anticipation is 100 % (6-34)."
    )
    notes.append(
        "ASSUMED: the position loop uses the filtered reference too. Page 6-26 names the speed reference"
        " only; but the usual acceleration anticipation of 400 us (6-34) leaves no room for a delay of the"
        " one against the other."
    )
    return int(terms), 1.0
