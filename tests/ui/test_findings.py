"""The findings below the table."""

from collections.abc import Callable

import pytest
from PySide6.QtCore import QPoint, Qt, QUrl
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialogButtonBox

from amp_studio.files import content_of, new_file
from amp_studio.schema import Value
from amp_studio.ui.base.places import finding_text
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.findings.dialogs import FixSeveralDialog, SuppressDialog, WhyDialog
from amp_studio.ui.findings.panel import FindingsPanel
from amp_studio.ui.main_window import MainWindow
from amp_studio.validate import Finding

from .conftest import action

EXCESS = ("servo.excess_error", "1")


@pytest.fixture
def wrong(window: MainWindow) -> MainWindow:
    """Return a window with three values out of range."""
    axes = "123"
    wanted = {("servo.excess_error", a): Value(1e6, "mm") for a in axes}
    window.workspace.edit("force", wanted, force="on a day")
    return window


@pytest.fixture
def delivered(window_with: Callable[[bytes], MainWindow], bare: bytes) -> MainWindow:
    """Return a window with a new file that lists the findings of later steps too."""
    window = window_with(bare)
    window.workspace.show_later(True)
    return window


def test_errors_come_first_and_are_counted(wrong: MainWindow) -> None:
    model = wrong.findings.model
    assert model.index(0, 0).data().startswith("error: ")
    errors = wrong.workspace.count("error")
    assert errors >= 3
    assert wrong.findings.chips["error"].text() == str(errors)
    assert wrong.status.counts["error"].text() == str(errors)


def test_the_selected_finding_stays_selected(wrong: MainWindow) -> None:
    finding = next(f for f in wrong.workspace.findings if f.addresses[0] == ("servo.excess_error", "3"))
    wrong.findings.select(finding)

    wrong.workspace.edit("mend", {EXCESS: Value(11.0, "mm")})

    assert wrong.findings.current().addresses == finding.addresses


def test_when_a_rule_is_met_again_the_next_row_is_selected(delivered: MainWindow) -> None:
    panel = delivered.findings
    place = next(n for n, group in enumerate(panel.model.groups) if group.fixable and n)
    panel.view.setCurrentIndex(panel.model.index(place, 0))
    ended = panel.model.groups[place].key
    panel.fix()
    left = [group.key for group in panel.model.groups]
    assert ended not in left
    assert panel.view.currentIndex().row() == min(place, len(left) - 1) > 0


def test_enter_shows_the_parameter_of_a_finding(wrong: MainWindow) -> None:
    finding = next(f for f in wrong.workspace.findings if f.addresses[0] == ("servo.excess_error", "2"))
    wrong.findings.select(finding)
    wrong.show_panel("Findings")
    assert wrong.findings.view.hasFocus()

    QTest.keyClick(wrong.findings.view, Qt.Key.Key_Return)

    assert wrong.selected() == ("servo.excess_error", "2")
    assert wrong.table_view.hasFocus()


def click(panel: FindingsPanel, part: str, row: int, child: int | None = None) -> None:
    """Click a button or a link that is painted in a row."""
    if panel.is_folded:
        panel.fold.click()
        QApplication.processEvents()
    index = panel.model.index(row, 0)
    index = index if child is None else panel.model.index(child, 0, index)
    panel.view.setExpanded(index.parent(), True)
    panel.view.scrollTo(index)
    place = panel.view.visualRect(index)
    spot = next(
        QPoint(x, place.top() + 12)
        for x in range(place.left(), place.right())
        if panel._delegate.part_at(index, QPoint(x, place.top() + 12)) == part
    )
    QTest.mouseClick(panel.view.viewport(), Qt.MouseButton.LeftButton, pos=spot)


def test_a_row_is_a_rule_with_the_axes_it_is_broken_on(delivered: MainWindow) -> None:
    model = delivered.findings.model
    first = model.index(0, 0)
    assert model.group(first).title == "Servo hardware of a fitted axis"
    assert model.text_of(first).startswith("The axis is fitted but its Servo Hardware Type is None")
    assert model.axes_of(first) == ("X", "Y", "Z", "B", "S")
    assert model.fix_of(first) == "Set Servo Hardware Type to SERCOS Interface"
    assert [model.axes_of(model.index(n, 0, first)) for n in range(model.rowCount(first))] == [
        ("X",),
        ("Y",),
        ("Z",),
        ("B",),
        ("S",),
    ]


