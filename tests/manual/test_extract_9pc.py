"""The extractor on pages of an invented manual that has the real one's form: every kind of table,
and what it misses.
"""

import sys
from collections.abc import Callable
from pathlib import Path

import extract_9pc
import pytest
from manual_facts import PrintedChoice, PrintedNumber, PrintedRange, Section, StoredRow, read, write_facts

CONTENTS = [
    ("Chapter Overview", "5-1"),
    ("Barrel Roll", "5-2"),
    ("Function", "5-2"),
    ("Secondary Barrel Word", "5-3"),
    ("Patch AMP Values", "37-3"),
    ("The last page", "B-3"),
]

Extract = Callable[..., tuple[dict[str, Section], str]]


@pytest.fixture
def extract(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Extract:
    """Return what gives sections by heading, and stderr, for the text of a manual."""

    def run(*body: str) -> tuple[dict[str, Section], str]:
        contents = [f"{title}\t{page}" for title, page in CONTENTS]
        text = "\n".join((*contents, "", "Chapter Overview", "", *body, "", "The last page", ""))
        manual, facts = tmp_path / "manual.txt", tmp_path / "facts.yaml"
        manual.write_text(text, encoding="utf-8")
        monkeypatch.setattr(sys, "argv", ["extract_9pc.py", str(manual), "-o", str(facts)])
        assert write_facts(extract_9pc.__doc__, extract_9pc.HEAD, extract_9pc.sections) == 0
        return {section.heading: section for section in read(facts)}, capsys.readouterr().err

    return run


def roll(*body: str) -> tuple[str, ...]:
    """Return a section with a separate heading."""
    return ("Barrel Roll**Function**", "", *body, "", "Secondary Barrel Word", "", "Patch AMP Values", "")


def numbers(section: Section) -> list[dict[str, str]]:
    """Return the numbers of a section without their lines and without what is empty."""
    return [{k: v for k, v in vars(n).items() if v and k != "line"} for n in section.numbers]


def test_a_number_has_its_section_page_and_line(extract: Extract) -> None:
    found, faults = extract(*roll("Axis\tParameter Number", "(1)\t[7001]", "(2)\t[7002]"))
    section = found["Barrel Roll"]
    assert (section.page, section.chapter, section.line) == ("5-2", "5", 10)
    assert section.numbers == (
        PrintedNumber(line=13, number="7001", axis="1"),
        PrintedNumber(line=14, number="7002", axis="2"),
    )
    assert faults.split() == []


@pytest.mark.parametrize(
    ("table", "expected"),
    [
        pytest.param(
            ["Axis\tParameter Number\t\t", "\tSingle Process\tProcess 1\tProcess 2", "All\t[7]\t[8]\t[9]"],
            [
                {"number": "7", "axis": "All", "process": "single process"},
                {"number": "8", "axis": "All", "process": "process 1"},
                {"number": "9", "axis": "All", "process": "process 2"},
            ],
            id="processes",
        ),
        pytest.param(
            [
                "Axis\tParameter Number\t",
                "\tMill\tLathe",
                "All\t7 (single process) [8] (process 1)\t—",
                "(1)\t\t[17]",
            ],
            [
                {"number": "7", "axis": "All", "machine": "mill", "process": "single process"},
                {"number": "8", "axis": "All", "machine": "mill", "process": "process 1"},
                {"number": "17", "axis": "1", "machine": "lathe"},
            ],
            id="mill and lathe",
        ),
        pytest.param(
            [
                "Spindle\tParameter\tParameter Number\tSpindle\tParameter\tParameter Number",
                "1\tLeast\t[70]\t1\tMost\t[80]",
                "\tLeast - Gear 2\t[71]\t\tMost - Gear 2\t[81]",
            ],
            [
                {"number": "70", "spindle": "1", "name": "Least"},
                {"number": "80", "spindle": "1", "name": "Most"},
                {"number": "71", "spindle": "1", "name": "Least - Gear 2"},
                {"number": "81", "spindle": "1", "name": "Most - Gear 2"},
            ],
            id="two tables side by side, the spindle printed once",
        ),
        pytest.param(
            ["Axis\tNumber\tControl Type", "All\t[52]\tMill", "\t[56]\tLathe"],
            [
                {"number": "52", "axis": "All", "machine": "mill"},
                {"number": "56", "axis": "All", "machine": "lathe"},
            ],
            id="control type",
        ),
        pytest.param(
            ["Deskew\tAxis\tParameter Number", "\t\tSingle Process", "Set 1\tAll\t[66]"],
            [{"number": "66", "axis": "All", "pair": "Set 1", "process": "single process"}],
            id="pairs",
        ),
        pytest.param(
            ["Axis\tParameter Number\tParameter Name", "All\t[33]\tRoll Buffer"],
            [{"number": "33", "axis": "All", "name": "Roll Buffer"}],
            id="name behind the number",
        ),
        pytest.param(["**Parameter", "Number**", "", "[86]"], [{"number": "86"}], id="alone"),
        pytest.param(["Parameter Number", "62"], [{"number": "62"}], id="alone and without brackets"),
    ],
)
def test_every_form_of_number_table_is_read(
    extract: Extract, table: list[str], expected: list[dict[str, str]]
) -> None:
    found, faults = extract(*roll(*table))
    assert [{"place": "table"} | number for number in expected] == numbers(found["Barrel Roll"])
    assert faults.split() == []


def test_a_number_that_is_only_mentioned_is_distinguished_from_one_in_a_table(extract: Extract) -> None:
    found, _ = extract(*roll("You can also use [77] through [80] for this.", "# 86\tTurns it on for [85]."))
    assert [(n.number, n.place) for n in found["Barrel Roll"].numbers] == [
        ("77", "mention"),
        ("80", "mention"),
        ("86", "mention"),
    ]


def test_a_screen_gives_its_number_and_its_choices(extract: Extract) -> None:
    found, _ = extract(*roll("Roll Type : 360\t", "left\t<a>", "right\t", "none\t(c)"))
    section = found["Barrel Roll"]
    assert numbers(section) == [{"number": "360", "place": "screen", "name": "Roll Type"}]
    assert [(c.letter, c.text) for c in section.choices] == [("a", "left"), ("", "right"), ("c", "none")]


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("-9.50000 to 20,000.50000 mm", [("-9.50000", "20000.50000", "mm", "")]),
        (".0060 to +10.0 volts dc", [("0.0060", "10.0", "volts dc", "")]),
        (
            "0 to 2.5 mm or 0 to 0.1 in. (straight axes)",
            [("0", "2.5", "mm", "straight axes"), ("0", "0.1", "in.", "straight axes")],
        ),
        ("0.0 to 3.0 in./76.2 mm", [("0.0", "3.0", "in.", ""), ("0.0", "76.2", "mm", "")]),
        (
            "0.1 mm or .2 degree to Next Roll value",
            [("0.1", "Next Roll value", "mm", ""), ("0.2", "Next Roll value", "degree", "")],
        ),
        (
            "First Roll to 5 mm or degrees",
            [("First Roll", "5", "mm", ""), ("First Roll", "5", "degrees", "")],
        ),
        ("First Roll to Third Roll value", [("First Roll", "Third Roll value", "", "")]),
        ("0.5 mmpm to 7.5 mmpm", [("0.5", "7.5", "mmpm", "")]),
        ("0 to 60,000 feedback counts", [("0", "60000", "", "feedback counts")]),
        ("0 to 1.0 mm, or", [("0", "1.0", "mm", "")]),
        ("The range of this parameter reaches from 0 to 5 mm.", []),
        ("or", []),
    ],
)
def test_every_form_of_range_is_read(
    extract: Extract, line: str, expected: list[tuple[str, str, str, str]]
) -> None:
    found, faults = extract(
        *roll("Parameter Number", "62", "", "Range", "", line, "", "Notes", "", "1 to 9 rpm")
    )
    assert expected == [(r.low, r.high, r.unit, r.note) for r in found["Barrel Roll"].ranges]
    assert ("not read" in faults) == (line.startswith("The range")), "what looks like a range is told"


