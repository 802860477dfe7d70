"""Words of chapters 4 and 5 of the NUM parameter manual: every example it prints, bit by bit."""

import pytest

from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import Address, field_at, field_value, load_schema

SCHEMA = load_schema("num")


@pytest.fixture
def file() -> ParameterFile:
    return new_file("num")


def put(file: ParameterFile, **words: int) -> None:
    """Set words by number."""
    for number, word in words.items():
        address = file.find(number)
        file.set(address, file.read(address, str(word)))


def state(file: ParameterFile, number: str) -> str:
    return file.evaluation.state(file.find(number)).state


@pytest.mark.parametrize(
    ("number", "word", "bits", "page"),
    [
        ("P2N0", 0x0000007F, range(7), "4-8"),
        ("P0N0", 0x0000007F, range(7), "4-10"),
        ("P3N0", 0x0000007F, range(7), "4-14"),
        ("P8N0", 0x00000019, (0, 3, 4), "4-22"),
        ("P28N0", 0x0000000E, (1, 2, 3), "4-32"),
        ("P64N0", 0x0000002D, (0, 2, 3, 5), "4-34"),
        ("P10N0", 0x00000044, (2, 6), "5-4"),
        ("P25N0", 0x0000007F, range(7), "5-14"),
    ],
)
def test_each_bit_of_a_mask_is_an_axis(
    file, number: str, word: int, bits: tuple[int, ...], page: str
) -> None:
    parameter = SCHEMA.parameter(file.find(number)[0])
    fields = [field_at(parameter, n) for n in range(32)]
    assert [field.label for field in fields] == [f"Axis {n}" for n in range(32)]
    assert [n for n in range(32) if field_value(fields[n], word)] == list(bits), f"page {page}"
    assert file.evaluation.find_bit(f"{number}.5") == (file.find(number), 5)


@pytest.mark.parametrize(
    ("number", "word", "labels"),
    [
        ("P4N0", 0x07, ["Group 1", "Group 2", "Group 3"]),
        ("P4N1", 0x05, ["Group 1", "Group 3"]),
        ("P4N3", 0x02, ["Group 2"]),
        ("P12N0", 0x05, ["Handwheel 1 at address 28", "Handwheel 3 at address 30"]),
    ],
)
def test_bits_of_groups_and_handwheels(file, number: str, word: int, labels: list[str]) -> None:
    """Pages 4-18 and 5-10."""
    parameter = SCHEMA.parameter(file.find(number)[0])
    assert [field.label for field in parameter.bits or () if field_value(field, word)] == labels


def message(parameter_id: str, bit: int, word: int) -> str:
    """Return the label of the code that is in a field of a word."""
    field = field_at(SCHEMA.parameter(parameter_id), bit)
    (label,) = [choice.label for choice in field.choices or () if choice.raw == field_value(field, word)]
    return label


@pytest.mark.parametrize(
    ("word", "name", "group"),
    [
        (0x00, "X", 1),
        (0x02, "Z", 1),
        (0x10, "X", 2),
        (0x15, "W", 2),
        (0x23, "U", 3),
        (0x25, "W", 3),
        (0x28, "C", 3),
    ],
)
def test_a_word_of_p9_is_a_group_and_a_name(word: int, name: str, group: int) -> None:
    """Page 4-24."""
    assert (message("axes.assignment", 0, word), message("axes.assignment", 4, word)) == (
        name,
        f"Group {group}",
    )


def test_ff_in_p9_is_neither() -> None:
    assert (message("axes.assignment", 0, 0xFF), message("axes.assignment", 4, 0xFF)) == ("none", "none")


def test_the_drive_axis_is_stored_as_its_address_and_none_as_ff() -> None:
    """Page 4-30."""
    raw = {choice.label: choice.raw for choice in SCHEMA.parameter("axes.drive_axis").choices or ()}
    assert (raw["No drive axis"], raw["Axis 0"], raw["Axis 31"], len(raw)) == (0xFF, 0, 31, 33)


