"""Two or three sources side by side: what kind each row is, what the result takes, and that nothing is
lost.
"""

from functools import cache
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from amp_studio.files import ParameterFile, compare, content_of, new_file, read_content
from amp_studio.files.merging import Merge, Row, Typed
from amp_studio.files.parameter_file import HeaderSnapshot
from amp_studio.schema import Address, Value, family_ids, load_schema
from tests.campaigns import examples

CALIBRATION, POSITION = ("home.calibration", "1"), ("home.position", "1")
TYPE = ("axis.type", "1")


def a_file(values: dict[Address, Value]) -> ParameterFile:
    """Return a 9/PC file that contains these values only."""
    file = ParameterFile(load_schema("9pc"))
    file.values.update(values)
    return file


def mm(value: float) -> ParameterFile:
    """Return a file with one home calibration."""
    return a_file({CALIBRATION: Value(value, "mm")})


def row_of(merge: Merge, address: Address) -> Row:
    """Return the row of a parameter."""
    return next(row for row in merge.rows if row.id.part == "value" and row.address == address)


# -- rows


@pytest.mark.parametrize(
    ("base", "a", "b", "kind"),
    [
        (1.0, 1.0, 1.0, "same"),
        (1.0, 2.0, 1.0, "a"),
        (1.0, 1.0, 2.0, "b"),
        (1.0, 2.0, 2.0, "both"),
        (1.0, 2.0, 3.0, "conflict"),
        (None, 1.0, 1.0, "same"),
        (None, 1.0, 2.0, "different"),
    ],
)
def test_a_row_shows_who_changed_it(base: float | None, a: float, b: float, kind: str) -> None:
    merge = Merge(mm(a), mm(b), None if base is None else mm(base))
    assert row_of(merge, CALIBRATION).kind == kind


def test_without_a_base_a_value_that_one_side_has_alone_is_of_that_side() -> None:
    merge = Merge(mm(1.0), a_file({POSITION: Value(2.0, "mm")}))
    kinds = {row.address: row.kind for row in merge.rows}
    assert (kinds[CALIBRATION], kinds[POSITION]) == ("a", "b")


def test_the_same_length_in_another_unit_is_no_difference() -> None:
    merge = Merge(mm(25.4), a_file({CALIBRATION: Value(1.0, "in")}), mm(25.4))
    assert (merge.differing, merge.same) == ((), 1)


def test_rows_come_in_the_groups_of_the_manual_with_the_header_first() -> None:
    a = new_file("9pc", "mill", ["X"])
    b = a.copy()
    b.set(CALIBRATION, Value(1.0, "mm"))
    b.set(("feedrate.rapid", "1"), Value(9.0, "mm/min"))
    b.header.notes = "after the move"
    b.unknown["future.thing"] = "1"
    merge = Merge(a, b)
    titles = [group.title for group in merge.grouped(merge.differing)]
    assert titles[0] == "Machine facts"
    assert titles[-1] == "Entries that this family does not know"
    assert len(titles) == 4


# -- the result


def test_a_conflict_is_open_until_it_is_chosen_and_keeps_a_until_then() -> None:
    merge = Merge(mm(2.0), mm(3.0), mm(1.0))
    (row,) = merge.open_conflicts
    assert merge.result().get(CALIBRATION) == Value(2.0, "mm")
    merge.choose(row, "b")
    assert merge.open_conflicts == []
    assert merge.result().get(CALIBRATION) == Value(3.0, "mm")
    merge.choose(row, None)
    assert merge.open_conflicts == [row]


@pytest.mark.parametrize(
    ("choice", "value"),
    [("base", Value(1.0, "mm")), (Typed(Value(2.5, "mm")), Value(2.5, "mm")), (Typed(None), None)],
)
def test_a_conflict_may_be_settled_by_the_base_by_a_typed_value_or_by_none(
    choice: object, value: Value
) -> None:
    merge = Merge(mm(2.0), mm(3.0), mm(1.0))
    merge.choose(merge.conflicts[0], choice)
    assert (merge.result().get(CALIBRATION), merge.open_conflicts) == (value, [])


def test_without_a_base_nothing_is_taken_from_b_until_it_is_chosen() -> None:
    merge = Merge(mm(1.0), mm(2.0))
    assert merge.result().get(CALIBRATION) == Value(1.0, "mm")
    merge.take("b")
    assert merge.result().get(CALIBRATION) == Value(2.0, "mm")


