"""Five families open in one window: the memory of the process, and how long a full file takes to open there.

``python bench/many_files.py FULL FILE …`` opens the files in a process alone and prints megabytes,
then seconds.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from measure import Measure

if TYPE_CHECKING:
    from PySide6.QtCore import QCoreApplication

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
FAMILIES = ("mill-1394", "num-1060-mill", "syntec-mill", "acromill-router", "57c422b-label-press")
"""An example of each."""


def measures(folder: Path, full: Path, times: int) -> Iterator[Measure]:
    """Yield the memory with five families open, and the time until a full file is painted in that window."""
    from amp_studio.files.example_files import examples_folder

    paths = [next((examples_folder() / name).glob("*.amp")) for name in FAMILIES]
    copies = [folder / f"open-{path.name}" for path in paths]
    for path, copy in zip(paths, copies, strict=True):
        copy.write_bytes(path.read_bytes())
    megabytes, seconds = [], []
    for _ in range(max(1, min(times, 5))):
        command = [sys.executable, str(Path(__file__)), str(full), *map(str, copies)]
        said = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120).stdout.split()
        megabytes.append(float(said[0]))
        seconds += [float(text) for text in said[1:]]
    yield Measure("memory with five families open in one window", tuple(megabytes), 250.0, "MB")
    yield Measure("full file open in a window, painted", tuple(seconds), 0.150)


def main(full: Path, paths: list[Path]) -> None:
    """Open the files in a window, show each once, and print what that takes."""
    from PySide6.QtCore import QSettings
    from PySide6.QtWidgets import QApplication

    QSettings.setPath(QSettings.Format.NativeFormat, QSettings.Scope.UserScope, str(paths[0].parent))
    from amp_studio.ui.main_window import MainWindow

    application = QApplication(["bench"])
    window = MainWindow()
    window.resize(1440, 900)
    window.show()
    for path in paths:
        window.open_first(path)
        application.processEvents()
    for page in window.tabs.pages():
        window.tabs.bring(page)
        _rest(application)
    assert len(window.tabs.pages()) == len(paths)
    print(_resident())
    for _ in range(3):
        begin = time.perf_counter()
        window.open_first(full)
        application.processEvents()
        print(time.perf_counter() - begin)
        window.close_page(window.page_of(full))
        application.processEvents()
    sys.stdout.flush()
    os._exit(0)


def _rest(application: QCoreApplication) -> None:
    """Let the window do what it does once the user stops typing: indexes, findings of other files."""
    end = time.monotonic() + 0.4
    while time.monotonic() < end:
        application.processEvents()
        time.sleep(0.005)


def _resident() -> float:
    """Return the megabytes of memory that this process has now;
    the most it had where the system has no such figure.
    """
    try:
        text = Path("/proc/self/status").read_text(encoding="ascii")
        return int(text.partition("VmRSS:")[2].split()[0]) / 1024
    except (OSError, IndexError, ValueError):
        import resource

        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
    main(Path(sys.argv[1]), [Path(text) for text in sys.argv[2:]])
