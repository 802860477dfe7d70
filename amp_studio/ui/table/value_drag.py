"""Values that follow a handle: live in every view while it moves, one undo step when it is dropped."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QObject

from amp_studio.files import HeaderSnapshot, RangeError
from amp_studio.schema import Address, Value
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.workspace import Workspace

_FOLLOW_MS = 60
"""Milliseconds after which findings and the other views follow a moving value; the picture follows at
once."""


class ValueDrag(QObject):
    """One drag. The file has the values of the moment; nothing is on the undo stack until ``drop``."""

    def __init__(self, workspace: Workspace, addresses: tuple[Address, ...]) -> None:
        super().__init__(workspace)
        self.workspace = workspace
        self.before = {address: workspace.file.get(address) for address in addresses}
        """The values when the drag began."""
        self._marks = HeaderSnapshot.of(workspace.file)
        self.refused = ""
        """Why the last place was not taken; the values are still those before it."""
        self._follow = single_shot(self, self._show_value, _FOLLOW_MS)
        workspace.validator.update(list(addresses))  # rules are compiled now, and not in the first frame

    @property
    def values(self) -> dict[Address, Value | None]:
        """The values of the moment."""
        return {address: self.workspace.file.get(address) for address in self.before}

    def move(self, wanted: Mapping[Address, Value]) -> bool:
        """Take values; returns whether anything changed. What is out of range is refused, with the reason."""
        self.refused = ""
        try:
            changes = self.workspace.file.set_checked({a: v for a, v in wanted.items() if a in self.before})
        except RangeError as error:
            self.refused = str(error)
            return False
        # Not restarted by the next place: the views follow during a long drag too.
        if changes and not self._follow.isActive():
            self._follow.start()
        return bool(changes)

    def _show_value(self) -> None:
        self.workspace.follow(list(self.before))

    def _put_back(self) -> None:
        self._follow.stop()
        for address, value in self.before.items():
            self.workspace.file.set(address, value)
        self._marks.put_back(self.workspace.file)

    def cancel(self) -> None:
        """Give the old values back."""
        self._put_back()
        self._show_value()
        self.deleteLater()

    def drop(self, text: str) -> bool:
        """Keep the values as one undo step; returns whether there is one."""
        # First the old values, then the new ones as an edit: so the undo step has both.
        wanted = self.values
        self._put_back()
        changed = wanted != self.before and self.workspace.edit(text, wanted)
        if not changed:
            self._show_value()
        self.deleteLater()
        return bool(changed)
