"""Types and clicks at random in the window: ``python -m tests.faults.monkey FAMILY SEED SECONDS [LOG]``.

FAMILY ``all`` opens the examples of every family, one after another; the folder is a project. An emulated
control is started and stopped as the actions go.

The same seed makes the same choices; what they meet depends on how fast work in the background is. Each
action is written to the log as it is done, one JSON list a line; ``python -m tests.faults.monkey FAMILY
--replay LOG`` does them again, and leaves out what is not there. Prints each error with the actions before
it, then how much was done; ends with 1 where an error was found: an exception, a message of Qt, a logged
warning, an action that takes longer than a minute, more memory than the budget, a connection to another
machine.
"""

from __future__ import annotations

import faulthandler
import json
import logging
import os
import shutil
import sys
import tempfile
import time
import traceback
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from random import Random
from types import TracebackType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from PySide6.QtWidgets import QWidget

Action = list[Any]
"""What is done, and with what: a line of the log."""

FAMILIES = ("9pc", "num", "syntec", "57c422b", "acromill", "grblhal", "linuxcnc")
ALL = "all"
"""In the place of a family: the files of each."""
RUNS = (*FAMILIES, ALL)
MAX_MEMORY = 700
"""MB that the window may take."""
LONGEST_S = 60
"""Seconds after which an action that is not over is an error."""
_LEFT_ALONE = ("quit", "exit", "beenden")
"""Words of actions that end the program."""
_TEXTS = ("5 mm", "=1+1", "-1", "x" * 300, "1e9", "0", "yes", "10000 mm/min")
_PASTED = (*_TEXTS, "", "\t1\t2\n3\t4", "•", "a\nb")
_PAUSE_MS = 10
_LAST = 15
"""Actions that are printed with an error."""
_OF_THE_PLATFORM = ("propagateSizeHints", "QFontDatabase", "does not support")
"""In messages of Qt about the display without a screen."""


def main(family: str, seed: str, seconds: str, log: str = os.devnull) -> int:
    """Be the monkey; return the exit code. ``seed`` is ``--replay`` and ``seconds`` a log to do it again."""
    actions = None
    if seed == "--replay":
        actions = [json.loads(line) for line in Path(seconds).read_text("utf-8").splitlines()]
        seed, seconds = "1", "1e9"
    out = Path(log).absolute()
    faulthandler.enable()
    sys.addaudithook(_stay_here)
    folder = Path(tempfile.mkdtemp(prefix="amp-studio-monkey-"))
    for name in ("XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME", "HOME"):
        os.environ[name] = str(folder / name.lower())
        Path(os.environ[name]).mkdir()
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    os.chdir(folder)
    try:
        return Monkey(family, int(seed), float(seconds), folder, out, actions).run()
    finally:
        os.chdir("/")
        shutil.rmtree(folder, ignore_errors=True)


def _stay_here(event: str, arguments: tuple[Any, ...]) -> None:
    """Refuse a connection to another machine."""
    if event == "socket.connect" and isinstance(arguments[1], tuple):
        host = str(arguments[1][0])
        if not (host.startswith("127.") or host in {"localhost", "::1", ""}):
            raise PermissionError(f"the monkey wanted to connect to {host}")


