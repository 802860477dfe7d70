"""Numbers with their units beside words in Hebrew and Arabic, and names in these beside our words."""

from pathlib import Path

import pytest

from amp_studio.schema import isolated, isolated_path


def seen(text: str) -> str:
    """Return a text with the characters for isolation as signs that one sees."""
    return text.translate({0x2066: "<", 0x2068: "[", 0x2069: ">"})


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("-3.5 mm and ä", "-3.5 mm and ä"),
        ("סטייה -3.5 mm בציר X", "[סטייה <-3.5 mm> בציר X>"),
        ("ملاحظة: 12,5 µm", "[ملاحظة: <12,5 µm>>"),
        ("קצב 10\u202f000 mm/min", "[קצב <10\u202f000 mm/min>>"),
        ("ב-3.5 mm", "[ב-<3.5 mm>>"),  # the hyphen is that of the word: at 3.5 mm
        ("-1 mm\nציר -2 mm", "-1 mm\n[ציר <-2 mm>>"),
    ],
)
def test_a_number_keeps_its_sign_and_its_unit(text: str, expected: str) -> None:
    assert seen(isolated(text)) == expected


def test_each_name_of_a_path_is_for_itself() -> None:
    assert seen(isolated_path(Path("/hall/קו 4/כרסומת.amp"))) == "/hall/[קו <4>>/[כרסומת.amp>"
