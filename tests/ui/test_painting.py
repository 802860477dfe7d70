"""An edit paints what it changes and nothing else, and nothing stale stays on the screen."""

import random
from collections.abc import Iterator
from functools import partial

import pytest
from PySide6.QtCore import QCoreApplication
from PySide6.QtGui import QImage
from pytestqt.qtbot import QtBot

from amp_studio.schema import Address, write_value
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.table.parameter_table import AddressRole
from tests.campaigns import CAMPAIGN

from .conftest import WAIT_MS
from .shared import Brush

EXCESS = ("servo.excess_error", "1")
EDITS = 200 if CAMPAIGN else 12


def paint(window: MainWindow) -> None:
    """Paint what has to be, as Qt does after the events of an edit and what they have led to."""
    for _ in range(5):
        QCoreApplication.processEvents()
    window.findChild(Brush).paint()


def on_screen(window: MainWindow) -> QImage:
    """Return what was painted, as the screen has it."""
    return window.screen().grabWindow(window.winId()).toImage()


def new_painting(window: MainWindow) -> QImage:
    """Return what a painting of the whole window shows, with nothing of a cell remembered."""
    assert window.table is not None
    window.table._looks.clear()
    return window.grab().toImage().convertToFormat(on_screen(window).format())


def is_up_to_date(window: MainWindow) -> bool:
    """Return whether the screen has what a painting of everything shows; what comes later may still come."""
    paint(window)
    return on_screen(window) == new_painting(window)


@pytest.fixture
def painted_cells(window: MainWindow, monkeypatch: pytest.MonkeyPatch) -> Iterator[list[int]]:
    """Every cell that is painted, as one entry."""
    cells, painter = list[int](), window.page_in_front.table_view._delegate.painter
    paint = painter.paint
    monkeypatch.setattr(painter, "paint", lambda *given, **named: cells.append(1) or paint(*given, **named))
    yield cells
    monkeypatch.undo()


def texts_for(window: MainWindow, address: Address) -> list[str]:
    """Return what may be typed for a value: its present one, others of its kind, and some out of range."""
    parameter = window.workspace_in_front.file.schema.parameters[address[0]]
    value = window.workspace_in_front.file.get(address)
    present = [] if value is None or parameter.secret else [write_value(parameter, value)]
    numbers = ["0", "1", "10"] if parameter.type in ("integer", "real") else []
    return present + numbers + [choice.label for choice in parameter.choices or ()]


def test_an_edit_that_brings_a_finding_paints_the_cells_that_it_is_about(
    window: MainWindow, painted_cells: list[int]
) -> None:
    """The count on a filter had all tabs laid out again, and all that is in them painted."""
    window.go_to(EXCESS)
    window.page_in_front.table_view.viewport().update()
    paint(window)
    whole, painted, findings = len(painted_cells), list[int](), set[int]()
    for text in ("1 mm", "11 mm", "1 mm"):
        painted_cells.clear()
        window.edits.commit(EXCESS, text)
        paint(window)
        painted.append(len(painted_cells))
        findings.add(len(window.workspace_in_front.findings))
    assert len(findings) > 1
    assert 0 < min(painted) <= whole // 3, "of one edit the focus may have changed besides"


def test_another_selected_finding_has_the_cells_painted_that_it_outlines(
    window: MainWindow, qtbot: QtBot
) -> None:
    window.edits.commit(EXCESS, "1 mm")
    window.go_to(EXCESS)
    panel, table = window.page_in_front.findings, window.page_in_front.table
    cells, seen = list[Address](), set[frozenset[Address]]()
    table.dataChanged.connect(lambda first, last: cells.extend((first.data(AddressRole),) * (first == last)))
    for row in range(len(panel.model.groups)):
        before = table.outlined
        cells.clear()
        panel.view.setCurrentIndex(panel.model.index(row, 0))
        others = {address for address in before ^ table.outlined if table.index_of(address).isValid()}
        assert others <= set(cells) <= before | table.outlined
        qtbot.waitUntil(partial(is_up_to_date, window), timeout=WAIT_MS)
        seen.add(table.outlined)
    assert len(seen) > 1


def test_the_screen_has_after_any_edits_what_a_new_painting_shows(window: MainWindow, qtbot: QtBot) -> None:
    chance, workspace = random.Random(22), window.workspace_in_front
    addresses = [a for a in workspace.file.addresses() if texts_for(window, a)]
    made = 0
    while made < EDITS:
        here = [a for row in window.page_in_front.table.unfiltered() for a in row if texts_for(window, a)]
        address = chance.choice(here or addresses)
        if chance.random() < 0.3:
            window.page_in_front.select(chance.choice(addresses))
        if chance.random() < 0.2:
            workspace.undo_stack.undo()
        try:
            made += workspace.enter(address, chance.choice(texts_for(window, address)))
        except ValueError:
            continue
        paint(window)
        qtbot.waitUntil(partial(is_up_to_date, window), timeout=WAIT_MS)
