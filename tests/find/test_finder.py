"""One question over everything: what is found, why, and where it leads."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.files.notes import set_group_note, set_value_note
from amp_studio.find import Entry, Finder, message_page
from amp_studio.schema import load_schema
from amp_studio.schema.quoting import quoted
from amp_studio.validate import Validator

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture
def mill() -> ParameterFile:
    return open_file(EXAMPLES / "mill-1394" / "MILL_1394.amp").file


@pytest.fixture
def finder(mill: ParameterFile) -> Finder:
    return Finder(mill.schema, mill.machine, mill)


def of_family(family: str) -> Finder:
    schema = load_schema(family)
    return Finder(schema, schema.family.default_machine)


def test_a_whole_number_leads_to_its_axis(finder: Finder) -> None:
    hit, *_ = finder.find("2750")
    assert (hit.kind, hit.address, hit.why) == ("parameter", ("servo.excess_error", "2"), "number")
    assert hit.title == "2750 Excess Error Y"


@pytest.mark.parametrize("query", ["excess error Y", "exess error y", "1750@Y", "1750 y"])
def test_the_letter_of_an_axis_at_the_end_is_the_axis(finder: Finder, query: str) -> None:
    assert finder.find(query)[0].address == ("servo.excess_error", "2")


def test_an_address_as_verbs_take_it_leads_there(finder: Finder) -> None:
    assert finder.find("home.calibration@X")[0].address == ("home.calibration", "1")
    assert finder.find("servo.excess_error@2")[0].address == ("servo.excess_error", "2")
    num = open_file(EXAMPLES / "num-1060-mill" / "MILL_1060.amp").file
    assert Finder(num.schema, num.machine, num).find("P3N0.2")[0].address == ("axes.servoed", "")


def test_a_value_is_found_in_its_own_and_in_another_unit(finder: Finder) -> None:
    for query in ("12.7", "12.7 mm", "0.5 in"):
        hits = [hit for hit in finder.find(query) if hit.kind == "value"]
        assert hits[0].key == "servo.lead_screw_pitch"
        assert hits[0].detail == "Lead Screw Thread Pitch X, Y, Z"
        assert len(hits[0].others) == 2
    assert not [hit for hit in finder.find("12.7 ms") if hit.kind == "value"]


def test_a_choice_that_the_file_has_is_a_value_of_the_axes_that_have_it(finder: Finder) -> None:
    hits = [hit for hit in finder.find("J3") if hit.kind == "value"]
    assert [(hit.title, hit.detail) for hit in hits] == [
        ("Feedback Connector J3", "Position Loop Feedback Port Z"),
        ("Feedback Connector J3", "Velocity Loop Feedback Port Z"),
    ]


def test_a_mask_is_found_by_its_hexadecimal_number() -> None:
    num = open_file(EXAMPLES / "num-1060-mill" / "MILL_1060.amp").file
    found = {
        hit.key for hit in Finder(num.schema, num.machine, num).find("0x0000000F") if hit.kind == "value"
    }
    assert {"axes.measured", "axes.servoed"} <= found


def test_the_choices_of_a_parameter_are_not_listed_for_its_name_alone(finder: Finder) -> None:
    assert [hit.kind for hit in finder.find("baud rate") if hit.kind in ("choice", "value")] == []
    assert any(hit.title == "2 MHz" for hit in finder.find("2 mhz"))
    assert any(hit.title == "2 MHz" for hit in finder.find("baud rate 2 mhz"))


def test_a_value_is_found_after_an_edit(finder: Finder, mill: ParameterFile) -> None:
    address = ("servo.excess_error", "1")
    assert not [hit for hit in finder.find("17.123 mm") if hit.kind == "value"]
    mill.set(address, mill.read(address, "17.123 mm"))
    finder.forget_values()
    assert [hit.address for hit in finder.find("17.123 mm") if hit.kind == "value"] == [address]


def test_notes_are_found_and_secrets_are_not(finder: Finder, mill: ParameterFile) -> None:
    secret = next(p for p in mill.schema.parameters.values() if p.secret)
    instance = mill.machine_schema.instances(secret)[0]
    mill.set((secret.id, instance), mill.read((secret.id, instance), "7"))
    set_value_note(mill, ("servo.excess_error", "1"), "ask Karl\nabout the slideway")
    set_group_note(mill, "home", "Karl set the switches")
    finder.forget_values()
    assert [hit.key for hit in finder.find("karl") if hit.kind == "group"] == ["home"]
    assert [(hit.kind, hit.address) for hit in finder.find("karl") if hit.kind == "note"] == [
        ("note", ("servo.excess_error", "1"))
    ]
    assert secret.id not in {hit.key for hit in finder.find("7") if hit.kind == "value"}


def test_a_shared_number_finds_both_its_parameters(finder: Finder) -> None:
    """1013 is a gear on an axis and another one on a spindle."""
    found = {hit.key for hit in finder.find("1013") if hit.kind == "parameter"}
    assert {"servo.velocity_gear_teeth", "servo.spindle_motor_teeth"} <= found


def test_every_word_counts_in_any_order_and_case_and_an_id_is_found(finder: Finder) -> None:
    assert finder.find("ERROR excess")[0].key == "servo.excess_error"
    assert finder.find("servo.excess_error")[0].key == "servo.excess_error"
    assert "servo.hardware_type" in {hit.key for hit in finder.find("sercos interface")}


def test_every_hit_has_its_reason(finder: Finder) -> None:
    assert finder.find("excess error")[0].why == "name"
    assert finder.find("exess error")[0].why == "name, 'exess' as 'excess'"
    assert finder.find("backlash")[0].why.startswith("help: Backlash")


def test_a_message_comes_before_the_help_that_quotes_it() -> None:
    hit, *others = of_family("9pc").find("SERVO AMP FE LIMITS CORRECTED")
    assert (hit.kind, hit.key) == ("message", "following-error-limits-corrected")
    assert "servo.feedrate_suppression" in {other.key for other in others}


def test_the_number_of_an_error_shows_which_axis_it_means() -> None:
    hit = of_family("num").find("error 43")[0]
    assert (hit.key, hit.detail) == ("following-error-too-large", "axis of address 3, page 6-22")
    assert "following-error-too-large" not in {hit.key for hit in of_family("num").find("error 72")}


@pytest.mark.parametrize("query", ["estop", "goes into e-stop", "why emergency stop"])
def test_the_reasons_of_an_e_stop_are_found_by_it(query: str) -> None:
    finder = of_family("9pc")
    found = {hit.key for hit in finder.find(query) if hit.kind == "message"}
    assert {"loop-type-missing", "excess-skew", "incompatible-tool-activation-modes"} <= found


@pytest.mark.parametrize("query", ["MOT-022", "mot022", "MOT-22", "mot 22", "alarm mot-022"])
def test_a_code_is_found_however_it_is_written(query: str) -> None:
    assert of_family("syntec").find(query)[0].key == "mot-022"


def test_nothing_is_found_for_noise_and_the_nearest_is_offered_for_a_slip_too_many() -> None:
    finder = of_family("num")
    assert finder.find("qxqxqx zzkk") == []
    assert finder.find("") == finder.find("   ") == finder.find("?!") == []
    assert finder.nearest("ssaamplingg period") == "sampling period"
    assert finder.nearest("ssaamplingg limmmiit") == "", "near each word is another question"


@pytest.mark.parametrize(
    "query", ["x" * 5000, "excess " * 500, "\x00\x1b[31m", "((((", "%s{}", "é\u202e", "9" * 400]
)
def test_any_text_can_be_asked(finder: Finder, query: str) -> None:
    assert isinstance(finder.find(query), list)
    assert isinstance(finder.nearest(query), str)
    assert quoted(query)


def test_commands_of_a_window_are_found_with_the_rest(mill: ParameterFile) -> None:
    save = Entry("command", "File › Save As", "save-as", (("name", "File Save As"),))
    finder = Finder(mill.schema, mill.machine, mill, [save])
    assert finder.find("save as")[0].key == "save-as"


def test_a_parameter_of_the_other_machine_type_is_not_found() -> None:
    schema = load_schema("grblhal")
    assert Finder(schema, "grbl-1.1").find("laser mode")[0].key == "classic.laser_mode"
    assert "classic.laser_mode" not in {hit.key for hit in Finder(schema, "grblhal").find("laser mode")}


# -- the page of a message


def test_a_page_has_the_values_of_the_machine_and_the_rules_that_are_broken_now(mill: ParameterFile) -> None:
    address = ("servo.gain_break_point", "1")
    mill.set(address, mill.read(address, "50 mm"))
    message = mill.schema.messages["following-error-limits-corrected"]
    page = message_page(mill.schema, mill.machine, message, mill, Validator(mill).run())
    assert [p.number for p in page.parameters] == ["1735", "1730", "1740", "1750"]
    assert (address, "X", "50 mm") in page.parameters[1].values
    assert "9pc.servo.gain-break-below-suppression" in {linked.rule.id for linked in page.broken}


def test_a_page_without_a_file_has_names_and_no_values() -> None:
    schema = load_schema("9pc")
    page = message_page(schema, "mill", schema.messages["excess-following-error"])
    assert page.parameters[0].values == ()
    assert page.broken == ()
    assert page.parameters[0].name == "Excess Error"
