"""The editor of a value in its cell: the result of an expression at the left,
and below it why a value is refused.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QAccessible, QAccessibleEvent, QFontMetrics, QKeyEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QFrame, QGridLayout, QLabel, QLineEdit, QWidget

from amp_studio.ui.base.figures import unbroken
from amp_studio.ui.base.theme import GAP2, SMALL_ICON, colour, font, scheme, severity_icon
from amp_studio.ui.forms.mask_list import MaskList

_WIDEST = 540


class Preview(NamedTuple):
    """What a text comes to while it is typed."""

    result: str = ""
    """The value of an expression; empty for a text that is the value itself."""
    refusal: Refusal | None = None


class Refusal(NamedTuple):
    """Why a text is not taken."""

    problem: str
    allowed: str = ""
    by_rules: str = ""
    """What the rules need of the value."""
    can_force: bool = False
    """Whether it is only out of range."""


class CellEditor(QLineEdit):
    """Edits one value; a refused text stays, with the reason in a frame below that never takes the focus."""

    def __init__(self, parent: QWidget, preview: Callable[[str], Preview]) -> None:
        super().__init__(parent)
        self.setFrame(False)
        self.setFont(font("text"))
        self._preview, self._result, self._is_refused = preview, "", False
        self.keys: tuple[tuple[str, str], ...] = ()
        """Keys that help with a refused text, and what each does."""
        self._frame: RefusalFrame | None = None
        self.is_gone = False
        """Whether its view has given it up: it is still there until the event ends,
        and may still lose the focus."""
        self.bits: MaskList | None = None
        """The bits of a word, below its field."""
        self.textEdited.connect(self._show_preview)

    def _show_preview(self, text: str) -> None:
        found = self._preview(text)
        self._result = found.result
        left = QFontMetrics(font("small")).horizontalAdvance(found.result) + 10 if found.result else 0
        self.setTextMargins(left, 0, 0, 0)
        self.show_refusal(found.refusal)

    def show_refusal(self, refusal: Refusal | None) -> None:
        """Show why the text is refused, or that it is not."""
        self._is_refused = refusal is not None
        if refusal is None:
            if self._frame is not None:
                self._frame.hide()
            if self.bits is not None:
                self.bits.show()
        else:
            view = self.parentWidget().parentWidget()
            assert isinstance(view, QWidget)
            if self._frame is None:
                # On the view, not in the cell: a child of the editor would be cut at its edges.
                self._frame = RefusalFrame(view)
                self.destroyed.connect(self._frame.deleteLater)
            self._frame.fill(refusal, self.keys if refusal.can_force else self.keys[:-1])
            below = QRect(self.mapTo(view, self.rect().topLeft()), self.size())
            self._frame.place_below(below)
            if self.bits is not None:
                self.bits.hide()
            self.setAccessibleDescription(f"{refusal.problem}. {refusal.allowed}")
            # A frame that appears without the focus is not read out by itself.
            QAccessible.updateAccessibility(QAccessibleEvent(self, QAccessible.Event.Alert))
        self.update()

    def attach(
        self, mask: MaskList, word_of: Callable[[str], int | None], text_of: Callable[[int], str]
    ) -> None:
        """Show the bits of the word below; they and the text follow each other."""
        self.bits = mask
        self.destroyed.connect(mask.deleteLater)

        def follow(text: str) -> None:
            word = word_of(text)
            if word is not None:
                mask.show_word(word)

        def take(word: int) -> None:
            self.setText(text_of(word))
            self._show_preview(self.text())

        follow(self.text())
        self.textEdited.connect(follow)
        mask.changed.connect(take)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Up and Down go through the bits of a word, Space checks one."""
        steps = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1}
        if self.bits is not None and event.key() in steps:
            self.bits.go(steps[Qt.Key(event.key())])
        elif self.bits is not None and event.key() == Qt.Key.Key_Space and self.bits.has_current:
            self.bits.toggle_current()
        else:
            super().keyPressEvent(event)

    @property
    def refusal_text(self) -> str:
        """The reason that is shown below; empty where none is."""
        return self._frame.text if self._frame is not None and self._frame.isVisible() else ""

    @property
    def result_text(self) -> str:
        """The result of the expression that is shown at the left."""
        return self._result

    def close_frame(self) -> None:
        """Take the frame and the list away with the editor."""
        if self.bits is not None:
            self.bits.hide()
        if self._frame is not None:
            self._frame.deleteLater()
            self._frame = None

    def paintEvent(self, event: QPaintEvent) -> None:
        super().paintEvent(event)
        painter = QPainter(self)
        painter.setPen(QPen(colour("error" if self._is_refused else "sel"), 2))
        painter.drawRect(self.rect().adjusted(1, 1, -1, -1))
        if self._result:
            painter.setFont(font("small"))
            painter.setPen(colour("error" if self._is_refused else "dim"))
            painter.drawText(self.rect().adjusted(8, 0, 0, 0), Qt.AlignmentFlag.AlignVCenter, self._result)


