"""The program starts whatever is in its settings."""

import os
import stat
import sys
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import QByteArray, QRect, QSettings, Qt
from PySide6.QtWidgets import QDockWidget

from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.window.settings import UserSettings, is_there, on_screen, stored_in

from .conftest import WAIT_MS

LONG = "/" + "x" * 5_000
SCREEN = QRect(0, 0, 1024, 768)


def remember(**entries: object) -> None:
    """Write entries into the settings of the user."""
    settings = QSettings("AMP Studio", "AMP Studio")
    for key, value in entries.items():
        settings.setValue(key, value)
    settings.sync()


@pytest.mark.parametrize(
    "recent", [[LONG], LONG, 5, {"a": 1}, ["", None, 7], ["a\0b"], [["x"]], b"\xff\x00", [LONG] * 100]
)
def test_recent_files_that_cannot_be_looked_at_are_left_out(open_window, path: Path, recent: object) -> None:
    remember(recent=recent, control=recent, geometry=recent, layout=recent)
    window: MainWindow = open_window()
    assert window.files.recent.paths() == []
    window.open_first(path)
    assert window.files.recent.paths() == [path]
    assert window.workspace is not None


def test_a_recent_file_in_a_folder_without_permission_is_left_out(
    open_window, path: Path, monkeypatch
) -> None:
    look = Path.stat

    def refused(place: Path, **how: Any) -> os.stat_result:
        if place == path:
            raise PermissionError(13, "Permission denied")
        return look(place, **how)

    remember(recent=[str(path)])
    with monkeypatch.context() as patched:
        patched.setattr(Path, "stat", refused)
        assert not is_there(path)
        assert open_window().files.recent.paths() == []
    assert is_there(path)


@pytest.mark.skipif(sys.platform == "win32" or os.geteuid() == 0, reason="a superuser may look everywhere")
def test_a_folder_really_without_permission(open_window, path: Path) -> None:
    remember(recent=[str(path)])
    path.parent.chmod(0)
    try:
        assert open_window().files.recent.paths() == []
    finally:
        path.parent.chmod(stat.S_IRWXU)


@pytest.mark.parametrize(
    ("kept", "wanted"),
    [
        (QRect(100, 100, 800, 600), QRect(100, 100, 800, 600)),  # fits
        (QRect(3000, 200, 800, 600), QRect(224, 168, 800, 600)),  # of a second screen that is gone
        (QRect(-5000, -5000, 800, 600), QRect(0, 0, 800, 600)),
        (QRect(0, 0, 3840, 2160), QRect(0, 0, 1024, 768)),  # of a larger screen
        (QRect(10, 10, 0, 0), QRect(10, 10, 320, 200)),  # nothing to be seen
        (QRect(900, 700, 800, 600), QRect(224, 168, 800, 600)),
    ],
)
def test_a_window_lies_on_a_screen_of_today(kept: QRect, wanted: QRect) -> None:
    place = on_screen(kept, [SCREEN])
    assert SCREEN.contains(place)
    assert place.size() == wanted.size()
    if SCREEN.contains(kept):
        assert place == wanted


def test_of_two_screens_it_is_the_one_that_shows_most() -> None:
    second = QRect(1024, 0, 1920, 1080)
    assert on_screen(QRect(900, 50, 800, 600), [SCREEN, second]) == QRect(1024, 50, 800, 600)


def test_a_panel_that_floats_where_no_screen_is_comes_back(open_window, path: Path) -> None:
    window: MainWindow = open_window(path)
    panel = window.findChild(QDockWidget, "Parameter")
    panel.setFloating(True)
    panel.setGeometry(9000, 9000, 300, 300)
    window.settings.bring_back([panel])
    screen = window.screen().availableGeometry()
    assert not panel.isFloating() or screen.contains(panel.geometry())


@pytest.mark.parametrize("kept", [b"", b"garbage", b"\x01\xd9\xd0\xcb" + b"\xff" * 200, b"\0" * 100_000])
def test_a_layout_that_is_none_leaves_the_panels_where_they_are(
    open_window, path: Path, qtbot, kept: bytes
) -> None:
    remember(layout=QByteArray(kept), geometry=QByteArray(kept))
    window: MainWindow = open_window(path)
    for title in ("Groups", "Parameter", "Findings"):
        qtbot.waitUntil(window.findChild(QDockWidget, title).isVisible, timeout=WAIT_MS)
    assert window.screen().availableGeometry().intersects(window.geometry())
    assert (
        window.dockWidgetArea(window.findChild(QDockWidget, "Groups")) == Qt.DockWidgetArea.LeftDockWidgetArea
    )


def test_what_is_kept_comes_back(qapp) -> None:
    settings = UserSettings()
    settings.keep_recent([Path("/a/b.amp"), Path("/c.amp")])
    settings.keep_control("tcp://127.0.0.1:9600")
    assert (UserSettings().recent(), UserSettings().control()) == (
        [Path("/a/b.amp"), Path("/c.amp")],
        "tcp://127.0.0.1:9600",
    )


@pytest.mark.skipif(os.name != "posix", reason="pipes")
def test_a_pipe_in_the_place_of_the_settings_is_not_waited_for(tmp_path: Path) -> None:
    place = tmp_path / "AMP Studio.conf"
    os.mkfifo(place)
    stored = stored_in(place)
    stored.setValue("control", "tcp://somewhere:1")
    stored.sync()
    assert stored.value("recent") is None
    assert [path.name for path in tmp_path.iterdir()] == ["AMP Studio.conf"]


@pytest.mark.parametrize(
    "damage", [b"\\0\\0\\0\\x\t7f\\0\\0\\0\\x8QString", b"\\0\\0\\0\\t\\x7f\\xff\\xff\\xff", b""]
)
def test_settings_of_a_type_that_is_never_stored_are_not_read(tmp_path: Path, damage: bytes) -> None:
    """Qt would ask for the memory of two thousand million entries and end the program."""
    place = tmp_path / "AMP Studio.conf"
    place.write_bytes(b"[General]\ncontrol=tcp://127.0.0.1:7090\nother=@Variant(" + damage + b")\n")
    settings = stored_in(place)
    assert Path(settings.fileName()) == place / "none"
    assert settings.value("control") is None
