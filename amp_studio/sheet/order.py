"""An order in which values can be set one after the other so that no state
in between breaks more rules than before.

Values that no check reads together do not matter to each other, so each group that hangs together is searched
alone: first for an order without a new error or warning, then for one without a new error, at last the least
bad step after the other. The validator judges each state;
what is broken in the end anyway is no reason against a step.
"""

from __future__ import annotations

from collections.abc import Collection, Hashable, Sequence
from dataclasses import dataclass

from amp_studio.validate import Finding, Interim, NewValue

_TRIES_A_VALUE = 4
_TRIES = 4_000
"""States that all searches together may try; the steps that are left then come in the order in which they
are given. A thousand values that cannot be ordered would be tried a million times else.
"""
_CHECKS_A_TRY = 100
"""Checks that are asked in 0.2 to 0.6 ms. A value that decides about others has thousands: it counts as so
many states.
"""


@dataclass
class _Budget:
    """How many states may be tried yet."""

    left: int


def safe_order(start: Interim, steps: Sequence[NewValue], allowed: Collection[Hashable]) -> list[NewValue]:
    """Return the steps in a safe order, as near as may be to the one in which they are given.

    ``start`` is as it was afterwards. ``allowed`` are the keys of what is broken when all are made.
    """
    place = {step: n for n, step in enumerate(steps)}
    budget = _Budget(_TRIES + _TRIES_A_VALUE * len(steps))
    queues = [_ordered(start, group, allowed, budget) for group in _groups(start, steps)]
    values: list[NewValue] = []
    while queues:
        # Groups do not matter to each other, so they are merged as near to the given order as their own
        # allows.
        first = min(queues, key=lambda queue: place[queue[0]])
        values.append(first.pop(0))
        queues = [queue for queue in queues if queue]
    return values


def bad(
    found: dict[Hashable, Finding], allowed: Collection[Hashable], severities: Collection[str]
) -> list[Finding]:
    """Return those of the new findings that count against a step."""
    return [f for key, f in found.items() if key not in allowed and f.severity in severities]


def _groups(start: Interim, steps: Sequence[NewValue]) -> list[list[NewValue]]:
    """Return the steps in groups that no check connects, each in the order given."""
    first_of: dict[Hashable, int] = {}
    leader = list(range(len(steps)))

    def led(n: int) -> int:
        while leader[n] != n:
            # Union-find with halved paths: checks connect thousands of values in about linear time.
            leader[n] = n = leader[leader[n]]
        return n

    for n, step in enumerate(steps):
        for check in start.checks_of(step.address):
            leader[led(n)] = led(first_of.setdefault(check, n))
    groups: dict[int, list[NewValue]] = {}
    for n, step in enumerate(steps):
        groups.setdefault(led(n), []).append(step)
    return list(groups.values())


def _effort(start: Interim, step: NewValue) -> int:
    """Return as how many states one in which this step is tried counts."""
    return 1 + start.effort(step.address) // _CHECKS_A_TRY


def _ordered(
    start: Interim, steps: list[NewValue], allowed: Collection[Hashable], budget: _Budget
) -> list[NewValue]:
    """Return the steps of one group in the best order that is found within the budget."""
    if len(steps) == 1:
        return steps
    for severities in (("error", "warning"), ("error",)):
        if (found := _without_new(start, steps, allowed, severities, budget)) is not None:
            return found
    return _least_bad(start, steps, allowed, budget)


def _without_new(
    start: Interim,
    steps: list[NewValue],
    allowed: Collection[Hashable],
    severities: Collection[str],
    budget: _Budget,
) -> list[NewValue] | None:
    """Search, depth first, an order in which no step brings anything new;
    None where there is none or it takes more than half of the budget.
    """
    before = {step: NewValue(step.address, start.file.get(step.address)) for step in steps}
    efforts = [_effort(start, step) for step in steps]
    # Which steps are done is a bit pattern. What comes of them does not depend on their order: a pattern from
    # which nothing went on is impossible however it is reached, and is not tried again.
    everything = (1 << len(steps)) - 1
    done, path, nexts, impossible = 0, list[int](), [0], set[int]()
    # Half of what is left for each search, so that the later, weaker ones still have some.
    tries = most = budget.left // 2
    while done != everything and nexts and tries > 0:
        at = nexts[-1]
        if at == len(steps):  # nothing goes on from here
            impossible.add(done)
            nexts.pop()
            if path:
                last = path.pop()
                start.set(before[steps[last]])
                done &= ~(1 << last)
            continue
        nexts[-1] = at + 1
        if done >> at & 1 or done | 1 << at in impossible:
            continue
        tries -= efforts[at]
        if bad(start.set(steps[at]), allowed, severities):
            start.set(before[steps[at]])
            continue
        done |= 1 << at
        path.append(at)
        nexts.append(0)
    budget.left -= most - tries
    for at in reversed(path):
        start.set(before[steps[at]])
    return [steps[at] for at in path] if done == everything else None


def _least_bad(
    start: Interim, steps: list[NewValue], allowed: Collection[Hashable], budget: _Budget
) -> list[NewValue]:
    """Return an order in which each step brings as few new errors, then warnings, as any at that moment;
    without a budget the next one given is taken.
    """
    before = {step: NewValue(step.address, start.file.get(step.address)) for step in steps}
    left, path = list(steps), list[NewValue]()
    while left:
        # More than any step can cost, so that the first one tried is taken.
        best, least = left[0], (len(steps) ** 3, 0)
        for step in left if budget.left > 0 else ():
            budget.left -= _effort(start, step)
            new = start.set(step)
            cost = len(bad(new, allowed, ("error",))), len(bad(new, allowed, ("warning",)))
            start.set(before[step])
            if cost < least:
                best, least = step, cost
            if cost == (0, 0):
                break
        start.set(best)
        left.remove(best)
        path.append(best)
    # The state is left as it was found: the next group is searched from it.
    for step in reversed(path):
        start.set(before[step])
    return path
