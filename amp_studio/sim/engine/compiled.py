"""One kernel for each law: the same source as plain Python or as machine code, with equal results.

numba cannot take the two functions of a law as arguments without a call through a pointer at every sample.
So the functions of kernel and law are copied, with the ones they call in their globals, and the copy of
``run`` has a name with a digest of all their code and constants: by it the machine code is found in later
processes (`machine_code.py`), and never that of a law or a constant that has changed.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Sequence
from functools import lru_cache
from types import CodeType, FunctionType
from typing import Any, cast

from . import kernel
from .arrays import Vector
from .machine_code import NUMBER, ROWS, VECTOR, WHOLE, ArgumentKind, machine_code

Sample = Callable[[Vector, Vector, Vector], None]
"""A sample function of a law: parameters, state, signals."""
Run = Callable[..., int]
"""`kernel.run`."""
FiguresOfRows = Callable[..., None]
"""`batch.measure`."""

PLAIN_STEPS = 30_000
"""Physics steps after which machine code pays. Plain Python computes them in 0.12 s, three times as long as
it takes to load what was kept (docs/simulation/inside.md): for one short move nothing is made."""

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


def compiled(position_sample: Sample, velocity_sample: Sample | None) -> Run | None:
    """Return the kernel of a law as machine code; its vectors are contiguous numpy arrays.

    The first call on a machine compiles it and stores the result. None where there is no machine code.
    """
    return _compiled(position_sample, velocity_sample) if _is_wanted() else None


@lru_cache(maxsize=64)
def _compiled(position_sample: Sample, velocity_sample: Sample | None) -> Run | None:
    own = _own(position_sample, velocity_sample)
    made = code_of(kernel.run, own, (*[VECTOR] * 11, ROWS), result=True)
    if made is not None:
        _loaded.add((position_sample, velocity_sample))
    return made


def compiled_figures(measure: FiguresOfRows) -> FiguresOfRows | None:
    """Return what makes figures of rows (`variations/batch.py`) as machine code, the same for every law;
    None where there is none.
    """
    return _compiled_figures(measure) if _is_wanted() else None


@lru_cache(maxsize=4)
def _compiled_figures(measure: FiguresOfRows) -> FiguresOfRows | None:
    return code_of(measure, {}, (ROWS, WHOLE, WHOLE, VECTOR, NUMBER, NUMBER, VECTOR), result=False)


def code_of(
    entry: Callable[..., Any], own: dict[str, FunctionType], kinds: Sequence[ArgumentKind], *, result: bool
) -> Callable[..., Any] | None:
    """Return a function and all that it calls as machine code, the law's for two of the kernel; None where
    there is none.
    """
    name = _name(entry, own)
    return machine_code(name, kinds, result, lambda: _linked(entry, own, name))


def _linked(
    entry: Callable[..., Any], own: dict[str, FunctionType], name: str
) -> tuple[FunctionType, dict[str, Any]]:
    """Return a function that calls what numba has taken in, under a name, and the options for it."""
    import numba

    jitted: dict[FunctionType, Any] = {}

    def taken_in(function: FunctionType) -> Any:
        if function not in jitted:
            names = {name: taken_in(called) for name, called in _called(function, own).items()}
            # Only machine code calls them: what Python or C would call them by takes a tenth of the time.
            bare: dict[str, Any] = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
            jitted[function] = numba.njit(_copy(function, names), forceinline=True, **bare, **OPTIONS)
        return jitted[function]

    called = {name: taken_in(each) for name, each in _called(entry, own).items()}
    run = _copy(entry, called)
    run.__qualname__ = run.__name__ = name
    return run, OPTIONS


def kernel_name(position_sample: Sample, velocity_sample: Sample | None) -> str:
    """Return the name of the machine code of a law:
    another one as soon as any of its code or constants is another.
    """
    return _name(kernel.run, _own(position_sample, velocity_sample))


def _name(entry: Callable[..., Any], own: dict[str, FunctionType]) -> str:
    # An option changes the machine code as a line of source does.
    described = [repr(OPTIONS), *_described(entry, own, {})]
    return f"{entry.__name__}_{hashlib.sha256(chr(10).join(described).encode()).hexdigest()[:16]}"


def _is_wanted() -> bool:
    """Return whether NUMBA_DISABLE_JIT does not ask for plain Python."""
    return os.environ.get("NUMBA_DISABLE_JIT", "0") in ("", "0")


def pays(position_sample: Sample, velocity_sample: Sample | None, steps: float) -> bool:
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