def test_a_range_shows_for_what_it_is_printed(extract: Extract) -> None:
    found, _ = extract(
        *roll("Range", "Least Roll:\t0 to Most Roll (RPM)", "Range for rack parameters:", "1 to 9")
    )
    assert found["Barrel Roll"].ranges == (
        PrintedRange(line=13, low="0", high="Most Roll", unit="RPM", applies="Least Roll"),
        PrintedRange(line=15, low="1", high="9", applies="rack parameters"),
    )


def test_choices_are_read_from_several_columns(extract: Extract) -> None:
    found, _ = extract(
        *roll("Range", "Selection\tResult\tSelection\tResult", "(a)\tA\t(c)\t\\$B", "(b) B\tsays more")
    )
    assert found["Barrel Roll"].choices == (
        PrintedChoice(line=14, letter="a", text="A"),
        PrintedChoice(line=15, letter="b", text="B"),
        PrintedChoice(line=14, letter="c", text="$B"),
    )


def test_a_heading_may_be_broken_and_a_list_of_titles_is_none(extract: Extract) -> None:
    found, faults = extract(
        "- Barrel Roll",
        "- Secondary Barrel Word",
        "",
        "Barrel Roll",
        "",
        "Parameter Number",
        "1",
        "",
        "**Secondary Barrel",
        "Word****Function**",
        "",
        "Parameter Number",
        "2",
        "",
        "Patch AMP Values",
        "",
    )
    assert {heading: section.numbers[0].number for heading, section in found.items()} == {
        "Barrel Roll": "1",
        "Secondary Barrel Word": "2",
    }
    assert faults.split() == []


