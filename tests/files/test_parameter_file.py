"""A parameter file in memory: new, read, changed, all or none."""

import math
import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.files import (
    Change,
    Document,
    ParameterFile,
    RangeError,
    describe,
    fitted_axes,
    new_file,
    open_file,
)
from amp_studio.files.axes import AxisError
from amp_studio.files.parameter_file import fill_defaults
from amp_studio.files.storage import save_file
from amp_studio.schema import InvalidValueError, UnitError, UnknownParameterError, Value

POSITIVE, NEGATIVE = ("zone.overtravel_positive", "1"), ("zone.overtravel_negative", "1")
CALIBRATION = ("home.calibration", "1")


# -- new ---------------------------------------------------------------------------------------------


def test_a_new_file_holds_every_printed_default_and_nothing_else() -> None:
    file = new_file("9pc", "mill", ["X", "Y"])
    assert all(
        file.is_default(a) for a in file.addresses() if a[0] not in ("axis.name", "axis.type", "control.type")
    )
    unset = {a[0] for a in file.addresses() if file.get(a) is None}
    assert unset == {a[0] for a in file.addresses() if file.default(a) is None and file.get(a) is None}
    assert Value(0.0, "mm") == file.get(CALIBRATION)
    assert file.schema.signature == file.header.signature


def test_a_new_file_is_of_the_machine_and_the_axes_that_were_asked_for() -> None:
    file = new_file("9pc", "mill", ["x", "Y", "C", "S"], name="bench")
    assert (file.machine, file.header.name, file.header.application) == ("mill", "bench", "Mill/Lathe")
    assert fitted_axes(file) == ("1", "2", "3", "4")
    types = [file.get(("axis.type", axis)).value for axis in "12345678"]
    assert ["linear", "linear", "rotary", "spindle", *["unfitted"] * 4] == types
    assert [Value("x"), Value("y"), Value("c"), Value("s")] == [
        file.get(("axis.name", axis)) for axis in "1234"
    ]
    assert Value(0.0, "deg") == file.get(("home.calibration", "3")), (
        "the lengths of an axis that turns are angles"
    )


def test_without_axes_the_printed_ones_stay() -> None:
    file = new_file("9pc")
    assert (file.machine, fitted_axes(file)) == ("lathe", ("1", "2", "3"))


@pytest.mark.parametrize(
    ("arguments", "error", "said"),
    [
        (("no-such",), KeyError, "no-such"),
        (("9pc", "grinder"), ValueError, "Unknown machine type 'grinder'. Known: lathe, mill"),
        (("9pc", "mill", ["X", "Q"]), AxisError, "'Q' is not a choice of Axis Name"),
        (("9pc", "mill", ["X", ""]), AxisError, "'' is not a choice of Axis Name"),
        (("9pc", "mill", list("XYZABCUVW")), AxisError, "9 axes are too many: Allen-Bradley 9/PC AMP has 8"),
    ],
)
def test_a_new_file_that_cannot_be_is_refused(arguments, error, said: str) -> None:
    with pytest.raises(error, match=said):
        new_file(*arguments)


def test_filling_in_defaults_touches_nothing_that_is_set(mill: ParameterFile) -> None:
    mill.set(CALIBRATION, Value(3.0, "mm"))
    mill.set(POSITIVE, None)
    assert [Change(POSITIVE, None, Value(0.0, "mm"))] == fill_defaults(mill, ["1"])
    assert Value(3.0, "mm") == mill.get(CALIBRATION)
    assert fill_defaults(mill, ["", "1", "2", "3"]) == []


# -- read and set ----------------------------------------------------------------------------------------


def test_a_value_is_read_in_the_unit_of_the_file_unless_it_names_its_own(mill: ParameterFile) -> None:
    assert Value(2.5, "mm") == mill.read(CALIBRATION, "2,5")
    mill.header.units = "inch"
    assert Value(2.5, "in") == mill.read(CALIBRATION, "2.5")
    assert Value(2.5, "mm") == mill.read(CALIBRATION, "2.5 mm")
    mill.set(("axis.type", "1"), Value("rotary"))
    assert Value(2.5, "deg") == mill.read(CALIBRATION, "2.5")
    with pytest.raises(InvalidValueError, match="Home Calibration is given in °, not in mm"):
        mill.read(CALIBRATION, "2.5 mm")


