"""The accessibility tree of every page of the window: names, roles and the way of the Tab key."""

import threading
from collections.abc import Callable

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible
from PySide6.QtWidgets import QApplication, QHeaderView, QWidget

from amp_studio.schema import Value
from amp_studio.ui.dialogs.calculator_dialog import CalculatorDialog
from amp_studio.ui.dialogs.file_dialogs import ReportDialog
from amp_studio.ui.dialogs.new_file_dialog import NewFileDialog
from amp_studio.ui.dialogs.note_dialog import NoteDialog
from amp_studio.ui.dialogs.settings_dialog import SettingsDialog
from amp_studio.ui.dialogs.tables_dialog import TablesDialog
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.merge.machines_dialog import MachinesDialog
from amp_studio.ui.merge.window import MergeWindow
from amp_studio.ui.motion.tuning_page import TuningView
from amp_studio.ui.motion.view import MotionView
from amp_studio.ui.page.step_list import StepList
from amp_studio.ui.project.check import ProjectCheckDialog, check_files
from amp_studio.ui.table.quick_edit import QuickEdit

from .conftest import action

EXCESS = ("servo.excess_error", "1")


def focusable(top: QWidget) -> list[QWidget]:
    """Return the visible parts of a window that take the keyboard by themselves."""
    return [
        part
        for part in top.findChildren(QWidget)
        if part.window() is top
        and part.isVisible()
        and part.isEnabled()
        and part.focusProxy() is None
        and part.focusPolicy() != Qt.FocusPolicy.NoFocus
    ]


def silent(top: QWidget) -> list[str]:
    """Return the parts of the accessibility tree that take the keyboard and have no name,
    or a role that has no meaning.
    """
    found: list[str] = []

    def walk(node: object) -> None:
        part = node.object()
        if isinstance(part, QWidget) and part in wanted:
            wanted.remove(part)
            name, role = node.text(QAccessible.Text.Name), node.role()
            if not name or role == QAccessible.Role.NoRole:
                found.append(f"{type(part).__name__} in {type(part.parent()).__name__}: {name!r} {role.name}")
        for n in range(min(node.childCount(), 200)):
            child = node.child(n)
            if child is not None and isinstance(child.object(), QWidget):
                walk(child)

    wanted = focusable(top)
    heads = [
        part for part in wanted if isinstance(part.parent(), QHeaderView)
    ]  # Qt lists no widgets in a head
    wanted = [part for part in wanted if part not in heads]
    found += [type(part).__name__ for part in heads if not part.accessibleName()]
    walk(QAccessible.queryAccessibleInterface(top))
    return found + [
        f"not in the tree: {type(part).__name__} in {type(part.parent()).__name__}" for part in wanted
    ]


def beside_the_way(top: QWidget) -> list[str]:
    """Return the parts that the Tab key never reaches in the chain of the focus."""
    reached, part = set(), top.nextInFocusChain()
    while part is not None and part is not top and part not in reached:
        reached.add(part)
        part = part.nextInFocusChain()
    return [
        type(p).__name__
        for p in focusable(top)
        if p.focusPolicy() & Qt.FocusPolicy.TabFocus and p not in reached
    ]


def opened(window: MainWindow, kind: type[QWidget]) -> QWidget:
    return window.findChildren(kind)[-1]


def by(name: str, kind: type[QWidget]) -> Callable[[MainWindow], QWidget]:
    """Return what opens a side window by a command of the menus."""

    def open_it(window: MainWindow) -> QWidget:
        action(window, name).trigger()
        return opened(window, kind)

    return open_it


def displayed(make: Callable[[MainWindow], QWidget]) -> Callable[[MainWindow], QWidget]:
    """Return what shows a dialog without waiting for its end."""

    def open_it(window: MainWindow) -> QWidget:
        dialog = make(window)
        dialog.show()
        return dialog

    return open_it


def left(side: str) -> Callable[[MainWindow], QWidget]:
    def open_it(window: MainWindow) -> QWidget:
        window.page.left.show_side(side)
        return window

    return open_it


def findings(window: MainWindow) -> QWidget:
    window.workspace.edit("error", {EXCESS: Value(0.001, "mm")})
    window.show_panel("Findings")
    return window


def pictures(window: MainWindow) -> QWidget:
    action(window, "Pictures").trigger()
    return window


def at_the_control(window: MainWindow) -> QWidget:
    action(window, "At the Control").trigger()
    return window


def report(window: MainWindow) -> QWidget:
    action(window, "Report Preview").trigger()
    for _ in range(3):  # it is made in turns of the event loop
        QApplication.processEvents()
    assert window.preview.panel is not None
    return window


def project_check(window: MainWindow) -> QWidget:
    checked = check_files([window.workspace.path], lambda *_: None, threading.Event())
    return ProjectCheckDialog(checked, lambda *_: None, window)


PAGES: dict[str, Callable[[MainWindow], QWidget]] = {
    "steps": left("steps"),
    "groups": left("groups"),
    "project": left("project"),
    "findings": findings,
    "pictures": pictures,
    "report preview": report,
    "motion": by("Motion", MotionView),
    "tuning": by("Tuning", TuningView),
    "exchanges": displayed(lambda window: (window.control.recorded(), window)[1]),
    "several controls": displayed(lambda window: (window.control.several(), window)[1]),
    "sheet": displayed(lambda window: (window.control.show("hand"), window)[1]),
    "download": displayed(at_the_control),
}
BESIDE: dict[str, Callable[[MainWindow], QWidget]] = {
    "machines": by("Compare Machines", MachinesDialog),
    "compare": lambda window: window.files.comparing.open(window.page),
    "calculator": by("Calculator", CalculatorDialog),
    "tables": by("Tables of the Manual", TablesDialog),
    "quick edit": lambda window: (window.edits.quick_edit(), opened(window, QuickEdit))[1],
    "steps of undo": lambda window: (window.edits.steps(), opened(window, StepList))[1],
    "new": displayed(lambda window: NewFileDialog(window, "9pc")),
    "report": displayed(lambda window: ReportDialog(window.workspace.path, window)),
    "settings": by("Settings", SettingsDialog),
    "note": displayed(lambda window: NoteDialog(window.workspace, EXCESS, window)),
    "project check": displayed(project_check),
}


def demand(top: QWidget, page: str) -> None:
    """Each part of a page has a name and a role, and the Tab key reaches it."""
    QApplication.processEvents()
    assert (page, silent(top), beside_the_way(top)) == (page, [], [])
    assert top.windowTitle() or top.accessibleName(), page


@pytest.mark.own_window
@pytest.mark.parametrize("pages", [PAGES, BESIDE], ids=["in the window", "beside it"])
def test_each_part_of_a_page_has_a_name_and_a_role_and_tab_reaches_it(
    window: MainWindow, pages: dict[str, Callable[[MainWindow], QWidget]]
) -> None:
    """In a separate window: PySide deletes menus that were reached as accessible children."""
    window.go_to(EXCESS)
    for page, show in pages.items():
        top = show(window)
        demand(top, page)
        if isinstance(top, TuningView):
            for n in range(top.pages.count()):
                top.pages.setCurrentRow(n)
                demand(top, top.pages.item(n).text())
        if isinstance(top, MergeWindow):
            assert top.tree.accessibleName()
        if top is not window and top.isWindow():
            top.close()
