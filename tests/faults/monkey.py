"""Types and clicks at random in the window: ``python -m tests.faults.monkey FAMILY SEED SECONDS``.

The same seed makes the same choices; what they meet depends on how fast work in the background is. Prints each error with the actions
before it, then how much was done; ends with 1 where an error was found.
"""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
import time
import traceback
from collections import deque
from pathlib import Path
from random import Random
from types import TracebackType

FAMILIES = ("9pc", "num", "syntec", "57c422b", "acromill", "grblhal")
MOST_MEMORY = 1_200
"""MB that the window may take."""
_LEFT_ALONE = ("quit", "exit", "emulated", "beenden")
"""Words of actions that end the program, or start another one."""
_TEXTS = ("5 mm", "=1+1", "-1", "x" * 300, "1e9", "0", "yes", "10000 mm/min")
_PASTED = (*_TEXTS, "", "\t1\t2\n3\t4", "•", "a\nb")
_PAUSE_MS = 10
_LAST = 15
"""Actions that are printed with an error."""


def main(family: str, seed: str, seconds: str) -> int:
    """Be the monkey; return the exit code."""
    folder = Path(tempfile.mkdtemp(prefix="amp-studio-monkey-"))
    for name in ("XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME", "HOME"):
        os.environ[name] = str(folder / name.lower())
        Path(os.environ[name]).mkdir()
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    os.chdir(folder)
    try:
        return Monkey(family, int(seed), float(seconds), folder).run()
    finally:
        os.chdir("/")
        shutil.rmtree(folder, ignore_errors=True)


