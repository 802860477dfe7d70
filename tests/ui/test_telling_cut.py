"""A name that has no room is cut so that it cannot be taken for another one."""

import pytest
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import QApplication

from amp_studio.schema import family_ids, load_schema
from amp_studio.ui.base.theme import font
from amp_studio.ui.forms.telling_cut import telling_cut


@pytest.fixture
def metrics(qapp: QApplication) -> QFontMetrics:
    return QFontMetrics(font("text"))


def test_what_names_have_in_common_goes_first(metrics: QFontMetrics) -> None:
    """Both were ``Analog S… Voltage`` in a table beside the preview."""
    names = ["Analog Servo Pos. Voltage", "Analog Servo Neg. Voltage"]
    room = metrics.horizontalAdvance("Analog S… Voltage")
    cut = [telling_cut(metrics, name, names, room) for name in names]
    assert [text.partition("…")[2] for text in cut] == ["Pos. Voltage", "Neg. Voltage"]
    assert all(metrics.horizontalAdvance(text) <= room for text in cut)


@pytest.mark.parametrize("family", family_ids())
def test_names_of_a_group_are_different_when_they_are_cut(metrics: QFontMetrics, family: str) -> None:
    groups = [{parameter.name for parameter in group.parameters} for group in load_schema(family).groups]
    room = metrics.horizontalAdvance("m" * 12)
    alike = []
    for names in groups:
        cut = {name: telling_cut(metrics, name, names, room) for name in names}
        assert all(metrics.horizontalAdvance(text) <= room for text in cut.values())
        seen = list(cut.values())
        alike += [(name, text) for name, text in cut.items() if seen.count(text) > 1]
    assert alike == []
