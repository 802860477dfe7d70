"""The 9/PC's ramps (chapter 10) as figures of `sim`."""

from __future__ import annotations

from amp_studio.sim import AxisParameters, Ramp, SimulationError, value_text

from .law_facts import ids
from .law_reading import LARGEST, SMALLEST, demand, if_set, not_negative

_SHORTEST, _LONGEST = 2, 60
"""Scans of an S-curve filter (10-19)."""


def ramps_of(read: AxisParameters, unit: str, notes: list[str]) -> dict[str, Ramp]:
    """Return the ramps of an axis by kind, that of positioning (10-3) first.

    0 as acceleration is no ramp, as deceleration the acceleration (10-8, 10-10, 10-11, 10-13). Raises
    SimulationError where a figure that the ramp needs is not set or impossible.
    """
    step, up, down = (
        if_set(read, ids.velocity_step) / 60.0,
        not_negative(read, ids.linear_acceleration),
        not_negative(read, ids.linear_deceleration),
    )
    found = {"linear": Ramp("linear", up, down or up, velocity_step=step)}
    time, scan = _exponential(read, notes)
    if time is not None:
        found["exponential"] = Ramp("exponential", time=time)
    curve = _curve(read, unit, scan, step, notes)
    if curve is not None:
        found["s-curve"] = curve
    found["none"] = Ramp()
    own = str(read.value(ids.positioning_mode, everywhere=True) or "linear")
    if own not in found:
        delay = read.called(ids.programmed_delay, everywhere=True)
        notes.append(
            f"Positioning is exponential (10-3), but {delay} or the scan time is not set: linear ramps are"
            " used."
        )
        own = "linear"
    # The first of the dictionary is what moves use by default; ``found`` has it again, in its place.
    return {own: found[own], **found}


def jerk_bounds(ramp: float, scan: float) -> tuple[float, float]:
    """Return the least and the greatest jerk in u/s3 for a ramp in u/s2 and a scan in s:
    ramp / time of 60 and of 2 scans (10-20).
    """
    return ramp / (_LONGEST * scan), ramp / (_SHORTEST * scan)


def _exponential(read: AxisParameters, notes: list[str]) -> tuple[float | None, float | None]:
    """Return (time constant, system scan time) in s; None where they are not set (10-14, 10-17)."""
    delay, fine = (
        read.optional(ids.programmed_delay, everywhere=True),
        read.optional(ids.fine_foreground, everywhere=True),
    )
    scans = read.optional(ids.scans_per_logic, everywhere=True)
    if fine is None:
        return None, None
    scan = fine * (1.0 if scans is None else scans)
    if not SMALLEST <= scan <= LARGEST:
        raise SimulationError(
            f"{read.called(ids.fine_foreground, everywhere=True)} times"
            f" {read.called(ids.scans_per_logic, everywhere=True)} is {scan:g} ms; it must be above 0 and a"
            " scan time",
            ids.fine_foreground,
        )
    if delay is None:
        return None, scan / 1000.0
    demand(read, ids.programmed_delay, delay, delay > 0.0, "must be above 0", everywhere=True)
    notes.append(
        "One coarse iteration of Programmed Delay Constant (10-17) is assumed to be Fine Foreground Scan Time"
        f" times Fine Scans per Logic Scan (33-19), {scan:g} ms."
    )
    return delay * scan / 1000.0, scan / 1000.0


def _curve(read: AxisParameters, unit: str, scan: float | None, step: float, notes: list[str]) -> Ramp | None:
    """Return the S-curve: its time is ramp / jerk, between 2 and 60 scans (10-19 to 10-22);
    None where it is not set.
    """
    up, down, jerk = (
        if_set(read, ids.scurve_acceleration),
        if_set(read, ids.scurve_deceleration),
        if_set(read, ids.accdec_jerk),
    )
    if up == 0.0 or jerk == 0.0:
        return None
    if scan is not None:
        low, high = jerk_bounds(up, scan)
        used = min(max(jerk, low), high)
        if used != jerk:
            notes.append(
                f"Axis Jerk {value_text(jerk)} {unit}/s3 gives an S-curve of "
                f"{value_text(up / jerk, 's', 3)}, outside"
                f" of 2 to 60 scans (10-19): the S-curve is simulated with {value_text(used)} {unit}/s3."
            )
            jerk = used
    return Ramp("s-curve", up, down or up, jerk=jerk, velocity_step=step)
