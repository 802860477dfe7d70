"""Quick edit by number, as the old development system had it: number, value, number, value."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from amp_studio.files import ParameterFile
from amp_studio.schema import Value
from amp_studio.ui.forms.choice_box import ChoiceBox
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.table.quick_edit import QuickEdit

from .conftest import WAIT_MS

ENTER = Qt.Key.Key_Return


@pytest.fixture
def quick(window: MainWindow, qtbot) -> QuickEdit:
    """Return the open dialog with the keyboard in its number field."""
    window.edits.quick_edit()
    quick = window.findChild(QuickEdit)
    with qtbot.waitActive(quick, timeout=WAIT_MS):
        quick.activateWindow()
    return quick


def enter(quick: QuickEdit, text: str = "") -> None:
    """Type into the field that has the keyboard, and Enter."""
    field = quick.focusWidget()
    if text:
        QTest.keyClicks(field, text)
    QTest.keyClick(field, ENTER)


def test_number_value_number_value_without_the_mouse(
    quick: QuickEdit, window: MainWindow, file: ParameterFile
) -> None:
    enter(quick, "1750")
    assert quick.editor.text() == "11 mm"
    assert "1750 Excess Error, X axis\nAllowed here: 0 to" in quick.name.text()
    assert window.selected() == ("servo.excess_error", "1")
    enter(quick, "3,5")

    assert file.get(("servo.excess_error", "1")) == Value(3.5, "mm")
    assert quick.number.hasFocus()
    assert quick.number.selectedText() == "1750"

    enter(quick, "2750")
    enter(quick, "4")
    assert file.get(("servo.excess_error", "2")) == Value(4.0, "mm")


def test_a_choice_by_its_letter(quick: QuickEdit, file: ParameterFile) -> None:
    """Arrow keys and letters only select; Enter takes."""
    enter(quick, "1510")
    assert isinstance(quick.editor, ChoiceBox)
    QTest.keyClick(quick.editor, Qt.Key.Key_Down)
    assert file.get(("servo.position_loop_type", "1")) == Value("closed")

    QTest.keyClicks(quick.editor, "o")
    assert quick.editor.currentData() == "Open Loop"
    enter(quick)

    assert file.get(("servo.position_loop_type", "1")) == Value("open")
    assert quick.number.hasFocus()


def test_a_shared_number_means_what_exists_for_this_axis(quick: QuickEdit) -> None:
    """1013 is a gear of axis 1, which is no spindle; 5013 that of the spindle."""
    enter(quick, "1013")
    assert "Velocity Feedback" in quick.name.text()
    enter(quick)
    enter(quick, "5013")
    assert "S axis" in quick.name.text()
    assert "Spindle" in quick.name.text() or "Motor" in quick.name.text()


def test_a_shared_number_follows_the_type_of_the_axis(
    quick: QuickEdit, window: MainWindow, file: ParameterFile
) -> None:
    enter(quick, "1013")
    assert window.selected() == ("servo.velocity_gear_teeth", "1")
    enter(quick)
    window.workspace.edit("type", {("axis.type", "1"): Value("spindle")})
    enter(quick, "1013")
    assert window.selected() == ("servo.spindle_motor_teeth", "1")


def test_an_unknown_number_is_reported_and_asks_again(quick: QuickEdit) -> None:
    enter(quick, "99999")
    assert quick.name.text() == "Unknown parameter '99999'. Did you mean: 21091, 21009, 20091."
    assert quick.editor is None
    assert quick.number.selectedText() == "99999"
    enter(quick, "1750")
    assert quick.editor is not None


def test_an_id_with_its_instance_is_an_address_too(quick: QuickEdit, window: MainWindow) -> None:
    enter(quick, "home.calibration@3")
    assert window.selected() == ("home.calibration", "3")


def test_a_refused_value_stays_to_be_mended(quick: QuickEdit, file: ParameterFile, user) -> None:
    enter(quick, "1750")
    enter(quick, "many")
    assert "is not a number" in user.reads()
    assert quick.editor.text() == "many"
    assert file.get(("servo.excess_error", "1")) == Value(11.0, "mm")


def test_a_value_is_offered_in_the_unit_in_which_a_bare_number_counts(
    quick: QuickEdit, window: MainWindow, file: ParameterFile
) -> None:
    """10 in/min is offered as 254 mm/min in a metric file, because 12 would be 12 mm/min."""
    window.edits.commit(("home.speed_off_switch", "1"), "10 ipm")
    enter(quick, "1350")
    assert quick.editor.text() == "254 mm/min"
    enter(quick)
    assert file.get(("home.speed_off_switch", "1")) == Value(10.0, "in/min")


def test_what_is_out_of_force_shows_it(quick: QuickEdit) -> None:
    enter(quick, "5002")
    assert "\n" in quick.name.text()


def test_it_closes_with_its_file(quick: QuickEdit, window: MainWindow, qtbot) -> None:
    with qtbot.waitSignal(quick.destroyed, timeout=WAIT_MS):
        window.files.close()
