"""The help menu: the keys of all actions, and a text to report a problem with that has nothing
of the machine without a yes.
"""

from pathlib import Path

import platformdirs
import pytest

from amp_studio.trouble import keep_details
from amp_studio.ui.actions import help as help_menu
from amp_studio.ui.dialogs.settings_dialog import SettingsDialog
from amp_studio.ui.main_window import MainWindow

from .conftest import User, action


@pytest.fixture(autouse=True)
def log(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(platformdirs, "user_log_dir", lambda name: str(tmp_path / "log"))
    return tmp_path / "log"


def test_the_keys_of_all_actions_are_listed(window: MainWindow) -> None:
    action(window, "Keys").trigger()
    dialog = window.findChild(SettingsDialog)
    rows = [dialog.keys.topLevelItem(n) for n in range(dialog.keys.topLevelItemCount())]
    page = "\n".join(f"{row.text(0)} {row.text(1)}" for row in rows)
    for name, keys in (("Save", "Ctrl+S"), ("Find", "Ctrl+F, Ctrl+K"), ("Fill Down", "Ctrl+D")):
        assert name in page
        assert keys in page


def failed() -> None:
    try:
        raise ValueError("secret-machine is at 12.7 mm")
    except ValueError as error:
        keep_details(error)


@pytest.mark.parametrize("answer", ["With Them", "Without Them"])
def test_a_report_has_what_is_of_the_machine_only_with_a_yes(
    window: MainWindow, user: User, tmp_path: Path, answer: str
) -> None:
    failed()
    window.edits.commit(("servo.excess_error", "1"), "0.001 mm")
    user.answers(answer)
    user.chooses(tmp_path / "report.txt")
    action(window, "Report a Problem").trigger()
    text = (tmp_path / "report.txt").read_text()
    assert "AMP Studio " in text
    assert "Qt " in text
    assert 'test_help.py", line' in text or "test_help.py, line" in text
    own = [
        "secret-machine",
        "12.7",
        str(tmp_path),
        str(Path(__file__).parent),
        "9pc",
        *(f.message for f in window.workspace.findings),
    ]
    assert [each in text for each in own if answer == "Without Them"] == [False] * (
        len(own) if answer == "Without Them" else 0
    )
    assert answer == "Without Them" or ("secret-machine" in text and "Family 9pc" in text)


def test_a_report_that_is_not_wanted_is_not_written(window: MainWindow, user: User, tmp_path: Path) -> None:
    user.answers("Cancel")
    action(window, "Report a Problem").trigger()
    assert not (tmp_path / "report.txt").exists()


def test_the_log_folder_is_made_and_opened(
    window: MainWindow, log: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened = []
    monkeypatch.setattr(help_menu.QDesktopServices, "openUrl", opened.append)
    action(window, "Open Log Folder").trigger()
    assert log.is_dir()
    assert opened[0].toLocalFile() == str(log)
