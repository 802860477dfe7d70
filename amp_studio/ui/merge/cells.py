"""The cells of a row of a comparison: the value of every source and of the result, all in one unit."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from amp_studio.files import Merge, Row, in_one_unit
from amp_studio.schema import MASKED, Parameter, Value, labels_of_word, visible
from amp_studio.ui.base.figures import show_value
from amp_studio.ui.base.translated import tr, unit_in_words


class MergeCell(NamedTuple):
    """A value as it is painted: the number or the text, and the unit (of a mask its number) apart."""

    text: str
    unit: str = ""
    typed: str = ""
    """What a person types for it; empty for the text itself."""

    @property
    def whole(self) -> str:
        """The text with its unit."""
        return f"{self.text}{'' if self.unit == '°' or not self.unit else ' '}{self.unit}"


def cells_of(
    merge: Merge, row: Row, values: Sequence[Value | None], *, units: str | None, secrets: bool
) -> list[MergeCell]:
    """Return the cells of the values of one row; ``units`` is a unit system,
    None for the unit of the first value that has one.
    """
    if row.id.part != "value":
        return [MergeCell("–" if value is None else visible(str(value.value))) for value in values]
    parameter = merge.a.schema.parameters[row.address[0]]
    own = next(filter(None, (value.unit for value in values if value is not None)), None)
    if own is not None:
        values = in_one_unit(values, own if units is None else merge.a.evaluation.unit(row.address, units))
    masked = parameter.secret and not secrets
    return [_cell(parameter, value, masked=masked) for value in values]


def _cell(parameter: Parameter, value: Value | None, *, masked: bool) -> MergeCell:
    if value is None:
        return MergeCell(tr("not set"))
    if masked:
        return MergeCell(MASKED)
    if isinstance(value.value, (str, bool)) or not value.unit:
        return _bare_cell(parameter, value)
    bare = show_value(parameter, Value(value.value), secrets=True)
    return MergeCell(bare, unit_in_words(value.unit))


def _bare_cell(parameter: Parameter, value: Value) -> MergeCell:
    """Return how a value without a unit is painted: a mask by the names of its bits,
    a number in groups of digits.
    """
    text = show_value(parameter, value, secrets=True)
    if parameter.bits and isinstance(value.value, int) and value.value >= 0:
        return MergeCell(labels_of_word(parameter, value.value), f"0x{value.value:X}", text)
    return MergeCell(text)
