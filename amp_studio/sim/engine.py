"""Runs the kernel as machine code or as plain Python, whichever is done sooner; the answer is the same.

Loading numba and the cached machine code takes longer than a short move takes in plain Python, so a single
call from the command line does without it, and a program that stays open (or a long move) uses it.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import lru_cache
from typing import Literal, cast

import numpy as np
import numpy.typing as npt

from . import kernel

Engine = Literal["auto", "plain", "compiled"]
RunMove = Callable[[kernel.Loop, kernel.Profile, int, npt.NDArray[np.float64]], int]

PLAIN_ROWS = 60_000
"""Rows plain Python fills in about the time that loading numba and its cache takes (docs/simulation.md)."""

_PARTS = (
    kernel.velocity_asked,
    kernel.measured,
    kernel.wanted_torque,
    kernel.limited_torque,
    kernel.rates,
    kernel.advance,
    kernel.linear_step,
    kernel.next_command,
)


@lru_cache(maxsize=1)
def compiled_run_move() -> RunMove:
    """Return ``kernel.run_move`` as machine code; the first call on a machine compiles it and keeps the
    result.

    The signature is explicit, so there is one compilation and none later; ``fastmath`` stays off, so that
    sums are formed in the order they are written in. Raises ImportError where numba is not installed.
    """
    import numba
    from numba.extending import register_jitable

    for part in _PARTS:
        register_jitable(part)
    floats = [
        numba.types.NamedUniTuple(numba.float64, len(record._fields), record)  # type: ignore[no-untyped-call]  # numba's types have none
        for record in (kernel.Loop, kernel.Profile)
    ]
    signature = numba.int64(*floats, numba.int64, numba.float64[:, ::1])
    return cast(RunMove, numba.njit(signature, cache=True, fastmath=False)(kernel.run_move))


def run_move_by(engine: Engine, rows: int) -> RunMove:
    """Return the function that runs a move of about ``rows`` rows.

    ``auto`` takes machine code when it is already loaded or the move is long, else plain Python. Setting
    NUMBA_DISABLE_JIT=1 in the environment makes everything plain.
    """
    if os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0"):
        return kernel.run_move
    loaded = compiled_run_move.cache_info().currsize > 0
    if engine == "compiled" or (engine == "auto" and (loaded or rows > PLAIN_ROWS)):
        return compiled_run_move()
    return kernel.run_move
