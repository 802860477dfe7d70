"""The desktop program without a display, and without a question that nobody answers."""

import gc
import queue
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import QSettings, Qt, QTimer
from PySide6.QtGui import QAction, QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QFileDialog,
    QInputDialog,
    QLineEdit,
    QMessageBox,
    QWidget,
)
from pytestqt.qtbot import QtBot

from amp_studio.families.ninepc.emulated.panel import NinePcPanel, axes_supported
from amp_studio.files import Document, ParameterFile, content_of, new_file, open_file
from amp_studio.transfer import decode_image, encode_image, patch_image
from amp_studio.transfer.emulated.control import Control as EmulatedMemory
from amp_studio.transfer.emulated.emulator import serve
from amp_studio.transfer.emulated.record import Identity
from amp_studio.transfer.links import parse_endpoint
from amp_studio.transfer.links.security import Security
from amp_studio.ui.base import garbage
from amp_studio.ui.base.menu_commands import commands
from amp_studio.ui.base.task import ProgressDialog
from amp_studio.ui.base.translated import set_language
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.table.parameter_table import ParameterTable

from .alt_letters import doubled, texts_of
from .shared import Brush, SharedWindow, close_windows

garbage.REST_MS = 3_600_000  # no test but that of the collection goes through the objects of all tests
WAIT_MS = 20_000
"""Far more than anything takes; a test that waits ends as soon as what it waits for is there."""


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Let nothing be collected while Qt is at work (``amp_studio.ui.base.garbage``),
    and other folders as always.
    """
    if Path(__file__).parent in item.path.parents:
        gc.disable()
    try:
        return (yield)
    finally:
        gc.unfreeze()  # what belonged to the files that were open
        gc.enable()


class User:
    """Who answers: every question needs an answer given before, every message must be read."""

    def __init__(self) -> None:
        self._answers: list[str] = []
        self._paths: list[str] = []
        self._texts: list[str] = []
        self.shown_boxes: list[str] = []
        self.asked: list[str] = []
        self.labels: list[str] = []

    def answers(self, *buttons: str) -> None:
        """Click these buttons in the next questions; ``&`` need not be given."""
        self._answers.extend(buttons)

    def chooses(self, *paths: Path | str) -> None:
        """Give these paths to the next file dialogs."""
        self._paths.extend(str(path) for path in paths)

    def types(self, *texts: str) -> None:
        """Give these texts to the next input dialogs."""
        self._texts.extend(texts)

    def reads(self) -> str:
        """Return the one message that was shown."""
        assert len(self.shown_boxes) == 1, self.shown_boxes
        return self.shown_boxes.pop()

    def is_done(self) -> None:
        """Fail when a message was not read, or an answer not asked for."""
        assert (self.shown_boxes, self._answers, self._paths, self._texts) == ([], [], [], [])

    # -- what Qt's dialogs do instead -------------------------------------------

    def exec(self, box: QMessageBox) -> int:
        buttons = {button.text().replace("&", ""): button for button in box.buttons()}
        if len(buttons) == 1:
            self.shown_boxes.append(box.text())
        else:
            self.asked.append(box.text())
            assert self._answers, f"nobody answers: {box.text()}"
            box.setProperty("clicked", self._answers.pop(0))
        return 0

    def clicked(self, box: QMessageBox) -> QAbstractButton | None:
        wanted = box.property("clicked")
        buttons = {button.text().replace("&", ""): button for button in box.buttons()}
        assert wanted in buttons, (wanted, list(buttons))
        return buttons[wanted]

    def path(self, *_: object, **__: object) -> tuple[str, str]:
        assert self._paths, "no path is given to a file dialog"
        return self._paths.pop(0), "All files (*)"

    def text(self, box: QInputDialog) -> bool:
        self.labels.append(box.labelText())
        assert self._texts, f"nothing is typed: {box.windowTitle()}"
        box.setTextValue(self._texts.pop(0))
        return True


@pytest.fixture(autouse=True, scope="session")
def _english(qapp: QApplication) -> Iterator[None]:
    """Give the program its forms of numbers: ``1 value``, ``2 values``. Leave nothing in the clipboard: what
    is in it when Python ends is deleted without Python, which is a segmentation fault.
    """
    set_language("en")
    yield
    QGuiApplication.clipboard().clear()


@pytest.fixture
def german(qapp: QApplication) -> Iterator[None]:
    set_language("de")
    yield
    set_language("en")


@pytest.fixture
def user(monkeypatch: pytest.MonkeyPatch) -> Iterator[User]:
    """Return who answers message boxes, file and input dialogs; a question nobody expects fails the test."""
    who = User()
    monkeypatch.setattr(QMessageBox, "exec", lambda box: who.exec(box))  # noqa: PLW0108  # a bound method would not be given the box
    monkeypatch.setattr(QMessageBox, "clickedButton", lambda box: who.clicked(box))  # noqa: PLW0108  # likewise
    for name in ("getOpenFileName", "getSaveFileName"):
        monkeypatch.setattr(QFileDialog, name, who.path)
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *_, **__: who.path()[0])
    monkeypatch.setattr(QInputDialog, "exec", lambda box: who.text(box))  # noqa: PLW0108  # likewise
    yield who
    who.is_done()


@pytest.fixture
def accept(monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Return what makes the next dialogs of a class be filled in by ``fill(dialog)`` and accepted,
    as ``accept()`` does.
    """

    def arrange(kind: type[QWidget], fill: Callable[..., object] = lambda dialog: None) -> None:
        def run(dialog: QWidget) -> int:
            fill(dialog)
            assert doubled(texts_of(dialog)) == {}, "two controls have one Alt letter"
            dialog.accept()
            return int(dialog.result())

        monkeypatch.setattr(kind, "exec", run)

    return arrange


