"""Printed tables: columns of numbers, or rows of texts under a head."""

from __future__ import annotations

import pytest
from pydantic import ValidationError

from amp_studio.schema.model import Table

ROWS = {"head": ["Mill", "Lathe C"], "rows": [["G20", "G70"], ["G21", ""]]}
COLUMNS = {"columns": [{"name": "Gain", "values": [0.25, 0.5]}]}


def table(**content: object) -> Table:
    """Return a small table."""
    return Table.model_validate({"id": "small", "title": "Small", "page": "1-1"} | content)


def test_a_table_of_texts_keeps_its_rows() -> None:
    assert table(**ROWS).rows == (("G20", "G70"), ("G21", ""))
    assert table(**COLUMNS).rows == ()


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ({}, "either 'columns' of numbers or 'rows' of texts"),
        (ROWS | COLUMNS, "either 'columns' of numbers or 'rows' of texts"),
        (ROWS | {"rows": [["G20"]]}, "as many cells as its head"),
    ],
)
def test_a_table_is_of_one_kind_and_even(content: dict[str, object], said: str) -> None:
    with pytest.raises(ValidationError, match=said):
        table(**content)


def test_the_modal_groups_name_the_codes_that_parameters_offer(ninepc) -> None:
    """Chapter 18: the choices of a parameter named after its codes are codes of the table."""
    codes = {code.lower() for row in ninepc.tables["modal-groups"].rows for code in row[1:5]}
    for name in ("motion", "plane", "distance_mode", "tool_length", "radius_diameter", "zones", "path_mode",
                 "comp_corner", "short_block", "accdec_mode", "synch_mode"):  # fmt: skip
        assert {c.key for c in ninepc.parameter(f"powerup.{name}").choices or ()} <= codes, name
