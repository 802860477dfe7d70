"""The Syntec family has every number that the slides print, spread over twenty axes as they print it.

Figures are typed here from the slides; sections are counted as in ``parameter_db/syntec/family.yaml``.
"""

from collections.abc import Iterator

import pytest

from amp_studio.files import ParameterFile, axis_title, copy_axis, delete_axis, fitted_axes, new_file
from amp_studio.report import page_of
from amp_studio.schema import InvalidValueError, Schema, Value, fault, load_schema, read_value, show_value


@pytest.fixture(scope="module")
def syntec() -> Schema:
    return load_schema("syntec")


@pytest.fixture
def mill() -> ParameterFile:
    return new_file("syntec", "generic", ["X", "Y", "Z"])


SPANS = [
    ("1.2.1", 21, 40, ["axis.port"]),
    ("1.2.2", 221, 240, ["axis.type"]),
    ("1.2.3", 281, 300, ["axis.radius_diameter"]),
    ("1.2.3", 321, 340, ["axis.name"]),
    ("1.2.4", 381, 400, ["axis.servo_mode"]),
    ("1.2.5", 61, 80, ["resolution.encoder"]),
    ("1.2.5", 81, 100, ["resolution.multiplication"]),
    ("1.2.6", 121, 160, ["resolution.screw_teeth", "resolution.motor_teeth"]),
    ("1.2.6", 161, 180, ["resolution.pitch"]),
    ("1.2.6", 17, 17, ["control.blu"]),
    ("1.2.7", 201, 220, ["resolution.encoder_type"]),
    ("1.4.1", 3203, 3203, ["dda.interpolation_time"]),
    ("1.5.1", 461, 480, ["feed.rapid"]),
    ("1.5.1", 1401, 1420, ["compensation.time_constant"]),
    ("1.5.1", 581, 600, ["servo.feed_forward"]),
    ("1.5.2", 561, 580, ["servo.loss_pulse_range"]),
    ("1.5.3", 401, 401, ["motion.acceleration_time"]),
    ("1.5.4", 541, 560, ["motion.axis_acceleration"]),
    ("2.2.2.1", 961, 980, ["home.search_method"]),
    ("2.2.2.2", 881, 900, ["home.offset"]),
    ("2.2.2.3", 821, 840, ["home.first_speed"]),
    ("2.2.2.3", 841, 860, ["home.second_speed"]),
    ("2.2.2.3", 861, 880, ["home.direction"]),
    ("2.2.2.4", 941, 960, ["home.grid"]),
    ("2.2.2.4", 981, 1000, ["home.protective_turns"]),
    ("2.2.2.4", 1001, 1020, ["home.fast_return"]),
    ("2.2.5.3", 901, 920, ["home.zero_speed_window"]),
    ("3.2", 2401, 2440, ["limit.first_positive", "limit.first_negative"]),
    ("3.3", 2501, 2540, ["limit.second_positive", "limit.second_negative"]),
    ("3.3", 2542, 2542, ["limit.second_scope"]),
    ("3.3", 3838, 3838, ["limit.second_at_start"]),
    ("3.7", 2441, 2480, ["limit.third_positive", "limit.third_negative"]),
    ("3.7", 2481, 2481, ["limit.third_mode"]),
    ("3.7", 2482, 2482, ["limit.third_scope"]),
    ("4.1", 661, 661, ["mpg.feedrate"]),
    ("4.1", 521, 540, ["jog.feedrate"]),
    ("4.1", 410, 410, ["mpg.acceleration_time"]),
    ("4.1", 2001, 2001, ["mpg.fourth_factor"]),
    ("4.1", 2003, 2003, ["mpg.simulation_handwheel"]),
    ("4.1", 2021, 2021, ["mpg.port"]),
    ("4.1", 2031, 2031, ["mpg.axis"]),
    ("4.1", 2041, 2041, ["mpg.resolution"]),
]
"""Section, first and last number, and the parameters that take turns in the span."""
WITHOUT_A_NUMBER = {"control.series", "servo.loop_gain"}


@pytest.mark.parametrize(("page", "first", "last", "names"), SPANS, ids=[f"{s[0]} Pr{s[1]}" for s in SPANS])
def test_a_span_of_numbers_belongs_to_the_axes_in_turn(
    syntec: Schema, page: str, first: int, last: int, names: list[str]
) -> None:
    numbers = iter(range(first, last + 1))
    axes = [""] if first == last else [str(n) for n in range(1, 21)]
    for axis in axes:
        for name in names:
            assert syntec.on("generic").number((name, axis)) == f"Pr{next(numbers)}"
    assert next(numbers, None) is None
    assert {syntec.parameter(name).page for name in names} == {page}


def test_there_is_no_other_parameter(syntec: Schema) -> None:
    assert {name for span in SPANS for name in span[3]} | WITHOUT_A_NUMBER == set(syntec.parameters)
    assert {p.id for p in syntec.parameters.values() if p.numbers is None} == WITHOUT_A_NUMBER


