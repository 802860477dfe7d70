"""The colours can be read, icons are there, and light and dark follow the choice at once."""

import ast
import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QRect, QSize
from PySide6.QtGui import QIcon, QImage, QPainter, QPixmap
from PySide6.QtWidgets import (
    QAbstractItemView,
    QListWidget,
    QStyle,
    QStyleOptionViewItem,
    QTableWidget,
    QTreeWidget,
    QWidget,
)
from pytestqt.qtbot import QtBot

from amp_studio.schema import Parameter
from amp_studio.ui.base import theme
from amp_studio.ui.base.style_sheet import style_sheet
from amp_studio.ui.base.theme import COLOURS, Token, scheme
from amp_studio.ui.forms.mask_list import MaskList
from amp_studio.ui.table.cell_editor import Refusal, RefusalFrame
from tests.source_trees import nodes_of

ACTIVE = QStyle.StateFlag.State_Active
GROUNDS: tuple[Token, ...] = ("window", "panel", "base", "raised", "hover", "selbg", "selidle")
READ: list[tuple[Token, Token]] = [
    *[
        (front, background)
        for front in ("text", "dim")
        for background in (*GROUNDS, "errorbg", "warnbg", "recbg")
    ],
    *[(front, background) for front in ("sel", "error", "warn", "rec", "chg") for background in GROUNDS],
    ("error", "errorbg"),
    ("warn", "warnbg"),
    ("rec", "recbg"),
    ("onsel", "sel"),
    *[("off", background) for background in ("window", "panel", "base", "raised")],
]
"""Every ink on every ground on which it is read, hovered and selected too; that of a disabled control."""
SEEN: list[tuple[Token, Token]] = [("edge", "base"), ("edge", "panel"), ("sel", "base"), ("chg", "base")]
"""Borders and marks that must be seen."""


def contrast(one: str, other: str) -> float:
    """Return the contrast of two colours by WCAG: 1 for the same, 21 for black on white."""

    def light(name: str) -> float:
        parts = [int(name[n : n + 2], 16) / 255 for n in (1, 3, 5)]
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    low, high = sorted((light(one), light(other)))
    return (high + 0.05) / (low + 0.05)


@pytest.fixture
def light_again(qtbot: QtBot) -> Iterator[None]:
    """Leave the other tests the scheme they started with."""
    before = theme.scheme().choice
    yield
    theme.apply_style(before)


def test_contrast_is_one_of_the_same_and_21_of_black_on_white() -> None:
    assert contrast("#808080", "#808080") == 1
    assert contrast("#000000", "#FFFFFF") == pytest.approx(21)


@pytest.mark.parametrize("dark", [0, 1], ids=["light", "dark"])
def test_every_colour_is_read_on_every_background_it_is_on(dark: int) -> None:
    poor = {
        pair: round(found, 2)
        for pair in READ
        if (found := contrast(COLOURS[pair[0]][dark], COLOURS[pair[1]][dark])) < 4.5
    }
    assert poor == {}


@pytest.mark.parametrize("dark", [0, 1], ids=["light", "dark"])
def test_every_border_and_mark_is_seen(dark: int) -> None:
    poor = {
        pair: round(found, 2)
        for pair in SEEN
        if (found := contrast(COLOURS[pair[0]][dark], COLOURS[pair[1]][dark])) < 3
    }
    assert poor == {}


SWITCHED = """
import json, sys
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication
application = QApplication([])
from amp_studio.ui.base import theme
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.dialogs.settings_dialog import SettingsDialog
from amp_studio.ui.window.settings import UserSettings
window, told = MainWindow(), []
window.show()
theme.scheme().changed.connect(lambda: told.append(theme.colour("base").name()))
def inks(icon):
    image = icon.pixmap(32, 32).toImage()
    spots = [image.pixelColor(x, y) for x in range(32) for y in range(32)]
    return sorted({spot.name() for spot in spots if spot.alpha() == 255})
icon = theme.icon("floppy-disk")
before = inks(icon)
SettingsDialog(window).form.set_answer("theme", "dark")
print(json.dumps({"told": told, "base": QGuiApplication.palette().base().color().name(),
                  "before": before, "after": inks(icon),
                  "window": window.palette().window().color().name(), "kept": UserSettings().theme()}))
"""
"""A program that is switched to dark; separate, so that no window of another test follows."""


