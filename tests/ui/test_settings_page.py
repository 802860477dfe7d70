"""The one page of settings: each takes effect at once, or the page names when."""

import sys
from types import SimpleNamespace

import pytest
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QTreeWidget

from amp_studio.transfer.links import enter_password, parse_endpoint
from amp_studio.ui.base.known_controls import KnownControl
from amp_studio.ui.dialogs.settings_dialog import PAGES, SettingsDialog
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.window.settings import UserSettings

from .alt_letters import doubled, texts_of
from .conftest import User

PLACE = "tcp://127.0.0.1:9"


@pytest.fixture
def dialog(window: MainWindow) -> SettingsDialog:
    """Return the page as its action opens it."""
    window.menus["view.settings"].trigger()
    return window.findChild(SettingsDialog)


def test_language_is_kept_and_units_change_at_once(window: MainWindow, dialog: SettingsDialog) -> None:
    dialog.form.set_answer("language", "de")
    assert UserSettings().language() == "de"
    dialog.form.set_answer("units", "inch")
    assert window.workspace.file.header.units == "inch"


def test_the_keys_are_found_by_words_of_their_command(dialog: SettingsDialog) -> None:
    dialog.search.setText("save as")
    rows = [dialog.keys.topLevelItem(n) for n in range(dialog.keys.topLevelItemCount())]
    assert ("File › Save As", "Ctrl+Shift+S") in [(row.text(0), row.text(1)) for row in rows]
    assert len(rows) < 4, "commands without the words are left out"


def test_a_password_is_forgotten_where_it_is_kept(
    window: MainWindow, dialog: SettingsDialog, monkeypatch: pytest.MonkeyPatch
) -> None:
    ring = {("amp-studio", PLACE): "open"}
    known = SimpleNamespace(
        get_password=lambda *key: ring.get(key), delete_password=lambda *key: ring.pop(key)
    )
    monkeypatch.setitem(sys.modules, "keyring", known)
    window.settings.keep_controls([KnownControl(PLACE, "9pc", "mill")])
    enter_password(parse_endpoint(PLACE), "open")
    dialog.tabs.setCurrentIndex(PAGES.index("passwords"))
    row = dialog.passwords.topLevelItem(0)
    assert (row.text(0), row.text(1)) == ("mill", "until AMP Studio ends")
    dialog._forget()
    assert ring == {}
    assert dialog.passwords.topLevelItem(0).text(0) == "No password is kept."


def test_a_folder_is_opened_and_one_that_is_not_there_is_named(
    window: MainWindow, dialog: SettingsDialog, user: User, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: opened.append(url.toLocalFile()))
    dialog._open_folder()
    assert opened == [str(window.workspace.path.parent)]
    dialog.folders.setCurrentItem(dialog.folders.topLevelItem(1))
    window.guarded(dialog._open_folder)
    assert "templates does not exist yet" in user.reads()


@pytest.mark.parametrize("page", PAGES)
def test_every_part_of_it_has_each_letter_once(dialog: SettingsDialog, page: str) -> None:
    dialog.tabs.setCurrentIndex(PAGES.index(page))
    assert doubled(texts_of(dialog)) == {}


@pytest.mark.parametrize("page", PAGES[1:])
def test_the_rows_of_every_list_are_high_enough_to_be_clicked(dialog: SettingsDialog, page: str) -> None:
    dialog.show()
    dialog.show_page(page)
    for rows in dialog.tabs.currentWidget().findChildren(QTreeWidget):
        for n in range(min(3, rows.topLevelItemCount())):
            assert rows.visualItemRect(rows.topLevelItem(n)).height() >= 22
