"""The NUM extractor on pages of an invented manual that has the real one's form,
and what it reports as missed.
"""

import sys
from collections.abc import Callable
from pathlib import Path

import extract_num
import pytest
from manual_facts import Section, read, write_facts

FRONT = (
    "\t4.1\tBarrel Roll\t4 - 2",
    "\t4.2\tLost Barrel\t4 - 4",
    "P4\tBarrels\t0\tRolling barrels\t4-2",
    "P5\tBarrels\t\tOther barrels\tNot documented",
    "## 4.1 Barrel Roll",
    "Category\tBarrels",
    "Type 0\t8-bit hexadecimal",
    "No. of words\t5",
)

Extract = Callable[..., tuple[Section, str]]


@pytest.fixture
def extract(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Extract:
    """Return what gives the section of P4, and stderr, for lines of its text."""

    def run(*body: str) -> tuple[Section, str]:
        manual, facts = tmp_path / "manual.txt", tmp_path / "facts.yaml"
        manual.write_text("\n".join((*FRONT, *body, "")), encoding="utf-8")
        monkeypatch.setattr(sys, "argv", ["extract_num.py", str(manual), "-o", str(facts)])
        assert write_facts(extract_num.__doc__, extract_num.HEAD, extract_num.sections) == 0
        (section,) = (section for section in read(facts) if section.parameter == "P4")
        return section, capsys.readouterr().err

    return run


def message(facts: tuple[object, ...]) -> list[dict[str, object]]:
    """Return facts without their lines and without what is empty."""
    return [{k: v for k, v in vars(fact).items() if v not in {"", "head"} and k != "line"} for fact in facts]


def test_a_section_has_page_line_and_size(extract: Extract) -> None:
    section, faults = extract()
    assert (section.heading, section.page, section.line) == ("Barrel Roll", "4-2", 5)
    assert message(section.sizes) == [{"number": "P4", "words": 5, "type": "0", "category": "Barrels"}]
    assert "no heading 4.2 'Lost Barrel' (page 4-4)" in faults


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("#### Words N0 to N3", [("P4", "N0-N3")]),
        ("Words N0 and N8", [("P4", "N0"), ("P4", "N8")]),
        ("Word N1, Word N3", [("P4", "N1"), ("P4", "N3")]),
        ("six words (N12-N17) of it", [("P4", "N12-N17")]),
        ("Words No to N7", [("P4", "N0-N7")]),
        ("unless P7, word 0, bit 7 equals 0", [("P7", "N0")]),
        ("higher than word N0 of P50", [("P50", "N0")]),
        ("P46-P47: Added words 12-17", [("P46", "N12-N17"), ("P47", "N12-N17")]),
        ("16-bit words. The word number gives the axis.", []),
    ],
)
def test_words_belong_to_the_parameter_named_beside_them(
    extract: Extract, text: str, words: list[tuple[str, str]]
) -> None:
    assert [(fact.number, fact.word) for fact in extract(text)[0].words] == words


@pytest.mark.parametrize(
    ("text", "bits"),
    [
        ("Bits 31-27", ("P4", "N1", "31-27")),
        ("Bits 19 à 16", ("P4", "N1", "19-16")),
        ("Bit\t26\t25\t", ("P4", "N1", "26-25")),
        ("the value of bit 5 of word N2", ("P4", "N2", "5")),
        ("unless P7, word 0, bit 7 equals 0", ("P7", "N0", "7")),
    ],
)
def test_bits_belong_to_a_word(extract: Extract, text: str, bits: tuple[str, str, str]) -> None:
    section, _ = extract("#### Word N1", text)
    assert [(fact.number, fact.word, fact.bits) for fact in section.bits] == [bits]


@pytest.mark.parametrize(
    ("text", "default"),
    [
        (r"The default value is \$FF.", {"value": "$FF", "note": "default"}),
        (r"The basic value is 50  $\mu\text{m}$ .", {"value": "50", "unit": "µm", "note": "basic"}),
        ("Default value forced to zero.", {"value": "0", "note": "default"}),
        ("P51\t6-12 ms\t20 ms (default)", {"value": "20", "unit": "ms", "note": "default"}),
    ],
)
def test_a_default_has_its_word(extract: Extract, text: str, default: dict[str, object]) -> None:
    section, _ = extract("#### Word N1", text)
    assert message(section.defaults) == [{"number": "P4", "word": "N1"} | default]


@pytest.mark.parametrize(
    ("text", "bounds"),
    [
        ("as a percentage between 0 and 100.", ("0", "100", "")),
        (r"is from 400  $\mu\text{s}$  to 1,000  $\mu\text{s}$", ("400", "1000", "µs")),
        ("It cannot be less than 4 ms nor greater than 14 ms.", ("4", "14", "ms")),
        (r"- \$4 to \$B for the lines", ("$4", "$B", "")),
        (r"This number is limited to 64 (\$40).", ("", "64", "")),
    ],
)
def test_bounds_have_their_word(extract: Extract, text: str, bounds: tuple[str, str, str]) -> None:
    section, _ = extract("#### Word N1", text)
    assert [(fact.low, fact.high, fact.unit) for fact in section.ranges] == [bounds]
    assert [fact.applies for fact in section.ranges] == ["P4 N1"]


def test_a_table_of_bits_gives_codes(extract: Extract) -> None:
    section, _ = extract("Bit\t13\t12\t", "\t0\t1\t: 16 $\\mu$ s", "\t1\t0\t500 ns", "0\t1\t1")
    codes = [(fact.letter, fact.text, fact.applies) for fact in section.choices]
    assert codes == [("01", "16 µs", "13-12"), ("10", "500 ns", "13-12")]


def test_a_default_that_is_not_understood_is_reported(extract: Extract) -> None:
    assert (
        "line 9 not read: 'The default value is twice as high.'"
        in extract("The default value is twice as high.")[1]
    )
