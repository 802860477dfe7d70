"""Findings: range, choice, state and cross-parameter rules, each with its page and its suggested fix.

What calculates, explains, makes fixes and reads a builder's rules is loaded when it is first asked for:
most files are only checked.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .arguments import finite, not_negative, percent_of, positive, whole
    from .beside import axes_by_letter, earlier_beside, rules_beside, validator_of
    from .builder_rules import NO_RULES, BuilderRules, Suppressed
    from .calculator import Argument, Calculator, calculate, calculators, shown_result
    from .cell_expression import Entered, enter, read_plain
    from .companions import RULES_FILE, companion_names, companions_of, machines_of
    from .explanation import Explanation, SeenValue, explain, rule_title
    from .finding import NOT_SET, SEVERITIES, AddressedValue, Finding, addresses_not_set, family_of_rule
    from .findings_between import new_findings
    from .fixes import Fixed, apply_all_safe, apply_fixes
    from .functions import formulas, rule_functions
    from .interim import Interim, NewValue
    from .kept_validators import KeptValidators
    from .plausible.earlier import Earlier
    from .result_check import ResultCheck
    from .rule_file import GENERAL_RULES, read_builder_rules, suppress
    from .validator import Validator
else:
    __getattr__ = front_page(__name__)
