"""Several values at once: what would change is known before anything does."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.files.block_entry import plan_entry, plan_values
from amp_studio.schema import Value

X, Y, Z = (("servo.excess_error", axis) for axis in "123")


@pytest.fixture
def file(checkout: Path) -> ParameterFile:
    """Return the example mill: excess error 11 mm on X, Y and Z."""
    return open_file(checkout / "examples" / "mill-1394" / "MILL_1394.amp").file


def test_what_changes_is_apart_from_what_is_the_same_and_what_is_refused(file: ParameterFile) -> None:
    before = dict(file.values)
    entry = plan_entry(file, {X: "12 mm", Y: "11", Z: "99999"}, file.read)
    assert entry.changed == {X: Value(12.0, "mm")}
    assert entry.same == 1
    assert [(c.address, c.text) for c in entry.refused] == [(Z, "99999")]
    assert "is outside 0 to 214.1" in entry.refused[0].problem
    assert file.values == before, "nothing was changed yet"


def test_the_same_value_in_another_unit_is_no_change(file: ParameterFile) -> None:
    file.set(X, Value(25.4, "mm"))
    assert plan_entry(file, {X: "1 in"}, file.read).same == 1


def test_not_set_clears_and_what_is_no_number_is_refused(file: ParameterFile) -> None:
    entry = plan_entry(file, {X: "Not set", Y: "eleven", Z: "1,234"}, file.read)
    assert entry.changed == {X: None}
    assert "is not a number" in entry.refused[0].problem
    assert "two ways" in entry.refused[1].problem


def test_two_values_that_bound_each_other_move_together(file: ParameterFile) -> None:
    """Alone the first would be out of its range, which the second sets;
    a third that is refused takes neither along.
    """
    bounded = next(
        (p.id, i)
        for p in file.schema.parameters.values()
        for i in file.machine_schema.instances(p)
        if p.type == "real" and (limit := _bound(file, (p.id, i))) is not None and limit[0] in file.values
    )
    source, high = _bound(file, bounded) or (bounded, 0.0)
    unit = file.evaluation.unit(bounded, "metric")
    alone = plan_values(file, {bounded: Value(high * 1.01, unit)})
    assert alone.refused
    raised = Value(float(file.values[source].value) * 1.01, file.values[source].unit)
    both = plan_values(file, {bounded: Value(high * 1.005, unit), source: raised, X: Value(-1e9, "mm")})
    assert [c.address for c in both.refused] == [X]
    assert set(both.changed) == {bounded, source}


def _bound(file: ParameterFile, address: tuple[str, str]) -> tuple[tuple[str, str], float] | None:
    from amp_studio.schema import limits

    found = limits(file.evaluation, address, file.evaluation.unit(address, "metric"))
    if found is None or found.high_from is None or found.high is None or found.high <= 0:
        return None
    return found.high_from, found.high


def test_what_the_control_writes_and_what_does_not_exist_is_refused(file: ParameterFile) -> None:
    hidden = next(
        a
        for a in file.addresses()
        if file.evaluation.state(a).state == "hidden" and file.schema.parameters[a[0]].type == "real"
    )
    entry = plan_values(file, {hidden: Value(1.0, file.evaluation.unit(hidden, "metric"))})
    assert "does not exist here" in entry.refused[0].problem
