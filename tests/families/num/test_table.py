"""The NUM parameter table: every byte is understood or reported, and comes back as it was (page 13-14)."""

from pathlib import Path

import pytest

from amp_studio.families.num.formats.table import FORMAT
from amp_studio.files import ParameterFile, content_of, read_content
from amp_studio.formats import FormatError, ReadOptions, all_formats, export_file, import_file
from amp_studio.schema import Address, Schema, Value
from tests.families.num.small_num import PARAMETERS, SAMPLE, XOFF, fault, measured, small_num, taken


def kept_on_disk(file: ParameterFile, schema: Schema, monkeypatch: pytest.MonkeyPatch) -> ParameterFile:
    """Return a file after it was saved and opened."""
    monkeypatch.setattr("amp_studio.files.reading.load_schema", lambda family: schema)
    return read_content(Path("try.amp"), content_of(file))


# -- the manual's own example ----------------------------------------------------


def test_the_example_of_the_manual_is_read(num: Schema) -> None:
    file = taken(num, SAMPLE)
    assert len(file.values) == 1 + 2 + 1 + 1 + 3 + 2 + 5 + 2 + 1 + 32 + 1
    assert file.get(("p.w0_0", "")) == Value(7)
    assert [file.get((f"p.w7_{n}", "")) for n in (0, 1)] == [Value(0x54), Value(10)]
    assert [file.get(("p.w9", n)) for n in ("0", "1", "2", "3", "31")] == [
        Value(0),
        Value(1),
        Value(2),
        Value(255),
        Value(255),
    ]


def test_the_example_of_the_manual_is_written_byte_for_byte(num: Schema) -> None:
    """From the words alone: what the file remembers of the table is the four words that P4 has by the
    header.
    """
    file = taken(num, SAMPLE)
    assert FORMAT.write(file) == SAMPLE
    assert file.header.extra == {"num_table": {"words": {"P4": "t0n4"}}}
    file.header.extra.clear()
    assert FORMAT.write(file) == SAMPLE.replace("P4N0:t0n4", "P4N0:t0n5")


def test_what_the_example_leaves_out_is_reported(num: Schema) -> None:
    """Page 13-14 gives P4 four words and P6 nine, and writes three and five."""
    notes = FORMAT.read(SAMPLE, num, ReadOptions()).notes
    assert notes == [
        "the table does not contain P16, P18, P21 to P22, P30, P50, P96 to P98, P101, P113",
        "the table does not contain these words: P4N3, P6N5 to P6N8",
        "the table has other numbers of words than Small NUM: 4 of P4 (5)",
    ]


def test_every_length_of_the_example_is_checked(num: Schema) -> None:
    lines = SAMPLE.split("\n")
    for n, line in enumerate(lines[:-1]):
        wrong = [*lines[:n], f"{line[:-2]}{int(line[-2:], 16) + 1:02X}", *lines[n + 1 :]]
        message = fault(num, "\n".join(wrong))
        assert message.startswith(
            f"line {n + 1}, column {len(line) - 1}: the line has {len(line) - 3} characters, "
        )


# -- words of every type ---------------------------------------------------------


@pytest.mark.parametrize(
    ("lines", "address", "value"),
    [
        (["P18N3:t1n32", "#-32768"], ("p.w18", "3"), Value(-32768)),
        (["P21N31:t4n32", "#99999999"], ("p.w21", "31"), Value(99_999_999)),
        (["P16N6:t2n64", "#-12345"], ("p.w16", "3"), Value(-12.345, "mm")),
        (["P16N7:t2n64", "#500000"], ("p.w17", "3"), Value(500.0, "mm")),
        (["P22N0:t5n32", "#65535"], ("p.w22", "0"), Value(65535.0, "ms")),
        (["P30N2:t4n32", "#6000"], ("p.w30", "2"), Value(6000.0, "mm/min")),
        (["P96N0:t8n1", "#M .E"], ("p.w96_0", ""), Value("M .E")),
        (["P97N1:t8n3", "#AB CD"], ("p.w97_2", ""), Value("CD")),
        (["P98N0:t0n1", "#1"], ("p.w98_0", ""), Value("ladder")),
        (["P98N0:t0n1", "#5"], ("p.w98_0", ""), Value("raw:5")),
        (["P101N0:t7n1", "#A0F"], ("p.w101_0", ""), Value(0xA0F)),
        (["P113N0:t9n1", "#-1.5"], ("p.w113_0", ""), Value(-1.5)),
    ],
)
def test_a_word_is_what_the_schema_shows_of_its_storage(
    num: Schema, lines: list[str], address: Address, value: Value
) -> None:
    file = taken(num, measured(*lines))
    assert file.get(address) == value
    assert FORMAT.write(file) == measured(*lines)


