"""The window with its parts, as the table of actions sees it."""

from __future__ import annotations

from amp_studio.ui.window.studio_window import StudioWindow

from .control import AtControl
from .edit import Edits
from .file import Files
from .find import Search
from .picture import Pictures
from .preview import Preview


class PartsWindow(StudioWindow):
    """What an action may ask, beyond the open files; the main window is one."""

    files: Files
    edits: Edits
    finder: Search
    pictures: Pictures
    preview: Preview
    control: AtControl

    def step_findings(self, by: int) -> None:
        """Go to the next finding, or to the one before."""
        if self.findings is not None:
            self.findings.step(by)
