"""Draw every page of the window without a display: light and dark, English and German,
for documents and for review.

The files are copies of the examples with fixed times; nothing of the person who runs it is read or written.
"""

import argparse
import contextlib
import os
import shutil
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import Any
from unittest import mock

TOP = Path(__file__).resolve().parents[1]
OUT = TOP / "build" / "screenshots"
WORK = TOP / "build" / "screenshots-work"
MOMENT = 1_773_305_100
"""12 March 2026, 08:45 UTC: when every file was last changed."""
LARGE = (1440, 900)
DOUBLED = (960, 540)
"""Of a screen of 1920 x 1080 at 200 %, in logical pixels; drawn in twice as many."""
SIZES = (LARGE, (1024, 700), (1366, 768), (2560, 1440), DOUBLED)
DARK = (LARGE, (1024, 700))
"""The sizes of which there is a dark picture too."""
PATIENCE = 900.0
"""Seconds after which a page that is not ready ends the run: one that never will be,
whatever else the computer does."""

# Before anything imports Qt or asks where the user's folders are.
os.environ |= {"QT_QPA_PLATFORM": "offscreen", "TZ": "UTC", "USER": "operator", "LOGNAME": "operator"}
os.environ |= {f"XDG_{n}_HOME": str(WORK / "home" / n.lower()) for n in ("CACHE", "CONFIG", "DATA", "STATE")}
sys.path.insert(0, str(TOP))

from page_pictures import IMAGES, draw_documents  # noqa: E402  # Qt reads the environment that is set above
from PySide6.QtCore import QEventLoop, QPoint, QSettings, Qt, QTimer  # noqa: E402  # after the folders are set
from PySide6.QtGui import QPainter, QPixmap  # noqa: E402  # Qt reads the environment that is set above
from PySide6.QtTest import QTest  # noqa: E402  # Qt reads the environment that is set above
from PySide6.QtWidgets import QApplication, QWidget  # noqa: E402  # Qt reads the environment that is set above

from amp_studio.files import Document, ParameterFile, Project, ProjectInfo, new_file  # noqa: E402  # Qt reads the environment that is set above
from amp_studio.files.storage import save_file  # noqa: E402  # Qt reads the environment that is set above
from amp_studio.schema import Value  # noqa: E402  # Qt reads the environment that is set above
from amp_studio.ui.actions import project  # noqa: E402  # Qt reads the environment that is set above
from amp_studio.ui.base.task import Task  # noqa: E402  # Qt reads the environment that is set above
from amp_studio.ui.base.theme import scheme  # noqa: E402  # Qt reads the environment that is set above
from amp_studio.ui.base.translated import set_language, tr  # noqa: E402  # Qt reads the environment that is set above
from amp_studio.ui.base.workspace import Workspace  # noqa: E402  # Qt reads the environment that is set above
from amp_studio.ui.main_window import MainWindow  # noqa: E402  # Qt reads the environment that is set above
from amp_studio.ui.window.settings import UserSettings  # noqa: E402  # Qt reads the environment that is set above

EXCESS, RAPID, CALIBRATION = ("servo.excess_error", "1"), ("feedrate.rapid", "1"), ("home.calibration", "1")


ENDLESS: set[Task] = set()
"""Work that only ends with its page: nothing waits for it."""


def settle(ready: Callable[[], object] = lambda: Task.running <= ENDLESS) -> None:
    """Let the window work until it is ready; raises TimeoutError."""
    end = time.monotonic() + PATIENCE
    while not ready():
        if time.monotonic() > end:
            raise TimeoutError("a page did not become ready")
        pause(10)
    for _ in range(3):
        pause(5)


def pause(milliseconds: int) -> None:
    """Let the window and its threads work for a moment; ``QTest.qWait`` would keep the threads waiting."""
    loop = QEventLoop()
    QTimer.singleShot(milliseconds, loop.quit)
    loop.exec()


