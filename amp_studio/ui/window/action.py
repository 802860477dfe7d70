"""What a row of the table of actions is. ``amp_studio/ui/actions/table.py`` has the rows;
``menus.py`` makes the menus of them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Generic, Literal, TypeVar

from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QMenu

from amp_studio.ui.base.workspace import Workspace

W = TypeVar("W")
"""The window whose parts an action may use."""

Needs = Literal[
    "",
    "file",
    "edit",
    "axes",
    "project",
    "units",
    "undo",
    "redo",
    "emulated",
    "emulated estop",
    "no emulated",
    "seen",
]
"""What has to be there: nothing, an open file, the right to change it, axes as well, a project, several
systems of units, a step to undo or redo, an emulated control that runs, a file and none that runs, the values
in front."""

Shortcut = str | QKeySequence.StandardKey | tuple[str, ...]


@dataclass(frozen=True)
class Action(Generic[W]):
    """One thing that a person can ask for, by menu, key, tool bar or find box."""

    key: str
    """By which code names it, ``file.save``."""
    text: str
    """Its name in the menu, with an Alt letter; ``…`` where it asks something first."""
    does: Callable[[W], object]
    keys: Shortcut = ()
    needs: Needs = "file"
    icon: str = ""
    short: str = ""
    """Its name in the tool bar."""
    tip: str = ""
    """Instead of its name and keys."""
    is_on: Callable[[W], bool | None] | None = None
    """For one that can be switched: whether it is on; None leaves it as it is."""
    why_not: Callable[[Workspace], str] | None = None
    """The reason why the file in front cannot have it, which is then its tip; empty where it can."""
    follows: Callable[[W, QAction], None] | None = None
    """Shows in it what depends on the file in front: text, icon."""
    of_a_cell: bool = False
    """Also in the menu of a cell."""
    of_selected: bool = False
    """It acts on what is selected among the values, as all of a cell do: off while these are not in front."""
    only_in_table: bool = False
    """Its keys mean it in the table only: a text field has its own copy and paste."""


@dataclass(frozen=True)
class ChoiceMenu(Generic[W]):
    """A menu of which one row is on."""

    key: str
    text: str
    offers: Callable[[W], Sequence[tuple[str, str]] | None]
    """Key and name of each row; None leaves the rows as they are, disabled."""
    present: Callable[[W], str]
    choose: Callable[[W, str], object]
    needs: Needs = ""


@dataclass(frozen=True)
class FilledMenu(Generic[W]):
    """A menu that its owner fills, as the one of recent files."""

    menu: Callable[[W], QMenu]


@dataclass(frozen=True)
class Menu(Generic[W]):
    """A menu and its rows; None is a line between them."""

    key: str
    text: str
    rows: tuple[Action[W] | ChoiceMenu[W] | FilledMenu[W] | Menu[W] | None, ...]
    shows_tips: bool = False
