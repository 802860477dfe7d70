"""From the words of one NUM axis to the parameters of its sample function, with limits,
alarms and what is assumed.
"""

from __future__ import annotations

import math

from amp_studio.sim import AlarmText, AxisParameters, SimulationError, value_text

from . import law_sample as sample
from .law_facts import ids
from .law_words import Words

LARGEST = "maximum following error"
"""The limit at which the control takes its axes off."""


def loop(
    read: AxisParameters, words: Words, notes: list[str]
) -> tuple[list[float], dict[int, AlarmText], dict[str, float]]:
    """Return the parameters of the sample function, its alarms and the limits of the following error."""
    p = [0.0] * sample.PARAMETERS
    p[sample.GAIN], p[sample.CONSTANT], p[sample.PERIOD] = words.gain, words.constant, words.period
    p[sample.SHARE], p[sample.TERMS], p[sample.WHOLE] = words.share, float(words.terms), 1.0
    p[sample.VOLTS] = words.voltage / words.top
    p[sample.FRICTION], p[sample.FRICTION_LEFT] = _friction(read, words, notes)
    p[sample.AHEAD] = _ahead(read, words, notes)
    p[sample.EMAX] = read.number(ids.max_following_error) * words.length
    p[sample.TOLERANCE] = _tolerance(read, words, notes)
    # No synchronisation yet: a driven axis gets its threshold when it is bound to its leader.
    p[sample.SYNC_LIMIT], p[sample.BACKLASH] = math.inf, _backlash(read, words, notes)
    limit = value_text(p[sample.EMAX], words.unit)
    alarms = {
        int(sample.EXCESS_ERROR): AlarmText(
            "40 to 71",
            f"Following error is above Maximum Following Error (P23N{read.axis}), {limit}; the CNC goes into"
            " the fault state (6-22) and the move ends. Which of the errors 40 to 71 is of this axis is not"
            " printed.",
        ),
        int(sample.DYNAMIC_CHECK): AlarmText(
            "40 to 71",
            f"Dynamic movement control (P57N{read.axis}): the speed is not between 0.875 and 1.125 times the"
            f" one that follows from the following error and {words.constant * 1000.0:g} ms, less and more"
            " the tolerance (6-24).",
        ),
    }
    band = read.number(ids.in_position_window) * words.length
    return p, alarms, {LARGEST: p[sample.EMAX], "in-position window": band}


def _ahead(read: AxisParameters, words: Words, notes: list[str]) -> float:
    """Return the acceleration anticipation in samples (6-34), 0 for none.

    In the printed formula one reference is missing: Ri - Ri-2j-1 + Ri-2j-2. Only - Ri-1 makes it 0 at rest
    and at a constant speed, the change of the filtered speed from one sample to the next.
    """
    anticipation = read.optional(ids.acceleration_anticipation) or 0.0
    if not anticipation:
        return 0.0
    if words.share < 1.0:
        notes.append(
            f"Acceleration Anticipation (P19N{read.axis}) is not used: it belongs to a speed anticipation of"
            f" 100 % (6-34), and P55 has {100.0 * words.share:g} %."
        )
        return 0.0
    notes.append(
        f"ASSUMED: in the printed formula of the acceleration anticipation (P19N{read.axis}, 6-34) - Ri-1 is"
        " missing, without which it would act at rest and at a constant speed; its time times the"
        " acceleration is added to the speed reference."
    )
    return anticipation / 1000.0 / words.period


def _friction(read: AxisParameters, words: Words, notes: list[str]) -> tuple[float, float]:
    """Return (amplitude in u, share that one sample leaves of the correction)
    of the dry friction correction (6-34).
    """
    amplitude = read.optional(ids.friction_amplitude) or 0.0
    if not amplitude:
        return 0.0, 0.0
    time = (read.optional(ids.friction_time) or 0.0) / 1000.0
    # 1 - period / time is the factor from sample to sample: at -1 and below it does not die away.
    if not time > words.period / 2.0:
        raise SimulationError(
            f"The dry friction correction of axis {read.axis} has the time constant {time * 1000.0:g} ms"
            f" (P19, words 64 to 95). With less than half the sampling period, {words.period * 500.0:g} ms,"
            " it never dies away (6-34)",
            ids.friction_time,
        )
    notes.append(
        "ASSUMED: the amplitude of the dry friction correction has the sign of the speed reference, and the"
        " correction is added to the following error; the figure of 6-34 is lost."
    )
    return amplitude * words.length, 1.0 - words.period / time


def _tolerance(read: AxisParameters, words: Words, notes: list[str]) -> float:
    """Return the tolerance of the dynamic check in u per sample, -1 for no check (6-24)."""
    tolerance = read.optional(ids.movement_tolerance)
    if tolerance is None:
        notes.append("Dynamic Movement Control (P57) is not set: it is not simulated.")
    if not tolerance:
        return -1.0
    if words.turns:
        notes.append(
            "Dynamic Movement Control (P57) is in um per sample, and its unit on a rotary axis is not printed"
            " (6-24): it is not simulated on this one."
        )
        return -1.0
    notes.append(
        "ASSUMED: the tolerance of P57 widens the band between 0.875 and 1.125 times the theoretical speed on"
        " both sides, and the theoretical speed is that of the following error one sample before, with the"
        " speed anticipation; the figure of 6-24 is lost."
    )
    return tolerance / 1000.0


def _backlash(read: AxisParameters, words: Words, notes: list[str]) -> float:
    """Return the reversal error compensation in u (7-14); 0 on a machine without backlash, which needs
    none.
    """
    compensation = read.optional(ids.travel_backlash) or 0.0
    if not compensation:
        return 0.0
    # Compensating a play that is not there would itself be an error of the axis.
    if not read.optional("model.backlash"):
        notes.append(
            f"The reversal error compensation P18N{read.axis} is not used: the machine has no backlash unless"
            " model.backlash is set."
        )
        return 0.0
    notes.append(
        "ASSUMED: P18 is added as a whole in the sample in which the reference turns to the positive"
        " direction, and taken away in the negative one; page 7-14 prints its sign only."
    )
    return compensation * words.length
