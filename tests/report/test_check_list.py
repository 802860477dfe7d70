"""The printed check list: a box for each step, a blank for each value that is not set."""

from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import pytest

from amp_studio.files import new_file, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.guide import find_step, progress, steps_of, tick
from amp_studio.report.papers.check_list import (
    WIDTH,
    CheckList,
    build_check_list,
    render_check_list_html,
    render_check_list_text,
    write_check_list,
)
from amp_studio.schema import Value
from amp_studio.validate import Validator

from .test_pages import small_words
from .test_pdf import poppler, texts_of

NOON = datetime(2026, 11, 22, 12, 0, tzinfo=UTC)


@pytest.fixture
def checks() -> CheckList:
    """Return the list of a new mill, whose dual axes somebody has ticked."""
    file = new_file("9pc", "mill", ["X", "Y", "Z"], "mill <1>")
    tick(file, find_step(file.schema, "dual"), "2026-11-22T10:00:00+00:00 by ann")
    validator = Validator(file)
    return build_check_list(file, progress(validator, validator.run()), Path("mill.amp"), NOON)


def test_every_open_value_has_a_blank_with_its_unit_and_what_is_allowed(checks: CheckList) -> None:
    text = render_check_list_text(checks).decode()
    assert text.count("[ ] ______________") == sum(len(each.values) for each in checks.steps) == 336
    assert "[ ] ______________ mm/min  1011 G28 Home Speed X (0 to 10160 mm/min; page 5-16)" in text
    assert "[ ] ______________         1010 G28 Direction to Home X (plus / minus; page 5-15)" in text


def test_a_done_step_is_ticked_with_who_did_it(checks: CheckList) -> None:
    text = render_check_list_text(checks).decode()
    assert "\n[x] 19  Dual and deskewed axes (page 31-1)\n" in text
    assert "by ann" in text
    assert "[ ]  3  Homing (page 5-1)" in text
    assert "Position loop" not in text  # nothing of it is active without servos


def test_the_errors_of_a_step_are_on_it_once() -> None:
    file = open_file(examples_folder() / "mill-1394" / "MILL_1394.amp").file
    file.set(("servo.excess_error", "1"), Value(0.001, "mm"))
    validator = Validator(file)
    errors = [finding for finding in validator.run() if finding.severity == "error"]
    checks = build_check_list(file, progress(validator, validator.run()), Path("mill.amp"), NOON)
    text = " ".join(render_check_list_text(checks).decode().split())
    assert errors
    assert [text.count(error.message) for error in errors] == [1] * len(errors)
    assert f"{len(errors)} error" in text


def test_no_line_is_wider_than_the_page(checks: CheckList) -> None:
    assert [line for line in render_check_list_text(checks).decode().splitlines() if len(line) > WIDTH] == []


def test_a_name_cannot_become_markup(checks: CheckList) -> None:
    page = render_check_list_html(checks).decode()
    assert "mill &lt;1&gt;" in page
    assert "<h1>mill <1>" not in page


def test_an_unknown_ending_is_refused_and_nothing_written(checks: CheckList, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"list\.xls: unknown format of a check list"):
        write_check_list(checks, tmp_path / "list.xls")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("family", ["num", "syntec", "57c422b", "acromill", "grblhal"])
def test_every_family_has_a_list(family: str) -> None:
    validator = Validator(new_file(family))
    come = progress(validator, validator.run())
    found = build_check_list(validator.file, come)
    assert len(found.steps) == len(come.needed)
    assert render_check_list_text(found)


@poppler
def test_steps_without_values_fill_a_page_and_no_type_is_small(tmp_path: Path) -> None:
    file = new_file("9pc", "mill", ["X"])
    for step in steps_of(file.schema):
        tick(file, step, "2026-11-22T10:00:00+00:00 by ann")
    validator = Validator(file)
    checks = build_check_list(file, progress(validator, validator.run()), Path("mill.amp"), NOON)
    done = replace(checks, steps=tuple(replace(each, values=()) for each in checks.steps))
    write_check_list(done, tmp_path / "l.pdf")
    assert "Homing" in texts_of(tmp_path / "l.pdf")[0]
    assert small_words(tmp_path / "l.pdf") == set()
