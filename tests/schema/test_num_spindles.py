"""NUM spindles, miscellaneous and communication words: chapters 8 to 10,
and the order of integration of chapter 3.
"""

import re

import pytest

from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import InvalidValueError, Schema, Value, fault, load_schema, read_value, write_value
from amp_studio.schema.model import Guide

WORDS = {
    "P6": 9,
    "P40": 4,
    "P41": 4,
    "P42": 4,
    "P43": 4,
    "P44": 4,
    "P45": 4,
    "P46": 18,
    "P47": 18,
    "P48": 18,
    "P49": 18,
    "P62": 8,
    "P63": 24,
    "P7": 2,
    "P35": 32,
    "P50": 2,
    "P51": 2,
    "P58": 3,
    "P59": 4,
    "P67": 24,
    "P80": 2,
    "P95": 3,
    "P96": 1,
    "P98": 1,
    "P99": 3,
    "P114": 3,
    "P37": 9,
    "P38": 40,
    "P39": 3,
    "P84": 1,
    "P100": 8,
    "P110": 8,
    "P111": 10,
    "P112": 3,
}
"""Number of words of each parameter, as its section heads it; P44 and P45 by the data tables of page 8-3."""

TYPES = {
    "P6": 0,
    "P7": 0,
    "P35": 5,
    "P37": 0,
    "P38": 6,
    "P39": 4,
    "P40": 4,
    "P41": 0,
    "P42": 4,
    "P43": 5,
    "P44": 5,
    "P45": 5,
    "P46": 5,
    "P47": 5,
    "P48": 5,
    "P49": 5,
    "P50": 5,
    "P51": 5,
    "P58": 5,
    "P59": 0,
    "P62": 1,
    "P63": 1,
    "P67": 5,
    "P80": 0,
    "P84": 5,
    "P95": 5,
    "P96": 8,
    "P98": 0,
    "P99": 5,
    "P100": 0,
    "P110": 0,
    "P111": 0,
    "P112": 0,
    "P114": 5,
}
"""Word type of each parameter (pages 2-2 to 2-4)."""


@pytest.fixture(scope="module")
def num() -> Schema:
    return load_schema("num")


@pytest.fixture(scope="module")
def file() -> ParameterFile:
    return new_file("num")


@pytest.mark.parametrize("number", WORDS)
def test_a_parameter_has_all_its_words_and_each_once(num: Schema, number: str) -> None:
    found = [
        n for a in num.on("cnc").addresses if (n := num.on("cnc").number(a)) and n.startswith(f"{number}N")
    ]
    assert sorted(found, key=lambda n: int(n.partition("N")[2])) == [
        f"{number}N{k}" for k in range(WORDS[number])
    ]


@pytest.mark.parametrize("number", TYPES)
def test_every_word_is_of_the_printed_type(num: Schema, file: ParameterFile, number: str) -> None:
    bits = {0: 8, 1: 16, 4: 32, 5: 16, 6: 32, 8: None}
    for k in range(WORDS[number]):
        storage = num.parameter(file.find(f"{number}N{k}")[0]).storage
        assert (storage.code, storage.bits) == (TYPES[number], bits[TYPES[number]]), k
        assert storage.signed == (TYPES[number] in (1, 8)), k


@pytest.mark.parametrize(
    ("number", "name"),
    [
        pytest.param("P6N4", "spindle.type@4", id="8-10"),
        pytest.param("P6N5", "spindle.group@1", id="8-11"),
        pytest.param("P46N0", "spindle.range_min@1.40", id="8-16 min of M40"),
        pytest.param("P46N11", "spindle.range_max@1.45", id="8-16 max of M45"),
        pytest.param("P49N12", "spindle.limit_speed@4.40", id="8-22 limit of M40"),
        pytest.param("P47N17", "spindle.limit_speed@2.45", id="8-18 limit of M45"),
        pytest.param("P62N5", "spindle.hole_bottom_reference@3", id="8-32"),
        pytest.param(
            "P63N23", "spindle.zero_crossing_anticipation@8", id="8-34 24 words, erratum e-p63-words"
        ),
        pytest.param("P35N31", "misc.m_subroutine@16", id="9-8"),
        pytest.param("P95N1", "misc.memory_area@2", id="9-22"),
        pytest.param("P37N8", "comm.dnc1_character@GS", id="10-2"),
        pytest.param("P38N19", "comm.computer_sequence@10", id="10-4"),
        pytest.param("P38N20", "comm.computer_code@1", id="10-4"),
        pytest.param("P100N7", "comm.way_destination@channel", id="10-10"),
        pytest.param("P111N5", "comm.slave_destination@network", id="10-16"),
    ],
)
def test_a_word_belongs_to(file: ParameterFile, number: str, name: str) -> None:
    assert file.find(number) == file.find(name)