def picture(widget: QWidget, scale: int = 1) -> QPixmap:
    """Return a window as it is, with what is open over it."""
    drawn = QPixmap(widget.size() * scale)
    drawn.setDevicePixelRatio(scale)
    widget.render(drawn)
    over = QApplication.activePopupWidget()
    if over is not None and over is not widget:
        painter = QPainter(drawn)
        painter.drawPixmap(widget.mapFromGlobal(over.mapToGlobal(QPoint(0, 0))), over.grab())
        painter.end()
    return drawn


class Photographer:
    """Keeps each page in both colours."""

    def __init__(self, language: str, only: str, sizes: Sequence[tuple[int, int]] = SIZES) -> None:
        self.language, self.only, self.sizes, self.count = language, only, sizes, 0

    def wants(self, name: str) -> bool:
        """Return whether a page was asked for."""
        return self.only in name

    def take(self, name: str, widget: QWidget, sizes: tuple[tuple[int, int], ...] = ()) -> None:
        """Write a page in light and in dark, in each size of the window or in its own."""
        if not self.wants(name):
            return
        for size in [size for size in sizes if size in self.sizes] or (None,):
            if size:
                widget.resize(*size)
                settle()
                if (widget.width(), widget.height()) != size:
                    sys.stdout.write(f"{name}-{self.language}: {size} became {widget.size().toTuple()}\n")
            for colours in ("light", "dark") if size is None or size in DARK else ("light",):
                scheme().choose(colours)
                settle()
                suffix = "" if size is None or size == LARGE else f"-{size[0]}x{size[1]}"
                path = OUT / f"{name}-{colours}-{self.language}{suffix}.png"
                picture(widget, 2 if size == DOUBLED else 1).save(str(path))
                self.count += 1
            scheme().choose("light")
        if sizes:
            widget.resize(*LARGE)


