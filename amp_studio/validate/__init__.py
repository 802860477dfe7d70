"""Findings: range, choice, state and cross-parameter rules, each with its page and its repair."""

from .calculators import Argument, Calculator, calculate, calculators, shown_result
from .expressions import RuleFault
from .finding import SEVERITIES, Finding, Setting
from .formulas import formulas
from .validator import Validator

__all__ = [
    "SEVERITIES",
    "Argument",
    "Calculator",
    "Finding",
    "RuleFault",
    "Setting",
    "Validator",
    "calculate",
    "calculators",
    "formulas",
    "shown_result",
]
