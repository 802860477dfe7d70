"""Kills the editor while somebody types, and looks whether what was entered more than a second before is
still there.
"""

import os
import random
import subprocess
import sys
import time
from pathlib import Path

from amp_studio.files import Document

ADDRESS = ("home.calibration", "1")
LIMIT = 1.0
"""Seconds before the kill that may be lost."""

EDITOR = """
import sys, time
from pathlib import Path
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication
from amp_studio.ui.main_window import MainWindow
application = QApplication(["amp-studio"])
window = MainWindow()
window.show()
window.open_first(Path(sys.argv[1]))
entered = 0
def enter():
    global entered
    entered += 1
    window.edits.commit(("home.calibration", "1"), f"{entered} mm")
    header = window.workspace.file.header
    facts = {"notes": f"note {entered}", "name": f"name {entered}"}
    window.workspace.do("Machine facts", lambda: vars(header).update(facts))
    print(entered, time.monotonic(), flush=True)
timer = QTimer()
timer.timeout.connect(enter)
timer.start(int(sys.argv[2]))
application.exec()
"""
"""A window in which a value, the notes and the name are changed again and again;
each is printed with its time."""


def kill_editor(path: Path, *, seed: int, begin: str = "") -> list[str]:
    """Kill one editor at a moment that chance chooses; return what was lost or broken by it.
    ``begin`` is Python that it runs first.
    """
    chance = random.Random(seed)
    interval, life = chance.choice((20, 100, 700)), chance.uniform(1.2, 3.0)
    before = path.read_bytes()
    command = [sys.executable, "-c", begin + EDITOR, str(path), str(interval)]
    env = os.environ | {"QT_QPA_PLATFORM": "offscreen"}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=env) as editor:
        assert editor.stdout is not None
        first = editor.stdout.readline()
        time.sleep(life)
        killed = time.monotonic()
        editor.kill()
        lines = [first, *editor.stdout.read().splitlines()]
    entered = {int(n): float(at) for n, at in (line.split() for line in lines if len(line.split()) == 2)}
    # Its last sign of life counts: on a busy machine the editor may not have been given any time since.
    alive = max((at for at in entered.values() if at < killed), default=0.0)
    safe = max((n for n, at in entered.items() if at < alive - LIMIT), default=0)
    faults = [] if path.read_bytes() == before else ["the file itself was changed"]
    with Document.open(path) as document:
        left = document.find_unsaved()
        kept = {c.address: c.new.value for c in left.changes if c.new} if left else {}
        value = float(kept.get(ADDRESS, 0))
        notes = int((left.header.get("notes", "") if left else "").rpartition(" ")[2] or 0)
        name = int((left.header.get("name", "") if left else "").rpartition(" ")[2] or 0)
        document.discard_unsaved()
    if min(value, notes, name) < safe:
        faults.append(f"entered {safe}, kept {value:g}, notes {notes}, name {name}")
    return [f"seed {seed}: {fault}" for fault in faults]
