"""Help, facts, rules and history of the selected parameter."""

from __future__ import annotations

from PySide6.QtCore import QUrl

from amp_studio.schema import Value
from amp_studio.ui.main_window import MainWindow

EXCESS = ("servo.excess_error", "1")


def page(window: MainWindow, name: str) -> str:
    """Return the text of a page, brought to the front."""
    titles = [window.detail.tabs.tabText(n) for n in range(window.detail.tabs.count())]
    window.detail.tabs.setCurrentIndex(titles.index(name))
    return window.detail.pages[name].toPlainText()


def test_help_says_what_it_is_where_it_counts_and_what_is_allowed(window: MainWindow) -> None:
    window.go_to(EXCESS)
    text = page(window, "Help")
    for part in ("1750 Excess Error", "11 mm", "Axis 1", "Allowed here: 0 to", "What it does", "page 7-"):
        assert part in text


def test_facts_rules_and_history(window: MainWindow) -> None:
    window.go_to(EXCESS)
    assert "servo.excess_error" in page(window, "Facts")
    assert "✓" in page(window, "Rules")
    assert "No saved changes of servo.excess_error@1 yet" in page(window, "History")

    window.edits.commit(EXCESS, "3 mm")
    assert window.save()
    assert "11 mm → 3 mm" in page(window, "History")
    assert "studio" in page(window, "History")


def test_the_printed_table_of_a_value_stands_below_its_help(window: MainWindow) -> None:
    window.go_to(("servo.velocity_proportional_gain", "1"))
    text = window.detail.pages["Help"].toPlainText()
    assert "Velocity Proportional Gain Values for Standard Motors (page 7-55)" in text
    assert "B520E" in text
    assert "26214" in text


def test_a_broken_rule_is_marked(window: MainWindow) -> None:
    loop = ("servo.position_loop_type", "5")
    window.edits.commit(loop, "Closed Loop")
    window.go_to(loop)
    assert "✗" in page(window, "Rules")


def test_three_values_where_they_differ(window: MainWindow) -> None:
    """What is edited is not what is on disk, and not what the control contains."""
    window.go_to(EXCESS)
    assert "on disk" not in page(window, "Help")
    window.workspace.remember_control({EXCESS: Value(5.0, "mm")}, "10:30")
    window.edits.commit(EXCESS, "3 mm")

    text = page(window, "Help")

    assert "3 mm" in text
    assert "11 mm on disk" in text
    assert "5 mm in the control at 10:30" in text


def test_the_range_that_another_parameter_sets_names_it(window: MainWindow) -> None:
    window.edits.commit(EXCESS, "3 mm")
    text = page(window, "Help")
    assert "Excess" not in text or "Allowed here" in text


def test_why_a_parameter_is_out_of_force(window: MainWindow) -> None:
    file = window.workspace.file
    ignored = next(a for a in file.addresses() if file.evaluation.state(a).state == "ignored" and a[1] == "1")
    window.go_to(ignored)
    assert f"Ignored: {file.evaluation.state(ignored).why}" in page(window, "Help")


def test_a_link_leads_to_the_parameter_on_the_same_axis(window: MainWindow) -> None:
    window.go_to(("servo.excess_error", "3"))
    window.detail.pages["Help"].anchorClicked.emit(QUrl("param:servo.gain_break_point"))
    assert window.selected() == ("servo.gain_break_point", "3")


def test_a_page_that_does_not_change_stays_where_it_was_scrolled(window: MainWindow) -> None:
    window.go_to(EXCESS)
    bar = window.detail.pages["Help"].verticalScrollBar()
    bar.setValue(bar.maximum())
    assert bar.value() > 0
    window.workspace.edit("elsewhere", {("home.calibration", "2"): Value(1.0, "mm")})
    assert bar.value() == bar.maximum()
