"""Every window that a command of the menus opens: no text is cut, numbers are those of the cells, and every
button names what it does.
"""

from collections.abc import Iterator

import pytest
from PySide6.QtWidgets import QApplication, QDialog, QFileDialog, QMessageBox, QPushButton, QWidget

from amp_studio.files import Project, ProjectInfo
from amp_studio.ui.main_window import MainWindow

from .test_screens import cells, heads, is_cut, overlaps, settled, texts, unreadable

LEFT_OUT = {
    "file.exit",
    "file.close",
    "help.log",  # opens the folder of the system
    "control.start",  # an emulated control
    "control.live",
    "control.send",
    "control.compare",
    "control.read",
}


def faults(window: QWidget) -> Iterator[tuple[object, ...]]:
    """Yield what is wrong with a window as it is seen."""
    if window.width() > 700:  # the screen of the tests is narrower than any of a person
        window.resize(1024, 700)
    settled()
    yield from ((type(w).__name__, text) for w, text in texts(window) if is_cut(w))
    yield from (*heads(window), *cells(window), *overlaps(window), *unreadable(window))
    for button in window.findChildren(QPushButton):
        if button.text().replace("&", "") in ("OK", "Yes", "No"):
            yield "a button without a verb", button.text()


@pytest.mark.own_window
def test_every_window_of_a_command_can_be_read_and_its_buttons_say_what_they_do(
    window: MainWindow, monkeypatch: pytest.MonkeyPatch
) -> None:
    """``Copy File…`` asked with "OK"; axes without a number were called ``servo.velocity_port@1``."""
    found: list[tuple[object, ...]] = []
    seen: list[str] = []

    def look(box: QDialog) -> int:
        seen.append(name)
        box.show()
        found.extend((name, *each) for each in faults(box))
        box.hide()
        return 0

    monkeypatch.setattr(QDialog, "exec", look)
    for kind in QDialog.__subclasses__():
        monkeypatch.setattr(kind, "exec", look)
    monkeypatch.setattr(QMessageBox, "clickedButton", lambda _: None)
    for static in ("getOpenFileName", "getSaveFileName", "getOpenFileNames"):
        monkeypatch.setattr(QFileDialog, static, lambda *_, **__: ("", ""))
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *_, **__: "")
    window.project = Project.create(window.workspace.path.parent, ProjectInfo("HALL_2", "9pc"))
    window.go_to(("servo.excess_error", "1"))
    for name, act in window.menus.items():
        if name in LEFT_OUT or act.isCheckable() or not act.isEnabled():
            continue
        act.trigger()
        settled()
        for opened in window.findChildren(QDialog):
            if opened.isVisible():
                seen.append(name)
                found.extend((name, *each) for each in faults(opened))
                opened.close()
        QApplication.processEvents()
    assert len(seen) > 20
    assert found == [], "\n".join(map(str, found))
