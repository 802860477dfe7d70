"""A family with tables of hundreds of entries, of which an operator fills a few."""

from __future__ import annotations

from amp_studio.files import open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.report.build import build_report


def test_of_a_table_only_what_is_set_is_printed() -> None:
    (path,) = (examples_folder() / "acromill-router").glob("*.amp")
    file = open_file(path).file
    values = int(dict(build_report(file).counts)["Values"])
    assert len(file.values) <= values < 400, "not the thousands of entries that are empty"
    file.set(("offset.r_geometric", "7"), None)
    assert int(dict(build_report(file).counts)["Values"]) == values - 1
