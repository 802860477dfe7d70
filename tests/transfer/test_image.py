"""The control image: what is written reads back the same, and what is damaged is refused."""

from functools import cache

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import Value
from amp_studio.schema.storage import stored_number
from amp_studio.transfer.image import ImageError, PatchError, decode_image, encode_image, patch_image
from tests.campaigns import examples


def a_file() -> ParameterFile:
    """A mill with three axes and values in both unit systems."""
    file = new_file("9pc", "mill", ["X", "Y", "B"])
    for number, text in {
        "1030": "sercos",
        "1031": "digital",
        "1350": "10 ipm",
        "1300": "0,1 in",
        "2300": "1.1 mm",
    }.items():
        address = file.find(number)
        file.set(address, file.read(address, text))
    return file


def test_an_image_reads_back_as_the_same_values() -> None:
    """Every value comes back exactly, in the unit it was entered in."""
    file = a_file()

    at_control = decode_image(encode_image(file))

    assert at_control.values == file.values
    assert at_control.values[("home.speed_off_switch", "1")] == Value(10.0, "in/min")
    assert encode_image(at_control) == encode_image(file)


def test_the_page_shows_the_form() -> None:
    """The records of docs/protocols/image.md are in an image like that."""
    lines = encode_image(a_file()).decode().splitlines()

    assert lines[:2] == ["AMP-IMAGE 1", "family 9pc"]
    assert "1350\thome.speed_off_switch@1\t10 in/min" in lines
    assert "1510\tservo.position_loop_type@1\traw:1" in lines
    assert "-\tservo.velocity_port@1\tnone" in lines
    assert lines[-1] == f"end {len(lines) - 7}"


def test_an_image_cut_off_anywhere_is_refused() -> None:
    """No beginning of an image is taken for a whole one."""
    image = encode_image(a_file())

    for length in [*range(0, len(image), 97), len(image) - 1]:
        with pytest.raises(ImageError):
            decode_image(image[:length])


def test_an_image_of_another_schema_is_refused() -> None:
    """The signature guards against a number that means another parameter."""
    file = a_file()
    image = encode_image(file).replace(file.schema.signature.encode(), b"0" * 64)

    with pytest.raises(ImageError, match="another schema"):
        decode_image(image)


an_image = cache(lambda: encode_image(a_file()))


@settings(max_examples=examples(200))
@given(st.binary(max_size=200), st.integers(0, 5000))
def test_damage_never_raises_anything_else(junk: bytes, at: int) -> None:
    """Whatever is written over an image, it is read or refused in one sentence."""
    image = bytearray(an_image())
    image[at : at + len(junk)] = junk
    said = ""
    try:
        decode_image(bytes(image))
    except ImageError as error:
        said = str(error)
    assert "\n" not in said


def test_a_value_keyed_in_at_the_control_is_in_its_own_unit() -> None:
    """Patch AMP speaks mm/s where the editor speaks mm/min, and stored codes of choices (page 37-3)."""
    image = encode_image(a_file())

    at_control = decode_image(patch_image(patch_image(image, "1350", "4.23333"), "1002", "1"))

    assert at_control.values[("home.speed_off_switch", "1")] == Value(4.23333, "mm/s")
    assert at_control.values[("home.direction_off_switch", "1")] == Value("positive")


def test_a_number_the_control_does_not_offer_is_refused() -> None:
    """Not every parameter can be patched (page 37-2)."""
    for number in ("1540", "9999", "1030"):
        with pytest.raises(PatchError, match="PARAMETER NUMBER NOT FOUND"):
            patch_image(encode_image(a_file()), number, "1")


def test_a_code_that_no_choice_has_is_kept() -> None:
    """The control checks nothing, so an upload may hold any code."""
    at_control = decode_image(patch_image(encode_image(a_file()), "1510", "77"))

    assert at_control.values[("servo.position_loop_type", "1")] == Value("raw:77")
    assert decode_image(encode_image(at_control)).values == at_control.values


@pytest.mark.parametrize(
    ("number", "text", "stored"),
    [
        ("1350", "10160 mm/min", 169.3333),  # page 37-3 prints mm/sec with four decimals
        ("1203", "10160 mm/min", 169.33333),
        ("1002", "Negative direction off switch", -1),  # the codes do not follow the letters
        ("1595", "Minus", -1),
        ("1020", "True", 1),
        ("1750", "1 in", 25.4),
    ],
)
def test_what_the_control_stores_for_a_value(number: str, text: str, stored: float) -> None:
    """The patch value of a value, as page 37-3 and its table print it."""
    file = a_file()
    address = file.find(number)
    parameter = file.schema.parameters[address[0]]

    assert stored_number(parameter, file.read(address, text), turns=False) == stored
