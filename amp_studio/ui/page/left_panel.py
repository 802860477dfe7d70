"""The left panel of a file: steps of commissioning, parameter groups, or the project; one of them at a
time.
"""

from __future__ import annotations

from typing import Literal, get_args

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QHBoxLayout, QLabel, QStackedWidget, QVBoxLayout, QWidget

from amp_studio.guide import step_of
from amp_studio.ui.base.theme import GAP2, HEAD
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.segment import Segment

from .group_list import GroupList
from .steps_panel import StepsPanel

LeftSide = Literal["steps", "groups", "project"]


def as_side(kept: object) -> LeftSide | None:
    """Return a stored side; None where it is none."""
    return next((side for side in get_args(LeftSide) if side == kept), None)


class LeftPanel(QWidget):
    """Chooses which parameters the table shows, by step or by group."""

    chosen = Signal(str, list)
    """Title and parameters."""
    turned = Signal(str)
    """The person chose one of the sides."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self._workspace = workspace
        self.groups, self.steps = GroupList(workspace), StepsPanel(workspace)
        none = QLabel(self.tr("This file is in no project."))
        none.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignHCenter)
        none.setMargin(GAP2 * 2)
        none.setWordWrap(True)
        self._sides: dict[LeftSide, QWidget] = {"steps": self.steps, "groups": self.groups, "project": none}
        self._stack = QStackedWidget()
        for widget in self._sides.values():
            self._stack.addWidget(widget)
        self.head = self._head()
        """What the dock shows above the panel."""
        self.setAutoFillBackground(True)
        self.setBackgroundRole(QPalette.ColorRole.AlternateBase)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(self._stack, 1)
        self.steps.chosen.connect(self.chosen)
        self.groups.chosen.connect(self.chosen)
        self.show_side("steps" if workspace.progress.set < workspace.progress.total else "groups")

    def _head(self) -> QWidget:
        """Return the head of the dock: which of the three is shown."""
        self.segment = Segment(
            self.tr("Left panel"),
            [
                ("steps", self.tr("Steps"), ""),
                ("groups", self.tr("Groups"), ""),
                ("project", self.tr("Project"), ""),
            ],
        )
        self.segment.chosen.connect(self._turn)
        head = QWidget()
        head.setFixedHeight(HEAD)
        row = QHBoxLayout(head)
        row.setContentsMargins(GAP2, 0, GAP2, 0)
        row.addWidget(self.segment)
        row.addStretch()
        return head

    @property
    def side(self) -> LeftSide:
        """The side that is shown."""
        return next(side for side, widget in self._sides.items() if widget is self._stack.currentWidget())

    def show_side(self, side: LeftSide) -> None:
        """Show steps, groups or the project; the table stays as it is."""
        self._stack.setCurrentWidget(self._sides[side])
        self.segment.show_choice(side)
        self.groups.follow_edits(side == "groups")
        self.setFocusProxy(self._sides[side])

    def _turn(self, key: str) -> None:
        side = as_side(key)
        assert side is not None
        self.show_side(side)
        if side != "project":
            self.choose()
        self.turned.emit(side)

    def set_project_tree(self, tree: QWidget) -> None:
        """Show a widget as the project."""
        old = self._sides["project"]
        is_current = old is self._stack.currentWidget()
        self._sides["project"] = tree
        self._stack.addWidget(tree)
        self._stack.removeWidget(old)
        old.deleteLater()
        if is_current:
            self.show_side("project")

    def choose(self) -> None:
        """Emit the present choice again."""
        if self.side == "steps":
            self.steps.choose()
        else:
            self.groups.choose()

    def show_place_of(self, parameter_id: str) -> None:
        """Show the step or the group of a parameter, whichever the panel is at."""
        if self.side == "steps":
            self.steps.choose_step(step_of(self._workspace.file.schema)[parameter_id])
        else:
            self.groups.choose_group_of(parameter_id)