@pytest.mark.parametrize("text", [" M. ", "", "  ", "null", "'", "#", "0x1F"])
def test_a_text_keeps_every_blank_in_the_table_and_on_disk(
    num: Schema, monkeypatch: pytest.MonkeyPatch, text: str
) -> None:
    table = measured("P96N0:t8n1", f"#{text}")
    file = taken(num, table)
    assert file.get(("p.w96_0", "")) == Value(text)
    assert FORMAT.write(kept_on_disk(file, num, monkeypatch)) == table


def test_millimetres_are_degrees_on_an_axis_that_turns(num: Schema) -> None:
    table = measured("P1N0:t6n2", "#00000004", "P16N2:t2n64", "#1000 2000 3000", "P30N1:t4n32", "#10 20")
    file = taken(num, table)
    assert [file.get(("p.w30", n)) for n in "12"] == [Value(10.0, "mm/min"), Value(20.0, "deg/min")]
    assert [file.get(("p.w16", n)) for n in "12"] == [Value(1.0, "mm"), Value(3.0, "deg")]
    assert FORMAT.write(file) == table
    file.set(("p.w1_0", ""), Value(0))
    assert FORMAT.write(file) == table.replace("#00000004", "#00000000"), "the control keeps the figure"


def test_a_word_with_two_meanings_has_the_one_of_its_configuration(num: Schema) -> None:
    plain = taken(num, measured("P50N0:t5n1", "#7"))
    coarse = taken(num, measured("P7N0:t0n2", "#1 0", "P50N0:t5n1", "#7"))
    assert (plain.get(("p.w50_0", "")), plain.get(("p.w50_1", ""))) == (Value(7), None)
    assert (coarse.get(("p.w50_0", "")), coarse.get(("p.w50_1", ""))) == (None, Value(7.0, "s"))


def test_a_value_in_another_unit_is_written_as_the_nearest_word(num: Schema) -> None:
    file = ParameterFile(num)
    file.set(("p.w16", "0"), Value(0.1, "in"))
    file.set(("p.w30", "0"), Value(10.0, "in/min"))
    assert "#2540;05\n" in FORMAT.write(file)
    assert "#254;04\n" in FORMAT.write(file)


@pytest.mark.parametrize(
    ("name", "instance", "value", "message"),
    [
        ("p.w21", "3", Value(100_000_000), "P21N3 Word P21Nx: 100000000 is outside 0 to 99999999"),
        ("p.w5_0", "", Value(256), "P5N0 Word P5N0: 256 is outside 0 to 255"),
        ("p.w16", "3", Value(1.0, "ms"), "P16N6 .* is stored in °, not in ms"),
        ("p.w113_0", "", Value(float("inf")), "P113N0 .*: inf is no number"),
        ("p.w18", "0", Value(float("nan")), "P18N0 .*: nan is no number"),
        ("p.w96_0", "", Value("é"), "P96N0 .* not ASCII"),
        ("p.w97_0", "", Value("A B"), "P97N0: the text 'A B' would not be read as one value"),
        ("p.w97_0", "", Value(""), "P97N0: the text '' would not be read as one value"),
        ("p.w96_0", "", Value("A" * 300), "a line has 255 characters at most, and this one 301"),
        ("p.w21", "3", Value("text"), "P21N3 .*'text' is not a whole number"),
    ],
)
def test_what_a_word_cannot_hold_is_not_written(
    num: Schema, name: str, instance: str, value: Value, message: str
) -> None:
    file = ParameterFile(num)
    file.values[name, instance] = value  # also one that no file contains
    with pytest.raises(FormatError, match=message):
        FORMAT.write(file)


