"""The actions of the window: one table, which menus, keys, tool bar and find box read.

A new action is one row here (of the menu View: in view_table.py) and a function that does it.
Its text needs a translation (``make translations`` names it).
"""

from __future__ import annotations

from functools import partial

from PySide6.QtGui import QKeySequence

from amp_studio.ui.base.translated import tr
from amp_studio.ui.window.action import Action, FilledMenu, Menu

from . import axis, document, filters, guide, pages, project, view
from . import help as help_menu
from .edit import show_redo, show_undo
from .find_box import COMMANDS
from .parts import PartsWindow
from .view_table import view_menu

TOOL_BAR = {
    "file": ("file.new", "file.open", "file.save"),
    "steps": ("edit.undo", "edit.redo"),
    "views": (
        "view.values",
        "view.pictures",
        "view.motion",
        "view.tuning",
        "view.check",
        "view.program",
        "file.compare",
    ),
    "control": ("control.page",),
}
"""What the tool bar has, by its parts."""

_KEY = QKeySequence.StandardKey


def menus() -> tuple[Menu[PartsWindow], ...]:
    """Return the menus of a window, with every action, in the present language."""
    return _file(), _edit(), _axis(), _guide(), view_menu(), _control(), _project(), _help()


def _file() -> Menu[PartsWindow]:
    return Menu(
        "file",
        tr("&File"),
        (
            Action("file.new", tr("&New…"), lambda w: w.files.new(), _KEY.New, "", "file-plus", tr("New")),
            Action(
                "file.open", tr("&Open…"), lambda w: w.files.open(), _KEY.Open, "", "folder-open", tr("Open")
            ),
            FilledMenu(lambda w: w.files.recent.menu),
            Action("file.save", tr("&Save"), lambda w: w.save(), _KEY.Save, "edit", "floppy-disk"),
            Action("file.save_as", tr("Save &As…"), lambda w: w.files.save_as(), "Ctrl+Shift+S"),
            Action("file.close", tr("&Close"), lambda w: w.files.close(), _KEY.Close),
            None,
            Action(
                "file.compare",
                tr("Compare and Merge &With…"),
                lambda w: w.files.comparing.compare(),
                ("Ctrl+Shift+M", "Alt+7"),
                icon="git-diff",
                short=tr("Compare"),
            ),
            Action("file.recover", tr("Recover &Backup…"), lambda w: w.files.recover(), needs="edit"),
            None,
            Action("file.import", tr("&Import…"), lambda w: w.files.formats.read(), needs=""),
            Action("file.export", tr("Ex&port…"), lambda w: w.files.formats.write()),
            Action("file.migrate", tr("Mi&grate to Another Control…"), document.migrate),
            None,
            Action(
                "file.report", tr("&Report…"), document.report, _KEY.Print, icon="printer", short=tr("Report")
            ),
            Action("file.form", tr("&Form to Fill In…"), document.form),
            Action("file.template", tr("New Report &Template…"), document.new_template),
            Action("file.facts", tr("&Machine Facts…"), lambda w: w.files.facts(), needs="edit"),
            None,
            Action("file.exit", tr("E&xit"), lambda w: w.close(), _KEY.Quit, ""),
        ),
    )


def _edit() -> Menu[PartsWindow]:
    return Menu(
        "edit",
        tr("&Edit"),
        (
            Action(
                "edit.undo",
                tr("&Undo"),
                lambda w: w.edits.undo(),
                _KEY.Undo,
                "undo",
                "arrow-u-up-left",
                tr("Undo"),
                follows=show_undo,
            ),
            Action(
                "edit.redo",
                tr("&Redo"),
                lambda w: w.edits.redo(),
                _KEY.Redo,
                "redo",
                "arrow-u-up-right",
                tr("Redo"),
                follows=show_redo,
            ),
            Action("edit.steps", tr("Histor&y of Steps…"), lambda w: w.edits.steps(), "Ctrl+Shift+H"),
            None,
            Action("edit.value", tr("&Edit Value"), lambda w: w.edits.edit(), "F2", "edit", of_a_cell=True),
            *_cells(),
            Action(
                "edit.note",
                tr("N&ote…"),
                lambda w: w.edits.edit_notes(),
                "Alt+Return",
                icon="note-pencil",
                of_a_cell=True,
            ),
            None,
            Action("edit.quick", tr("&Quick Edit by Number…"), lambda w: w.edits.quick_edit(), "F4", "edit"),
            Action("edit.calculator", tr("Ca&lculator…"), lambda w: w.edits.calculator(), "F3"),
            Action("edit.tables", tr("&Tables of the Manual…"), lambda w: w.edits.tables(), "Shift+F3"),
            None,
            Action(
                "edit.fix",
                tr("F&ix Selected Finding"),
                lambda w: w.edits.fix_selected(),
                "F8",
                "edit",
                of_selected=True,
            ),
            Action(
                "edit.fix_several",
                tr("Fix Se&veral…"),
                lambda w: w.edits.fix_several(),
                "Shift+F8",
                "edit",
                "magic-wand",
            ),
            Action("edit.fix_safe", tr("Apply All &Safe Fixes"), lambda w: w.edits.fix_safe(), needs="edit"),
            Action(
                "edit.explain",
                tr("S&how Explanation of Finding"),
                lambda w: w.edits.explain_selected(),
                "Shift+F1",
                of_selected=True,
            ),
            None,
            Action("edit.find", tr("&Find…"), lambda w: w.finder.box.begin(), ("Ctrl+F", "Ctrl+K"), ""),
            Action("edit.go_to", tr("&Go to Number…"), pages.go_to, "Ctrl+G"),
            Action(
                "edit.bookmark",
                tr("Boo&kmark"),
                filters.toggle_bookmark,
                "Ctrl+B",
                icon="bookmark-simple",
                of_selected=True,
            ),
        ),
    )


