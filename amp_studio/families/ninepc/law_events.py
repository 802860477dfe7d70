"""Homing, jogging and overtravels of a 9/PC axis (chapters 5, 6 and 8)."""

from __future__ import annotations

import math

from amp_studio.sim import AxisParameters, CodedScale, Failure, Homing, Jogging, Ramp, SimulationError, Travel

from .law_facts import ids
from .law_feedback import Feedback
from .law_reading import above_zero, if_set

_SIGN = {"plus": 1.0, "positive": 1.0, "minus": -1.0, "negative": -1.0}
JOGS = ("lowest", "second", "third", "fourth", "highest")
INCREMENTS = ("smallest", "second", "third", "fourth", "largest")

_HOMED = (
    (
        "The axis has not been homed: G28 searches at G28 Home Speed in G28 Direction to Home (5-13), a"
        " manual homing at the jog speed (5-3); from the switch on both are the same (steps 3 to 10, 5-3 and"
        " 5-4)."
    ),
    (
        "The home position is the marker nearest to where the switch goes off, and Home Calibration from"
        " there (5-4, 5-10)."
    ),
    (
        "ASSUMED: the ramp of homing is that of manual moves, exponential by Manual Delay Constant (10-14"
        " calls homing exponential)."
    ),
)
_TOO_FAST = Failure(
    "JOGGED HOME TOO FAST:",
    "The axis passed the whole switch before it stopped: it is too fast for it (page 5-4)",
)
CODED = (
    (
        "Three markers in a row are passed at G28 Home Speed in G28 Direction to Home, then the axis stops,"
        " waits for Inposition Band and takes its place on the scale plus Machine Position at DCM Scale 0 as"
        " its position (5-5 to 5-7, 5-14); pages 7-31 and B-1 say two markers."
    ),
    (
        "Then it goes to Axis Position After Homing at Home Speed from Limit Switch (5-14); by page 5-11 this"
        " position is not used with such a scale."
    ),
    (
        "ASSUMED: even markers lie half a smaller period beside the odd ones at the zero of the scale; it is"
        " not printed."
    ),
)
_STOPPED = (
    "A software overtravel stops all commands of a manual motion at once, without a ramp; the axis moves past"
    " it by its following error (10-18). ASSUMED: a programmed move is stopped in the same way, which is not"
    " printed."
)
_ZONE_PAGE = "6-3 and 6-7"
"""While the logic program requests it, in positioning moves; jogs are not slowed (9-6)."""
_ZONES = (
    "ASSUMED: the axis is alone in its zone group, so that no other axis keeps it out of the zone (6-4), and"
    " is stopped there as at an overtravel; for zones no stop is printed (6-3)."
)
JOGGED = (
    "Incremental jogs go at Third Jog Speed (8-2). Linear manual ramps are those of programmed moves (10-18)."
)


def manual_ramp(read: AxisParameters, linear: Ramp, homing: bool) -> Ramp:
    """Return the ramp of manual moves (10-14, 10-18): exponential, or linear as Manual ACC./DEC Mode is set,
    but for homing.
    """
    # Homing is exponential whatever the mode of jogs is (10-14).
    if not homing and read.value(ids.manual_mode, everywhere=True) == "linear":
        return linear
    delay = read.optional(ids.manual_delay)
    fine = read.optional(ids.fine_foreground, everywhere=True)
    if delay is None or fine is None:
        return linear
    # The delay counts scans of the logic program: each is so many fine iterations long.
    scans = read.optional(ids.scans_per_logic, everywhere=True)
    return Ramp("exponential", time=delay * fine * (1.0 if scans is None else scans) / 1000.0)