class Stage:
    """The window on copies of the examples."""

    def __init__(self, photographer: Photographer) -> None:
        self.photographer, self.take = photographer, photographer.take
        shutil.rmtree(WORK, ignore_errors=True)
        self.files = WORK / "machines"
        shutil.copytree(TOP / "examples", self.files)
        for path in self.files.rglob("*"):
            os.utime(path, (MOMENT, MOMENT))
        QSettings("AMP Studio", "AMP Studio").clear()
        UserSettings().keep_language(photographer.language)
        self.window: Any = MainWindow()  # a file is open on every page but the first
        self.window.resize(*LARGE)
        self.window.show()
        settle()

    def take_keyboard(self) -> None:
        """Let keys go to the window: no window manager gives the keyboard back after a progress dialog,
        which a slow computer shows.
        """
        self.window.activateWindow()
        settle(self.window.isActiveWindow)

    def path(self, folder: str) -> Path:
        """Return the parameter file of an example: a copy that was kept beside it has a longer name."""
        return min((self.files / folder).glob("*.amp"), key=lambda path: len(path.name))

    @contextlib.contextmanager
    def beside(self, kind: str) -> Iterator[Any]:
        """Give the side window of a class once it is open, which may wait for what it needs;
        close it afterwards.
        """

        def found() -> list[QWidget]:
            parts = self.window.findChildren(QWidget)
            return [w for w in parts if type(w).__name__ == kind and w.isVisible()]

        settle(found)
        window = found()[-1]
        yield window
        window.close()
        QTest.qWait(1)

    def show_new(self, name: str, file: ParameterFile) -> None:
        """Show a file that is not among the examples."""
        path = self.files / "new" / name
        path.parent.mkdir(exist_ok=True)
        self.window.show_workspace(Workspace(Document.create(file, path)))
        os.utime(path, (MOMENT, MOMENT))

    # -- pages ---------------------------------------------------------------------------

    def welcome(self) -> None:
        """The page that is there before a file is open."""
        settle(lambda: self.window.welcome.has_facts)
        self.take("01-welcome", self.window, SIZES)

    def steps(self) -> None:
        """A new mill at its steps."""
        file = new_file("9pc", "mill", ["X", "Y", "Z"])
        for axis in "123":
            file.set(("servo.hardware_type", axis), Value("sercos"))
            file.set(("servo.loop_type", axis), Value("digital"))
        self.show_new("NEW_MILL.amp", file)
        self.take("02-steps", self.window, SIZES)

    def main(self) -> None:
        """Groups, project, findings, filters and the find box on the example mill."""
        window = self.window
        window.open_first(self.path("mill-1394"))
        settle()
        window.go_to(EXCESS)
        self.take("03-groups", window, SIZES)
        window.page.left.show_side("project")
        self.take("04-project", window, SIZES)
        window.page.left.show_side("groups")
        window.workspace.edit("excess error", {EXCESS: Value(0.001, "mm")})
        window.workspace.edit("loops", {("servo.position_loop_type", a): Value("open") for a in "123"})
        window.workspace.edit("home", {CALIBRATION: Value(1.0, "mm")})
        window.show_panel("Findings")
        self.take("05-findings", window, SIZES)
        window.page.filters.choose("unsaved", True)
        self.take("06-filters", window, SIZES)
        window.page.filters.clear()

    def refusal(self) -> None:
        """A value that is out of range, refused in its cell."""
        view = self.window.table_view
        self.window.go_to(EXCESS)
        self.take_keyboard()
        view.setFocus()
        view.edit_current()
        settle(QApplication.focusWidget)
        field: Any = QApplication.focusWidget()
        QTest.keyClick(field, Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
        QTest.keyClicks(field, "99999999 mm")
        QTest.keyClick(field, Qt.Key.Key_Return)
        self.take("07-refusal", self.window, SIZES)
        QTest.keyClick(QApplication.focusWidget() or field, Qt.Key.Key_Escape)

    def find(self) -> None:
        """The find box with what it found."""
        box = self.window.finder.box
        box.begin("excess")
        settle(lambda: self.window.finder._finder() is not None)
        for text in ("servo amp fe limits", "exess error"):
            box.begin(text)
            settle()
            self.take("08-find-message" if "fe" in text else "09-find-typing-error", self.window, SIZES)
        box.close_list()
        box.clear()

    def pictures(self) -> None:
        """Every picture of the mill, all at once and one by one."""
        page = self.window.page
        self.window.menus["view.pictures"].trigger()
        page.pictures.show_picture("all")
        self.take("10-pictures", self.window, SIZES)
        for name in page.pictures._pictures:
            page.pictures.show_picture(name)
            self.take(f"11-picture-{name}", self.window, SIZES)
        self.window.menus["view.pictures"].trigger()

    def compare(self) -> None:
        """Two sources, then three with a conflict."""
        from amp_studio.ui.merge.columns import BASE, A, B
        from amp_studio.ui.merge.sources import MergeSource

        window = self.window
        base, other = window.workspace.file.copy(), window.workspace.file.copy()
        shown = window.files.comparing.open(window.page)
        other.set(EXCESS, Value(13.0, "mm"))
        other.set(RAPID, Value(190.0, "mm/s"))
        source = MergeSource("MILL_1394.amp", "hall 2", other)
        shown.show_merge({A: shown.sources.now(), B: source})
        self.take("12-compare-two", shown, SIZES)
        base.set(EXCESS, Value(11.0, "mm"))
        base.set(CALIBRATION, Value(0.0, "mm"))
        shown.show_merge({A: shown.sources.now(), B: source, BASE: MergeSource(tr("Last saved"), "", base)})
        self.take("13-compare-three", shown, SIZES)
        shown.close()

    def exchange(self) -> None:
        """What a download would change, and what was exchanged before."""
        from amp_studio.transfer.client.record import RecordedExchange, add_exchange

        workspace = self.window.workspace
        self.control_page()
        for when, verb, text in (
            ("2026-03-10T07:12:00Z", "upload", "written into MILL_1394.amp"),
            ("2026-03-12T08:30:00Z", "download", "complete and read back equal"),
        ):
            add_exchange(
                workspace.path,
                RecordedExchange(
                    when,
                    "operator",
                    verb,
                    workspace.path.name,
                    "9pc",
                    "tcp://192.168.0.20:4001",
                    "3f6c1a90be52",
                    "a14be0097d21",
                    "new" if verb == "download" else "",
                    "",
                    text,
                    (("1400 Home Calibration, X", "0.5 mm", "1 mm"),) if verb == "download" else (),
                ),
            )
        page = self.window.control
        page.recorded()
        self.take("15-history", self.window, SIZES)
        page.several()
        self.take("15-several", self.window, SIZES)
        page.show("hand")
        self.take("15-by-hand", self.window, SIZES)

    def control_page(self) -> None:
        """The page at the control: without E-stop, with differences, sent, not reached."""
        from amp_studio.ui.base.emulated_control import EmulatedControl

        emulated = EmulatedControl(self.window)
        emulated.start("9pc", "mill")
        settle(lambda: emulated.address)
        control, window = self.window.control, self.window
        window.save()  # the saved file is sent
        settle()
        control.exchanges.choose(window.workspace, emulated.address)
        emulated.send("estop off")
        control.show("send")
        settle(lambda: control.page.session.in_estop is False or control.page.session.ask())
        self.take("14-control-estop", window, SIZES)
        emulated.send("estop on")
        settle(lambda: control.page.session.in_estop or control.page.session.ask())
        self.take("14-control-differences", window, SIZES)
        control.page.checked.setChecked(True)
        control.page.press()
        settle()
        self.take("14-control-done", window, SIZES)
        emulated.stop(wait=True)
        control.page.connect_again()
        settle()
        self.take("14-control-away", window, SIZES)
        control.leave()

    def live(self) -> None:
        """What emulated controls show of themselves beside the file: values that differ, one turned, a
        fault.
        """
        for folder, fault in (("57c422b-label-press", "fault drive X"), ("grblhal-router", "alarm 9")):
            self._live_of(folder, fault)
        self.window.open_first(self.path("mill-1394"))

    def _live_of(self, folder: str, fault: str) -> None:
        window, control = self.window, self.window.control
        window.open_first(self.path(folder))
        control.start_emulated()
        settle(lambda: control.emulated.address)
        window.menus["control.live"].trigger()
        page = window.page.pages["live"]
        settle(lambda: page.is_live and page.panel.readings.isEnabled())
        ENDLESS.add(page.readings._task)
        page.frame.step(1)
        self.take(f"15-live-{folder}", window, SIZES)
        control.emulated.send(fault)
        settle(page.panel.faults.isVisible)
        self.take(f"15-live-{folder}-fault", window, SIZES)
        window.menus["control.live"].trigger()
        control.emulated.stop(wait=True)
        settle(lambda: not Task.running)
        ENDLESS.clear()

    def motion(self) -> None:
        """A simulated movement."""
        self.window.go_to(("feedrate.rapid", "1"))
        self.window.menus["view.motion"].trigger()
        view = self.window.page.pages["motion"]
        settle(lambda: view.trace is not None and not Task.running)
        self.take("16-motion", self.window, SIZES)
        self.window.page.show_page("")

    def tuning(self) -> None:
        """Every step of the page of tuning."""
        self.window.menus["view.tuning"].trigger()
        tuning = self.window.page.pages["tuning"]
        for n in range(tuning.pages.count()):
            tuning.pages.setCurrentRow(n)
            settle()
            self.take(f"17-tuning-{n + 1}", self.window, SIZES)
        self.window.page.show_page("")

    def machine(self) -> None:
        """The machine checked and drawn: a homing on a short switch, what is not good, tapping."""
        self.window.menus["view.check"].trigger()
        check = self.window.page.pages["check"]
        settle(lambda: check.checks and not Task.running)
        check.choose("home", "1")
        check.card.length.setText("5 mm")
        check.card.length.returnPressed.emit()
        self.take("17-machine", self.window, SIZES)
        check.choose("velocity", "1")
        self.take("17-machine-doubtful", self.window, SIZES)
        check.choose("tap", "")
        self.take("17-machine-tapping", self.window, SIZES)
        self.window.page.show_page("")

    def program(self) -> None:
        """A part program of the router: its path, what limits it, and another value."""
        window = self.window
        window.open_first(self.path("acromill-router"))
        window.menus["view.program"].trigger()
        page = window.page.pages["program"]
        self.take("17-program-empty", window, SIZES)
        page.open_program(self.path("acromill-router").with_name("plate.nc"))
        settle(lambda: page.outcome is not None and not Task.running)
        page.change_form.set_answer("change", "speeds.rapid=150")
        page.change_form.entered.emit("change")
        settle(lambda: page.tries.table.rowCount() == 1)
        page.play.slider.setValue(500)
        self.take("17-program", window, SIZES)
        window.page.show_page("")

    def migration(self) -> None:
        """The questions of the way to another control."""
        self.window.open_first(self.path("mill-1394"))
        self.window.menus["file.migrate"].trigger()
        with self.beside("MigrationWindow") as shown:
            settle()
            self.take("29-migration", shown, SIZES)

    def dialogs(self) -> None:
        """Calculator, tables, steps of undo, and the dialog of a new file."""
        from amp_studio.ui.dialogs.file_dialogs import ReportDialog
        from amp_studio.ui.dialogs.new_file_dialog import NewFileDialog

        self.window.go_to(("servo.lead_screw_pitch", "1"))
        for n, (act, kind, name) in enumerate(
            (
                (self.window.edits.calculator, "CalculatorDialog", "calculator"),
                (self.window.edits.tables, "TablesDialog", "tables"),
                (self.window.edits.steps, "StepList", "undo"),
            ),
            18,
        ):
            act()
            with self.beside(kind) as dialog:
                self.take(f"{n}-{name}", dialog)
        for name, dialog in (
            ("21-new", NewFileDialog(self.window, "9pc")),
            (
                "22-report",
                ReportDialog(self.window.workspace.path, self.window, self.window.report_options.contents),
            ),
        ):
            dialog.show()
            self.take(name, dialog)
            dialog.close()

    def preview(self) -> None:
        """The report beside the table, at the page of the selected value; and what it contains."""
        with mock.patch("amp_studio.report.build.datetime") as clock:
            clock.now.return_value = datetime.fromtimestamp(MOMENT, UTC)
            self._preview()

    def _preview(self) -> None:
        window = self.window
        window.go_to(EXCESS)
        window.menus["view.preview"].trigger()
        settle(lambda: window.preview.panel is not None and window.preview.panel.view.places)
        settle(lambda: window.preview.panel.is_settled)
        self.take("24-preview", window, SIZES)
        head = window.preview.panel.head
        head.menu.popup(head.mapToGlobal(head.rect().bottomLeft()))
        self.take("25-preview-contents", head.menu)
        head.menu.close()
        self.template()
        window.resize(*LARGE)
        window.menus["view.preview"].trigger()

    def template(self) -> None:
        """The cover by the template to begin with, and a mistake in it."""
        from amp_studio.report.templating.starting import write_starting_template

        panel, folder = self.window.preview.panel, self.window.workspace.path.parent
        path = write_starting_template(folder)
        settle(lambda: "= Service" in panel.source)
        settle(lambda: panel.is_settled)
        panel.view.go_to_page(1)
        self.take("27-preview-template", self.window, SIZES)
        path.write_text(path.read_text("utf-8").replace("= Service", "= Service\n#telefone"), "utf-8")
        settle(panel.bar.isVisible)
        self.take("28-preview-mistake", self.window, SIZES)
        shutil.rmtree(path.parent)
        settle(panel.bar.isHidden)

    def machines(self) -> None:
        """Machines of a project side by side."""
        folder = self.window.workspace.path.parent
        for n, rate in ((2, 165.0), (3, 190.0), (4, 165.0)):
            file = self.window.workspace.file.copy()
            file.set(RAPID, Value(rate, "mm/s"))
            file.set(CALIBRATION, Value(0.25 * n, "mm"))
            save_file(file, folder / f"MILL_{n}.amp")
        if self.window.project is None:
            self.window.project = Project.create(folder, ProjectInfo("HALL_2", "9pc"))
        project.compare(self.window)
        with self.beside("MachinesDialog") as dialog:
            self.take("26-machines", dialog)

    def project_check(self) -> None:
        """The findings of several files."""
        import threading

        from amp_studio.ui.project.check import ProjectCheckDialog, check_files

        paths = sorted(self.files.glob("*/*.amp"))
        checked = check_files(paths, lambda *_: None, threading.Event())
        dialog = ProjectCheckDialog(checked, lambda *_: None, self.window)
        dialog.show()
        self.take("23-project-check", dialog)
        dialog.close()

    def families(self) -> None:
        """The other families, each with its pictures."""
        for n, folder in enumerate(
            ("num-1060-mill", "acromill-router", "57c422b-label-press", "grblhal-router", "syntec-mill"), 30
        ):
            self.window.open_first(self.path(folder))
            settle()
            self.take(f"{n}-{folder}", self.window, SIZES)
            self.window.menus["view.pictures"].trigger()
            self.take(f"{n}-{folder}-pictures", self.window, SIZES)
            self.window.menus["view.pictures"].trigger()

    def close(self) -> None:
        """End without a question."""
        self.window.may_leave = lambda *_: True
        self.window.close()
        self.window.deleteLater()
        QApplication.processEvents()


PAGES: tuple[Callable[[Stage], None], ...] = (
    Stage.welcome,
    Stage.steps,
    Stage.main,
    Stage.refusal,
    Stage.find,
    Stage.pictures,
    Stage.compare,
    Stage.exchange,
    Stage.live,
    Stage.motion,
    Stage.tuning,
    Stage.machine,
    Stage.program,
    Stage.migration,
    Stage.dialogs,
    Stage.preview,
    Stage.project_check,
    Stage.machines,
    Stage.families,
)


def draw(language: str, only: str, sizes: Sequence[tuple[int, int]]) -> int:
    """Draw all pages in a language; returns how many pictures were written."""
    set_language(language)
    stage = Stage(Photographer(language, only, sizes))
    for page in PAGES:
        page(stage)
    stage.close()
    return stage.photographer.count


def main() -> int:
    """Draw what the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--language", choices=("en", "de"), action="append", help="default: both")
    parser.add_argument("--only", default="", help="pages whose name contains this")
    parser.add_argument(
        "--size", choices=[f"{w}x{h}" for w, h in SIZES], action="append", help="default: all"
    )
    parser.add_argument("--documents", action="store_true", help="only the pictures of README and the pages")
    chosen = parser.parse_args()
    OUT.mkdir(parents=True, exist_ok=True)
    application = QApplication(["amp-studio"])
    application.setCursorFlashTime(0)  # a cursor that blinks makes two pictures of one
    start = time.monotonic()
    count = 0
    sizes = [size for size in SIZES if not chosen.size or f"{size[0]}x{size[1]}" in chosen.size]
    if not chosen.documents:
        count += sum(map(partial(draw, only=chosen.only, sizes=sizes), chosen.language or ("en", "de")))
    if chosen.documents or not (chosen.only or chosen.language):
        set_language("en")
        count += draw_documents(lambda: Stage(Photographer("en", "")))
    application.quit()
    sys.stdout.write(f"{count} pictures in {OUT} and {IMAGES} after {time.monotonic() - start:.0f} s\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
