"""The ballscrew compensation of page 107 as the file that the controller reads."""

from pathlib import Path

import pytest

from amp_studio.families.acromill.formats.ballscrew import FORMAT
from amp_studio.families.acromill.formulas import ballscrew_words
from amp_studio.files import new_file
from amp_studio.formats import FormatError, ReadOptions, export_file, import_file
from amp_studio.schema import Value, load_schema

DIFFERENCES = [0.0, 0.00625, 0.00325, 0.00175, -0.0025, *[0.001] * 36, 0.0025]
"""Positions 0 to 4 and the last one as on page 107; the page leaves out those between."""

PRINTED = ["X0E.00325", "X1E.00175", "X2E-.00250"]
LAST = ["X39E.00250", "X40E.00000", "X41E.00625"]


def test_the_table_of_the_guide_is_written_line_by_line_and_read_again(tmp_path: Path) -> None:
    file = new_file("acromill", "mill")
    table = Value(ballscrew_words("X", DIFFERENCES, 2))
    file.set(("ballscrew.table", "X"), table)
    file.set(("ballscrew.table", "Z"), Value("Z0E.00000 Z1E-.00010"))
    path = tmp_path / "screw.bsc"
    assert export_file(file, path).format is FORMAT
    lines = path.read_bytes().decode().split("\r\n")
    assert (lines[:3], lines[39:42], lines[42:]) == (PRINTED, LAST, ["Z0E.00000", "Z1E-.00010", ""])
    again = import_file(path)
    assert again.values == {("ballscrew.table", a): file.get(("ballscrew.table", a)) for a in "XZ"}


@pytest.mark.parametrize(
    ("text", "line", "column", "message"),
    [
        ("X0E.00325\nX1E.0175\n", 2, 1, "'X1E.0175' is no word"),
        ("X0E.00325\n  X2E.00175\n", 2, 3, "the next position of X is 1"),
        ("X0E.00325\nX0E.00325\n", 2, 1, "the next position of X is 1"),
        ("X0E.00325\n\nQ0E.00000\n", 3, 1, "there is no axis Q"),
        ("X1E.00325\n", 1, 1, "the next position of X is 0"),
        ("\n", None, None, "no word of compensation"),
    ],
)
def test_a_line_that_cannot_be_understood_is_reported(
    text: str, line: int | None, column: int | None, message: str
) -> None:
    with pytest.raises(FormatError, match=message) as refused:
        FORMAT.read(text, load_schema("acromill"), ReadOptions())
    assert (line, column) == (refused.value.line, refused.value.column)


def test_a_file_without_a_table_is_not_written(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="no axis has a table"):
        export_file(new_file("acromill", "mill"), tmp_path / "screw.bsc")
    assert list(tmp_path.iterdir()) == []
