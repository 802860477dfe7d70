"""The sheet of values to key in at a control as a list on the screen: tick each value,
type in what the control shows.
"""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QBrush, QFont
from PySide6.QtWidgets import (
    QHeaderView,
    QLabel,
    QPushButton,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTabWidget,
    QTextBrowser,
    QTreeWidget,
    QTreeWidgetItem,
    QWidget,
)

from amp_studio.sheet import Instruction, ReadBackState, Sheet, SheetEntry, SheetError, Ticks, judged
from amp_studio.ui.base.ask_path import ask_to_save
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.places import place_in_words
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.theme import GAP2, GAP3, Token, colour, scheme, severity_icon
from amp_studio.ui.base.translated import message_in_words, tr
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.message_bar import MessageBar

from .rows import FOOT, side_by_side

_STEP, _NUMBER, _KEY_IN, _UNIT, _NOW, _NAME, _READ, _RESULT = range(8)
_WIDTHS = (120, 90, 110, 60, 100, 270, 110, 130)
_ENTRY = Qt.ItemDataRole.UserRole
_FILTERS = "PDF (*.pdf);;Web page (*.html);;Text (*.txt);;Table with a column to fill in (*.csv)"
_TOKENS: dict[str, Token] = {"same": "text", "old": "error", "other": "error"}


def _in_words(state: ReadBackState) -> str:
    """Return what a value that was read back is."""
    names: dict[ReadBackState, str] = {
        "same": tr("as keyed in"),
        "old": tr("still the old value"),
        "other": tr("another value"),
        "not read": tr("not read back"),
    }
    return names[state]


