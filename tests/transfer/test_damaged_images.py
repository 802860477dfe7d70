"""What a control may hold instead of an image: each is refused in a sentence that names the entry,
and nothing else happens.
"""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import Value, family_ids
from amp_studio.transfer.image import ImageError, PatchError, decode_image, encode_image, patch_image
from tests.campaigns import CAMPAIGN, some

from .image_mutations import fault_of, mutants


def small(family: str) -> ParameterFile:
    """Return a file with the first values of a family, and a text in each parameter that takes one."""
    file = new_file(family)
    machine = file.schema.family.machine_parameter
    for address in list(file.values)[30:]:
        if address[0] != machine and file.schema.parameters[address[0]].type != "format":
            del file.values[address]
    for parameter in file.schema.parameters.values():
        instances = file.machine_schema.instances(parameter)
        if parameter.type == "text" and instances:
            file.values[parameter.id, instances[0]] = Value("X")
    file.evaluation.forget()
    file.header.application, file.header.revision = "Mill Lathe", "3.05"
    return file


def mill(entry: str = "", line: str = "") -> bytes:
    """Return the image of a mill with one line changed: that of an address, or that of a key of the head."""
    file = new_file("9pc", "mill", ["X", "Y"])
    file.set(file.find("1350"), Value(10.0, "in/min"))
    lines = encode_image(file).decode().split("\n")
    if entry:
        [at] = [n for n, old in enumerate(lines) if entry in (*old.split("\t")[1:2], old.partition(" ")[0])]
        lines[at] = line
    return "\n".join(lines).encode()


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("1300\thome.calibration@1\t5", "home.calibration@1 .*'5' has no unit"),
        ("1300\thome.calibration@1\tnan mm", "home.calibration@1 .*'nan mm' is not a number"),
        ("1300\thome.calibration@1\tinf mm", "home.calibration@1 .*not a number"),
        ("1300\thome.calibration@1\t1e999 mm", "home.calibration@1 .*too large"),
        ("1300\thome.calibration@1\ttext:five mm", "home.calibration@1 .*no value of it"),
        ("1300\thome.calibration@1\traw:5", "home.calibration@1 .*not a number"),
        ("1300\thome.calibration@1\t5 deg/min", "home.calibration@1 .*given in mm"),
        ("1300\thome.calibration@1\t5 furlong", "home.calibration@1 .*'furlong' is not a unit"),
        (
            "1300\thome.calibration@1\t5.0 mm",
            "'1300 home.calibration@1 5.0 mm', which would be written '1300 home",
        ),
        ("1300\thome.calibration@1\t5 millimeter", "which would be written"),
        ("1300\thome.calibration@1\t", "home.calibration@1 .*not a number"),
        ("1300\thome.calibration@1\t" + "7" * 5000, "home.calibration@1 .*no value of it"),
        ("1300\thome.calibration@99\t5 mm", "what does not exist: Home Calibration has no instance '99'"),
        ("1300\thome.calibration\t5 mm", "what does not exist: Home Calibration has no instance ''"),
        ("1300\thome.calibration@2\t5 mm", "home.calibration@2 twice"),
        ("1300\thome.calibration@1@1\t5 mm", "what does not exist: Home Calibration has no instance '1@1'"),
        ("1300\tno.such@1\t5 mm", "'no.such@1', which the schema does not have"),
        ("1301\thome.calibration@1\t5 mm", "which would be written '1300 home.calibration@1 5 mm'"),
        ("home.calibration@1\t5 mm", "line .* .home.calibration@1. is not number, address and value"),
        ("1300\thome.calibration@1\t5 mm\t", "line .* .home.calibration@1. is not number, address and value"),
        ("1300\thome.calibration@1\t5\x1b[2J mm", "line .*control character"),
        ("1300\thome.calibration@1\t5 mm\r", "line .*control character"),
    ],
)
def test_a_damaged_number_names_its_entry(line: str, message: str) -> None:
    """A number has its unit, in the one form it is written in, at an instance that exists, once."""
    with pytest.raises(ImageError, match=message) as caught:
        decode_image(mill("home.calibration@1", line))

    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 300


