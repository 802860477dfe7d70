"""What one parameter has on all axes: one and the same choice, or connectors one after another."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

from amp_studio.files import ParameterFile, are_alike
from amp_studio.validate.finding import Finding

from .active_value import ActiveValue, ActiveValues, sentence

UNIFORM, COUNTED = "plausible.uniform", "plausible.counted"
_UNIFORM_REASON = "ours, not the manual's: the axes of one machine that move alike have this alike as a rule"
_COUNTED_REASON = "ours, not the manual's: connectors are given out to the axes one after another as a rule"
_SPARE = 3
"""Connectors that are there for spindles and handwheels beside those of the axes."""


class AxisColumns:
    """What the facts of a family compare among all axes of one file, one parameter at a time."""

    def __init__(self, file: ParameterFile, values: ActiveValues) -> None:
        self._file, self._values = file, values

    def checks(self) -> Iterator[tuple[tuple[str, ...], Callable[[], list[Finding]]]]:
        """Yield the parameter that a check reads, and the check."""
        for name in self._file.schema.plausible.uniform:
            yield (name,), partial(self._uniform, name)
        for name in self._file.schema.plausible.counted:
            yield (name,), partial(self._counted, name)

    def _uniform(self, name: str) -> list[Finding]:
        """Find the one of three and more axes that is not as all others that move alike."""
        seen = self._values[name]
        for odd in seen.values():
            axis = odd.address[1]
            others = [one for i, one in seen.items() if i != axis and are_alike(self._file, i, axis)]
            if (
                len(others) > 1
                and len({one.number for one in others}) == 1
                and others[0].number != odd.number
            ):
                text = f"{sentence(self._file, odd)}, and {sentence(self._file, others[0])}"
                return [self._finding(UNIFORM, _UNIFORM_REASON, odd, f"{text} as on all others like it")]
        return []

    def _counted(self, name: str) -> list[Finding]:
        """Find the axis that has no number, or one far beyond the others."""
        numbers = list(self._values[name].values())
        used = [one.number for one in numbers if isinstance(one.number, float) and one.number]
        # 0 is an axis without a connector; all others have their place in the order of the axes.
        is_in_order = len(used) > 1 and all(one.number in (0.0, n) for n, one in enumerate(numbers, 1))
        for place, one in enumerate(numbers, 1):
            if not isinstance(one.number, float):
                continue
            if one.number > len(used) + _SPARE or (is_in_order and one.number == 0.0 and place < max(used)):
                text = f"{sentence(self._file, one)}, and the others have theirs one after another"
                return [self._finding(COUNTED, _COUNTED_REASON, one, text)]
        return []

    def _finding(self, rule: str, reason: str, one: ActiveValue, text: str) -> Finding:
        return Finding(rule, "advice", (one.address,), f"{text}. Is it meant?", reason=reason)
