"""Several controls from the window, and the exchanges that were recorded."""

from __future__ import annotations

from pathlib import Path

import pytest

from amp_studio.ui.control.exchanges_dialog import ExchangesDialog
from amp_studio.ui.control.fleet_dialog import FleetDialog
from amp_studio.ui.main_window import MainWindow

from .conftest import Person, action

DEAD = "tcp://127.0.0.1:1"


@pytest.fixture
def dialog(window: MainWindow) -> FleetDialog:
    """Return the dialog, open."""
    action(window, "Several Controls").trigger()
    found = window.findChild(FleetDialog)
    assert isinstance(found, FleetDialog)
    return found


def results(dialog: FleetDialog) -> list[tuple[str, str]]:
    """Return the address and the result of each row."""
    rows = (dialog.table.topLevelItem(n) for n in range(dialog.table.topLevelItemCount()))
    return [(row.text(0), row.text(1)) for row in rows]


def test_a_file_goes_to_several_controls_and_each_exchange_is_recorded(
    window: MainWindow, dialog: FleetDialog, path: Path, start_control, person: Person
) -> None:
    one, two = start_control().address, start_control().address
    dialog.addresses.setPlainText(f"{one}\n\n  {two}\n")
    person.answers("Download")
    dialog.download_button.click()
    assert results(dialog) == [(one, "done"), (two, "done")]
    dialog.verify_button.click()
    assert results(dialog) == [(one, "same"), (two, "same")]
    table = path.with_name("table.html")
    person.chooses(table)
    dialog.save_button.click()
    assert one in table.read_text()

    action(window, "Exchanges of This File").trigger()
    listed = window.findChild(ExchangesDialog).tree
    assert [listed.topLevelItem(n).text(2) for n in range(listed.topLevelItemCount())] == (
        ["verify", "verify", "download", "download"]
    )
    assert listed.topLevelItem(3).childCount() > 0, "what the download changed"


def test_after_a_failure_the_next_control_is_not_begun(
    dialog: FleetDialog, start_control, person: Person
) -> None:
    control = start_control().address
    dialog.addresses.setPlainText(f"{DEAD}\n{control}")
    person.answers("Download")
    dialog.download_button.click()
    assert results(dialog) == [(DEAD, "failed"), (control, "not tried")]


@pytest.mark.parametrize(
    ("text", "problem"),
    [("", "Name at least one control"), (f"{DEAD}\n{DEAD}", "is named twice"), ("x", "is no address")],
)
def test_addresses_that_cannot_be_used_are_refused(
    dialog: FleetDialog, person: Person, text: str, problem: str
) -> None:
    dialog.addresses.setPlainText(text)
    dialog.verify_button.click()
    assert problem in person.reads()
