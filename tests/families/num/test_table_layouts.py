"""NUM tables of other software and other hands: what is kept of their form."""

import re
from pathlib import Path

import pytest

from amp_studio.families.num.formats.table import FORMAT
from amp_studio.files import ParameterFile, content_of, read_content
from amp_studio.formats import FormatError
from amp_studio.schema import Schema, Value
from tests.families.num.small_num import SAMPLE, XOFF, measured, taken


def kept_on_disk(file: ParameterFile, schema: Schema, monkeypatch: pytest.MonkeyPatch) -> ParameterFile:
    """Return a file after it was saved and opened."""
    monkeypatch.setattr("amp_studio.files.reading.load_schema", lambda family: schema)
    return read_content(Path("try.amp"), content_of(file))


# -- other software, other hands -------------------------------------------------

OLD = re.sub(
    r"^(P[0-9]+N[0-9]+):t[0-9]n[0-9]+;..$", lambda m: f"{m[1]};{len(m[1]):02X}", SAMPLE, flags=re.MULTILINE
)


def test_tables_of_older_software_come_without_types(num: Schema, monkeypatch: pytest.MonkeyPatch) -> None:
    """Type and number of words are in the header from index K on (page 13-14)."""
    file = taken(num, OLD)
    assert "P9N10;05\n" in OLD
    assert file.values == taken(num, SAMPLE).values
    assert file.header.extra == {"num_table": {"headers": "old"}}
    assert FORMAT.write(kept_on_disk(file, num, monkeypatch)) == OLD


def test_older_software_may_have_unknown_words_too(num: Schema) -> None:
    table = measured("P5N0", "#1 0 77", "P12N0", "#anything goes", "P96N0", "#A  B")
    file = taken(num, table, keep_unknown=True)
    assert file.unknown == {"P5N2": "#77", "P12N0": "#anything goes"}
    assert FORMAT.write(file) == table


EDITED = (
    SAMPLE.replace("%00000000;09", "%12345678 Machine 7, spare; as of 1998;26")
    .replace("P10N0:t6n1;0A\n#00000000;09\n", "")
    .replace("P8N0:t6n1;09\n", "P10N0:t6n1;0A\n#0;02\nP8N0:t6n1;09\n")
    .replace("P9N10:t0n32;0B", "P9N10;05")
    .replace("P9N30:t0n32;0B\n#FF FF;06\n", "P9N31:t0n32;0B\n#FF;03\nP9N30:t0n32;0B\n#0F;03\n")
    .replace("\n", "\r\n")
    + "\r\n\x1a"
)


def test_a_table_that_was_edited_by_hand_comes_back_as_it_was(
    num: Schema, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Another order and division of the lines, leading zeros, CR LF, a remark, a DOS end of file."""
    file = taken(num, EDITED)
    assert FORMAT.write(file) == EDITED
    assert FORMAT.write(kept_on_disk(file, num, monkeypatch)) == EDITED


def test_a_changed_word_is_written_into_an_edited_table(num: Schema) -> None:
    file = taken(num, EDITED)
    file.set(("p.w9", "30"), Value(0x1F))
    file.set(("p.w5_1", ""), None)
    file.set(("p.w101_0", ""), Value(0xAB))
    expected = EDITED.replace("#0F;03", "#1F;03").replace("#1 0;04", "#1;02")
    assert FORMAT.write(file) == expected.replace(f"\r\n{XOFF}", f"\r\nP101N0:t7n1;0B\r\n#AB;03\r\n{XOFF}")
    file.set(("p.w9", "30"), Value(0xF))
    assert "#0F;03" in FORMAT.write(file), "as it was spelled"


def test_a_value_that_was_not_there_gets_its_place(num: Schema) -> None:
    file = taken(num, SAMPLE)
    for n in (5, 7, 8):
        file.set((f"p.w6_{n}", ""), Value(n))
    assert "P6N0:t0n9;09\n#0 0 0 0 0 5;0C\nP6N7:t0n9;09\n#7 8;04\nP7N0" in FORMAT.write(file)


def test_a_word_that_the_control_of_the_table_lacks_is_not_written(num: Schema) -> None:
    file = taken(num, SAMPLE)
    file.set(("p.w4_4", ""), Value(1))
    with pytest.raises(FormatError, match="P4N4: the control that the table came from has 4 words of P4"):
        FORMAT.write(file)


def test_an_end_without_a_line_of_its_own_is_taken_too(num: Schema) -> None:
    table = SAMPLE.removesuffix("\n" + XOFF) + XOFF + "\n\n"
    assert FORMAT.write(taken(num, table)) == table


@pytest.mark.parametrize(
    ("reported", "message"),
    [
        ({"job_reference": "12"}, "the job reference '12' is not of eight digits"),
        ({"comment": "9"}, "the comment behind the job reference"),
        ({"comment": "\n"}, "the comment behind the job reference"),
        ({"end": "LF XON"}, "XON is not one of the characters CR, LF, XOFF"),
        ({"words": {"P4": "t3n4"}}, "'P4: t3n4' is not type and number of words"),
        ({"lines": ["P9N0"]}, "'P9N0' is no line of a table"),
    ],
)
def test_what_a_user_spoils_in_the_header_is_reported(
    num: Schema, reported: dict[str, object], message: str
) -> None:
    file = taken(num, SAMPLE)
    file.header.extra["num_table"] = reported
    with pytest.raises(FormatError, match=message):
        FORMAT.write(file)


def test_a_job_reference_may_be_given_in_the_header(num: Schema) -> None:
    file = taken(num, SAMPLE)
    file.header.extra["num_table"] = {"job_reference": 1234, "comment": " Mill 7"}
    assert FORMAT.write(file).startswith("%00001234 Mill 7;10\nP0N0:t6n1;09\n")
