"""Whatever is to be written can be read, and means the same; else nothing is written."""

import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.files import Document, ParameterFile, SaveError, content_of, new_file, open_file, read_content
from amp_studio.files.storage import readable_content
from amp_studio.schema import InvalidValueError, Value, family_ids, load_schema
from tests.campaigns import some
from tests.work import calls_of

HERE = Path("x.amp")
GAIN = ("gain.integral", "X")


@pytest.mark.parametrize(
    "value",
    [
        Value(2**53),
        Value(10**400),
        Value(1e300),
        Value(1.5),
        Value(math.inf),
        Value(math.nan),
        Value("nonsense"),
        Value(True),
        Value(5, "furlong"),
        Value(5, "mm"),
    ],
    ids=repr,
)
def test_a_value_that_could_not_be_read_back_is_refused_and_nothing_is_changed(
    tmp_path: Path, value: Value
) -> None:
    path = tmp_path / "a.amp"
    Document.create(new_file("57c422b", name="A"), path).close()
    before = path.read_bytes()
    with Document.open(path) as document:
        document.file.values[GAIN] = value
        with pytest.raises(SaveError, match=r"a\.amp was not written: .*gain\.integral@X"):
            document.save()
    assert (path.read_bytes(), [p.name for p in tmp_path.iterdir()]) == (before, ["a.amp"])


@pytest.mark.parametrize("text", ["\ud800", "a\ud800b"])
def test_half_a_character_is_refused_in_a_header_a_mark_and_a_text(tmp_path: Path, text: str) -> None:
    for change in (
        lambda file: setattr(file.header, "notes", text),
        lambda file: file.header.extra.update(x=text),
        lambda file: file.forced.update({GAIN: text}),
        lambda file: file.unknown.update({"a@b": text}),
        lambda file: file.unknown.update({text: "a"}),
    ):
        file = new_file("57c422b", name="A")
        change(file)
        with pytest.raises(SaveError, match="was not written: "):
            readable_content(file, HERE)


EXTRA = """\
# kept
amp_studio: 1
family: 57c422b
rev: 1.10
serial: 007
made: 2001-12-14
never: 2001-99-99
<<: 5
big: 99999999999999999999999999999999999999999999999999
none: .nan
quoted: "a: 'b'"
deep: {list: [a, {b: 0x1F}], text: |-
    not a block}
5: a key like a number
~: {2.: a, true: b, ~: c}
nested:
  - one   # with a remark
  - two: [3]
    four: ~
values:
  gain.integral@X: 768   # page 4-48
...
"""


@pytest.mark.parametrize("text", [EXTRA, EXTRA.replace("# kept\n", "")], ids=["remark", "no remark"])
def test_what_the_program_does_not_know_survives_every_save_byte_for_byte(tmp_path: Path, text: str) -> None:
    path = tmp_path / "a.amp"
    text = text.replace(", text: |-\n    not a block", "")
    path.write_text(text, encoding="utf-8")
    with Document.open(path) as document:
        document.file.set(GAIN, Value(700))
        document.save()
        document.file.set(GAIN, None)
        document.file.set(("gain.integral", "Y"), Value(5))
        document.save()
        extra = document.file.header.extra
        copy = document.save_as(tmp_path / "b.amp")
        copy.close()
    kept = [line for line in text.splitlines() if "gain" not in line and line not in ("values:", "...")]
    saved = path.read_text(encoding="utf-8").splitlines()
    assert [line for line in saved if line in kept] == kept
    again = open_file(tmp_path / "b.amp").file.header.extra
    assert repr(again) == repr({**extra, "made_from": "a.amp"})
    assert "rev: 1.10" in (tmp_path / "b.amp").read_text(encoding="utf-8").splitlines()


ODD = st.one_of(
    st.text(st.characters(), max_size=20),
    st.from_regex(
        r"[+-]?[0-9]{1,20}([.,][0-9]{1,20})?(e[+-]?[0-9]{1,4})?( (mm|in|deg|ms|%|V|counts))?", fullmatch=True
    ),
    st.from_regex(r"(0x|\$)?[0-9A-F]{1,60}", fullmatch=True),
    st.from_regex(r"raw:[+-]?[0-9]{1,30}", fullmatch=True),
    st.sampled_from(
        ["yes", "no", "true", "1e300", "nan", "inf", "-0", "~", "null", "...", "'", "a: b", "# x", "=", "3.4"]
    ),
)


@pytest.mark.parametrize("family", some(family_ids()))
@given(data=st.data())
def test_whatever_a_person_may_say_of_a_value_is_written_and_read_back_equal(family: str, data) -> None:
    schema = load_schema(family)
    file = ParameterFile(schema)
    address = data.draw(st.sampled_from(file.addresses()))
    parameter = schema.parameters[address[0]]
    labels = [t for c in parameter.choices or () for t in (c.key, c.label, c.code, f"raw:{c.raw}") if t]
    said = data.draw(st.one_of(ODD, st.sampled_from(labels)) if labels else ODD)
    try:
        value = file.read(address, said)
    except InvalidValueError:
        return
    file.set(address, value)
    file.forced[address] = "on a day by a test"
    content = readable_content(file, HERE)
    again = read_content(HERE, content)
    assert (again.values, again.forced) == (file.values, file.forced)
    assert content_of(again, content) == content


def test_reading_back_costs_little_even_for_the_largest_file() -> None:
    file = new_file("9pc", name="A")
    content = content_of(file)
    readable_content(file, HERE, content)
    assert calls_of(lambda: readable_content(file, HERE, content)) < 100 * len(file.values)
