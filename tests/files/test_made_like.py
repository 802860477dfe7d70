"""A new file like another one: what it takes over, and what is true of the other machine alone."""

from pathlib import Path

import pytest

from amp_studio.files import open_file
from amp_studio.files.creation import made_like, new_file, new_like, of_one_machine
from amp_studio.files.example_files import examples
from amp_studio.schema import Value, family_ids, load_schema


def example(name: str):
    """Return an example machine."""
    return open_file(next(e.path for e in examples() if e.path.parent.name == name)).file


def test_a_file_has_the_values_of_the_other_except_what_was_measured_there() -> None:
    source = example("mill-1394")
    source.set(("home.calibration", "1"), Value(1.5, "mm"))
    source.set(("servo.reversal_error", "2"), Value(0.004, "mm"))
    source.header.notes, source.header.revision = "commissioned in May", "12.1"
    source.header.done = {"home": "ann"}
    source.forced[("servo.excess_error", "1")] = "on a day"
    made = made_like(source, "second")
    file = made.file
    own = {p.id for p in of_one_machine(source.schema)}
    assert {"home.calibration", "servo.reversal_error", "calibration.table", "password.character"} <= own
    differing = {a[0] for a in source.values if file.get(a) != source.get(a)}
    assert differing == {
        "home.calibration",
        "servo.reversal_error",
        "probing.probe_length",
        "probing.probe_radius",
        "password.character",
    }
    assert [p.id for p in made.left] == sorted(differing, key=list(source.schema.parameters).index)
    assert file.get(("home.calibration", "1")) == Value(0.0, "mm")
    assert [a for a in file.values if a[0] == "password.character"] == []  # the control keeps its own
    assert (file.header.name, file.header.notes, file.header.revision, file.header.done) == (
        "second",
        "",
        "",
        {},
    )
    assert file.forced == {}
    assert file.header.units == source.header.units


def test_the_other_file_stays_as_it_is() -> None:
    source = example("mill-1394")
    before = dict(source.values), dict(source.forced), source.header.name
    made_like(source, "second", ["X", "Y"])
    assert (dict(source.values), dict(source.forced), source.header.name) == before


def test_an_axis_brings_its_values_to_the_place_of_its_letter() -> None:
    source = example("mill-1394")
    made = made_like(source, "second", ["Z", "X", "C", "S"])
    pitch = {axis: source.get(("servo.lead_screw_pitch", axis)) for axis in "123"}
    source_feed = {axis: source.get(("feedrate.rapid", axis)) for axis in "123"}
    assert made.file.get(("servo.lead_screw_pitch", "1")) == pitch["3"]
    assert made.file.get(("feedrate.rapid", "2")) == source_feed["1"]
    assert (made.new_axes, made.missing_axes) == (("C",), ("Y", "B"))
    plain = new_file("9pc", "mill", ["Z", "X", "C", "S"])
    of_c = [a for a in made.file.values if a[1] == "3" and made.file.machine_schema.scopes[a[0]] == "axis"]
    assert of_c
    assert {a: made.file.get(a) for a in of_c} == {a: plain.get(a) for a in of_c}
    assert source.get(("servo.feed_forward", "3")) is None
    assert made.file.get(("servo.feed_forward", "1")) is None  # not set there, not set here
    assert made.file.get(("control.retrace_limit", "")) == source.get(("control.retrace_limit", ""))


def test_the_same_axes_in_words_are_the_same_file() -> None:
    source = example("mill-1394")
    assert (
        made_like(source, "second", ["X", "Y", "Z", "B", "S"]).file.values
        == new_like(source, "second").values
    )


def test_a_family_whose_axes_cannot_move_is_refused_in_one_sentence() -> None:
    with pytest.raises(
        ValueError, match=r"^a file of NUM .* with the same axes \(X, Y, Z, B\): leave the axes out"
    ):
        made_like(example("num-1060-mill"), "second", ["X", "Y"])


def test_axes_that_cannot_be_are_refused_as_in_a_new_file() -> None:
    with pytest.raises(ValueError, match="Q"):
        made_like(example("mill-1394"), "second", ["X", "Q"])


@pytest.mark.parametrize("name", [e.path.parent.name for e in examples()])
def test_every_example_can_be_started_from(name: str, tmp_path: Path) -> None:
    source = example(name)
    made = made_like(source, "second")
    own = {p.id for p in of_one_machine(source.schema)}
    assert {a: v for a, v in made.file.values.items() if a[0] not in own} == {
        a: v for a, v in source.values.items() if a[0] not in own
    }


@pytest.mark.parametrize("family", family_ids())
def test_what_stays_with_its_machine_is_named_in_every_family(family: str) -> None:
    names = [p.id for p in of_one_machine(load_schema(family))]
    if not names:
        pytest.skip("names none")
    assert len(names) == len(set(names))
