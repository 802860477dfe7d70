"""Every page on real screens, in both languages and colours: no text is cut, nothing overlaps,
and ink can be read on its ground.
"""

import re
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtGui import QFontMetrics, QImage, QPixmap, QTextDocument
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QApplication,
    QBoxLayout,
    QComboBox,
    QGridLayout,
    QHeaderView,
    QLabel,
    QLineEdit,
    QListView,
    QSplitter,
    QTabBar,
    QTableView,
    QToolButton,
    QTreeView,
    QWidget,
)

from amp_studio.drawing import THIN
from amp_studio.schema import Value
from amp_studio.sim import LimitUse, MotionCheck, Trace
from amp_studio.transfer import AxisStatus, ControlStatus, known_fault
from amp_studio.ui.base.task import Task
from amp_studio.ui.base.theme import font, scheme
from amp_studio.ui.base.translated import set_language
from amp_studio.ui.forms.elided_label import ElidedLabel
from amp_studio.ui.forms.list_title import ListTitle
from amp_studio.ui.live.page import LiveView
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.motion.tuning_page import TuningView
from amp_studio.ui.motion.tuning_steps import TuningSteps
from amp_studio.ui.table.table_heads import AxisHeads
from tests.campaigns import CAMPAIGN

from .test_live import StoppedReadings, StoppedSession

SCREENS = ((1024, 700), (1366, 768), (2560, 1440), (960, 540))
"""The last is a screen of 1920 x 1080 at 200 %."""
OF_LANGUAGE = {"en": (min(SCREENS),), "de": (min(SCREENS), max(SCREENS))}
"""The screens that are tried each time: English is the shorter language."""


def findings(window: MainWindow) -> None:
    window.workspace.edit("error", {("servo.excess_error", "1"): Value(0.001, "mm")})
    window.show_panel("Findings")


def show_live(window: MainWindow) -> None:
    """Show Live with a reading, a fault, and a control that takes single values."""
    workspace = window.workspace_in_front
    window.control.exchanges.choose(workspace, "tcp://127.0.0.1:1")
    window.menus["control.live"].trigger()
    page = window.page_in_front.pages["live"]
    assert isinstance(page, LiveView)
    session: Any = StoppedSession(workspace.file.copy())
    readings: Any = StoppedReadings()
    page.use(session, "bench", "CNC_1", readings=readings)
    page.start()
    axis = AxisStatus("X", -123.4567, 0.0123, 45.0, "mm", ("homed",), ("homed", "moving"), "R72 = 0085H")
    fault = known_fault("9pc", "SERVO AMPLIFIER FAULT", "SERVO AMPLIFIER FAULT", "X")
    page.show_status(ControlStatus("9pc", "screen", "CNC_1", "ready", (axis,), (fault,)))


TUNED = {
    "Ms": (1.24, ""),
    "phase_margin": (88.3, "deg"),
    "gain_margin": (21.5, "dB"),
    "bandwidth": (2.27, "Hz"),
    "stiffness": (0.00243, "mm/%"),
    "velocity_loop_Ms": (1.29, ""),
}


def show_steps_of_tuning(window: MainWindow) -> None:
    """Show a printed way of tuning with figures of both loops, which are not sought here."""
    if not window.menus["view.tuning"].isChecked():
        window.menus["view.tuning"].trigger()
    page = window.page_in_front.pages["tuning"]
    assert isinstance(page, TuningView)
    page.pages.setCurrentRow(page.pages.count() - 1)
    (steps,) = page.guided
    figures = {f"{name}_before": figure for name, figure in TUNED.items()} | TUNED
    trace = Trace("tune", "1", "", {}, {}, figures, (), (), (), {})
    steps.figures.setText(steps._figures_text(trace))


PAGES: dict[str, Callable[[MainWindow], object]] = {
    "pictures": lambda window: window.menus["view.pictures"].trigger(),
    "values": lambda window: window.menus["view.pictures"].trigger(),
    "steps": lambda window: window.page.left.show_side("steps"),
    "project": lambda window: window.page.left.show_side("project"),
    "findings": findings,
    "preview": lambda window: window.menus["view.preview"].trigger(),
    "send": lambda window: window.control.show("send"),
    "several controls": lambda window: window.control.several(),
    "by hand": lambda window: window.control.show("hand"),
    "exchanges": lambda window: window.control.recorded(),
    "motion": lambda window: window.menus["view.motion"].trigger(),
    "tuning": lambda window: window.menus["view.tuning"].trigger(),
    "steps of tuning": show_steps_of_tuning,
    "program": lambda window: window.menus["view.program"].trigger(),
    "machine": lambda window: window.menus["view.check"].trigger(),
    "live": show_live,
}
MAX_ROWS = 60
"""Rows of a table that are checked."""
CHECKS = (
    MotionCheck("home", "1", "X", "bad", {"home_grid": (6.0, "%")}, part="homing", headline="home_grid"),
    MotionCheck(
        "step",
        "1",
        "X",
        "doubtful",
        why="too little margin",
        use=LimitUse(1.2, "excess error", 12.0, 10.0, "mm"),
    ),
    MotionCheck("travel", "4", "B", "not possible", why="No limit is active", part="travel"),
    MotionCheck("spindle", "", "", "good", {"speed": (6000.0, "rpm")}, part="spindle", headline="speed"),
)


