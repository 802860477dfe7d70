"""The window that compares and merges, over the open mill."""

import pytest

from amp_studio.schema import Value
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.merge.columns import BASE, A, B
from amp_studio.ui.merge.sources import MergeSource
from amp_studio.ui.merge.window import MergeWindow

from .steps import CALIBRATION, EXCESS, RAPID


@pytest.fixture
def displayed(window: MainWindow) -> MergeWindow:
    """Return the comparison of the open mill with itself."""
    return window.files.comparing.open(window.page)


@pytest.fixture
def three(window: MainWindow, displayed: MergeWindow) -> MergeWindow:
    """Return a comparison of three: one conflict, one change of the file, one of the other side."""
    base, other = window.workspace.file.copy(), window.workspace.file.copy()
    window.workspace.edit("mine", {EXCESS: Value(12.0, "mm"), CALIBRATION: Value(1.0, "mm")})
    other.set(EXCESS, Value(13.0, "mm"))
    other.set(RAPID, Value(190.0, "mm/s"))
    now = displayed.sources.now()
    displayed.show_merge(
        {A: now, B: MergeSource("CNC_1", "", other), BASE: MergeSource("Last saved", "", base)}
    )
    return displayed
