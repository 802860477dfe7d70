"""After an exchange that broke off the page shows of each value what the control has of it, whatever the
control calls it.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from pytestqt.qtbot import QtBot

from amp_studio.families.acromill.emulated.card import AcrCard
from amp_studio.families.acromill.lines.driver import TerminalDriver
from amp_studio.files import new_file
from amp_studio.files.storage import save_file
from amp_studio.schema import Value
from amp_studio.transfer.client import parameters
from amp_studio.transfer.emulated.line_device import DeviceSetup
from amp_studio.transfer.emulated.memory import Memory
from amp_studio.transfer.errors import ConnectionCutError
from amp_studio.ui.control.differences import REMARK
from amp_studio.ui.control.page import ControlPage
from amp_studio.ui.main_window import MainWindow
from tests.transfer.device_line import served

from .at_control import at_control, settled

SET = {("axes.pulses_per_unit", "X"): 4096.0, ("servo.p_gain", "X"): 0.08, ("servo.p_gain", "Y"): 0.09}


@contextmanager
def sending_to_card(window: MainWindow, folder: Path, qtbot: QtBot) -> Iterator[ControlPage]:
    """Give the page before three values are sent to an emulated ACR card."""
    file = new_file("acromill")
    for (name, axis), number in SET.items():
        file.set((name, axis), Value(number, file.get((name, axis)).unit))
    path = folder / "router.amp"
    save_file(file, path)
    window.open_first(path)
    card = AcrCard(DeviceSetup("acromill", Memory(folder / "card"), print))
    with served(card, "tcp://127.0.0.1:0?protocol=terminal") as (address, _):
        page = at_control(window, address, "send", qtbot)
        page.checked.setChecked(True)
        yield page


def remarks(page: ControlPage) -> list[str]:
    return [page.table._items[address].text(REMARK) for address in SET]


def stop_after(monkeypatch: pytest.MonkeyPatch, page: ControlPage, count: int) -> None:
    """Have the user stop when so many values are confirmed."""
    real = parameters.download_file

    def download(file, address, exchange, **approved):
        def report(stage: str, done: int, total: int) -> None:
            exchange.progress(stage, done, total)
            if (stage, done) == ("download", count):
                exchange.cancel.set()

        return real(file, address, replace(exchange, progress=report), **approved)

    monkeypatch.setattr(parameters, "download_file", download)


def test_a_stop_shows_which_values_a_card_has_that_calls_them_by_commands(
    window: MainWindow, qtbot: QtBot, tmp_path: Path, monkeypatch
) -> None:
    """Only a control whose names are the numbers of the window showed it."""
    with sending_to_card(window, tmp_path, qtbot) as page:
        stop_after(monkeypatch, page, 2)
        page.press()
        settled(window, qtbot)
    assert page.bar.text.text().startswith("The control contains some of both: new and old values.")
    assert remarks(page) == ["new", "new", "old"]
    assert page.counts.text() == "2 new, 1 old"
    assert page.ends.counts == {"new": 2, "old": 1}
    parts = page.ends.parts()
    assert parts["new"] > parts["old"]


def test_a_line_that_is_lost_for_good_shows_what_was_confirmed_and_what_was_not_sent(
    window: MainWindow, qtbot: QtBot, tmp_path: Path, monkeypatch
) -> None:
    """Nothing was shown of any value, though it is known that one of them was never sent."""
    begun = TerminalDriver._command

    def command(self: TerminalDriver, transfer: Any, name: str) -> str:
        if name != "PGAIN X":
            return begun(self, transfer, name)
        transfer.begin(name)
        raise ConnectionCutError("the line broke")

    monkeypatch.setattr(TerminalDriver, "_command", command)
    with sending_to_card(window, tmp_path, qtbot) as page:
        page.press()
        settled(window, qtbot)
    assert page.bar.text.text().startswith("It is not known what the control contains.")
    assert remarks(page) == ["confirmed", "not answered", "not sent"]
    assert page.ends.counts == {"new": 1, "open": 1, "old": 1}
