"""The list of printed figures of machines in motion names a test for each, which there is."""

from __future__ import annotations

from pathlib import Path

from amp_studio.schema.yaml_reader import read_yaml

ROOT = Path(__file__).parents[2]
LIST = Path(__file__).with_name("printed_figures.yaml")


def test_each_printed_figure_has_its_test() -> None:
    rows = read_yaml(LIST.read_text("utf-8")).data
    missing = []
    for _family, _page, what, test in rows:
        path, _, name = test.partition("::")
        if f"def {name}(" not in (ROOT / path).read_text("utf-8"):
            missing.append(f"{what}: {test}")
    assert not missing
    assert len({test for *_, test in rows}) > 40
