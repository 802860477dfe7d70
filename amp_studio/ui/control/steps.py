"""The right side of the page at the control: what will happen, how far it is, and what to mind."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import QLabel, QListWidget, QListWidgetItem, QWidget

from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.theme import GAP, GAP2, GAP3, SMALL_ICON, font, severity_icon
from amp_studio.ui.base.translated import tr

if TYPE_CHECKING:
    from amp_studio.report import Danger

    from .session import ControlSession

_STAGES = ("identify", "keep", "download", "verify", "commit")
_OF_PROGRESS = {"keep": 1, "download": 2, "commit": 2, "restart": 3, "verify": 3, "upload": 1}
"""Stage of an exchange -> the step that is under way."""


class ExchangeSteps(QWidget):
    """Five steps and the statements of danger; a click on one selects its row."""

    chosen = Signal(object)
    line_changed = Signal(str)
    """The steps in one line, for a page that has no room beside its table."""

    def __init__(self) -> None:
        super().__init__()
        self.setMinimumWidth(220)
        self._title, self._remark = QLabel(self.tr("What will happen")), QLabel(self.tr("Mind"))
        for label in (self._title, self._remark):
            label.setFont(font("small"))
            label.setForegroundRole(label.palette().ColorRole.PlaceholderText)
        self._lines = [(QLabel(), QLabel()) for _ in range(5)]
        column = in_column(self._title, on=self, margins=(GAP3, GAP2, GAP2, 0), gap=GAP)
        for first, second in self._lines:
            first.setFont(font("text"))
            second.setFont(font("small"))
            second.setForegroundRole(second.palette().ColorRole.PlaceholderText)
            second.setWordWrap(True)
            column.addWidget(first)
            column.addWidget(second)
        column.addWidget(self._remark)
        self.list = QListWidget()
        self.list.setAccessibleName(self.tr("Dangers of the values that change"))
        self.list.setFrameShape(QListWidget.Shape.NoFrame)
        self.list.setWordWrap(True)
        self.list.setIconSize(QSize(SMALL_ICON, SMALL_ICON))
        self.list.itemClicked.connect(lambda item: self.chosen.emit(item.data(Qt.ItemDataRole.UserRole)))
        column.addWidget(self.list, 1)
        column.addStretch(0)
        self._at = -1

    def show_plan(
        self, direction: str, session: ControlSession | None, count: int, dangers: Sequence[Danger]
    ) -> None:
        """Show what will happen, or what has happened."""
        phase = session.phase if session else "away"
        self._show_phase(phase)
        whole = session is None or session.seen is None or session.seen.abilities.all_or_nothing
        is_sent = direction == "send"
        self._show_texts(_texts(count, whole) if is_sent else _reading(), is_sent=is_sent)
        self._show_dangers(dangers, is_over=phase in ("done", "failed"))
        self._show_line()

    def _show_phase(self, phase: str) -> None:
        if phase == "running":
            self._title.setText(self.tr("Under way"))
        else:
            self._title.setText(
                self.tr("What happened") if phase in ("done", "failed") else self.tr("What will happen")
            )
            # Where it failed it stays where it got to, so that the ticks show how far it was.
            self._at = len(_STAGES) if phase == "done" else self._at if phase == "failed" else -1

    def _show_texts(self, texts: Sequence[tuple[str, str]], *, is_sent: bool) -> None:
        for n, (first, second) in enumerate(self._lines):
            first.setVisible(n < len(texts))
            second.setVisible(n < len(texts))
            if n < len(texts):
                mark = "✓ " if n < self._at and is_sent else f"{n + 1}  "
                first.setText(mark + texts[n][0])
                second.setText(texts[n][1])

    def _show_dangers(self, dangers: Sequence[Danger], *, is_over: bool) -> None:
        """Show each value that changes with all that is dangerous about it; nothing once it is over."""
        self._remark.setVisible(bool(dangers) and not is_over)
        self.list.setVisible(bool(dangers) and not is_over)
        self.list.clear()
        about: dict[tuple[str, str], list[str]] = {}
        for danger in dangers:
            for place in danger.about:
                about.setdefault(place, []).append(danger.says)
        for (anchor, label), statements in about.items():
            item = QListWidgetItem(severity_icon("error"), label)
            parameter, _, instance = anchor.rpartition("@")
            item.setData(Qt.ItemDataRole.UserRole, (parameter, instance))
            item.setToolTip("\n".join(statements))
            self.list.addItem(item)

    def _show_line(self) -> None:
        self.line_changed.emit("   ".join(first.text() for first, _ in self._lines if not first.isHidden()))

    def show_stage(self, stage: str, done: int, total: int) -> None:
        """Show how far an exchange is."""
        step = _OF_PROGRESS.get(stage)
        # Stages of waiting belong to no step.
        if step is None:
            return
        self._at = step
        for n, (first, second) in enumerate(self._lines):
            text = first.text()[2:].lstrip()
            first.setText(("✓ " if n < step else "▸ " if n == step else f"{n + 1}  ") + text)
            if n == step and total > 0:
                second.setText(tr("{done} of {total}").format(done=done, total=total))
        self._show_line()


def _texts(count: int, whole: bool) -> list[tuple[str, str]]:
    last = (
        (tr("Commit all or nothing"), tr("until then the old values stay"))
        if whole
        else (tr("Each value acts at once"), tr("cancelling leaves what is confirmed"))
    )
    return [
        (tr("Identify"), tr("same machine, same options")),
        (tr("Back up what it contains"), tr("as a file beside this one")),
        (
            tr("Write %n values", "", count) if count else tr("Write the values"),
            tr("only what was shown may be replaced"),
        ),
        (tr("Read everything back"), tr("compared exactly")),
        last,
    ]


def _reading() -> list[tuple[str, str]]:
    return [
        (tr("Identify"), tr("reads only")),
        (tr("Read what it contains"), tr("nothing is changed in the control")),
        (tr("Compare with the file"), tr("every value, exactly")),
    ]