class Monkey:
    """One run over a copy of the examples of a family."""

    def __init__(
        self, family: str, seed: int, seconds: float, folder: Path, log: Path, actions: list[Action] | None
    ) -> None:
        from PySide6.QtCore import QTimer, qInstallMessageHandler
        from PySide6.QtWidgets import QApplication

        import amp_studio.ui  # its guard comes before every other class of the window
        from amp_studio.files import Project, ProjectInfo
        from amp_studio.files.example_files import examples
        from amp_studio.ui.main_window import MainWindow

        assert amp_studio.ui.main
        self.random, self.folder, self.end = Random(seed), folder, time.monotonic() + seconds
        self.errors: list[str] = []
        self.last: deque[str] = deque(maxlen=_LAST)
        self.log = log.open("w", encoding="utf-8")
        self.replayed: Iterator[Action] | None = iter(actions) if actions is not None else None
        self.done = 0
        qInstallMessageHandler(self._qt_message)
        logging.lastResort = _Reporting(self._report)  # what would be printed where nobody looks
        self.application = QApplication([])
        self._answer_system_dialogs()
        sys.excepthook = self._failed
        self.files = []
        for example in examples():
            if family in (ALL, example.family):
                self.files.append(Path(shutil.copy(example.path, folder / example.path.name)))
        self.project = folder if family == ALL else None
        if self.project is not None:
            Project.create(self.project, ProjectInfo("Monkey", FAMILIES[0]))
        self.window = MainWindow()
        self.window.resize(1366, 768)
        self.window.show()
        self.window.open_first(self.files[0])
        self._after = QTimer.singleShot
        self.at_start = _memory()

    def run(self) -> int:
        """Act until the time is over, which ends the process."""
        self._after(0, self._act)
        self.application.exec()
        return 1  # the window was closed

    def _finish(self) -> None:
        """Print what was found and end, wherever the window is."""
        for error in self.errors:
            print(error)
        self.window.control.emulated.stop(wait=True)
        memory = _memory()
        if memory > MAX_MEMORY:
            print(f"the window takes {memory} MB")
        print(f"{self.done} actions, {len(self.errors)} errors, {self.at_start} MB, then {memory} MB")
        sys.stdout.flush()
        os._exit(bool(self.errors) or memory > MAX_MEMORY)  # windows are left as they are

    def _failed(self, kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        if kind.__name__ == "AskerGoneError":
            return
        text = "".join(traceback.format_exception(kind, error, trace))
        last = traceback.extract_tb(trace)[-1:]
        where = f"{kind.__name__} in {last[0].filename}:{last[0].lineno}" if last else kind.__name__
        self._report(where, text)

    def _qt_message(self, _kind: object, _context: object, text: str) -> None:
        if not any(word in text for word in _OF_THE_PLATFORM):
            where = "".join(traceback.format_stack()[-4:-1])
            self._report(f"Qt: {text.split(':', maxsplit=1)[0]}", f"{text}\n{where}")

    def _report(self, where: str, text: str) -> None:
        if not any(known.startswith(where) for known in self.errors):
            self.errors.append(f"{where}\n{text}\nafter: " + "\n       ".join(self.last))

    def _answer_system_dialogs(self) -> None:
        """Answer file dialogs with a path of the own folder, and let nothing leave it."""
        from PySide6.QtGui import QDesktopServices
        from PySide6.QtPrintSupport import QPrintDialog, QPrintPreviewDialog
        from PySide6.QtWidgets import QFileDialog

        def path(*_: object, **__: object) -> tuple[str, str]:
            names = ["", "new.amp", "out.pdf", "out.csv", *(f.name for f in self.files)]
            name = self.random.choice(names)
            return (str(self.folder / name) if name else ""), "All files (*)"

        for name in ("getOpenFileName", "getSaveFileName"):
            setattr(QFileDialog, name, path)
        QFileDialog.getOpenFileNames = lambda *a, **k: ([path()[0]] if path()[0] else [], "")
        QFileDialog.getExistingDirectory = lambda *a, **k: str(self.folder)
        QDesktopServices.openUrl = lambda _url: True
        for dialog in (QPrintDialog, QPrintPreviewDialog):
            dialog.exec = lambda _self: 0

    def _act(self) -> None:
        action = next(self.replayed, None) if self.replayed is not None else self._chosen()
        if action is None or time.monotonic() > self.end:
            self._finish()
        assert action is not None
        self._after(
            _PAUSE_MS, self._act
        )  # before the action: it may open a dialog, whose loop the next one needs
        self.done += 1
        faulthandler.dump_traceback_later(LONGEST_S, exit=True)
        line = json.dumps(action, ensure_ascii=False)
        self.last.append(f"{self.done}: {line}")
        print(line, file=self.log, flush=True)
        kind, *what = action
        getattr(self, f"_{kind}")(*what)

    def _front(self) -> QWidget:
        return self.application.activeModalWidget() or self.application.activePopupWidget() or self.window

    # -- what is chosen ------------------------------------------------------------------

    def _chosen(self) -> Action:
        """Return an action that is possible now."""
        front = self._front()
        kinds = (
            ["button", "button", "text", "close", "key"]
            if front is not self.window
            else [
                "trigger",
                "trigger",
                "trigger",
                "text",
                "key",
                "mouse",
                "mouse",
                "resize",
                "clipboard",
                "open",
            ]
        )
        kind = self.random.choice(kinds)
        return [kind, *getattr(self, f"_any_{kind}")(front)]

    def _any_trigger(self, _: QWidget) -> Action:
        able = [name for name, action in self._commands().items() if action.isEnabled()]
        return [self.random.choice(sorted(able))]

    def _any_button(self, front: QWidget) -> Action:
        return [self.random.choice(sorted(self._buttons(front)) or [""])]

    def _any_close(self, front: QWidget) -> Action:
        return [type(front).__name__]

    def _any_text(self, _: QWidget) -> Action:
        return [self.random.choice(_TEXTS)]

    def _any_key(self, _: QWidget) -> Action:
        keys = (
            "Return",
            "Escape",
            "Tab",
            "Down",
            "Up",
            "Left",
            "Right",
            "Delete",
            "F2",
            "Home",
            "End",
            "PageDown",
        )
        modifiers = ("NoModifier", "NoModifier", "NoModifier", "ShiftModifier", "ControlModifier")
        return [f"Key_{self.random.choice(keys)}", self.random.choice(modifiers)]

    def _any_mouse(self, _: QWidget) -> Action:
        widgets = self._widgets()
        name = self.random.choice(sorted(widgets))
        widget = widgets[name]
        x, y = (self.random.randrange(max(1, size)) for size in (widget.width(), widget.height()))
        return [name, x, y, self.random.choice(["mouseClick", "mouseClick", "mouseDClick"])]

    def _any_resize(self, _: QWidget) -> Action:
        return [self.random.randrange(300, 2000), self.random.randrange(200, 1200)]

    def _any_clipboard(self, _: QWidget) -> Action:
        return [self.random.choice(_PASTED)]

    def _any_open(self, _: QWidget) -> Action:
        return [self.random.choice([each.name for each in self.files] + [""] * (self.project is not None))]

    # -- what is there -------------------------------------------------------------------

    def _commands(self) -> dict[str, Any]:
        from amp_studio.ui.base.menu_commands import commands

        found = dict(commands(self.window.menuBar()))
        return {n: a for n, a in found.items() if not any(word in n.casefold() for word in _LEFT_ALONE)}

    def _buttons(self, front: QWidget) -> dict[str, Any]:
        from PySide6.QtWidgets import QAbstractButton

        seen = [b for b in front.findChildren(QAbstractButton) if b.isVisible() and b.isEnabled()]
        return {b.text() or b.accessibleName() or b.toolTip(): b for b in seen}

    def _widgets(self) -> dict[str, Any]:
        from PySide6.QtWidgets import QWidget

        seen = [
            w for w in self.window.findChildren(QWidget) if w.isVisible() and w.isEnabled() and w.width() > 2
        ]
        names: dict[str, Any] = {}
        for widget in seen:
            name = f"{type(widget).__name__} {widget.objectName()}"
            names[f"{name} {sum(other.startswith(name) for other in names)}"] = widget
        return names

    # -- what is done --------------------------------------------------------------------

    def _trigger(self, name: str) -> None:
        action = self._commands().get(name)
        if action is not None and action.isEnabled():
            action.trigger()

    def _button(self, name: str) -> None:
        if (button := self._buttons(self._front()).get(name)) is not None:
            with suppress(RuntimeError):  # the click took the dialog of the button away
                button.click()

    def _close(self, name: str) -> None:
        if type(front := self._front()).__name__ == name and front is not self.window:
            front.close()

    def _text(self, text: str) -> None:
        from PySide6.QtTest import QTest

        if (widget := self.application.focusWidget()) is not None:
            QTest.keyClicks(widget, text)

    def _key(self, key: str, modifier: str) -> None:
        from PySide6.QtCore import Qt
        from PySide6.QtTest import QTest

        if (widget := self.application.focusWidget()) is not None:
            QTest.keyClick(widget, Qt.Key[key], Qt.KeyboardModifier[modifier])

    def _mouse(self, name: str, x: int, y: int, act: str) -> None:
        from PySide6.QtCore import QPoint, Qt
        from PySide6.QtTest import QTest

        widget = self._widgets().get(name) if self._front() is self.window else None
        if widget is not None:
            getattr(QTest, act)(
                widget, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, QPoint(x, y)
            )

    def _resize(self, width: int, height: int) -> None:
        self.window.resize(width, height)

    def _clipboard(self, text: str) -> None:
        clipboard = self.application.clipboard()
        clipboard.setText(text) if text else clipboard.clear()

    def _open(self, name: str) -> None:
        """Open a file by its name, the project without one."""
        self.window.open_first(self.folder / name)


class _Reporting(logging.Handler):
    """Takes a warning that the program logs for an error."""

    def __init__(self, report: Callable[[str, str], None]) -> None:
        super().__init__(logging.WARNING)
        self._report = report

    def emit(self, record: logging.LogRecord) -> None:
        self._report(f"log of {record.name}", record.getMessage())


def _memory() -> int:
    """Return the MB that this process takes; 0 where the system does not state it."""
    try:
        with Path("/proc/self/status").open() as lines:
            return next(int(line.split()[1]) // 1024 for line in lines if line.startswith("VmRSS"))
    except OSError:
        return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