CHOICES = [
    ("1.2.2", "axis.type", [0, 1, 2, 3, 4, 5]),
    ("1.2.3", "axis.radius_diameter", [0, 1]),
    ("1.2.4", "axis.servo_mode", [0, 1, 2]),
    ("1.2.5", "resolution.multiplication", [1, 2, 4]),
    ("1.2.7", "resolution.encoder_type", [0, 1, 2, 3]),
    ("2.2.2.1", "home.search_method", [0, 1, 2, 3]),
    ("2.2.2.4", "home.grid", [0, 1]),
    ("2.2.2.4", "home.fast_return", [0, 1]),
    ("3.5", "limit.second_scope", [2, None]),
    ("4.1", "mpg.axis", [0, 1, 2, 3, 4, 5, 6]),
]


@pytest.mark.parametrize(("page", "name", "codes"), CHOICES, ids=[c[1] for c in CHOICES])
def test_a_choice_is_given_by_the_figure_that_is_printed(
    syntec: Schema, page: str, name: str, codes: list[int | None]
) -> None:
    parameter = syntec.parameter(name)
    assert [choice.raw for choice in parameter.choices] == codes
    assert [choice.code for choice in parameter.choices] == [None if c is None else str(c) for c in codes]
    for choice in parameter.choices:
        if choice.raw is not None:
            key = choice.key == "yes" if parameter.type == "boolean" else choice.key
            assert read_value(parameter, str(choice.raw), "") == Value(key)


def test_odd_and_even_numbers_are_the_pairs_of_the_examples(mill: ParameterFile) -> None:
    assert mill.find("Pr121") == ("resolution.screw_teeth", "1")  # 1.3.1: screw side 2, Pr.121=2
    assert mill.find("Pr122") == ("resolution.motor_teeth", "1")
    assert mill.find("Pr2501") == ("limit.second_positive", "1")  # 3.5: Pr2501 = 25000, Pr2502 = 10000
    assert mill.find("pr2502") == ("limit.second_negative", "1")
    assert mill.find("Pr2505") == ("limit.second_positive", "3")


def test_the_first_limits_have_the_range_and_the_defaults_of_their_table(mill: ParameterFile) -> None:
    """Section 3.2: [-999999999~999999999] BLU, default -999999999 and 999999999, effective on reset."""
    for number, default in (("Pr2401", 999999999), ("Pr2402", -999999999), ("Pr2440", -999999999)):
        address = mill.find(number)
        assert mill.default(address) == Value(default, "BLU")
        assert mill.schema.parameter(address[0]).effect.level == "reset"
        assert fault(mill.evaluation, address, Value(999999999, "BLU")) is None
        assert fault(mill.evaluation, address, Value(-1000000000, "BLU")) is not None


@pytest.mark.parametrize("name", ["home.direction", "limit.second_scope", "limit.third_scope", "control.blu"])
def test_a_code_that_is_not_printed_may_stand(mill: ParameterFile, name: str) -> None:
    address = mill.find(f"{name}@1" if name.startswith("home") else name)
    assert fault(mill.evaluation, address, Value("raw:0")) is None
    assert "raw:0" in show_value(mill.schema.parameter(name), Value("raw:0"))


def test_a_code_is_refused_where_all_of_them_are_printed(mill: ParameterFile) -> None:
    """Section 1.2.5: one, two or four times."""
    assert fault(mill.evaluation, mill.find("Pr81"), Value("raw:3")) is not None
    with pytest.raises(InvalidValueError, match=r"one time \(1\), two times \(2\), four times \(4\)"):
        read_value(mill.schema.parameter("resolution.multiplication"), "3", "")


def test_lengths_are_in_blu_and_in_nothing_else_where_its_length_is_unknown(mill: ParameterFile) -> None:
    """Section 1.2.6: the unit of the pitch is BLU, and what that is depends on Pr17."""
    pitch = mill.find("Pr161")
    assert mill.read(pitch, "10000") == mill.read(pitch, "10000 blu") == Value(10000, "BLU")
    assert mill.read(pitch, "10 mm") == Value(10000, "BLU"), "as delivered"
    mill.set(mill.find("Pr17"), Value("raw:2"))
    with pytest.raises(InvalidValueError, match="is given in BLU, not in mm"):
        mill.read(pitch, "10 mm")


def test_speeds_are_degrees_on_an_axis_that_turns(mill: ParameterFile) -> None:
    mill.set_checked({("axis.type", "3"): Value("rotary2")})
    assert mill.evaluation.unit(("feed.rapid", "2"), "metric") == "mm/min"
    assert mill.evaluation.unit(("feed.rapid", "3"), "metric") == "deg/min"


def out_of_force(file: ParameterFile) -> Iterator[tuple[str, str]]:
    for address in file.addresses():
        if (state := file.evaluation.state(address).state) != "in-force":
            yield address[0], state