def test_the_button_of_a_rule_fixes_it_on_every_axis_as_one_step(delivered: MainWindow) -> None:
    steps = delivered.workspace.undo_stack.count()
    click(delivered.findings, "fix", 0)
    types = [delivered.workspace.file.get(("servo.hardware_type", axis)).value for axis in "12345"]
    assert types == ["sercos"] * 5
    assert delivered.workspace.undo_stack.count() == steps + 1
    delivered.menus["edit.undo"].trigger()
    assert delivered.workspace.file.get(("servo.hardware_type", "5")).value == "none"


def test_a_finding_below_its_rule_is_fixed_alone(delivered: MainWindow) -> None:
    panel = delivered.findings
    panel.view.setExpanded(panel.model.index(0, 0), True)
    panel.view.setCurrentIndex(panel.model.index(2, 0, panel.model.index(0, 0)))
    delivered.edits.fix_selected()
    types = [delivered.workspace.file.get(("servo.hardware_type", axis)).value for axis in "1234"]
    assert types == ["none", "none", "sercos", "none"]
    assert panel.view.isExpanded(panel.model.index(0, 0)), "the list keeps its place"
    assert panel.view.currentIndex().parent().row() == 0


def test_a_link_goes_to_the_value_of_a_finding(delivered: MainWindow) -> None:
    click(delivered.findings, "go", 0, 3)
    assert delivered.selected() == ("servo.hardware_type", "4")


def test_a_finding_without_a_fix_shows_it(delivered: MainWindow, user) -> None:
    panel = delivered.findings
    unable = next(n for n, group in enumerate(panel.model.groups) if not group.fixable)
    panel.view.setCurrentIndex(panel.model.index(unable, 0))
    delivered.guarded(delivered.edits.fix_selected)
    assert "has no suggested fix" in user.reads()


def test_findings_are_filtered_to_the_axis_and_the_group_in_front(delivered: MainWindow) -> None:
    panel = delivered.findings
    delivered.go_to(("servo.loop_type", "5"))
    panel.scope.buttons["axis"].click()
    assert panel.scope.buttons["axis"].text() == "Axis S"
    assert {group.axes for group in panel.model.groups} == {("S",)}
    delivered.go_to(("accdec.jerk", "1"))
    panel.scope.buttons["shown"].click()
    assert {group.findings[0].causes[0][0] for group in panel.model.groups} == {
        "accdec.jerk",
        "accdec.min_jerk",
    }
    panel.scope.buttons["file"].click()
    assert len(panel.model.groups) > 4


def test_a_severity_is_left_out_and_listed_again(delivered: MainWindow) -> None:
    panel = delivered.findings
    for severity in ("error", "warning", "advice"):
        panel.chips[severity].click()
    assert panel.model.groups == ()
    assert "filters" in panel.empty.text()
    panel._follow("all")
    assert {group.severity for group in panel.model.groups} == {"error", "warning", "advice"}


def test_what_is_kept_back_is_counted_and_not_listed(delivered: MainWindow) -> None:
    panel = delivered.findings
    panel.withhold(lambda finding: finding.rule.startswith("9pc.accdec."))
    assert not any("accdec" in group.key for group in panel.model.groups)
    assert panel.hint.text().startswith("8 as delivered, to be set in steps ")
    assert not panel.chips["warning"].isVisible()


def test_an_empty_list_leads_to_what_is_not_set(window_with) -> None:
    window = window_with(content_of(new_file("num", "cnc", [], "bare")))
    assert "921 active parameters are not set" in window.findings.summary.text(), "one line, without the list"
    assert not window.findings.isVisible()
    assert "921 active parameters are not set." in window.findings.empty.text()
    window.findings._follow("unset")
    assert window.page.list_title.text().startswith("<b>Not set</b>")