class Monkey:
    """One run over a copy of the examples of a family."""

    def __init__(self, family: str, seed: int, seconds: float, folder: Path) -> None:
        from PySide6.QtCore import QTimer
        from PySide6.QtWidgets import QApplication

        import amp_studio.ui  # its guard comes before every other class of the window
        from amp_studio.files.examples import examples
        from amp_studio.ui.main_window import MainWindow

        assert amp_studio.ui.main
        self.random, self.folder, self.end = Random(seed), folder, time.monotonic() + seconds
        self.errors: list[str] = []
        self.log: deque[str] = deque(maxlen=_LAST)
        self.done = 0
        self.application = QApplication([])
        self._answer_system_dialogs()
        sys.excepthook = self._failed
        self.files = []
        for example in examples():
            if example.family == family:
                self.files.append(Path(shutil.copy(example.path, folder / example.path.name)))
        self.window = MainWindow()
        self.window.resize(1366, 768)
        self.window.show()
        self.window.open_first(self.files[0])
        self._after = QTimer.singleShot

    def run(self) -> int:
        """Act until the time is over, which ends the process."""
        self._after(0, self._act)
        self.application.exec()
        return 1  # the window was closed

    def _finish(self) -> None:
        """Print what was found and end, wherever the window is."""
        for error in self.errors:
            print(error)
        memory = _memory()
        if memory > MOST_MEMORY:
            print(f"the window takes {memory} MB")
        print(f"{self.done} actions, {len(self.errors)} errors, {memory} MB")
        sys.stdout.flush()
        os._exit(bool(self.errors) or memory > MOST_MEMORY)  # windows are left as they are

    def _failed(self, kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        text = "".join(traceback.format_exception(kind, error, trace))
        last = traceback.extract_tb(trace)[-1:]
        where = f"{kind.__name__} in {last[0].filename}:{last[0].lineno}" if last else kind.__name__
        if not any(known.startswith(where) for known in self.errors):
            self.errors.append(f"{where}\n{text}after: " + "\n       ".join(self.log))

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
        QFileDialog.getOpenFileNames = lambda *a, **k: ([path()[0]] if path()[0] else [], "")  # type: ignore[method-assign]
        QFileDialog.getExistingDirectory = lambda *a, **k: str(self.folder)  # type: ignore[method-assign]
        QDesktopServices.openUrl = lambda _url: True  # type: ignore[method-assign]
        for dialog in (QPrintDialog, QPrintPreviewDialog):
            dialog.exec = lambda _self: 0  # type: ignore[method-assign]

    def _act(self) -> None:
        if time.monotonic() > self.end:
            self._finish()
        self._after(
            _PAUSE_MS, self._act
        )  # before the action: it may open a dialog, whose loop the next one needs
        self.done += 1
        modal = self.application.activeModalWidget() or self.application.activePopupWidget()
        acts = (
            [self._click, self._click, self._type, self._escape, self._press]
            if modal
            else [self._trigger, self._trigger, self._trigger, self._type, self._press, self._mouse, self._mouse, self._resize,
                  self._paste, self._open]
        )  # fmt: skip
        self.random.choice(acts)(modal or self.window)

    def _note(self, what: str) -> None:
        self.log.append(f"{self.done}: {what}")

    def _trigger(self, _: object) -> None:
        from amp_studio.ui.menu_commands import commands

        able = [(name, action) for name, action in commands(self.window.menuBar()) if action.isEnabled()]
        able = [one for one in able if not any(word in one[0].casefold() for word in _LEFT_ALONE)]
        if able:
            name, action = self.random.choice(able)
            self._note(f"action {name}")
            action.trigger()

    def _click(self, modal: object) -> None:
        from PySide6.QtWidgets import QAbstractButton

        buttons = [b for b in modal.findChildren(QAbstractButton) if b.isVisible() and b.isEnabled()]  # type: ignore[attr-defined]
        if buttons:
            button = self.random.choice(buttons)
            self._note(f"button {button.text()!r} of {type(modal).__name__}")
            button.click()

    def _escape(self, modal: object) -> None:
        self._note(f"close {type(modal).__name__}")
        modal.close()  # type: ignore[attr-defined]

    def _type(self, _: object) -> None:
        from PySide6.QtTest import QTest

        if (widget := self.application.focusWidget()) is not None:
            text = self.random.choice(_TEXTS)
            self._note(f"text {text[:12]!r} into {type(widget).__name__}")
            QTest.keyClicks(widget, text)

    def _press(self, _: object) -> None:
        from PySide6.QtCore import Qt
        from PySide6.QtTest import QTest

        keys = Qt.Key
        key = self.random.choice([keys.Key_Return, keys.Key_Escape, keys.Key_Tab, keys.Key_Down, keys.Key_Up, keys.Key_Left,
                                  keys.Key_Right, keys.Key_Delete, keys.Key_F2, keys.Key_Home, keys.Key_End, keys.Key_PageDown])  # fmt: skip
        modifier = self.random.choice(
            [Qt.KeyboardModifier.NoModifier] * 3
            + [Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier]
        )
        if (widget := self.application.focusWidget()) is not None:
            self._note(f"key {key.name} {modifier.name} at {type(widget).__name__}")
            QTest.keyClick(widget, key, modifier)

    def _mouse(self, _: object) -> None:
        from PySide6.QtCore import QPoint, Qt
        from PySide6.QtTest import QTest
        from PySide6.QtWidgets import QWidget

        able = [
            w for w in self.window.findChildren(QWidget) if w.isVisible() and w.isEnabled() and w.width() > 2
        ]
        widget = self.random.choice(able)
        point = QPoint(self.random.randrange(widget.width()), self.random.randrange(max(1, widget.height())))
        self._note(f"mouse {point.x()},{point.y()} on {type(widget).__name__} {widget.objectName()}")
        act = self.random.choice([QTest.mouseClick, QTest.mouseClick, QTest.mouseDClick])
        act(widget, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, point)

    def _resize(self, _: object) -> None:
        width, height = self.random.randrange(300, 2000), self.random.randrange(200, 1200)
        self._note(f"resize {width} x {height}")
        self.window.resize(width, height)

    def _paste(self, _: object) -> None:
        clipboard = self.application.clipboard()
        text = self.random.choice(_PASTED)
        self._note(f"clipboard {text[:12]!r}")
        clipboard.setText(text) if text else clipboard.clear()

    def _open(self, _: object) -> None:
        path = self.random.choice(self.files)
        self._note(f"open {path.name}")
        self.window.open_first(path)


def _memory() -> int:
    """Return the MB that this process takes; 0 where the system does not state it."""
    try:
        with Path("/proc/self/status").open() as lines:
            return next(int(line.split()[1]) // 1024 for line in lines if line.startswith("VmRSS"))
    except OSError:
        return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
