"""The settings of a simulation: those of the scenario, and the machine that the control does not know."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from PySide6.QtCore import QEvent, QObject, QSize, Qt
from PySide6.QtWidgets import QLineEdit, QScrollArea, QWidget

from amp_studio.schema import dimension, read_number, unit_named, unit_text
from amp_studio.ui.base.translated import sentenced, unit_in_words, worded
from amp_studio.ui.forms.form import Field, FieldForm

MODE = "move.mode"
RAMPS = (
    ("", "as configured"),
    ("linear", "linear ramp"),
    ("exponential", "exponential"),
    ("s-curve", "S-curve"),
    ("sine-squared", "sine squared"),
    ("none", "no ramp"),
)
_LENGTHS = (
    "move.distance",
    "move.radius",
    "move.amplitude",
    "move.start",
    "move.switch",
    "move.switch_length",
    "move.marker",
)
_SCROLL = 16
"""Width in pixels of the bar that scrolls a form."""
FEEDRATE, SECOND = "move.feedrate", "move.second_axis"


class SettingsForm(FieldForm):
    """One field for each setting; an empty field takes the default."""

    def __init__(self, changed: Callable[[], None]) -> None:
        super().__init__()
        self._units = ("mm", "mm/min")
        self.entered.connect(lambda _: changed())

    def offer_settings(
        self,
        settings: Mapping[str, str],
        units: tuple[str, str],
        axes: Iterable[tuple[str, str]] = (),
        family: str = "",
    ) -> None:
        """Show the fields of these settings (name -> what it is) and keep what is in them;
        ``units`` of length and feedrate; the family's own are worded with its facts.
        """
        self._units = units
        choices = {
            MODE: tuple((key, worded(title)) for key, title in RAMPS),
            SECOND: (("", worded("the next one")), *axes),
        }
        self.offer(
            [
                Field(name, _title(name), "choice", "", choices[name], words)
                if name in choices
                else Field(name, _title(name), tip=words, hint=self._hint(name, meaning, words))
                for name, meaning in settings.items()
                for words in [sentenced(meaning, family)]
            ],
            keep=True,
        )

    def _hint(self, name: str, meaning: str, words: str) -> str:
        """Return the unit and what is taken where the field is empty; ``words``: what it is, as the window
        has it.
        """
        unit = self._unit(name)
        if not unit and name not in (*_LENGTHS, FEEDRATE) and " (" in meaning:
            unit = words.partition(" (")[2].partition(")")[0]
        default = words.partition(f"{self.tr('default:')} ")[2] or self.tr("automatic")
        empty = f"{self.tr('empty:')} {default}"
        return f"{unit_in_words(unit)}, {empty}" if unit else empty

    def _unit(self, name: str) -> str:
        return self._units[0] if name in _LENGTHS else self._units[1] if name == FEEDRATE else ""

    def show_defaults(self, defaults: Mapping[str, str]) -> None:
        """Show in the empty fields what is taken now."""
        for name, text in defaults.items():
            field = self.editors.get(name)
            if isinstance(field, QLineEdit):
                empty = self.tr("empty:")
                unit, _, _ = field.placeholderText().rpartition(empty)
                field.setPlaceholderText(f"{unit}{empty} {text}")

    def filled_in(self) -> dict[str, float | str]:
        """Return the settings that are filled in; raises ValueError for a wrong unit or no number."""
        given = {name: text for name, text in self.answers().items() if text}
        return {
            name: _read(name, text, unit) if (unit := self._unit(name)) else text
            for name, text in given.items()
        }


def _read(name: str, text: str, unit: str) -> str:
    """Return a length or feedrate with its unit; a bare number is in the unit of the file."""
    number, rest = read_number(text)
    named = unit_named(rest) if rest else unit
    if dimension(named) != dimension(unit):
        raise ValueError(
            f"Give the {_title(name).lower()} of this axis in {unit_text(unit)}, not in {unit_text(named)}."
        )
    # With all its digits: the text is read again by the simulation.
    return f"{number!r} {named}"


def _title(name: str) -> str:
    words = name.partition(".")[2].replace("_", " ")
    return worded("Ramp" if name == MODE else words[:1].upper() + words[1:])


class _FormArea(QScrollArea):
    """Scrolls a form up and down; it is as wide as the form needs, whatever is offered in it later."""

    def minimumSizeHint(self) -> QSize:
        return QSize(self.widget().minimumSizeHint().width() + _SCROLL, super().minimumSizeHint().height())

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        # Fields that are offered later make the form wider: a scroll area asks its size once only.
        if event.type() == QEvent.Type.LayoutRequest:
            self.updateGeometry()
        return super().eventFilter(watched, event)


def scrolled(form: QWidget) -> QScrollArea:
    """Return a form that can be scrolled."""
    area = _FormArea()
    area.setFrameShape(QScrollArea.Shape.NoFrame)
    area.setWidgetResizable(True)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    area.setWidget(form)
    area.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # the fields in it take the keyboard, and it follows them
    return area
