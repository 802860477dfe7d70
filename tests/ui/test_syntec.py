"""A Syntec file in the program: axes whose names are texts, fitted by a port, and codes that are not
printed.
"""

from collections.abc import Callable

import pytest

from amp_studio.files import ParameterFile, content_of, fitted_axes, new_file
from amp_studio.schema import Value
from amp_studio.ui.dialogs.axis_dialogs import AxisDialog
from amp_studio.ui.main_window import MainWindow

from .conftest import action


@pytest.fixture
def mill(window_with: Callable[..., MainWindow]) -> MainWindow:
    """Return a window with a new file of three axes."""
    return window_with(content_of(new_file("syntec", "generic", ["X", "Y", "Z"], "mill")))


@pytest.fixture
def file(mill: MainWindow) -> ParameterFile:
    return mill.workspace.file


def fill(dialog: AxisDialog, axis: str, text: str) -> None:
    dialog.form.set_answer("axis", axis)
    dialog.form.set_answer("axis.name", text)


def test_only_axes_that_may_have_a_port_have_a_column(mill: MainWindow) -> None:
    assert [title for title in mill.table.titles if "linear" in title][:3] == [
        "X 1 linear",
        "Y 2 linear",
        "Z 3 linear",
    ]


def test_an_axis_is_named_by_a_text(mill: MainWindow, file: ParameterFile, accept) -> None:
    accept(AxisDialog, lambda dialog: fill(dialog, "2", "X2"))
    action(mill, "Name Axis").trigger()
    assert file.get(("axis.name", "2")) == Value("X2")
    assert "X2 2 linear" in mill.table.titles
    mill.menus["edit.undo"].trigger()
    assert file.get(("axis.name", "2")) == Value("Y")


def test_a_deleted_axis_has_no_port(mill: MainWindow, file: ParameterFile, accept) -> None:
    accept(AxisDialog, lambda dialog: dialog.form.set_answer("axis", "3"))
    action(mill, "Delete Axis").trigger()
    assert fitted_axes(file) == ("1", "2")


def test_a_code_that_is_not_printed_is_entered_as_a_code(mill: MainWindow, file: ParameterFile) -> None:
    """Section 3.3: that 2 is inside is printed, what outside is, is not."""
    assert mill.edits.commit(("limit.second_scope", ""), "raw:1")
    assert file.get(("limit.second_scope", "")) == Value("raw:1")
    assert mill.edits.commit(("limit.second_scope", ""), "2")
    assert file.get(("limit.second_scope", "")) == Value("inside")


def test_a_speed_without_a_range_shows_its_unit(mill: MainWindow) -> None:
    mill.go_to(("feed.rapid", "1"))
    assert "no bounds printed, in mm/min" in mill.detail.page.toPlainText()
