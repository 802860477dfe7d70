"""The CEL engine without its command line.

``import cel`` also imports the package's own command-line program (typer,
prompt_toolkit: 0.2 s of every start), so the compiled module is loaded alone.
"""

from __future__ import annotations

import importlib.util
import logging
import re
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any


def _engine() -> ModuleType:
    """Return the compiled module of the engine, loaded without the package around it where its file is
    found.
    """
    package = importlib.util.find_spec("cel")
    for folder in (package.submodule_search_locations or ()) if package else ():
        for library in sorted(Path(folder).glob("cel.*")):
            if library.suffix in (".so", ".pyd"):
                spec = importlib.util.spec_from_file_location("cel.cel", library)
                if spec and spec.loader:
                    module = importlib.util.module_from_spec(spec)
                    # Under its own name, and before it runs, as an import does it: a later ``import cel``
                    # then finds this one.
                    sys.modules.setdefault("cel.cel", module)
                    spec.loader.exec_module(module)
                    return module
    # Without a library beside the package: the whole of it, slower to load, has the same names.
    return importlib.import_module("cel")


_module = _engine()
Program = Any
compile_expression = _module.compile
Context = _module.Context

_FAULTS = ("AttributeError", "NameError", "UnboundLocalError", "AssertionError", "ImportError")
"""What a function raises that is wrong itself."""


def _reports_a_fault(record: logging.LogRecord) -> bool:
    """Return whether what CEL logs is worth a line.

    It warns of every function that raises. Most only make no sense of their arguments, which ends the
    expression and is all there is to say.
    """
    return record.levelno > logging.WARNING or any(
        f" failed: {fault}" in record.getMessage() for fault in _FAULTS
    )


logging.getLogger("cel").addFilter(_reports_a_fault)

_LANGUAGE_FUNCTIONS = frozenset(
    {
        "size",
        "contains",
        "startsWith",
        "endsWith",
        "matches",
        "int",
        "uint",
        "double",
        "string",
        "bytes",
        "type",
        "dyn",
        "timestamp",
        "duration",
    }
)
"""Functions of the language itself; those of dates are left out, no parameter is one."""


_WIDEST = 64
"""Bits of the widest field: a number of 10^10 bits would take all memory."""


def _bit(word: float | None, n: float) -> bool | None:
    """Return whether a bit of a word is set; null for a word that is not set,
    which ends an expression like any other null.
    """
    return None if word is None else int(word) >> int(n) & 1 == 1


def _field(word: float | None, n: float, width: float) -> float | None:
    """Return the number in the bits of a word that begin at ``n``; null for a word that is not set."""
    if not 0 <= width <= _WIDEST:
        raise ValueError(f"a word has no field of {width} bits")
    return None if word is None else float(int(word) >> int(n) & (1 << int(width)) - 1)


WORD_FUNCTIONS: dict[str, Callable[..., Any]] = {"bit": _bit, "field": _field}
"""What conditions and rules may ask of the bits of a word: CEL has no operators for them."""

_OPERATOR = re.compile(r"[^a-zA-Z]")


def functions_called(compiled: Program) -> frozenset[str]:
    """Return the functions an expression calls that the language itself does not have."""
    named = {name for name in compiled.references()["functions"] if not _OPERATOR.match(name)}
    return frozenset(named - _LANGUAGE_FUNCTIONS)
