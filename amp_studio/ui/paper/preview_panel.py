"""The report of the file in front beside its table, set again in the background a moment after each edit."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

from PySide6.QtCore import QMetaObject, QObject, Qt, QUrl, Signal
from PySide6.QtGui import QDesktopServices, QKeyEvent
from PySide6.QtWidgets import QProgressBar, QWidget

from amp_studio.files import describe, real_path
from amp_studio.report import OWN, Contents
from amp_studio.schema import Address
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.loading import load
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.task import Task, TaskProgress
from amp_studio.ui.base.translated import message_in_words
from amp_studio.ui.forms.message_bar import MessageBar
from amp_studio.ui.page.file_page import FilePage
from amp_studio.ui.window.report_options import ReportOptions, answers_of

from .page_view import PageView, Spot
from .preview_head import PreviewHead
from .template_watch import TemplateWatch

if TYPE_CHECKING:
    from amp_studio.report import PrintedFigure, PrintedPlace, SetReport
    from amp_studio.ui.base.workspace import Workspace

WAIT_MS = 500
"""Milliseconds after an edit until the report is set again."""
PPI, SHARP_PPI = 96, 192
"""Pixels to the inch of the pages, and of those that are seen from near."""
_NEAR = 1.7
"""Zoom, in pixels to the point, from which the finer pages are wanted."""


@dataclass
class _PreviewState:
    """What is known of the report of one file."""

    pages: tuple[bytes, ...] = ()
    ppi: int = PPI
    places: dict[Address, PrintedPlace] = field(default_factory=dict)
    motion: tuple[PrintedFigure, ...] = ()
    """The drawings of the simulator, which come later than the pages:
    those of the time before are shown until then."""
    spot: Spot = field(default_factory=lambda: Spot(0, 0.0))
    notes: tuple[str, ...] = ()
    source: str = ""


class PreviewPanel(QWidget):
    """Pages, a message about the project's template, and a line while pages are being set."""

    _set = Signal(object, object, tuple, tuple)
    """From the thread: which file, its pages, the drawings in them, notes."""
    value_requested = Signal(object)
    """The address of a value that was clicked."""

    def __init__(self, choice: ReportOptions) -> None:
        super().__init__()
        self.setAccessibleName(self.tr("Report preview"))
        self._choice = choice
        self._page: FilePage | None = None
        self._links: list[QMetaObject.Connection] = []
        """To the signals of the page."""
        self._known: WeakKeyDictionary[Workspace, _PreviewState] = WeakKeyDictionary()
        self._task: Task | None = None
        self._is_stale = False
        self.follows = True
        """Whether the pages turn to the value that is selected in the table."""
        self.bar = MessageBar()
        self.busy = QProgressBar()
        self.busy.setRange(0, 0)
        self.busy.setFixedHeight(2)
        self.busy.setTextVisible(False)
        policy = self.busy.sizePolicy()
        policy.setRetainSizeWhenHidden(True)
        self.busy.setSizePolicy(policy)
        self.busy.hide()
        self.view = PageView()
        self.head = PreviewHead(choice.contents)
        in_column(self.bar, self.busy, self.view, on=self, margins=0, gap=0)
        self.setFocusProxy(self.view)
        self._wait = single_shot(self, self._begin)
        self._watch = TemplateWatch(self)
        self._watch.changed.connect(self.set_again)
        self._set.connect(self._show_pages)
        self.view.turned.connect(self.head.show_page)
        self.view.value_clicked.connect(self.value_requested)
        self.view.zoomed.connect(self._render_sharper)
        self.head.page_requested.connect(self.view.go_to_page)
        self.head.contents_requested.connect(self._choose)
        choice.changed.connect(self._chosen)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Escape goes back to the table."""
        if event.key() == Qt.Key.Key_Escape and self._page is not None:
            self._page.setFocus()
        else:
            super().keyPressEvent(event)

    # -- which file --------------------------------------------------------------------------

    def show_page(self, page: FilePage | None) -> None:
        """Show the report of another file; of none it is empty."""
        if page is self._page:
            return
        if self._page is not None:
            self._preview_state().spot = self.view.spot()
        for link in self._links:  # of a page that is closed nothing is left to disconnect
            QObject.disconnect(link)
        self._links = []
        self._page = page
        self.bar.hide()
        self.view.empty = self.tr("Setting the pages …") if page else ""
        if page is None:
            self._wait.stop()
            self._watch.watch(None)
            self.view.show_pages((), PPI)
            self.head.show_count(0)
            return
        self._links = [
            page.selected.connect(self._follow),
            page.workspace.changed.connect(self.set_again),
            page.workspace.saved.connect(self.set_again),
        ]
        self._watch.watch(real_path(page.workspace.path).parent)
        known = self._preview_state()
        self.view.show_pages(known.pages, known.ppi, known.spot)
        self.view.show_places(known.places)
        self.head.show_count(len(known.pages))
        self._show_notes(known.notes)
        self._follow(page.table_view.address())
        self.set_again()

    def _preview_state(self) -> _PreviewState:
        assert self._page is not None
        return self._known.setdefault(self._page.workspace, _PreviewState())

    @property
    def source(self) -> str:
        """What Typst made the pages of; empty while there are none."""
        return self._preview_state().source if self._page is not None else ""

    # -- what it contains ----------------------------------------------------------------------

    def _choose(self, contents: Contents) -> None:
        self._choice.contents = contents

    def _chosen(self) -> None:
        self.head.options.show_answers(answers_of(self._choice.contents))
        self.set_again()

    def _render_sharper(self) -> None:
        if self._page is not None and self._wanted_ppi() > self._preview_state().ppi:
            self.set_again()

    def _wanted_ppi(self) -> int:
        return SHARP_PPI if self.view.scale() * self.devicePixelRatioF() > _NEAR else PPI

    # -- setting it ----------------------------------------------------------------------------

    def set_again(self, *_: object) -> None:
        """Set the pages a moment from now; at once more when what is being set now is ready."""
        self._is_stale = True
        if self._page is not None and self.isVisible():
            self._wait.start(WAIT_MS)

    def showEvent(self, event: object) -> None:
        """Set what has changed while the preview was hidden."""
        super().showEvent(event)  # type: ignore[arg-type]  # Qt gives the event of this kind
        if self._is_stale:
            self.set_again()

    @property
    def is_settled(self) -> bool:
        """Whether the pages are those of now."""
        return not (self._is_stale or self._wait.isActive() or self._task is not None)

    def _begin(self) -> None:
        if self._page is None or not self.isVisible() or self._task is not None:
            return  # one at a time: its end begins the next
        self._is_stale = False
        self._task = Task(self._work(self._page.workspace))
        self._task.failed.connect(self._failed)
        self._task.finished.connect(self._ended)
        self.busy.show()
        self._task.begin()

    def _work(self, workspace: Workspace) -> Callable[[TaskProgress, threading.Event], None]:
        """Return what the thread does: pages with the drawings there are, their places,
        then again with new drawings.
        """
        file, contents, ppi = workspace.file.copy(), self._choice.contents, self._wanted_ppi()
        own, source, known = workspace.validator.own, workspace.path, self._preview_state().motion

        def pages(motion: tuple[PrintedFigure, ...]) -> None:
            load("amp_studio.dossier")
            from amp_studio.dossier import set_dossier

            notes: list[str] = []
            found = set_dossier(
                file, contents, ppi, source=source, motion=motion, own=own, notify=notes.append
            )
            self._set.emit(workspace, (found, ppi), motion, tuple(notes))

        def work(_: TaskProgress, cancelled: threading.Event) -> None:
            load("amp_studio.dossier")
            from amp_studio.dossier import motion_apart

            pages(known)
            if "motion" in contents.without or cancelled.is_set():
                return
            drawn = motion_apart(file)
            if drawn != known and not cancelled.is_set():
                pages(drawn)

        return work

    def _show_pages(
        self,
        workspace: Workspace,
        found: tuple[SetReport, int],
        motion: tuple[PrintedFigure, ...],
        notes: tuple[str, ...],
    ) -> None:
        (report, ppi), known = found, self._known.setdefault(workspace, _PreviewState())
        # An equal page stays the same object, by which the view knows that it need not be decoded again.
        before = dict.fromkeys(known.pages)
        kept = {page: page for page in before}
        known.pages = tuple(kept.get(page, page) for page in report.pages)
        known.ppi, known.motion, known.notes, known.source = ppi, motion, notes, report.source
        is_first, known.places = not known.places, report.places()
        if self._page is not None and workspace is self._page.workspace:
            self.view.show_pages(known.pages, ppi)
            self.view.show_places(known.places)
            self.head.show_count(len(known.pages))
            self.head.show_page(self.view.page)
            self._show_notes(notes)
            if is_first:
                self._follow(self._page.table_view.address())

    def _failed(self, error: Exception) -> None:
        self.bar.say(str(error), "error")

    def _ended(self) -> None:
        self._task = None
        self.busy.hide()
        if self._is_stale:
            self.set_again()

    def _show_notes(self, notes: tuple[str, ...]) -> None:
        """Show what the project's template has wrong, with a way to it; nothing where it is right."""
        if not notes:
            self.bar.hide()
            return
        folder = real_path(self._page.workspace.path).parent if self._page is not None else Path()
        text = "\n".join(map(message_in_words, notes)).replace(
            f"{folder}{os.sep}", ""
        )  # there is little room
        self.bar.say(text, "warning", (self.tr("Open the &Folder"), self.open_templates))

    def open_templates(self) -> None:
        """Show the folder of the project's templates."""
        if self._page is not None:
            folder: Path = real_path(self._page.workspace.path).parent / OWN
            QDesktopServices.openUrl(QUrl.fromLocalFile(str(folder)))

    # -- from the table, and back --------------------------------------------------------------

    def _follow(self, address: object) -> None:
        self.view.highlight(address, scroll=self.follows)  # type: ignore[arg-type]  # a signal of Qt has no type of an address

    def set_follows(self, follows: bool) -> None:
        """Turn the pages to the selected value from now on, or only mark it."""
        self.follows = follows
        if follows:
            self.go_to_selected()

    def go_to_selected(self) -> None:
        """Turn to the value that is selected in the table, and say where it is not in the report."""
        address = self._page.table_view.address() if self._page is not None else None
        if address is None or self._page is None or not self.view.places:
            return
        if not self.view.highlight(address, scroll=True):
            name = describe(self._page.workspace.file, address)
            self.bar.say(self.tr("{name} is not in this report.").format(name=name))