class RefusalFrame(QFrame):
    """Why a text is refused: the reason, the allowed range, what rules want, and the keys that help."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("refusal")
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        # A click goes to the cell below: the frame must not be in the way of leaving.
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setAutoFillBackground(True)
        layout = QGridLayout(self)
        layout.setContentsMargins(GAP2, GAP2, GAP2 + 4, GAP2)
        layout.setHorizontalSpacing(GAP2)
        layout.setVerticalSpacing(3)
        self._sign = QLabel()
        layout.addWidget(self._sign, 0, 0, Qt.AlignmentFlag.AlignTop)
        self._problem, self._by_rules, self._keys = QLabel(), QLabel(), QLabel()
        for row, (label, role) in enumerate(
            ((self._problem, "text"), (self._by_rules, "small"), (self._keys, "small"))
        ):
            label.setTextFormat(Qt.TextFormat.RichText)
            label.setFont(font("text" if role == "text" else "small"))
            label.setWordWrap(True)
            layout.addWidget(label, row, 1)
        layout.setColumnStretch(1, 1)
        self.text = ""
        self._filled: tuple[Refusal, Sequence[tuple[str, str]]] | None = None
        self._apply_colours()
        scheme().changed.connect(self._apply_colours)

    def _apply_colours(self) -> None:
        """Take the colours of light or dark."""
        self.setStyleSheet(
            f"#refusal {{ background: {colour('raised').name()}; border: 1px solid {colour('error').name()};"
            " border-radius: 4px; } #refusal QLabel { background: transparent; }"
        )
        self._sign.setPixmap(severity_icon("error").pixmap(SMALL_ICON, SMALL_ICON))
        if self._filled is not None:
            self.fill(*self._filled)

    def fill(self, refusal: Refusal, keys: Sequence[tuple[str, str]]) -> None:
        """Show a refusal."""
        self._filled = refusal, keys
        allowed = self.tr("Allowed: {range}").format(range=refusal.allowed) if refusal.allowed else ""
        self.text = "\n".join(filter(None, (refusal.problem, allowed, refusal.by_rules)))
        dim, cap = colour("dim").name(), colour("hover").name()
        caps = "&nbsp;&nbsp; ".join(
            f'<span style="background-color:{cap}">&nbsp;{key}&nbsp;</span> {_html(what)}'
            for key, what in keys
        )
        self._problem.setText(unbroken(f"<b>{_html(refusal.problem)}.</b> {_html(allowed)}"))
        self._by_rules.setText(f'<span style="color:{dim}">{_html(refusal.by_rules)}</span>')
        self._by_rules.setVisible(bool(refusal.by_rules))
        self._keys.setText(f'<span style="color:{dim}">{caps}</span>')
        room = self.parentWidget().width() - 16
        lines = (self._problem, self._by_rules, self._keys)
        for label in lines:
            label.setWordWrap(False)
        widest = max(label.sizeHint().width() for label in lines)
        for label in lines:
            label.setWordWrap(True)
        self.setFixedWidth(min(_WIDEST, room, widest + SMALL_ICON + 4 * GAP2))

    def place_below(self, editor: QRect) -> None:
        """Place it below an editor, or above where there is no room."""
        height = (
            self.layout().totalHeightForWidth(self.width())
            if self.layout().hasHeightForWidth()
            else self.sizeHint().height()
        )
        room = self.parentWidget().rect()
        left = max(4, min(editor.left(), room.width() - self.width() - 4))
        top = editor.bottom() + 4
        if top + height > room.height():
            top = max(4, editor.top() - height - 4)
        self.setGeometry(left, top, self.width(), height)
        self.show()
        self.raise_()


def _html(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;")