@pytest.fixture(scope="session")
def example(checkout: Path) -> bytes:
    """Return the content of the example mill: five axes, no errors."""
    return (checkout / "examples" / "mill-1394" / "MILL_1394.amp").read_bytes()


@pytest.fixture(scope="session")
def router(checkout: Path) -> bytes:
    """Return the content of the example router: the shortest report, and one page of pictures."""
    return (checkout / "examples" / "grblhal-router" / "GRBL_ROUTER.amp").read_bytes()


@pytest.fixture(scope="session")
def bare() -> bytes:
    """Return the content of a new file: five axes at their printed defaults, with its errors."""
    return content_of(new_file("9pc", "mill", ["X", "Y", "Z", "B", "S"], "bare"))


def new_window(path: Path | None = None) -> MainWindow:
    """Open a window on a file, or none, and wait until it has the keyboard."""
    window = MainWindow(opening=[str(path)] if path else [])
    Brush(window)
    # the least in which every panel has its own place; a smaller one is painted sooner
    window.resize(1200, 640)
    window.show()
    if path is not None:
        window.open_first(path)
    # After the file: where opening takes its time a progress dialog comes, and no window manager gives the
    # keyboard back.
    window.activateWindow()
    assert QTest.qWaitForWindowActive(window, WAIT_MS)
    return window


@pytest.fixture
def open_window(qtbot: QtBot, user: User) -> Iterator[Callable[..., MainWindow]]:
    """Return what opens a window on a file, or none; it is closed at the end, unsaved work thrown away."""
    windows: list[MainWindow] = []
    QSettings("AMP Studio", "AMP Studio").clear()

    def show(path: Path | None = None) -> MainWindow:
        windows.append(new_window(path))
        return windows[-1]

    yield show
    close_windows(windows)


