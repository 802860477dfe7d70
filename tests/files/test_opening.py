"""Opening a file: understood whole, kept whole, or refused with file and line."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.files import ParameterFile, ParameterFileError, content_of, open_file, read_content, save_file
from amp_studio.schema import Value, load_schema

HERE = Path("small.amp")


def edited(path: Path, old: str, new: str) -> Path:
    """Change the text of a file as a person would."""
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    return path


def refused(path: Path) -> ParameterFileError:
    """Return how a file is refused; it is not touched by that."""
    before = path.read_bytes()
    with pytest.raises(ParameterFileError) as fault:
        open_file(path)
    assert before == path.read_bytes()
    assert (path, 1) == (fault.value.path, len(str(fault.value).splitlines()))
    return fault.value


def test_a_file_is_read_as_it_was_saved(on_disk: Path, mill: ParameterFile) -> None:
    opened = open_file(on_disk)
    assert mill.values == opened.file.values
    assert (mill.header, mill.forced, mill.unknown) == (
        opened.file.header,
        opened.file.forced,
        opened.file.unknown,
    )


def test_a_file_a_person_wrote_is_read(small: Path) -> None:
    file = open_file(small).file
    expected = {
        ("control.type", ""): Value("mill"),
        ("axis.type", "1"): Value("linear"),
        ("home.calibration", "1"): Value(1.5, "mm"),
        ("home.position", "1"): Value(0.25, "in"),
        ("axis.name", "1"): Value("x"),
    }
    assert (expected, "mill", "metric") == (file.values, file.machine, file.header.units)


@pytest.mark.parametrize(
    ("written", "name", "expected"),
    [
        ("zone.overtravel_used@1: true", ("zone.overtravel_used", "1"), Value(True)),
        ("zone.overtravel_used@1: 'False'", ("zone.overtravel_used", "1"), Value(False)),
        ("servo.velocity_gear_teeth@1: 0x10", ("servo.velocity_gear_teeth", "1"), Value(16)),
        ("servo.velocity_gear_teeth@1: 12", ("servo.velocity_gear_teeth", "1"), Value(12)),
        ("home.g30_position@1: 1,5mm", ("home.g30_position", "1"), Value(1.5, "mm")),
        ("home.g30_position@1: 10 deg", ("home.g30_position", "1"), Value(10.0, "deg")),
        ("feedrate.rapid@1: 2 in/s", ("feedrate.rapid", "1"), Value(2.0, "in/s")),
        ("servo.loop_type@1: c", ("servo.loop_type", "1"), Value("digital")),
        ("servo.loop_type@1: 'raw:77'", ("servo.loop_type", "1"), Value("raw:77")),
    ],
)
def test_a_value_may_be_written_in_every_form_that_is_clear(
    small: Path, written: str, name, expected: Value
) -> None:
    edited(small, "...", f"  {written}\n...")
    assert expected == open_file(small).file.values[name]


# -- cut off ---------------------------------------------------------------------------------------------


def test_a_file_cut_off_at_any_byte_is_refused_or_whole(small: Path) -> None:
    content = small.read_bytes()
    whole = read_content(small, content).values
    for length in range(len(content)):
        if content[:length] + b"\n" == content:  # only the last line end is missing
            assert whole == read_content(small, content[:length]).values
            continue
        with pytest.raises(ParameterFileError):
            read_content(small, content[:length])


def test_a_file_cut_off_in_a_letter_of_two_bytes_is_refused(small: Path) -> None:
    edited(small, "family: 9pc", "family: 9pc\nnotes: für Prüfstand °")
    content = small.read_bytes()
    for length in range(len(content) - 1):
        with pytest.raises(ParameterFileError):
            read_content(small, content[:length])


def test_a_saved_file_cut_off_at_a_line_end_says_so(on_disk: Path) -> None:
    lines = on_disk.read_bytes().splitlines(keepends=True)
    for count in range(3, len(lines) - 1, 40):
        with pytest.raises(ParameterFileError, match="it has been cut off"):
            read_content(on_disk, b"".join(lines[:count]))


# -- refused -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new", "line", "said"),
    [
        ("axis.name@1: X", "axis.type@1: rotary", 8, "'axis.type@1' occurs twice"),
        ("axis.name@1: X", "control.type@: Lathe", 8, "'control.type' occurs twice"),
        ("axis.name@1: X", "1300: 5\n  '1300': 6", 9, "'1300' occurs twice"),
        ("amp_studio: 1", "amp_studio: 2", 1, "was written by a newer AMP Studio (file format 2, known: 1)"),
        ("amp_studio: 1", "amp_studio: one", 1, "'one' is no version of the file format"),
        ("amp_studio: 1", "amp_studio: true", 1, "'true' is no version of the file format"),
        ("amp_studio: 1", "amp_studio: 1.0", 1, "'1.0' is no version of the file format"),
        ("amp_studio: 1\n", "", None, "is not an AMP Studio parameter file"),
        ("family: 9pc", "family: 9pd", 2, "Unknown family '9pd'. Known: 57c422b, 9pc, acromill"),
        ("family: 9pc\n", "", None, "names no control family"),
        ("1.5 mm", "much mm", 6, "home.calibration@1: 'much mm' is not a number"),
        ("1.5 mm", "1,500 mm", 6, "home.calibration@1: '1,500' can be read two ways: write 1500 or 1.500"),
        ("1.5 mm", "1.5", 6, "home.calibration@1: '1.5' has no unit: write 1.5 mm"),
        ("1.5 mm", "1.5 kg", 6, "home.calibration@1: 'kg' is not a unit; Home Calibration is given in mm"),
        ("1.5 mm", "1.5 mm/min", 6, "home.calibration@1: Home Calibration is given in mm, not in mm/min"),
        ("1.5 mm", "[1.5, mm]", 6, "home.calibration@1 has no single value"),
        ("1.5 mm", "", 6, "home.calibration@1 has no single value"),
        ("1.5 mm", "2001-12-14", 6, "home.calibration@1: '-12-14' is not a unit"),
        ("1.5 mm", "2001-13-34", 6, "home.calibration@1: '-13-34' is not a unit"),
        ("1.5 mm", "'1.5 mm", 9, "is not readable: found unexpected document indicator"),
        ("1.5 mm", "!!python/object:os.system 1", 6, "is not readable: it uses a YAML tag"),
        ("linear", "square", 5, "axis.type@1: 'square' is not a choice of Axis Type"),
        ("values:", "values:\n  - 5\nvalue:", 4, "is not a list of parameters with values"),
        ("family: 9pc", "family: 9pc\nunits: cubits", 3, "units is 'cubits'; known here: metric, inch"),
        ("family: 9pc", "family: 9pc\nmachine: grinder", 3, "machine is 'grinder'; known here: lathe, mill"),
        ("family: 9pc", "family: 9pc\nforced: [home.calibration@1]", 3, "'forced' is not a list of parameters"),
        ("  control.type: Mill", "\tcontrol.type: Mill", 4, "is not readable: found character that cannot start any token"),
        ("...", "...\n---\nfamily: 9pc\n...", 10, "is not readable: something comes after its end"),
        ("...", "", 10, "ends without its end mark '...': it has been cut off"),
        ("control.type: Mill", "control.type: Grinder", 4, "control.type: 'Grinder' is not a choice of Control Type"),
    ],
)  # fmt: skip
def test_what_is_not_understood_is_refused_with_its_line(
    small: Path, old: str, new: str, line: int | None, said: str
) -> None:
    if old == "values:":
        small.write_text("amp_studio: 1\nfamily: 9pc\n# a list\nvalues:\n  - 5\n...\n", encoding="utf-8")
    else:
        edited(small, old, new)
    fault = refused(small)
    assert said in fault.what
    assert line == fault.line
    assert f"small.amp, line {line}: " in str(fault) or line is None


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "is not an AMP Studio parameter file"),
        (b"...\n", "is not readable"),
        (b"just a text\n...\n", "is not an AMP Studio parameter file"),
        (b"[1, 2, 3]\n...\n", "is not an AMP Studio parameter file"),
        (b"amp_studio: 1\nfamily: 9pc\nname: \xff\n...\n", "is not UTF-8 text"),
        (b"\xff\xfea\x00m\x00p\x00", "is not UTF-8 text"),
        (b"PK\x03\x04\x14\x00\x08\x08", "is not readable"),
        (b"\x00" * 64, "is not readable"),
        (b"amp_studio: 1\nfamily: 9pc\nvalues: " + b"[" * 5000, "is not readable"),
        (b"%PDF-1.7\n", "is not readable"),
    ],
)
def test_what_is_no_parameter_file_is_refused(tmp_path: Path, content: bytes, said: str) -> None:
    path = tmp_path / "other.amp"
    path.write_bytes(content)
    assert said in refused(path).what


def test_the_line_of_a_byte_that_is_no_text_is_told(small: Path) -> None:
    small.write_bytes(small.read_bytes().replace(b"linear", b"lin\xe9aire"))
    assert (refused(small).line, refused(small).what) == (5, "is not UTF-8 text")


def test_what_cannot_be_read_at_all_is_refused(tmp_path: Path) -> None:
    for path, said in ((tmp_path / "none.amp", "No such file"), (tmp_path, "Is a directory")):
        with pytest.raises(ParameterFileError, match=f"cannot be read: .*{said}"):
            open_file(path)


@given(st.binary(max_size=200))
def test_no_bytes_whatever_break_the_reader(content: bytes) -> None:
    with pytest.raises(ParameterFileError):
        read_content(HERE, content)


@given(st.integers(0, 999), st.binary(min_size=1, max_size=3))
def test_a_damaged_file_is_refused_or_read_and_never_breaks(at: int, noise: bytes) -> None:
    content = COMMENTED.encode()
    at %= len(content)
    try:
        said = read_content(HERE, content[:at] + noise + content[at:]).schema.family.family
    except ParameterFileError as fault:
        said = str(fault)
    assert said == "9pc" or said.startswith("small.amp")


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
        "amp_studio: 1\nfamily: two\nvalues:\n  control.type: Mill\n  plane.radius@1: 5\n  plane.radius: 7\n...\n"
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


COMMENTED = """\
# The bench of hall 4
amp_studio: 1
family: 9pc
# measured in spring
builder: {name: me, parts: [1, 2.50, yes]}
values:
  # the machine
  control.type: Mill   # not a lathe
  axis.type@1: linear
  # home, measured twice

  home.calibration@1: 1.5 mm   # +- 0.1
  # to be checked
  home.position@1: 0.25 in
  axis.name@1: X
  # end of the values
