"""Findings: range, choice, state and cross-parameter rules, each with its page and its repair."""

from .expressions import RuleFault
from .finding import SEVERITIES, Finding, Repair
from .formulas import formulas
from .validator import Validator

__all__ = ["SEVERITIES", "Finding", "Repair", "RuleFault", "Validator", "formulas"]