# -- what cannot be meant --------------------------------------------------------


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (["P9N0:t6n32", "#0"], "line 2, column 7: P9 of Small NUM has words of type 0, not 6"),
        (["P9N0:t3n32", "#0"], "line 2, column 7: there is no type 3 of words"),
        (["P9N0:t0n32", "#0", "P9N1:t0n31", "#0"], "line 4, column 6: a header above gives t0n32 of P9"),
        (["P5N0:t0n2", "#1 0 0"], "line 3, column 6: P5 has 2 words: there is no P5N2"),
        (["P5N2:t0n2", "#1"], "line 2, column 3: P5 has 2 words: there is no P5N2"),
        (["P5N2", "#1"], "line 2, column 3: P5 has 2 words: there is no P5N2"),
        (
            ["P9N0:t0n32", "#" + " ".join("0" * 11)],
            "line 3, column 22: a data line contains 10 values at most",
        ),
        (["P9N0:t0n32", "#0 0", "P9N1:t0n32", "#5"], "line 5, column 2: P9N1 is in line 3 already"),
        (["P5N0:t0n2", "#1  0"], "line 3, column 4: a value is missing: values have one blank"),
        (["P5N0:t0n2", "#"], "line 3, column 2: a value is missing"),
        (["P5N0:t0n2", "#0 100"], "line 3, column 4: P5N1: '100' is not hexadecimal from 0 to FF"),
        (["P5N0:t0n2", "#0 ff"], "line 3, column 4: P5N1: 'ff' is not hexadecimal from 0 to FF"),
        (
            ["P0N0:t6n1", "#123456789"],
            "line 3, column 2: P0N0: '123456789' is not hexadecimal from 0 to FFFFFFFF",
        ),
        (
            ["P18N0:t1n32", "#5 32768"],
            "line 3, column 4: P18N1: '32768' is not a whole number from -32768 to 32767",
        ),
        (["P21N0:t4n32", "#-1"], "line 3, column 2: P21N0: '-1' is not a whole number from 0 to 99999999"),
        (
            ["P16N0:t2n64", "#100000000"],
            "line 3, column 2: P16N0: '100000000' is not a whole number from -99999999",
        ),
        (["P22N0:t5n32", "#1.5"], "line 3, column 2: P22N0: '1.5' is not a whole number from 0 to 65535"),
        (["P113N0:t9n1", "#1e5"], "line 3, column 2: P113N0: '1e5' is not a number"),
        (["P113N0:t9n1", "#1E999"], "line 3, column 2: P113N0: '1E999' is not a number"),
        (["P9N0:t0n32", "P9N10:t0n32"], "line 2, column 1: P9N0:t0n32 has no data line"),
        (["P9N0:t0n32"], "line 2, column 1: P9N0:t0n32 has no data line"),
        (["P9N0:t0n32", "#0", "#1"], "line 4, column 1: a data line without a header"),
        (["#0"], "line 2, column 1: a data line without a header"),
        (["P09N0:t0n32", "#0"], "line 2, column 3: 'N' is expected here"),
        (["P9M0:t0n32", "#0"], "line 2, column 3: 'N' is expected here"),
        (["P9N0;t0n32", "#0"], "line 2, column 5: ':t' or the end is expected here"),
        (["P9N0:t0", "#0"], "line 2, column 8: 'n' is expected here"),
        (["P9N0:t0n0", "#0"], "line 2, column 9: the number of words is expected here"),
        (["P9N0:t0n32 ", "#0"], "line 2, column 11: the header goes on"),
        (["Q9N0:t0n32", "#0"], "line 2, column 1: 'P' is expected here"),
        (["P9N0:t0n32", "#0\t1"], "line 3, column 3: the character with the code 9 has no place in a line"),
        (["P12N0:t0n4", "#0 0 0 0"], "line 2, column 1: Small NUM has no P12N0"),
        (["P12N0", "#0 0 0 0"], "line 2, column 1: Small NUM has no P12N0"),
        (["P5N0:t0n3", "#0 0 1"], "line 3, column 6: Small NUM has no P5N2"),
    ],
)
def test_a_table_that_cannot_be_understood_is_reported_with_its_place(
    num: Schema, lines: list[str], message: str
) -> None:
    assert fault(num, measured(*lines)).startswith(message)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (XOFF, "", "line 30, column 1: the table has no Xoff (ALT 19) at its end: it may have been cut off"),
        (f";09\n{XOFF}", "", "line 29, column 10: the table has no Xoff"),
        (
            XOFF,
            "X off\n",
            "line 30, column 1: the table ends with the character Xoff (ALT 19), not with its name",
        ),
        (XOFF, f"{XOFF}\nmore", "line 31, column 1: something comes after Xoff"),
        (XOFF, f"{XOFF} ", "line 30, column 2: something comes after Xoff"),
        ("%00000000;09", "%0000000;08", "line 1, column 1: a table begins with '%' and the eight digits"),
        ("%00000000;09", "%000000000;0A", "line 1, column 1: a table begins with '%' and the eight digits"),
        ("%00000000;09\n", "", "line 1, column 1: a table begins with '%'"),
        (
            "#1 0;04",
            "#1 0",
            "line 13, column 5: the line does not close with ';' and two digits for its length",
        ),
        ("#1 0;04", "#1 0;04 ", "line 13, column 8: something comes after the length"),
        ("#1 0;04", "#1 0;04\tremark", "line 13, column 8: something comes after the length"),
        ("0 0;0A", "0 0;0a", "line 15, column 12: the length is written with capitals: 0A"),
        (
            "#1 0;04",
            "#1 0;05",
            "line 13, column 6: the line has 4 characters, 04 in hexadecimal, and gives 05",
        ),
        (
            "#1 0;04",
            "#1 1 0;04",
            "line 13, column 8: the line has 6 characters, 06 in hexadecimal, and gives 04",
        ),
        ("#1 0;04", "", "line 13, column 1: an empty line"),
        ("#1 0;04\n", "#1 0;04\r\n", "line 13, column 8: the line ends otherwise than the first one"),
    ],
)
def test_what_is_wrong_around_the_words_is_reported_with_its_place(
    num: Schema, old: str, new: str, message: str
) -> None:
    assert SAMPLE.count(old) == 1
    assert fault(num, SAMPLE.replace(old, new)).startswith(message)