# end of the file
...
"""


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
    opened.file.set_many(
        {("home.calibration", "1"): Value(1e6, "mm")}, force="on a day by a test: 'quoted' # sign"
    )
    save_file(opened.file, small, opened.digest)
    assert open_file(small).file.forced == {("home.calibration", "1"): "on a day by a test: 'quoted' # sign"}


texts = st.text(st.characters(exclude_categories=["Cs"]), max_size=40)


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
    """In a file with remarks, where what did not change is written as it was read: in texts, lists and mappings."""
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
    """Readers of YAML differ on it: what stands behind it on the screen would be an entry of its own."""
    content = content_of(ParameterFile(load_schema("9pc"))).decode("utf-8")
    with pytest.raises(ParameterFileError, match=f"sign U.{ord(sign):04X} has no place") as error:
        read_content(HERE, content.replace("amp_studio: 1", f"name: a{sign}b\namp_studio: 1").encode())
    assert error.value.line == content[: content.index("amp_studio: 1")].count("\n") + 1


@given(st.floats(allow_nan=False, allow_infinity=False), st.sampled_from(["mm", "in", "deg"]))
def test_any_number_is_kept_exactly(number: float, unit: str) -> None:
    file = ParameterFile(load_schema("9pc"))
    file.set(("home.calibration", "1"), Value(number, unit))
    assert file.values == read_content(HERE, content_of(file)).values
