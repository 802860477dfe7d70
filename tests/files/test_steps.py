"""One edit is one step: all of it is made, or the file is as it was before."""

import pytest

from amp_studio.files import Change, ParameterFile, RangeError
from amp_studio.files.parameter_file import HeaderSnapshot
from amp_studio.schema import Address, Value, load_schema

HOME: Address = ("home.calibration", "1")
ZONE: Address = ("zone.group_count", "")


@pytest.fixture
def mill() -> ParameterFile:
    """Return a mill with a value, and one that was forced out of its range."""
    file = ParameterFile(load_schema("9pc"))
    file.set(HOME, Value(2.0, "mm"))
    file.set_checked({ZONE: Value(9)}, force="on Monday")
    return file


def test_an_error_takes_back_values_marks_and_header(mill: ParameterFile) -> None:
    def change_and_fail() -> None:
        with mill.step():
            mill.set(HOME, Value(5.0, "mm"))
            mill.set(HOME, None)
            mill.set(ZONE, Value(1))
            mill.header.name = "new"
            raise RuntimeError("the operation broke off")

    with pytest.raises(RuntimeError):
        change_and_fail()
    assert (mill.values, mill.forced, mill.header.name) == (
        {HOME: Value(2.0, "mm"), ZONE: Value(9)},
        {ZONE: "on Monday"},
        "",
    )


def test_a_step_inside_a_step_is_taken_back_by_itself(mill: ParameterFile) -> None:
    with mill.step() as changes:
        mill.set(HOME, Value(5.0, "mm"))
        with pytest.raises(RangeError):
            mill.set_checked({ZONE: Value(8)})
    assert (mill.get(HOME), mill.get(ZONE), mill.forced) == (Value(5.0, "mm"), Value(9), {ZONE: "on Monday"})
    assert changes[0] == Change(HOME, Value(2.0, "mm"), Value(5.0, "mm"))


def test_a_step_can_be_taken_back_and_made_again(mill: ParameterFile) -> None:
    before = HeaderSnapshot.of(mill)
    with mill.step() as changes:
        mill.set_checked({ZONE: Value(2), HOME: None})
    after = HeaderSnapshot.of(mill)

    mill.take_back(changes, before)
    assert (mill.values, mill.forced) == ({HOME: Value(2.0, "mm"), ZONE: Value(9)}, {ZONE: "on Monday"})
    mill.replay(changes, after)
    assert (mill.values, mill.forced) == ({ZONE: Value(2)}, {})


def test_the_machine_type_is_put_back_with_what_depends_on_it() -> None:
    file = ParameterFile(load_schema("syntec"))

    def change_and_fail() -> None:
        with file.step():
            file.set_machine("serial")
            assert file.evaluation.machine_schema is file.schema.on("serial")
            raise RuntimeError("the operation broke off")

    with pytest.raises(RuntimeError):
        change_and_fail()
    assert (file.machine, file.evaluation.machine_schema) == ("generic", file.schema.on("generic"))
