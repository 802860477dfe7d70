"""What the window takes with files, the preview of the report and edits: one file and an edit, and a file
of every family, motion and a hundred edits in ``make campaign``.
"""

import subprocess
import sys

import pytest

from tests.campaigns import CAMPAIGN

MAX_MB = 450 if CAMPAIGN else 250
FAMILIES = () if CAMPAIGN else ("grblhal",)
"""Whose files are opened; all where none is named."""
EDITED = ("servo.loop_gain", "1") if CAMPAIGN else ("axis.max_rate", "X")
EDITS, EDITS_A_REPORT = (100, 50) if CAMPAIGN else (1, 1)
DRAWS_MOTION = CAMPAIGN
"""A separate process simulates, which takes seconds and nothing of the window's memory."""
PROGRAM = f"""
import os, shutil, sys, tempfile
from pathlib import Path
import amp_studio.dossier, amp_studio.ui
from PySide6.QtCore import QElapsedTimer, QEventLoop, QTimer
from PySide6.QtWidgets import QApplication
from amp_studio.files.example_files import examples
from amp_studio.ui.main_window import MainWindow

def memory():
    lines = dict(line.split(":", 1) for line in Path("/proc/self/status").read_text().splitlines())
    return int(lines["VmRSS"].split()[0]) // 1024

def wait(until):
    timer = QElapsedTimer()
    timer.start()
    while not until():
        assert timer.elapsed() < 120_000
        application.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)

if not {DRAWS_MOTION}:
    amp_studio.dossier.motion_apart = lambda file: ()
application = QApplication([])
beat = QTimer()  # so that a wait looks again, without a turn of the processor in between
beat.start(20)
window = MainWindow()
window.show()
folder, families = Path(tempfile.mkdtemp()), set()
for example in examples():
    if example.family not in families and example.family in ({FAMILIES} or [example.family]):
        families.add(example.family)
        path = Path(shutil.copy(example.path, folder))
        window.open_first(path)
        wait(lambda: window.workspace is not None and window.workspace.path == path)
window.preview.toggle()
wait(lambda: window.preview.panel is not None and window.preview.panel.is_settled)
pages = window.preview.panel.view.pages
for edit in range({EDITS}):
    assert window.edits.commit({EDITED}, str(31 + edit))
    application.processEvents()
    if edit % {EDITS_A_REPORT} == {EDITS_A_REPORT} - 1:
        wait(lambda: window.preview.panel.is_settled)
assert window.preview.panel.view.pages != pages, "no edit was seen in the report"
assert len(families) >= {len(FAMILIES) or 6}
print(memory(), len(set(window.preview.panel.view.pages)))
shutil.rmtree(folder)
sys.stdout.flush()
os._exit(0)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="reads what Linux says of a process")
def test_files_and_the_preview_stay_small(tmp_path) -> None:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
        cwd=tmp_path,
    )
    assert done.returncode == 0, done.stderr
    assert int(done.stdout.split()[0]) < MAX_MB
