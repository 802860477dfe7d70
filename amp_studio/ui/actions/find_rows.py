"""What the find box shows below itself: heads, and under each what was found, painted on one line."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from PySide6.QtCore import QAbstractListModel, QModelIndex, QPersistentModelIndex, QRect, QSize, Qt
from PySide6.QtGui import QAction, QFontMetrics, QKeySequence, QPainter
from PySide6.QtWidgets import QStyle, QStyledItemDelegate, QStyleOptionViewItem

from amp_studio.find import Hit, HitKind
from amp_studio.schema import load_schema
from amp_studio.ui.base.theme import FINDING_ROW, GAP, GAP2, ROW, SMALL_ICON, colour, font, paint_icon
from amp_studio.ui.base.translated import control_message, tr, worded

_ICONS: dict[HitKind, str] = {
    "parameter": "hash",
    "value": "equals",
    "choice": "list-bullets",
    "message": "warning-circle",
    "group": "tree-structure",
    "command": "terminal-window",
    "note": "note-pencil",
}
_MAX_HITS: dict[HitKind, int] = {
    "parameter": 8,
    "value": 6,
    "choice": 5,
    "message": 6,
    "command": 6,
    "group": 3,
    "note": 4,
}
"""Rows of each kind, so that none buries the others."""
_BEST = 3
"""Hits that come first, of whatever kind."""
_PLAIN = frozenset({"number", "name", "code", "text", "choice", "value", "note", "id", "group"})
"""Reasons that the row itself shows."""
_TYPED, _PAGE = re.compile("'(.+)' as '(.+)'"), re.compile(r"\bpage \S+$")


class FindRow(NamedTuple):
    """One line: the head of a kind, something that was found, or a text."""

    text: str
    detail: str = ""
    right: str = ""
    icon: str = ""
    hit: Hit | None = None
    action: QAction | None = None
    instead: str = ""
    """The question that Enter puts in place of the present one."""
    every: tuple[str, ...] = ()
    """Ids of all parameters that were found, to be shown in the table."""
    family: str = ""
    """The other family that has it."""
    waits: bool = False
    """Whether the question is asked again soon: its words are still being read."""

    @property
    def is_head(self) -> bool:
        """Whether nothing can be done with it."""
        return self.hit is None and self.action is None and not self.instead and not self.every


def _head(kind: HitKind) -> str:
    return {
        "parameter": tr("Parameters"),
        "value": tr("Values"),
        "choice": tr("Choices"),
        "message": tr("Messages of the control"),
        "group": tr("Groups"),
        "command": tr("Commands"),
        "note": tr("Notes"),
    }[kind]


def rows_of(hits: Sequence[Hit], actions: dict[str, QAction], family: str = "") -> list[FindRow]:
    """Return the hits under heads: the best ones first where they are of several kinds, then the kind of the
    best hit, and in each the best first; titles of messages of a family are in the language of the window.
    """

    def one(hit: Hit) -> FindRow:
        return _row(hit, actions.get(hit.key) if hit.kind == "command" else None, family)

    rows: list[FindRow] = []
    if (
        len({hit.kind for hit in hits[:_BEST]}) > 1
    ):  # else the second best were below everything of the kind of the best
        rows = [FindRow(tr("Best")), *(one(hit) for hit in hits[:_BEST])]
        hits = hits[_BEST:]
    kinds: dict[HitKind, list[Hit]] = {}
    for hit in hits:
        kinds.setdefault(hit.kind, []).append(hit)
    for kind, found in kinds.items():
        rows.append(FindRow(_head(kind)))
        # Of a single kind all: there is no other that could be buried.
        listed = found[: _MAX_HITS[kind]] if len(kinds) > 1 else found
        rows += map(one, listed)
    return rows


def _row(hit: Hit, action: QAction | None, family: str) -> FindRow:
    if action is not None:
        mark = "✓ " if action.isCheckable() and action.isChecked() else ""
        # As the keyboard of the system has them, not as Qt writes them.
        keys = action.shortcut().toString(QKeySequence.SequenceFormat.NativeText)
        return FindRow(mark + hit.title, "", keys, _ICONS["command"], hit, action)
    reasons = [_in_words(reason) for reason in hit.why.split(", ") if reason not in _PLAIN]
    detail = _PAGE.sub(lambda found: worded(found[0]), hit.detail)
    return FindRow(title_in_words(hit, family), detail, ", ".join(reasons), _ICONS[hit.kind], hit)


def title_in_words(hit: Hit, family: str) -> str:
    """Return what was found in the language of the window; names of parameters stay."""
    if hit.kind != "message":
        return hit.title
    # Without a file the key has the family before it.
    own, _, message = hit.key.rpartition(":")
    return control_message(load_schema(own or family).messages[message], own or family)


def _in_words(reason: str) -> str:
    """Return why something was found in the language of the window; what was found stays as it is."""
    if match := _TYPED.fullmatch(reason):
        return tr("'{typed}' as '{found}'").format(typed=match[1], found=match[2])
    head, colon, rest = reason.partition(": ")
    return f"{worded(head)}{colon}{rest}"


class FindRows(QAbstractListModel):
    """The rows of the list; heads cannot be chosen."""

    def __init__(self) -> None:
        super().__init__()
        self.rows: list[FindRow] = []

    def show_rows(self, rows: Iterable[FindRow]) -> None:
        """Show other rows."""
        self.beginResetModel()
        self.rows = list(rows)
        self.endResetModel()

    def rowCount(self, parent: QModelIndex | QPersistentModelIndex = QModelIndex()) -> int:  # noqa: B008  # as Qt has it
        return 0 if parent.isValid() else len(self.rows)

    def data(
        self, index: QModelIndex | QPersistentModelIndex, role: int = Qt.ItemDataRole.DisplayRole
    ) -> object:
        # The whole row as one text, which a screen reader reads; the delegate paints its parts.
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole):
            row = self.rows[index.row()]
            return ", ".join(filter(None, (row.text, row.detail, row.right)))
        return None

    def flags(self, index: QModelIndex | QPersistentModelIndex) -> Qt.ItemFlag:
        if self.rows[index.row()].is_head:
            return Qt.ItemFlag.NoItemFlags
        return Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable

    def next_row(self, row: int, step: int) -> int:
        """Return the next row that can be chosen, around the ends for one step; -1 where there is none."""
        able = [n for n, each in enumerate(self.rows) if not each.is_head]
        if not able:
            return -1
        at = able.index(row) if row in able else -1 if step > 0 else 0
        return (
            able[(at + step) % len(able)] if abs(step) == 1 else able[max(0, min(at + step, len(able) - 1))]
        )


class FindDelegate(QStyledItemDelegate):
    """Paints a row: icon, what it is, where it is, and at the right why or the keys."""

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        model = index.model()
        assert isinstance(model, FindRows)
        return QSize(0, ROW if model.rows[index.row()].is_head else FINDING_ROW)

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        model = index.model()
        assert isinstance(model, FindRows)
        row = model.rows[index.row()]
        place: QRect = option.rect
        state: QStyle.StateFlag = option.state
        painter.save()
        if row.is_head:
            self._write(painter, place.adjusted(GAP2 + GAP, 0, -GAP2, 0), row.text, "caption")
            painter.restore()
            return
        if state & QStyle.StateFlag.State_Selected:
            painter.fillRect(place, colour("selbg"))
        inside = place.adjusted(GAP2 + GAP, 0, -GAP2 - GAP, 0)
        paint_icon(
            painter,
            QRect(inside.left(), place.center().y() - SMALL_ICON // 2, SMALL_ICON, SMALL_ICON),
            row.icon,
            colour("dim"),
        )
        inside.setLeft(inside.left() + SMALL_ICON + GAP2)
        if row.right:
            wide = self._wide(row.right, inside.width() // 2)
            self._write(
                painter, inside.adjusted(inside.width() - wide, 0, 0, 0), row.right, "small", right=True
            )
            inside.setRight(inside.right() - wide - GAP2)
        used = self._write(painter, inside, row.text, "text")
        inside.setLeft(inside.left() + used + GAP2)
        if row.detail and inside.width() > 40:
            self._write(painter, inside, row.detail, "small")
        painter.restore()

    @staticmethod
    def _wide(text: str, most: int) -> int:
        return min(QFontMetrics(font("small")).horizontalAdvance(text) + 2, most)

    @staticmethod
    def _write(painter: QPainter, place: QRect, text: str, role: str, right: bool = False) -> int:
        """Write a text, cut at its end where there is no room; return how wide it became."""
        painter.setFont(font(role))  # type: ignore[arg-type]  # one of the roles
        painter.setPen(colour("text" if role == "text" else "dim"))
        cut = painter.fontMetrics().elidedText(text, Qt.TextElideMode.ElideRight, place.width())
        side = Qt.AlignmentFlag.AlignRight if right else Qt.AlignmentFlag.AlignLeft
        painter.drawText(place, side | Qt.AlignmentFlag.AlignVCenter, cut)
        return painter.fontMetrics().horizontalAdvance(cut)