class _ReadBackOnly(QStyledItemDelegate):
    """Lets a person type in the column of what the screen shows, and nowhere else."""

    def createEditor(  # type: ignore[override]  # Qt's name; Qt takes no editor too
        self, parent: QWidget, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> QWidget | None:
        """Return the editor of a cell; None where nothing is typed in."""
        return super().createEditor(parent, option, index) if index.column() == _READ else None


SheetSource = Callable[[], tuple[Sheet, Ticks]]
"""Makes the sheet of the file as it is now, with its ticks; raises SheetError."""


class HandSheet(QWidget):
    """One sheet with its ticks, which are on the disk as soon as they are made."""

    control_requested = Signal()
    """The sheet is to be made against what the chosen control contains."""
    file_requested = Signal()
    """The sheet is to be made against a file or a backup."""

    def __init__(self) -> None:
        super().__init__()
        self._workspace: Workspace | None = None
        self._make: SheetSource | None = None
        self.sheet: Sheet | None = None
        self.ticks: Ticks | None = None
        self.seen: object = None
        self.bar = MessageBar()
        self.text, self.details = QLabel(), QLabel()
        for label in (self.text, self.details):
            label.setWordWrap(True)
            label.setTextFormat(Qt.TextFormat.PlainText)
            label.setContentsMargins(GAP3, GAP2, GAP3, GAP2)
        self.details.setMinimumHeight(54)
        self.details.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.list = _list()
        self.around, self.left_out = QTextBrowser(), QTextBrowser()
        self.tabs = QTabWidget()
        for title, page in (
            (self.tr("&Values"), self.list),
            (self.tr("&Before and After"), self.around),
            (self.tr("&Not on This Sheet"), self.left_out),
        ):
            self.tabs.addTab(page, title)
        self.control_button = QPushButton(self.tr("Against the &Control"))
        self.file_button = QPushButton(self.tr("Against a &File…"))
        self.update_button = QPushButton(self.tr("&Update"))
        self.save_button = QPushButton(self.tr("&Save or Print…"))
        for button, act in (
            (self.control_button, self.control_requested.emit),
            (self.file_button, self.file_requested.emit),
            (self.update_button, self.refresh),
            (self.save_button, self.save),
        ):
            button.clicked.connect(act)
        footer = (self.control_button, self.file_button, None, self.update_button, self.save_button)
        parts = (self.bar, self.text, (self.tabs, 1), self.details, side_by_side(FOOT, *footer))
        in_column(*parts, on=self, margins=0, gap=0)
        self.list.itemChanged.connect(self._edited)
        self.list.currentItemChanged.connect(self._explain)
        self.list.itemActivated.connect(self._type)
        scheme().changed.connect(self._judge_all)
        self.setFocusProxy(self.list)

    def show_file(self, workspace: Workspace) -> None:
        """Show the sheet of a file; what its control contains is asked for if that is not known."""
        if workspace is self._workspace:
            return
        if self._workspace is not None:
            self._workspace.changed.disconnect(self._stale)
            self._workspace.closed.disconnect(self._forget)
        workspace.changed.connect(self._stale)
        workspace.closed.connect(self._forget)
        self._forget()
        self._workspace = workspace

    def _forget(self) -> None:
        self._workspace, self._make, self.sheet, self.ticks, self.seen = None, None, None, None, None
        self.bar.hide()
        self._fill()

    def make(self, source: SheetSource, seen: object = None) -> None:
        """Show another sheet; raises what ``source`` raises, and then the one before stays.

        ``seen`` is the reading of the control that it is made against; None for a file.
        """
        # Both or none: ``source`` may raise, and the sheet on the screen must go with its own ticks.
        self.sheet, self.ticks = source()
        self._make, self.seen = source, seen
        self.bar.hide()
        self._fill()

    # -- what is shown -----------------------------------------------------------

    def items(self) -> list[QTreeWidgetItem]:
        """Return the rows of the entries, in the order of the steps."""
        stages = (self.list.topLevelItem(n) for n in range(self.list.topLevelItemCount()))
        rows = (stage.child(n) for stage in stages if stage is not None for n in range(stage.childCount()))
        return [row for row in rows if row is not None]

    def refresh(self) -> None:
        """Make the sheet again: the file has changed."""
        assert self._make is not None
        try:
            self.make(self._make, self.seen)
        except SheetError as error:  # the file has become one of another machine type
            why = message_in_words(str(error))
            self.bar.say(f"{why[:1].upper()}{why[1:]}.", "warning")

    def _fill(self) -> None:
        from amp_studio.report import PrintedSheet

        self.update_button.setEnabled(False)
        self.save_button.setEnabled(self.sheet is not None)
        self.tabs.setVisible(self.sheet is not None)
        align = Qt.AlignmentFlag
        self.text.setAlignment(
            align.AlignCenter if self.sheet is None else align.AlignLeft | align.AlignVCenter
        )
        self.details.setVisible(self.sheet is not None)
        # Qt emits itemChanged for what the program writes too: it would be taken for a tick or a value read
        # back.
        with QSignalBlocker(self.list):
            self.list.clear()
            if self.sheet is None:
                self.list.blockSignals(False)
                self.text.setText(
                    self.tr(
                        "The sheet lists the values that differ from what the control contains. Where is that"
                        " known from?"
                    )
                )
                return
            for stage, steps in PrintedSheet(self.sheet).parts():
                head = QTreeWidgetItem([stage.title or self.tr("Values")])
                head.setToolTip(0, stage.why)
                head.setFirstColumnSpanned(True)
                self.list.addTopLevelItem(head)
                head.setFirstColumnSpanned(True)
                bold = QFont(self.list.font())
                bold.setBold(True)
                head.setFont(0, bold)
                head.setFlags(Qt.ItemFlag.ItemIsEnabled)
                for step in steps:
                    head.addChild(self._row(step.at, step.entry, bold))
            self.list.expandAll()
        self.around.setPlainText(
            _instructions(self.tr("Before"), self.sheet.before)
            + _instructions(self.tr("After"), self.sheet.after)
        )
        self.left_out.setPlainText(
            "\n".join(f"{left.number}  {left.name}: {left.why}." for left in self.sheet.left_out)
        )
        self.tabs.setTabVisible(2, bool(self.sheet.left_out))
        self._count()

    def _row(self, at: int, entry: SheetEntry, bold: QFont) -> QTreeWidgetItem:
        assert self.ticks is not None
        item = QTreeWidgetItem(
            [
                str(at),
                entry.number,
                entry.new,
                entry.unit,
                entry.old or "?",
                self._name(entry) + (f" = {entry.meaning}" if entry.meaning else ""),
                self.ticks.screen_text.get(entry.number, ""),
                "",
            ]
        )
        item.setData(_STEP, _ENTRY, entry)
        item.setFlags(item.flags() | Qt.ItemFlag.ItemIsEditable | Qt.ItemFlag.ItemIsUserCheckable)
        item.setCheckState(_STEP, Qt.CheckState.Checked if entry in self.ticks else Qt.CheckState.Unchecked)
        item.setFont(_KEY_IN, bold)
        for column in (_KEY_IN, _NOW):
            item.setTextAlignment(column, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        if entry.order or entry.until:
            item.setIcon(_NAME, severity_icon("warning"))
        self._judge(item)
        return item

    def _name(self, entry: SheetEntry) -> str:
        """Return the name of a parameter with the letter of its axis: ``Excess Error, X axis``."""
        assert self._workspace is not None
        name = entry.name.removesuffix(entry.place).rstrip()
        place = place_in_words(self._workspace.file, entry.address) if entry.place else ""
        return f"{name}, {place}" if place else name

    def _judge_all(self) -> None:
        """Show every result in the colours of the theme."""
        with QSignalBlocker(self.list):
            for item in self.items():
                self._judge(item)

    def _judge(self, item: QTreeWidgetItem) -> None:
        found = judged(item.data(_STEP, _ENTRY), item.text(_READ))
        item.setText(_RESULT, "" if found.state == "not read" else _in_words(found.state))
        if found.state in _TOKENS:
            item.setForeground(_RESULT, QBrush(colour(_TOKENS[found.state])))

    def _count(self) -> None:
        assert self.sheet is not None
        assert self.ticks is not None
        total, items = len(self.sheet.entries), self.items()
        states = [judged(item.data(_STEP, _ENTRY), item.text(_READ)).state for item in items]
        parts = [
            self.tr("{done} of {total} keyed in").format(done=self.ticks.done, total=total),
            self.tr("{count} read back as they should be").format(count=states.count("same")),
        ]
        if wrong := states.count("old") + states.count("other"):
            parts.append(self.tr("{wrong} not as keyed in").format(wrong=wrong))
        if self.ticks.forgotten:
            parts.append(
                self.tr("{forgotten} ticks left out, whose values have changed since").format(
                    forgotten=self.ticks.forgotten
                )
            )
        lines = [
            ", ".join(parts) + self.tr(". Compared with {present}.").format(present=self.sheet.present),
            *self.sheet.warnings,
        ]
        self.text.setText("\n".join(lines))

    def _explain(self, item: QTreeWidgetItem | None, *_: object) -> None:
        entry = item.data(_STEP, _ENTRY) if item is not None else None
        if isinstance(entry, SheetEntry) and self.sheet is not None:
            stage = self.sheet.stages[entry.stage]
            why = (
                self.tr("{why} (page {page})").format(why=stage.why, page=stage.page)
                if stage.page
                else stage.why
            )
            self.details.setText(
                "\n".join(
                    filter(None, (f"{entry.name}, page {entry.page}. {why}", entry.order, *entry.until))
                )
            )
        else:
            self.details.clear()

    # -- what a person does --------------------------------------------------------

    def _type(self, item: QTreeWidgetItem) -> None:
        if isinstance(item.data(_STEP, _ENTRY), SheetEntry):
            self.list.editItem(item, _READ)

    def _edited(self, item: QTreeWidgetItem, column: int) -> None:
        """Keep a tick, or what was typed in, beside the file."""
        entry = item.data(_STEP, _ENTRY)
        if not isinstance(entry, SheetEntry) or column not in (_STEP, _READ):
            return
        assert self.ticks is not None
        try:
            if column == _STEP:
                self.ticks.tick([entry], item.checkState(_STEP) == Qt.CheckState.Checked)
            else:
                self.ticks.read_back(entry, item.text(_READ))
        except OSError as error:
            # The tick stays on the screen: the value was keyed in, whether that can be stored or not.
            self.bar.say(
                self.tr("The tick is not kept: {error}.").format(error=message_in_words(str(error))), "error"
            )
        with QSignalBlocker(self.list):
            self._judge(item)
        self._count()

    def _stale(self, *_: object) -> None:
        if self.sheet is not None:
            self.update_button.setEnabled(True)
            text = self.tr("The file has changed: update the sheet before you go on.")
            self.bar.say(text, "warning", (self.tr("Update"), self.refresh))

    def save(self) -> None:
        """Ask for a name and write the sheet; the ending sets the format."""
        from amp_studio.report import PrintedSheet, write_sheet

        assert self._workspace is not None
        assert self.sheet is not None
        assert self.ticks is not None
        near = self._workspace.path.with_name(f"{self._workspace.path.stem}-sheet.pdf")
        path = ask_to_save(self, self.sheet.title, near, _FILTERS)
        if path is None:
            return
        printed = PrintedSheet(
            self.sheet,
            {e.number for e in self.sheet.entries if e in self.ticks},
            tuple(self.ticks.screen_text.items()),
        )
        try:
            in_background(self, self.tr("Printing"), lambda: write_sheet(printed, path))
        except (OSError, ValueError) as error:
            self.bar.say(message_in_words(str(error)), "error")


def _list() -> QTreeWidget:
    found = QTreeWidget()
    found.setHeaderLabels(
        [
            tr("Step"),
            tr("Number"),
            tr("Key In"),
            tr("Unit"),
            tr("Now"),
            tr("Parameter"),
            tr("Screen Shows"),
            tr("Result"),
        ]
    )
    found.setUniformRowHeights(True)
    found.setAlternatingRowColors(True)
    found.setItemDelegate(_ReadBackOnly(found))
    found.setAllColumnsShowFocus(True)
    for column, width in enumerate(_WIDTHS):
        found.setColumnWidth(column, width)
    found.header().setSectionResizeMode(_NAME, QHeaderView.ResizeMode.ResizeToContents)
    return found


def _instructions(title: str, steps: tuple[Instruction, ...]) -> str:
    if not steps:
        return ""
    lines = (
        f"{n}. {each.text}" + (f" (page {each.page})" if each.page else "") for n, each in enumerate(steps, 1)
    )
    return f"{title}\n\n" + "\n".join(lines) + "\n\n"
