"""The page Tuning: chapter 36 of the 9/PC on the open file, and measured points."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QComboBox, QLabel, QWidget
from pytestqt.qtbot import QtBot

from amp_studio.calibration import Compensation, compensation_of
from amp_studio.files import Document, new_file
from amp_studio.schema import Value, load_schema, registered_families
from amp_studio.ui.base.theme import colour, scheme
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.motion.calibration_page import CalibrationPage
from amp_studio.ui.motion.measured_dialog import MeasuredDialog
from amp_studio.ui.motion.tuning_page import TuningView
from amp_studio.ui.motion.tuning_values import ValuesPage
from tests.ui.conftest import WAIT_MS, User, action

REVERSAL, TABLE = ("servo.reversal_error", "1"), ("calibration.table", "1")
POINTS = "position [mm],error [um]\n0,0\n100,4\n200,7\n200,13\n100,10\n0,6\n"


@pytest.fixture
def tuning(workspace: Workspace, qtbot: QtBot, user: User) -> TuningView:
    return displayed(TuningView(workspace, lambda: None), qtbot)


def displayed(window: TuningView, qtbot: QtBot) -> TuningView:
    qtbot.addWidget(window, before_close_func=lambda w: setattr(w, "control", None))
    window.show()
    with qtbot.waitActive(window, timeout=WAIT_MS):
        window.activateWindow()
    return window


def page(tuning: TuningView, key: str) -> ValuesPage:
    """Bring a page of values to the front."""
    (found,) = [p for p in tuning.values if p.page.key == key]
    row = next(
        n
        for n in range(tuning.stack.count())
        if tuning.stack.widget(n).isAncestorOf(found) or tuning.stack.widget(n) is found
    )
    tuning.pages.setCurrentRow(row)
    return found


def calibration(tuning: TuningView) -> CalibrationPage:
    titles = [tuning.pages.item(n).text() for n in range(tuning.pages.count())]
    tuning.pages.setCurrentRow(titles.index("Axis Calibration"))
    assert tuning.calibration is not None
    return tuning.calibration


def put_cursor(values: ValuesPage, address: tuple[str, str]) -> None:
    values.table.setCurrentCell(values.addresses().index(address), 2)


def test_a_page_that_is_not_seen_is_filled_when_it_is(
    window: MainWindow, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every edit filled each table of tuning behind the values again: a fifth of its time."""
    action(window, "Tuning").trigger()
    (tuning,) = window.findChildren(TuningView)
    values, filled, fill = page(tuning, "reversal"), list[object](), ValuesPage._fill_row
    monkeypatch.setattr(ValuesPage, "_fill_row", lambda *given: filled.append(given) or fill(*given))
    action(window, "Values").trigger()
    window.edits.commit(REVERSAL, "0.123 mm")
    assert not filled
    action(window, "Tuning").trigger()
    assert {each[0] for each in filled} == {values}
    put_cursor(values, REVERSAL)
    assert values.table.item(values.table.currentRow(), 2).text() == "0.123 mm"


def test_the_command_opens_the_pages_of_the_manual(window: MainWindow, qtbot: QtBot) -> None:
    action(window, "Tuning").trigger()
    (tuning,) = window.findChildren(TuningView)
    pages = [tuning.pages.item(n).text() for n in range(tuning.pages.count())]
    values = ["Reversal Error", "Home Calibration", "Axis Calibration", "Servo", "Spindle"]
    assert pages == [*values, "Tuning a digital axis by appendix A"]
    assert window.page.turned_to == "tuning"
    assert all(dock.isHidden() for dock in window.docks.docks), "the page has the whole window"
    action(window, "Tuning").trigger()
    assert window.page.turned_to == ""


def test_every_value_is_painted_in_the_colours_of_a_theme_that_is_chosen_later(tuning: TuningView) -> None:
    try:
        scheme().choose("dark")
        fronts = [lambda each=each: page(tuning, each.page.key) for each in tuning.values]
        for bring in (*fronts, lambda: calibration(tuning)):
            table = bring().table
            items = (table.item(n, k) for n in range(table.rowCount()) for k in range(table.columnCount()))
            colours = {item.foreground().color().name() for item in items if item is not None}
            assert colours <= {colour("text").name(), colour("dim").name()}
    finally:
        scheme().choose("light")