def test_a_value_is_default_whatever_its_unit(mill: ParameterFile) -> None:
    assert mill.is_default(("accdec.linear_acceleration", "1"))
    mill.set(("accdec.linear_acceleration", "1"), Value(1.0, "in/s2"))
    assert mill.is_default(("accdec.linear_acceleration", "1")), "the printed default is 25.4 mm/s2"
    mill.set(("accdec.linear_acceleration", "1"), Value(25.4, "deg/s2"))
    assert not mill.is_default(("accdec.linear_acceleration", "1")), "degrees are no millimetres"
    mill.set(("accdec.linear_acceleration", "1"), None)
    assert not mill.is_default(("accdec.linear_acceleration", "1"))


def test_setting_what_is_set_changes_nothing_and_calls_nobody(mill: ParameterFile) -> None:
    heard: list[Change] = []
    end = mill.listen(heard.append)
    assert mill.set(CALIBRATION, mill.get(CALIBRATION)) is None
    change = mill.set(CALIBRATION, Value(4.0, "mm"))
    assert [Change(CALIBRATION, Value(0.0, "mm"), Value(4.0, "mm"))] == [change] == heard
    mill.apply(change.reversed())
    assert (Value(0.0, "mm"), 2) == (mill.get(CALIBRATION), len(heard))
    end()
    mill.set(CALIBRATION, Value(5.0, "mm"))
    assert len(heard) == 2


def test_an_instance_is_called_by_its_number_or_by_name_and_axis(mill: ParameterFile) -> None:
    assert describe(mill, CALIBRATION) == "1300 Home Calibration"
    assert describe(mill, ("servo.velocity_port", "1")) == "Velocity Loop Feedback Port Axis 1"
    with pytest.raises(UnknownParameterError):
        mill.find("home.nothing@1")


# -- several at once ---------------------------------------------------------------------------------------


def test_a_pair_that_bounds_each_other_moves_together(mill: ParameterFile) -> None:
    mill.set_checked({POSITIVE: Value(10.0, "mm"), NEGATIVE: Value(-10.0, "mm")})
    changes = mill.set_checked({POSITIVE: Value(100.0, "mm"), NEGATIVE: Value(50.0, "mm")})
    assert [change.address for change in changes] == [POSITIVE, NEGATIVE]
    changes = mill.set_checked({POSITIVE: Value(-50.0, "mm"), NEGATIVE: Value(-100.0, "mm")})
    assert (Value(-50.0, "mm"), Value(-100.0, "mm")) == (mill.get(POSITIVE), mill.get(NEGATIVE))


def test_a_pair_that_crosses_is_refused_with_both_reasons(mill: ParameterFile) -> None:
    before = dict(mill.values)
    with pytest.raises(RangeError) as refused:
        mill.set_checked({POSITIVE: Value(1.0, "mm"), NEGATIVE: Value(2.0, "mm")})
    assert {POSITIVE, NEGATIVE} == set(refused.value.faults)
    assert "set by 1330 Negative Software Overtravel" in refused.value.faults[POSITIVE]
    assert before == mill.values


def test_one_fault_among_many_changes_nothing_at_all(mill: ParameterFile) -> None:
    before, heard = dict(mill.values), []
    mill.listen(heard.append)
    with pytest.raises(
        RangeError, match=r"Home Calibration 1e\+06 mm is outside|Home Calibration 1000000 mm is outside"
    ):
        mill.set_checked(
            {
                ("control.type", ""): Value("lathe"),
                ("axis.type", "2"): Value("rotary"),
                ("zone.overtravel_used", "1"): Value(True),
                CALIBRATION: Value(1e6, "mm"),
            }
        )
    assert before == mill.values
    assert mill.machine == "mill"
    assert mill.evaluation.unit(("home.calibration", "2"), "metric") == "mm"
    replayed = dict(before)
    for change in heard:
        assert replayed.get(change.address) == change.old
        replayed = {**replayed, change.address: change.new}
    assert before == replayed, "whoever listened has heard all of it taken back"