@pytest.mark.parametrize(
    "number", ["2.5", "1e300", "9007199254740993", "0x10", "nan", "inf", "-1e999", "٣", "1 000"]
)
def test_a_whole_number_is_one(number: str) -> None:
    """Whole numbers of a module are whole, exact and written plainly."""
    file = new_file("57c422b")
    address = next(a for a in file.addresses() if file.schema.parameters[a[0]].type == "integer")
    unit = file.schema.units_of(file.schema.parameters[address[0]])[0]
    file.values = {address: Value(0, unit)}
    file.evaluation.forget()
    image = encode_image(file)
    line = next(line for line in image.decode().split("\n") if "\t" in line)

    with pytest.raises(ImageError, match=f"{address[0]}@{address[1]}"):
        decode_image(
            image.replace(line.encode(), f"{line.rpartition(chr(9))[0]}\t{number} {unit}".rstrip().encode())
        )


@pytest.mark.parametrize(
    "code",
    [
        "linear",
        "raw:",
        "raw:x",
        "raw:01",
        "raw:+1",
        "raw:1.5",
        "raw:²",
        "yes",
        "Linear",
        "text:linear",
        "1",
        "",
    ],
)
def test_a_choice_is_its_code_and_nothing_else(code: str) -> None:
    """Labels, letters and other spellings of a code are not what a control contains."""
    with pytest.raises(ImageError, match=r"servo\.position_loop_type@1"):
        decode_image(mill("servo.position_loop_type@1", f"1510\tservo.position_loop_type@1\t{code}"))


@pytest.mark.parametrize("digits", [400, 5_000])
def test_a_code_of_thousands_of_digits_is_no_code(digits: int) -> None:
    with pytest.raises(ImageError, match=r"servo\.position_loop_type@1") as caught:
        decode_image(
            mill("servo.position_loop_type@1", f"1510\tservo.position_loop_type@1\traw:{'9' * digits}")
        )
    assert len(str(caught.value)) < 300


@pytest.mark.parametrize(
    ("key", "line", "message"),
    [
        ("machine", "machine submarine", "machine type 'submarine'"),
        ("machine", "machine lathe", "'machine lathe', which would be written 'machine mill'"),
        ("machine", "machine ", "machine type ''"),
        ("machine", "maschine mill", "line 4 of the control image is not its machine"),
        ("family", "family ../../../tmp/mine", "family '../../../tmp/mine', which is not known"),
        ("family", "family /etc", "family '/etc', which is not known"),
        ("family", "family ", "family '', which is not known"),
        ("family", "family 9PC", "family '9PC', which is not known"),
        ("revision", "revision a\\", "'revision a\\\\', which would be written"),
        ("revision", "revision \x00", "line 6 .*control character"),
        ("application", "application\tMill", "line 5 of the control image is not its application"),
        ("signature", "signature ", "another schema"),
    ],
)
def test_junk_in_the_head_is_named(key: str, line: str, message: str) -> None:
    """The family is never taken for a path, and the machine type is one of the family's."""
    with pytest.raises(ImageError, match=message):
        decode_image(mill(key, line))


@pytest.mark.parametrize(
    "text", ["text:a\\", "text:\\q", "text:\\x41", "text:\\X1b", "text:a\tb", "plain", "raw:1", ""]
)
def test_a_text_is_escaped_as_it_is_written(text: str) -> None:
    """A lone backslash at the end, an escape nobody writes and a bare TAB are damage."""
    file = small("syntec")
    image = encode_image(file).replace(b"axis.name@1\ttext:X", b"axis.name@1\t" + text.encode())

    with pytest.raises(ImageError):
        decode_image(image)


