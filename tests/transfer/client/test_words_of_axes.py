"""Words with a bit for each axis: at a download no bit of an axis changes of which the file has nothing.

Where a control describes itself, a build has as many bits as axes, and a file may have fewer:
tests/families/grblhal/test_masks_of_axes.py. In every other family each file has all axes that a control of
the family can have, those that are not there included.
"""

from pathlib import Path

from amp_studio.files import new_file
from amp_studio.files.axis_values import words_of_axes
from amp_studio.schema import Value, family_ids, load_schema
from amp_studio.schema.registration import registration_of
from tests.families.num.lines.bench import NumBench
from tests.families.num.lines.test_peripheral_driver import send


def test_only_a_control_that_describes_itself_has_masks_of_as_many_bits_as_it_has_axes() -> None:
    by_build = {
        family
        for family in family_ids()
        if any(p.first_axis is not None for p in load_schema(family).parameters.values())
    }
    assert by_build == {family for family in family_ids() if registration_of(family).describe} == {"grblhal"}


def test_every_other_word_of_axes_has_a_bit_for_each_axis_on_each_type_of_machine() -> None:
    words = {family: words_of_axes(load_schema(family)) for family in family_ids() if family != "grblhal"}
    assert {family for family in words if words[family]} == {"num"}
    schema = load_schema("num")
    for machine in schema.family.machines:
        here = schema.on(machine)
        axes = {instance for parameter, instance in here.addresses if parameter == "axes.assignment"}
        assert all(bits.keys() == axes for bits in words["num"].values()), machine


def test_a_new_num_file_of_three_axes_states_of_every_other_axis_that_it_is_not_there() -> None:
    file = new_file("num", axes=["X", "Y", "Z"])
    assignments = {
        instance: value.value
        for (parameter, instance), value in file.values.items()
        if parameter == "axes.assignment"
    }
    assert len(assignments) == 32
    assert [axis for axis, word in assignments.items() if word != 0xFF] == ["0", "1", "2"]


def test_a_num_word_of_axes_that_a_file_does_not_set_stays_and_one_that_it_sets_goes_whole(
    tmp_path: Path,
) -> None:
    bench = NumBench(tmp_path)
    bench.press("patch P10N0=0000001F", "patch P20N0=00000018", "patch P15N0=00000010")
    file = new_file("num", axes=["X", "Y", "Z"])
    file.set(("travel.homing_negative", ""), Value(0b11))
    assert send(bench, file, []).verified
    assert (bench.words(10)[0], bench.words(20)[0]) == ("0000001F", "00000018")
    assert bench.words(15)[0] == "00000003"
