"""Printed documentation, and parameters and findings as text and JSON.

``write_report`` prints a parameter file as PDF, HTML, CSV or text, in one of
one of three orders; ``build_report`` returns the same as plain data.
"""

from .build import build_report
from .describe import definition, finding_json, finding_text, suppressed_text
from .findings import alike, same_finding_text
from .manual_page import facts, formula_lines, help_parts, one_line, page_of, range_text
from .model import SORTS, Report, Sort
from .printed_table import cells_of, table_lines, tables_of
from .why import why_parts, why_text
from .wording import counted
from .write import FORMATS, write_report

__all__ = [
    "FORMATS",
    "SORTS",
    "Report",
    "Sort",
    "alike",
    "build_report",
    "cells_of",
    "counted",
    "definition",
    "facts",
    "finding_json",
    "finding_text",
    "formula_lines",
    "help_parts",
    "one_line",
    "page_of",
    "range_text",
    "same_finding_text",
    "suppressed_text",
    "table_lines",
    "tables_of",
    "why_parts",
    "why_text",
    "write_report",
]