def test_a_range_that_another_change_of_the_same_step_moves_counts_as_moved(mill: ParameterFile) -> None:
    """Excess Error: 214.1 mm on a slide, 1440 degrees on a spindle (page 7-20)."""
    excess = ("servo.excess_error", "1")
    with pytest.raises(RangeError):
        mill.set_checked({excess: Value(1000.0, "deg")})
    mill.set_checked({excess: Value(1000.0, "deg"), ("axis.type", "1"): Value("spindle")})
    assert Value(1000.0, "deg") == mill.get(excess)


def test_an_axis_that_changes_its_type_takes_its_values_along(mill: ParameterFile) -> None:
    mill.set(CALIBRATION, Value(3.5, "mm"))
    changes = mill.set_checked({("axis.type", "1"): Value("rotary")})
    assert Value(3.5, "deg") == mill.get(CALIBRATION)
    assert Change(CALIBRATION, Value(3.5, "mm"), Value(3.5, "deg")) in changes
    for change in reversed(changes):
        mill.apply(change.reversed())
    assert Value(3.5, "mm") == mill.get(CALIBRATION)


# -- force ------------------------------------------------------------------------------------------------


def test_a_forced_value_is_taken_and_marked(mill: ParameterFile) -> None:
    mill.set_checked({CALIBRATION: Value(1e6, "mm"), POSITIVE: Value(5.0, "mm")}, force="by a test")
    assert Value(1e6, "mm") == mill.get(CALIBRATION)
    assert mill.forced == {CALIBRATION: "by a test"}, "what is in range needs no mark"


def test_the_mark_goes_when_the_value_is_changed_or_fits_again(mill: ParameterFile) -> None:
    mill.set_checked({CALIBRATION: Value(1e6, "mm")}, force="by a test")
    mill.set_checked({CALIBRATION: Value(1.0, "mm")})
    assert mill.forced == {}
    mill.set_checked({NEGATIVE: Value(5.0, "mm")}, force="by a test")
    assert mill.forced == {NEGATIVE: "by a test"}
    mill.set_checked({POSITIVE: Value(10.0, "mm"), NEGATIVE: Value(5.0, "mm")})
    assert mill.forced == {}, "the other bound has moved: the same value is in range now"


def test_a_refused_step_leaves_the_marks_as_they_were(mill: ParameterFile) -> None:
    mill.set_checked({CALIBRATION: Value(1e6, "mm")}, force="by a test")
    with pytest.raises(RangeError):
        mill.set_checked({CALIBRATION: Value(1.0, "mm"), POSITIVE: Value(-1e9, "mm")})
    assert mill.forced == {CALIBRATION: "by a test"}
    assert Value(1e6, "mm") == mill.get(CALIBRATION)


def test_whoever_listens_hears_of_a_mark_though_the_value_stands(mill: ParameterFile) -> None:
    mill.set(CALIBRATION, Value(1e6, "mm"))
    told: list[Change] = []
    mill.listen(told.append)
    assert mill.set_checked({CALIBRATION: Value(1e6, "mm")}, force="by a test") == []
    assert told == [Change(CALIBRATION, Value(1e6, "mm"), Value(1e6, "mm"))]
    assert mill.forced == {CALIBRATION: "by a test"}


def test_the_mark_stays_when_the_axis_begins_to_turn(mill: ParameterFile) -> None:
    mill.set_checked({CALIBRATION: Value(1e6, "mm")}, force="by a test")
    mill.set_checked({("axis.type", "1"): Value("rotary")})
    assert (Value(1e6, "deg"), {CALIBRATION: "by a test"}) == (mill.get(CALIBRATION), mill.forced)


def test_a_code_nobody_knows_needs_force(mill: ParameterFile) -> None:
    with pytest.raises(RangeError, match="77 is no code of Axis Type"):
        mill.set_checked({("axis.type", "1"): Value("raw:77")})
    mill.set_checked({("axis.type", "1"): Value("raw:77")}, force="by a test")
    assert Value("raw:77") == mill.get(("axis.type", "1"))


