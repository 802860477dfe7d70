"""What a file contains besides known values comes back from a save as it was."""

import re
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from amp_studio.files import ParameterFile, ParameterFileError, content_of, open_file, read_content
from amp_studio.files.storage import save_file
from amp_studio.schema import Value, load_schema
from tests.campaigns import examples
from tests.files.commented import COMMENTED, edited

HERE = Path("small.amp")


# -- kept -----------------------------------------------------------------------------------------------


def test_an_unknown_parameter_is_kept_through_a_save(small: Path) -> None:
    edited(small, "...", "  future.thing@1: 5 furlongs\n  another: 1.25\n  third@x: true\n...")
    opened = open_file(small)
    expected = {"future.thing@1": "5 furlongs", "another": "1.25", "third@x": "true"}
    assert expected == opened.file.unknown
    opened.file.set(("home.calibration", "1"), Value(2.0, "mm"))
    save_file(opened.file, small, opened.digest)
    again = open_file(small).file
    assert (expected, Value(2.0, "mm")) == (again.unknown, again.get(("home.calibration", "1")))


def test_an_instance_this_machine_does_not_have_is_kept_too(small: Path) -> None:
    edited(small, "...", "  home.calibration@9: 7 mm\n  forgotten: why\n...")
    opened = open_file(small)
    save_file(opened.file, small, opened.digest)
    assert open_file(small).file.unknown == {"home.calibration@9": "7 mm", "forgotten": "why"}


LATHE_ONLY = """
family: two
name: Two machines
document: two
title: Two
machines: [{key: mill, name: Mill}, {key: lathe, name: Lathe}]
default_machine: mill
machine_parameter: control.type
scopes: {global: {instances: [""], label: Control}, axis: {instances: ["1", "2"], label: "Axis {i}"}}
units: {metric: {length: mm}}
effect: {level: reset}
groups: [all]
"""
SCOPED = """
- id: control.type
  name: Type
  type: choice
  choices: [{key: mill, label: Mill}, {key: lathe, label: Lathe}]
  help: {what: Mill or lathe.}
  page: "1"
- id: plane.radius
  name: Radius
  layouts: [{machines: [lathe], scope: axis}, {scope: global}]
  type: integer
  help: {what: One value on a mill and one for each axis of a lathe.}
  page: "1"
"""


def test_values_of_the_other_machine_type_wait_until_it_comes_back(family, tmp_path: Path) -> None:
    family(LATHE_ONLY, SCOPED)
    path = tmp_path / "two.amp"
    path.write_text(
        "amp_studio: 1\nfamily: two\nvalues:\n  control.type: Mill\n  plane.radius@1: 5\n  plane.radius:"
        " 7\n...\n"
    )
    opened = open_file(path)
    assert ({"plane.radius@1": "5"}, Value(7)) == (opened.file.unknown, opened.file.get(("plane.radius", "")))
    opened.file.set(("control.type", ""), Value("lathe"))
    save_file(opened.file, path, opened.digest)
    again = open_file(path)
    assert ({"plane.radius": "7"}, Value(5)) == (again.file.unknown, again.file.get(("plane.radius", "1")))


def test_a_value_set_now_is_not_overwritten_by_one_that_was_not_understood(family, tmp_path: Path) -> None:
    family(LATHE_ONLY, SCOPED)
    path = tmp_path / "two.amp"
    path.write_text("amp_studio: 1\nfamily: two\nvalues:\n  control.type: Mill\n  plane.radius@1: 5\n...\n")
    opened = open_file(path)
    opened.file.set(("control.type", ""), Value("lathe"))
    opened.file.set(("plane.radius", "1"), Value(9))
    save_file(opened.file, path, opened.digest)
    assert Value(9) == open_file(path).file.get(("plane.radius", "1"))


def test_saving_unchanged_keeps_every_byte_a_person_wrote(tmp_path: Path) -> None:
    path = tmp_path / "small.amp"
    path.write_text(COMMENTED, encoding="utf-8")
    file = read_content(path, COMMENTED.encode())
    assert content_of(file, COMMENTED.encode()).decode() == COMMENTED


def test_comments_and_unknown_keys_survive_changes(tmp_path: Path) -> None:
    path = tmp_path / "small.amp"
    path.write_text(COMMENTED, encoding="utf-8")
    opened = open_file(path)
    opened.file.set(("home.calibration", "1"), Value(2.0, "mm"))
    opened.file.set(("home.g30_position", "1"), Value(9.0, "mm"))
    save_file(opened.file, path, opened.digest)
    text = path.read_text(encoding="utf-8")
    for line in COMMENTED.splitlines():
        if "#" in line:
            assert line[line.index("#") :] in text
    assert re.search(r"home\.calibration@1: 2 mm +# \+- 0\.1\n", text)
    assert "builder: {name: me, parts: [1, 2.50, yes]}" in text
    again = open_file(path).file
    assert (Value(9.0, "mm"), {"name": "me", "parts": [1, 2.5, "yes"]}) == (
        again.get(("home.g30_position", "1")),
        again.header.extra["builder"],
    )