def test_a_mixed_line_end_is_reported_in_both_directions(num: Schema) -> None:
    mixed = SAMPLE.replace("\n", "\r\n").replace("#1 0;04\r\n", "#1 0;04\n")
    assert fault(num, mixed).startswith("line 13, column 8: the line ends otherwise than the first one")


def test_nothing_is_imported_of_a_table_with_a_fault(
    num: Schema, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("amp_studio.formats.import_export.load_schema", lambda family: num)
    path = tmp_path / "bad.par"
    path.write_bytes(SAMPLE.replace("%00000000;09", "%0000000é;09").encode("latin-1"))
    with pytest.raises(FormatError, match="line 1: there is a byte that is no ascii text"):
        import_file(path, "num")


# -- words that the schema does not have -----------------------------------------

STRANGE = measured(
    "P0N0:t6n1",
    "#00000007",
    "P5N0:t0n4",
    "#1 0 0F 2",
    "P12N0:t1n12",
    "#0 0 0 -5 0 0 0 0 0 0",
    "P12N10:t1n12",
    "#+3 004",
    "P16N0:t2n66",
    "#1 2",
    "P16N64:t2n66",
    "#7 8",
    "P107N0:t8n1",
    "#A B  C",
    "P130N5:t0n9",
    "#1",
)


def test_unknown_words_are_kept_and_written_back_in_their_place(
    num: Schema, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = taken(num, STRANGE, keep_unknown=True)
    assert file.unknown == {
        "P5N2": ":t0n4#0F 2",
        "P12N0": ":t1n12#0 0 0 -5 0 0 0 0 0 0",
        "P12N10": ":t1n12#+3 004",
        "P16N64": ":t2n66#7 8",
        "P107N0": ":t8n1#A B  C",
        "P130N5": ":t0n9#1",
    }
    assert FORMAT.write(file) == STRANGE
    assert FORMAT.write(kept_on_disk(file, num, monkeypatch)) == STRANGE
    file.set(("p.w5_1", ""), Value(3))
    assert FORMAT.write(file) == STRANGE.replace("#1 0 0F 2", "#1 3 0F 2")


def test_words_between_known_ones_are_kept_apart(num: Schema, tmp_path: Path) -> None:
    sparse = "".join(
        line for line in PARAMETERS.splitlines(True) if "P6N1" not in line and "P6N3" not in line
    )
    schema = small_num(tmp_path / "num", sparse)
    table = measured("P6N0:t0n9", "#1 2 3 4 5 6 7 8 9")
    assert fault(schema, table).startswith("line 3, column 4: Small NUM has no P6N1")
    file = taken(schema, table, keep_unknown=True)
    assert file.unknown == {"P6N1": ":t0n9#2", "P6N3": ":t0n9#4"}
    assert FORMAT.write(file) == table


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (["P12N0:t0n4", "#0 100"], "line 3, column 4: P12N1: '100' is not hexadecimal from 0 to FF"),
        (["P12N0:t0n2", "#0 1 2"], "line 3, column 6: P12 has 2 words: there is no P12N2"),
        (["P9N0:t6n32", "#0"], "line 2, column 7: P9 of Small NUM has words of type 0, not 6"),
        (["P12N0:t0n4", "#0", "P12N1:t1n4", "#0"], "line 4, column 7: a header above gives t0n4 of P12"),
    ],
)
def test_what_is_kept_is_checked_by_the_type_the_table_reports(
    num: Schema, lines: list[str], message: str
) -> None:
    assert fault(num, measured(*lines), keep_unknown=True).startswith(message)


