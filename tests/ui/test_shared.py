"""The window that tests share is as a new one after each of them."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtWidgets import QDialog

from amp_studio.ui.main_window import MainWindow

from .conftest import User, action, new_window, on_disk
from .shared import SharedWindow, first_of

EXCESS = ("servo.excess_error", "1")


@pytest.fixture
def shared(path: Path, user: User) -> Iterator[SharedWindow]:
    made = SharedWindow(path, new_window)
    yield made
    made.close()


def test_what_a_test_did_is_taken_back(shared: SharedWindow, path: Path) -> None:
    window = shared.get()
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
    shared.put_back()
    assert shared.get() is window
    assert replace(first_of(window), docks=first.docks) == first
    assert not window.findings.isVisible()
    assert not page.shows_pictures
    assert not window.findChildren(QDialog)
    assert window.windowTitle() == title
    assert not window.menus["edit.undo"].isEnabled()
    assert page.workspace.file.values == on_disk(path).values


@pytest.mark.parametrize(
    ("does", "is_kept"),
    [
        (lambda window: window.close_page(window.page), True),
        (lambda window: window.edits.commit(EXCESS, "3 mm") and window.save(), True),
        (lambda window: window.workspace.path.with_name("a.csv").write_text(""), True),
        (lambda window: action(window, "Motion").trigger(), True),
        (lambda window: window.control.show("compare"), False),
        (lambda window: window.close(), False),
    ],
    ids=("closed", "saved", "beside", "motion", "control", "window"),
)
def test_what_undo_does_not_take_back_is_opened_again(
    shared: SharedWindow, path: Path, does: Callable[[MainWindow], object], is_kept: bool
) -> None:
    window, content = shared.get(), path.read_bytes()
    first = first_of(window)
    does(window)
    shared.put_back()
    again = shared.get()
    assert (again is window) == is_kept
    assert replace(first_of(again), page=first.page, docks=first.docks) == first
    assert path.read_bytes() == content
    assert {each.suffix for each in path.parent.iterdir()} <= {".amp", ".lock", ".holder"}


def test_a_change_past_the_undo_steps_is_a_failure(shared: SharedWindow) -> None:
    shared.get().workspace.file.set(EXCESS, None)
    with pytest.raises(AssertionError, match="has changed the file"):
        shared.put_back()
