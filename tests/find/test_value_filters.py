"""By which marks the values of a file are listed, alone and together."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.find import FILTER_NAMES, FilterName, ValueFilters, rows_of_file
from amp_studio.schema import Address
from amp_studio.validate import Validator
from tests.campaigns import some

EXAMPLES = Path(__file__).parents[2] / "examples"
EXCESS = ("servo.excess_error", "1")


@pytest.fixture
def mill() -> ParameterFile:
    return open_file(EXAMPLES / "mill-1394" / "MILL_1394.amp").file


@pytest.fixture
def marks(mill: ParameterFile) -> ValueFilters:
    found = ValueFilters(mill, saved=dict(mill.values))
    found.take_findings(Validator(mill).run())
    return found


def listed(marks: ValueFilters, *wanted: FilterName) -> set[Address]:
    """Return every value of the file that has all of the marks."""
    return {
        a
        for row in rows_of_file(marks.file)
        for a in row
        if marks.passing(wanted, row)
        and (all(marks.has(mark, a) for mark in wanted if mark != "axes-differ"))
    }


def test_what_is_not_the_default_is_changed_and_what_is_not_on_disk_unsaved(marks: ValueFilters) -> None:
    file = marks.file
    assert listed(marks, "changed") == {
        a for row in rows_of_file(file) for a in row if file.get(a) is not None and not file.is_default(a)
    }
    assert listed(marks, "unsaved") == set()
    file.set(EXCESS, file.read(EXCESS, "13 mm"))
    marks.forget([EXCESS])
    assert listed(marks, "unsaved") == listed(marks, "unsaved", "changed") == {EXCESS}
    file.set(EXCESS, file.default(EXCESS))
    marks.forget([EXCESS])
    assert EXCESS not in listed(marks, "changed")


def test_not_set_is_what_the_check_counts(marks: ValueFilters) -> None:
    assert marks.counted("not-set", rows_of_file(marks.file)) == len(marks.not_set)
    marks.file.set(EXCESS, None)
    marks.forget([EXCESS])
    marks.take_findings(Validator(marks.file).run())
    assert EXCESS in listed(marks, "not-set")


def test_axes_differ_where_two_of_a_kind_have_other_values(marks: ValueFilters) -> None:
    row = next(r for r in rows_of_file(marks.file) if r[0][0] == "servo.inposition_band")
    assert not marks.differs(row)  # 0.0254 mm on three axes and 0.0254 degrees on two
    marks.file.set(row[0], marks.file.read(row[0], "0.03 mm"))
    marks.forget([row[0]])
    assert marks.differs(row)
    names = next(r for r in rows_of_file(marks.file) if r[0][0] == "axis.name")
    assert not marks.differs(names)


def test_what_differs_from_the_last_download_is_listed_once_that_is_known(marks: ValueFilters) -> None:
    assert listed(marks, "since-download") == set()
    marks.downloaded = dict(marks.file.values)
    marks.file.set(EXCESS, marks.file.read(EXCESS, "13 mm"))
    assert listed(marks, "since-download") == {EXCESS}


def test_marks_combine_on_the_same_value(marks: ValueFilters) -> None:
    marks.recent, marks.bookmarked, marks.noted = [EXCESS], {"servo.excess_error", "feedrate.rapid"}, {EXCESS}
    assert listed(marks, "recent", "bookmarked", "noted") == {EXCESS}
    assert len(listed(marks, "bookmarked")) > 2
    assert listed(marks, "recent", "not-set") == set()


def test_only_values_that_wait_for_a_restart_are_listed_as_such(marks: ValueFilters) -> None:
    file = marks.file
    found = listed(marks, "restart")
    levels = {(file.schema.parameters[a[0]].effect or file.schema.family.effect).level for a in found}
    assert found
    assert levels <= {"restart", "reset"}


@pytest.mark.parametrize(
    "example", some(["mill-1394/MILL_1394", "num-1060-mill/MILL_1060", "grblhal-router/GRBL_ROUTER"], 2)
)
def test_after_any_edit_the_counts_are_those_of_a_fresh_start(example: str) -> None:
    """What is remembered between edits is never stale."""
    file = open_file(EXAMPLES / f"{example}.amp").file
    validator = Validator(file)
    kept = ValueFilters(file, saved=dict(file.values))
    kept.take_findings(validator.run())

    def counts(marks: ValueFilters) -> dict[FilterName, int]:
        rows = rows_of_file(file)
        return {mark: marks.counted(mark, rows) for mark in FILTER_NAMES}

    addresses: list[Address] = [a for a in file.values if not file.schema.parameters[a[0]].secret][::97]
    for address in addresses:
        for value in (file.default(address), None, kept.saved.get(address)):
            file.set(address, value)
            kept.forget([address])
            kept.take_findings(validator.update([address]))
            fresh = ValueFilters(file, saved=kept.saved)
            fresh.take_findings(validator.findings())
            assert counts(kept) == counts(fresh), address
