"""Help, facts, rules and history of the selected parameter."""

import itertools
from pathlib import Path
from typing import ClassVar

import pytest
from PySide6.QtCore import QPointF, QRectF, QUrl
from PySide6.QtGui import QPainter

from amp_studio.files import Document
from amp_studio.files.document import HistoryEntry
from amp_studio.schema import Value
from amp_studio.ui.base.theme import colour
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.table.range_bar import RangeBar, ValueInRange

from .conftest import WAIT_MS

EXCESS = ("servo.excess_error", "1")


def page(window: MainWindow) -> str:
    """Return the text of the panel."""
    return window.detail.page.toPlainText()


def test_help_shows_what_it_is_where_it_counts_and_what_is_allowed(window: MainWindow) -> None:
    window.go_to(EXCESS)
    assert (window.detail.number.text(), window.detail.name.text()) == ("1750", "Excess Error")
    assert window.detail.value.text() == "11 mm"
    assert window.detail.axes.choice == "1"
    for part in ("Allowed here: 0 to", "What it does", "page 7-"):
        assert part in page(window)


def test_a_danger_is_in_a_box_before_the_help(window: MainWindow) -> None:
    window.go_to(EXCESS)
    displayed = page(window)
    assert "DANGER\nThis limit guards against damage and injury" in displayed
    assert displayed.index("DANGER") < displayed.index("What it does") < displayed.index("The order must be")
    assert colour("errorbg").name() in window.detail.page.toHtml()


def test_facts_are_folded_until_they_are_wanted(window: MainWindow) -> None:
    window.go_to(EXCESS)
    assert "servo.excess_error" not in page(window)
    window.detail.page.anchorClicked.emit(QUrl("fold:facts"))
    assert "servo.excess_error" in page(window)
    window.detail.page.anchorClicked.emit(QUrl("fold:facts"))
    assert "servo.excess_error" not in page(window)


def test_history_has_what_was_saved(window: MainWindow) -> None:
    window.go_to(EXCESS)
    assert "No saved changes of 1750 Excess Error yet" in page(window)
    window.edits.commit(EXCESS, "3 mm")
    assert window.save()
    assert "11 mm → 3 mm" in page(window)
    assert "studio" in page(window)
    assert "today " in page(window)


def test_of_many_saved_changes_the_newest_are_shown_until_all_are_wanted(
    window: MainWindow, monkeypatch: pytest.MonkeyPatch
) -> None:
    entries = [HistoryEntry("2020-01-01T00:00", "me", "edit", "", f"{n} mm", "") for n in range(25)]
    monkeypatch.setattr(Document, "history", lambda *_: entries)
    window.go_to(EXCESS)
    assert page(window).count(" mm → not set") == 10
    assert "15 earlier" in page(window)
    window.detail.page.anchorClicked.emit(QUrl("fold:history"))
    assert page(window).count(" mm → not set") == 25


def test_the_bar_has_the_range_and_what_the_rules_allow(window: MainWindow, qtbot) -> None:
    """With a rapid of 10000 mm/min and this gain the axis trails by 10 mm;
    a tenth more is demanded (page 7-20).
    """
    window.go_to(EXCESS)
    assert window.detail.bar.isVisible()
    qtbot.waitUntil(lambda: bool(window.detail.bar.words), timeout=WAIT_MS)
    assert window.detail.bar.words == "rules allow from 11"
    assert window.detail.bar.accessibleDescription() == "0 to 214.1 mm, rules allow from 11"


def test_a_choice_and_a_secret_have_no_bar(window: MainWindow) -> None:
    for address in (("servo.position_loop_type", "1"), ("password.character", "1")):
        window.go_to(address)
        assert window.detail.bar.isHidden(), address


def test_rules_that_are_not_met_come_first_and_are_counted(window: MainWindow) -> None:
    window.edits.commit(EXCESS, "5 mm")
    window.go_to(EXCESS)
    text = page(window)
    assert "3 of 13 not met" in text  # one of them is that the like axes have another value
    assert text.index("Error: At rapid 10 000 mm/min") < text.index("Reserve of excess error")


def test_a_rule_that_needs_a_value_that_is_not_set_is_not_called_met(window: MainWindow) -> None:
    window.go_to(EXCESS)
    assert "all 12 met" in page(window)
    window.workspace.edit("", {EXCESS: None})
    assert "3 met, 9 not checked without a value" in page(window)


class _Texts(QPainter):
    """A painter that keeps the texts, with where each is."""

    kept: ClassVar[dict[str, QRectF]] = {}

    def drawText(self, at: QPointF, text: str) -> None:  # type: ignore[override]  # noqa: N802  # Qt's
        metrics = self.fontMetrics()
        width = metrics.horizontalAdvance(text)
        self.kept[text] = QRectF(at.x(), at.y() - metrics.ascent(), width, metrics.ascent())


