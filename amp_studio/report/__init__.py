"""Printed documentation, and parameters and findings as text and JSON.

``print_report`` prints a parameter file in the format of the file's ending (``FORMATS``), in one of
four orders (``SORTS``); ``build_report`` returns the same as plain data.

What is named here is loaded when it is first asked for: most verbs print findings, and no report.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .apart import run_apart
    from .by_rule import FindingGroup, finding_axes, finding_groups, fix_lines, fix_text
    from .check_list import OpenValue, build_check_list, open_value, write_check_list
    from .contents import CHAPTERS, PAPER_SIZES, SORTS, UNIT_CHOICES, Chapter, Contents
    from .dangers import dangers_of_change
    from .describe import definition
    from .differences import (
        SIDE_BY_SIDE,
        MachineLine,
        alike_of,
        differences_paper,
        groups_by_value,
        machine_groups,
        machine_lines,
        machine_names,
        machine_rows,
        machines_paper,
    )
    from .finding_lines import finding_json, finding_parts, finding_text, suppressed_text
    from .findings import alike, same_finding_text
    from .form import form_paper
    from .language import language_codes, language_of
    from .manual_page import GRADES, facts, help_parts, one_line, page_of
    from .model import Danger, ExchangeLine, PrintedFigure
    from .paper import Paper, PaperTable, check_paper_ending, results_paper, write_paper
    from .paper_of_merge import merge_paper
    from .pdf import Place, SetReport, typeset
    from .printed_table import cells_of, table_lines, tables_of
    from .sheet import PrintedSheet, text_lines, write_sheet
    from .starting_template import write_starting_template
    from .templating import OWN
    from .why import why_parts, why_text
    from .wording import counted, severity_name, state_name
    from .write import print_report, set_report
else:
    __getattr__ = front_page(__name__)