@pytest.fixture(autouse=True)
def _no_motion(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the preview draw no motion, which takes seconds: test_preview.py has it."""
    monkeypatch.setattr("amp_studio.dossier.motion_apart", lambda file: ())
    monkeypatch.setattr("amp_studio.ui.motion.check_page.check_motion", lambda file: iter(CHECKS))
    monkeypatch.setattr(TuningSteps, "run", lambda _steps: None)


@pytest.fixture(params=("en", "de"))
def language(request: pytest.FixtureRequest, qapp: QApplication) -> Iterator[str]:
    set_language(request.param)
    yield request.param
    set_language("en")
    scheme().choose("light")


def settled() -> None:
    """Wait for the threads that fill a page, and let the layouts come to their end."""
    for task in list(Task.running):
        task.wait()
    for _ in range(4):
        QApplication.processEvents()


def texts(window: QWidget) -> Iterator[tuple[QWidget, str]]:
    """Yield what is seen and has a text that is to be read whole."""
    for widget in window.findChildren(QWidget):
        if (
            not widget.isVisible()
            or widget.visibleRegion().isEmpty()
            or isinstance(widget, (ElidedLabel, ListTitle))
        ):
            continue
        if isinstance(widget, QComboBox):
            yield widget, widget.currentText()
        elif (
            isinstance(widget, QToolButton)
            and widget.toolButtonStyle() == Qt.ToolButtonStyle.ToolButtonIconOnly
        ):
            continue
        elif isinstance(widget, (QLabel, QAbstractButton)) and widget.text():
            yield widget, widget.text()


def is_hint_cut(field: QLineEdit) -> bool:
    """Whether an empty field has no room for what it is for."""
    wide = field.fontMetrics().horizontalAdvance(field.placeholderText())
    return (
        bool(wide) and not field.text() and wide > field.width() - 2 * max(8, field.cursorRect().center().x())
    )


def squeezed(window: MainWindow) -> Iterator[tuple[str, str]]:
    """Yield each column that has less room than its texts while others, or none, have it to spare."""
    for view in window.findChildren(QAbstractItemView):
        head = view.horizontalHeader() if isinstance(view, QTableView) else None
        head = view.header() if isinstance(view, QTreeView) else head
        if head is None or not view.isVisible():
            continue
        columns = [n for n in range(head.count()) if not head.isSectionHidden(n)]
        needs = {n: max(view.sizeHintForColumn(n), head.sectionSizeHint(n)) for n in columns}
        spare = sum(max(0, head.sectionSize(n) - needs[n]) for n in columns)
        spare += max(0, view.viewport().width() - head.length())
        for n in columns:
            missing = needs[n] - head.sectionSize(n)
            if 0 < missing <= spare:
                title = head.model().headerData(n, Qt.Orientation.Horizontal)
                yield type(view).__name__, f"{title}: {missing} of {spare} to spare"


def is_broken(table: QLabel) -> bool:
    """Whether a word of a table, as a unit, goes on in the next line, or the table needs more room."""
    document = QTextDocument()
    document.setDefaultFont(table.font())
    document.setDocumentMargin(0)
    document.setHtml(table.text())
    document.setTextWidth(table.width())
    document.size()  # lays it out
    block, broken = document.begin(), document.idealWidth() > table.width() + 1
    while block.isValid():
        lines = [block.layout().lineAt(n) for n in range(block.layout().lineCount())]
        ends = [line.textStart() + line.textLength() for line in lines[:-1]]
        broken = broken or any(not block.text()[end - 1].isspace() for end in ends)
        block = block.next()
    return broken


def is_cut(widget: QWidget) -> bool:
    if isinstance(widget, QLabel) and "<td" in widget.text():
        return is_broken(widget)
    if isinstance(widget, QLabel) and widget.wordWrap():
        return widget.heightForWidth(widget.width()) > widget.height() + 1
    return widget.sizeHint().width() > widget.width() + 1


def width_of_axis(letter: str, what: str) -> int:
    """Return the width of the head of an axis, whose letter is larger than what it is."""
    strong = font("text")
    strong.setWeight(strong.Weight.DemiBold)
    letters, small = (QFontMetrics(each) for each in (strong, font("caption")))
    return letters.horizontalAdvance(letter) + small.horizontalAdvance(what) + 20 * bool(letter)


def heads(window: QWidget) -> Iterator[tuple[str, str]]:
    """Yield each painted head of a column that has less room than its text, by the class of its view."""
    for header in window.findChildren(QHeaderView):
        if not header.isVisible() or header.orientation() != Qt.Orientation.Horizontal:
            continue
        for n in range(header.count()):
            text = str(header.model().headerData(n, header.orientation(), Qt.ItemDataRole.DisplayRole) or "")
            measure = header.fontMetrics()
            wide = max((measure.horizontalAdvance(line) for line in text.splitlines()), default=0)
            if isinstance(header, AxisHeads):
                wide = width_of_axis(*header._table.column_head(n))
            place = header.sectionViewportPosition(n)
            is_seen = not header.isSectionHidden(n) and 0 <= place < header.viewport().width()
            if is_seen and wide > header.sectionSize(n):
                yield type(header.parent()).__name__, text


NUMBER = re.compile(r"[-−]?\d[\d\u202f.,]*(?: [^\s\d]\S*)?")


def cells(window: QWidget) -> Iterator[tuple[str, str]]:
    """Yield each painted number that has less room than its digits and its unit."""
    for view in window.findChildren(QAbstractItemView):
        model = view.model()
        if not view.isVisible() or model is None or isinstance(view, QHeaderView):
            continue
        for row in range(min(model.rowCount(), MAX_ROWS)):
            for column in range(1 if isinstance(view, QListView) else model.columnCount()):
                index = model.index(row, column)
                text, box = str(index.data() or ""), view.visualRect(index)
                is_seen = box.isValid() and view.viewport().rect().contains(box)
                wide = view.fontMetrics().horizontalAdvance(text)
                if is_seen and NUMBER.fullmatch(text) and wide > box.width():
                    yield type(view).__name__, text


RAW = re.compile(
    r"(?<![\w.$@)\]:/-])-(?=\d)"  # a hyphen for a minus
    r"|(?<![\w.$@:/−\u202f-])[1-9]\d{4,}(?![\w:/-])(?! [A-Z])"  # more than four digits without groups
)
"""A number that is not written as the cells of the table have it; neither an address nor a part of a path."""


RAW_KEY = re.compile(r"\b[a-z0-9_]+\.[a-z0-9_]+@")
"""The address of a value as files and commands have it: a person has names and letters."""


def unreadable(window: QWidget) -> Iterator[tuple[str, str]]:
    """Yield what is seen with a raw address, or a number in another form than that of the cells."""
    seen = [(widget, re.sub("<[^<>]*>|&#[0-9]+;", "", text)) for widget, text in texts(window)]
    for view in window.findChildren(QAbstractItemView):
        model = view.model()
        if not view.isVisible() or model is None or isinstance(view, QHeaderView):
            continue
        for row in range(min(model.rowCount(), MAX_ROWS)):
            for column in range(1 if isinstance(view, QListView) else model.columnCount()):
                text = str(model.index(row, column).data() or "")
                if column or not text.isdecimal():  # a number alone at the left is that of a parameter
                    seen.append((view, text))
    for label in window.findChildren(QLabel):
        if label.isVisible() and THIN in label.text() and Qt.mightBeRichText(label.text()):
            yield "breaks in a number", label.text()
    for widget, text in seen:
        if RAW.search(text) or RAW_KEY.search(text):
            yield type(widget).__name__, text


def overlaps(window: QWidget) -> Iterator[tuple[str, str, str]]:
    for parent in window.findChildren(QWidget):
        layout = parent.layout()
        if not isinstance(
            layout, (QBoxLayout, QGridLayout)
        ):  # those of Qt's own windows overlap as they like
            continue
        below = (
            child for child in parent.children() if isinstance(child, QWidget) and layout.indexOf(child) >= 0
        )
        there = [w for w in below if w.isVisible() and not w.visibleRegion().isEmpty()]
        for n, one in enumerate(there):
            for other in there[n + 1 :]:
                both = one.geometry() & other.geometry()
                if both.width() > 1 and both.height() > 1:
                    yield type(parent).__name__, type(one).__name__, type(other).__name__


def scrolling_tabs(window: QWidget) -> Iterator[tuple[str, int, list[str]]]:
    """Yield tabs that have less room than they need where the window has it; those of files may be any."""
    for tabs in window.findChildren(QTabBar):
        wanted = tabs.sizeHint().width()
        is_of_files = isinstance(tabs.parent().parent(), QSplitter)
        if tabs.isVisible() and not is_of_files and tabs.width() < wanted < 0.45 * window.width():
            yield "tabs", wanted - tabs.width(), [tabs.tabText(n) for n in range(tabs.count())]


def test_no_text_of_a_page_is_cut_and_nothing_overlaps_on_any_screen(
    language: str, window: MainWindow
) -> None:
    """Labels and buttons, and what is painted: heads of columns, and numbers in cells."""
    found = []
    for name, show in PAGES.items():
        window.resize(1366, 768)
        show(window)
        for screen in SCREENS if CAMPAIGN else OF_LANGUAGE[language]:
            window.resize(*screen)
            settled()
            if (window.width(), window.height()) != screen:
                found.append((name, screen, f"needs {window.width()} x {window.height()}"))
            cut = [(type(w).__name__, text) for w, text in texts(window) if is_cut(w)]
            painted = (*heads(window), *cells(window), *squeezed(window), *scrolling_tabs(window))
            cut += [
                ("hint", field.placeholderText())
                for field in window.findChildren(QLineEdit)
                if field.isVisible() and is_hint_cut(field)
            ]
            found += [(name, screen, each) for each in (*cut, *painted, *overlaps(window))]
        found += [(name, "unreadable", each) for each in unreadable(window)]
    assert found == [], "\n".join(map(str, found))


def painted(window: MainWindow) -> np.ndarray:
    """Return the colour of each pixel of a window as one number, painted in twice its size so that thin
    strokes have their ink.
    """
    drawn = QPixmap(window.size() * 2)
    drawn.setDevicePixelRatio(2)
    window.render(drawn)
    image = drawn.toImage().convertToFormat(QImage.Format.Format_RGB32)
    return np.frombuffer(image.constBits(), np.uint32).reshape(image.height(), -1)[:, : image.width()].copy()


def contrast(pixels: np.ndarray) -> float:
    """Return the contrast (WCAG) of a ground and the ink that is farthest from it."""
    colours, counts = np.unique(pixels, return_counts=True)
    one = np.stack([(colours >> shift) & 0xFF for shift in (16, 8, 0)], axis=1) / 255
    linear = np.where(one <= 0.04045, one / 12.92, ((one + 0.055) / 1.055) ** 2.4)
    light = linear @ np.array((0.2126, 0.7152, 0.0722))
    background = float(light[counts.argmax()])
    ends = (float(light.min()), float(light.max()))
    return max((max(x, background) + 0.05) / (min(x, background) + 0.05) for x in ends)


@pytest.mark.parametrize("colours", ["light", "dark"])
def test_text_can_be_read_on_its_background_on_every_page(window: MainWindow, colours: str) -> None:
    scheme().choose(colours)
    try:
        poor = {}
        for name, show in PAGES.items():
            show(window)
            settled()
            pixels = painted(window)
            for widget, text in texts(window):
                place = QRect(widget.mapTo(window, QPoint(0, 0)), widget.size())
                part = pixels[2 * place.top() : 2 * place.bottom(), 2 * place.left() : 2 * place.right()]
                if (found := contrast(part)) < 4.5:
                    poor[name, text] = round(found, 1)
        assert poor == {}
    finally:
        scheme().choose("light")


def test_the_parameter_is_as_wide_as_ever_when_the_window_grows_beside_the_preview(
    window: MainWindow,
) -> None:
    window.resize(1024, 700)
    window.menus["view.preview"].trigger()
    QApplication.processEvents()
    window.resize(2560, 1440)
    QApplication.processEvents()
    assert window.docks._dock("Parameter").width() >= 240


def test_pictures_and_what_is_found_come_to_the_front_from_the_page_at_the_control(
    window: MainWindow,
) -> None:
    window.control.show("compare")
    window.menus["view.pictures"].trigger()
    assert not window.control.is_shown
    assert window.page.shows_pictures
    window.control.show("compare")
    window.menus["view.pictures"].trigger()
    assert window.page.shows_pictures, "they were behind the page, and are there again"
    window.control.show("compare")
    window.go_to(("servo.excess_error", "1"))
    assert not window.control.is_shown
