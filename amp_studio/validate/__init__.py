"""Findings: range, choice, state and cross-parameter rules, each with its page and its suggested fix.

What calculates, explains, makes fixes and reads a builder's rules is loaded when it is first asked for: most files are only checked.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from .beside import axes_by_letter, companions_of, earlier_beside, rules_beside
from .builder_rules import NO_RULES, RULES_FILE, BuilderRules, Suppressed
from .expressions import RuleError
from .finding import NOT_SET, SEVERITIES, Finding, Setting, not_set
from .formulas import formulas
from .plausible import Earlier
from .validator import Validator

if TYPE_CHECKING:
    from .calculator import Argument, Calculator, calculate, calculators, shown_result
    from .explanation import Explanation, SeenValue, explain, rule_title
    from .fixes import Fixed, apply_all_safe, apply_fixes
    from .rule_file import GENERAL_RULES, read_builder_rules, suppress

_PLACES = {
    "GENERAL_RULES": "rule_file",
    "Argument": "calculator",
    "Calculator": "calculator",
    "Explanation": "explanation",
    "Fixed": "fixes",
    "SeenValue": "explanation",
    "apply_all_safe": "fixes",
    "apply_fixes": "fixes",
    "calculate": "calculator",
    "calculators": "calculator",
    "explain": "explanation",
    "read_builder_rules": "rule_file",
    "rule_title": "explanation",
    "shown_result": "calculator",
    "suppress": "rule_file",
}
"""Name -> its module."""


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__} has no attribute {name}")
    found = globals()[name] = getattr(import_module(f".{_PLACES[name]}", __name__), name)
    return found


__all__ = [
    "GENERAL_RULES",
    "NOT_SET",
    "NO_RULES",
    "RULES_FILE",
    "SEVERITIES",
    "Argument",
    "BuilderRules",
    "Calculator",
    "Earlier",
    "Explanation",
    "Finding",
    "Fixed",
    "RuleError",
    "SeenValue",
    "Setting",
    "Suppressed",
    "Validator",
    "apply_all_safe",
    "apply_fixes",
    "axes_by_letter",
    "calculate",
    "calculators",
    "companions_of",
    "earlier_beside",
    "explain",
    "formulas",
    "not_set",
    "read_builder_rules",
    "rule_title",
    "rules_beside",
    "shown_result",
    "suppress",
]