def test_several_fixes_are_chosen_from_a_list_and_undone_at_once(delivered: MainWindow, accept) -> None:
    before, steps = dict(delivered.workspace.file.values), delivered.workspace.undo_stack.count()

    def choose(dialog: FixSeveralDialog) -> None:
        assert dialog.chosen() == (), "nothing that can change motion is chosen by itself"
        assert not dialog.ok.isEnabled()
        for top, leaf in ((0, 0), (0, 1), (1, 2)):
            dialog.list.topLevelItem(top).child(leaf).setCheckState(0, Qt.CheckState.Checked)
        assert dialog.ok.text() == "Apply 3 &Fixes"

    accept(FixSeveralDialog, choose)
    delivered.findings.several.click()

    changed = {a for a, value in delivered.workspace.file.values.items() if before.get(a) != value}
    assert changed == {("servo.hardware_type", "1"), ("servo.hardware_type", "2"), ("accdec.jerk", "3")}
    assert delivered.workspace.undo_stack.count() == steps + 1
    delivered.menus["edit.undo"].trigger()
    assert delivered.workspace.file.values == before


def test_rows_are_as_high_as_their_words_need(window_with, bare: bytes) -> None:
    """Also when the window becomes narrower."""
    wrong = window_with(bare)
    wrong.workspace.edit("begin", {("home.position", "1"): Value(1.0, "mm")})
    wrong.show_panel("Findings")
    view, model = wrong.findings.view, wrong.findings.model
    longest = max(range(len(model.groups)), key=lambda n: len(model.groups[n].message))
    heights = []
    for width in (1900, 700):
        wrong.resize(width, 900)
        QApplication.processEvents()
        heights.append(view.visualRect(model.index(longest, 0)).height())
    assert heights[1] > heights[0]


def test_a_hidden_parameter_of_a_finding_can_be_shown(window: MainWindow, workspace: Workspace) -> None:
    """Going to what does not exist for this configuration turns the option on."""
    hidden = ("control.lathe_type", "")  # page 3-9: on a lathe only
    window.go_to(hidden)
    assert window.menus["view.hidden"].isChecked()
    assert window.selected() == hidden


def test_an_unfitted_axis_can_be_shown(window: MainWindow) -> None:
    window.go_to(("axis.type", "7"))
    assert window.menus["view.unfitted_axes"].isChecked()
    assert window.selected() == ("axis.type", "7")


def test_why_shows_the_rule_and_leads_to_its_parameters(wrong: MainWindow) -> None:
    wrong.workspace.edit("speed", {("home.g28_speed", "1"): Value(10160.0, "mm/min")})
    wrong.workspace.edit("rapid", {("feedrate.rapid", "1"): Value(9000.0, "mm/min")})
    rule = "9pc.home.g28-speed-above-rapid"
    wrong.findings.select(next(f for f in wrong.workspace.findings if f.rule == rule))

    wrong.findings.explain()

    dialog = wrong.findChild(WhyDialog)
    text = dialog.page.toPlainText()
    assert "10160 mm/min <= 9000 mm/min" in text
    dialog.page.anchorClicked.emit(QUrl("seen:1"))
    assert wrong.selected() == ("feedrate.rapid", "1")
    dialog.close()


def test_a_finding_is_left_as_it_is_with_a_reason_and_a_name(wrong: MainWindow, path, monkeypatch) -> None:
    finding = next(f for f in wrong.workspace.findings if f.addresses[0] == EXCESS)
    wrong.findings.select(finding)

    def fill(dialog: SuppressDialog) -> bool:
        dialog.form.set_answer("reason", "measured on the machine")
        dialog.form.set_answer("name", "")
        ok = dialog.findChild(QDialogButtonBox).button(QDialogButtonBox.StandardButton.Ok)
        assert not ok.isEnabled(), "a name is wanted"
        dialog.form.set_answer("name", "J. Doe")
        assert ok.isEnabled()
        return True

    monkeypatch.setattr(SuppressDialog, "exec", fill)
    wrong.findings.suppress()

    assert all(EXCESS not in f.addresses or f.rule != finding.rule for f in wrong.workspace.findings)
    assert [s.suppression.by for s in wrong.workspace.validator.suppressed] == ["J. Doe"]
    chip = wrong.findings.suppressed
    assert chip.text() == "1 suppressed"
    assert not any("J. Doe" in group.message for group in wrong.findings.model.groups)
    chip.click()
    assert any(
        "Suppressed by J. Doe: measured on the machine" in f.message
        for g in wrong.findings.model.groups
        for f in g.findings
    )
    assert "measured on the machine" in path.with_name("rules.yaml").read_text()


