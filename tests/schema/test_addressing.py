"""What a person means by a number, an id or the letter of an axis: one answer for every verb."""

import pytest

from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import (
    UnknownParameterError,
    Value,
    family_ids,
    load_schema,
    resolve_address,
    resolve_all,
    resolve_axis,
)


@pytest.fixture(scope="module")
def mill() -> ParameterFile:
    """Return a 9/PC mill with the axes X, Y, Z and S."""
    return new_file("9pc", "mill", ["X", "Y", "Z", "S"])


@pytest.fixture(scope="module")
def num() -> ParameterFile:
    return new_file("num")


@pytest.mark.parametrize(
    ("family", "text", "address"),
    [
        ("9pc", "1300", ("home.calibration", "1")),
        ("9pc", " 2300 ", ("home.calibration", "2")),
        ("9pc", "HOME.Calibration@1", ("home.calibration", "1")),
        ("9pc", "101", ("password.character", "1")),
        ("num", "P21N3", ("servo.loop_gain", "3")),
        ("num", "p21n3", ("servo.loop_gain", "3")),
        ("num", "21N3", ("servo.loop_gain", "3")),
        ("num", "P3", ("axes.servoed", "")),
        ("syntec", "Pr61", ("resolution.encoder", "1")),
        ("syntec", "pr61", ("resolution.encoder", "1")),
        ("syntec", "61", ("resolution.encoder", "1")),
        ("57c422b", "R3", ("gain.proportional", "X")),
        ("57c422b", "R2051", ("gain.proportional", "Y")),
        ("57c422b", "gain.proportional@y", ("gain.proportional", "Y")),
        ("acromill", "axes.pulses_per_unit@X", ("axes.pulses_per_unit", "X")),
        ("acromill", "axes.pulses_per_unit@x", ("axes.pulses_per_unit", "X")),
    ],
)
def test_every_form_of_the_contract_is_understood(family: str, text: str, address: tuple[str, str]) -> None:
    assert new_file(family).find(text) == address


@pytest.mark.parametrize("family", family_ids())
def test_every_instance_is_found_by_its_address_and_every_number_means_one(family: str) -> None:
    schema = load_schema(family)
    for machine in schema.family.machines:
        file = new_file(family, machine.key)
        for address in schema.on(machine.key).addresses[::7]:
            assert file.find(schema.on(machine.key).short(address)) == address
            number = schema.on(machine.key).number(address)
            if number is not None:
                found = resolve_address(file.evaluation, number)
                assert address in (found.address, *found.others)
                assert bool(found.others) == bool(found.remark(schema))


# -- a number of two parameters


def test_a_number_that_is_printed_twice_means_one_and_shows_it(mill: ParameterFile) -> None:
    """1020 (pages 6-10 and 7-46)."""
    found = resolve_address(mill.evaluation, "1020")
    assert found.address == ("zone.overtravel_used", "1")
    assert (
        found.remark(mill.schema)
        == "1020 is printed for two parameters: taken is Software Overtravel Used (zone.overtravel_used@1); "
        "the other is Velocity Loop Feedback Port (servo.velocity_port@1)"
    )
    assert resolve_address(mill.evaluation, "1300").remark(mill.schema) == ""


def test_the_other_is_reached_by_id_and_by_the_letter_of_its_axis(mill: ParameterFile) -> None:
    assert (
        mill.find("servo.velocity_port@1")
        == mill.find("servo.velocity_port@X")
        == ("servo.velocity_port", "1")
    )


def test_the_type_of_the_axis_decides_for_1013(mill: ParameterFile) -> None:
    """Page 7-52 and 7-82: teeth of the velocity feedback on a linear axis, of the motor on a spindle."""
    assert mill.find("1013") == ("servo.velocity_gear_teeth", "1")
    assert mill.find("4013") == ("servo.spindle_motor_teeth", "4")


def test_of_several_that_exist_the_first_is_taken() -> None:
    module = new_file("57c422b")
    found = resolve_address(module.evaluation, "R132")
    assert found.address == ("cam.time_points", "X.0")
    assert found.remark(module.schema).startswith("R132 is printed for three parameters: taken is ")
    assert found.others == (("cam.byte_points", "X.0"), ("cam.position_points", "X.0"))


# -- words and bits


def test_a_number_of_several_words_means_all_of_them(num: ParameterFile) -> None:
    found = [m.address for m in resolve_all(num.evaluation, "P21")]
    assert found == [("servo.loop_gain", str(n)) for n in range(32)]
    with pytest.raises(UnknownParameterError, match="'P21' has 32 words, P21N0 to P21N31: name one of them"):
        num.find("P21")


def test_an_id_alone_means_all_axes_where_several_are_welcome(mill: ParameterFile) -> None:
    found = [m.address for m in resolve_all(mill.evaluation, "Home.Calibration")]
    assert found[:2] == [("home.calibration", "1"), ("home.calibration", "2")]
    assert len(found) == sum(
        mill.evaluation.state(("home.calibration", str(n))).state != "hidden" for n in range(1, 9)
    )
    with pytest.raises(UnknownParameterError, match=r": write home\.calibration@1$"):
        mill.find("home.calibration")