def test_the_frame_of_the_stegmann_encoders() -> None:
    """Page 5-18: AG66 sends 12 bits, AG661 24, both one status bit."""
    parameter = SCHEMA.parameter("measure.sensor")
    for bits, code in ((12, 0b01100), (24, 0b11000)):
        word = 1 << 25 | code << 3 | 0b001
        assert message("measure.sensor", 25, word) == "absolute sensor with SSI serial transmission"
        assert [field_value(field_at(parameter, n), word) for n in (3, 0)] == [bits, 1]


@pytest.mark.parametrize(
    ("parameter_id", "bit", "labels"),
    [
        ("measure.channel_check", 4, ["32 µs", "16 µs", "8 µs", "4 µs", "2 µs", "1 µs", "500 ns", "250 ns"]),
        ("measure.sensor", 11, ["120 ns", "16 µs", "8 µs", "4 µs", "2 µs", "1 µs", "500 ns", "250 ns"]),
        (
            "measure.sensor",
            8,
            ["100 kHz", "200 kHz", "400 kHz", "500 kHz", "800 kHz", "1 MHz", "1.6 MHz", "2 MHz"],
        ),
        (
            "measure.sensor",
            25,
            [
                "incremental sensor",
                "absolute sensor with SSI serial transmission",
                "combined absolute encoder",
                "incremental rule with encoded reference marks",
            ],
        ),
    ],
)
def test_the_codes_of_a_field_are_those_of_its_table(parameter_id: str, bit: int, labels: list[str]) -> None:
    """Pages 5-16 and 5-18."""
    assert [message(parameter_id, bit, code << bit) for code in range(len(labels))] == labels


@pytest.mark.parametrize(
    ("address", "number"),
    [
        (("measure.multi", "0"), "P11N0"),
        (("measure.divi", "0"), "P11N1"),
        (("measure.multi", "31"), "P11N62"),
        (("measure.divi", "31"), "P11N63"),
        (("measure.handwheel_multi", "1"), "P13N0"),
        (("measure.handwheel_divi", "4"), "P13N7"),
        (("measure.handwheel_auto_multi", ""), "P13N8"),
        (("measure.handwheel_auto_divi", ""), "P13N9"),
        (("measure.handwheel_rotary_multi", "1"), "P13N10"),
        (("measure.handwheel_rotary_divi", "4"), "P13N17"),
        (("measure.graduation", "0"), "P36N0"),
        (("measure.graduations", "0"), "P36N32"),
        (("measure.graduations", "31"), "P36N63"),
        (("axes.group_machine", "1"), "P5N1"),
        (("qvn.rejection_89_zn", "3"), "P89N7"),
    ],
)
def test_a_word_is_addressed_by_its_number(file, address: Address, number: str) -> None:
    assert (file.find(number), SCHEMA.on("cnc").number(address)) == (address, number)


WORDS = {
    "P97": 2,
    "P2": 1,
    "P0": 1,
    "P1": 2,
    "P3": 1,
    "P4": 5,
    "P8": 1,
    "P9": 32,
    "P14": 2,
    "P27": 32,
    "P28": 1,
    "P64": 1,
    "P65": 32,
    "P10": 1,
    "P11": 64,
    "P12": 1,
    "P13": 18,
    "P25": 2,
    "P26": 32,
    "P34": 32,
    "P36": 64,
    "P5": 2,
}
TYPES = {
    "P97": 0,
    "P2": 6,
    "P0": 6,
    "P1": 6,
    "P3": 6,
    "P4": 0,
    "P8": 6,
    "P9": 0,
    "P14": 0,
    "P27": 0,
    "P28": 6,
    "P64": 6,
    "P65": 5,
    "P10": 6,
    "P11": 5,
    "P12": 0,
    "P13": 5,
    "P25": 6,
    "P26": 0,
    "P34": 6,
    "P36": 5,
    "P5": 0,
}


@pytest.mark.parametrize("parameter", WORDS)
def test_each_parameter_has_as_many_words_of_the_type_as_its_section_shows(parameter: str) -> None:
    """The head of each section; P5 by the table of page 13-14."""
    words = {
        number: address
        for address in SCHEMA.on("cnc").addresses
        if (number := SCHEMA.on("cnc").number(address) or "").startswith(f"{parameter}N")
    }
    assert sorted(words) == sorted(f"{parameter}N{n}" for n in range(WORDS[parameter]))
    codes = {SCHEMA.parameter(address[0]).storage.code for address in words.values()}
    assert codes == {TYPES[parameter]}


