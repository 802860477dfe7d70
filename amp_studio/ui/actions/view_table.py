"""The rows of the menu View, for the table of actions."""

from __future__ import annotations

from functools import partial

from PySide6.QtGui import QKeySequence

from amp_studio.ui.base.translated import tr
from amp_studio.ui.window.action import Action, ChoiceMenu, FilledMenu, Menu

from . import filters, pages, view
from .parts import PartsWindow

_KEY = QKeySequence.StandardKey


def _to_dock(name: str, window: PartsWindow) -> None:
    window.docks.toggle(name)


def view_menu() -> Menu[PartsWindow]:
    """Return the menu of what is shown, and where."""
    return Menu(
        "view",
        tr("&View"),
        (
            ChoiceMenu(
                "view.units",
                tr("&Units"),
                view.units,
                lambda w: w.workspace_in_front.file.header.units,
                view.set_units,
                "file",
            ),
            ChoiceMenu(
                "view.machine",
                tr("Control &Type"),
                view.machines,
                lambda w: w.workspace_in_front.file.machine,
                view.set_machine,
                "edit",
            ),
            Action(
                "view.switch_units",
                tr("S&witch mm / inch"),
                view.switch_units,
                "Ctrl+M",
                "units",
                "ruler",
                tr("mm / inch"),
            ),
            Action(
                "view.as_entered",
                tr("Show Values &As Entered"),
                view.show_as_entered,
                "Ctrl+E",
                is_on=lambda w: w.workspace.as_entered if w.workspace else None,
            ),
            Action(
                "view.unfitted_axes",
                tr("Show Un&fitted Axes"),
                view.show_columns,
                "Ctrl+U",
                is_on=lambda w: w.table.shows_every_axis if w.table else None,
            ),
            Action(
                "view.hidden",
                tr("Show &Hidden Parameters"),
                view.show_columns,
                "Ctrl+H",
                is_on=lambda w: w.table.hidden_too if w.table else None,
            ),
            Action(
                "view.secrets",
                tr("Show Se&crets"),
                view.show_secrets,
                is_on=lambda w: w.workspace.secrets if w.workspace else None,
                tip=tr("Show passwords in clear text, also in exports"),
                follows=view.show_secrets_where_some_are,
            ),
            None,
            _places(),
            None,
            Action("view.next_file", tr("Ne&xt File"), lambda w: w.tabs.turn(1), "Ctrl+Tab"),
            Action("view.previous_file", tr("Pre&vious File"), lambda w: w.tabs.turn(-1), "Ctrl+Shift+Tab"),
            Action("view.beside", tr("Show File Besi&de"), lambda w: w.tabs.move_across(), "Ctrl+\\"),
            None,
            Action(
                "view.values",
                tr("Va&lues"),
                pages.show_values,
                "Alt+1",
                icon="table",
                short=tr("Values"),
                is_on=lambda w: pages.is_shown(w, "") and not w.page_in_front.middle.covers,
            ),
            Action(
                "view.pictures",
                tr("&Pictures"),
                lambda w: w.pictures.toggle(),
                ("F12", "Alt+2"),
                icon="frame-corners",
                short=tr("Pictures"),
                is_on=lambda w: pages.is_shown(w, "") and w.page_in_front.shows_pictures,
            ),
            Action(
                "view.motion",
                tr("&Motion"),
                pages.open_motion,
                ("F9", "Alt+3"),
                icon="activity",
                short=tr("Motion"),
                is_on=lambda w: pages.is_shown(w, pages.MOTION),
                follows=pages.name_motion,
            ),
            Action(
                "view.tuning",
                tr("Tu&ning"),
                pages.open_tuning,
                ("Shift+F9", "Alt+4"),
                icon="sliders-horizontal",
                short=tr("Tuning"),
                is_on=lambda w: pages.is_shown(w, pages.TUNING),
            ),
            Action(
                "view.check",
                tr("Chec&k in Motion"),
                pages.open_check,
                "Alt+5",
                icon="arrows-left-right",
                short=tr("Machine"),
                is_on=lambda w: pages.is_shown(w, pages.CHECK),
            ),
            Action(
                "view.tests",
                tr("Te&sts at the Machine"),
                pages.open_tests,
                icon="check-square",
                is_on=lambda w: pages.is_shown(w, pages.TESTS),
            ),
            Action(
                "view.program",
                tr("&Blocks and Programs"),
                pages.open_program,
                ("Ctrl+F9", "Alt+6"),
                icon="path",
                short=tr("Program"),
                is_on=lambda w: pages.is_shown(w, pages.PROGRAM),
            ),
            None,
            Action("view.save_picture", tr("Save P&icture As SVG…"), lambda w: w.pictures.save()),
            Action(
                "view.preview",
                tr("Rep&ort Preview"),
                lambda w: w.preview.toggle(),
                "Ctrl+5",
                icon="article",
                short=tr("Preview"),
                is_on=lambda w: w.preview.is_shown,
            ),
            Menu(
                "filter",
                tr("Filte&r"),
                (
                    *(
                        Action(
                            f"filter.{mark}",
                            name,
                            pages.in_values(partial(filters.toggle, mark=mark)),
                            tip=tip,
                        )
                        for mark, name, tip in filters.listed()
                    ),
                    None,
                    Action("filter.none", tr("&All Rows"), pages.in_values(filters.show_all_rows), "Ctrl+0"),
                ),
            ),
            None,
            Action("view.settings", tr("S&ettings…"), view.open_settings, "Ctrl+,", ""),
        ),
    )


def _places() -> Menu[PartsWindow]:
    return Menu(
        "places",
        tr("&Go To"),
        (
            Action("view.table", tr("&Table"), pages.in_values(view.to_table), "Ctrl+1"),
            *(
                Action(f"view.{name.lower()}", text, pages.in_values(partial(_to_dock, name)), keys)
                for name, text, keys in (
                    ("Groups", tr("&Groups"), "Ctrl+2"),
                    ("Parameter", tr("&Parameter Help"), "Ctrl+3"),
                    ("Findings", tr("&Findings"), "Ctrl+4"),
                )
            ),
            Action("view.next_finding", tr("&Next Finding"), lambda w: w.step_findings(1), "Alt+Down"),
            Action("view.previous_finding", tr("Pre&vious Finding"), lambda w: w.step_findings(-1), "Alt+Up"),
            None,
            Action("view.back", tr("&Back"), lambda w: w.visited.go(-1), _KEY.Back),
            Action("view.forward", tr("F&orward"), lambda w: w.visited.go(1), _KEY.Forward),
            FilledMenu(lambda w: w.visited.menu),
            None,
            Action("view.reset", tr("&Reset Layout"), lambda w: w.docks.reset()),
        ),
    )
