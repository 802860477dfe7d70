"""Values as 16-bit registers hold them: what fits, what comes back,
and how far it may be from what was written.
"""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.families.servo57c422b.formats.word_text import read_word, write_hexadecimal
from amp_studio.schema import InvalidValueError, Parameter, Schema, Value, load_schema, read_value
from amp_studio.schema.storage import (
    StorageError,
    exact,
    is_signed,
    register_number,
    value_of_register,
    value_of_words,
    words_of,
)

MODULE = load_schema("57c422b")
NUMBERS = [p for p in MODULE.parameters.values() if p.type in ("integer", "real", "bits")]


def unit_of(parameter: Parameter) -> str:
    return MODULE.units_of(parameter)[0]


def span(parameter: Parameter) -> tuple[int, int]:
    """Return the smallest and the largest number the registers hold."""
    bits = parameter.storage.bits
    return (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) if is_signed(parameter) else (0, 2**bits - 1)


@given(data=st.data(), parameter=st.sampled_from(NUMBERS))
def test_every_word_a_register_can_hold_comes_back_as_it_was(
    data: st.DataObject, parameter: Parameter
) -> None:
    number = data.draw(st.integers(*span(parameter)))
    value = value_of_register(parameter, number, unit_of(parameter))
    assert register_number(parameter, value, unit_of(parameter)) == number
    assert (
        value_of_words(parameter, words_of(parameter, value, unit_of(parameter)), unit_of(parameter)) == value
    )


@given(data=st.data(), parameter=st.sampled_from([p for p in NUMBERS if p.type == "real"]))
def test_a_value_comes_back_within_half_a_count_of_its_register(
    data: st.DataObject, parameter: Parameter
) -> None:
    low, high = (n / parameter.storage.scale for n in span(parameter))
    value = Value(data.draw(st.floats(low, high)), parameter.storage.unit or "")
    number = register_number(parameter, value, unit_of(parameter))
    assert abs(exact(value.value) * exact(parameter.storage.scale) - number) <= Fraction(1, 2)
    back = value_of_register(parameter, number, unit_of(parameter))
    nearest = float(number / exact(parameter.storage.scale))
    assert back.value == nearest or len(repr(back.value)) < len(repr(nearest)), (
        "the nearest double, or a shorter number"
    )
    assert register_number(parameter, back, unit_of(parameter)) == number


@given(st.integers(0, 2**32 - 1))
def test_bits_are_read_as_they_are_written(pattern: int) -> None:
    assert read_word(write_hexadecimal(pattern)) == (pattern, True)


@pytest.mark.parametrize(
    ("name", "text", "number", "words"),
    [
        (
            "command.velocity",
            "160000 counts/s",
            10485760,
            (0x00A0, 0x0000),
        ),  # 40.0 * 4000 * 65.536 (page 4-48)
        ("command.acceleration", "50000 counts/s2", 3277, (0x0000, 0x0CCD)),  # 3276.8 (page 4-48)
        ("command.position", "80000 counts", 80000, (0x0001, 0x3880)),  # 20 * 4000 (page 4-48)
        ("command.gear_ratio", "1", 16777216, (0x0100, 0x0000)),  # page 5-5
        ("output.max_voltage", "10 V", 1984, (1984,)),  # page 4-17
        ("command.direct_reference", "-10 V", -1984, (0xF840,)),  # page 4-16
        ("output.linearization_positive", "-1", -1, (0xFFFF,)),  # page 4-18
        ("cam.position_points", "80000 counts", 80000, (0x3880, 0x0001)),  # even register lower (page 4-57)
        ("cam.time", "0.0025 s", 2, (2,)),  # scans of 1.25 ms (page 4-54)
    ],
)
def test_engineering_units_become_the_words_of_the_manual(
    name: str, text: str, number: int, words: tuple[int, ...]
) -> None:
    parameter = MODULE.parameter(name)
    value = read_value(parameter, text, unit_of(parameter))
    assert register_number(parameter, value, unit_of(parameter)) == number
    assert words_of(parameter, value, unit_of(parameter)) == words


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("r.gain", Value(32768), "32768 does not fit the 16 bits of Gain, -32768 to 32767"),
        ("r.limit", Value(-1, "counts"), "-1 does not fit the 16 bits of Limit, 0 to 65535"),
        ("r.byte", Value(128), "128 does not fit the 8 bits of Byte, -128 to 127"),
        ("r.setup", Value(65536), "65536 does not fit the 16 bits of Setup, 0 to 65535"),
        ("r.slow", Value(32768000.0, "counts/s"), "2147483648 does not fit the 32 bits of Slow"),
        ("r.fast", Value(65536000.0, "counts/s"), "4294967296 does not fit the 32 bits of Fast"),
        ("r.volts", Value(1.0, "ms"), "Volts is stored in V, not in ms"),
        ("r.version", Value("1.0"), "Version is a text"),
        ("r.sense", Value("odd"), "no code is printed for 'Odd' of Sense"),
    ],
)
def test_what_a_register_cannot_hold_is_told(module: Schema, name: str, value: Value, said: str) -> None:
    parameter = module.parameter(name)
    with pytest.raises(StorageError, match=said):
        register_number(parameter, value, module.units_of(parameter)[0])


def test_choices_are_their_codes(module: Schema) -> None:
    sense, marker = module.parameter("r.sense"), module.parameter("r.marker")
    assert [words_of(sense, Value(key), "") for key in ("up", "down", "raw:7")] == [(1,), (0xFFFF,), (7,)]
    assert [value_of_words(sense, (word,), "") for word in (1, 0xFFFF, 7)] == [
        Value("up"),
        Value("down"),
        Value("raw:7"),
    ]
    assert [value_of_words(marker, (word,), "") for word in (1, 0)] == [Value(True), Value(False)]
    assert words_of(marker, Value(False), "") == (0,)


@pytest.mark.parametrize("text", ["", "FFH", "0x14", "1.5", "1e3", "-0FH", "12 34", "65536.*256.", "PGAIN%"])
def test_what_is_no_whole_number_is_told(text: str) -> None:
    with pytest.raises(InvalidValueError, match="is no whole number"):
        read_word(text)