def test_safe_fixes_are_one_step_that_can_be_undone(window: MainWindow) -> None:
    patched = ("oci.connections", "")
    rule = next(r for r in window.workspace.file.schema.rules if r.id == "9pc.oci.one-connection")
    assert rule.fix[0].safe
    assert rule.reads[rule.fix[0].set] == patched[0]
    before = window.workspace.file.get(patched)
    window.workspace.edit("wrong", {patched: Value(2)}, force="on a day")
    steps = window.workspace.undo_stack.count()

    window.edits.fix_safe()

    assert window.workspace.undo_stack.count() == steps + 1
    assert not [f for f in window.workspace.findings if f.rule == rule.id]
    window.menus["edit.undo"].trigger()
    window.menus["edit.undo"].trigger()
    assert window.workspace.file.get(patched) == before


def test_what_the_control_uses_instead_is_behind_an_arrow(path, open_window) -> None:
    path.with_name("rules.yaml").write_text(
        "rules:\n  - {id: own.clamp, title: Clamp, severity: warning, reads: {error: servo.excess_error},"
        ' check: error <= 1.0, message: "no", effective: [{set: error, value: "1.0"}]}\n'
    )
    window = open_window(path)
    window.go_to(EXCESS)
    assert window.table.cell_text(EXCESS).endswith(" → 1 mm")
    assert "1 mm effective value in the control" in window.detail.page.toPlainText()


def test_keys_go_from_finding_to_finding_and_their_values(delivered: MainWindow) -> None:
    groups = delivered.findings.model.groups
    delivered.findings.view.setCurrentIndex(delivered.findings.model.index(0, 0))
    action(delivered, "Next Finding").trigger()
    assert delivered.selected() == groups[1].findings[0].addresses[0]
    for _ in range(2):
        action(delivered, "Previous Finding").trigger()
    assert delivered.findings.view.currentIndex().row() == len(groups) - 1


def test_the_outline_of_a_finding_ends_with_it(window: MainWindow) -> None:
    page = window.page
    window.workspace.edit("turned", {("zone.overtravel_positive", "1"): Value(-400.0, "mm")})
    page.findings.select(next(f for f in window.workspace.findings if f.compared))
    assert page.table.outlined
    page.findings.show_all()
    window.workspace.undo_stack.undo()
    assert page.findings.current_findings() == ()
    assert page.table.outlined == frozenset()


def test_a_typed_slip_is_asked_about_until_it_is_saved_and_saved_again(window: MainWindow) -> None:
    workspace, address = window.workspace, ("cycle.peck_retract", "")
    was = workspace.file.get(address)
    assert was is not None

    def asked() -> list[str]:
        return [f.message for f in workspace.findings if f.rule == "plausible.earlier"]

    assert asked() == []
    workspace.edit("a slip", {address: Value(was.value / 2, was.unit)})
    assert asked() == []
    workspace.edit("a slip", {address: Value(was.value * 10, was.unit)})
    (message,) = asked()
    assert message.endswith("in the saved file. Is it meant?")
    workspace.save()
    (message,) = asked()
    assert message.endswith("in the backup. Is it meant?")
    workspace.edit("another", {("axis.name", "1"): Value("Y")}, force="a test")
    workspace.save()
    assert asked() == []


def test_an_axis_of_a_finding_is_called_by_its_letter_where_that_is_clear(workspace: Workspace) -> None:
    """ "Port 1 of axis 2 belongs to an axis before it" was the text for the axis whose column is Y."""

    def text_of(message: str) -> str:
        return finding_text(workspace.file, Finding("own", "warning", (), message))

    assert text_of("The table of axis 2 cannot be used.") == "The table of axis Y cannot be used."
    assert text_of("Axis 2 has the name Y of axis 3.") == "Axis 2 has the name Y of axis 3."
    assert text_of("20020 Limits of 10000 mm, -5 mm.") == "20020 Limits of 10\u202f000 mm, −5 mm."
