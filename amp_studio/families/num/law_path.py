"""How a NUM goes along the path of a programme: traverse rates (6-6), accelerations of work and fast moves
(6-10), approach speeds between blocks (6-36), the in-position window of G9 (6-20).
"""

from __future__ import annotations

from amp_studio.sim import AxisParameters, BoundMachine, PathLimit, PathRules, SimulationError, steps_of_axes

from .law_facts import ids
from .law_words import Words, read_words

ASSUMED = (
    (
        "No axis passes its Maximum Axis Traverse Rate (P30), nor its acceleration (P32): the first word of"
        " work rates, the second of G0 (6-10)."
    ),
    (
        "ASSUMED: from one block to the next no axis changes its speed by more than its Approach Speed (P33),"
        " and as many blocks are known as are needed; the programming manual is not among the sources."
    ),
    "ASSUMED: the feed is that along the path.",
)


def path_rules(machine: BoundMachine) -> PathRules:
    """Return the rules of a file; raises SimulationError naming what is missing."""
    speeds, work, fast, steps = {}, {}, {}, {}
    notes: list[str] = []
    for axis in machine.fitted:
        read, letter = machine.read(axis), machine.letter(axis)
        # An axis without a name is in no program.
        if not letter:
            continue
        words = read_words(read, [])
        speeds[letter] = PathLimit(words.top, (ids.max_speed, axis))
        work[letter] = PathLimit(_work(words, axis), (ids.acceleration_work, axis))
        fast[letter] = PathLimit(words.acceleration, (ids.acceleration_fast, axis))
        steps[letter] = _approach(read, words, axis, notes)
    # Bit 5 of P7N1 is of the whole control: the first axis has the same kind of ramp as all.
    ramp = next(iter(machine.axis(machine.fitted[0]).ramps.values()))
    return PathRules(
        feed_ramp=ramp,
        rapid_ramp=ramp,
        axis_speed=speeds,
        axis_acceleration=work,
        axis_rapid_acceleration=fast,
        corner=steps_of_axes(steps),
        waits=True,
        stop=PathLimit(0.0, (ids.in_position_window, machine.fitted[0])),
        assumptions=(*ASSUMED, *dict.fromkeys(notes)),
    )


def _work(words: Words, axis: str) -> float:
    if not words.work_acceleration > 0.0:
        raise SimulationError(
            f"P32N{axis}: the acceleration of work rates is not set (6-10)", ids.acceleration_work
        )
    return words.work_acceleration


def _approach(read: AxisParameters, words: Words, axis: str, notes: list[str]) -> PathLimit:
    """Return by how much an axis may change its speed; with 0 it is P32 times the time constant (6-36)."""
    own = read.optional(ids.approach_speed)
    if own:
        return PathLimit(own / 60.0, (ids.approach_speed, axis))
    notes.append(
        "An Approach Speed (P33) that is 0 or not set is acceleration times time constant (6-36, 6-40)."
    )
    return PathLimit(words.work_acceleration * words.constant, (ids.approach_speed, axis))
