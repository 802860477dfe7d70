"""From the words of one NUM axis to the parameters of its sample function, with limits, alarms and what is assumed."""

from __future__ import annotations

import math

from amp_studio.sim.axis_parameters import AxisParameters
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AlarmText
from amp_studio.sim.rounding import shown

from . import law_sample as sample
from .law_words import Words, above


def loop(
    read: AxisParameters, words: Words, notes: list[str]
) -> tuple[list[float], dict[int, AlarmText], dict[str, float]]:
    """Return the parameters of the sample function, its alarms and the limits of the following error."""
    p = [0.0] * sample.PARAMETERS
    p[sample.GAIN], p[sample.CONSTANT], p[sample.PERIOD] = words.gain, words.constant, words.period
    p[sample.SHARE], p[sample.TERMS], p[sample.WHOLE] = words.share, float(words.terms), 1.0
    p[sample.VOLTS] = words.voltage / words.top
    p[sample.FRICTION], p[sample.FRICTION_LEFT] = _friction(read, words, notes)
    p[sample.EMAX] = read.number("servo.max_following_error") * words.length
    p[sample.TOLERANCE] = _tolerance(read, words, notes)
    p[sample.LEADER_GAIN], p[sample.CORRECTION], p[sample.SYNC_LIMIT] = _synchronised(read, words, notes)
    limit = shown(p[sample.EMAX], words.unit)
    alarms = {
        int(sample.EXCESS_ERROR): AlarmText(
            "40 to 71",
            f"Following error is above Maximum Following Error (P23N{read.axis}), {limit}; the CNC goes into the fault state"
            " (6-22) and the move ends. Which of the errors 40 to 71 is of this axis is not printed.",
        ),
        int(sample.DYNAMIC_CHECK): AlarmText(
            "40 to 71",
            f"Dynamic movement control (P57N{read.axis}): the speed is not between 0.875 and 1.125 times the one that follows"
            f" from the following error and {words.constant * 1000.0:g} ms, less and more the tolerance (6-24).",
        ),
        int(sample.SYNCHRONISATION): AlarmText(
            "39", f"The synchronisation error is above threshold 1 (P24N{read.axis}); CN_PRET falls (6-30)."
        ),
    }
    band = read.number("servo.in_position_window") * words.length
    return p, alarms, {"maximum following error": p[sample.EMAX], "in-position window": band}


def _friction(read: AxisParameters, words: Words, notes: list[str]) -> tuple[float, float]:
    """Return (amplitude in u, share that one sample leaves of the correction) of the dry friction correction (6-34)."""
    amplitude = read.optional("servo.friction_amplitude") or 0.0
    anticipation = read.optional("servo.acceleration_anticipation") or 0.0
    if anticipation:
        notes.append(
            f"Acceleration Anticipation (P19N{read.axis}) is set, but not simulated: one reference is missing in the printed"
            " formula (6-34), and which one is unknown."
        )
    if not amplitude:
        return 0.0, 0.0
    time = (read.optional("servo.friction_time") or 0.0) / 1000.0
    if not time > words.period / 2.0:
        raise SimulationError(
            f"The dry friction correction of axis {read.axis} has the time constant {time * 1000.0:g} ms (P19, words 64 to"
            f" 95). With less than half the sampling period, {words.period * 500.0:g} ms, it never dies away (6-34)",
            "servo.friction_time",
        )
    notes.append(
        "ASSUMED: the amplitude of the dry friction correction has the sign of the speed reference, and the correction is"
        " added to the following error; the figure of 6-34 is lost."
    )
    return amplitude * words.length, 1.0 - words.period / time


def _tolerance(read: AxisParameters, words: Words, notes: list[str]) -> float:
    """Return the tolerance of the dynamic check in u per sample, -1 for no check (6-24)."""
    tolerance = read.optional("servo.movement_tolerance")
    if tolerance is None:
        notes.append("Dynamic Movement Control (P57) is not set: it is not simulated.")
    if not tolerance:
        return -1.0
    if words.turns:
        notes.append(
            "Dynamic Movement Control (P57) is in um per sample, and its unit on a rotary axis is not printed (6-24): it is"
            " not simulated on this one."
        )
        return -1.0
    notes.append(
        "ASSUMED: the tolerance of P57 widens the band between 0.875 and 1.125 times the theoretical speed on both sides, and"
        " the theoretical speed is that of the following error one sample before, with the speed anticipation; the figure of"
        " 6-24 is lost."
    )
    return tolerance / 1000.0


def _synchronised(read: AxisParameters, words: Words, notes: list[str]) -> tuple[float, float, float]:
    """Return (gain of the drive axis in 1/s, correction 0 to 1, threshold 1 in u); a gain of 0 for an axis on its own."""
    leader = read.value("axes.drive_axis")
    enabled = int(read.optional("axes.synchronised", everywhere=True) or 0.0) >> int(read.axis) & 1
    if leader in (None, "none") or not enabled:
        if leader not in (None, "none"):
            notes.append(
                f"The axis copies the reference of {leader} (P27) without a correction (P28): a move is simulated without"
                " its drive axis (4-30)."
            )
        return 0.0, 0.0, math.inf
    at = str(leader).removeprefix("axis-")
    if at == read.axis:
        raise SimulationError(f"Axis {at} is synchronised with itself in P27", "axes.drive_axis")
    own = [read.optional(name, at=at) for name in ("servo.loop_gain", "servo.max_speed")]
    gain = (own[0] or 0.0) / 1000.0 / words.length * 10.0 / sample.FULL_POINTS * (own[1] or 0.0) / 60.0 / 9.0
    above(gain, "servo.loop_gain", f"The gain of drive axis {at} (P21, P30)")
    correction, threshold = read.optional("servo.sync_correction"), read.optional("servo.sync_error")
    notes.append(
        f"ASSUMED: the drive axis {at} of the synchronised pair moves by its own KVAR, with a drive without lag, and pulls"
        " the driven axis by the control alone, not by the machine (4-30, 6-30)."
    )
    limit = math.inf if threshold is None else threshold * words.length
    return gain, (250.0 if correction is None else correction) / 1000.0, limit