def homing(read: AxisParameters, feedback: Feedback) -> Homing:
    """Return the homing sequence, with a marker each turn of the position device. Raises SimulationError for
    devices that home without a switch.
    """
    if read.choice(ids.position_feedback_type) == "dcm":
        return _coded(read)
    off = _SIGN[read.choice(ids.direction_off_switch)]
    speed = above_zero(read, ids.speed_off_switch) / 60.0
    return Homing(
        approach=_SIGN[read.choice(ids.g28_direction)] * above_zero(read, ids.g28_speed) / 60.0,
        leave=off * speed,
        marker="nearest",
        turn=feedback.position_count * above_zero(read, ids.position_counts),
        coordinate=read.number(ids.home_position),
        final=speed,
        offset=read.optional(ids.home_calibration) or 0.0,
        failures={"fast": _TOO_FAST},
        speeds={"approach": ids.g28_speed, "leave": ids.speed_off_switch, "final": ids.speed_off_switch},
        page="5-4",
        notes=_HOMED,
    )


def _coded(read: AxisParameters) -> Homing:
    """Return the homing by distance-coded markers (5-5 to 5-7, 5-14): no switch, any three in a row,
    then to the home position.
    """
    small, large = above_zero(read, ids.dcm_small_period), above_zero(read, ids.dcm_large_period)
    if small == large:
        raise SimulationError(
            f"Both periods of the scale of axis {read.axis} are {small:g}: no place is known by them",
            ids.dcm_large_period,
        )
    return Homing(
        approach=0.0,
        leave=_SIGN[read.choice(ids.g28_direction)] * above_zero(read, ids.g28_speed) / 60.0,
        marker="next",
        turn=small,
        coordinate=read.number(ids.home_position),
        final=above_zero(read, ids.speed_off_switch) / 60.0,
        scale=CodedScale(small, large, 0.5 * small, read.optional(ids.dcm_scale_zero) or 0.0),
        speeds={"search": ids.g28_speed, "final": ids.speed_off_switch},
        page="5-5",
        notes=CODED,
    )


def jogging(read: AxisParameters) -> Jogging:
    """Return the speeds (8-2 to 8-5, 8-14) and increments (8-7 to 8-10) that are set."""
    speeds = {name: if_set(read, ids[f"jog_speed_{name}"]) / 60.0 for name in JOGS}
    speeds["traverse"] = if_set(read, ids.traverse_speed) / 60.0
    increments = {name: if_set(read, ids[f"jog_increment_{name}"]) for name in INCREMENTS}
    return Jogging(
        # A speed of 0 moves nothing: it would be a jog without an end.
        {name: speed for name, speed in speeds.items() if speed},
        {name: way for name, way in increments.items() if way},
        "third",
        page="8-2",
        notes=(JOGGED,),
    )


def travel(read: AxisParameters) -> Travel:
    """Return the software overtravels (6-10, 6-11), if they are used."""
    zones = _zones(read)
    if read.value(ids.overtravel_used) is not True:
        return Travel({}, "OVERTRAVEL", "6-10", zones=zones, zone_page=_ZONE_PAGE, zone_note=_ZONES)
    low, high = (read.optional(ids[f"zone_overtravel_{side}"]) for side in ("negative", "positive"))
    # An end that is not set stops nothing on its side.
    edges = (-math.inf if low is None else low, math.inf if high is None else high)
    notes = (
        _STOPPED,
        (
            "The overtravel works only after homing (6-10). ASSUMED: it is checked once in a servo sample, on"
            " the measured position."
        ),
    )
    slow = (read.optional(ids.external_decel_positioning) or 0.0) / 60.0
    return Travel(
        {"the software overtravel": edges}, "OVERTRAVEL", "6-10", notes, zones, _ZONE_PAGE, _ZONES, slow=slow
    )


def _zones(read: AxisParameters) -> dict[str, tuple[float, float]]:
    """Return the programmable zones 2 and 3 (6-7 to 6-9) that are set."""
    found = {}
    for zone in ("2", "3"):
        low, high = (read.optional(ids[f"zone_limit{zone}_{side}"]) for side in ("min", "max"))
        # Equal or crossed limits enclose nothing, so that there is no zone.
        if low is not None and high is not None and low < high:
            found[zone] = (low, high)
    return found