@pytest.fixture(scope="module")
def _shared(
    qapp: QApplication, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Callable[[bytes], SharedWindow]]:
    """Return what gives the window that the tests of a module share for a content; made when one asks for
    it.
    """
    windows: dict[bytes, SharedWindow] = {}

    def of(content: bytes) -> SharedWindow:
        if content not in windows:
            path = tmp_path_factory.mktemp("shared") / "mill.amp"
            path.write_bytes(content)
            windows[content] = SharedWindow(path, new_window)
        return windows[content]

    yield of
    for each in windows.values():
        each.close()


@pytest.fixture
def window_with(
    user: User, checkout: Path, _shared: Callable[[bytes], SharedWindow]
) -> Iterator[Callable[..., MainWindow]]:
    """Return what gives a window with a file of this content open, or with that of a folder of examples, as a
    new one is: one of the module, in which what a test did is taken back after it.
    """
    given: list[SharedWindow] = []

    def give(content: bytes | str) -> MainWindow:
        if isinstance(content, str):
            content = next((checkout / "examples" / content).glob("*.amp")).read_bytes()
        shared = _shared(content)
        given.append(shared)
        window = shared.get()
        window.activateWindow()
        assert QTest.qWaitForWindowActive(window, WAIT_MS)
        return window

    yield give
    for each in given:
        each.put_back()


def is_shared(request: pytest.FixtureRequest) -> bool:
    """Return whether the window of a test is that of its module: not where it is marked with
    ``own_window``.
    """
    return "window" in request.fixturenames and not any(request.node.iter_markers("own_window"))


@pytest.fixture
def path(request: pytest.FixtureRequest, tmp_path: Path, example: bytes) -> Path:
    """Return the file of the window that is shared, else a copy of the example mill in a separate folder."""
    if is_shared(request):
        shared: SharedWindow = request.getfixturevalue("_shared")(example)
        return shared.path
    folder = tmp_path / "machine"
    folder.mkdir()
    path = folder / "mill.amp"
    path.write_bytes(example)
    return path


@pytest.fixture
def window(request: pytest.FixtureRequest, path: Path, example: bytes) -> MainWindow:
    """Return a window with the example mill open: the one of the module; a separate one where the module
    opens other files, or for a test that is marked with ``own_window``.
    """
    shared: SharedWindow = request.getfixturevalue("_shared")(example)
    made: MainWindow
    if is_shared(request) and path == shared.path:
        made = request.getfixturevalue("window_with")(example)
    else:
        made = request.getfixturevalue("open_window")(path)
    return made


@pytest.fixture
def workspace(request: pytest.FixtureRequest, qapp: QApplication, path: Path) -> Iterator[Workspace]:
    """Return the workspace of the window; without a window in the test, one that is alone."""
    if "window" in request.fixturenames:
        window: MainWindow = request.getfixturevalue("window")
        assert window.workspace is not None
        yield window.workspace
    else:
        alone = Workspace(Document.open(path))
        yield alone
        alone.close()


@pytest.fixture
def table(workspace: Workspace) -> ParameterTable:
    """Return a table of all parameters, without a window."""
    table = ParameterTable(workspace)
    table.show_parameters(list(workspace.file.schema.parameters.values()))
    return table


@pytest.fixture
def file(workspace: Workspace) -> ParameterFile:
    """Return the open file."""
    return workspace.file


@pytest.fixture
def whole(workspace: Workspace) -> Callable[[], tuple[object, ...]]:
    """Return what gives all that a save would write, and the findings:
    two of them are equal or something is left over.
    """

    def give() -> tuple[object, ...]:
        file = workspace.file
        return (
            dict(file.values),
            dict(file.forced),
            dict(vars(file.header)),
            dict(file.unknown),
            workspace.findings,
        )

    return give


def on_disk(path: Path) -> ParameterFile:
    """Return a file as it is on disk."""
    return open_file(path).file


def action(window: MainWindow, name: str) -> QAction:
    """Return a command of the menus by its name."""
    found = [a for path, a in commands(window.menuBar()) if path.split(" › ")[-1] == name]
    assert len(found) == 1, name
    return found[0]