def test_a_speed_range_is_named_after_its_spindle_and_its_m_function(num: Schema) -> None:
    assert num.on("cnc").instance_label(("spindle.range_max", "3.42")) == "Spindle 3, M42"
    pages = [num.page(("spindle.range_max", f"{n}.40")) for n in (1, 2, 3, 4)]
    assert pages == ["8-16", "8-18", "8-20", "8-22"]


def test_a_limit_speed_is_at_most_the_highest_speed_of_its_range() -> None:
    # Page 8-16.
    file = new_file("num")
    file.set(file.find("P46N5"), Value(2000, "rpm"))
    limit = file.find("P46N14")
    assert fault(file.evaluation, limit, Value(2000, "rpm")) is None
    assert "2001 rpm is outside 0 to 2000 rpm" in str(fault(file.evaluation, limit, Value(2001, "rpm")))


def test_the_group_of_a_spindle_is_written_as_a_name_or_as_the_word(num: Schema) -> None:
    # Page 8-11: 0 for group 1, 1 for group 2.
    group = num.parameter("spindle.group")
    assert read_value(group, "1", "") == read_value(group, "Group 2", "") == Value("group_2")
    assert write_value(group, Value("group_1")) == "Group 1"
    with pytest.raises(InvalidValueError, match="'8' is not a choice"):
        read_value(group, "8", "")


def test_bits_of_a_word_whose_figure_is_lost_are_kept_and_marked(num: Schema, file: ParameterFile) -> None:
    assert file.evaluation.find_bit("P6N1.5") == (("spindle.type", "1"), 5)
    known = {bit.bit for bit in num.parameter("spindle.type").bits if not bit.unknown}
    assert known == {0, 5, 6, 7}
    for name in ("comm.master_settings", "comm.slave_settings", "comm.dnc1_settings", "misc.graphics"):
        assert all(bit.unknown for bit in num.parameter(name).bits), name


def test_a_hexadecimal_word_is_read_as_the_manual_writes_it_and_written_so(num: Schema) -> None:
    xoff = num.parameter("misc.xoff_character")
    assert read_value(xoff, "$93", "") == Value(0x93)
    assert write_value(xoff, Value(0x93)) == "0x93"
    sequence = num.parameter("comm.computer_sequence")
    assert write_value(sequence, read_value(sequence, "$001B5B43", "")) == "0x001B5B43"


@pytest.mark.parametrize(
    ("number", "value"),
    [
        pytest.param("P46N12", Value(0, "rpm"), id="8-16"),
        pytest.param("P62N0", Value(10, "rev/s2"), id="8-35"),
        pytest.param("P62N7", Value(100, "mV"), id="8-35"),
        pytest.param("P51N0", Value(20, "ms"), id="9-12"),
        pytest.param("P58N2", Value(512, "kbytes"), id="9-14"),
        pytest.param("P98N0", Value("ladder"), id="9-26 the value 1"),
        pytest.param("P99N0", Value(10, "ms"), id="9-28"),
        pytest.param("P39N1", Value(1000, "ms"), id="10-6"),
        pytest.param("P100N0", Value(0xFF), id="10-10 $FF"),
        pytest.param("P110N0", Value("ff"), id="10-12 $FF"),
        pytest.param("P110N1", Value(0x15), id="10-12 $15"),
        pytest.param("P110N3", Value(5), id="10-12 $5"),
        pytest.param("P110N7", Value(0x14), id="10-12 $14"),
        pytest.param("P111N4", Value(0), id="10-16 $0"),
        pytest.param("P112N1", Value(0x15), id="10-20 $15"),
    ],
)
def test_the_printed_defaults(file: ParameterFile, number: str, value: Value) -> None:
    assert file.default(file.find(number)) == value


