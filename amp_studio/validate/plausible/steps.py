"""A table of the steps of one motion: whether it comes back to where it began, or turns back once.

A motion that runs again and again and ends a little beside its beginning drifts by as much each time; one
that goes one way, but for a single step, has the sign of that step wrong.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import accumulate

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Value, show_value
from amp_studio.validate.finding import Finding

NOT_CLOSED, TURN_BACK, STROKE = "plausible.not-closed", "plausible.turn-back", "plausible.stroke"
_STROKE_REASON = (
    "ours, not the manual's: the axis stops at the end of its travel before the motion is through"
)
REASON = (
    "ours, not the manual's: a motion that runs again and again comes back to where it began, or goes one way"
    " only"
)
_MIN_STEPS = 8
"""Steps of a table from which its course is known."""
_NEARLY = 0.25
"""The part of the way that may be missing at its end in a motion that was meant to come back."""


class _Motion:
    """The steps of one table: sums and places of those forward and backward."""

    def __init__(self, steps: dict[Address, float]) -> None:
        self.steps = steps
        self.forward = sum(step for step in steps.values() if step > 0)
        self.backward = -sum(step for step in steps.values() if step < 0)
        self.behind = {address for address, step in steps.items() if step < 0}
        self.ahead = {address for address, step in steps.items() if step > 0}

    def change(self, address: Address, step: float) -> None:
        """Take another step."""
        old = self.steps[address]
        self.steps[address] = step
        # Kept as sums, so that an edit of one step in 3,830 costs the same as in ten.
        self.forward += max(step, 0.0) - max(old, 0.0)
        self.backward += max(-step, 0.0) - max(-old, 0.0)
        for places, belongs in ((self.ahead, step > 0), (self.behind, step < 0)):
            (places.add if belongs else places.discard)(address)

    @property
    def stroke(self) -> float:
        """How far the places that the steps lead to are apart."""
        places = [0.0, *accumulate(self.steps.values())]
        return max(places) - min(places)


class StepTables:
    """The tables of steps of one file, as the facts of its family name them."""

    def __init__(self, file: ParameterFile) -> None:
        self._file, self._names = file, frozenset(file.schema.plausible.steps)
        self._travels = {name: span for span in file.schema.plausible.within for name in span.strokes}
        self._ends = frozenset(end for span in self._travels.values() for end in (span.low, span.high))
        self._motions: dict[Address, _Motion] = {}
        """Parameter and axis -> its motion."""

    def check_all(self) -> None:
        """Look at every table."""
        self._motions.clear()
        points = {address for address in self._file.values if address[0] in self._names}
        if not points:
            return
        parts: dict[Address, dict[Address, float]] = {}
        for address in self._file.addresses():
            if address in points and (step := self._step(address)) is not None:
                parts.setdefault(_whole(address), {})[address] = step
        self._motions = {whole: _Motion(steps) for whole, steps in parts.items()}

    def recheck(self, address: Address) -> bool:
        """Look at one step again; returns whether anything is otherwise."""
        if address[0] not in self._names:
            return address[0] in self._ends
        step, motion = self._step(address), self._motions.get(_whole(address))
        if step is None or motion is None or address not in motion.steps:
            self.check_all()
        else:
            motion.change(address, step)
        return True

    def _step(self, address: Address) -> float | None:
        value = self._file.values.get(address)
        if value is None or isinstance(value.value, (bool, str)):
            return None
        return float(value.value) if self._file.evaluation.state(address).is_active else None

    def findings(self) -> Iterator[Finding]:
        """Yield each motion that nearly comes back, and each single step back."""
        for whole, motion in self._motions.items():
            if len(motion.steps) < _MIN_STEPS:
                continue
            if whole[0] in self._travels:
                yield from self._too_long(whole, motion)
            fewer = min(motion.ahead, motion.behind, key=len)
            most = max(motion.forward, motion.backward)
            drift = motion.forward - motion.backward
            # The single step back is asked about first: with it mended the motion is another one.
            if len(fewer) == 1 and len(motion.ahead) + len(motion.behind) >= _MIN_STEPS:
                yield self._turning_back(next(iter(fewer)))
            # Below is the rounding of the sums; above, the motion does not nearly come back.
            elif fewer and 1e-9 * most < abs(drift) <= _NEARLY * most:
                yield self._not_closed(whole, motion, drift)

    def _too_long(self, whole: Address, motion: _Motion) -> Iterator[Finding]:
        """Yield that a motion is longer than the travel of its axis."""
        span, file = self._travels[whole[0]], self._file
        ends = (span.low, whole[1]), (span.high, whole[1])
        values = [file.values[a] for a in ends if a in file.values and file.evaluation.state(a).is_active]
        first = next(iter(motion.steps))
        numbers = [v.value for v in (*values, file.values[first]) if isinstance(v.value, int | float)]
        # Steps in counts and ends in mm cannot be compared without the figures of the axis.
        if len({value.unit for value in (*values, file.values[first])}) != 1 or len(numbers) != 3:
            return
        travel = numbers[1] - numbers[0]
        # The sums of one direction bound the stroke, and cost nothing: a cam may have 3,830 steps.
        if 0 < travel < max(motion.forward, motion.backward) and motion.stroke > travel:
            parameters = file.schema.parameters
            stroke, low, high = (
                show_value(parameters[name], value)
                for name, value in zip(
                    (whole[0], span.low, span.high),
                    (Value(round(motion.stroke), values[0].unit), *values),
                    strict=True,
                )
            )
            label = file.schema.on(file.machine).label(first)
            message = (
                f"{label}: the steps from here on move the axis by {stroke}, and its travel is from {low} to"
                f" {high}. Is it meant?"
            )
            yield Finding(STROKE, "advice", (first,), message, compared=ends, reason=_STROKE_REASON)

    def _turning_back(self, address: Address) -> Finding:
        schema = self._file.schema
        text = show_value(schema.parameters[address[0]], self._file.values[address])
        message = (
            f"{schema.on(self._file.machine).label(address)} is {text}: the only step of its table in that"
            " direction. Is it meant?"
        )
        return Finding(TURN_BACK, "advice", (address,), message, reason=REASON)

    def _not_closed(self, whole: Address, motion: _Motion, drift: float) -> Finding:
        """Return the finding about a motion that ends beside where it began."""
        parameter = self._file.schema.parameters[whole[0]]
        first, last = next(iter(motion.steps)), next(reversed(motion.steps))
        unit = self._file.values[last].unit
        beside = show_value(parameter, Value(round(drift) if drift.is_integer() else drift, unit))
        label = self._file.schema.on(self._file.machine).label(last)
        message = (
            f"{label}: the steps up to here lead to {beside} beside where they began; run again and again,"
            " the axis drifts by as much each time. Is it meant?"
        )
        return Finding(NOT_CLOSED, "advice", (last,), message, compared=(first,), reason=REASON)


def _whole(address: Address) -> Address:
    return address[0], address[1].rpartition(".")[0]
