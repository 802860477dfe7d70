"""The list of printed figures of machines in motion: each has a test that there is, or a reason why it has
none."""

import re
from functools import cache
from pathlib import Path

from amp_studio.schema.yaml_reader import read_yaml

ROOT = Path(__file__).parents[2]
LIST = Path(__file__).with_name("printed_figures.yaml")
COVERAGE = ROOT / "docs" / "coverage.md"
LOST = "lost: "


@cache
def text_of(path: str) -> str:
    return (ROOT / path).read_text("utf-8")


def figures() -> dict[str, list[list[str]]]:
    return read_yaml(LIST.read_text("utf-8")).data


def test_each_printed_figure_has_its_test() -> None:
    missing = []
    for _family, _page, what, test in (row for rows in figures().values() for row in rows):
        path, _, name = test.partition("::")
        if not test.startswith(LOST) and f"def {name}(" not in text_of(path):
            missing.append(f"{what}: {test}")
    assert not missing


def test_the_document_counts_them() -> None:
    """Subject by subject, and together: figures, those with a test, those that have none."""
    counted = {
        subject: (len(rows), sum(row[3].startswith(LOST) for row in rows))
        for subject, rows in figures().items()
    }
    counted["together"] = tuple(map(sum, zip(*counted.values(), strict=True)))
    rows = re.findall(r"^\| (.+?) \| (\d+) \| (\d+) \| (\d+) \|$", COVERAGE.read_text("utf-8"), re.MULTILINE)
    assert {name: (int(all_), int(lost)) for name, all_, _, lost in rows} == counted
    assert all(int(all_) == int(tested) + int(lost) for _, all_, tested, lost in rows)