def test_plus_and_minus_change_the_value_by_a_step_and_each_is_undone(tuning: TuningView, workspace) -> None:
    values = page(tuning, "reversal")
    put_cursor(values, REVERSAL)
    assert values.step.currentText() == "0.001 mm"
    for key in ("+", "+", "+", "-"):
        QTest.keyClicks(values.table, key)
    assert workspace.file.get(REVERSAL) == Value(0.002, "mm")
    QTest.keyClick(tuning, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert workspace.file.get(REVERSAL) == Value(0.003, "mm")
    assert workspace.undo_stack.index() == 3


def test_a_value_stops_at_the_end_of_its_range(tuning: TuningView, workspace) -> None:
    values = page(tuning, "reversal")
    put_cursor(values, REVERSAL)
    workspace.edit("set", {REVERSAL: Value(9.9985, "mm")})
    for _ in range(3):
        values.increase.click()
    assert workspace.file.get(REVERSAL) == Value(9.999, "mm")


def test_a_file_that_another_program_has_is_not_changed_by_keys_either(
    qtbot, user: User, path: Path, qapp
) -> None:
    first = Document.open(path)
    second = Workspace(Document.view(path))
    tuning = displayed(TuningView(second, lambda: None), qtbot)
    values = page(tuning, "reversal")
    put_cursor(values, REVERSAL)
    QTest.keyClicks(values.table, "+")
    assert "read-only" in tuning.message.text.text()
    assert second.file.get(REVERSAL) == Value(0.0, "mm")
    second.close()
    first.close()


def test_a_value_that_is_not_used_is_not_changed(tuning: TuningView, workspace) -> None:
    workspace.edit("set", {("servo.position_feedback_type", "1"): Value("aqb-no-marker")}, force="test")
    values = page(tuning, "reversal")
    put_cursor(values, REVERSAL)
    QTest.keyClicks(values.table, "+")
    assert "is not used" in tuning.message.text.text()
    assert workspace.file.get(REVERSAL) == Value(0.0, "mm")


def test_a_typed_value_replaces_and_one_out_of_range_is_refused_in_the_bar(
    tuning: TuningView, workspace
) -> None:
    values = page(tuning, "home")
    put_cursor(values, ("home.calibration", "2"))
    item = values.table.item(values.table.currentRow(), 2)
    item.setText("0.5 in")
    assert workspace.file.get(("home.calibration", "2")) == Value(0.5, "in")
    values.table.item(values.table.currentRow(), 2).setText("99999999")
    assert "home" in tuning.message.text.text().casefold()
    assert tuning.message.isVisible()
    assert workspace.file.get(("home.calibration", "2")) == Value(0.5, "in")
    assert "99999999" not in values.table.item(values.table.currentRow(), 2).text()


def test_a_number_is_added_to_a_value(tuning: TuningView, workspace, user: User) -> None:
    values = page(tuning, "home")
    put_cursor(values, ("home.calibration", "1"))
    before = workspace.file.get(("home.calibration", "1")).value
    user.types("-1.25")
    QTest.keyClick(values.table, Qt.Key.Key_A)
    assert workspace.file.get(("home.calibration", "1")).value == before - 1.25


def test_a_tuned_velocity_gain_takes_the_motor_table_off_in_the_same_step(
    tuning: TuningView, workspace
) -> None:
    workspace.edit("set", {("servo.standard_motor_values", ""): Value(True)}, force="test")
    values = page(tuning, "servo")
    address = ("servo.velocity_proportional_gain", "1")
    if not workspace.file.evaluation.state(address).is_active:
        workspace.undo_stack.undo()
    steps = workspace.undo_stack.index()
    tuning.target.set("Tune", {address: Value(6500)})
    assert workspace.file.get(("servo.standard_motor_values", "")) == Value(False)
    assert workspace.undo_stack.index() == steps + 1
    assert values.addresses()


# -- the table ------------------------------------------------------------------------------------


def test_points_are_put_in_replaced_and_deleted_and_the_first_one_decides_input_and_start(
    tuning: TuningView, workspace, user: User
) -> None:
    table = calibration(tuning)
    table.input.setCurrentIndex(table.input.findData("deviation"))
    table.input.activated.emit(table.input.currentIndex())
    table.start.setCurrentIndex(table.start.findData("-"))
    table.start.activated.emit(table.start.currentIndex())
    for text in ("0 0", "100 0.004", "50=0.001"):
        user.types(text)
        table.table.setFocus()
        QTest.keyClick(table.table, Qt.Key.Key_Insert)
    assert workspace.file.get(TABLE) == Value("deviation - mm 0:0 50:0.001 100:0.004")
    table.was_on.setChecked(True)
    table.table.item(1, 1).setText("0.0005")
    assert workspace.file.get(TABLE) == Value("deviation - mm 0:0 50:0.0015 100:0.004")
    table.was_on.setChecked(False)
    assert not table.input.isEnabled()
    table.table.item(1, 1).setText("0.002")
    assert workspace.file.get(TABLE) == Value("deviation - mm 0:0 50:0.002 100:0.004")
    table.table.item(2, 1).setText("5")
    assert "PARAMETER OUT OF RANGE" in tuning.message.text.text()
    table.table.setCurrentCell(1, 1)
    QTest.keyClick(table.table, Qt.Key.Key_Delete)
    assert workspace.file.get(TABLE) == Value("deviation - mm 0:0 100:0.004")
    table.clear.click()
    assert workspace.file.get(TABLE) is None
    assert table.input.isEnabled()
    tuning.target.undo()
    assert workspace.file.get(TABLE) == Value("deviation - mm 0:0 100:0.004")


def test_measured_points_are_asked_about_and_become_one_step(
    tuning: TuningView, workspace, user: User, accept: Callable[..., None], tmp_path: Path
) -> None:
    path = tmp_path / "laser.csv"
    path.write_text(POINTS)

    def answer(dialog: MeasuredDialog) -> None:
        assert not dialog.set_button.isEnabled()
        assert "what an error is" in dialog.missing.text()
        dialog.form.editor("sign", QComboBox).setCurrentIndex(1)
        assert dialog.set_button.isEnabled()
        assert "0.01300 mm measured, 0.00000 mm expected" in dialog.summary.text()

    user.chooses(path)
    accept(MeasuredDialog, answer)
    steps = workspace.undo_stack.index()
    calibration(tuning).read.click()
    assert workspace.file.get(TABLE) == Value("deviation - mm 0:0 100:0.004 200:0.007")
    assert workspace.file.get(REVERSAL) == Value(0.006, "mm")
    assert workspace.undo_stack.index() == steps + 1


def test_a_file_that_is_no_measurement_is_named_in_the_dialog(
    workspace, tmp_path: Path, qtbot: QtBot
) -> None:
    path = tmp_path / "laser.csv"
    path.write_text("0,000;0,001\n100,000;0,004\n")
    dialog = MeasuredDialog(workspace.file, "1", path)
    qtbot.addWidget(dialog)
    assert "decimal comma" in dialog.missing.text()
    assert not dialog.set_button.isEnabled()
    dialog.form.editor("decimal", QComboBox).setCurrentIndex(1)
    assert "does not name" in dialog.missing.text()


def test_a_circle_of_a_ball_bar_asks_which_axis_it_is(workspace, tmp_path: Path, qtbot: QtBot) -> None:
    path = tmp_path / "ballbar.csv"
    rows = [(n, (2.5 if 0 < n % 360 < 180 else -2.5) * math.cos(math.radians(n))) for n in range(-20, 200)]
    path.write_text("angle [deg],deviation [um]\n" + "".join(f"{n},{by:.4f}\n" for n, by in rows))
    dialog = MeasuredDialog(workspace.file, "1", path)
    qtbot.addWidget(dialog)
    dialog.show()
    dialog.form.editor("sign", QComboBox).setCurrentIndex(1)
    assert "first or the second" in dialog.missing.text()
    assert dialog.form.editors["circle"].isVisible()
    dialog.form.editor("circle", QComboBox).setCurrentIndex(1)
    assert dialog.missing.text() == ""
    assert dialog.proposal is not None
    assert list(dialog.proposal.settings) == [REVERSAL]
    assert dialog.set_button.isEnabled()


# -- manners --------------------------------------------------------------------------------------


def demand_manners(tuning: TuningView) -> None:
    """Every view of every page has a name, and no letter of Alt means two things."""
    for n in range(tuning.pages.count()):
        tuning.pages.setCurrentRow(n)
        QApplication.processEvents()
        texts = [
            w.text()
            for w in (*tuning.findChildren(QAbstractButton), *tuning.findChildren(QLabel))
            if w.isVisible()
        ]
        letters = [text[text.index("&") + 1].upper() for text in texts if "&" in text]
        assert len(set(letters)) == len(letters), (tuning.pages.item(n).text(), letters)
        for view in tuning.stack.widget(n).findChildren(QWidget):
            if view.isVisible() and view.metaObject().className() in ("QTableWidget", "QComboBox"):
                assert view.accessibleName(), view


def test_every_view_has_a_name_and_no_two_texts_of_a_page_share_a_letter(tuning: TuningView) -> None:
    demand_manners(tuning)


def test_a_family_whose_manual_tunes_nothing_names_that(
    open_window, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "syntec.amp"
    Document.create(new_file("syntec"), path).close()
    window = open_window(path)
    monkeypatch.setattr("amp_studio.calibration.compensation_of", lambda _family: Compensation())
    action(window, "Tuning").trigger()
    assert "tuned on line" in window.page.bar.text.text()


def test_each_family_has_pages_of_parameters_that_it_has() -> None:
    for family in registered_families():
        pages = compensation_of(family).pages
        assert pages, family
        assert len({page.key for page in pages}) == len(pages)
        known = load_schema(family).parameters
        assert [name for page in pages for name in page.params if name not in known] == []
