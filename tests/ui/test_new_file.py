"""The dialog for a new file: what a family cannot choose is off before anything is accepted."""

from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtWidgets import QComboBox

from amp_studio.files import fitted_axes
from amp_studio.files.creation import new_like
from amp_studio.files.example_files import examples
from amp_studio.schema import Value
from amp_studio.ui.dialogs.new_file_dialog import NewFileDialog
from amp_studio.ui.main_window import MainWindow

from .conftest import User, on_disk


@pytest.fixture
def dialog(open_window: Callable[..., MainWindow]) -> Callable[[str], NewFileDialog]:
    """Return what makes the dialog, with a family chosen."""
    return lambda family: NewFileDialog(open_window(), family)


def test_a_family_with_fixed_axes_shows_it_before_ok(dialog) -> None:
    new = dialog("57c422b")
    assert not new.form.editors["axes"].isEnabled()
    assert (
        new.form.answer("hint")
        == "Reliance 57C422B 2-Axis Servo Module always has the axes X and Y (page 4-1)."
    )
    assert new.ok.isEnabled()
    assert fitted_axes(new.make()) == ("X", "Y")


@pytest.mark.parametrize(
    ("family", "axes", "fitted"),
    [
        ("num", "X, Y, B", 3),
        ("acromill", "X, Y", 2),
        ("grblhal", "X,Y,Z,A", 4),
        ("syntec", "X", 1),
        ("9pc", "X, Z, S", 3),
    ],
)
def test_every_other_family_takes_axes_in_the_dialog(dialog, family: str, axes: str, fitted: int) -> None:
    new = dialog(family)
    new.form.set_answer("axes", axes)
    assert new.ok.isEnabled(), new.fault.text()
    assert len(fitted_axes(new.make())) == fitted
    assert new.form.answer("place").endswith(f"; axes {' '.join(a.strip() for a in axes.split(','))}")


@pytest.mark.parametrize(
    ("family", "axes"), [("num", "X, S"), ("acromill", "X"), ("grblhal", "X, Z"), ("num", "X, X")]
)
def test_axes_that_cannot_be_are_refused_while_they_are_typed(dialog, family: str, axes: str) -> None:
    new = dialog(family)
    new.form.set_answer("axes", axes)
    assert new.fault.text()
    assert not new.ok.isEnabled()


def test_where_the_axes_are_written_is_shown_with_the_page(dialog) -> None:
    new = dialog("num")
    assert "Axis Assignment to a Group, Number of CNC Axis Groups, Measured Axes" in new.form.answer("hint")
    assert "(page 4-24)" in new.form.answer("hint")
    assert "X.2 is X of group 2" in new.form.answer("hint")


def test_another_family_changes_what_is_offered(dialog) -> None:
    new = dialog("57c422b")
    new.form.set_answer("family", "acromill")
    assert new.form.editors["axes"].isEnabled()
    units = new.form.editor("units", QComboBox)
    assert [units.itemData(n) for n in range(units.count())] == ["metric", "inch"]
    units.setCurrentIndex(1)
    assert new.make().header.units == "inch"
    new.form.set_answer("family", "num")
    assert not units.isEnabled()


def test_a_file_like_an_example_has_its_values_but_not_its_notes(dialog) -> None:
    new = dialog("9pc")
    example = next(e for e in examples() if e.family == "9pc")
    new.form.set_answer("like", example.path)
    assert not new.form.editors["axes"].isEnabled()
    assert example.path.name in new.form.answer("hint")
    new.form.set_answer("name", "MINE")
    made = new.make()
    assert (made.header.name, made.header.notes) == ("MINE", "")
    assert made.values == new_like(on_disk(example.path), "MINE").values
    assert not [a for a in made.values if a[0] == "password.character"], "passwords stay with their machine"
    assert "Home Calibration" in new.form.answer("hint"), "it is named what is not taken over"


def test_a_file_like_one_of_mine(dialog, path: Path, user: User) -> None:
    new = dialog("9pc")
    user.chooses(path)
    new.form.set_answer("like", "other")
    assert new.source() == path
    assert new.make().get(("axis.name", "1")) == Value("x")


def test_a_file_of_another_family_cannot_be_the_pattern(dialog, path: Path, user: User) -> None:
    new = dialog("num")
    user.chooses(path)
    new.form.set_answer("like", "other")
    assert "is a file for Allen-Bradley 9/PC AMP" in new.fault.text()
    assert not new.ok.isEnabled()
