"""What a control must be before it is written to, in one line: connected, the same machine, in E-stop,
with its password.
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime

from PySide6.QtGui import QFontMetrics, QResizeEvent
from PySide6.QtWidgets import QLabel, QWidget

from amp_studio.files import ParameterFile
from amp_studio.ui.base.layout import in_row
from amp_studio.ui.base.theme import GAP, GAP2, GAP3, GAP4, SMALL_ICON, FontRole, Token, colour, font, icon
from amp_studio.ui.base.translated import tr, worded

from .session import ControlSession


@dataclass(frozen=True, slots=True)
class ControlCondition:
    """One of them: ``met`` is None while it was not asked yet."""

    text: str
    met: bool | None
    detail: str = ""


def conditions_of(session: ControlSession | None, file: ParameterFile) -> list[ControlCondition]:
    """Return the conditions in their fixed order."""
    seen = session.seen if session else None
    # What was asked before the line was lost is no longer known.
    if session is None or seen is None or session.error:
        return _not_connected(session)
    conditions = [
        ControlCondition(tr("Connected"), True, worded(seen.control.revision)),
        _same_machine(session, file),
        _estop(session),
        ControlCondition(tr("Password accepted") if session.has_password else tr("No password needed"), True),
    ]
    if seen.abilities.lasting_states:
        conditions.append(
            ControlCondition(
                tr("A write lasts in {states}").format(
                    states=", ".join(map(worded, seen.abilities.lasting_states))
                ),
                True,
            )
        )
    return conditions


def _not_connected(session: ControlSession | None) -> list[ControlCondition]:
    """Return the conditions of a control that has not answered, or does not any more."""
    waits = [ControlCondition(text, None) for text in (tr("Same machine"), tr("E-stop"), tr("Password"))]
    if session is not None and session.lacks_password:
        needs = ControlCondition(tr("Needs a password"), False)
        return [ControlCondition(tr("Connected"), None), *waits[:2], needs]
    # After an exchange that broke off it may be connected: nothing has asked since.
    if session is not None and session.phase == "failed":
        return [ControlCondition(tr("Connected"), None), *waits]
    is_lost = session is not None and session.error
    return [ControlCondition(tr("Not connected"), False if is_lost else None), *waits]


def _estop(session: ControlSession) -> ControlCondition:
    if session.in_estop is None:
        return ControlCondition(tr("No E-stop needed"), True)
    text = tr("E-stop is pressed") if session.in_estop else tr("E-stop is not pressed")
    return ControlCondition(text, session.in_estop, _age(session.asked_at))


def _same_machine(session: ControlSession, file: ParameterFile) -> ControlCondition:
    seen, signature = session.seen, file.schema.signature
    assert seen is not None
    # Some controls do not name their family: then what they answer must do.
    if seen.control.family and seen.control.family != file.schema.family.family:
        return ControlCondition(tr("Another family: {name}").format(name=seen.control.family), False)
    # By another schema a number can mean another parameter. A driver that maps them sends by the numbers of
    # the control's own.
    theirs = seen.control.signature
    if theirs and theirs != signature and not seen.abilities.maps_numbers:
        return ControlCondition(tr("Numbers its parameters by another schema"), False, theirs[:9])
    return ControlCondition(tr("Same machine"), True, signature[:9])


def _age(when: datetime | None) -> str:
    if when is None:
        return ""
    seconds = max(0, round((datetime.now(UTC).astimezone() - when).total_seconds()))
    return tr("asked {seconds} s ago").format(seconds=seconds) if seconds else tr("asked now")


class ConditionLine(QWidget):
    """A check in ink where one is met, a circle where it was not asked, amber with words where it is
    missing.
    """

    def __init__(self) -> None:
        super().__init__()
        self.setFixedHeight(34)
        self.setAccessibleName(self.tr("Conditions"))
        self._row = in_row(1, on=self, margins=(GAP3, 0, GAP3, 0), gap=GAP2)
        self._made: list[tuple[QLabel, QLabel]] = []
        self._conditions: list[ControlCondition] = []

    def show_conditions(self, conditions: list[ControlCondition]) -> None:
        """Show them; nothing else of the page moves."""
        while len(self._made) < len(conditions):
            mark, text = QLabel(), QLabel()
            text.setFont(font("text"))
            text.setContentsMargins(0, 0, GAP4, 0)
            for widget in (mark, text):
                self._row.insertWidget(self._row.count() - 1, widget)
            self._made.append((mark, text))
        self._conditions = conditions
        self._write()
        self.setAccessibleDescription(", ".join(f"{c.text} {c.detail}".strip() for c in conditions))

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._write()

    def _write(self) -> None:
        """Show each with its details, or without them where they do not all have the room, or smaller."""
        conditions = self._conditions
        has_room = self._needed([f"{c.text} {c.detail}" for c in conditions], "text", GAP4) <= self.width()
        is_small = not has_room and self._needed([c.text for c in conditions], "text", 0) > self.width()
        self._row.setSpacing(GAP if is_small else GAP2)
        for n, (mark, text) in enumerate(self._made):
            text.setContentsMargins(0, 0, GAP4 if has_room else 0, 0)
            text.setFont(font("small" if is_small else "text"))
            is_there = n < len(conditions)
            mark.setVisible(is_there)
            text.setVisible(is_there)
            if is_there:
                _show(mark, text, conditions[n], has_detail=has_room)

    @staticmethod
    def _needed(texts: list[str], letters: FontRole, aside: int) -> int:
        """Return the width of texts with their marks, each with ``aside`` pixels after it."""
        words = QFontMetrics(font(letters)).horizontalAdvance(" ".join(texts))
        return words + len(texts) * (SMALL_ICON + 2 * GAP2 + aside) + 2 * GAP3


def _show(mark: QLabel, text: QLabel, condition: ControlCondition, *, has_detail: bool) -> None:
    looks: dict[bool | None, tuple[str, Token]] = {
        True: ("check", "text"),
        None: ("circle", "dim"),
        False: ("warning-fill", "warn"),
    }
    name, colour_name = looks[condition.met]
    mark.setPixmap(icon(name, colour_name).pixmap(SMALL_ICON, SMALL_ICON))
    dim = colour("dim").name()
    text.setText(
        f'<span style="color:{colour(colour_name).name()}">{condition.text}</span>'
        + (f' <span style="color:{dim}">{condition.detail}</span>' if has_detail else "")
    )
    text.setToolTip(f"{condition.text} {condition.detail}".strip())
