"""By which words the values of a family are known: parameter id and instance, written
``home.calibration@1``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache

from amp_studio.errors import AmpStudioError

Address = tuple[str, str]
"""Parameter id and instance; the instance of a global parameter is ``""``."""


class UnknownParameterError(AmpStudioError, KeyError):
    """A number or an id that the family does not have; the text is one clear sentence.

    ``nearest`` is asked for the names that come near only when the text is read: many are never shown.
    """

    def __init__(self, text: str, nearest: Callable[[], Sequence[str]] = tuple) -> None:
        super().__init__(text)
        self._nearest = nearest

    def __str__(self) -> str:
        near = ", ".join(self._nearest())
        return f"{self.args[0]}. Did you mean: {near}" if near else str(self.args[0])


@cache
def whole_of(instance: str) -> str:
    """Return the instance that another one is a part of: ``1`` for ``1.3``, itself for a whole one."""
    return instance.partition(".")[0]


def part_of(instance: str) -> float | None:
    """Return which part of its whole an instance is: 3.0 for ``1.3``; None for a whole one."""
    part = instance.partition(".")[2]
    return float(part) if part.isdecimal() else None


def written(address: Address) -> str:
    """Write an address the way files do: ``home.calibration@1``, a global one without the ``@``."""
    return f"{address[0]}@{address[1]}" if address[1] else address[0]


def read_address(text: str) -> Address:
    """Read ``id@instance``."""
    parameter_id, _, instance = text.partition("@")
    return parameter_id, instance