def test_entries_of_other_formats_are_left_alone_and_spoilt_ones_reported(num: Schema) -> None:
    file = taken(num, SAMPLE)
    file.unknown["home.nonsense@1"] = "3 mm"
    assert FORMAT.write(file) == SAMPLE
    file.unknown["P12N0"] = "5"
    with pytest.raises(FormatError, match="'5' is not how words of P12N0 are kept"):
        FORMAT.write(file)


# -- finding the format ----------------------------------------------------------


@pytest.mark.parametrize("name", ["table.par", "table.NUM", "table.txt"])
def test_a_table_is_found_by_its_content_and_written_by_its_ending(
    num: Schema, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    monkeypatch.setattr("amp_studio.formats.import_export.load_schema", lambda family: num)
    (tmp_path / "in").write_bytes(SAMPLE.encode("ascii"))
    reported: list[str] = []
    file = import_file(tmp_path / "in", notify=reported.append)
    assert export_file(file, tmp_path / name).format.key == "num"
    assert (tmp_path / name).read_bytes() == SAMPLE.encode("ascii")
    assert len(reported) == 3


def test_no_other_format_takes_a_table_for_its_own() -> None:
    assert [f.key for f in all_formats() if f.recognises(SAMPLE)] == ["num"]
    assert [f.key for f in all_formats() if f.recognises(SAMPLE[1:])] == ["num"], (
        "so that it is told what is missing"
    )
