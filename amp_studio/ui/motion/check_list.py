"""The list of the checks of a machine: parts with their heads, and a row a check with its mark, the share of
its limit that it uses as a bar, and its figure.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Sequence

from PySide6.QtCore import (
    QAbstractListModel,
    QModelIndex,
    QPersistentModelIndex,
    QPointF,
    QRect,
    QRectF,
    QSize,
    Qt,
)
from PySide6.QtGui import QColor, QFontMetrics, QKeyEvent, QPainter, QPen
from PySide6.QtWidgets import (
    QAbstractItemView,
    QListView,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QWidget,
)

from amp_studio.files import ParameterFile
from amp_studio.sim import CheckPart, LimitUse, MotionCheck, value_text
from amp_studio.ui.base.figures import as_tip, written
from amp_studio.ui.base.places import sentenced_with_letters
from amp_studio.ui.base.theme import GAP, GAP2, GAP3, ROW, SMALL_ICON, Token, colour, font, icon
from amp_studio.ui.base.translated import scenario_in_words, sentenced, tr, unit_in_words, worded

RowIndex = QModelIndex | QPersistentModelIndex
MARKS: dict[str, tuple[str, Token]] = {
    "bad": ("x-circle-fill", "error"),
    "doubtful": ("warning-fill", "warn"),
    "good": ("check", "text"),
    "not possible": ("circle-dashed", "dim"),
}
"""Verdict -> its icon; in this order within a part."""
PARTS: tuple[CheckPart, ...] = ("homing", "travel", "following", "spindle", "probing", "coupling")
_BAR = 44
"""Width of a bar in logical pixels."""
_WITH_BARS = 300
"""Width of the list from which there is room for bars."""
_NEAR = 0.95
"""Share of its limit from which a figure is bold."""


def verdict_in_words(verdict: str) -> str:
    """Return a verdict in the language of the window."""
    return {
        "good": tr("good"),
        "doubtful": tr("doubtful"),
        "bad": tr("bad"),
        "not possible": tr("not possible"),
    }[verdict]


def part_in_words(part: CheckPart) -> str:
    """Return what a part of the list is about."""
    return {
        "homing": tr("Homing"),
        "travel": tr("Travel and zones"),
        "following": tr("Following and limits"),
        "spindle": tr("Spindle"),
        "probing": tr("Probes and stops"),
        "coupling": tr("Gears and cams"),
    }[part]


def _name_of_check(check: MotionCheck) -> str:
    """Return scenario and axis."""
    return " ".join(filter(None, (scenario_in_words(check.scenario), check.letter)))


def figures_of(check: MotionCheck) -> list[str]:
    """Return the figures of a check in words, each with its number first: where there is no room for all, the
    number stays.
    """
    return [
        f"{worded(name.replace('_', ' '))} {_number_in_words(value, unit)}"
        for name, (value, unit) in check.figures.items()
        if value is not None
    ]


def _number_in_words(value: float | None, unit: str, digits: int = 4) -> str:
    """Return a figure with its unit; a dash for none."""
    return "–" if value is None else written(value_text(float(value), unit_in_words(unit), digits))


def figure_of(file: ParameterFile, check: MotionCheck) -> str:
    """Return the one figure of a row: how much of its limit a check uses, or what it found."""
    if check.verdict == "not possible":
        is_missing = any(_is_not_set(file, each, check.axis) for each in check.params)
        return tr("not set") if is_missing else tr("not possible")
    if check.use is not None and check.part == "following":
        return _of_limit(check.use, is_good=check.verdict == "good")
    value, unit = check.figures.get(check.headline, (None, ""))
    return "" if value is None else _number_in_words(value, unit, 3)


def _of_limit(use: LimitUse, *, is_good: bool) -> str:
    """Return a figure of its limit where it is not good, else the share of it."""
    if use.most is not None and use.value is not None and not is_good:
        peak, most = (written(value_text(each, digits=3)) for each in (use.value, use.most))
        limit = f"{most} {unit_in_words(use.unit)}".rstrip()
        return tr("{value} of {limit}").format(value=peak, limit=limit)
    share = written(value_text(100.0 * use.share, digits=3))
    return f"{share} %" if math.isfinite(use.share) else tr("unstable")


def _is_not_set(file: ParameterFile, parameter: str, axis: str) -> bool:
    instances = file.machine_schema.instances(file.schema.parameters[parameter])
    # A check that is of no axis, as of a spindle that there is not, asks for a parameter of any of them.
    places = (axis,) if axis in instances else instances
    return all(file.get((parameter, each)) is None for each in places)


class CheckRows(QAbstractListModel):
    """Parts and their checks, what is bad first in each; filtered by their verdicts."""

    def __init__(self, file: ParameterFile) -> None:
        super().__init__()
        self.file = file
        self.checks: list[MotionCheck] = []
        """In the order in which they were made."""
        self.wanted: frozenset[str] = frozenset()
        """The verdicts that are shown; all of them where it is empty."""
        self.rows: list[CheckPart | MotionCheck] = []

    def show_checks(self, checks: Iterable[MotionCheck], wanted: Collection[str] = ()) -> None:
        """Show these checks of these verdicts."""
        self.beginResetModel()
        self.checks, self.wanted = list(checks), frozenset(wanted)
        self.rows = list(self._ordered())
        self.endResetModel()

    def add(self, check: MotionCheck) -> None:
        """Show one more check, in its place; every row stays its own check."""
        self.checks.append(check)
        new = list(self._ordered())
        while len(self.rows) < len(new):
            # Inserted, not reset: a reset would take the selection away while checks still come in.
            at = next((n for n, each in enumerate(self.rows) if each is not new[n]), len(self.rows))
            self.beginInsertRows(QModelIndex(), at, at)
            self.rows.insert(at, new[at])
            self.endInsertRows()

    def _ordered(self) -> Iterable[CheckPart | MotionCheck]:
        order = list(MARKS)
        for part in PARTS:
            own = [c for c in self.checks if c.part == part and (not self.wanted or c.verdict in self.wanted)]
            if own:
                yield part
                # A stable sort: with one verdict they stay in the order in which they were made.
                yield from sorted(own, key=lambda check: order.index(check.verdict))

    def check(self, index: RowIndex) -> MotionCheck | None:
        """Return the check of a row; None for a head."""
        row = self.rows[index.row()] if index.isValid() else None
        return row if isinstance(row, MotionCheck) else None

    def rowCount(self, parent: RowIndex | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(self.rows)

    def flags(self, index: RowIndex) -> Qt.ItemFlag:
        # So that arrow keys skip a head.
        return super().flags(index) if self.check(index) else Qt.ItemFlag.NoItemFlags

    def data(self, index: RowIndex, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        row = self.rows[index.row()]
        if not isinstance(row, MotionCheck):
            return part_in_words(row) if role == Qt.ItemDataRole.DisplayRole else None
        if role == Qt.ItemDataRole.DisplayRole:
            return _name_of_check(row)
        if role == Qt.ItemDataRole.AccessibleTextRole:
            words = f"{_name_of_check(row)}: {verdict_in_words(row.verdict)}"
            return ", ".join(filter(None, (words, figure_of(self.file, row))))
        if role == Qt.ItemDataRole.ToolTipRole:
            return as_tip(self._tip(row))
        return None

    def _tip(self, check: MotionCheck) -> str:
        family, why = self.file.schema.family.family, sentenced_with_letters(self.file, check.why)
        parts = [f"{_name_of_check(check)}: {verdict_in_words(check.verdict)}", why]
        if check.use is not None and math.isfinite(check.use.share):
            share = written(value_text(100.0 * check.use.share, digits=3))
            limit = sentenced(check.use.limit.replace("_", " "), family)
            parts.append(tr("{share} % of its limit: {limit}").format(share=share, limit=limit))
        return "\n".join(filter(None, (*parts, ", ".join(figures_of(check)))))


class _CheckDelegate(QStyledItemDelegate):
    """Paints heads and rows of the list."""

    def sizeHint(self, option: QStyleOptionViewItem, index: RowIndex) -> QSize:
        return QSize(200, ROW)

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: RowIndex) -> None:
        model = index.model()
        assert isinstance(model, CheckRows)
        check, box = model.check(index), QRect(option.rect)
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if check is None:
            self._head(painter, box, str(index.data()))
        else:
            is_chosen = bool(option.state & QStyle.StateFlag.State_Selected)
            self._row(painter, box, model.file, check, is_chosen=is_chosen)
        painter.restore()

    def _head(self, painter: QPainter, box: QRect, text: str) -> None:
        painter.fillRect(box, colour("window"))
        strong = font("caption")
        strong.setWeight(strong.Weight.DemiBold)
        painter.setFont(strong)
        painter.setPen(colour("dim"))
        painter.drawText(box.adjusted(GAP3, 0, -GAP3, 0), Qt.AlignmentFlag.AlignVCenter, text)

    def _row(
        self, painter: QPainter, box: QRect, file: ParameterFile, check: MotionCheck, *, is_chosen: bool
    ) -> None:
        mark, tint = MARKS[check.verdict]
        painter.fillRect(box, colour("selbg" if is_chosen else "panel"))
        if is_chosen:
            painter.fillRect(QRect(box.left(), box.top(), 3, box.height()), colour("sel"))
        middle = box.top() + (box.height() - SMALL_ICON) // 2
        icon(mark, tint).paint(painter, QRect(box.left() + GAP3, middle, SMALL_ICON, SMALL_ICON))
        inner = box.adjusted(GAP3 + SMALL_ICON + GAP2, 0, -GAP3, 0)
        figure = font("small")
        figure.setWeight(
            figure.Weight.DemiBold if check.verdict in ("bad", "doubtful") else figure.Weight.Normal
        )
        text = figure_of(file, check)
        wide = QFontMetrics(figure).horizontalAdvance(text)
        painter.setFont(figure)
        painter.setPen(colour(tint if tint != "text" else "dim"))
        painter.drawText(inner, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, text)
        room = inner.adjusted(0, 0, -wide - GAP2, 0)
        if check.use is not None and box.width() >= _WITH_BARS:
            place = QRect(box.right() - GAP3 - _FIGURES - _BAR - GAP2, box.top(), _BAR, box.height())
            # Bars are below each other; only a figure that is wider than its column moves its own bar.
            place.moveRight(min(place.right(), room.right()))
            self._bar(painter, place, check.use.share, tint)
            room.setRight(place.left() - GAP2)
        plain = font("text")
        painter.setFont(plain)
        painter.setPen(colour("dim" if check.verdict == "not possible" else "text"))
        measure, name = QFontMetrics(plain), _name_of_check(check)
        painter.drawText(
            room,
            Qt.AlignmentFlag.AlignVCenter,
            # In the middle: the scenario at its begin and the axis at its end are both needed.
            measure.elidedText(name, Qt.TextElideMode.ElideMiddle, room.width()),
        )
        if check.verdict == "not possible":
            self._reason(painter, room.adjusted(measure.horizontalAdvance(name) + GAP2, 0, 0, 0), file, check)

    def _reason(self, painter: QPainter, room: QRect, file: ParameterFile, check: MotionCheck) -> None:
        """Write why a check is not possible, as far as there is room; the head of the page has all of it."""
        small = font("caption")
        painter.setFont(small)
        text = QFontMetrics(small).elidedText(
            sentenced_with_letters(file, check.why), Qt.TextElideMode.ElideRight, room.width()
        )
        # Less is an ellipsis with a letter.
        if len(text) > 2:
            painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, text)
        painter.setPen(QPen(colour("line2"), 1, Qt.PenStyle.DashLine))
        level = room.bottom() - GAP // 2
        painter.drawLine(QPointF(room.left(), level), QPointF(room.right(), level))

    def _bar(self, painter: QPainter, box: QRect, share: float, tint: Token) -> None:
        painter.setPen(Qt.PenStyle.NoPen)
        line = QRectF(box.left(), box.center().y() - 1.0, box.width(), 4.0)
        painter.setBrush(colour("line"))
        painter.drawRoundedRect(line, 2.0, 2.0)
        painter.setBrush(QColor(colour(tint)))
        part = min(max(share, 0.0), 1.0)
        # Two points at least: a share of nearly 0 is not the same as none.
        painter.drawRoundedRect(QRectF(line.left(), line.top(), max(part * line.width(), 2.0), 4.0), 2.0, 2.0)


_FIGURES = 72
"""Room for a figure behind the bars, which keeps them under one another."""


class MachineCheckList(QListView):
    """The list; arrow keys go over heads."""

    def __init__(self, rows: CheckRows, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setModel(rows)
        self.setItemDelegate(_CheckDelegate(self))
        self.setFrameShape(QListView.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setUniformItemSizes(True)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setMouseTracking(True)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Leave digits to the page: they choose an axis."""
        if event.text().isdigit():
            event.ignore()
        else:
            super().keyPressEvent(event)


def counts_of(checks: Sequence[MotionCheck]) -> dict[str, int]:
    """Return how many checks each verdict has, in the order of the list."""
    return {verdict: sum(check.verdict == verdict for check in checks) for verdict in MARKS}