def test_header_entries_keys_of_others_and_marks_come_with_the_side_that_changed_them() -> None:
    base = new_file("9pc", "mill", ["X"])
    a, b = base.copy(), base.copy()
    a.header.revision = "3.1"
    b.header.notes, b.header.extra = "new spindle", {"shop": {"bay": 7}}
    b.unknown["future.thing"] = "5"
    b.set_checked({CALIBRATION: Value(1e7, "mm")}, force="on site")
    result = Merge(a, b, base).result()
    assert (result.header.revision, result.header.notes) == ("3.1", "new spindle")
    assert result.header.extra == {"shop": {"bay": 7}}
    assert (result.unknown, result.forced) == ({"future.thing": "5"}, {CALIBRATION: "on site"})
    assert (a.header.notes, a.header.extra, a.unknown, a.forced) == ("", {}, {}, {}), (
        "the sides are not touched"
    )


def test_an_axis_that_begins_to_turn_in_the_result_takes_lengths_of_the_other_side_along() -> None:
    base = new_file("9pc", "mill", ["X"])
    a, b = base.copy(), base.copy()
    a.set(CALIBRATION, Value(7.0, "mm"))
    b.set_checked({TYPE: Value("rotary")})
    merge = Merge(a, b, base)
    merge.take("a", merge.open_conflicts)
    assert merge.result().get(CALIBRATION) == Value(7.0, "deg")


def test_the_result_goes_into_a_file_as_one_step_that_can_be_taken_back_whole() -> None:
    a = new_file("9pc", "mill", ["X"])
    b = a.copy()
    b.set(CALIBRATION, Value(1.0, "mm"))
    b.header.notes, b.unknown["future.thing"] = "n", "1"
    before = content_of(a)
    merge = Merge(a.copy(), b)
    merge.take("b")
    marks = HeaderSnapshot.of(a)
    with a.step() as changes:
        merge.apply_to(a)
    assert content_of(a) == content_of(merge.result())
    a.take_back(changes, marks)
    assert content_of(a) == before


def test_choices_stay_when_a_source_is_read_again_and_follow_their_side_when_sides_are_swapped() -> None:
    base, a, b = mm(1.0), mm(2.0), mm(3.0)
    first = Merge(a, b, base)
    first.choose(first.conflicts[0], "b")
    again = Merge(a, b, base)
    again.keep_choices(first)
    swapped = Merge(b, a, base)
    swapped.keep_choices(first, swapped=True)
    assert again.result().get(CALIBRATION) == swapped.result().get(CALIBRATION) == Value(3.0, "mm")


def test_the_result_keeps_the_side_of_the_file_into_which_it_goes_whatever_it_is_called() -> None:
    file, other = mm(1.0), mm(2.0)
    file.header.extra, other.header.extra = {"bay": 1}, {"bay": 2}
    assert content(Merge(other, file, initial="b").result()) == content(file)
    open_conflict = Merge(other, file, mm(0.0), initial="b")
    assert open_conflict.result().get(CALIBRATION) == Value(1.0, "mm")
    open_conflict.take("a")
    assert content(open_conflict.result()) == content(other)


def test_what_was_taken_from_a_source_is_forgotten_with_it() -> None:
    first, again = Merge(mm(2.0), mm(3.0), mm(1.0)), Merge(mm(2.0), mm(4.0), mm(1.0))
    first.choose(first.conflicts[0], "b")
    again.keep_choices(first, without="b")
    assert len(again.open_conflicts) == 1
    first.choose(first.conflicts[0], "base")
    two = Merge(mm(2.0), mm(3.0))
    two.keep_choices(first)
    assert two.result().get(CALIBRATION) == Value(2.0, "mm"), (
        "and not cleared, as a base that is not there has none"
    )


def test_the_machine_type_of_the_header_is_a_row_and_empty_means_the_usual_one() -> None:
    a, b = new_file("num"), new_file("num")
    a.header.machine = ""
    assert [row for row in Merge(a, b).differing if row.id.part == "header"] == []


def test_ticked_steps_of_both_sides_come_together() -> None:
    base = new_file("9pc", "mill", ["X"])
    base.header.done = {"axes": "J. Doe"}
    a, b = base.copy(), base.copy()
    a.header.done = {"axes": "J. Doe", "homing": "J. Doe"}
    b.header.done = {"servo": "R. Roe"}
    merge = Merge(a, b, base)
    assert merge.open_conflicts == []
    assert merge.result().header.done == {"homing": "J. Doe", "servo": "R. Roe"}
    assert {row.id.key for row in merge.differing} == {"done.axes", "done.homing", "done.servo"}