@pytest.mark.parametrize("text", ["P3N0.5", "p3n0.5", "P3.5", "axes.servoed.5"])
def test_a_bit_is_named_behind_its_word(num: ParameterFile, text: str) -> None:
    found = resolve_address(num.evaluation, text)
    assert (found.address, found.bit) == (("axes.servoed", ""), 5)
    with pytest.raises(UnknownParameterError, match="is a bit"):
        num.find(text)


# -- letters of axes


def test_an_axis_is_named_by_the_letter_the_file_gives_it() -> None:
    lathe = new_file("9pc", "lathe", ["Z", "X"])
    assert [lathe.find(f"home.calibration@{letter}")[1] for letter in "XZxz"] == ["2", "1", "2", "1"]
    syntec = new_file("syntec", axes=["X", "Y"])
    assert syntec.find("feed.rapid@Y") == ("feed.rapid", "2")


def test_a_letter_of_num_is_in_the_word_that_assigns_the_axis(num: ParameterFile) -> None:
    """P9 (page 4-24): the right digit is the name, here Z of group 1 at address 7."""
    file = num.copy()
    file.set(("axes.assignment", "7"), Value(0x02))
    assert file.find("servo.loop_gain@Z") == ("servo.loop_gain", "7")


def test_two_axes_of_one_letter_are_both_reported(mill: ParameterFile) -> None:
    file = mill.copy()
    file.set(("axis.name", "3"), Value("x"))
    with pytest.raises(UnknownParameterError) as refused:
        file.find("home.calibration@X")
    assert (
        str(refused.value)
        == "'home.calibration@X': the axes 1 and 3 are all named X: write home.calibration@1 or"
        " home.calibration@3"
    )
    with pytest.raises(UnknownParameterError, match="the axes 1 and 3 are all named X"):
        resolve_axis(file.evaluation, ("1", "2", "3"), "X")


def test_a_letter_of_an_axis_that_is_not_there_gives_way_to_one_that_is(mill: ParameterFile) -> None:
    file = mill.copy()
    file.set(("axis.name", "8"), Value("x"))
    assert file.find("home.calibration@X") == ("home.calibration", "1")


def test_a_letter_means_nothing_to_what_belongs_to_no_axis(mill: ParameterFile) -> None:
    with pytest.raises(UnknownParameterError, match="is one for the whole control"):
        mill.find("control.type@X")
    with pytest.raises(UnknownParameterError, match=r"has @1 to @6$"):
        mill.find("password.character@X")


# -- wrong names


@pytest.mark.parametrize(
    ("family", "text", "nearest"),
    [
        ("9pc", "home.calibrtion", "home.calibration"),
        ("9pc", "home.calibrtion@2", "home.calibration@2"),
        ("9pc", "Home Calibration", "home.calibration"),
        ("9pc", "calibration", "home.calibration"),
        ("9pc", "1301", "1300"),
        ("num", "P21N33", "P21N31"),
        ("syntec", "Pr6l", "Pr61"),
    ],
)
def test_a_wrong_name_is_answered_with_the_nearest(family: str, text: str, nearest: str) -> None:
    with pytest.raises(UnknownParameterError) as refused:
        new_file(family).find(text)
    message, _, near = str(refused.value).partition(". Did you mean: ")
    assert message == f"Unknown parameter '{text}'"
    assert nearest in near.split(", ")


@pytest.mark.parametrize(
    "text", ["", "@", "@1", ".", "." * 5000, "9" * 5000, "x" * 100_000, "\0", "P" * 300 + "1", "1@1"]
)
def test_whatever_is_written_is_answered(mill: ParameterFile, text: str) -> None:
    with pytest.raises(UnknownParameterError) as refused:
        mill.find(text)
    assert str(refused.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("home.calibration", "has @1 to @8, or an axis by its letter: X, Y, Z, S"),
        ("home.calibration@9", "has @1 to @8, or an axis by its letter: X, Y, Z, S"),
        ("home.calibration@Q", "has @1 to @8, or an axis by its letter: X, Y, Z, S"),
    ],
)
def test_a_wrong_instance_is_answered_with_those_there_are(
    mill: ParameterFile, text: str, message: str
) -> None:
    with pytest.raises(UnknownParameterError) as refused:
        mill.find(text)
    assert message in str(refused.value)


@pytest.mark.parametrize(
    ("text", "instance"), [("1300@X", "1"), ("1300@y", "2"), ("2300@Z", "3"), ("1300@4", "4")]
)
def test_a_number_of_any_axis_with_a_letter_is_the_parameter_on_that_axis(text: str, instance: str) -> None:
    file = new_file("9pc", "mill", ["X", "Y", "Z"])
    assert file.find(text) == ("home.calibration", instance)


def test_a_number_on_an_axis_that_is_not_there_is_refused_with_those_that_are() -> None:
    with pytest.raises(
        UnknownParameterError, match="'1300@Q': Home Calibration has @1 to @8, or an axis by its letter: X, Y"
    ):
        new_file("9pc", "mill", ["X", "Y"]).find("1300@Q")
