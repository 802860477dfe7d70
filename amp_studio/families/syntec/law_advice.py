"""Recommendations after a move of a Syntec axis: rapid feedrate, interpolation time and acceleration,
with page and price.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from amp_studio.sim import AxisLaw, Recommendation, Trace, value_text

from . import law_sample as sample
from .law_facts import ids

_MIN_GRID, _MAX_GRID = 20.0, 80.0
"""% of a turn between dog and index (2.2)."""
_RECOMMENDED = 2000.0
"""Pr3203 should not be below (1.5.1)."""


def advise(axis: AxisLaw, trace: Trace) -> tuple[Recommendation, ...]:
    """Return the recommendations after the scenarios `step` and `home`; none after others."""
    if trace.scenario == "home":
        return tuple(_grid(trace))
    if trace.scenario != "step":
        return ()
    return (*_pulses(axis, trace), *_ramp(axis, trace))


def _grid(trace: Trace) -> Iterator[Recommendation]:
    """Yield the home grid function where the index is so near to the edge of the dog
    that it may be missed (2.2).
    """
    grid = trace.result.get("home_grid", (None, "%"))[0]
    if grid is None or _MIN_GRID <= grid <= _MAX_GRID:
        return
    yield Recommendation(
        ids.home_grid,
        1.0,
        "",
        f"The home grid is {value_text(grid, '%', 3)}: below {_MIN_GRID:g} or above {_MAX_GRID:g} % "
        "the index"
        " lies so near to the dog that it may be missed once and found the next time (page 2.2).",
        "An index within half a turn of the dog is passed, and home moves by a turn.",
    )


def _pulses(axis: AxisLaw, trace: Trace) -> Iterator[Recommendation]:
    """Yield a shorter interpolation time, else a lower rapid feedrate,
    where a move needs more than 2047 pulses (1.5.1).
    """
    most = axis.parameters[sample.MAX_PULSES]
    asked = (trace.result["feedrate"][0] or 0.0) / 60.0
    period = axis.servo_period * sample.PARTS
    pulses = asked * period / axis.parameters[sample.PULSE]
    if not pulses > most:
        return
    time, rapid = axis.sources["servo_period"], axis.sources["feedrate"]
    setting = math.floor(axis.servo_period * time.scale * most / pulses)
    why = f"{value_text(math.ceil(pulses))} pulses in one interpolation time, and {most:g} are allowed"
    if setting >= _RECOMMENDED:
        yield Recommendation(
            time.parameter,
            float(setting),
            "",
            f"{why}; a shorter time needs fewer (page 1.4.1).",
            "The control computes more often; below 2000 is not recommended (page 1.5.1).",
        )
        return
    highest = math.floor(most * axis.parameters[sample.PULSE] / period * 60.0)
    if axis.feedrate is not None and highest < axis.feedrate * 60.0:
        yield Recommendation(
            rapid.parameter,
            float(highest),
            f"{axis.unit}/min",
            f"{why}; this is the highest feedrate (page 1.4.2).",
            f"Rapid moves are {value_text(axis.feedrate * 60.0 / highest, digits=3)} times as slow.",
        )


def _ramp(axis: AxisLaw, trace: Trace) -> Iterator[Recommendation]:
    """Yield a longer acceleration time where the torque of a machine that was given was at its limit
    (1.5.3).
    """
    limit = min(axis.machine.torque_limit_positive, axis.machine.torque_limit_negative)
    available = 0.8 * axis.machine.acceleration_per_output * (limit - axis.machine.coulomb_friction)
    now, source = axis.ramps["linear"].acceleration, axis.sources["acceleration"]
    limited = (trace.result["peak_torque"][0] or 0.0) >= limit
    if "acceleration_per_output" in axis.assumed or not limited or not 0.0 < available < now:
        return
    yield Recommendation(
        source.parameter,
        float(math.ceil(1000.0 * (axis.feedrate or 0.0) / available)),
        "",
        f"The torque was at its limit; 80 % of it accelerate by {value_text(available, f'{axis.unit}/s2', 4)}"
        f" (page {source.page}).",
        f"Rapid moves reach their feedrate {value_text(now / available, digits=3)} times as late.",
    )
