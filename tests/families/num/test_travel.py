"""Every worked number of chapters 6 and 7 of the NUM manual that is a word: masks,
and the values of its examples.
"""

import math

import pytest

from amp_studio.families.num import formulas as num
from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import Value, field_at, field_value, load_schema, write_value


@pytest.fixture
def file() -> ParameterFile:
    return new_file("num")


@pytest.mark.parametrize(
    ("word", "axes", "printed"),
    [
        pytest.param("P20N0", range(7), "0000007F", id="6-12 axes 0 to 6 are reversed"),
        pytest.param("P15N0", [1], "00000002", id="7-8 axis 1 homes in the negative direction"),
        pytest.param("P15N1", [0, 2], "00000005", id="7-8 axes 0 and 2 have no datum switch"),
    ],
)
def test_a_mask_has_the_bit_of_each_axis(file: ParameterFile, word: str, axes, printed: str) -> None:
    address = file.find(word)
    parameter = file.schema.parameter(address[0])
    number = sum(1 << axis for axis in axes)
    assert write_value(parameter, Value(number)) == f"0x{printed}"
    bits = [axis for axis in range(32) if field_value(field_at(parameter, axis), int(printed, 16))]
    assert bits == list(axes)
    assert file.evaluation.find_bit(f"{word}.5") == (address, 5)


@pytest.mark.parametrize(
    ("word", "value", "unit", "parameter"),
    [
        pytest.param("P21N0", 4915, "", "servo.loop_gain@0", id="6-14"),
        pytest.param("P56N0", 60, "ms", "servo.group_time_constant@1", id="6-18 word N0 is group 1"),
        pytest.param("P23N0", 6600, "iu", "servo.max_following_error@0", id="6-22"),
        pytest.param("P33N0", 3600, "mm/min", "servo.approach_speed@0", id="6-36"),
        pytest.param("P32N63", 1000, "mm/s2", "servo.acceleration_fast@31", id="6-10 fast speed of axis 31"),
        pytest.param("P55N8", 5, "", "servo.filter_terms@1", id="6-26 words N0 and N8 are of group 1"),
        pytest.param("P24N63", 250, "", "servo.sync_correction@31", id="6-30"),
        pytest.param("P24N64", 600, "iu", "servo.sync_error_largest", id="6-30 threshold 2"),
        pytest.param("P19N95", 5000, "ms/100", "servo.friction_time@31", id="6-34"),
        pytest.param("P31N4", 1000, "deg/min", "servo.reduced_speed_rotary", id="6-8"),
        pytest.param("P17N63", 500, "iu", "travel.limit_max@31", id="7-12"),
    ],
)
def test_a_word_is_found_by_its_number_and_has_its_unit(
    file: ParameterFile, word: str, value: int, unit: str, parameter: str
) -> None:
    address = file.find(word)
    assert address == file.find(parameter)
    assert file.read(address, str(value)) == Value(value, unit)


def test_hundredths_of_a_ms_can_be_given_in_ms(file: ParameterFile) -> None:
    """5000 hundredths (page 6-34) are 50 ms."""
    address = file.find("P19N64")
    file.set(address, file.read(address, "50 ms"))
    assert file.evaluation.canonical(address) == 50.0
    file.set(address, file.read(address, "5000"))
    assert file.evaluation.canonical(address) == 50.0


def test_6_11_words_48_to_54_are_those_of_a_spindle_where_p6_declares_it(file: ParameterFile) -> None:
    assert file.find("P32N48") == ("servo.acceleration_work", "24")
    file.set(("spindle.measured", ""), Value(0b0101))
    assert file.find("P32N48") == ("servo.spindle_acceleration", "1")
    assert file.find("P32N50") == ("servo.acceleration_work", "25")
    assert file.find("P32N52") == ("servo.spindle_acceleration", "3")
    assert file.find("P32N54") == ("servo.acceleration_work", "27")
    assert file.find("P32N46") == ("servo.acceleration_work", "23")
    assert file.find("P32N56") == ("servo.acceleration_work", "28")
    assert file.find("P32N49") == ("servo.acceleration_fast", "24")


def test_4_12_a_modulo_axis_has_no_travel_limits(file: ParameterFile) -> None:
    file.set(("axes.modulo", ""), Value(0b100))
    states = [file.evaluation.state(("travel.limit_min", axis)).state for axis in ("1", "2")]
    assert states == ["in-force", "ignored"]


def test_each_address_and_group_of_these_chapters_has_its_word() -> None:
    """Numbers of words: pages 6-6 to 6-40 and 7-8 to 7-14; P55 has sixteen (erratum e-p55-words)."""
    schema = load_schema("num")
    words: dict[str, set[int]] = {}
    for key in ("servo_control", "axis_travel"):
        for parameter in next(group for group in schema.groups if group.key == key).parameters:
            for number in schema.on("cnc").numbers(parameter).values():
                head, _, n = number.partition("N")
                words.setdefault(head, set()).add(int(n))
    counts = {
        "P30": 32,
        "P31": 5,
        "P32": 64,
        "P20": 1,
        "P21": 32,
        "P56": 8,
        "P22": 32,
        "P23": 32,
        "P57": 32,
        "P55": 16,
        "P24": 65,
        "P52": 1,
        "P19": 96,
        "P33": 32,
        "P53": 1,
        "P66": 32,
        "P15": 2,
        "P16": 32,
        "P17": 64,
        "P18": 32,
    }
    assert {head: set(range(count)) for head, count in counts.items()} == words


# ------------------------------------------------------------------------------------- formulas


def test_7_12_the_travel_lies_between_the_limits() -> None:
    assert num.axis_travel(-1000.0, 500000.0) == 501000.0
    assert num.axis_travel(500.0, 200.0) == -300.0


@pytest.mark.parametrize(("value", "correction"), [(3.0, 3.0), (-3.0, -3.0), (0.0, 0.0)])
def test_7_14_the_sign_of_the_backlash_is_that_of_the_correction_on_a_positive_move(
    value: float, correction: float
) -> None:
    assert num.backlash_on_positive_move(value) == correction


@pytest.mark.parametrize(
    "asked", [lambda: num.axis_travel(0.0, math.nan), lambda: num.backlash_on_positive_move(math.inf)]
)
def test_an_argument_that_makes_no_sense_is_refused(asked) -> None:
    with pytest.raises(ValueError, match="finite number"):
        asked()