@pytest.mark.parametrize("width", [216, 400])
def test_no_two_texts_of_the_range_overlap_and_no_figure_is_cut(
    width: int, monkeypatch: pytest.MonkeyPatch, qtbot
) -> None:
    bar, most = RangeBar(), 4_194_304.0
    qtbot.addWidget(bar)
    bar.resize(width, bar.sizeHint().height())
    monkeypatch.setattr("amp_studio.ui.table.range_bar.QPainter", _Texts)
    for value, default in itertools.product((4.0, 2_500.0, 2e6, most), (4.0, 2_000.0, 2.1e6, most)):
        bar.show_range(ValueInRange(4.0, most, "counts", value, default))
        bar.show_allowed((4.0, 3_355_443.0))
        _Texts.kept = {}
        bar.grab()
        for one, other in itertools.combinations(_Texts.kept.values(), 2):
            assert not one.intersects(other), (value, default, _Texts.kept)
        assert any("3 355 4" in text.replace("\u202f", " ") for text in _Texts.kept)
        assert not any("…" in text for text in _Texts.kept)


def test_a_calculated_value_is_taken_by_a_link_and_nothing_else(window: MainWindow) -> None:
    window.edits.commit(EXCESS, "5 mm")
    window.go_to(EXCESS)
    before = dict(window.workspace.file.values)
    window.detail.page.anchorClicked.emit(QUrl("use:0"))
    changed = {a for a, v in window.workspace.file.values.items() if before.get(a) != v}
    assert changed == {EXCESS}
    assert window.workspace.file.get(EXCESS) == Value(11.0, "mm")


def test_the_axes_of_the_panel_choose_the_cell(window: MainWindow) -> None:
    window.go_to(EXCESS)
    assert [button.text() for button in window.detail.axes.buttons.values()] == ["X", "Y", "Z", "B", "S"]
    window.detail.axes.buttons["3"].click()
    assert window.selected() == ("servo.excess_error", "3")


def test_the_other_open_files_have_their_values_beside(window: MainWindow, path: Path) -> None:
    other = path.with_name("router.amp")
    other.write_bytes(path.read_bytes())
    first = window.page
    window.files.open_path(other)
    window.edits.commit(EXCESS, "7 mm")
    window.tabs.bring(first)
    window.go_to(("servo.excess_error", "2"))
    assert "router" in page(window)
    assert "X 7 mm, Y 11 mm" in page(window)


def test_the_printed_table_of_a_value_is_below_its_help(window: MainWindow) -> None:
    window.go_to(("servo.velocity_proportional_gain", "1"))
    text = window.detail.page.toPlainText()
    assert "Velocity Proportional Gain Values for Standard Motors (page 7-55)" in text
    assert "B520E" in text
    assert "26214" in text


def test_three_values_where_they_differ(window: MainWindow) -> None:
    """What is edited is not what is on disk, and not what the control contains."""
    window.go_to(EXCESS)
    window.go_to(EXCESS)
    assert "In the control" not in page(window)
    window.workspace.remember_control({EXCESS: Value(5.0, "mm")}, "10:30")
    window.edits.commit(EXCESS, "3 mm")

    lines = page(window).split("\n")

    assert window.detail.value.text() == "3 mm"
    assert lines[lines.index("Saved  ") + 1] == "11 mm"
    assert lines[lines.index("In the control, 10:30  ") + 1] == "5 mm"


def test_the_range_that_another_parameter_sets_names_it(window: MainWindow) -> None:
    window.edits.commit(EXCESS, "3 mm")
    text = page(window)
    assert "Excess" not in text or "Allowed here" in text


def test_why_a_parameter_is_out_of_force(window: MainWindow) -> None:
    file = window.workspace.file
    ignored = next(a for a in file.addresses() if file.evaluation.state(a).state == "ignored" and a[1] == "1")
    window.go_to(ignored)
    assert f"Ignored: {file.evaluation.state(ignored).why}" in page(window)


def test_a_link_leads_to_the_parameter_on_the_same_axis(window: MainWindow) -> None:
    window.go_to(("servo.excess_error", "3"))
    window.detail.page.anchorClicked.emit(QUrl("param:servo.gain_break_point"))
    assert window.selected() == ("servo.gain_break_point", "3")


def test_a_page_of_one_value_stays_where_it_was_scrolled(window: MainWindow) -> None:
    window.go_to(EXCESS)
    bar = window.detail.page.verticalScrollBar()
    bar.setValue(bar.maximum())
    assert bar.value() > 0
    window.workspace.edit("elsewhere", {("home.calibration", "2"): Value(1.0, "mm")})
    assert bar.value() == bar.maximum()
    bar.setValue(100)
    before = page(window)
    window.edits.commit(EXCESS, "3 mm")
    assert page(window) != before
    assert bar.value() == 100
    window.go_to(("servo.gain_break_point", "1"))
    assert bar.value() == 0


def test_formulas_have_their_titles_and_no_names_of_functions(window: MainWindow) -> None:
    window.go_to(("servo.gain_break_point", "1"))
    text = window.detail.page.toPlainText()
    assert "Gain break point: " in text
    assert "gain_break_point" not in text


def test_a_page_that_is_a_pixel_too_wide_has_no_bar_below(window: MainWindow) -> None:
    """Sixteen parameters of an AcroMill had one, where a table took its pixel from the margin."""
    window.go_to(("servo.load_inertia_ratio", "1"))
    panel = window.detail.page
    assert not panel.horizontalScrollBar().isVisible()
    assert panel.document().idealWidth() - panel.viewport().width() <= panel.document().documentMargin()
