"""Checks the result of a comparison in the background, and follows each choice after that."""

from __future__ import annotations

import threading

from PySide6.QtCore import QObject, Signal

from amp_studio.files import Merge, MergeChoice, Row
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.task import Task, TaskProgress
from amp_studio.ui.base.workspace import Workspace
from amp_studio.validate import Finding, ResultCheck, Validator

_PAINTED_MS = 50
"""Milliseconds until new rows are painted; a check that runs beside that would hold it up."""

_MANY = 25
"""Values that are checked again within a few milliseconds."""


class MergeCheck(QObject):
    """The findings of a result that the open file does not have. One check runs at a time:
    it takes as long as opening a file.
    """

    ready = Signal()
    """The sources that were given last have been checked."""
    failed = Signal(str)

    def __init__(self, workspace: Workspace, parent: QObject) -> None:
        super().__init__(parent)
        self._workspace = workspace
        self._asked: tuple[Merge, bool] | None = None
        self._checked: ResultCheck | None = None
        self._task: Task | None = None
        self._painted = single_shot(self, self._begin, _PAINTED_MS)

    @property
    def is_ready(self) -> bool:
        """Whether it is known what would be found."""
        return self._checked is not None

    def start(self, merge: Merge, *, is_file: bool) -> None:
        """Check the result of other sources; ``is_file``: the open file is one of them,
        and its findings are known.
        """
        self._asked, self._checked = (merge, is_file), None
        self._painted.start()

    def _begin(self) -> None:
        if self._task is not None or self._asked is None:
            return
        (merge, is_file), own = self._asked, self._workspace.validator.own
        before = self._workspace.findings if is_file else None

        def work(_: TaskProgress, __: threading.Event) -> tuple[Merge, ResultCheck]:
            known = Validator(merge.a.copy(), own).run() if before is None else before
            return merge, ResultCheck(merge, known, own)

        self._task = Task(work)
        self._task.done.connect(self._done)
        self._task.failed.connect(self._failed)
        self._task.begin()

    def _done(self, made: tuple[Merge, ResultCheck]) -> None:
        self._task = None
        if self._asked is not None and made[0] is self._asked[0]:
            self._checked = made[1]
            self.follow()
            self.ready.emit()
        else:
            self._painted.start()

    def _failed(self, error: Exception) -> None:
        self._task = None
        self.failed.emit(str(error))

    def follow(self) -> None:
        """Check again what a choice has changed."""
        if self._checked is None or self._asked is None or self._checked.update(self._asked[0], _MANY):
            return
        self._checked = None  # so many at once are checked in the background
        self._painted.start()

    def new(self) -> list[Finding]:
        """Return the errors and warnings that the file would get; none while they are not known."""
        return [f for f in self._checked.new if f.severity != "advice"] if self._checked else []

    def of_choice(self, row: Row, choice: MergeChoice) -> list[Finding] | None:
        """Return the findings about a row if that were chosen; None while they are not known."""
        return self._checked.with_choice(row, choice) if self._checked else None
