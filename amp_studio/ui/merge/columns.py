"""The columns of a merge."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from amp_studio.files import Side

NAME, AXIS, BASE, A, B, RESULT = range(6)
SIDES: dict[int, Side] = {BASE: "base", A: "a", B: "b"}
"""Column -> the source it shows."""
