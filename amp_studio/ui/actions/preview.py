"""The preview of the report beside the table, made when it is first seen."""

from __future__ import annotations

from functools import partial
from importlib import import_module
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer

from amp_studio.ui.window.studio_window import StudioWindow

if TYPE_CHECKING:
    from amp_studio.ui.paper.preview_panel import PreviewPanel


class ReportPreview(QObject):
    """Shows and hides the dock of the preview."""

    def __init__(self, window: StudioWindow) -> None:
        super().__init__(window)
        self.window = window
        self.panel: PreviewPanel | None = None
        self._takes_focus = False
        window.docks.preview.visibilityChanged.connect(lambda _: self._follow_file())
        window.tabs.current_changed.connect(lambda _: self._follow_file())

    def toggle(self) -> None:
        """Show the preview beside the table and go to it, or hide it."""
        dock = self.window.docks.preview
        if not dock.isHidden():
            # Asked before it is hidden: Qt moves the focus then.
            had_focus = dock.isAncestorOf(self.window.focusWidget())
            self.window.docks.show_preview(False)
            if had_focus and self.window.page is not None:
                self.window.page.setFocus()
            return
        # Only if the user asked for it: a preview that opens by itself leaves the keyboard to the table.
        self._takes_focus = True
        self.window.docks.show_preview(True)

    @property
    def is_shown(self) -> bool:
        """Whether the preview is to be seen."""
        return not self.window.docks.preview.isHidden()

    def _follow_file(self) -> None:
        """Follow the file in front while the preview is seen; it is made after the window has been
        painted.
        """
        self.window.menus["view.preview"].setChecked(self.is_shown)
        if self.is_shown:
            QTimer.singleShot(0, self, self._load)
        elif self.panel is not None:
            self.panel.show_page(None)

    def _load(self) -> None:
        """Load what is needed in one turn of the event loop, and make it in the next,
        so that none takes long.
        """
        if self.panel is None:
            import_module("amp_studio.ui.paper.preview_panel")
        QTimer.singleShot(0, self, self._show)

    def _show(self) -> None:
        if self.window.docks.preview.isHidden():
            return
        panel = self._made()
        panel.show_page(self.window.page)
        if self._takes_focus:
            self._takes_focus = False
            panel.setFocus()

    def _made(self) -> PreviewPanel:
        """Return the panel; it and what sets pages are loaded when they are first wanted."""
        if self.panel is not None:
            return self.panel
        from amp_studio.ui.paper.preview_panel import PreviewPanel

        panel = self.panel = PreviewPanel(self.window.report_options)
        head, view = panel.head, panel.view
        head.add_button("magnifying-glass-minus", self.tr("Smaller (-)"), partial(view.step_zoom, -1))
        head.add_button("magnifying-glass-plus", self.tr("Larger (+)"), partial(view.step_zoom, 1))
        head.add_button(
            "arrows-out-line-horizontal", self.tr("Fit the width (0)"), partial(view.set_zoom, None)
        )
        follow = head.add_button(
            "crosshair-simple",
            self.tr("Turn to the value that is selected in the table"),
            lambda: panel.set_follows(follow.isChecked()),
            is_switch=True,
        )
        follow.setChecked(True)
        head.add_options()
        head.add_button("export", self.tr("Export…"), self._guarded(self.export, self.tr("Export")))
        head.add_button("printer", self.tr("Print…"), self._guarded(self.print, self.tr("Print")))
        head.add_button("x", self.tr("Close (Ctrl+5)"), self.toggle)
        panel.value_requested.connect(self.window.go_to)
        self.window.docks.take_preview(panel, head)
        return panel

    def _guarded(self, act: object, title: str) -> partial[object]:
        return partial(self.window.guarded, act, title)  # type: ignore[arg-type]  # a signal of Qt may give it any arguments

    def export(self) -> None:
        """Ask for a file and write the report into it."""
        from amp_studio.ui.dialogs.file_dialogs import ask_report_path
        from amp_studio.ui.paper.printing import write_to

        workspace = self.window.workspace
        assert workspace is not None
        path = ask_report_path(self.window, str(workspace.path.with_suffix(".pdf").absolute()))
        if path is not None:
            write_to(self.window, workspace, path)

    def print(self) -> None:
        """Print the report through the system's dialog."""
        from amp_studio.ui.paper.printing import print_now

        assert self.window.workspace is not None
        print_now(self.window, self.window.workspace)
