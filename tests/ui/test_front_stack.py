"""A stack is as small as what is in front of it may be."""

from PySide6.QtWidgets import QSizePolicy, QWidget
from pytestqt.qtbot import QtBot

from amp_studio.ui.forms.front_stack import FrontStack


def test_what_is_behind_asks_for_no_room_and_what_makes_do_asks_for_none(qtbot: QtBot) -> None:
    stack, wide, narrow, ignored = FrontStack(), QWidget(), QWidget(), QWidget()
    qtbot.addWidget(stack)
    wide.setMinimumSize(1600, 300)
    narrow.setMinimumSize(300, 200)
    ignored.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Ignored)
    for page in (wide, narrow, ignored):
        stack.addWidget(page)
    assert stack.minimumSizeHint().width() == 1600
    stack.setCurrentWidget(narrow)
    assert stack.minimumSizeHint().width() == 300
    stack.setCurrentWidget(ignored)
    assert stack.minimumSizeHint().width() <= 0
