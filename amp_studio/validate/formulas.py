"""Functions offered to rules: arithmetic that CEL lacks, and those of each family's own module."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable
from functools import lru_cache
from importlib import import_module
from typing import Any

# Families with formulas of their own, and the module of this room that holds them.
FAMILY_MODULES = {"9pc": "ninepc"}


def _mod(a: float, b: float) -> float:
    return math.fmod(a, b) if b else math.nan


def _min(a: float, b: float) -> float:
    return min(a, b)


def _max(a: float, b: float) -> float:
    return max(a, b)


def _round(a: float, digits: float) -> float:
    return round(a, int(digits))


GENERAL: dict[str, Callable[..., Any]] = {
    "mod": _mod,
    "floor": lambda a: float(math.floor(a)),
    "ceil": lambda a: float(math.ceil(a)),
    "abs": lambda a: abs(a),
    "round": _round,
    "min": _min,
    "max": _max,
}


@lru_cache(maxsize=None)
def formulas(family: str) -> dict[str, Callable[..., Any]]:
    """Return name -> function of a family's published formulas."""
    if family not in FAMILY_MODULES:
        return {}
    module = import_module(f"amp_studio.validate.{FAMILY_MODULES[family]}")
    return {
        name: function
        for name, function in inspect.getmembers(module, inspect.isfunction)
        if function.__module__ == module.__name__ and not name.startswith("_")
    }


def rule_functions(family: str) -> dict[str, Callable[..., Any]]:
    """Return every function a rule of the family may call."""
    return GENERAL | formulas(family)
