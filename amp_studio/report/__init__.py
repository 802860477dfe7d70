"""Printed documentation, and parameters and findings as text and JSON.

``print_report`` prints a parameter file in the format of the file's ending (``FORMATS``), in one of
four orders (``SORTS``); ``build_report`` returns the same as plain data.

What is named here is loaded when it is first asked for: most verbs print findings, and no report.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .axes import place_of
    from .chapters import (
        CheckDrawing,
        CheckedFigure,
        CheckedMotion,
        Danger,
        ExchangeLine,
        PrintedProgram,
        PrintedTest,
        ProgramLimit,
        TunedFigure,
        TunedGain,
        TuningLine,
    )
    from .contents import CHAPTERS, PAPER_SIZES, SORTS, UNIT_CHOICES, Contents, contents_of
    from .dangers import dangers_of_change
    from .findings.alike import alike, same_finding_text
    from .findings.by_rule import FindingGroup, finding_axes, finding_groups, fix_lines, fix_text
    from .findings.lines import finding_json, finding_parts, finding_text, suppressed_text
    from .language import Language, language_of
    from .model import Additions, PrintedFigure
    from .output.pdf import PrintedPlace, SetReport, typeset
    from .papers.check_list import OpenValue, build_check_list, open_value, write_check_list
    from .papers.differences import (
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
    from .papers.form import form_paper
    from .papers.merge import merge_paper
    from .papers.migration import write_migration_folder
    from .papers.migration_lines import migration_lines
    from .papers.paper import Paper, PaperTable, check_paper_ending, results_paper, write_paper
    from .papers.sheet import PrintedSheet, text_lines, write_sheet
    from .parameter.describe import definition
    from .parameter.manual_page import GRADES, facts, help_parts, one_line, page_of, takes_effect
    from .parameter.printed_table import cells_of, table_lines, tables_of
    from .parameter.why import why_parts, why_text
    from .process import ReportNotMadeError, run_apart
    from .templating.starting import write_starting_template
    from .templating.templates import OWN
    from .wording import counted, delivered_text, severity_name, state_name
    from .write import print_report, set_report
else:
    __getattr__ = front_page(__name__)
