"""Live at a control that asks for a password nobody has given yet."""

from collections.abc import Callable
from typing import Any

import pytest
from pytestqt.qtbot import QtBot

from amp_studio.ui.main_window import MainWindow

from .at_control import settled
from .conftest import WAIT_MS, User

Start = Callable[..., Any]

pytestmark = pytest.mark.own_window


def test_live_leads_to_the_field_for_a_password_and_goes_on_with_it(
    window: MainWindow, start_control: Start, user: User, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Live named the variable of the command line and the keyring."""
    monkeypatch.setattr("amp_studio.transfer.links.password.ROUNDS", 10)
    window.control.exchanges.choose(window.workspace, start_control(password="open sesame").address)
    window.menus["control.live"].trigger()
    page: Any = window.page_in_front.pages["live"]
    qtbot.waitUntil(page.bar.isVisible, timeout=WAIT_MS)
    assert page.bar.text.text() == "The control asks for its password, which is entered there."
    (way,) = page.bar.buttons
    way.click()
    control = window.control.page
    settled(window, qtbot)
    assert control.password.isVisible()
    control.password.setText("open sesame")
    control._enter_password()
    settled(window, qtbot)
    assert control.session.seen is not None
    window.menus["control.live"].trigger()
    qtbot.waitUntil(lambda: page._status is not None, timeout=2 * WAIT_MS)
    assert page.is_live
    assert not page.bar.isVisible()
