"""Functions offered to rules: arithmetic that CEL lacks, and those of each family's own module."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from importlib import import_module
from typing import Any

from amp_studio.schema.cel_engine import WORD_FUNCTIONS

# Families with formulas of their own, and the package of this room that holds them.
FAMILY_MODULES = {
    "9pc": "ninepc",
    "57c422b": "servo57c422b",
    "acromill": "acromill",
    "num": "num",
    "syntec": "syntec",
}


def _mod(a: float, b: float) -> float:
    return math.fmod(a, b) if b else math.nan


def _floor(a: float) -> float:
    return float(math.floor(a))


def _ceil(a: float) -> float:
    return float(math.ceil(a))


def _min(a: float, b: float) -> float:
    return min(a, b)


def _max(a: float, b: float) -> float:
    return max(a, b)


def _round(a: float, digits: float) -> float:
    return round(a, int(digits))


GENERAL: dict[str, Callable[..., Any]] = {
    "mod": _mod,
    "floor": _floor,
    "ceil": _ceil,
    "abs": abs,
    "round": _round,
    "min": _min,
    "max": _max,
    **WORD_FUNCTIONS,
}


@cache
def formulas(family: str) -> dict[str, Callable[..., Any]]:
    """Return name -> function of a family's published formulas."""
    if family not in FAMILY_MODULES:
        return {}
    module = import_module(f"amp_studio.validate.{FAMILY_MODULES[family]}")
    return {name: getattr(module, name) for name in module.__all__ if name.islower()}


def rule_functions(family: str) -> dict[str, Callable[..., Any]]:
    """Return every function a rule of the family may call."""
    return GENERAL | formulas(family)
