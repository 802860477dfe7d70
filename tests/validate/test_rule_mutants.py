"""The table of cases is sharp: a rule that is changed in one place no longer gives what the table says."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass

import pytest

from amp_studio.files import ParameterFile
from amp_studio.schema import Rule, load_schema
from amp_studio.validate.plan import checks_of
from amp_studio.validate.rules import RuleChecks

FULL = os.environ.get("AMP_STUDIO_FULL") == "1"
"""Every mutant; without it every fourth of a rule's, and always the first."""

FLIPS = {
    "<": ("<=", ">="),
    "<=": ("<", ">"),
    ">": (">=", "<="),
    ">=": (">", "<"),
    "==": ("!=",),
    "!=": ("==",),
    "&&": ("||",),
    "||": ("&&",),
}
_PLACE = re.compile(r"'[^']*'|<=|>=|==|!=|&&|\|\||<|>|(?<![\w.\[])\d+\.\d+|(?<![\w.\[])\d+(?![\w.,\]])")


@dataclass(frozen=True)
class Mutant:
    """A rule with one change."""

    rule: Rule
    change: str


def mutants(rule: Rule) -> Iterator[Mutant]:
    """Yield a rule with its check negated, then with each comparison flipped, and with "and" for "or"."""
    yield Mutant(rule.model_copy(update={"check": f"!({rule.check})"}), "check negated")
    for place in ("check", "when"):
        text = getattr(rule, place)
        for found in _PLACE.finditer(text):
            for instead in FLIPS.get(found[0], ()) or _other(found[0]):
                changed = text[: found.start()] + instead + text[found.end() :]
                around = f"{text[max(found.start() - 30, 0) : found.start()]}[{found[0]} → {instead}]{text[found.end() : found.end() + 25]}"
                yield Mutant(rule.model_copy(update={place: changed}), f"{place}: {around}")


def _other(literal: str) -> tuple[str, ...]:
    """Return what to put in the place of a choice or a number."""
    if literal.startswith("'"):
        return ("'other'",)
    return (repr(float(literal) + 1) if "." in literal else str(int(literal) + 1),)


def count(file: ParameterFile, rule: Rule) -> int:
    """Return how many findings a rule gives."""
    checks = RuleChecks(file, file.machine)
    return sum(checks.finding(check) is not None for check in checks_of(file.situation, (rule,)))