def test_the_line_numbers_are_those_of_the_sections(num: Schema) -> None:
    # Pages 10-12, 10-16 and 10-20: only PLCTOOL may have $2 and $3.
    codes = {
        link: [c.raw for c in num.parameter(f"comm.{link}_line").choices]
        for link in ("master", "slave", "plctool")
    }
    assert codes["master"] == codes["slave"] == [0, 1, *range(4, 12), 255]
    assert codes["plctool"] == [*range(12), 255]


def test_the_codes_of_the_service_characters_are_those_of_ascii(num: Schema) -> None:
    # Page 10-2, whose value column is not called a default.
    rows = num.tables["dnc1-characters"].rows
    assert [row[2] for row in rows] == list(num.parameter("comm.dnc1_character").instances)
    assert [int(str(row[1])[1:], 16) for row in rows] == [0x02, 0x03, 0x16, 0x06, 0x15, 0x04, 0x05, 0x1D]


# ------------------------------------------------------------------------------------- the order of
# integration


def of_word(num: Schema, parameter: str) -> list[str]:
    """Return the ids that the words of a parameter belong to, in the manual's order."""
    numbers = {a: num.on("cnc").number(a) for a in num.on("cnc").addresses}
    return list(dict.fromkeys(a[0] for a, n in numbers.items() if n and re.fullmatch(rf"{parameter}N\d+", n)))


def sections(num: Schema) -> list[Guide]:
    """Return the guides of the sections that this manual describes, 3.1 to 3.7, in the order of the file."""
    return [g for g in num.guides if g.id.startswith("step-") and g.id != "step-3-8"]


def test_every_step_names_its_parameter_and_has_all_its_words_in_their_order(num: Schema) -> None:
    for guide in sections(num):
        for step in guide.steps:
            named = re.findall(r"\bP\d+", step.title)
            assert named, step.title
            assert all(list(step.params) == of_word(num, name) for name in named), step.title


def test_the_sections_are_those_of_chapter_3_and_go_through_chapters_4_to_10(num: Schema) -> None:
    names = [guide.title.split()[1] for guide in sections(num)]
    assert names == ["3.1", "3.2", "3.3", "3.4", "3.5.1", "3.5.2", "3.6", "3.7"]
    pages = ["3-3", "3-8", "3-11", "3-20", "3-23", "3-27", "3-28", "3-31"]
    assert [guide.page for guide in sections(num)] == pages
    chapters = [int(step.page.partition("-")[0]) for guide in sections(num) for step in guide.steps]
    assert chapters == sorted(chapters)
    assert set(chapters) == set(range(4, 11))


def test_a_path_through_all_sections_meets_every_parameter_of_the_chapters_once(num: Schema) -> None:
    path = [name for guide in sections(num) for step in guide.steps for name in step.params]
    assert len(path) == len(set(path))
    described = {name for name, group in num.group_of.items() if group.key not in ("qvn", "reserved")}
    assert described == set(path)


def test_a_step_is_reported_on_the_page_of_its_parameter(num: Schema) -> None:
    for guide in sections(num):
        for step in guide.steps:
            words = [
                a
                for a in num.on("cnc").addresses
                if re.fullmatch(rf"{step.title.split()[0].strip(',')}N\d+", num.on("cnc").number(a) or "")
            ]
            assert step.page in {num.page(a) for a in words}, step.title


def test_the_drives_of_section_3_8_have_the_words_that_chapter_12_names(num: Schema) -> None:
    [step] = next(g for g in num.guides if g.id == "step-3-8").steps
    named = ["P21", *(f"P{n}" for n in range(70, 80)), "P85", "P86", "P87"]  # page 12-1
    assert list(step.params) == [name for word in named for name in of_word(num, word)]


def test_every_procedure_goes_through_the_parameters_it_names(num: Schema) -> None:
    steps = next(g for g in num.guides if g.id == "procedures").steps
    assert len(steps) == 12
    for step in steps:
        names = re.findall(r"P\d+", step.what[step.what.rindex("(") :])
        assert list(step.params) == [name for word in names for name in of_word(num, word)], step.title
