"""The findings below the table."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt, QUrl
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDialogButtonBox

from amp_studio.schema import Value
from amp_studio.ui.finding_dialogs import SuppressDialog, WhyDialog
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.workspace import Workspace

from .conftest import WAIT_MS

EXCESS = ("servo.excess_error", "1")


@pytest.fixture
def wrong(window: MainWindow) -> MainWindow:
    """Return a window with three values out of range."""
    axes = "123"
    wanted = {("servo.excess_error", a): Value(1e6, "mm") for a in axes}
    window.workspace.edit("force", wanted, force="on a day")
    return window


def test_errors_come_first_and_are_counted(wrong: MainWindow) -> None:
    model = wrong.findings.model
    assert model.index(0, 0).data() == "error"
    errors = wrong.workspace.count("error")
    assert errors >= 3
    assert wrong.findings.counts.text().startswith(f"{errors} errors, ")
    assert wrong.status.counts["error"].text() == str(errors)
    assert not model.index(0, 0).data(Qt.ItemDataRole.DecorationRole).isNull()


def test_the_selected_finding_stays_selected(wrong: MainWindow) -> None:
    finding = next(f for f in wrong.workspace.findings if f.addresses[0] == ("servo.excess_error", "3"))
    wrong.findings.view.selectRow(wrong.workspace.findings.index(finding))

    wrong.workspace.edit("mend", {EXCESS: Value(11.0, "mm")})

    assert wrong.findings.current().addresses == finding.addresses


def test_when_a_finding_has_ended_the_next_one_is_selected(path, bare: bytes, open_window) -> None:
    path.write_bytes(bare)
    panel = open_window(path).findings
    place = next(n for n, f in enumerate(panel.model.findings) if f.fix and n)
    panel.view.selectRow(place)
    ended = panel.model.findings[place]
    panel.fix()
    left = panel.model.findings
    assert ended not in left
    assert panel.view.currentIndex().row() == min(place, len(left) - 1) > 0


def test_enter_shows_the_parameter_of_a_finding(wrong: MainWindow) -> None:
    finding = next(f for f in wrong.workspace.findings if f.addresses[0] == ("servo.excess_error", "2"))
    wrong.findings.view.selectRow(wrong.workspace.findings.index(finding))
    wrong.show_panel("Findings")
    assert wrong.findings.view.hasFocus()

    QTest.keyClick(wrong.findings.view, Qt.Key.Key_Return)

    assert wrong.selected() == ("servo.excess_error", "2")
    assert wrong.table_view.hasFocus()


def test_the_fix_button_fixes_and_only_where_there_is_a_fix(path, bare: bytes, open_window) -> None:
    path.write_bytes(bare)
    wrong = open_window(path)
    findings = wrong.workspace.findings
    able = next(n for n, f in enumerate(findings) if f.fix)
    unable = next(n for n, f in enumerate(findings) if not f.fix)
    wrong.findings.view.selectRow(unable)
    assert not wrong.findings.fix_button.isEnabled()

    wrong.findings.view.selectRow(able)
    assert wrong.findings.fix_button.isEnabled()
    setting = findings[able].fix[0]
    wrong.findings.fix_button.click()
    assert wrong.workspace.file.get(setting.address) == setting.value


def test_a_finding_without_a_fix_says_so(path, bare: bytes, open_window, person) -> None:
    path.write_bytes(bare)
    wrong = open_window(path)
    unable = next(n for n, f in enumerate(wrong.workspace.findings) if not f.fix)
    wrong.findings.view.selectRow(unable)
    wrong.guarded(wrong.edits._fix)
    assert "has no suggested fix" in person.reads()


def test_rows_are_as_high_as_their_words_need(wrong: MainWindow, qtbot) -> None:
    """Also when the window becomes narrower."""
    view = wrong.findings.view
    rows = range(len(wrong.workspace.findings))
    for width in (1700, 900, 1300):
        wrong.resize(width, 900)
        qtbot.waitUntil(
            lambda: [view.rowHeight(n) for n in rows] == [view.sizeHintForRow(n) for n in rows],
            timeout=WAIT_MS,
        )


def test_a_hidden_parameter_of_a_finding_can_be_shown(window: MainWindow, workspace: Workspace) -> None:
    """Going to what does not exist for this configuration turns the option on."""
    hidden = ("control.lathe_type", "")  # page 3-9: on a lathe only
    window.go_to(hidden)
    assert window.view.hidden_too.isChecked()
    assert window.selected() == hidden


def test_an_unfitted_axis_can_be_shown(window: MainWindow) -> None:
    window.go_to(("axis.type", "7"))
    assert window.view.all_axes.isChecked()
    assert window.selected() == ("axis.type", "7")


def test_why_shows_the_rule_and_leads_to_its_parameters(wrong: MainWindow) -> None:
    wrong.workspace.edit("speed", {("home.g28_speed", "1"): Value(10160.0, "mm/min")})
    wrong.workspace.edit("rapid", {("feedrate.rapid", "1"): Value(9000.0, "mm/min")})
    rule = "9pc.home.g28-speed-above-rapid"
    row = next(n for n, f in enumerate(wrong.workspace.findings) if f.rule == rule)
    wrong.findings.view.selectRow(row)

    wrong.findings.why_button.click()

    dialog = wrong.findChild(WhyDialog)
    text = dialog.page.toPlainText()
    assert "10160 mm/min <= 9000 mm/min" in text
    dialog.page.anchorClicked.emit(QUrl("seen:1"))
    assert wrong.selected() == ("feedrate.rapid", "1")
    dialog.close()


def test_a_finding_is_left_as_it_is_with_a_reason_and_a_name(wrong: MainWindow, path, monkeypatch) -> None:
    finding = next(f for f in wrong.workspace.findings if f.addresses[0] == EXCESS)
    wrong.findings.view.selectRow(wrong.workspace.findings.index(finding))

    def fill(dialog: SuppressDialog) -> bool:
        dialog.reason.setText("measured on the machine")
        dialog.name.clear()
        ok = dialog.findChild(QDialogButtonBox).button(QDialogButtonBox.StandardButton.Ok)
        assert not ok.isEnabled(), "a name is wanted"
        dialog.name.setText("J. Doe")
        assert ok.isEnabled()
        return True

    monkeypatch.setattr(SuppressDialog, "exec", fill)
    wrong.findings.suppress_button.click()

    assert all(EXCESS not in f.addresses or f.rule != finding.rule for f in wrong.workspace.findings)
    assert [s.suppression.by for s in wrong.workspace.validator.suppressed] == ["J. Doe"]
    assert "1 suppressed" in wrong.findings.counts.text()
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
    window.edits.undo.trigger()
    window.edits.undo.trigger()
    assert window.workspace.file.get(patched) == before


def test_what_the_control_uses_instead_stands_behind_an_arrow(path, open_window) -> None:
    path.with_name("rules.yaml").write_text(
        "rules:\n  - {id: own.clamp, title: Clamp, severity: warning, reads: {error: servo.excess_error},"
        ' check: error <= 1.0, message: "no", effective: [{set: error, value: "1.0"}]}\n'
    )
    window = open_window(path)
    window.go_to(EXCESS)
    assert window.table.cell_text(EXCESS).endswith(" → 1 mm")
    assert "1 mm effective value in the control" in window.detail.pages["Help"].toPlainText()
