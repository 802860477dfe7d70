"""Scenario `probe`: a probe or a registration mark met at a speed: the position that is taken,
how far it is wrong, and the overrun.
"""

from __future__ import annotations

import math

from amp_studio.sim.axis.moving_axis import MovingAxis, Watch
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw, BoundMachine
from amp_studio.sim.model import assumptions
from amp_studio.sim.probing import Probing
from amp_studio.sim.rounding import value_text
from amp_studio.sim.scenario import Scenario, Settings, above_zero, number, refuse_unknown
from amp_studio.sim.trace import Alarm, Figure, Trace

from .columns import alarms_of, column_units, per_minute

SETTINGS = {
    "move.speed": (
        "speed at which the probe is met (mm/min or deg/min); --speed is the same; default: that of the file"
    ),
    "move.cycle": "which cycle of the control, as G31 or G38; default: the first one",
    "move.expected": (
        "where the signal is expected, from the start (mm or deg); default: far enough to reach the speed"
    ),
    "move.touch": (
        "where the probe is met, from the start (mm or deg), or none; default: where it is expected"
    ),
    "move.latency": "from the signal to the position that is taken (s); default: that of the control",
    "move.overtravel": "how far the probe can be pushed over (mm or deg); default: not checked",
}
RUN_UP = 5.0
"""Time constants of the position loop until the axis follows its command."""
COUNTS = 100.0
"""Counts to the probe at least."""
FARTHER = 2.0
"""Bands, or run-ups, behind the expected place at which a move without a signal ends."""


def run_probe(machine: BoundMachine, settings: Settings) -> Trace:
    """Meet a probe once; raises SimulationError for impossible settings."""
    refuse_unknown(settings, SETTINGS)
    if machine.law.probing is None:
        raise SimulationError("Neither a probing cycle nor a registration input is printed for this family")
    axis = machine.axis(machine.one_chosen("probe"))
    probing = machine.law.probing(machine.parameters, axis, str(settings.get("move.cycle") or ""))
    given = above_zero(settings, "move.speed")
    speed = probing.speed if given is None else given / 60.0
    if not speed:
        raise SimulationError(f"Give the speed of {probing.name}: probe --speed 100", "move.speed")
    latency = number(settings, "move.latency")
    if latency is not None and latency < 0.0:
        raise SimulationError("move.latency must not be negative", "move.latency")
    own = latency is None
    wait = probing.latency if latency is None else latency
    return _probed(axis, probing, speed, wait, settings, own=own)


def _probed(
    axis: AxisLaw, probing: Probing, speed: float, latency: float, settings: Settings, *, own: bool
) -> Trace:
    ramp = probing.ramp or next(iter(axis.ramps.values()))
    run_up = speed * (
        5.0 * ramp.time
        + (speed / ramp.acceleration if ramp.acceleration else 0.0)
        + RUN_UP / axis.position_rate
    )
    given = number(settings, "move.expected")
    least = COUNTS * axis.machine.position_count
    expected = probing.approach_distance + max(run_up * FARTHER, least) if given is None else given
    if expected == 0.0:
        raise SimulationError("move.expected is 0; the probe must be somewhere else", "move.expected")
    sign = math.copysign(1.0, expected)
    touch = _touch(settings, expected)
    moving = MovingAxis(axis)
    far = abs(expected) + (probing.band if math.isfinite(probing.band) else FARTHER * run_up)
    if probing.approach and probing.approach_distance:
        moving.to(sign * min(probing.approach_distance, abs(expected)), probing.approach, ramp)
    seen = None
    place = sign * math.inf if touch is None else touch
    if probing.after == "goes on":
        far = abs(place) + run_up if touch is not None else far
    way = far - sign * moving.position
    if touch is not None and sign * touch > far + moving.behind(speed):
        place = sign * math.inf
    if not moving.is_over:
        seen = moving.go(sign * speed, ramp, Watch(place, sign), way)
    captured = None
    if seen is not None:
        # Between two samples the signal comes at its place, and the position is taken a latency later.
        captured = place + sign * speed * latency
        moving.advance(latency)
    if not moving.is_over:
        moving.stop(ramp)
    beyond = None if seen is None else moving.passed(place, sign)
    if seen is not None and captured is not None and probing.after == "returns":
        moving.to(captured, speed, ramp)
    motion = moving.motion()
    alarms = alarms_of(axis, motion)
    inside = captured is not None and abs(captured - expected) <= probing.band
    if probing.outside and not inside:
        what = (
            "No signal comes"
            if captured is None
            else f"The signal comes {value_text(abs(captured - expected), axis.unit)} from where it "
            "is expected"
        )
        text = (
            f"{what}; the band is {value_text(probing.band, axis.unit)} on both sides (page {probing.page})"
        )
        moment = float(motion.columns["time_s"][-1]) if seen is None else seen.time
        alarms = (*alarms, Alarm(probing.outside, moment, text))
    room = above_zero(settings, "move.overtravel")
    if room is not None and beyond is not None and beyond > room:
        text = (
            f"The probe is pushed {value_text(beyond, axis.unit)} over, more than "
            f"{value_text(room, axis.unit)}"
        )
        alarms = (*alarms, Alarm("PROBE OVERTRAVEL", seen.time if seen else 0.0, text))
    result: dict[str, Figure] = {
        "speed": (speed * 60.0, f"{axis.unit}/min"),
        "latency": (latency, "s"),
        "captured_position": (captured, axis.unit),
        "probe_error": (None if captured is None else abs(captured - place), axis.unit),
        "overrun": (None if probing.after == "goes on" else beyond, axis.unit),
        "band": (probing.band if math.isfinite(probing.band) else None, axis.unit),
        "from_expected": (None if captured is None else captured - expected, axis.unit),
        "stop_position": (float(motion.columns["position"][-1]), axis.unit),
        "time": (motion.command_end if not motion.stop else None, "s"),
    }
    notes = [probing.latency_note if own else "The latency is that of move.latency."]
    for page, other in probing.alternatives.items():
        result[f"probe_error_{page.replace('-', '_').lower()}"] = (speed * other, axis.unit)
        notes.append(
            f"Page {page} prints {value_text(other * 1e6, 'µs')}: "
            f"{value_text(speed * other, axis.unit)} at this speed."
        )
    return Trace(
        scenario="probe",
        axis=axis.axis,
        model=f"{axis.title}; {probing.name}",
        columns=per_minute(motion.columns),
        units=column_units(axis),
        result=result,
        alarms=alarms,
        recommendations=(),
        assumptions=(*notes, *probing.notes, *assumptions(axis)),
        limits={},
        move={"move.expected": expected},
    )


def _touch(settings: Settings, expected: float) -> float | None:
    """Return where the probe is met; None where it never is."""
    text = settings.get("move.touch")
    if text is None:
        return expected
    if text == "none":
        return None
    found = number(settings, "move.touch")
    if found is None or found * expected <= 0.0:
        raise SimulationError("move.touch must be on the way to where the signal is expected", "move.touch")
    return found


SCENARIO = Scenario(
    "probe",
    "A probe or a registration mark at a speed: position taken, error, overrun, band",
    SETTINGS,
    run_probe,
    gains=False,
    of_machine=True,
)
