"""The types of the flat arrays in compiled code."""

from __future__ import annotations

from typing import Protocol


class Vector(Protocol):
    """float64 numbers by index: a numpy array in compiled code,
    a list in plain Python (which is faster there).
    """

    def __getitem__(self, index: int, /) -> float:
        """Return a number."""
        ...

    def __setitem__(self, index: int, value: float, /) -> None:
        """Set a number."""
        ...

    def __len__(self) -> int:
        """Return how many there are."""
        ...
