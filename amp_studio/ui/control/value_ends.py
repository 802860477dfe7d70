"""What a control has of each value after an exchange that broke off: in words, and how many of each as a bar
of three parts.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QBrush, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from amp_studio.files import Difference
from amp_studio.schema import Address, same_value
from amp_studio.ui.base.theme import GAP3, colour
from amp_studio.ui.base.translated import tr

from .session import ControlSession

EndKind = Literal["new", "open", "old"]
KINDS: tuple[EndKind, ...] = ("new", "open", "old")
BAR, LEAST = 8, 4
"""px: how high the bar is, and how wide a part that has any."""


@dataclass(frozen=True, slots=True)
class ValueEnd:
    """What a control has of one value."""

    kind: EndKind
    text: str


def ends_of(session: ControlSession, sent: Iterable[Difference]) -> dict[Address, ValueEnd]:
    """Return what the control has of each value that was sent, by what was read of it since, else by its
    answers; empty if that is not known, or the head has it for all of them.
    """
    after = session.after_break()
    if after is None:
        return {}
    least, most = after.least, after.most
    ends = {}
    for each in sent:
        address = each.address
        if address not in least:
            ends[address] = ValueEnd("new", tr("new") if after.is_certain else tr("confirmed"))
        elif address not in most:
            ends[address] = ValueEnd("open", tr("not answered"))
        elif not after.is_read and not after.is_certain:
            ends[address] = ValueEnd("old", tr("not sent"))
        elif same_value(least[address], each.b):
            ends[address] = ValueEnd("old", tr("old"))
        else:
            ends[address] = ValueEnd("open", tr("another value"))
    return ends


def counts_in_words(ends: Iterable[ValueEnd]) -> str:
    """Return how many values there are of each end, in the order of the bar."""
    counts = Counter(ends)
    ordered = sorted(counts, key=lambda each: (KINDS.index(each.kind), each.text))
    return ", ".join(f"{counts[each]} {each.text}" for each in ordered)


class EndBar(QWidget):
    """New, not known (hatched) and old, each as wide as its share of the values."""

    def __init__(self) -> None:
        super().__init__()
        self.counts: Mapping[str, int] = {}
        self.setAccessibleName(tr("How much of it is new"))
        self.setFixedHeight(BAR)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.hide()

    def show_ends(self, ends: Iterable[ValueEnd]) -> None:
        """Show how many there are of each kind; hidden without any."""
        ends = list(ends)
        self.counts = Counter(each.kind for each in ends)
        self.setAccessibleDescription(counts_in_words(ends))
        self.setVisible(bool(ends))
        self.update()

    def parts(self) -> dict[str, float]:
        """Return how wide each part is, in logical pixels; a single value among hundreds can be seen."""
        room = self.width() - 2 * GAP3
        present = [kind for kind in KINDS if self.counts.get(kind)]
        rest = room - LEAST * len(present)
        total = sum(self.counts.values())
        return {kind: LEAST + rest * self.counts[kind] / total for kind in present}

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, left = QPainter(self), float(GAP3)
        brushes = {
            "new": QBrush(colour("text")),
            "open": QBrush(colour("warn"), Qt.BrushStyle.BDiagPattern),
            "old": QBrush(colour("line")),
        }
        for kind, width in self.parts().items():
            painter.fillRect(QRectF(left, 0.0, width, float(BAR)), brushes[kind])
            left += width
        painter.end()
