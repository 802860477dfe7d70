"""The window with its parts, as the table of actions sees it."""

from __future__ import annotations

from amp_studio.ui.window.studio_window import StudioWindow
from amp_studio.ui.window.visited import VisitedPlaces

from .control import ControlDesk
from .edit import Edits
from .file import Files
from .find import FindSearch
from .picture import Pictures
from .preview import ReportPreview


class PartsWindow(StudioWindow):
    """What an action may ask, beyond the open files; the main window is one."""

    files: Files
    edits: Edits
    finder: FindSearch
    visited: VisitedPlaces
    pictures: Pictures
    preview: ReportPreview
    control: ControlDesk

    def step_findings(self, by: int) -> None:
        """Go to the next finding, or to the one before."""
        if self.findings is not None:
            self.findings.step(by)
