"""Printed documentation, and parameters and findings as text and JSON.

``print_report`` prints a parameter file in the format of the file's ending (``FORMATS``), in one of
four orders (``SORTS``); ``build_report`` returns the same as plain data.

What is named here is loaded when it is first asked for: most verbs print findings, and no report.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .apart import ReportNotMadeError, run_apart
    from .build import build_report
    from .by_rule import FindingGroup, finding_axes, finding_groups, fix_lines, fix_text
    from .contents import (
        CHAPTERS,
        PAPER_SIZES,
        SORTS,
        UNIT_CHOICES,
        Chapter,
        Contents,
        PaperSize,
        Sort,
        UnitChoice,
    )
    from .dangers import dangers_of_change
    from .describe import definition
    from .finding_lines import finding_json, finding_parts, finding_text, suppressed_text
    from .findings import alike, same_finding_text
    from .manual_page import GRADES, facts, formula_lines, help_parts, one_line, page_of, range_text
    from .model import ExchangeLine, PrintedFigure, Report
    from .pdf import Place, SetReport
    from .printed_table import cells_of, table_lines, tables_of
    from .why import why_parts, why_text
    from .wording import counted
    from .write import FORMATS, print_report, set_report

_PLACES = {
    "CHAPTERS": "contents",
    "Chapter": "contents",
    "Contents": "contents",
    "GRADES": "manual_page",
    "ExchangeLine": "model",
    "PAPER_SIZES": "contents",
    "PaperSize": "contents",
    "Place": "pdf",
    "PrintedFigure": "model",
    "FORMATS": "write",
    "FindingGroup": "by_rule",
    "finding_axes": "by_rule",
    "finding_groups": "by_rule",
    "fix_lines": "by_rule",
    "fix_text": "by_rule",
    "Report": "model",
    "SORTS": "contents",
    "Sort": "contents",
    "UNIT_CHOICES": "contents",
    "UnitChoice": "contents",
    "alike": "findings",
    "build_report": "build",
    "cells_of": "printed_table",
    "counted": "wording",
    "dangers_of_change": "dangers",
    "definition": "describe",
    "facts": "manual_page",
    "finding_json": "finding_lines",
    "finding_parts": "finding_lines",
    "finding_text": "finding_lines",
    "formula_lines": "manual_page",
    "help_parts": "manual_page",
    "one_line": "manual_page",
    "page_of": "manual_page",
    "range_text": "manual_page",
    "same_finding_text": "findings",
    "suppressed_text": "finding_lines",
    "table_lines": "printed_table",
    "tables_of": "printed_table",
    "why_parts": "why",
    "why_text": "why",
    "SetReport": "pdf",
    "set_report": "write",
    "print_report": "write",
    "ReportNotMadeError": "apart",
    "run_apart": "apart",
}
"""Name -> its module."""


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__} has no attribute {name}")
    found = globals()[name] = getattr(import_module(f".{_PLACES[name]}", __name__), name)
    return found


__all__ = [
    "CHAPTERS",
    "FORMATS",
    "GRADES",
    "PAPER_SIZES",
    "SORTS",
    "UNIT_CHOICES",
    "Chapter",
    "Contents",
    "ExchangeLine",
    "FindingGroup",
    "PaperSize",
    "Place",
    "PrintedFigure",
    "Report",
    "ReportNotMadeError",
    "SetReport",
    "Sort",
    "UnitChoice",
    "alike",
    "build_report",
    "cells_of",
    "counted",
    "dangers_of_change",
    "definition",
    "facts",
    "finding_axes",
    "finding_groups",
    "finding_json",
    "finding_parts",
    "finding_text",
    "fix_lines",
    "fix_text",
    "formula_lines",
    "help_parts",
    "one_line",
    "page_of",
    "print_report",
    "range_text",
    "run_apart",
    "same_finding_text",
    "set_report",
    "suppressed_text",
    "table_lines",
    "tables_of",
    "why_parts",
    "why_text",
]