def test_what_a_kind_of_axis_does_not_use_is_ignored(mill: ParameterFile) -> None:
    mill.set(("resolution.encoder_type", "1"), Value("absolute"))
    mill.set(("home.search_method", "2"), Value("dog-only"))
    mill.set(("home.search_method", "3"), Value("index-only"))
    grids = ["home.grid", "home.grid"]
    assert [name for name, state in out_of_force(mill) if state == "ignored"] == grids
    # The zero point of an absolute encoder is set on the screen of the serial parameters (2.1.1); the alarm
    # limits (1.5.3) go on looking at the first homing speed.
    mill.header.machine = "serial"
    mill.evaluation.forget()
    ignored = [name for name, state in out_of_force(mill) if state == "ignored"]
    homing = {p.id for p in mill.schema.parameters.values() if p.id.startswith("home.")} - {
        "home.first_speed"
    }
    assert sorted(ignored) == sorted([*homing, *grids, *["axis.servo_mode"] * 3])


# -- an axis is there by its port ------------------------------------------------------------------


def test_named_axes_are_fitted_and_all_others_have_no_port(mill: ParameterFile) -> None:
    assert fitted_axes(mill) == ("1", "2", "3")
    assert mill.get(("axis.port", "4")) == Value(0)
    assert mill.get(("axis.port", "1")) is None, "which port an axis has is for its wiring to say"
    assert axis_title(mill, "1") == "1 X linear"
    assert mill.evaluation.state(("resolution.pitch", "4")).why == "the axis has no port and is not there"
    assert fitted_axes(new_file("syntec")) == tuple(str(n) for n in range(1, 21))


def test_a_deleted_axis_loses_its_port(mill: ParameterFile) -> None:
    mill.set(("axis.port", "2"), Value(2))
    mill.set(("resolution.pitch", "2"), Value(10000, "BLU"))
    delete_axis(mill, "2")
    assert fitted_axes(mill) == ("1", "3")
    assert mill.get(("axis.port", "2")) == Value(0)
    assert mill.get(("resolution.pitch", "2")) is None
    assert mill.get(("axis.name", "2")) == Value("Y")


def test_a_copied_axis_keeps_its_own_port_and_name(mill: ParameterFile) -> None:
    mill.set(("axis.port", "1"), Value(1))
    mill.set(("axis.port", "2"), Value(2))
    mill.set(("resolution.pitch", "1"), Value(10000, "BLU"))
    copy_axis(mill, "1", "2")
    assert mill.get(("axis.port", "2")) == Value(2)
    assert mill.get(("axis.name", "2")) == Value("Y")
    assert mill.get(("resolution.pitch", "2")) == Value(10000, "BLU")


# -- as a person reads it ----------------------------------------------------------------------------


def test_a_page_reports_span_effect_and_alarms(syntec: Schema) -> None:
    page = page_of(syntec, "Pr3203")
    assert "Number         Pr3203" in page
    assert "Takes effect   not given in the manual" in page
    assert "MOT-005 DDA command overflow (page 1.5.1)" in page
    assert "Pr122, Pr124 … Pr160 (Axis 1 to Axis 20)" in page_of(syntec, "Pr122")


ALARMS = {
    "mot-005": {
        "feed.rapid",
        "resolution.encoder",
        "compensation.time_constant",
        "servo.feed_forward",
        "dda.interpolation_time",
    },
    "mot-008": {"servo.loss_pulse_range"},
    "mot-019": {"motion.acceleration_time", "feed.rapid", "home.first_speed", "servo.loop_gain"},
    "mot-023": {
        "motion.acceleration_time",
        "motion.axis_acceleration",
        "feed.rapid",
        "home.first_speed",
        "servo.loop_gain",
    },
    "mot-022": {"home.grid"},
    "mot-029": {"home.second_speed"},
    "mot-030": {"home.zero_speed_window", "home.first_speed"},
    "mot-036": {"home.second_speed"},
    "limit-alarms": {"limit.first_positive", "limit.second_positive", "limit.third_positive"},
}
"""Alarm -> the parameters that its slide names, by number or by what they are."""


@pytest.mark.parametrize("alarm", ALARMS)
def test_an_alarm_is_tied_to_the_parameters_it_names(syntec: Schema, alarm: str) -> None:
    table = syntec.tables[alarm]
    assert ALARMS[alarm] <= set(table.params)
    if alarm != "limit-alarms":
        parts = [str(row[0]).partition(" ")[0] for row in table.rows]
        assert list(dict.fromkeys(parts)) == ["When", "Cause", "Cure"]


CAUSES_AND_CURES = {
    "mot-005": (5, 6),
    "mot-008": (6, 8),
    "mot-019": (9, 6),
    "mot-023": (4, 4),
    "mot-022": (2, 2),
    "mot-029": (4, 2),
    "mot-030": (2, 3),
    "mot-036": (1, 1),
}


@pytest.mark.parametrize(("alarm", "counts"), CAUSES_AND_CURES.items(), ids=list(CAUSES_AND_CURES))
def test_no_cause_and_no_cure_is_left_out(syntec: Schema, alarm: str, counts: tuple[int, int]) -> None:
    parts = [str(row[0]).partition(" ")[0] for row in syntec.tables[alarm].rows]
    assert (parts.count("Cause"), parts.count("Cure")) == counts