def _cells() -> tuple[Action[PartsWindow], ...]:
    """Return what is done with the selected cells."""
    own = partial(Action, of_a_cell=True, only_in_table=True)
    return (
        own("edit.copy", tr("&Copy"), lambda w: w.edits.range.copy(), _KEY.Copy),
        own(
            "edit.copy_named",
            tr("Copy with Na&mes"),
            lambda w: w.edits.range.copy_with_names(),
            "Ctrl+Shift+C",
        ),
        own("edit.paste", tr("&Paste…"), lambda w: w.edits.range.paste(), _KEY.Paste, "edit"),
        own("edit.fill_down", tr("Fill &Down"), lambda w: w.edits.range.fill_down(), "Ctrl+D", "edit"),
        own(
            "edit.fill_across",
            tr("Fill &Across Axes"),
            lambda w: w.edits.range.fill_across(),
            "Ctrl+R",
            "edit",
        ),
        own(
            "edit.default",
            tr("&Back to Default"),
            lambda w: w.edits.range.to_default(),
            "Ctrl+Backspace",
            "edit",
        ),
        own(
            "edit.saved",
            tr("Back to What &Was Saved"),
            lambda w: w.edits.range.to_saved(),
            "Ctrl+Shift+Backspace",
            "edit",
        ),
        own("edit.clear", tr("Clear (&Not Set)"), lambda w: w.edits.range.clear(), _KEY.Delete, "edit"),
        Action(
            "edit.all_axes",
            tr("Copy to All A&xes of the Type"),
            lambda w: w.edits.range.to_all_axes(),
            "Ctrl+Shift+A",
            "axes",
            of_a_cell=True,
        ),
    )


def _axis() -> Menu[PartsWindow]:
    return Menu(
        "axis",
        tr("&Axis"),
        (
            Action(
                "axis.name", tr("&Name Axis…"), axis.name, "Ctrl+Shift+N", "edit", why_not=axis.why_no_name
            ),
            Action(
                "axis.type",
                tr("Configure Axis &Type…"),
                axis.configure_type,
                "Ctrl+T",
                "edit",
                why_not=axis.why_no_type,
            ),
            Action(
                "axis.servo",
                tr("Configure &Servo…"),
                axis.configure_servo,
                "Ctrl+Shift+T",
                "edit",
                why_not=axis.why_no_servo,
            ),
            None,
            Action("axis.add", tr("&Add Axis…"), axis.add, needs="edit", why_not=axis.why_full),
            Action("axis.delete", tr("&Delete Axis…"), axis.delete, needs="edit", why_not=axis.why_none_less),
            None,
            Action("axis.copy", tr("&Copy Axis…"), axis.copy, needs="edit", why_not=axis.why_no_other),
            Action("axis.swap", tr("S&wap Axes…"), axis.swap, needs="edit", why_not=axis.why_no_other),
            Action("axis.compare", tr("Com&pare Axes…"), axis.compare, why_not=axis.why_no_other),
        ),
        shows_tips=True,
    )


