"""Differences and the three-way merge, by parameter."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from amp_studio.files import Difference, ParameterFile, compare, new_file
from amp_studio.files.diff import Conflict, merge
from amp_studio.schema import Address, Value, load_schema
from tests.campaigns import examples

CALIBRATION, POSITION, TEETH = (
    ("home.calibration", "1"),
    ("home.position", "1"),
    ("servo.velocity_gear_teeth", "1"),
)
USED, TYPE = ("zone.overtravel_used", "1"), ("axis.type", "1")


def a_file(values: dict[Address, Value], unknown: dict[str, str] | None = None) -> ParameterFile:
    """Return a file that contains these values only."""
    file = ParameterFile(load_schema("9pc"))
    file.values.update(values)
    file.unknown.update(unknown or {})
    return file


# -- compare ------------------------------------------------------------------------------------------------


def test_a_file_does_not_differ_from_its_copy(mill: ParameterFile) -> None:
    found = compare(mill.schema, mill.values, mill.copy().values)
    assert ((), len(mill.values)) == (found.differences, found.same)


@pytest.mark.parametrize(
    ("a", "b", "same"),
    [
        (Value(1.0, "in"), Value(25.4, "mm"), True),
        (Value(0.3, "in"), Value(7.62, "mm"), True),
        (Value(1000.0, "um"), Value(1.0, "mm"), True),
        (Value(1.0, "mm"), Value(1.0000000001, "mm"), False),
        (Value(5.0, "mm"), Value(5.0, "deg"), False),
        (Value(0.0, "mm"), Value(-0.0, "in"), True),
        (Value(1.0, "mm"), None, False),
    ],
)
def test_values_are_compared_exactly_and_whatever_their_unit(
    mill: ParameterFile, a: Value, b: Value | None, same: bool
) -> None:
    found = compare(mill.schema, {CALIBRATION: a}, {CALIBRATION: b} if b else {})
    assert (() if same else (Difference(CALIBRATION, a, b),)) == found.differences
    assert int(same) == found.same


def test_both_sides_of_a_difference_are_shown_in_one_unit() -> None:
    address = ("feedrate.rapid", "1")
    different = Difference(address, Value(600.0, "mm/min"), Value(4.0, "mm/s"))
    assert different.in_one_unit() == (Value(600.0, "mm/min"), Value(240.0, "mm/min"))


@pytest.mark.parametrize(
    ("a", "b"),
    [
        (Value(600.0, "mm/min"), Value(10.000000000000002, "mm/s")),
        (Value(1.0, "mm"), Value(1.0, "deg")),
        (Value(1.0, "mm"), None),
        (Value("linear"), Value("rotary")),
    ],
    ids=["alike in nine digits", "of two dimensions", "not set", "no numbers"],
)
def test_sides_that_have_no_one_unit_stay_as_they_are(a: Value, b: Value | None) -> None:
    assert Difference(("x", ""), a, b).in_one_unit() == (a, b)


def test_what_is_absent_on_one_side_is_counted_apart(mill: ParameterFile) -> None:
    a = {CALIBRATION: Value(1.0, "mm"), POSITION: Value(1.0, "mm"), USED: Value(True)}
    b = {
        CALIBRATION: Value(2.0, "mm"),
        USED: Value(True),
        TYPE: Value("linear"),
        ("future.thing", ""): Value("x"),
    }
    found = compare(mill.schema, a, b)
    assert (found.not_set_in_a, found.not_set_in_b, found.same, len(found.differences)) == (2, 1, 1, 4)


def test_differences_stand_in_the_order_of_the_manual_and_axis_10_behind_axis_9(mill: ParameterFile) -> None:
    order = [TYPE, CALIBRATION, ("home.calibration", "2"), ("home.calibration", "10"), ("unknown.thing", "")]
    values = dict.fromkeys(reversed(order), Value(1.0))
    assert order == [difference.address for difference in compare(mill.schema, values, {}).differences]


# -- merge


def test_changes_of_both_sides_come_together() -> None:
    base = new_file("9pc", "mill", ["X"])
    ours, theirs = base.copy(), base.copy()
    ours.set(CALIBRATION, Value(1.0, "mm"))
    theirs.set(POSITION, Value(2.0, "mm"))
    theirs.set(TEETH, None)
    merged, conflicts = merge(base, ours, theirs)
    assert conflicts == []
    assert (Value(1.0, "mm"), Value(2.0, "mm"), None) == tuple(
        merged.get(a) for a in (CALIBRATION, POSITION, TEETH)
    )
    assert Value(0.0, "mm") == ours.get(POSITION), "the sides are not touched"


def test_a_conflict_is_told_with_all_three_and_ours_stands() -> None:
    base, ours, theirs = (a_file({CALIBRATION: Value(float(n), "mm")}) for n in range(3))
    merged, conflicts = merge(base, ours, theirs)
    assert [Conflict(CALIBRATION, Value(0.0, "mm"), Value(1.0, "mm"), Value(2.0, "mm"))] == conflicts
    assert Value(1.0, "mm") == merged.get(CALIBRATION)


def test_the_same_change_on_both_sides_is_no_conflict_even_in_another_unit() -> None:
    base, ours, theirs = (
        a_file({CALIBRATION: v}) for v in (Value(0.0, "mm"), Value(25.4, "mm"), Value(1.0, "in"))
    )
    merged, conflicts = merge(base, ours, theirs)
    assert ([], Value(25.4, "mm")) == (conflicts, merged.get(CALIBRATION))


def test_one_side_removes_what_the_other_changes() -> None:
    base, ours, theirs = (
        a_file(v) for v in ({CALIBRATION: Value(0.0, "mm")}, {}, {CALIBRATION: Value(2.0, "mm")})
    )
    assert [Conflict(CALIBRATION, Value(0.0, "mm"), None, Value(2.0, "mm"))] == merge(base, ours, theirs)[1]
    assert [Conflict(CALIBRATION, Value(0.0, "mm"), Value(2.0, "mm"), None)] == merge(base, theirs, ours)[1]


def test_an_axis_that_begins_to_turn_brings_its_angles() -> None:
    base = new_file("9pc", "mill", ["X"])
    base.set(CALIBRATION, Value(5.0, "mm"))
    theirs = base.copy()
    theirs.set_checked({TYPE: Value("rotary")})
    merged, conflicts = merge(base, base.copy(), theirs)
    assert ([], Value(5.0, "deg")) == (conflicts, merged.get(CALIBRATION))
    assert theirs.values == merged.values


def test_a_mark_of_force_comes_with_the_value() -> None:
    base = new_file("9pc", "mill", ["X"])
    theirs = base.copy()
    theirs.set_checked({CALIBRATION: Value(1e7, "mm")}, force="by them")
    merged, _ = merge(base, base.copy(), theirs)
    assert ({CALIBRATION: "by them"}, Value(1e7, "mm")) == (merged.forced, merged.get(CALIBRATION))


def test_entries_nobody_understands_are_merged_as_well() -> None:
    base = a_file({}, {"kept": "1", "changed": "1", "removed": "1", "both": "1", "fight": "1"})
    ours = a_file({}, {"kept": "1", "changed": "1", "removed": "1", "both": "2", "fight": "2", "mine": "1"})
    theirs = a_file({}, {"kept": "1", "changed": "2", "both": "2", "fight": "3", "new": "1"})
    merged, conflicts = merge(base, ours, theirs)
    assert merged.unknown == {"kept": "1", "changed": "2", "both": "2", "fight": "2", "mine": "1", "new": "1"}
    assert [Conflict(("fight", ""), Value("1"), Value("2"), Value("3"))] == conflicts


def test_files_of_different_families_are_not_merged(family) -> None:
    head = """
        family: {0}
        name: Control {0}
        document: d
        title: t
        machines: [{{key: one, name: One}}, {{key: two, name: Two}}]
        default_machine: one
        scopes: {{global: {{instances: [""], label: Control}}}}
        units: {{}}
        effect: {{level: reset}}
        groups: [all]
        """
    number = '\n- {id: a.number, name: Number, type: integer, help: {what: A number.}, page: "1"}\n'
    family(head.format("alpha"), number)
    family(head.format("beta"), number)
    alpha, beta = new_file("alpha"), new_file("beta")
    with pytest.raises(ValueError, match="files of different control families cannot be merged: alpha, beta"):
        merge(alpha, alpha, beta)
    theirs = new_file("alpha", "two")
    assert merge(alpha, alpha.copy(), theirs)[0].machine == "two", "the machine type is merged as a value is"
    assert merge(alpha, theirs, alpha.copy())[0].machine == "two"


addresses = st.sampled_from([CALIBRATION, POSITION, ("home.calibration", "2")])
numbers = st.builds(Value, st.sampled_from([0.0, 1.0, 25.4, 0.3, 7.62]), st.sampled_from(["mm", "in", "deg"]))
values = st.dictionaries(addresses, numbers) | st.dictionaries(
    st.sampled_from([USED]), st.booleans().map(Value)
)
unknowns = st.dictionaries(st.sampled_from(["x", "y@1", "z"]), st.sampled_from(["1", "2"]))
files = st.builds(a_file, values, unknowns)


def content(file: ParameterFile) -> tuple:
    """Return the content of a file."""
    return file.values, file.unknown


@settings(max_examples=examples(60))
@given(files, files)
def test_what_only_one_side_changed_is_taken_as_it_is(base: ParameterFile, x: ParameterFile) -> None:
    ours, conflicts = merge(base, x, base)
    assert (content(x), []) == (content(ours), conflicts)
    theirs, conflicts = merge(base, base, x)
    assert conflicts == []
    assert (x.unknown, ()) == (theirs.unknown, compare(x.schema, theirs.values, x.values).differences)


@settings(max_examples=examples(60))
@given(files, files)
def test_two_sides_that_agree_have_no_conflict(base: ParameterFile, x: ParameterFile) -> None:
    merged, conflicts = merge(base, x, x)
    assert (content(x), []) == (content(merged), conflicts)


@settings(max_examples=examples(60))
@given(files, files, files)
def test_a_merge_takes_every_value_from_a_side_and_every_conflict_is_one(base, ours, theirs) -> None:
    merged, conflicts = merge(base, ours, theirs)
    fought = {conflict.address for conflict in conflicts}
    for address in {*base.values, *ours.values, *theirs.values, *merged.values}:
        assert merged.get(address) in (ours.get(address), theirs.get(address))
        if address in fought:
            assert merged.get(address) == ours.get(address)
    turned = {conflict.address for conflict in merge(base, theirs, ours)[1]}
    assert fought == turned, "the other way round the same is fought over"


@settings(max_examples=examples(60))
@given(files, files)
def test_comparing_the_other_way_round_says_the_same(a: ParameterFile, b: ParameterFile) -> None:
    there, back = compare(a.schema, a.values, b.values), compare(a.schema, b.values, a.values)
    assert there.same == back.same
    assert [Difference(d.address, d.b, d.a) for d in there.differences] == list(back.differences)
    assert (there.not_set_in_a, there.not_set_in_b) == (back.not_set_in_b, back.not_set_in_a)
