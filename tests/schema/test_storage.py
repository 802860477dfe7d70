"""What a control stores for a value: exact until the last rounding, and the same both ways."""

from fractions import Fraction

import pytest

from amp_studio.schema import Parameter, Value
from amp_studio.schema.storage import (
    StorageError,
    from_stored,
    stored_number,
    stored_range,
    to_stored,
    value_of_stored,
)


def parameter(**words: object) -> Parameter:
    """Return a parameter of which only its type and storage matter."""
    return Parameter.model_validate(
        {"id": "a.b", "name": "Gain", "type": "real", "help": {"what": "x"}, "page": "1", **words}
    )


SCANS = parameter(storage={"unit": "counts/s", "scale": 65.536})
SENSE = parameter(
    type="choice", choices=[{"key": "up", "label": "Up", "raw": 1}, {"key": "down", "label": "Down"}]
)


def test_a_number_is_stored_exactly_and_not_as_the_product_of_doubles() -> None:
    assert to_stored(SCANS, Value(0.1, "counts/s"), "counts/s") == Fraction(65536, 10000)
    inches = parameter(storage={"unit": "mm"})
    assert stored_number(inches, Value(0.3, "in"), turns=False) == 7.62
    assert 0.3 * 25.4 != 7.62, "which is what doubles make of it"


def test_what_is_keyed_in_means_the_value_that_is_stored_so() -> None:
    value = Value(160000.0, "counts/s")
    assert stored_number(SCANS, value, turns=False) == 10485760.0
    assert value_of_stored(SCANS, 10485760.0, turns=False) == value


def test_a_length_is_stored_in_degrees_on_an_axis_that_turns() -> None:
    length = parameter(storage={"unit": "mm", "decimals": 2})
    assert stored_number(length, Value(1.005, "deg"), turns=True) == 1.0
    assert value_of_stored(length, 90.0, turns=True) == Value(90.0, "deg")
    assert stored_number(length, Value(1.0, "mm"), turns=True) is None


def test_a_choice_is_its_code_and_an_unknown_code_is_kept() -> None:
    assert stored_number(SENSE, Value("up"), turns=False) == 1
    assert stored_number(SENSE, Value("down"), turns=False) is None
    assert from_stored(SENSE, 1, "") == Value("up")
    assert from_stored(SENSE, 9, "") == Value("raw:9")


@pytest.mark.parametrize("number", [1e308, 1e-323])
def test_a_stored_number_that_no_double_can_be_is_no_value(number: float) -> None:
    tiny = parameter(storage={"scale": 1e-10 if number > 1 else 1e10})
    with pytest.raises(StorageError, match="Gain cannot have a number of that size"):
        from_stored(tiny, number, "")


def test_a_value_beyond_all_doubles_is_shown_as_infinite_and_does_not_end_the_program() -> None:
    assert stored_number(parameter(storage={"unit": "um"}), Value(1e308, "in"), turns=False) == float("inf")


@pytest.mark.parametrize(
    ("storage", "span"),
    [
        ({"bits": 8}, (-128, 127)),
        ({"bits": 8, "signed": False}, (0, 255)),
        ({"words": 2}, (-(2**31), 2**31 - 1)),
    ],
)
def test_what_is_stored_fits_the_bits_or_else_the_registers(
    storage: dict[str, object], span: tuple[int, int]
) -> None:
    assert stored_range(parameter(storage=storage)) == span
    assert stored_range(parameter(type="bits", bits=[], storage={"bits": 8})) == (0, 255)
