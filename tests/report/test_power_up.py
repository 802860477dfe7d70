"""The chapter of what is active in part programs after power-up."""

from pathlib import Path

import pytest

from amp_studio.files import open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.report import Contents, print_report
from amp_studio.report.build import build_report

MILL = examples_folder() / "mill-1394" / "MILL_1394.amp"


def test_the_chapter_has_a_line_for_each_group_of_codes() -> None:
    lines = {line.what: line for line in build_report(open_file(MILL).file).power_up}
    assert (lines["unit"].code, lines["unit"].numbers, lines["unit"].page) == ("G21", "526", "18-3")
    assert lines["G92 offsets after a reset"].meaning == "Yes"


def test_a_parameter_without_a_number_has_its_name_on_paper_and_its_id_as_data() -> None:
    router = open_file(examples_folder() / "acromill-router" / "ROUTER.amp").file
    lines = {
        line.what: line for line in build_report(router, Contents(without=frozenset({"pictures"}))).power_up
    }
    assert (lines["unit"].parameters, lines["unit"].numbers) == ("Default Units", "control.default_units")


def test_it_can_be_left_out_and_a_family_without_such_pages_has_none() -> None:
    assert build_report(open_file(MILL).file, Contents(without=frozenset({"power-up"}))).power_up == ()
    press = examples_folder() / "57c422b-label-press" / "LABEL_PRESS.amp"
    assert build_report(open_file(press).file).power_up == ()


@pytest.mark.parametrize("ending", [".html", ".txt", ".json"])
def test_it_is_printed(tmp_path: Path, ending: str) -> None:
    paper = tmp_path / f"mill{ending}"
    print_report(open_file(MILL).file, paper, Contents(without=frozenset({"pictures"})))
    text = paper.read_text("utf-8")
    assert "level of return of a cycle" in text
