"""Printed documentation, and parameters and findings in words.

``write_report`` prints a parameter file as PDF, HTML, CSV or text, in one of
the documenter's three orders; ``build_report`` gives the same as plain data.
"""

from .build import build_report
from .describe import definition, finding_json, finding_text
from .manual_page import facts, help_parts, one_line, page_of, range_text
from .model import SORTS, Report, Sort
from .write import FORMATS, write_report

__all__ = [
    "FORMATS",
    "SORTS",
    "Report",
    "Sort",
    "build_report",
    "definition",
    "facts",
    "finding_json",
    "finding_text",
    "help_parts",
    "one_line",
    "page_of",
    "range_text",
    "write_report",
]