def editor(window: MainWindow) -> QWidget:
    """Return the editor that is open in the table."""
    assert window.table_view is not None
    fields = [
        w
        for w in window.table_view.viewport().findChildren(
            QWidget, options=Qt.FindChildOption.FindDirectChildrenOnly
        )
        if w.isVisible() and (isinstance(w, QLineEdit) or hasattr(w, "rows_of"))
    ]
    assert len(fields) == 1, fields
    return fields[0]


class Control:
    """An emulated 9/PC with its operator, in a thread: a process would load the program for each."""

    def __init__(
        self, state: Path, *, estop: bool = True, file: ParameterFile | None = None, password: str = ""
    ) -> None:
        """Start one that contains a file, or a new one: a mill differs from that in 460 values."""
        file = file or new_file("9pc", "mill")
        identity = Identity("9pc", file.schema.signature, "CNC_1", "emulated")
        state.mkdir(exist_ok=True)
        memory = EmulatedMemory(
            state, identity, encode_image(file), estop=estop, autostart=True, accept=decode_image
        )
        typed, heard = queue.SimpleQueue[str](), queue.SimpleQueue[str]()
        self._typed, self._stop = typed, threading.Event()
        self._thread = threading.Thread(
            target=serve,
            args=(replace(parse_endpoint("tcp://127.0.0.1:0"), security=Security(password)), memory),
            kwargs={
                "patch": patch_image,
                "panel": NinePcPanel(axes_supported({})),
                "commands": iter(typed.get, ""),
                "say": heard.put,
                "stop": self._stop,
            },
            daemon=True,
        )
        self._thread.start()
        lines = iter(partial(heard.get, timeout=60), "")
        self.address = next(line for line in lines if line.startswith("listening on ")).split()[-1]

    def says(self, command: str) -> None:
        """Type a command at its panel: ``estop on``."""
        self._typed.put(command)

    def stop(self) -> None:
        """End it, with its line; stopping twice is no fault."""
        self._stop.set()
        self._typed.put("")  # the operator leaves
        self._thread.join(timeout=60)


class ControlProcess:
    """An emulated control of any family in a separate process."""

    def __init__(self, state: Path, family: str, machine: str) -> None:
        command = [
            sys.executable,
            "-m",
            "amp_studio.cli",
            "emulate",
            family,
            "--machine",
            machine,
            "--state",
            str(state),
            "--listen",
            "tcp://127.0.0.1:0",
        ]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        assert self._process.stdout is not None
        lines = (line for line in self._process.stdout if line.startswith("listening on "))
        self.address = next(lines).removeprefix("listening on ").strip()

    def stop(self) -> None:
        """End the process; stopping twice is no fault."""
        if self._process.poll() is not None:
            return
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.close()
        self._process.stdout.close()
        self._process.terminate()
        self._process.wait(timeout=60)


@pytest.fixture
def start_control(tmp_path: Path) -> Iterator[Callable[..., Control | ControlProcess]]:
    """Return what starts an emulated control; it ends with the test."""
    controls: list[Control | ControlProcess] = []

    def start(family: str = "9pc", **kind: Any) -> Control | ControlProcess:
        state = tmp_path / f"control-{len(controls)}"
        made = Control(state, **kind) if family == "9pc" else ControlProcess(state, family, **kind)
        controls.append(made)
        return made

    yield start
    for control in controls:
        control.stop()


def during(act: Callable[[ProgressDialog], object], when: Callable[[], bool] = lambda: True) -> None:
    """Do something once while a progress dialog is to be seen and ``when`` is true."""
    timer = QTimer(QApplication.instance())

    def look() -> None:
        dialog = QApplication.activeModalWidget()
        if isinstance(dialog, ProgressDialog) and dialog.isVisible() and when():
            timer.stop()
            act(dialog)

    timer.timeout.connect(look)
    timer.start(5)
