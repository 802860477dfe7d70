"""Opens the pages of the file in front that are in the place of its values: motion, tuning, check and tests
of the machine, blocks and programs. A command that is given again shows the values.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtGui import QAction

from amp_studio.files import ParameterFile, SavedVersion, saved_versions
from amp_studio.schema import Address, Family, Value, why_not_simulated
from amp_studio.ui.base.loading import load
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.translated import tr
from amp_studio.ui.control.exchange import ControlExchange
from amp_studio.ui.page.file_page import FilePage
from amp_studio.ui.page.page_of_file import PageOfFile

from .parts import PartsWindow

if TYPE_CHECKING:
    from amp_studio.transfer.client import LiveTuning
    from amp_studio.ui.base.workspace import Workspace
    from amp_studio.ui.motion.view import MotionView

MOTION, TUNING, CHECK, TESTS, PROGRAM, LIVE = "motion", "tuning", "check", "tests", "program", "live"
"""The names of the pages."""
_MAX_VERSIONS = 5
"""Earlier versions of a file under which a program is run."""


def show_values(window: PartsWindow) -> None:
    """Show the values of the file in front, whatever is in their place."""
    window.leave_control()
    window.page_in_front.uncover()


def in_values(does: Callable[[PartsWindow], object]) -> Callable[[PartsWindow], object]:
    """Return what shows the values, where another page is in front, and then does what is done there."""

    def act(window: PartsWindow) -> None:
        if window.control.is_shown or window.page_in_front.turned_to:
            show_values(window)
        does(window)

    return act


def is_shown(window: PartsWindow, name: str) -> bool:
    """Return whether a page of the file in front is seen; ``""`` is that of its values."""
    return window.page is not None and window.page.turned_to == name and not window.control.is_shown


def _turn(window: PartsWindow, name: str, make: Callable[[FilePage], PageOfFile]) -> PageOfFile | None:
    """Show a page of the file in front, made when it is first wanted; None where it was in front,
    and the values are now.
    """
    page = window.page_in_front
    if not window.leave_control() and page.turned_to == name:
        page.show_page("")
        return None
    if name not in page.pages:
        made = make(page)
        made.left.connect(lambda: page.show_page(""))
        page.take_page(name, made)
    page.show_page(name)
    return page.pages[name]


# -- motion ------------------------------------------------------------------------


def name_motion(window: PartsWindow, action: QAction) -> None:
    """Show in the menu whether the family in front can be simulated;
    the key gives the reason where it cannot.
    """
    workspace = window.workspace
    family = workspace.file.schema.family if workspace else None
    reason = why_not_simulated(family) if family else ""
    missing = tr("&Motion (not for {family})") if reason else tr("&Motion")
    action.setText(missing.format(family=family.short or family.name) if family else missing)
    action.setIconText(tr("Motion"))
    action.setToolTip(reason or tr("Motion (F9)"))


def open_motion(window: PartsWindow) -> None:
    """Show the page on which the machine moves; where its family cannot be simulated
    the file has the reason.
    """
    page = window.page_in_front
    if page.turned_to != MOTION and (reason := why_not_simulated(page.workspace.file.schema.family)):
        page.bar.say(reason)
        return
    address, file = window.selected(), page.workspace.file.copy()
    kind = in_background(window, tr("Loading the simulator"), partial(_motion_view, file))
    made = _turn(
        window,
        MOTION,
        lambda page: kind(page.workspace, address, page.go_to, control=window.control.read_address),
    )
    if isinstance(made, kind) and address is not None:
        made.show_axis(address[1])


def _motion_view(file: ParameterFile) -> type[MotionView]:
    """Load the view with the plots, and the simulator with what it knows of the family of a file.
    For a thread.
    """
    load("amp_studio.sim", "amp_studio.ui.motion.view")
    from amp_studio.sim import listing
    from amp_studio.ui.motion.view import MotionView

    listing(file)

    return MotionView


def open_check(window: PartsWindow) -> None:
    """Show the check of the machine in motion: every scenario that the file in front allows."""
    page = window.page_in_front
    if page.turned_to != CHECK and (reason := why_not_simulated(page.workspace.file.schema.family)):
        page.bar.say(reason)
        return
    load("amp_studio.sim", "amp_studio.ui.motion.check_page")
    from amp_studio.ui.motion.check_page import CheckPage

    def make(page: FilePage) -> CheckPage:
        made = CheckPage(page.workspace, page.follow)
        made.motion_requested.connect(partial(_show_scenario, window))
        return made

    _turn(window, CHECK, make)


def _show_scenario(window: PartsWindow, scenario: str, axis: str) -> None:
    """Show in motion what a row of the check is about."""
    load("amp_studio.sim", "amp_studio.ui.motion.view")
    from amp_studio.ui.motion.view import MotionView

    window.guarded(partial(open_motion, window), tr("Motion"))
    motion = window.page_in_front.pages.get(MOTION)
    if isinstance(motion, MotionView):
        motion.show_scenario(scenario, axis)


def open_tests(window: PartsWindow) -> None:
    """Show the tests at the machine that the manual of the file in front prints."""
    page = window.page_in_front
    if page.turned_to != TESTS and (reason := why_not_simulated(page.workspace.file.schema.family)):
        page.bar.say(reason)
        return
    load("amp_studio.sim", "amp_studio.ui.motion.tests_page")
    from amp_studio.ui.motion.tests_page import MachineTestsPage

    _turn(
        window, TESTS, lambda page: MachineTestsPage(page.workspace, lambda error: page.bar.say(str(error)))
    )


# -- tuning ------------------------------------------------------------------------


def _why_not_tuned(family: Family) -> str:
    """Return why a family has no page for tuning; empty where it has one."""
    from amp_studio.calibration import compensation_of  # not needed at program start

    offered = compensation_of(family.family)
    if offered.pages or offered.reversal:
        return ""
    return tr("The manual of {family} names nothing that is tuned on line.").format(family=family.name)


def open_tuning(window: PartsWindow) -> None:
    """Show what is tuned at the machine; a family that has nothing to tune has the reason in its file."""
    page = window.page_in_front
    if reason := _why_not_tuned(page.workspace.file.schema.family):
        page.bar.say(reason)
        return
    from amp_studio.ui.motion.tuning_page import TuningView

    def make(page: FilePage) -> TuningView:
        made = TuningView(page.workspace, partial(_connect, page.workspace, window.control.exchanges))
        made.send_requested.connect(lambda addresses: window.control.show("send", only=addresses))
        return made

    _turn(window, TUNING, make)


def _connect(workspace: Workspace, exchanges: ControlExchange) -> LiveTuning | None:
    address = exchanges.chosen_address()
    if address is None:
        return None
    from amp_studio.transfer.client import LiveTuning, open_driver

    path = workspace.path
    driver = open_driver(address, workspace.file.schema.family.family)
    return LiveTuning(driver, path, address=address, record=path)


# -- live ----------------------------------------------------------------------------


def open_live(window: PartsWindow) -> None:
    """Show what the control of the file in front states of itself, beside the values that the table lists;
    raises ValueError while something is sent.
    """
    page = window.page_in_front
    if not window.control.is_shown and page.turned_to == LIVE:
        page.show_page("")
        return
    address = window.control.read_address()
    if address is None:
        return
    load("amp_studio.sim", "amp_studio.ui.live.page")
    from amp_studio.ui.live.page import LiveView

    def make(page: FilePage) -> LiveView:
        made = LiveView(page.workspace)
        made.linked.connect(page.follow)
        made.noted.connect(page.bar.say)
        made.changed.connect(window.enable)
        made.control_requested.connect(window.control.open)
        return made

    made = _turn(window, LIVE, make)
    if isinstance(made, LiveView):
        window.control.make_live(made, page.workspace, address)
        here = page.table_view.address()
        made.show_parameters(page.listed_title, page.table.asked, here[1] if here else "")
        if here is not None:
            made.rows.select(here[0])
        made.start()


def go_to(window: PartsWindow) -> None:
    """Ask for a number: of a block where the page in front has blocks, else of a parameter."""
    page = None if window.control.is_shown else window.page
    front = page.pages.get(page.turned_to) if page is not None else None
    if front is None or not front.go_to():
        window.finder.box.begin()


# -- blocks and programs -----------------------------------------------------------


def open_program(window: PartsWindow) -> None:
    """Show the page of blocks and programs of the file in front."""
    page = window.page_in_front
    if not page.workspace.file.schema.program.page:
        page.bar.say(tr("No page here prints how the blocks of this control are read."))
        return
    load("amp_studio.sim", "amp_studio.programs", "amp_studio.ui.program.page")
    from amp_studio.ui.program.page import ProgramPage

    def make(page: FilePage) -> ProgramPage:
        workspace = page.workspace

        def apply(values: Mapping[Address, Value]) -> bool:
            return workspace.edit(tr("Take from the program"), values)

        def earlier() -> list[SavedVersion]:
            document = workspace.document
            return list(saved_versions(document.as_saved(), document.history(), _MAX_VERSIONS))

        return ProgramPage(workspace.file.copy, apply, earlier=earlier)

    made = _turn(window, PROGRAM, make)
    if isinstance(made, ProgramPage):
        made.run_again()
