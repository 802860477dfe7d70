"""How far a file has come: what is open, what a step is, and which findings wait for their step."""

import pytest

from amp_studio.files import ParameterFile
from amp_studio.files.creation import new_file
from amp_studio.guide import GuideProgress, find_step, next_open, progress, tick
from amp_studio.schema import Value
from amp_studio.validate import Validator


def come(file: ParameterFile) -> GuideProgress:
    """Return the progress of a file that has just been checked."""
    validator = Validator(file)
    validator.run()
    return progress(validator)


def give(file: ParameterFile, *steps: str) -> None:
    """Give every open value of some steps: the first choice, 0, or lengths that go down from 100."""
    for step in steps:
        for n, address in enumerate(come(file).of(find_step(file.schema, step)).open):
            parameter = file.schema.parameters[address[0]]
            if parameter.choices:
                file.set(address, Value(parameter.choices[0].key if parameter.type == "choice" else False))
            else:
                file.set(address, file.read(address, "0" if parameter.type == "integer" else str(100 - n)))


def states(now: GuideProgress) -> dict[str, str]:
    return {each.step.id: each.state for each in now.steps}


@pytest.fixture
def mill() -> ParameterFile:
    """A new mill with three linear axes that have a name and a servo."""
    file = new_file("9pc", "mill", ["X", "Y", "Z"])
    for axis in "123":
        file.set(("servo.hardware_type", axis), Value("sercos"))
        file.set(("servo.loop_type", axis), Value("digital"))
    return file


def test_a_new_mill_has_its_values_without_a_default_to_give_and_nothing_else() -> None:
    now = come(new_file("9pc", "mill"))
    assert (now.set, now.total) == (0, sum(len(each.open) for each in now.steps))
    assert now.total > 300
    assert now.current is not None
    assert now.current.step.id == "control"
    assert now.current.open == (("axis.name", "1"), ("axis.name", "2"), ("axis.name", "3"))


def test_what_the_steps_have_open_is_what_validate_reports_as_not_set(mill: ParameterFile) -> None:
    validator = Validator(mill)
    (not_set,) = [f for f in validator.run() if f.rule == "schema.unset"]
    now = progress(validator)
    assert sorted(a for each in now.steps for a in each.open) == sorted(not_set.causes)
    assert set(validator.not_set) == set(not_set.causes)


def test_a_step_is_done_when_all_that_had_to_be_given_is(mill: ParameterFile) -> None:
    step = find_step(mill.schema, "axis")
    assert come(mill).of(step).open == tuple(("axis.integrand_name", axis) for axis in "123")
    assert come(mill).of(step).state == "not begun"
    mill.set(("axis.integrand_name", "1"), Value("i"))
    assert (come(mill).of(step).set, come(mill).of(step).state) == (1, "begun")
    mill.set(("axis.integrand_name", "2"), Value("j"))
    mill.set(("axis.integrand_name", "3"), Value("k"))
    assert (come(mill).of(step).set, come(mill).of(step).total, come(mill).of(step).state) == (3, 3, "done")


def test_a_step_whose_values_all_have_a_default_is_done_when_a_user_shows_it(mill: ParameterFile) -> None:
    step = find_step(mill.schema, "dual")
    assert come(mill).of(step).state == "not begun"
    assert tick(mill, step, "2026-11-22T20:00:00Z by ann") is True
    assert tick(mill, step, "2026-11-23T20:00:00Z by ben") is False
    done = come(mill).of(step)
    assert (done.state, done.ticked) == ("done", "2026-11-22T20:00:00Z by ann")
    assert tick(mill, step, None) is True
    assert come(mill).of(step).state == "not begun"


def test_a_tick_does_not_hide_an_error_or_an_open_value(mill: ParameterFile) -> None:
    step = find_step(mill.schema, "axis")
    tick(mill, step, "ann")
    assert come(mill).of(step).open
    assert come(mill).of(step).state == "begun"


