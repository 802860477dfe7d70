"""Skip, gauging and probing cycles of a 9/PC (9-7, 21-9 to 21-11, chapter 29)."""

from __future__ import annotations

from amp_studio.sim import AxisLaw, AxisParameters, Probing, SimulationError

from .law_facts import ids

CYCLES = {
    "G31": (ids.skip_g31, ""),
    "G31.1": (ids.skip_g31, ""),
    "G31.2": (ids.skip_g31_2, ""),
    "G31.3": (ids.skip_g31_3, ""),
    "G31.4": (ids.skip_g31_4, ""),
    "G37": (ids.skip_g31, "1"),
    "G37.1": (ids.skip_g31, "1"),
    "G37.2": (ids.skip_g31_2, "2"),
    "G37.3": (ids.skip_g31_3, "3"),
    "G37.4": (ids.skip_g31_4, "4"),
    "G38": (ids.probe_rate, ""),
    "G38.1": (ids.probe_rate, ""),
}
"""Cycle -> the parameter of its feedrate (9-8, 29-7) and the skip whose tolerance it has (21-9)."""
LATENCY = (
    "ASSUMED: the position is taken within a servo sample of the signal; how fast a 9/PC takes it is not"
    " printed."
)
PROGRAMMED = (
    "Use AMP Skip Feedrate (4) is not yes: the cycle goes at the programmed feedrate, which move.speed gives"
    " (9-8)."
)


def probing(read: AxisParameters, axis: AxisLaw, cycle: str) -> Probing:
    """Return a cycle, G31 where none is named; raises SimulationError for an unknown one."""
    name = cycle.upper() or "G31"
    if name not in CYCLES:
        raise SimulationError(f"Unknown cycle {cycle}. Known: {', '.join(CYCLES)}", "move.cycle")
    parameter, skip = CYCLES[name]
    edge = read.value(ids.probing_transition, everywhere=True)
    seen = f"The signal counts as it goes {'off' if edge == 'high-to-low' else 'on'} (602, 29-4)."
    speed = (read.optional(parameter, everywhere=True) or 0.0) / 60.0
    if name.startswith("G38"):
        return _probing_cycle(read, axis, name, speed, seen)
    return _skip(read, axis, name, skip, speed, seen)


def _probing_cycle(read: AxisParameters, axis: AxisLaw, name: str, speed: float, seen: str) -> Probing:
    """Return a probing cycle: quick up to the approach distance, then at the probe rate."""
    return Probing(
        f"{name} at Probe Rate behind Approach Distance",
        speed,
        axis.servo_period,
        LATENCY,
        approach=(read.optional(ids.approach_rate, everywhere=True) or 0.0) / 60.0,
        approach_distance=read.optional(ids.approach_distance, everywhere=True) or 0.0,
        band=read.number(ids.tolerance_band, everywhere=True),
        outside="PROBE ERROR",
        page="29-6",
        notes=(seen, "Approach Distance counts from the start of the cycle (29-4)."),
    )


def _skip(read: AxisParameters, axis: AxisLaw, name: str, skip: str, speed: float, seen: str) -> Probing:
    """Return a skip cycle, which changes an offset where ``skip`` names its table."""
    is_own = read.value(ids.use_skip_feedrate, everywhere=True) is True
    notes = [seen] if is_own else [seen, PROGRAMMED]
    band = float("inf")
    if skip:
        band = read.number(ids.skip_tolerance, at=skip)
        adds = read.value(ids.skip_add, at=skip) is True
        target = read.value(ids.skip_target, at=skip)
        notes.append(
            f"In the tolerance the result {'is added to' if adds else 'replaces'} the {target or 'wear'}"
            " offset; outside of it no offset changes (21-9 to 21-11)."
        )
    return Probing(
        f"{name} skip",
        speed if is_own else 0.0,
        axis.servo_period,
        LATENCY,
        band=band,
        outside="NO OFFSET" if skip else "",
        page="21-9" if skip else "9-8",
        notes=tuple(notes),
    )
