"""What is loaded beside the window is loaded by one thread at a time."""

import subprocess
import sys
import threading
from pathlib import Path

import pytest

from amp_studio.ui.base import loading


def test_a_thread_begins_to_load_when_the_other_has_loaded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """F9 within two seconds of opening: two threads inside of one package got a module that was not ready."""
    gate = type(sys)("gate_of_the_test")
    entered, go = threading.Event(), threading.Event()
    vars(gate).update(entered=entered, go=go)
    monkeypatch.setitem(sys.modules, "gate_of_the_test", gate)
    (tmp_path / "slow_part.py").write_text(
        "from gate_of_the_test import entered, go\nentered.set()\ngo.wait()\n"
    )
    (tmp_path / "quick_part.py").write_text("")
    monkeypatch.syspath_prepend(tmp_path)
    loading.load_beside("slow_part")
    entered.wait()
    second = threading.Thread(target=loading.load, args=("quick_part",))
    second.start()
    second.join(0.0)
    assert "quick_part" not in sys.modules
    assert loading._LOADING.locked()
    go.set()
    second.join()
    assert "quick_part" in sys.modules
    assert "slow_part" in sys.modules
    for name in ("slow_part", "quick_part"):
        del sys.modules[name]


def test_the_window_loads_in_threads_by_that_loader_alone() -> None:
    folder = Path(loading.__file__).parents[1]
    others = [
        path.name
        for path in folder.rglob("*.py")
        if "target=import_module" in path.read_text(encoding="utf-8")
    ]
    assert others == []


LOADED_AHEAD = """
import subprocess
import sys
from PySide6.QtWidgets import QApplication
application = QApplication(["test"])
from amp_studio.ui import main_window  # what every start loads
from amp_studio.ui.actions import ahead, picture
from amp_studio.ui.base.loading import load
from amp_studio.ui.window.studio_window import StudioWindow
load(*picture.PARTS, "numpy")  # which are loaded before
window = StudioWindow()
loaded, numbers = ahead.LoadedAhead(window), []
while loaded._left:
    before = len(sys.modules)
    loaded.step()
    numbers.append(len(sys.modules) - before)
assert max(numbers) <= 20, numbers
before = set(sys.modules)
for page in ("program.page", "motion.view", "motion.check_page", "motion.tests_page", "motion.tuning_page",
             "control.page"):
    load(f"amp_studio.ui.{page}")
assert set(sys.modules) == before, set(sys.modules) - before
"""


def test_pages_are_loaded_ahead_in_small_pieces() -> None:
    """The first page of blocks took 0.2 s on a busy machine, nearly all of it imports; each piece is at most
    twenty modules, so that a key waits for few.
    """
    ran = subprocess.run([sys.executable, "-c", LOADED_AHEAD], capture_output=True, text=True, check=False)
    assert (ran.returncode, ran.stderr) == (0, "")