def test_the_patch_table_gives_bounds_or_codes(extract: Extract) -> None:
    found, _ = extract(
        *roll()[:-2],
        "Patch AMP Values",
        "",
        "Parameter\tParameter Name\tDefault Value\tPatch AMP Value",
        "21 ^L\tRoll\t0.50000 mm\t-1.00000 to 9,999.90000 mm",
        "1012 2012\tRoll Type\tTwo\t-1 - Minus 14 - 1394 - AM03 (2 kW module) 15- Two",
    )
    assert found["Patch AMP Values"].stored == (
        StoredRow(
            line=18,
            numbers=("21",),
            name="Roll",
            default="0.50000 mm",
            low="-1.00000",
            high="9999.90000",
            unit="mm",
            machine="lathe",
        ),
        StoredRow(
            line=19,
            numbers=("1012", "2012"),
            name="Roll Type",
            default="Two",
            codes={"-1": "Minus", "14": "1394 - AM03 (2 kW module)", "15": "Two"},
        ),
    )


def test_what_is_overlooked_is_reported(extract: Extract) -> None:
    _, faults = extract(
        "Barrel Roll",
        "",
        "Range",
        "0 to 1",
        "",
        "Range",
        "0 to 2",
        "",
        "Loop [1]\tA\tlinear",
        "",
        "Patch AMP Values",
    )
    assert "no heading 'Secondary Barrel Word' (page 5-3)" in faults
    assert "more than one range under 'Barrel Roll'" in faults
    assert "line 18 not read: 'Loop [1]\\tA\\tlinear'" in faults


def test_no_sentence_of_the_manual_is_in_the_facts(extract: Extract) -> None:
    long = "so long that it is no label any more but the sentence of somebody who explains"
    found, _ = extract(*roll("Range", "Selection\tResult", f"(a)\t{long}", f"1 to 9 {long}."))
    section = found["Barrel Roll"]
    assert section.choices[0].text == long[:60].rstrip()
    assert section.ranges[0].note == ""
