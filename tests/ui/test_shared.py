"""The window that tests share is as a new one after each of them, or the test that changed it fails."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtWidgets import QDialog

from amp_studio.ui.main_window import MainWindow

from .conftest import action, on_disk
from .shared import first_of, put_back

EXCESS = ("servo.excess_error", "1")


def test_what_a_test_did_is_taken_back(window: MainWindow, path: Path) -> None:
    first, title = first_of(window), window.windowTitle()
    page = window.page
    assert page is not None
    window.go_to(EXCESS)
    window.edits.commit(EXCESS, "3 mm")
    page.left.show_side("steps" if first.side == "groups" else "groups")
    action(window, "Pictures").trigger()
    window.show_panel("Findings")
    QDialog(window).show()
    window.workspace._keep_unsaved()
    put_back(window, first)
    assert replace(first_of(window), docks=first.docks) == first
    assert not window.findings.isVisible()
    assert not page.shows_pictures
    assert not window.findChildren(QDialog)
    assert window.windowTitle() == title
    assert not window.menus["edit.undo"].isEnabled()
    assert page.workspace.file.values == on_disk(path).values


@pytest.mark.parametrize(
    ("does", "what"),
    [
        (lambda window: window.close_page(window.page), "opened or closed a file"),
        (lambda window: window.close(), "closed it"),
        (lambda window: window.workspace.file.set(EXCESS, None), "changed the file"),
        (lambda window: window.workspace.path.with_name("a.csv").write_text(""), "left {'.csv'}"),
    ],
    ids=("file", "window", "value", "beside"),
)
def test_what_cannot_be_taken_back_is_a_failure(
    window: MainWindow, does: Callable[[MainWindow], object], what: str
) -> None:
    first = first_of(window)
    does(window)
    with pytest.raises(AssertionError, match=what):
        put_back(window, first)