def test_notes_on_values_are_merged_one_by_one() -> None:
    base = new_file("9pc", "mill", ["X"])
    a, b = base.copy(), base.copy()
    a.header.value_notes = {"home.calibration@1": "mine", "home.position@1": "mine"}
    b.header.value_notes = {"home.calibration@1": "theirs"}
    merge = Merge(a, b, base)
    (conflict,) = merge.open_conflicts
    merge.choose(conflict, "b")
    assert merge.result().header.value_notes == {"home.calibration@1": "theirs", "home.position@1": "mine"}


def test_a_key_of_another_program_keeps_its_kind() -> None:
    a = new_file("9pc", "mill", ["X"])
    b = a.copy()
    a.header.extra, b.header.extra = {"bay": 7}, {"bay": 8, "shop": ["x"]}
    merge = Merge(a, b)
    merge.take("b")
    assert merge.result().header.extra == {"bay": 8, "shop": ["x"]}


# -- for all families


@cache
def fresh(family: str) -> ParameterFile:
    """Return a new file of a family."""
    return new_file(family)


@st.composite
def three_files(draw: st.DrawFn) -> tuple[ParameterFile, ParameterFile, ParameterFile]:
    """Return a base and two files that change, clear and add a few values of it."""
    base = fresh(draw(st.sampled_from(family_ids())))
    numbers = [a for a in base.values if isinstance(base.values[a].value, (int, float))]
    numbers = [a for a in numbers if not isinstance(base.values[a].value, bool)][:12]
    changes = st.dictionaries(st.sampled_from(numbers), st.sampled_from([None, 1, 2]), max_size=6)
    texts = st.sampled_from(["", "x", "y"])
    found = []
    for _ in range(2):
        file = base.copy()
        for address, number in draw(changes).items():
            unit = base.values[address].unit
            file.set(
                address, None if number is None else Value(type(base.values[address].value)(number), unit)
            )
        file.header.notes, file.header.extra = draw(texts), {"shop": t} if (t := draw(texts)) else {}
        file.unknown |= {"future.thing": t} if (t := draw(texts)) else {}
        found.append(file)
    return base.copy(), found[0], found[1]


def content(file: ParameterFile) -> tuple[object, ...]:
    """Return all that a merge is about."""
    return file.values, file.forced, file.unknown, file.header.notes, file.header.extra, file.machine


def agree(x: ParameterFile, y: ParameterFile) -> bool:
    """Return whether two files mean the same, whatever the units."""
    return not compare(x.schema, x.values, y.values).differences and content(x)[2:] == content(y)[2:]


@settings(max_examples=examples(60))
@given(three_files())
def test_a_merge_is_the_same_from_either_side_once_its_conflicts_are_settled(files) -> None:
    base, a, b = files
    merge, turned = Merge(a, b, base), Merge(b, a, base)
    merge.take("a", merge.conflicts)
    turned.take("b", turned.conflicts)
    assert agree(merge.result(), turned.result())


@settings(max_examples=examples(60))
@given(three_files())
def test_taking_all_of_a_side_gives_that_side(files) -> None:
    base, a, b = files
    for sources in ((a, b, base), (a, b, None)):
        merge = Merge(*sources)
        merge.take("a")
        assert content(merge.result()) == content(a)
        merge.take("b")
        assert agree(merge.result(), b)


@settings(max_examples=examples(60))
@given(three_files())
def test_what_one_side_left_as_it_was_comes_from_the_other(files) -> None:
    base, a, b = files
    assert agree(Merge(base, b, base).result(), b)
    assert content(Merge(a, base, base).result()) == content(a)
    assert agree(Merge(a, a, base).result(), a)
    result = Merge(a, b, base)
    for row in result.rows:
        assert result.result_of(row) in (row.a, row.b)
        assert row.kind != "conflict" or row.a != row.base != row.b, (
            "a change of either side is never overwritten unseen"
        )


@settings(max_examples=examples(40))
@given(three_files(), st.randoms(use_true_random=False))
def test_a_result_saves_and_loads_as_the_same_bytes(files, chance) -> None:
    base, a, b = files
    merge = Merge(a, b, base)
    for row in merge.differing:
        merge.choose(row, chance.choice(["a", "b", "base"]))
    result = merge.result()
    written = content_of(result)
    again = read_content(Path("merged.amp"), written)
    assert content_of(again, written) == written
    for row in merge.rows:
        assert row.id.part != "value" or again.get(row.address) == result.get(row.address)
    assert again.unknown == result.unknown
