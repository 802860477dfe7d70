"""The tool bar: the file, undo, units, the find box in the middle, the views, the control."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QSizePolicy, QToolBar, QToolButton, QWidget

from amp_studio.ui.base.layout import in_row
from amp_studio.ui.base.theme import GAP4, ICON
from amp_studio.ui.forms.segment import Segment

from .docks import WIDE
from .studio_window import StudioWindow

_FILE_WIDE = 1600
"""Width in logical pixels from which the buttons of the file have their words too."""
_FIND_WIDTH, _FIND_LEAST = 440, 106
"""Most that the find box takes, in logical pixels, and what it needs."""
_CONTROL_WIDTH = 200
"""Of the button of the control, whatever its state: nothing beside it moves when that changes."""


class MainToolBar(QToolBar):
    """Words beside the icons where the window is wide; the words of a narrow one are in the tips."""

    def __init__(
        self, window: StudioWindow, actions: Mapping[str, QAction], parts: Mapping[str, Sequence[str]]
    ) -> None:
        """Make the bar of a window; ``parts`` has the keys of the actions in each part of it."""
        super().__init__(self.tr("Main"), window)
        self.setObjectName("main-toolbar")
        self.setMovable(False)
        self.setIconSize(QSize(ICON, ICON))
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
        self._window, self._switch = window, actions["view.switch_units"]
        file, steps, views, control = (
            [actions[key] for key in parts[part]] for part in ("file", "steps", "views", "control")
        )
        self.addActions(file)
        self.addSeparator()
        self.addActions(steps)
        self._of_file, self._bare = self._buttons(file), self._buttons(steps)
        self.addSeparator()
        self.units = Segment(self.tr("Unit system"))
        self.units.setToolTip(self._switch.toolTip())
        self.units.chosen.connect(self._choose)
        self._units_action = self.addWidget(self.units)
        self._slot = QWidget()
        self._slot.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        self._slot_row = in_row(1, on=self._slot, margins=(12, 0, 12, 0))
        self.addWidget(self._slot)
        self.addActions(views)
        self.addSeparator()
        self.addActions(control)
        (self._control,) = self._buttons(control)
        self.fit(window.width())

    def take_find_box(self, box: QWidget) -> None:
        """Show the find box between the units and the views."""
        box.setMaximumWidth(_FIND_WIDTH)
        self._slot_row.insertWidget(0, box, 100)

    def _buttons(self, actions: Sequence[QAction]) -> list[QToolButton]:
        found = (self.widgetForAction(action) for action in actions)
        return [button for button in found if isinstance(button, QToolButton)]

    def fit(self, width: int) -> None:
        """Show words where the window has room for them: first those of the file go, then those of the
        pages; the control keeps its name and state longest.
        """
        is_wide = width >= WIDE
        for has_words, of_file in ((is_wide, width >= _FILE_WIDE), (is_wide, False), (False, False)):
            self._show_words(has_words, of_file, of_control=True)
            if self._needed() <= width:  # the words of a longer language may have none
                return
        self._show_words(False, False, of_control=False)

    def _needed(self) -> int:
        """Return the width at which everything is seen."""
        parts = [self.widgetForAction(action) for action in self.actions()]
        spacing = self.layout().spacing() * len(parts) + 2 * GAP4
        own = (self._slot, self._control)
        widths = (part.sizeHint().width() for part in parts if part not in own)
        return sum(widths) + _CONTROL_WIDTH + _FIND_LEAST + spacing

    def _show_words(self, has_words: bool, of_file: bool, *, of_control: bool) -> None:
        style = Qt.ToolButtonStyle
        words, bare = style.ToolButtonTextBesideIcon, style.ToolButtonIconOnly
        self.setToolButtonStyle(words if has_words else bare)
        self._control.setToolButtonStyle(words if of_control else bare)
        self._control.setMinimumWidth(_CONTROL_WIDTH if of_control else 0)
        self._control.setMaximumWidth(_CONTROL_WIDTH)
        for button in self._bare:
            button.setToolButtonStyle(bare)
        for button in self._of_file:
            button.setToolButtonStyle(words if of_file else bare)

    def show_units(self) -> None:
        """Show the unit systems of the file in front, and which one it is shown in;
        none is pressed for values as entered.
        """
        workspace = self._window.workspace
        systems = workspace.file.schema.family.units if workspace else ("metric", "inch")
        words = {"metric": "mm", "inch": self.tr("inch")}
        self.units.offer([(system, words.get(system, system), "") for system in systems])
        self.units.setEnabled(workspace is not None)
        self._units_action.setVisible(len(systems) > 1)
        is_converted = workspace is not None and not workspace.as_entered
        self.units.show_choice(workspace.file.header.units if workspace and is_converted else None)

    def _choose(self, system: str) -> None:
        workspace = self._window.workspace
        if workspace is not None:
            self._window.guarded(lambda: workspace.show_in(system), self._switch.toolTip())
        self.show_units()
