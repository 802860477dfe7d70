"""Scenario `probe`: a probe or a registration mark met at a speed: the position that is taken,
how far it is wrong, and the overrun.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from amp_studio.sim.axis.motion import Motion
from amp_studio.sim.axis.moves import run_up
from amp_studio.sim.axis.moving_axis import MovingAxis
from amp_studio.sim.axis.orders import Seen, Watch
from amp_studio.sim.command.events import Ramp
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw, BoundMachine
from amp_studio.sim.model import assumptions
from amp_studio.sim.probing import Probing
from amp_studio.sim.rounding import page_text, value_text
from amp_studio.sim.scenario import Scenario, ScenarioSettings, above_zero, number, refuse_unknown
from amp_studio.sim.trace import Alarm, Figure, Trace

from .columns import alarms_of, column_units, per_minute

SETTINGS = {
    "move.speed": "speed at which the probe is met (mm/min or deg/min); default: that of the file",
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
COUNTS = 100.0
"""Counts to the probe at least."""
FARTHER = 2.0
"""Bands, or run-ups, behind the expected place at which a move without a signal ends."""


def run_probe(machine: BoundMachine, settings: ScenarioSettings) -> Trace:
    """Meet a probe once; raises SimulationError for impossible settings."""
    refuse_unknown(settings, SETTINGS)
    if machine.law.probing is None:
        raise SimulationError("Neither a probing cycle nor a registration input is printed for this family")
    axis = machine.axis(machine.one_chosen("probe"))
    probing = machine.law.probing(machine.parameters, axis, str(settings.get("move.cycle") or ""))
    given = above_zero(settings, "move.speed")
    speed = probing.speed if given is None else given / 60.0
    if not speed:
        raise SimulationError(f"Give the speed of {probing.name}: move.speed, as 100", "move.speed")
    latency = number(settings, "move.latency")
    if latency is not None and latency < 0.0:
        raise SimulationError("move.latency must not be negative", "move.latency")
    note = probing.latency_note if latency is None else "The latency is that of move.latency."
    wait = probing.latency if latency is None else latency
    return _probed(axis, _probe_contact(axis, probing, speed, wait, settings), note, settings)


@dataclass(frozen=True)
class _ProbeContact:
    """A probe that is to be met: places in u from the start."""

    probing: Probing
    speed: float
    """u/s"""
    latency: float
    """s"""
    ramp: Ramp
    expected: float
    sign: float
    """1.0 or -1.0: the direction of the move."""
    run_up: float
    """From rest until the axis follows its command."""
    touch: float | None
    """Where the probe is; None for nowhere."""


@dataclass(frozen=True)
class _Outcome:
    """What the axis did: places in u from the start."""

    motion: Motion
    seen: Seen | None
    """The servo sample that saw the signal; None where none came."""
    place: float
    """Where the signal came; infinite for never."""
    captured: float | None
    """The position that the control took."""
    beyond: float | None
    """How far the axis went over the place of the signal."""


def _probe_contact(
    axis: AxisLaw, probing: Probing, speed: float, latency: float, settings: ScenarioSettings
) -> _ProbeContact:
    """Return where the probe is met; raises SimulationError for a place that is none."""
    ramp = probing.ramp or next(iter(axis.ramps.values()))
    way = run_up(axis, speed, ramp)
    expected = number(settings, "move.expected")
    if expected is None:
        least = COUNTS * axis.machine.position_count
        expected = probing.approach_distance + max(way * FARTHER, least)
    if expected == 0.0:
        raise SimulationError("move.expected is 0; the probe must be somewhere else", "move.expected")
    sign = math.copysign(1.0, expected)
    return _ProbeContact(probing, speed, latency, ramp, expected, sign, way, _contact(settings, expected))


def _probe_move(axis: AxisLaw, meeting: _ProbeContact) -> _Outcome:
    """Move the axis against the probe and through what the cycle does then."""
    probing, sign, speed, touch = meeting.probing, meeting.sign, meeting.speed, meeting.touch
    moving = MovingAxis(axis)
    far = abs(meeting.expected)
    far += probing.band if math.isfinite(probing.band) else FARTHER * meeting.run_up
    if probing.approach and probing.approach_distance:
        near = min(probing.approach_distance, abs(meeting.expected))
        moving.to(sign * near, probing.approach, meeting.ramp)
    place = sign * math.inf if touch is None else touch
    if probing.after == "goes on" and touch is not None:
        far = abs(place) + meeting.run_up
    way = far - sign * moving.position
    # A probe behind the end of the move is not met, but for what the axis still lags behind its command.
    if touch is not None and sign * touch > far + moving.behind(speed):
        place = sign * math.inf
    seen = captured = None
    if not moving.is_over:
        seen = moving.go(sign * speed, meeting.ramp, Watch(place, sign), way)
    if seen is not None:
        # Between two samples the signal comes at its place, and the position is taken a latency later.
        captured = place + sign * speed * meeting.latency
        moving.advance(meeting.latency)
    if not moving.is_over:
        moving.stop(meeting.ramp)
    beyond = None if seen is None else moving.passed(place, sign)
    if captured is not None and probing.after == "returns":
        moving.to(captured, speed, meeting.ramp)
    return _Outcome(moving.motion(), seen, place, captured, beyond)


def _outside(axis: AxisLaw, meeting: _ProbeContact, outcome: _Outcome) -> tuple[Alarm, ...]:
    """Return the alarm of a cycle that expects its signal within a band."""
    probing, captured = meeting.probing, outcome.captured
    off = math.inf if captured is None else abs(captured - meeting.expected)
    if not probing.outside or (off <= probing.band and captured is not None):
        return ()
    what = "No signal comes"
    if captured is not None:
        what = f"The signal comes {value_text(off, axis.unit)} from where it is expected"
    band = value_text(probing.band, axis.unit)
    text = f"{what}; the band is {band} on both sides ({page_text(probing.page)})"
    seen = outcome.seen
    moment = float(outcome.motion.columns["time_s"][-1]) if seen is None else seen.time
    return (Alarm(probing.outside, moment, text),)


def _pushed_over(axis: AxisLaw, outcome: _Outcome, room: float | None) -> tuple[Alarm, ...]:
    """Return the alarm of a probe that is pushed farther than it can be."""
    if room is None or outcome.beyond is None or outcome.beyond <= room:
        return ()
    way, most = value_text(outcome.beyond, axis.unit), value_text(room, axis.unit)
    moment = outcome.seen.time if outcome.seen else 0.0
    return (Alarm("PROBE OVERTRAVEL", moment, f"The probe is pushed {way} over, more than {most}"),)


def _probed(axis: AxisLaw, meeting: _ProbeContact, latency_note: str, settings: ScenarioSettings) -> Trace:
    """Return the trace of one cycle, with its alarms and figures."""
    outcome = _probe_move(axis, meeting)
    probing, speed, captured, motion = meeting.probing, meeting.speed, outcome.captured, outcome.motion
    alarms = (
        *alarms_of(axis, motion),
        *_outside(axis, meeting, outcome),
        *_pushed_over(axis, outcome, above_zero(settings, "move.overtravel")),
    )
    result: dict[str, Figure] = {
        "speed": (speed * 60.0, f"{axis.unit}/min"),
        "latency": (meeting.latency, "s"),
        "captured_position": (captured, axis.unit),
        "probe_error": (None if captured is None else abs(captured - outcome.place), axis.unit),
        "overrun": (None if probing.after == "goes on" else outcome.beyond, axis.unit),
        "band": (probing.band if math.isfinite(probing.band) else None, axis.unit),
        "from_expected": (None if captured is None else captured - meeting.expected, axis.unit),
        "stop_position": (float(motion.columns["position"][-1]), axis.unit),
        "time": (motion.command_end if not motion.stop else None, "s"),
    }
    notes = [latency_note]
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
        assumptions=(*notes, *probing.notes, *assumptions(axis)),
        move={"move.expected": meeting.expected},
    )


def _contact(settings: ScenarioSettings, expected: float) -> float | None:
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
    part="probing",
    headline="probe_error",
    checked=("speed", "probe_error", "overrun", "band"),
    programmed={"move.speed": 100.0},
)
