"""An error in a method that Qt calls never ends the program, whatever raises it."""

import importlib
import os
import pkgutil
import subprocess
import sys
from collections.abc import Iterator
from types import FunctionType

import pytest

import amp_studio.ui
from amp_studio.ui.base.guard import is_override

RAISING = {
    "by C": "int('x')",
    "by a mapping": "{}['x']",
    "of a text": r"b'\xff'.decode()",
    "by Python": "raise ValueError('no')",
}
PROGRAM = """
import sys
import amp_studio.ui
from PySide6.QtCore import QAbstractTableModel, QEvent, QModelIndex, QObject, QSize, Qt, QTimer
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QApplication, QStyledItemDelegate, QTableView, QVBoxLayout, QWidget

failed = set()
sys.excepthook = lambda kind, error, trace: failed.add(
    trace.tb_next.tb_frame.f_code.co_name if trace.tb_next else "?"
)

def fail():
    RAISE

class Model(QAbstractTableModel):
    def rowCount(self, parent=QModelIndex()): return 3
    def columnCount(self, parent=QModelIndex()): return 3
    def data(self, index, role=Qt.ItemDataRole.DisplayRole): fail()
    def headerData(self, section, orientation, role): fail()
    def flags(self, index): fail()

class Box(QWidget):
    def sizeHint(self): fail()
    def minimumSizeHint(self): fail()
    def paintEvent(self, event):
        painter = QPainter(self)
        fail()
    def resizeEvent(self, event): fail()
    def showEvent(self, event): fail()
    def event(self, event):
        if event.type() == QEvent.Type.Polish: fail()
        return super().event(event)

class Filter(QObject):
    def eventFilter(self, watched, event): fail()

class Delegate(QStyledItemDelegate):
    def paint(self, painter, option, index): fail()
    def sizeHint(self, option, index): fail()

application = QApplication([])
window = QWidget()
layout = QVBoxLayout(window)
plain, drawn, box = QTableView(), QTableView(), Box()
for each in (plain, drawn, box):
    layout.addWidget(each)
box.setMinimumSize(50, 50)
plain.setModel(Model())
drawn.setModel(Model())
drawn.setItemDelegate(Delegate(drawn))
watching = Filter()
box.installEventFilter(watching)
window.resize(400, 400)
window.show()
QTimer.singleShot(0, fail)
for _ in range(20):
    drawn.resizeRowsToContents()
    for each in (plain.viewport(), drawn.viewport(), box):
        each.update()
    application.processEvents()
print(*sorted(failed))
"""


@pytest.mark.parametrize("raising", RAISING.values(), ids=RAISING)
def test_the_program_lives_and_reports_whatever_raises_in_what_qt_calls(raising: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM.replace("RAISE", raising)],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
        env=os.environ,
    )
    assert done.returncode == 0, done.stderr
    expected = {
        *("data", "event", "eventFilter", "flags", "headerData", "minimumSizeHint"),
        *("paint", "paintEvent", "resizeEvent", "showEvent", "sizeHint"),
    }
    assert expected <= set(done.stdout.split()), done.stdout


def overrides() -> Iterator[tuple[str, object]]:
    """Yield each method of the window that takes the place of one of Qt's."""
    for module in pkgutil.walk_packages(amp_studio.ui.__path__, "amp_studio.ui."):
        for made in vars(importlib.import_module(module.name)).values():
            if isinstance(made, type) and made.__module__ == module.name:
                for name, method in vars(made).items():
                    if isinstance(method, FunctionType) and is_override(made, name):
                        yield f"{module.name}.{made.__name__}.{name}", method


def test_every_method_that_qt_calls_is_guarded() -> None:
    found = dict(overrides())
    assert len(found) > 150
    assert [name for name, method in found.items() if not hasattr(method, "__wrapped__")] == []