# -- what is active ----------------------------------------------------------------------------------


def test_an_address_that_no_list_names_has_nothing_to_say(file) -> None:
    put(file, P2N0=0b001, P3N0=0b010, P9N0=0xFF, P9N1=0xFF, P9N2=0x02, P9N3=0xFF, P14N0=0)
    assert [state(file, f"P27N{n}") for n in range(4)] == ["in-force", "in-force", "in-force", "ignored"]
    put(file, P9N30=0xFF)
    assert (state(file, "P27N30"), state(file, "P34N30")) == ("ignored", "ignored")
    put(file, P14N0=0b0100)
    assert (state(file, "P27N30"), state(file, "P34N30")) == ("ignored", "in-force"), (
        "the encoder of handwheel 3"
    )
    assert state(file, "P11N3") == "in-force"


def test_steps_count_on_a_clamped_modulo_axis_only(file) -> None:
    """Page 4-36."""
    put(file, P2N0=8, P3N0=8, P9N3=6, P1N0=8, P8N0=0)
    assert state(file, "P65N3") == "ignored"
    put(file, P8N0=8)
    assert state(file, "P65N3") == "in-force"
    put(file, P1N0=0)
    assert state(file, "P65N3") == "ignored"


def test_an_address_that_serves_a_spindle_or_a_handwheel_is_no_axis(file) -> None:
    """Page 4-8: the spindle and the handwheel have priority; the bit of P2 has their input looked for."""
    put(file, P2N0=0xFF800000, P6N0=0b1001, P14N0=0b1001)
    for n in range(23, 32):
        expected = "ignored" if n in (24, 27, 28, 31) else "in-force"
        assert state(file, f"P17N{2 * n}") == expected, n
        assert state(file, f"P34N{n}") == "in-force", "the sensor of whatever stands there"
    # An indexed spindle has the address C in P9 and is modulo in P1 (page 8-5).
    put(file, P9N24=8, P9N25=8, P1N0=0x03000000)
    assert (state(file, "P11N48"), state(file, "P11N50")) == ("ignored", "in-force")


def test_words_of_handwheels_count_where_there_is_a_handwheel(file) -> None:
    put(file, P14N0=0b0010)
    assert [state(file, f"P13N{n}") for n in (0, 2, 8, 10, 12)] == [
        "ignored",
        "in-force",
        "in-force",
        "ignored",
        "in-force",
    ]
    put(file, P14N0=0b10000)
    assert [state(file, number) for number in ("P13N8", "P12N0", "P14N1")] == ["ignored"] * 3


def test_p36_counts_with_coded_rules_and_combined_sensors(file) -> None:
    """Page 5-24."""
    put(file, P2N0=1, P3N0=1, P9N0=0)
    for kind, expected in enumerate(("ignored", "ignored", "in-force", "in-force")):
        put(file, P34N0=kind << 25)
        assert (state(file, "P36N0"), state(file, "P36N32")) == (expected, expected)


def test_a_rotary_axis_is_one_by_its_list_or_by_its_name(file) -> None:
    put(file, P1N0=0b0001, P1N1=0b0010, P9N0=0, P9N1=1, P9N2=2, P9N3=0x16, P9N4=8, P9N5=0xFF)
    turns = [file.evaluation.turns(("axes.increment", str(n))) for n in range(6)]
    assert turns == [True, True, False, True, True, False]


@pytest.mark.parametrize("naming", ["P70N3", "P71N3"])
def test_qvn_words_count_once_p70_or_p71_names_a_card_or_an_axis(file, naming: str) -> None:
    assert state(file, "P74N0") == "ignored"
    put(file, **{naming: 1})
    assert [state(file, number) for number in ("P70N0", "P71N0", "P74N0")] == ["in-force"] * 3


def test_words_that_may_not_be_used_are_ignored(file) -> None:
    assert (state(file, "P29N0"), state(file, "P115N0")) == ("ignored", "ignored")