@pytest.mark.parametrize(
    "text", ["", " ", "a\\", "\\n", "a\nb", "a\tb", "\r", "\x1b[2J", "\x85", "\u2028", "=1+1", "é", "\x00"]
)
def test_any_text_of_a_file_comes_back_from_its_image(text: str) -> None:
    """What a file can hold is carried, without a control character on the line."""
    file = small("syntec")
    file.values["axis.name", "1"] = Value(text)
    file.header.revision = text

    image = encode_image(file)

    assert not any(sign in image.decode().replace("\n", "") for sign in "\r\x1b\x85\x00")
    at_control = decode_image(image)
    assert at_control.values == file.values
    assert at_control.header.revision == text


def test_half_a_character_is_no_text_of_an_image() -> None:
    file = small("syntec")
    file.values["axis.name", "1"] = Value("\ud800")
    with pytest.raises(ImageError, match="half a character"):
        encode_image(file)


@pytest.mark.parametrize(
    "damaged",
    [
        "101\tpassword.character@1\t4711.0",
        "101\tpassword.character@1\t4711 mm",
        "101\tpassword.character@1\ttext:4711",
        "password.character@1\t4711",
        "101 password.character@1 4711",
        "102\tpassword.character@1\t4711",
        "101\tpassword.character@1\t4711\t",
    ],
)
def test_a_damaged_password_is_not_repeated(damaged: str) -> None:
    """The entry is named, what is there is not."""
    with pytest.raises(ImageError, match=r"password\.character@1") as caught:
        decode_image(mill("password.character@1", damaged))
    assert "4711" not in str(caught.value)


def test_records_stand_in_the_manuals_order() -> None:
    """Two images of the same values are the same bytes."""
    lines = mill().split(b"\n")
    lines[7], lines[8] = lines[8], lines[7]
    with pytest.raises(ImageError, match=r"line 8 of the control image is '.*', which would be written"):
        decode_image(b"\n".join(lines))


@pytest.mark.parametrize("family", some(family_ids(), 2))
def test_a_damaged_image_is_refused_or_is_one_that_comes_back_byte_for_byte(family: str) -> None:
    """Also by way of a parameter file; the seed gives the same damage each time."""
    image = encode_image(small(family))
    assert fault_of(image) == ""

    message = [fault_of(damaged) for damaged in mutants(image, seed=9, count=300)]

    assert sum(map(bool, message)) > 150
    assert len(set(message)) > min(100, 2 * image.count(b"\n"))


@pytest.mark.parametrize(
    "path", sorted((Path(__file__).parents[2] / "examples").glob("*/*.amp")), ids=lambda p: p.stem
)
def test_every_example_has_an_image_that_reads_back(path: Path) -> None:
    from amp_studio.files import open_file

    file = open_file(path).file
    image = encode_image(file)
    assert encode_image(decode_image(image)) == image


@pytest.mark.parametrize(
    ("number", "text"), [("1002", "1.5"), ("1002", "1e999"), ("1002", "x"), ("1350", "5 mm/s")]
)
def test_what_no_image_can_hold_cannot_be_keyed_in(number: str, text: str) -> None:
    """The control checks no range, but a fraction is no code and infinity no number."""
    with pytest.raises(PatchError):
        patch_image(mill(), number, text)


def test_every_value_that_can_be_keyed_in_reads_back() -> None:
    """Each number the control offers takes 1, in the unit it stores."""
    file = new_file("9pc", "mill", ["X", "B"])
    image = encode_image(file)
    patchable = [a for a in file.addresses() if file.schema.parameters[a[0]].patchable]
    numbers = {file.schema.on("mill").number(a): a for a in patchable}
    offered = [n for n, address in numbers.items() if n and file.find(n) == address]
    assert len(offered) > 500
    for number in offered[:: 1 if CAMPAIGN else 61]:
        assert decode_image(patch_image(image, number, "1")).values[numbers[number]] is not None