# -- copies -------------------------------------------------------------------------------------------------


def test_a_copy_shares_nothing(mill: ParameterFile) -> None:
    mill.unknown["future.thing"] = "5"
    mill.header.extra["builder"] = "me"
    twin = mill.copy()
    assert (mill.values, mill.unknown, mill.header) == (twin.values, twin.unknown, twin.header)
    twin.set(CALIBRATION, Value(9.0, "mm"))
    twin.header.extra["builder"], twin.header.notes = "you", "mine"
    twin.unknown.clear()
    twin.forced[CALIBRATION] = "x"
    assert Value(0.0, "mm") == mill.get(CALIBRATION)
    assert (mill.header.extra["builder"], mill.header.notes, mill.unknown, mill.forced) == (
        "me",
        "",
        {"future.thing": "5"},
        {},
    )


@given(st.dictionaries(st.sampled_from([CALIBRATION, POSITIVE, NEGATIVE]), st.floats(-3e6, 3e6), min_size=1))
def test_a_step_is_done_whole_or_not_at_all(wanted) -> None:
    file = new_file("9pc", "mill", ["X"])
    values = {address: Value(number, "mm") for address, number in wanted.items()}
    before = dict(file.values)
    faults = {}
    try:
        file.set_checked(values)
    except RangeError as refused:
        faults = refused.faults
    assert file.values == (before if faults else before | values)
    assert set(faults) <= set(values)


@pytest.mark.parametrize(
    ("address", "value", "error", "text"),
    [
        ("1300", Value(5.0, "mm"), TypeError, "an address is a parameter id and an instance"),
        (("home.calibration", "1"), "5 mm", TypeError, "a value is a Value"),
        (("home.calibration", "1"), 5, TypeError, "a value is a Value"),
        (("home.calibration", "1"), Value(None, "mm"), TypeError, "a value is a Value"),
        (
            ("home.calibration", "X"),
            Value(5.0, "mm"),
            UnknownParameterError,
            "has no instance 'X'; it has '1', '2'",
        ),
        (
            ("home.calibratoin", "1"),
            Value(5.0, "mm"),
            UnknownParameterError,
            "Unknown parameter 'home.calibratoin'",
        ),
        (("home.calibration", "1"), Value(5.0, "furlong"), UnitError, "'furlong' is not a unit"),
        (("home.calibration", "1"), Value("abc", "mm"), InvalidValueError, "Home Calibration is a number"),
        (("home.calibration", "1"), Value(math.inf, "mm"), InvalidValueError, "inf is not a number"),
        (("axis.name", "1"), Value(5.0), InvalidValueError, "5.0 is no value of Axis Name"),
    ],
)
def test_what_is_no_address_and_what_is_no_value_is_refused_at_once(
    address: object, value: object, error: type[Exception], text: str
) -> None:
    file = new_file("9pc", "mill", ["X"])
    before = dict(file.values)
    for change in (file.set, lambda a, v: file.set_checked({a: v}), lambda a, v: file.take({a: v})):
        with pytest.raises(error, match=re.escape(text)):
            change(address, value)
    assert file.values == before


@pytest.mark.parametrize(
    ("address", "error"),
    [
        ("1300", TypeError),
        (("1300", "1"), UnknownParameterError),
        (("axis.name", "9"), UnknownParameterError),
    ],
)
def test_what_is_no_address_has_no_value_either(address: object, error: type[Exception]) -> None:
    with pytest.raises(error):
        new_file("9pc", "mill", ["X"]).get(address)


def test_paths_may_be_text(tmp_path: Path) -> None:
    path = f"{tmp_path}/a.amp"
    save_file(new_file("9pc", "mill", ["X"]), path)
    assert open_file(path).path == Path(path)
    with Document.open(path) as document:
        document.save_as(f"{tmp_path}/b.amp").close()
    assert open_file(f"{tmp_path}/b.amp").file.header.name == "b"
