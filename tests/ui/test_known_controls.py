"""The controls on the welcome page: what is remembered of each, and what can be done from there."""

import json
from datetime import UTC, datetime

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from amp_studio.transfer.errors import TransferError
from amp_studio.ui.base.known_controls import (
    MAX_CONTROLS,
    KnownControl,
    read_controls,
    stored_controls,
    with_exchange,
)
from amp_studio.ui.welcome.list import ROW
from amp_studio.ui.window.settings import UserSettings

NOW = datetime(2026, 3, 12, 8, 45, tzinfo=UTC)
PLACE = "tcp://192.168.0.10:9600"


def rows(page):
    view = page.controls.list
    return [view.item(n).data(ROW) for n in range(view.count())]


def test_the_last_exchange_comes_first_and_what_a_control_did_not_say_stays() -> None:
    known = with_exchange([], PLACE, "upload", reached=True, family="9pc", name="CNC_1", now=NOW)
    known = with_exchange(known, "tcp://10.0.0.2:9600", "connect", reached=False, now=NOW)
    known = with_exchange(known, PLACE, "verify", reached=False, now=NOW)
    assert known[0] == KnownControl(
        PLACE, "9pc", "CNC_1", "verify", "2026-03-12T08:45:00+00:00", reached=False
    )
    assert [each.address for each in known] == [PLACE, "tcp://10.0.0.2:9600"]
    assert read_controls(stored_controls(known)) == known


def test_only_so_many_are_remembered() -> None:
    known: list[KnownControl] = []
    for n in range(MAX_CONTROLS + 3):
        known = with_exchange(known, f"tcp://10.0.0.{n}:9600", "connect", reached=True, now=NOW)
    assert (len(known), known[0].address) == (MAX_CONTROLS, f"tcp://10.0.0.{MAX_CONTROLS + 2}:9600")


@pytest.mark.parametrize(
    "odd",
    [
        None,
        7,
        "",
        "{",
        "[]",
        '{"address": 5}',
        '{"address": ""}',
        "[" * 100_000,
        json.dumps({"address": "x" * 1000}),
    ],
)
def test_what_is_stored_and_is_no_control_is_left_out(odd: object) -> None:
    assert read_controls([odd]) == []
    assert read_controls(odd) == []


def test_an_odd_time_or_verb_is_no_reason_to_forget_a_control() -> None:
    (found,) = read_controls(json.dumps({"address": PLACE, "verb": "explode", "when": "0001-01-01T00:00:00"}))
    assert (found.address, found.verb) == (PLACE, "connect")
    assert KnownControl(PLACE, when="nonsense").moment is None


def test_without_a_control_the_page_shows_what_upload_does(open_window) -> None:
    page = open_window().welcome.controls
    assert page.none.isVisibleTo(page)
    assert not page.connect_button.isEnabled()
    assert page.upload_button.isEnabled()


def test_a_control_is_connected_from_the_page_and_taken_from_the_list(
    open_window, start_control, user, qtbot, tmp_path
) -> None:
    control = start_control()
    UserSettings().keep_controls([])
    window = open_window()
    UserSettings().keep_controls([KnownControl(control.address, when=NOW.isoformat(), reached=False)])
    page = window.welcome
    page.show_recent([])
    assert rows(page)[0].status == "not reached"
    page.controls.list.setFocus()
    QTest.keyClick(page.controls.list, Qt.Key.Key_Return)
    (known,) = window.settings.controls()
    assert (known.address, known.family, known.verb, known.reached) == (
        control.address,
        "9pc",
        "connect",
        True,
    )
    assert "connected" in rows(page)[0].right
    assert "E-stop" in rows(page)[0].second
    control.stop()
    page.controls.connect_button.click()
    assert "no connection to the control" in user.reads()
    assert rows(page)[0].status == "not reached"
    assert "E-stop" not in rows(page)[0].second
    page.controls._on_current(page.controls._forget)
    assert rows(page) == []


def test_an_upload_that_fails_is_remembered_as_not_reached(open_window, monkeypatch) -> None:
    exchanges = open_window().control.exchanges

    def fail():
        raise TransferError("no connection to the control (refused)")

    with pytest.raises(TransferError):
        exchanges._recorded(PLACE, "upload", fail, "")
    (known,) = exchanges.window.settings.controls()
    assert (known.address, known.verb, known.reached) == (PLACE, "upload", False)
