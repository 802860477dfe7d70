"""German that a fitter trusts: one word for each act at the control, and a decimal comma where a number is shown."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator

import pytest
from PySide6.QtWidgets import QApplication

from amp_studio.schema import Value
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.translated import FOLDER, speak


@pytest.fixture
def german(qapp: QApplication) -> Iterator[None]:
    speak("de")
    yield
    speak("en")


def translations() -> list[tuple[str, str]]:
    """Return every English text of the window with its German one."""
    found = []
    for message in ET.parse(FOLDER / "amp_studio_de.ts").iter("message"):
        translation = message.find("translation")
        assert translation is not None
        found.append((message.findtext("source") or "", "".join(translation.itertext())))
    return found


def test_loading_is_no_word_for_what_replaces_the_parameters_of_a_control() -> None:
    dangerous = re.compile(r"\b(ge|hoch|herunter)?lade(n|t)?\b|\bHolen\b|Download|Upload", re.IGNORECASE)
    assert [pair for pair in translations() if dangerous.search(re.sub("'.*?'|&", "", pair[1]))] == []


def test_checking_is_what_rules_do_and_comparing_is_done_with_a_control() -> None:
    words = dict(translations())
    assert words["Verify"] == "Vergleichen"
    assert words["&Verify"] == "&Vergleichen"
    assert not [s for s, d in words.items() if "erify" in s and re.search("[Pp]rüf", d.replace("&", ""))]


def test_numbers_are_shown_with_a_comma_and_typed_with_either_sign(german: None, window) -> None:
    address = ("servo.excess_error", "1")
    window.edits.commit(address, "12,7 mm")
    assert window.workspace.file.get(address) == Value(12.7, "mm")
    assert window.table.cell_text(address) == "12,7 mm"
    window.edits.commit(address, "12.8 mm")
    assert window.table.cell_text(address) == "12,8 mm"
    assert window.table.typed_value(address) == "12.8 mm", "editors and the clipboard have a point"
    assert written("10.0.0.21") == "10,0,0,21", "which is why only values go through it"
    assert [button.text() for button in window.tools.units.buttons.values()] == ["mm", "Zoll"]
