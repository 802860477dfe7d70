"""Findings: range, choice, state and cross-parameter rules, each with its page and its suggested fix."""

from .builder_rules import (
    NO_RULES,
    RULES_FILE,
    BuilderRules,
    Suppressed,
    read_builder_rules,
    rules_beside,
    suppress,
)
from .calculators import Argument, Calculator, calculate, calculators, shown_result
from .explanation import Explanation, Seen, explain
from .expressions import RuleError
from .finding import SEVERITIES, Finding, Setting
from .fixes import Fixed, apply_all_safe, apply_fixes
from .formulas import formulas
from .validator import Validator

__all__ = [
    "NO_RULES",
    "RULES_FILE",
    "SEVERITIES",
    "Argument",
    "BuilderRules",
    "Calculator",
    "Explanation",
    "Finding",
    "Fixed",
    "RuleError",
    "Seen",
    "Setting",
    "Suppressed",
    "Validator",
    "apply_all_safe",
    "apply_fixes",
    "calculate",
    "calculators",
    "explain",
    "formulas",
    "read_builder_rules",
    "rules_beside",
    "shown_result",
    "suppress",
]
