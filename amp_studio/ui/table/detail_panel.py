"""The right side: the selected parameter with its value in its range, rules, help,
where else it has a value, and facts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cached_property

from PySide6.QtCore import Qt, QUrl, Signal
from PySide6.QtGui import QResizeEvent, QShowEvent
from PySide6.QtWidgets import QBoxLayout, QHBoxLayout, QLabel, QTextBrowser, QWidget

from amp_studio.files import RECORD, axis_letter, real_path, shown_axes
from amp_studio.schema import Address, Value, convert, limits
from amp_studio.ui.base.figures import unbroken
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.task import Task
from amp_studio.ui.base.theme import GAP2, GAP3, font, scheme
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.elided_label import ElidedLabel
from amp_studio.ui.forms.pages import LINK
from amp_studio.ui.forms.segment import Segment
from amp_studio.validate import NOT_SET, SEVERITIES

from .detail_page import CALCULATE, DOWNLOAD, FOLD, MESSAGE, USE, DetailPage, hex_text
from .range_bar import RangeBar, ValueInRange
from .word_panel import WordPanel

_MAX_AXES = 8
"""Axes that the segment has room for; the others are chosen in the table."""
_TWO_COLUMNS, _SIDE_WIDTH = 600, 340
"""Width from which the value is beside its page, below the table of a narrow window, and its width there."""
_REST_MS = 150
"""Milliseconds that a selection must rest before the rules are asked which values they allow."""


class DetailPanel(QWidget):
    """Shows one address; links lead to other parameters."""

    linked = Signal(str)
    """A parameter id that was clicked."""
    axis_requested = Signal(object)
    """The same parameter of another axis is to be selected."""
    message_requested = Signal(str)
    """The id of a message of the control that was clicked."""
    calculator_requested = Signal()
    """The formulas of the parameter are to be opened."""

    def __init__(
        self, workspace: Workspace, commit: Callable[[Address, str], bool], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._workspace, self._commit = workspace, commit
        self._address: Address | None = None
        self._is_stale = False
        self._written: tuple[Address | None, str] = None, ""
        """What the page is about, and its text."""
        self._writer = DetailPage(workspace)
        self.head = self._make_head()
        self.axes = Segment(self.tr("Axis"), is_tight=True)
        self.axes.chosen.connect(self._choose_axis)
        self.value = QLabel()
        self.value.setFont(font("title"))
        self.value.setAccessibleName(self.tr("Value"))
        self.value.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.bar = RangeBar()
        self.page = QTextBrowser()
        self.page.setOpenLinks(False)
        self.page.setAccessibleName(self.tr("Parameter"))
        self.page.document().setDocumentMargin(GAP3)
        # A table that is a pixel too wide takes it from the margin.
        self.page.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.page.anchorClicked.connect(self._follow)
        self._top = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        self._top.setContentsMargins(GAP3, GAP2, GAP3, 0)
        self._top.addWidget(self.axes)
        self._top.addStretch(1)
        self._top.addWidget(self.value)
        self._side = QWidget(self)
        self._beside = in_column(self._top, self.bar, 0, on=self._side, margins=0)
        self._rows = QBoxLayout(QBoxLayout.Direction.TopToBottom, self)
        self._rows.setContentsMargins(0, 0, 0, 0)
        self._rows.setSpacing(GAP2)
        self._rows.addWidget(self._side)
        self._rows.addWidget(self.page, 1)
        self.setFocusProxy(self.page)
        self._pause = single_shot(self, self._ask_rules, _REST_MS)
        workspace.changed.connect(self._show)
        workspace.saved.connect(self._show)
        scheme().changed.connect(self._show)
        self._show()

    @cached_property
    def word(self) -> WordPanel:
        """The bits and fields of a word, made for the first parameter that has some."""
        word = WordPanel(self._workspace, self._commit, self._side)
        self._beside.insertWidget(self._beside.count() - 1, word)
        self._workspace.changed.connect(lambda _: word.refresh())
        return word

    def _make_head(self) -> QWidget:
        head = QWidget()
        self.number, self.name = QLabel(), ElidedLabel()
        self.number.setForegroundRole(self.number.palette().ColorRole.PlaceholderText)
        self.name.setFont(font("text", own=True))
        self.tools = QHBoxLayout()
        in_row(self.number, (self.name, 1), self.tools, on=head, margins=(GAP3, 0, GAP2, 0), gap=GAP2)
        return head

    def take_others(self, others: Callable[[], Iterable[Workspace]]) -> None:
        """Show the values of these open files too."""
        self._writer.others = others

    def show_address(self, address: Address | None) -> None:
        """Show an address, or nothing."""
        if address != self._address:
            self._writer.last_download = None
        self._address = address
        has_bits = address is not None and self._workspace.file.schema.parameters[address[0]].bits
        if has_bits or "word" in vars(self):
            self.word.show_address(address)
        self._show()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        is_wide = event.size().width() >= _TWO_COLUMNS
        self._rows.setDirection(
            QBoxLayout.Direction.LeftToRight if is_wide else QBoxLayout.Direction.TopToBottom
        )
        self._side.setMaximumWidth(_SIDE_WIDTH if is_wide else 16_777_215)
        self._place_value()

    def _place_value(self) -> None:
        """Show the value beside the axes, or below them where it has no room: the panel keeps its width."""
        room = min(self.width(), self._side.maximumWidth()) - 2 * GAP3
        self.value.setWordWrap(False)
        axes = 0 if self.axes.isHidden() else self.axes.sizeHint().width() + self._top.spacing()
        is_beside = axes + self.value.sizeHint().width() <= room
        directions = QBoxLayout.Direction
        self._top.setDirection(directions.LeftToRight if is_beside else directions.TopToBottom)
        self.value.setWordWrap(not is_beside)

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        if self._is_stale:
            self._show()

    def _show(self, *_: object) -> None:
        self._is_stale = not self.isVisible()
        if self._is_stale:  # written when it can be seen
            return
        address, file = self._address, self._workspace.file
        # The selection moves on: what the rules allow is asked only where it rests.
        self._pause.stop()
        if address is None:
            self.number.clear()
            self.name.setText(self.tr("Parameter"))
            self.value.clear()
            self.axes.hide()
            self.bar.show_range(None)
            self.page.clear()
            self._written = None, ""
            return
        number = file.machine_schema.number(address)
        self.number.setText(number or "")
        self.number.setVisible(bool(number))
        self.name.setText(file.schema.parameters[address[0]].name)
        self.name.setToolTip(file.machine_schema.label(address))
        value, has_boxes = file.get(address), bool(file.schema.parameters[address[0]].bits)
        word = value.value if has_boxes and value is not None else None
        # The names of the bits are on the check boxes below.
        self.value.setText(
            hex_text(word) if isinstance(word, int) else self._writer.value_html(address, value)
        )
        self._show_axes(address)
        self._place_value()
        self.bar.show_range(self._in_range(address))
        if self.bar.isVisibleTo(self):
            self._pause.start()
        self._writer.may_have_download = real_path(self._workspace.path).with_name(RECORD).exists()
        self._put(address, self._writer.write(address))

    def _put(self, address: Address, text: str) -> None:
        """Show a page; one of the same value stays where it was scrolled to."""
        (before, written), self._written = self._written, (address, text)
        if text == written:
            return
        page, bar, policies = self.page, self.page.verticalScrollBar(), Qt.ScrollBarPolicy
        place = bar.value() if address == before else 0
        # A page is empty for a moment: where the bar went and came again, each would be laid out three times.
        page.setVerticalScrollBarPolicy(
            policies.ScrollBarAlwaysOn if bar.isVisible() else policies.ScrollBarAsNeeded
        )
        page.setHtml(unbroken(text))
        page.setVerticalScrollBarPolicy(policies.ScrollBarAsNeeded)
        bar.setValue(place)

    def _show_axes(self, address: Address) -> None:
        file = self._workspace.file
        axes = shown_axes(file) if file.evaluation.scope(address) == "axis" else ()
        self.axes.setVisible(1 < len(axes) <= _MAX_AXES)
        if 1 < len(axes) <= _MAX_AXES:
            self.axes.offer([(axis, axis_letter(file, axis) or axis, "") for axis in axes])
            self.axes.show_choice(address[1])

    def _choose_axis(self, axis: str) -> None:
        if self._address is not None:
            self.axis_requested.emit((self._address[0], axis))

    # -- the bar -----------------------------------------------------------------

    def _in_range(self, address: Address) -> ValueInRange | None:
        """Return the value in its range; None where there is no range with two ends, and for choices,
        words and secrets.
        """
        file = self._workspace.file
        parameter = file.schema.parameters[address[0]]
        if parameter.choices or parameter.secret or parameter.type not in ("integer", "real"):
            return None
        unit = self._workspace.typed_unit(address)
        found = limits(file.evaluation, address, unit)
        if found is None or found.low is None or found.high is None or found.low >= found.high:
            return None
        value, default = (_number(v, unit) for v in (file.get(address), file.default(address)))
        return ValueInRange(found.low, found.high, unit, value, default, self._worst(address))

    def _worst(self, address: Address) -> str:
        """Return the worst severity of the findings that a value is the cause of; "" without any."""
        severities = {
            f.severity
            for f in self._workspace.findings_of(address)
            if f.rule != NOT_SET and address in f.causes and not self._workspace.is_deferred(f)
        }
        return next((severity for severity in SEVERITIES if severity in severities), "")

    def _ask_rules(self) -> None:
        """Ask in the background which values the rules allow;
        an answer for what is no longer shown is not used.
        """
        address = self._address
        found = self._in_range(address) if address else None
        if address is None or found is None:
            return
        search = self._workspace.validator.allowed(address, found.unit)
        # The search begins where a value is most likely allowed.
        near = [x for x in (found.value, found.default) if x is not None]
        task = Task(lambda *_: (address, found, search.around(found.low, found.high, near)))
        task.done.connect(self._take_allowed)
        task.begin()

    def _take_allowed(self, answer: tuple[Address, ValueInRange, tuple[float, float] | None]) -> None:
        address, found, allowed = answer
        # Another address, or another range of it, may be on the screen by now.
        if self._address == address and self._in_range(address) == found:
            self.bar.show_allowed(allowed)

    # -- links -------------------------------------------------------------------

    def _follow(self, url: QUrl) -> None:
        text, address = url.toString(), self._address
        if text.startswith(FOLD):
            self._writer.opened ^= {text.removeprefix(FOLD)}
            self._show()
        elif text.startswith(CALCULATE):
            self.calculator_requested.emit()
        elif text.startswith(MESSAGE):
            self.message_requested.emit(text.removeprefix(MESSAGE))
        elif text.startswith(USE) and address is not None:
            self._use(address, int(text.removeprefix(USE)))
        elif text.startswith(DOWNLOAD) and address is not None:
            self._read_download(address)
        else:
            self.linked.emit(text.removeprefix(LINK))

    def _use(self, address: Address, place: int) -> None:
        """Take the value that a fix gives this parameter, and only that one."""
        finding = self._writer.findings(address)[place]
        wanted = {setting.address: setting.value for setting in finding.fix if setting.address == address}
        self._workspace.edit(self.tr("Use the calculated value"), wanted)

    def _read_download(self, address: Address) -> None:
        from amp_studio.files import day_and_time
        from amp_studio.transfer.client import NoDownloadError, last_download

        # A copy: the thread reads it while the file may be edited.
        file, path = self._workspace.file.copy(), self._workspace.path

        not_known = self.tr("not known")

        def work(*_: object) -> tuple[Address, str, Value | None]:
            try:
                last = last_download(file, path)
            except (NoDownloadError, OSError):
                return address, not_known, None
            return address, day_and_time(last.when), last.file.get(address)

        task = Task(work)
        task.done.connect(self._take_download)
        task.begin()

    def _take_download(self, answer: tuple[Address, str, Value | None]) -> None:
        if self._address == answer[0]:
            self._writer.last_download = answer[1:]
            self._show()


def _number(value: Value | None, unit: str) -> float | None:
    """Return the number of a value in a unit; None for anything that is no number there."""
    if value is None or isinstance(value.value, str | bool):
        return None
    try:
        return convert(value.value, value.unit, unit) if unit and value.unit else float(value.value)
    except (ValueError, KeyError):
        return None