@pytest.mark.parametrize(
    "gone",
    [
        [("axis.type", "1")],
        [("control.type", "")],
        [("control.type", ""), ("axis.type", "1")],
        [("home.calibration", "1")],
        [("axis.name", "1")],
        [("axis.type", "1"), ("home.calibration", "1"), ("home.position", "1"), ("axis.name", "1")],
    ],
)
def test_a_comment_does_not_go_with_the_value_above_it(gone) -> None:
    path = HERE
    file = read_content(path, COMMENTED.encode())
    for address in gone:
        file.set(address, None)
    text = content_of(file, COMMENTED.encode()).decode()
    own = {("control.type", ""): "# not a lathe", ("home.calibration", "1"): "# +- 0.1"}
    lost = [own[address] for address in gone if address in own]
    for line in COMMENTED.splitlines():
        comment = line[line.index("#") :] if "#" in line else ""
        if comment and comment not in lost:
            assert comment in text, text
    assert file.values == read_content(path, text.encode()).values


def test_comments_below_a_section_that_goes_stay() -> None:
    text = COMMENTED.replace(
        "values:", "forced:\n  axis.name@1: why   # a mark\n  # before the values\nvalues:"
    )
    file = read_content(HERE, text.encode())
    assert file.forced == {("axis.name", "1"): "why"}
    file.forced.clear()
    saved = content_of(file, text.encode()).decode()
    assert ("forced" in saved, "# before the values" in saved) == (False, True)
    file.values.clear()
    emptied = content_of(file, text.encode()).decode()
    assert ("values:" in emptied, "# end of the file" in emptied) == (False, True)
    assert read_content(HERE, emptied.encode()).values == {}


def test_marks_of_force_are_kept_through_a_save(small: Path) -> None:
    opened = open_file(small)
    opened.file.set_checked(
        {("home.calibration", "1"): Value(1e6, "mm")}, force="on a day by a test: 'quoted' # sign"
    )
    save_file(opened.file, small, opened.digest)
    assert open_file(small).file.forced == {("home.calibration", "1"): "on a day by a test: 'quoted' # sign"}


texts = st.text(st.characters(exclude_categories=["Cs"]), max_size=40)


@settings(max_examples=examples(12))
@given(name=texts, notes=texts, key=st.from_regex(r"[a-z]{3,8}_[0-9]", fullmatch=True), extra=texts)
def test_any_text_of_the_header_is_kept(name: str, notes: str, key: str, extra: str) -> None:
    file = ParameterFile(load_schema("9pc"))
    file.header.name, file.header.notes, file.header.extra[key] = name, notes, extra
    first = content_of(file)
    again = read_content(HERE, first)
    assert (name, notes, extra) == (again.header.name, again.header.notes, again.header.extra[key])
    assert first == content_of(again, first)


@pytest.mark.parametrize("sign", ["\x85", "\u2028", "\u2029", "\ufeff", "\r"])
@pytest.mark.parametrize("told", ["{}", "a{}b", "a{} b", "a {}"])
def test_rare_line_ends_survive_a_save_that_does_not_touch_them(sign: str, told: str) -> None:
    """In a file with remarks, where what did not change is written as it was read: in texts,
    lists and mappings.
    """
    file, told = ParameterFile(load_schema("9pc")), told.format(sign)
    file.header.notes, file.header.extra["made_by"] = told, {"lines": [told, "plain"], told: "#"}
    file.unknown["other.text"] = told
    first = content_of(file)
    again = read_content(HERE, first)
    assert content_of(again, first) == first
    assert (again.header.notes, again.header.extra, again.unknown) == (
        file.header.notes,
        file.header.extra,
        file.unknown,
    )


@pytest.mark.parametrize("sign", ["\x85", "\u2028", "\u2029"])
def test_a_line_end_that_no_editor_shows_is_refused(sign: str) -> None:
    """Readers of YAML differ on it: what comes after it on the screen would be a separate entry."""
    content = content_of(ParameterFile(load_schema("9pc"))).decode("utf-8")
    with pytest.raises(ParameterFileError, match=f"character U.{ord(sign):04X} has no place") as error:
        read_content(HERE, content.replace("amp_studio: 1", f"name: a{sign}b\namp_studio: 1").encode())
    assert error.value.line == content[: content.index("amp_studio: 1")].count("\n") + 1


@given(st.floats(allow_nan=False, allow_infinity=False), st.sampled_from(["mm", "in", "deg"]))
def test_any_number_is_kept_exactly(number: float, unit: str) -> None:
    file = ParameterFile(load_schema("9pc"))
    file.set(("home.calibration", "1"), Value(number, unit))
    assert file.values == read_content(HERE, content_of(file)).values
