"""The window comes back to its event loop while five families are open and a download
and a check of many files run.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import pytest
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from amp_studio.files.example_files import examples
from amp_studio.report import CHAPTERS, Contents
from amp_studio.transfer.client.parameters import download_file
from amp_studio.transfer.exchange import Exchange
from amp_studio.ui.base.task import Task
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.motion.view import MotionView
from amp_studio.ui.page.file_page import FilePage
from amp_studio.ui.project.check import check_files
from tests.campaigns import CAMPAIGN

from .conftest import WAIT_MS, Control, action
from .watchdog import Watchdog

LIMIT = 50.0 if CAMPAIGN else 400_000
"""In the unit of the watchdog: the first edit of a full file is the longest with 285,000 calls."""
EXCESS = ("servo.excess_error", "1")


@pytest.fixture
def pages(open_window: Callable[..., MainWindow], tmp_path: Path, qtbot: QtBot) -> list[FilePage]:
    """Return the pages of a window with an example of every family open, that of the 9/PC to be seen."""
    window = open_window()
    for example in {e.family: e for e in examples()}.values():
        path = tmp_path / example.path.name
        path.write_bytes(example.path.read_bytes())
        window.open_first(path)
    qtbot.waitUntil(lambda: len(window.tabs.pages()) >= 5 and not Task.running, timeout=WAIT_MS)
    return window.tabs.pages()


@dataclass
class Work:
    """What is done in the window under the eye of the watchdog."""

    window: MainWindow
    dog: Watchdog
    qtbot: QtBot

    def do(self, name: str, act: Callable[[], object], wait: int = 60) -> None:
        self.dog.watch(name)
        act()
        QTest.qWait(wait)

    def choose(self, name: str, command: str, wait: int = 60) -> None:
        self.do(name, action(self.window, command).trigger, wait)

    def go_through(self, pages: list[FilePage], mill: FilePage) -> None:
        """Look at every file, at all parameters and at the pictures, and change a value."""
        for page in pages:
            self.do(f"tab {family_of(page)}", partial(self.window.tabs.bring, page))
        self.window.tabs.bring(mill)
        self.do("value", lambda: self.window.edits.commit(EXCESS, "12 mm"), 200)
        groups = mill.left.groups.tree
        self.do("all parameters", lambda: groups.setCurrentItem(groups.topLevelItem(0)), 200)
        self.choose("pictures", "Pictures", 200)
        self.choose("table", "Pictures")

    def read_the_report(self) -> None:
        """Change a value beside the preview of the report."""
        window = self.window
        window.report_options.contents = Contents(changed_only=True, without=frozenset(CHAPTERS))
        self.choose("report preview", "Report Preview", 100)
        self.qtbot.waitUntil(
            lambda: bool(window.preview.panel and window.preview.panel.view.places), timeout=WAIT_MS
        )
        self.do("value beside its report", lambda: window.edits.commit(EXCESS, "13 mm"), 200)
        self.choose("report closed", "Report Preview")

    def move_an_axis(self) -> None:
        """Simulate a step response and see it drawn."""
        self.choose("step response", "Motion", 1)
        self.dog.watch("step response drawn")
        motion = self.window.findChildren(MotionView)[-1]
        self.qtbot.waitUntil(lambda: motion.trace is not None, timeout=WAIT_MS)
        QTest.qWait(50)
        self.choose("motion left", "Motion")


def family_of(page: FilePage) -> str:
    return page.workspace.file.schema.family.family


def test_the_window_does_not_stall_over_its_work(
    pages: list[FilePage], start_control: Callable[..., Control], tmp_path: Path, qtbot: QtBot
) -> None:
    mill = next(p for p in pages if family_of(p) == "9pc")
    window, file, control = mill.window(), mill.workspace.file.copy(), start_control()
    assert isinstance(window, MainWindow)
    paths = [p.workspace.path for p in pages]
    tasks = [
        Task(partial(check_files, paths)),
        Task(
            lambda progress, cancel: download_file(
                file, control.address, Exchange(progress, cancel, tmp_path / "copy")
            )
        ),
    ]
    with Watchdog() as dog:
        for task in tasks:
            task.begin()
        work = Work(window, dog, qtbot)
        work.go_through(pages, mill)
        work.read_the_report()
        work.move_an_axis()
        dog.watch("download and check")
        qtbot.waitUntil(lambda: not Task.running, timeout=WAIT_MS)
    assert dog.over(LIMIT) == {}