def test_a_step_of_which_nothing_is_active_is_not_needed() -> None:
    file = new_file("9pc", "mill")
    assert states(come(file))["position_loop"] == "not needed"
    assert come(file).of(find_step(file.schema, "position_loop")) not in come(file).needed


def test_the_errors_of_a_step_are_shown_when_the_steps_before_it_are_finished(mill: ParameterFile) -> None:
    rules = {f.rule for f in Validator(mill).run() if f.severity == "error"}
    assert {"9pc.servo.output-missing", "9pc.servo.feedback-missing"} <= rules
    assert {f.rule for f in come(mill).deferred if f.severity == "error"} == rules  # step 2 has open values
    give(mill, "axis", "home", "zone")
    now = come(mill)
    assert now.current is not None
    assert now.current.step.id == "position_loop"  # the port of step 5 is judged with the loop type of step 6
    assert now.current.open == ()
    displayed = {f.rule for each in now.steps for f in each.findings if f.severity == "error"}
    assert displayed == {"9pc.servo.output-missing", "9pc.servo.feedback-missing"}
    assert {f.rule for f in now.deferred if f.severity == "error"} == rules - displayed


def test_a_finding_about_a_value_that_a_user_has_set_in_a_later_step_is_shown() -> None:
    file = new_file("9pc", "mill", ["X", "Y", "Z"])
    here = ("jog.speed_lowest", "1")
    file.set(here, Value(-5.0, "mm/min"))  # out of its range
    now = come(file)
    assert [f.causes for f in now.of(find_step(file.schema, "jog")).findings] == [(here,)]
    assert now.current is not None
    assert now.current.step.id == "control"


def test_with_nothing_unfinished_nothing_is_deferred() -> None:
    file = new_file("grblhal", axes=["X", "Y", "Z"])
    file.set(("homing.cycle", ""), Value(1))
    now = come(file)
    assert (now.current, now.deferred) == (None, ())


def test_what_is_deferred_is_still_found_by_the_validator() -> None:
    validator = Validator(new_file("9pc", "mill"))
    findings = validator.run()
    content = progress(validator).deferred
    assert content
    assert set(map(id, content)) <= set(map(id, findings))


def test_the_next_open_value_goes_through_the_steps_and_begins_again_after_the_last() -> None:
    file = new_file("9pc", "mill")
    now = come(file)
    assert next_open(now) == ("axis.name", "1")
    assert next_open(now, ("axis.name", "1")) == ("axis.name", "2")
    assert next_open(now, ("control.type", "")) == ("axis.name", "1")
    assert next_open(now, ("servo.loop_type", "3"))[0].startswith("axis.")
    last = [each for each in now.steps if each.open][-1].open[-1]
    assert next_open(now, last) == ("axis.name", "1")
    walked, here = [], None
    for _ in range(now.total):
        here = next_open(now, here)
        walked.append(here)
    assert len(set(walked)) == now.total


def test_the_next_value_lies_behind_the_one_that_was_just_set(mill: ParameterFile) -> None:
    mill.set(("axis.integrand_name", "2"), Value("j"))
    now = come(mill)
    assert next_open(now, ("axis.integrand_name", "2")) == ("axis.integrand_name", "3")
    mill.set(("axis.integrand_name", "3"), Value("k"))
    assert next_open(come(mill), ("axis.integrand_name", "3")) == ("home.g28_direction", "1")


def test_nothing_is_next_where_nothing_is_open() -> None:
    assert next_open(come(new_file("grblhal"))) is None


def test_a_value_for_the_whole_control_speaks_for_its_processes() -> None:
    file = new_file("9pc", "mill", ["X"])
    before = come(file)
    file.set(("zone.group_count", ""), Value(0))
    after = come(file)
    assert after.total <= before.total
    assert all(a[0] != "zone.group_count" for each in after.steps for a in each.open)
