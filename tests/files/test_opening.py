"""Opening a file: understood whole, kept whole, or refused with file and line."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.files import ParameterFile, ParameterFileError, open_file, read_content
from amp_studio.schema import Value
from tests.files.commented import COMMENTED, edited

HERE = Path("small.amp")


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
        ("1.5 mm", "1,500 mm", 6, "home.calibration@1: '1,500' can be read two ways: write 1500 or 1.5000"),
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
        (
            "family: 9pc",
            "family: 9pc\nforced: [home.calibration@1]",
            3,
            "'forced' is not a list of parameters",
        ),
        (
            "  control.type: Mill",
            "\tcontrol.type: Mill",
            4,
            "is not readable: found character that cannot start any token",
        ),
        ("...", "...\n---\nfamily: 9pc\n...", 10, "is not readable: something comes after its end"),
        ("...", "", 10, "ends without its end mark '...': it has been cut off"),
        (
            "control.type: Mill",
            "control.type: Grinder",
            4,
            "control.type: 'Grinder' is not a choice of Control Type",
        ),
    ],
)
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
