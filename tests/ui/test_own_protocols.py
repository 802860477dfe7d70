"""The window exchanges files with controls in their own ways of speaking,
through the same actions as any other.
"""

import threading
from pathlib import Path

from PySide6.QtCore import QTimer
from pytestqt.qtbot import QtBot

from amp_studio.families.acromill.emulated.card import AcrCard
from amp_studio.families.num.emulated.control import NumControl
from amp_studio.files import new_file
from amp_studio.files.storage import save_file
from amp_studio.schema import Value
from amp_studio.transfer.emulated.line_device import DeviceSetup
from amp_studio.transfer.emulated.memory import Memory
from amp_studio.transfer.waiting import OPERATOR
from amp_studio.ui.base.task import ProgressDialog
from amp_studio.ui.main_window import MainWindow
from tests.families.num.lines.test_num_command_line import SMALL
from tests.transfer.device_line import served

from .at_control import at_control, settled
from .conftest import WAIT_MS


def test_an_acr_card_is_verified_and_downloaded_over_its_terminal(
    window: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    path = tmp_path / "router.amp"
    file = new_file("acromill")
    file.set(("servo.p_gain", "X"), Value(0.08, "V/count"))
    save_file(file, path)
    window.open_first(path)
    card = AcrCard(DeviceSetup("acromill", Memory(tmp_path / "card"), print))
    with served(card, "tcp://127.0.0.1:0?protocol=terminal") as (address, _):
        page = at_control(window, address, "send", qtbot)
        assert len(page.table.rows_taking(file=True)) == 1, (
            "what a card does not keep is not shown as a change of it"
        )
        page.checked.setChecked(True)
        page.press()
        settled(window, qtbot)
        message = page.empty.text()
        page.connect_again()
        settled(window, qtbot)
        compared = page.empty.text()
    assert "Download complete and read back equal. The card has saved it (ESAVE)." in message
    assert card.settings.values["PGAIN X"] == "0.08"
    assert compared.startswith("Nothing differs: 112 values and every byte are the same.")


def test_the_page_shows_what_to_press_at_a_num_control_until_it_is_done(
    window: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    """Nothing was shown, and the control, which only its operator can have send its table, stayed silent."""
    memory = Memory(tmp_path / "cnc")
    memory.replace("table", SMALL)
    path = tmp_path / "lathe.amp"
    save_file(new_file("num"), path)
    window.open_first(path)
    with served(
        NumControl(DeviceSetup("num", memory, lambda _: None)), "tcp://127.0.0.1:0?protocol=peripheral"
    ) as (address, service):
        window.control.exchanges.choose(window.workspace, address)
        window.control.show("compare", address)
        page = window.control.page
        qtbot.waitUntil(lambda: "3 UNLOAD" in page.bar.text.text(), timeout=WAIT_MS)
        assert not page.bar.isHidden()
        for key in ("exit", "unload", "enter", "start"):
            service.operate(key)
        settled(window, qtbot)
        assert page.session.phase == "ready"
        assert "3 UNLOAD" not in page.bar.text.text() or page.bar.isHidden()


def test_what_a_user_is_to_do_at_the_control_is_shown_until_it_is_done(window: MainWindow) -> None:
    texts: list[str] = []
    seen = threading.Event()

    def work(progress, cancel):
        assert seen.wait(30)
        progress("At the control: 3 UNLOAD", 0, OPERATOR)
        progress("silent", 5, 0)
        progress("upload", 1, 2)

    dialog = ProgressDialog("Work", work, window, "Waiting …", {"upload": "Reading …"})
    dialog.task.progressed.connect(lambda *_: texts.append(dialog.text.text()))
    QTimer.singleShot(0, seen.set)
    dialog.run()
    assert texts == [
        "At the control: 3 UNLOAD",
        "At the control: 3 UNLOAD\nNo answer for 5 s, trying again …",
        "Reading …",
    ]