def _guide() -> Menu[PartsWindow]:
    return Menu(
        "guide",
        tr("&Guide"),
        (
            Action("guide.next", tr("&Next Not Set"), pages.in_values(guide.go_to_next), "Ctrl+."),
            Action(
                "guide.done",
                tr("Mark Step as &Done"),
                guide.tick_step,
                "Ctrl+Shift+.",
                "edit",
                of_selected=True,
            ),
            Action(
                "guide.defaults",
                tr("Keep De&faults of This Step"),
                guide.keep_defaults,
                needs="edit",
                of_selected=True,
            ),
            None,
            Action(
                "guide.later",
                tr("&Show Later Findings"),
                guide.show_later,
                is_on=lambda w: w.workspace is not None and w.workspace.shows_later,
            ),
            Action("guide.check_list", tr("&Check List…"), guide.save_check_list),
        ),
    )


def _control() -> Menu[PartsWindow]:
    return Menu(
        "control",
        tr("&Control"),
        (
            Action(
                "control.page",
                tr("&At the Control"),
                lambda w: w.control.open(),
                "Alt+0",
                "",
                "cpu",
                tr("Control"),
                follows=lambda w, action: w.control.show_state(action),
            ),
            Action(
                "control.send",
                tr("Sen&d to the Control…"),
                lambda w: w.control.show("send"),
                "F5",
                icon="arrow-line-down",
            ),
            Action(
                "control.compare",
                tr("&Compare With the Control…"),
                lambda w: w.control.show("compare"),
                "F6",
                icon="git-diff",
            ),
            Action(
                "control.read",
                tr("Read &From the Control…"),
                lambda w: w.control.show("read"),
                "F7",
                "",
                "arrow-line-up",
            ),
            Action(
                "control.restore",
                tr("&Restore Control From Backup…"),
                lambda w: w.control.restore(),
                needs="",
            ),
            Action("control.by_hand", tr("Enter Values by &Hand…"), lambda w: w.control.show("hand")),
            None,
            Action("control.several", tr("Se&veral Controls…"), lambda w: w.control.several()),
            Action("control.exchanges", tr("E&xchanges of This File…"), lambda w: w.control.recorded()),
            Action("control.live", tr("&Live"), pages.open_live, "Ctrl+L", icon="broadcast"),
            None,
            Action(
                "control.start",
                tr("&Start Emulated Control"),
                lambda w: w.control.start_emulated(),
                needs="no emulated",
            ),
            Action(
                "control.estop",
                tr("Emulated Control in &E-Stop"),
                lambda w: w.control.switch_estop(),
                needs="emulated estop",
                is_on=lambda _: None,
            ),
            Action(
                "control.stop",
                tr("Sto&p Emulated Control"),
                lambda w: w.control.emulated.stop(),
                needs="emulated",
            ),
        ),
    )


def _project() -> Menu[PartsWindow]:
    return Menu(
        "project",
        tr("&Project"),
        (
            Action("project.new", tr("&New Project…"), project.new, needs=""),
            Action("project.open", tr("&Open Project…"), project.open_project, needs=""),
            Action("project.facts", tr("Project &Information…"), project.change, needs="project"),
            None,
            Action(
                "project.open_file",
                tr("Open &File of the Project…"),
                project.open_file,
                "Ctrl+Shift+O",
                "project",
            ),
            Action("project.check", tr("Chec&k All Files…"), project.check, "Ctrl+Shift+F8", "project"),
            Action("project.compare", tr("Compare &Machines…"), project.compare, needs=""),
            Action("project.copy", tr("&Copy File…"), project.copy, needs="project"),
            Action(
                "project.copy_from", tr("Copy from &Another Project…"), project.copy_from, needs="project"
            ),
            Action("project.rename", tr("&Rename File…"), project.rename, needs="project"),
            Action("project.delete", tr("&Delete File…"), project.delete, needs="project"),
            Action(
                "project.recover", tr("Reco&ver a Deleted or Older File…"), project.recover, needs="project"
            ),
        ),
    )


def _help() -> Menu[PartsWindow]:
    return Menu(
        "help",
        tr("&Help"),
        (
            Action(
                "help.commands", tr("&Commands…"), lambda w: w.finder.box.begin(COMMANDS), "Ctrl+Shift+P", ""
            ),
            Action("help.tutorial", tr("&Tutorial"), help_menu.open_tutorial, needs=""),
            Action("help.manual", tr("&Manual"), help_menu.open_manual, "F1", needs="", icon="book-open"),
            None,
            Action("help.keys", tr("&Keys…"), view.open_keys, needs=""),
            Action("help.log", tr("Open &Log Folder"), help_menu.open_log_folder, needs=""),
            Action("help.report", tr("&Report a Problem…"), help_menu.report_problem, needs=""),
            None,
            Action("help.about", tr("&About AMP Studio"), document.show_about, needs=""),
        ),
    )
