"""Runs the kernel as machine code or as plain Python, whichever is faster; the results are equal.

Loading numba and the cached machine code takes longer than a short move takes in plain Python, so a single
call from the command line does not use it; a program that stays open and a long move do.
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
"""Rows that plain Python computes in about the time of loading numba and its cache (docs/simulation.md)."""

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
    """Return ``kernel.run_move`` as machine code; the first call on a machine compiles it and stores the
    result.

    The signature is explicit, so it is compiled once; ``fastmath`` is off, so that
    sums are computed in the written order. Raises ImportError if numba is not installed.
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

    ``auto`` uses machine code if it is already loaded or the move is long, else plain Python. Setting
    NUMBA_DISABLE_JIT=1 in the environment always uses plain Python.
    """
    if os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0"):
        return kernel.run_move
    loaded = compiled_run_move.cache_info().currsize > 0
    if engine == "compiled" or (engine == "auto" and (loaded or rows > PLAIN_ROWS)):
        return compiled_run_move()
    return kernel.run_move