def test_dark_is_there_at_once_and_is_kept_for_the_next_start(tmp_path: Path) -> None:
    private = {
        "XDG_CONFIG_HOME": str(tmp_path),
        "XDG_STATE_HOME": str(tmp_path),
        "QT_QPA_PLATFORM": "offscreen",
    }
    done = subprocess.run(
        [sys.executable, "-c", SWITCHED],
        env=os.environ | private,
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    assert json.loads(done.stdout) == {
        "told": ["#17191c"],
        "base": "#17191c",
        "window": "#1c1e22",
        "kept": "dark",
        "before": ["#1a1e23"],
        "after": ["#e3e6ea"],
    }


@pytest.mark.parametrize("kept", ["purple", 7, None, ["dark"]])
def test_a_damaged_choice_of_theme_follows_the_system(kept: object) -> None:
    assert theme.as_choice(kept) == "system"


def test_a_disabled_icon_is_drawn_in_the_disabled_colour(qtbot: QtBot, light_again: None) -> None:
    theme.apply_style("light")
    image = theme.icon("x").pixmap(QSize(32, 32), QIcon.Mode.Disabled).toImage()
    assert {image.pixelColor(n, 16).name() for n in range(32) if image.pixelColor(n, 16).alpha() == 255} == {
        COLOURS["off"][0].lower()
    }


def test_every_icon_the_window_names_is_in_the_set(checkout: Path) -> None:
    known = set(theme._glyphs())
    named = {
        node.value
        for file in (checkout / "amp_studio" / "ui").rglob("*.py")
        for call in nodes_of(file)
        if isinstance(call, ast.Call)
        and getattr(call.func, "id", getattr(call.func, "attr", "")) in {"icon", "paint_icon"}
        for node in call.args
        if isinstance(node, ast.Constant)
        and isinstance(node.value, str)
        and node.value.islower()
        and "-" in node.value
    }
    assert {"magnifying-glass", "caret-down"} & named
    assert named <= known


def test_the_program_starts_without_the_icon_package(qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(theme, "_icon_files", lambda pattern: None)
    for cached in (theme._glyphs, theme._icon_font):
        cached.cache_clear()
    try:
        assert not theme.icon("floppy-disk").pixmap(16, 16).isNull()
    finally:
        for cached in (theme._glyphs, theme._icon_font):
            cached.cache_clear()


def test_only_the_theme_names_a_colour(checkout: Path) -> None:
    """One table: a colour written elsewhere would be wrong in one of the two schemes."""
    own = {"theme.py", "program_icon.py"}
    found = [
        f"{file.name}:{node.lineno}"
        for file in (checkout / "amp_studio" / "ui").rglob("*.py")
        if file.name not in own
        for node in nodes_of(file)
        if isinstance(node, ast.Constant)
        and isinstance(node.value, str)
        and len(node.value) in (4, 7)
        and node.value.startswith("#")
        and all(c in "0123456789abcdefABCDEF" for c in node.value[1:])
    ]
    assert found == []


@pytest.mark.parametrize("dark", [False, True])
def test_every_mark_of_the_style_sheet_is_a_picture_that_can_be_read(qtbot: QtBot, dark: bool) -> None:
    sheet = style_sheet({token: pair[dark] for token, pair in COLOURS.items()}, dark)
    marks = re.findall(r'url\("([^"]+)"\)', sheet)
    assert len(set(marks)) == 5
    assert all(not QPixmap(mark).isNull() for mark in marks)


def test_the_marks_have_colours_of_the_table(checkout: Path) -> None:
    named = {f"{token}-{n}": colours[n] for token, colours in COLOURS.items() for n in (0, 1)}
    for file in (checkout / "amp_studio" / "ui" / "marks").glob("*.svg"):
        used = set(re.findall(r"#[0-9A-F]{6}", file.read_text(encoding="utf-8")))
        dark = int(file.stem.endswith("dark"))
        assert used <= {colour for token, colour in named.items() if token.endswith(f"-{dark}")}, file.name


def test_what_is_open_over_the_table_changes_its_colours_with_the_theme(
    qtbot: QtBot, light_again: None
) -> None:
    parent = QWidget()
    qtbot.addWidget(parent)
    frame = RefusalFrame(parent)
    frame.fill(Refusal("99 mm is outside the range", "0 to 10 mm"), [("Esc", "keep 5 mm")])
    words = MaskList(Parameter.model_construct(bits=()), parent)
    before = [frame.styleSheet(), frame._keys.text(), words.styleSheet()]
    scheme().choose("dark")
    after = [frame.styleSheet(), frame._keys.text(), words.styleSheet()]
    assert all(old != new for old, new in zip(before, after, strict=True))
    assert "99 mm" in frame.text


def test_an_icon_without_room_is_not_painted(qtbot: QtBot, qtlog) -> None:
    assert theme.icon("x").pixmap(QSize(0, 8)).isNull()
    assert qtlog.records == []


@pytest.mark.parametrize("kind", [QListWidget, QTreeWidget, QTableWidget])
def test_a_selected_row_of_a_list_has_one_colour_and_no_gradient(
    qtbot: QtBot, light_again: None, kind: type[QAbstractItemView]
) -> None:
    rows = kind()
    rows.setStyleSheet(f"{kind.__name__}::item {{ padding-left: 8px; }}")
    rows.model().insertRows(0, 1)
    rows.model().insertColumns(0, 1)
    qtbot.addWidget(rows)
    rows.show()
    rows.setCurrentIndex(rows.model().index(0, 0))
    for is_active in (True, False):
        image, option = QImage(60, 30, QImage.Format.Format_RGB32), QStyleOptionViewItem()
        image.fill(0)
        rows.initViewItemOption(option)
        option.rect, option.state = QRect(0, 0, 60, 30), option.state | QStyle.StateFlag.State_Selected
        option.state = option.state | ACTIVE if is_active else option.state & ~ACTIVE
        rows.style().drawControl(QStyle.ControlElement.CE_ItemViewItem, option, QPainter(image), rows)
        wanted = COLOURS["selbg" if is_active else "selidle"][0]
        assert {image.pixelColor(30, y).name() for y in range(30)} == {wanted.lower()}
