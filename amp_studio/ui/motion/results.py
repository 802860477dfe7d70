"""The result of a simulation in words: figures, recommendations that can be applied, assumptions."""

from __future__ import annotations

import html
from collections.abc import Callable, Container, Sequence

from PySide6.QtCore import Qt, QUrl
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QTextBrowser,
    QWidget,
)

from amp_studio.schema import Schema
from amp_studio.sim import Recommendation, Trace, value_text
from amp_studio.ui.base.figures import unbroken, written
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.theme import severity_colour, state_colour
from amp_studio.ui.base.translated import sentenced, unit_in_words, worded
from amp_studio.ui.forms.pages import LINK

_PREDICTED, _SWEPT = "predicted_", "swept_"


def name_of(schema: Schema, parameter: str) -> str:
    """Return the name of a parameter, or the id of what is none."""
    found = schema.parameters.get(parameter)
    return found.name if found else parameter


class FiguresPage(QTextBrowser):
    """Alarms and figures; what a figure was predicted or swept as is beside it."""

    def __init__(self, follow: Callable[[QUrl], None]) -> None:
        super().__init__()
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setOpenLinks(False)
        self.anchorClicked.connect(follow)

    def _at(self, time_s: float) -> str:
        return html.escape(self.tr("at {time} s").format(time=written(f"{time_s:.4g}")))

    def show_trace(self, family: str, trace: Trace, before: Trace | None, kind: str = "saved") -> None:
        """Show the figures of a trace of a family, with those of the saved file or of what was ``kept``."""
        shade = severity_colour("error").name()
        alarms = "".join(
            f'<p style="color:{shade}"><b>{html.escape(a.code)}</b> {self._at(a.time_s)}:'
            f" {html.escape(sentenced(a.message, family))}</p>"
            for a in trace.alarms
        )
        warn = severity_colour("warning").name()
        doubts = "".join(
            f'<p style="color:{warn}">{html.escape(sentenced(text, family))}</p>' for text in trace.doubts
        )
        beside = self.tr("kept") if kind == "kept" else self.tr("saved")
        rows = "".join(_rows(trace, before, beside))
        self.setHtml(
            unbroken(f"{alarms}{doubts}<table cellspacing=0 cellpadding=2 width=100%>{rows}</table>")
        )


def _rows(trace: Trace, before: Trace | None, before_name: str) -> list[str]:
    dim = state_colour().name()
    others = [kind for kind in (_PREDICTED, _SWEPT) if any(name.startswith(kind) for name in trace.result)]
    heads = [worded(kind.rstrip("_")) for kind in others] + [before_name] * (before is not None)
    head = "".join(f'<td align=right style="color:{dim}">{words}</td>' for words in heads)
    rows = [f"<tr><td></td><td></td>{head}</tr>"] if heads else []
    for name, (value, unit) in trace.result.items():
        # It is in a column of the figure that it belongs to.
        if _is_beside(name, others, trace.result):
            continue
        cells = [trace.result.get(f"{kind}{name}", (None, ""))[0] for kind in others]
        if before:
            cells.append(before.result.get(name, (None, ""))[0])
        texts = ("" if cell is None else _number(cell) for cell in cells)
        beside = "".join(f'<td align=right style="color:{dim}">{text}</td>' for text in texts)
        words = worded(name.replace("_", " "))
        rows.append(
            f"<tr><td>{words}</td><td"
            f" align=right><b>{_number(value)}</b>&nbsp;{unit_in_words(unit)}</td>{beside}</tr>"
        )
    return rows


def _is_beside(name: str, kinds: Sequence[str], result: Container[str]) -> bool:
    """Return whether a figure is in the row of the one that it predicts or was swept for."""
    return any(name.startswith(kind) and name.removeprefix(kind) in result for kind in kinds)


def _number(value: float | None) -> str:
    return "–" if value is None else written(value_text(value, digits=5))


class RecommendationsPage(QScrollArea):
    """One frame for each recommendation: parameter and value, reason, price, and a button that applies it."""

    def __init__(
        self, apply: Callable[[Sequence[Recommendation]], None], follow: Callable[[QUrl], None]
    ) -> None:
        super().__init__()
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._apply, self._follow = apply, follow
        self.buttons: list[QPushButton] = []

    def show_all(
        self, schema: Schema, found: Sequence[Recommendation], may_apply: Callable[[str], bool]
    ) -> None:
        """Show the recommendations; ``may_apply`` returns whether a parameter can be changed."""
        inside = QWidget()
        column = in_column(on=inside, margins=(4, 8, 4, 8), gap=12)
        self.buttons = []
        for each in found:
            column.addWidget(self._frame(schema, each, may_apply(each.parameter)))
        usable = [each for each in found if may_apply(each.parameter)]
        if len(usable) > 1:
            together = self._button(self.tr("Apply All {count}").format(count=len(usable)), usable)
            column.addWidget(together, alignment=Qt.AlignmentFlag.AlignRight)
        if not found:
            column.addWidget(QLabel(self.tr("No recommendations.")))
        column.addStretch()
        self.setWidget(inside)

    def _frame(self, schema: Schema, each: Recommendation, usable: bool) -> QWidget:
        frame = QWidget()
        # Not higher than its text: with few recommendations they would be spread over the page.
        frame.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Maximum)
        column = in_column(on=frame, margins=0, gap=2)
        head, shade = QHBoxLayout(), severity_colour("advice").name()
        name = html.escape(name_of(schema, each.parameter))
        value = html.escape(written(value_text(each.value, unit_in_words(each.unit), 9)))
        title = QLabel(f'<a href="{LINK}{each.parameter}" style="color:{shade}">{name}</a> = <b>{value}</b>')
        title.setWordWrap(True)
        title.linkActivated.connect(lambda url: self._follow(QUrl(url)))
        head.addWidget(title, 1)
        if usable:
            head.addWidget(self._button(self.tr("Apply"), [each]), alignment=Qt.AlignmentFlag.AlignTop)
        column.addLayout(head)
        family = schema.family.family
        price = self.tr("Price: {price}").format(price=sentenced(each.price, family)) if each.price else ""
        for text in (sentenced(each.why, family), price):
            if text:
                label = QLabel(html.escape(text))
                label.setWordWrap(True)
                label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
                column.addWidget(label)
        return frame

    def _button(self, text: str, found: Sequence[Recommendation]) -> QPushButton:
        button = QPushButton(text)
        # Every frame has a button "Apply": heard alone they would be the same.
        button.setAccessibleName(f"{text}: {', '.join(each.parameter for each in found)}")
        button.clicked.connect(lambda: self._apply(found))
        self.buttons.append(button)
        return button


class AssumptionsPage(QTextBrowser):
    """What is assumed, the figures of the machine first."""

    def __init__(self) -> None:
        super().__init__()
        self.setFrameShape(QFrame.Shape.NoFrame)

    def show_trace(self, family: str, trace: Trace) -> None:
        """Show the assumptions of a trace of a family."""
        ordered = sorted(trace.assumptions, key=lambda text: not text.startswith("ASSUMED"))
        self.setHtml(unbroken("".join(f"<p>{html.escape(sentenced(text, family))}</p>" for text in ordered)))
