"""How a 9/PC goes along the path of a program: feedrates (9-1, 9-2), linear ramps (10-3 on), velocity step
(10-7), exact stops (7-24).
"""

from __future__ import annotations

from amp_studio.sim import AxisParameters, BoundMachine, PathLimit, PathRules, SimulationError, steps_of_axes

from .law_dual import slowest
from .law_facts import ids
from .law_reading import above_zero, if_set

ASSUMED = (
    (
        "The vector feedrate is such that no axis passes its maximum cutting feedrate (9-2), or its"
        " rapid feedrate (9-1)."
    ),
    (
        "ASSUMED: the ramp along the path is such that no axis passes its linear acceleration and"
        " deceleration (10-8, 10-10)."
    ),
    (
        "ASSUMED: a corner of G62 and G64 is passed at the speed at which no axis changes its own by more"
        " than its Velocity Step (10-7), and as many blocks are known as are needed: both are in the"
        " programming manual, which is not among the sources."
    ),
)


def path_rules(machine: BoundMachine) -> PathRules:
    """Return the rules of a file; raises SimulationError naming what is missing or not simulated."""
    if str(machine.parameters.value(ids.positioning_mode, everywhere=True) or "") == "exponential":
        mode = machine.parameters.called(ids.positioning_mode, everywhere=True)
        raise SimulationError(
            f"Programs with exponential ramps ({mode}, 10-3) are not simulated", ids.positioning_mode
        )
    cutting, rapid, faster, slower, steps = {}, {}, {}, {}, {}
    for axis in machine.fitted:
        read, letter = machine.read(axis), machine.letter(axis) or axis
        try:
            cutting[letter] = _speed(read, ids.max_cutting)
            rapid[letter] = _speed(read, ids.feedrate_rapid)
        except SimulationError:
            continue  # an axis without feedrates moves in no block; the planner names it where it does
        faster[letter], slower[letter] = _ramp(read, down=False), _ramp(read, down=True)
        member = slowest(read, ids.velocity_step)
        steps[letter] = PathLimit(if_set(member, ids.velocity_step) / 60.0, (ids.velocity_step, member.axis))
    return PathRules(
        axis_speed=cutting,
        axis_rapid=rapid,
        axis_acceleration=faster,
        axis_deceleration=slower,
        corner=steps_of_axes(steps),
        waits=True,
        stop=PathLimit(0.0, (ids.inposition_band, machine.fitted[0])),
        assumptions=ASSUMED,
    )


def _speed(read: AxisParameters, parameter: str) -> PathLimit:
    """Return a feedrate in u/s, in a dual group that of the slowest member (31-2)."""
    member = slowest(read, parameter)
    return PathLimit(above_zero(member, parameter) / 60.0, (parameter, member.axis))


def _ramp(read: AxisParameters, *, down: bool) -> PathLimit:
    """Return a linear ramp, 0 for none; without a deceleration it is the acceleration (10-10)."""
    member = slowest(read, ids.linear_deceleration)
    if down and (slower := if_set(member, ids.linear_deceleration)):
        return PathLimit(slower, (ids.linear_deceleration, member.axis))
    member = slowest(read, ids.linear_acceleration)
    return PathLimit(if_set(member, ids.linear_acceleration), (ids.linear_acceleration, member.axis))
