"""The spindle output and the skip of AcroMill (pages 29, 77)."""

from __future__ import annotations

from amp_studio.sim import AxisLaw, AxisParameters, Gear, Probing, SimulationError, Spindle

from .law_facts import ids

_FULL_V = 10.0
_SHARED = "The output is Spindle Scaling x speed (page 77): one step, a ramp is not printed."
_LATENCY = "ASSUMED: the card takes the position at the signal itself; its latency is not printed (page 29)."


def spindle(read: AxisParameters, number: str) -> Spindle:
    """Return the spindle; raises SimulationError without a scaling."""
    if number != "1":
        raise SimulationError("AcroMill has one spindle", "move.spindle")
    scaling = read.number(ids.spindle_scaling, everywhere=True)
    if scaling == 0.0:
        raise SimulationError("Spindle Scaling is 0: no speed gives an output", ids.spindle_scaling)
    top = _FULL_V / abs(scaling)
    sign = 1.0 if scaling > 0.0 else -1.0
    gear = Gear("1", 0.0, top, full=top, output=sign * _FULL_V)
    return Spindle("1", "AcroMill spindle: analog output", "V", (gear,), "77", (_SHARED,))


def probing(read: AxisParameters, _axis: AxisLaw, cycle: str) -> Probing:
    """Return G31: it decelerates, and goes back to where the signal came (page 29).
    Raises SimulationError for another cycle.
    """
    name = cycle.upper() or "G31"
    if name != "G31":
        raise SimulationError(f"Unknown cycle {cycle}. Known: G31", "move.cycle")
    edge = read.value(ids.probe_edge, everywhere=True)
    return Probing(
        "G31 block skip",
        (read.optional(ids.probe_feedrate, everywhere=True) or 0.0) / 60.0,
        0.0,
        _LATENCY,
        after="returns",
        page="29",
        notes=(f"The signal counts at its {edge or 'rising'} edge.",),
    )
