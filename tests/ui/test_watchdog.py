"""The window comes back to its event loop while five families are open and a download and a check of many files run."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from amp_studio.files.examples import examples
from amp_studio.report import CHAPTERS, Contents
from amp_studio.transfer.client.parameters import download_file
from amp_studio.ui.base.task import Task
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.motion.view import MotionView
from amp_studio.ui.project.check import check_files

from .conftest import WAIT_MS, Control, action
from .watchdog import Watchdog

LIMIT_MS = 50.0


def test_the_window_does_not_stall_over_its_work(
    open_window: Callable[..., MainWindow],
    start_control: Callable[..., Control],
    tmp_path: Path,
    qtbot: QtBot,
) -> None:
    window, paths = open_window(), []
    for example in {e.family: e for e in examples()}.values():
        path = tmp_path / example.path.name
        path.write_bytes(example.path.read_bytes())
        paths.append(path)
        window.open_first(path)
    qtbot.waitUntil(lambda: len(window.tabs.pages()) >= 5 and not Task.running, timeout=WAIT_MS)
    mill = next(p for p in window.tabs.pages() if p.workspace.file.schema.family.family == "9pc")
    file, control = mill.workspace.file.copy(), start_control()
    work = [
        Task(partial(check_files, paths * 4)),
        Task(
            lambda progress, cancel: download_file(file, control.address, tmp_path, "copy", progress, cancel)
        ),
    ]
    with Watchdog() as dog:
        for task in work:
            task.begin()

        def do(name: str, act: Callable[[], object], wait: int = 60) -> None:
            dog.watch(name)
            act()
            QTest.qWait(wait)

        for page in window.tabs.pages():
            do(f"tab {page.workspace.file.schema.family.family}", partial(window.tabs.bring, page))
        window.tabs.bring(mill)
        do("value", lambda: window.edits.commit(("servo.excess_error", "1"), "12 mm"), 200)
        groups = mill.left.groups.tree
        do("all parameters", lambda: groups.setCurrentItem(groups.topLevelItem(0)), 200)
        do("pictures", action(window, "Pictures").trigger, 200)
        do("table", action(window, "Pictures").trigger)
        window.report_choice.contents = Contents(changed_only=True, without=frozenset(CHAPTERS))
        do("report preview", action(window, "Report Preview").trigger, 100)
        qtbot.waitUntil(
            lambda: bool(window.preview.panel and window.preview.panel.view.places), timeout=WAIT_MS
        )
        do("value beside its report", lambda: window.edits.commit(("servo.excess_error", "1"), "13 mm"), 200)
        do("report closed", action(window, "Report Preview").trigger)
        do("step response", action(window, "Motion").trigger, 1)
        dog.watch("step response drawn")
        motion = window.findChildren(MotionView)[-1]
        qtbot.waitUntil(lambda: motion.trace is not None and motion.plot.is_drawn, timeout=WAIT_MS)
        QTest.qWait(50)
        do("motion closed", motion.close)
        dog.watch("download and check")
        qtbot.waitUntil(lambda: not Task.running, timeout=WAIT_MS)
    assert dog.over(LIMIT_MS) == {}
