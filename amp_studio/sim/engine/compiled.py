"""One kernel for each law: the same source as plain Python or as machine code, with equal results.

numba cannot take the two functions of a law as arguments without a call through a pointer at every sample,
and finds a function that was made in a closure in no process's cache again. So the functions of kernel and
law are copied, with the ones they call in their globals, and the copy of ``run`` has a name with a digest of
all their code and constants: numba's index on disk (file, name, line) then finds the machine code in later
processes, and never that of a law or a constant that has changed.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable
from functools import lru_cache
from types import CodeType, FunctionType
from typing import Any, cast

from . import kernel
from .arrays import Vector

Sample = Callable[[Vector, Vector, Vector], None]
"""A sample function of a law: parameters, state, signals."""
Run = Callable[..., int]
"""`kernel.run`."""
FiguresOfRows = Callable[..., None]
"""`batch.measure`."""

PLAIN_STEPS = 100_000
"""Physics steps that plain Python computes in about the time of loading numba
and its cache (docs/simulation/inside.md)."""

OPTIONS: dict[str, Any] = {"fastmath": False, "error_model": "numpy", "_nrt": False}
"""Sums are computed in the written order; a division does not look whether it is by 0; arrays are not counted
(``_nrt``), as nothing here makes one: counting them at every call took more time than a law."""

_loaded: set[tuple[Sample, Sample | None]] = set()
_plain_steps: dict[tuple[Sample, Sample | None], float] = {}
"""Physics steps of each law that this process has computed as plain Python."""


@lru_cache(maxsize=64)
def plain(position_sample: Sample, velocity_sample: Sample | None) -> Run:
    """Return the kernel of a law as plain Python; its vectors are lists."""
    return cast(Run, _copy(kernel.run, _own(position_sample, velocity_sample)))


@lru_cache(maxsize=64)
def compiled(position_sample: Sample, velocity_sample: Sample | None) -> Run:
    """Return the kernel of a law as machine code; its vectors are contiguous numpy arrays.

    The first call on a machine compiles it and stores the result. Only where `can_compile`.
    """
    import numba

    vector = numba.float64[::1]
    signature = numba.int64(*[vector] * 11, numba.float64[:, ::1])
    made = _machine_code(kernel.run, _own(position_sample, velocity_sample), signature)
    _loaded.add((position_sample, velocity_sample))
    return cast(Run, made)


@lru_cache(maxsize=4)
def compiled_figures(measure: FiguresOfRows) -> FiguresOfRows:
    """Return what makes figures of rows (`variations/batch.py`) as machine code, the same for every law."""
    import numba

    vector, rows = numba.float64[::1], numba.float64[:, ::1]
    signature = numba.void(rows, numba.int64, numba.int64, vector, numba.float64, numba.float64, vector)
    return cast(FiguresOfRows, _machine_code(measure, {}, signature))


def _machine_code(entry: Callable[..., Any], own: dict[str, FunctionType], signature: Any) -> Any:
    """Return a function and all that it calls as machine code, the law's for two of the kernel."""
    import numba

    jitted: dict[FunctionType, Any] = {}

    def machine_code(function: FunctionType) -> Any:
        if function not in jitted:
            names = {name: machine_code(called) for name, called in _called(function, own).items()}
            # Only machine code calls them: what Python or C would call them by takes a tenth of the time.
            bare: dict[str, Any] = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
            jitted[function] = numba.njit(_copy(function, names), forceinline=True, **bare, **OPTIONS)
        return jitted[function]

    called = {name: machine_code(each) for name, each in _called(entry, own).items()}
    run = _copy(entry, called)
    run.__qualname__ = run.__name__ = _name(entry, own)
    try:
        return numba.njit(signature, cache=True, **OPTIONS)(run)
    except RuntimeError:  # no folder can be written in which it would be found again
        return numba.njit(signature, **OPTIONS)(run)


def kernel_name(position_sample: Sample, velocity_sample: Sample | None) -> str:
    """Return the name of the machine code of a law:
    another one as soon as any of its code or constants is another.
    """
    return _name(kernel.run, _own(position_sample, velocity_sample))


def _name(entry: Callable[..., Any], own: dict[str, FunctionType]) -> str:
    # An option changes the machine code as a line of source does.
    described = [repr(OPTIONS), *_described(entry, own, {})]
    return f"{entry.__name__}_{hashlib.sha256(chr(10).join(described).encode()).hexdigest()[:16]}"


def can_compile() -> bool:
    """Return whether there is machine code: the extra ``fast`` is installed,
    and NUMBA_DISABLE_JIT does not ask for plain Python.
    """
    if os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0"):
        return False
    try:
        import numba  # noqa: F401  # whether it can be, with the numpy that is here
    except ImportError:
        return False
    return True


def pays_off(position_sample: Sample, velocity_sample: Sample | None, steps: float) -> bool:
    """Return whether machine code is worth its loading for so many physics steps more,
    after all that this process has computed without it.
    """
    law = position_sample, velocity_sample
    if law in _loaded:
        return True
    # Summed over the process: a thousand short runs are worth the loading as a long one is.
    _plain_steps[law] = _plain_steps.get(law, 0.0) + steps
    return _plain_steps[law] > PLAIN_STEPS


def _own(position_sample: Sample, velocity_sample: Sample | None) -> dict[str, FunctionType]:
    both = {"position_sample": position_sample, "velocity_sample": velocity_sample or kernel.velocity_sample}
    return {name: cast(FunctionType, function) for name, function in both.items()}


def _copy(function: Callable[..., Any], names: dict[str, Any]) -> FunctionType:
    """Return a copy of a function with other globals of these names."""
    source = cast(FunctionType, function)
    copy = FunctionType(
        source.__code__, {**source.__globals__, **names}, source.__name__, source.__defaults__
    )
    copy.__module__, copy.__qualname__ = source.__module__, source.__qualname__
    return copy


def _called(function: Callable[..., Any], own: dict[str, FunctionType]) -> dict[str, FunctionType]:
    """Return the functions that a function calls by their names, the law's for the kernel's two."""
    source = cast(FunctionType, function)
    # co_names are attributes and modules too (math.sqrt): what is left are functions of the globals.
    names = own if source is kernel.run else {}
    found = {name: names.get(name, source.__globals__.get(name)) for name in source.__code__.co_names}
    return {name: each for name, each in found.items() if isinstance(each, FunctionType)}


def _described(
    function: Callable[..., Any], own: dict[str, FunctionType], seen: dict[FunctionType, None]
) -> list[str]:
    """Return what decides about the machine code: code and constants of a function and of all that it
    calls.
    """
    source = cast(FunctionType, function)
    # A function that two others call is described once.
    if source in seen:
        return []
    seen[source] = None
    text = _code(source.__code__)
    called = _called(source, own)
    for name in source.__code__.co_names:
        constant = source.__globals__.get(name)
        # numba freezes the globals it reads: another value needs other machine code.
        if isinstance(constant, (int, float, str, tuple)):
            text.append(f"{name}={constant!r}")
    for name, each in called.items():
        text += [f"{name}()", *_described(each, own, seen)]
    return text


def _code(code: CodeType) -> list[str]:
    # The repr of a code object has its address, which is another one in each process.
    constants = [repr(each) for each in code.co_consts if not isinstance(each, CodeType)]
    return [code.co_code.hex(), *constants, *code.co_names, *code.co_varnames]
