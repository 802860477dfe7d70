"""The settings of a simulation: those of the scenario, and the machine that the control does not know."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox, QFormLayout, QLineEdit, QScrollArea, QWidget

from amp_studio.schema import dimension, read_number, shown, unit_named
from amp_studio.ui.base.translated import worded

MODE = "move.mode"
RAMPS = (
    ("", "as configured"),
    ("linear", "linear ramp"),
    ("exponential", "exponential"),
    ("s-curve", "S-curve"),
    ("sine-squared", "sine squared"),
    ("none", "no ramp"),
)
LENGTHS = (
    "move.distance",
    "move.radius",
    "move.amplitude",
    "move.start",
    "move.switch",
    "move.switch_length",
    "move.marker",
)
FEEDRATE, SECOND = "move.feedrate", "move.second_axis"


class SettingsForm(QWidget):
    """One field for each setting; an empty field takes the default."""

    def __init__(self, changed: Callable[[], None]) -> None:
        super().__init__()
        self._changed = changed
        self._units = ("mm", "mm/min")
        self.fields: dict[str, QLineEdit | QComboBox] = {}
        self._layout = QFormLayout(self)
        self._layout.setContentsMargins(0, 0, 0, 0)
        self._layout.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)

    def offer(
        self, settings: Mapping[str, str], units: tuple[str, str], axes: Iterable[tuple[str, str]] = ()
    ) -> None:
        """Show the fields of these settings (name -> what it is) and keep what is in them;
        ``units`` of length and feedrate.
        """
        texts = {name: field.text() for name, field in self.fields.items() if isinstance(field, QLineEdit)}
        chosen = {
            name: field.currentData() for name, field in self.fields.items() if isinstance(field, QComboBox)
        }
        if list(settings) == list(self.fields) and units == self._units and SECOND not in settings:
            return
        while self._layout.rowCount():
            self._layout.removeRow(0)
        self._units, self.fields = units, {}
        for name, meaning in settings.items():
            field = self._choice(name, axes) if name in (MODE, SECOND) else self._line(name, meaning)
            if isinstance(field, QLineEdit):
                field.setText(texts.get(name, ""))
            else:
                field.blockSignals(True)
                field.setCurrentIndex(max(0, field.findData(chosen.get(name, ""))))
                field.blockSignals(False)
            field.setToolTip(meaning)
            field.setAccessibleName(_title(name))
            self._layout.addRow(_title(name), field)
            # In a window that is shown already, a new row has no height before it is shown too.
            for widget in (field, self._layout.labelForField(field)):
                widget.show()
            self.fields[name] = field

    def _line(self, name: str, meaning: str) -> QLineEdit:
        field = QLineEdit()
        unit = self._unit(name)
        default = meaning.partition("default: ")[2] or "automatic"
        unit = unit or ("" if name in (*LENGTHS, FEEDRATE) else meaning.partition(" (")[2].partition(")")[0])
        empty = f"{self.tr('empty:')} {worded(default)}"
        field.setPlaceholderText(f"{shown(unit)}, {empty}" if unit else empty)
        field.returnPressed.connect(self._changed)
        return field

    def _choice(self, name: str, axes: Iterable[tuple[str, str]]) -> QComboBox:
        field = QComboBox()
        choices = RAMPS if name == MODE else (("", "the next one"), *axes)
        for key, title in choices:
            field.addItem(worded(title), key)
        field.currentIndexChanged.connect(lambda _: self._changed())
        return field

    def _unit(self, name: str) -> str:
        return self._units[0] if name in LENGTHS else self._units[1] if name == FEEDRATE else ""

    def show_defaults(self, defaults: Mapping[str, str]) -> None:
        """Show in the empty fields what is taken now."""
        for name, text in defaults.items():
            field = self.fields.get(name)
            if isinstance(field, QLineEdit):
                empty = self.tr("empty:")
                unit, _, _ = field.placeholderText().rpartition(empty)
                field.setPlaceholderText(f"{unit}{empty} {text}")

    def values(self) -> dict[str, float | str]:
        """Return what is given; raises ValueError with one sentence for a wrong unit or no number."""
        found: dict[str, float | str] = {}
        for name, field in self.fields.items():
            if isinstance(field, QComboBox):
                if field.currentData():
                    found[name] = str(field.currentData())
                continue
            if not field.text().strip():
                continue
            unit = self._unit(name)
            found[name] = _read(name, field.text(), unit) if unit else field.text().strip()
        return found


def _read(name: str, text: str, unit: str) -> str:
    """Return a length or feedrate with its unit; a bare number is in the unit of the file."""
    number, rest = read_number(text)
    named = unit_named(rest) if rest else unit
    if dimension(named) != dimension(unit):
        raise ValueError(
            f"Give the {_title(name).lower()} of this axis in {shown(unit)}, not in {shown(named)}."
        )
    return f"{number!r} {named}"


def _title(name: str) -> str:
    words = name.partition(".")[2].replace("_", " ")
    return worded("Ramp" if name == MODE else words[:1].upper() + words[1:])


def scrolled(form: QWidget) -> QScrollArea:
    """Return a form that can be scrolled."""
    area = QScrollArea()
    area.setFrameShape(QScrollArea.Shape.NoFrame)
    area.setWidgetResizable(True)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    area.setWidget(form)
    area.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # the fields in it take the keyboard, and it follows them
    return area


def refill(box: QComboBox, entries: Sequence[tuple[str, str]], wanted: str) -> None:
    """Fill a box without a signal and choose an entry by its key, else the first."""
    box.blockSignals(True)
    box.clear()
    for key, title in entries:
        box.addItem(title, key)
    box.setCurrentIndex(max(box.findData(wanted), 0))
    box.blockSignals(False)
