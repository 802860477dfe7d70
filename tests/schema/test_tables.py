"""The printed tables: one form for all, and no word against the parameters they belong to."""

from collections import Counter

import pytest
from pydantic import ValidationError

from amp_studio.schema import family_ids, load_schema
from amp_studio.schema.load import load_compiled
from amp_studio.schema.model import Table
from amp_studio.schema.model.compiled_json import text_record

ROW = {"id": "1", "title": "A table", "page": "1-1", "head": ["Axis", "Speed"]}


@pytest.mark.parametrize("family", family_ids())
def test_every_table_has_an_id_of_its_own_and_belongs_to_parameters_that_exist(family: str) -> None:
    tables = text_record(load_compiled(family).further).tables
    assert [name for name, times in Counter(table.id for table in tables).items() if times > 1] == []
    known = load_schema(family).parameters
    assert [(table.id, name) for table in tables for name in table.params if name not in known] == []
    assert [table.id for table in tables if not table.rows or len(table.head) < 2] == []


def test_a_row_has_as_many_cells_as_there_are_columns() -> None:
    assert Table.model_validate(ROW | {"rows": [["X", 5], ["Y", "none"]]}).rows == (("X", 5.0), ("Y", "none"))
    with pytest.raises(ValidationError, match="row 2 has 1 cells below 2 columns"):
        Table.model_validate(ROW | {"rows": [["X", 5], ["Y"]]})
    with pytest.raises(ValidationError, match="2 columns and 1 units"):
        Table.model_validate(ROW | {"rows": [], "units": ["mm"]})


def test_a_column_is_found_by_any_of_the_names_in_its_head(ninepc) -> None:
    gains = ninepc.tables["7.B"]
    assert gains.column("B410J") == gains.column("B410G") == (1000.0, 2000.0, 3000.0, 4000.0)
    assert gains.column("B410") is None


@pytest.mark.parametrize(
    ("table", "column", "parameter", "left_out"),
    [
        ("standard-motors", "Motor", "servo.motor_type", {"Nonstandard"}),
        ("output-port-connections", "Output Port Number", "servo.output_port", set()),
        ("loop-type-commands", "Servo Loop Type", "servo.loop_type", set()),
        ("servo-types", "Servo Type", "servo.hardware_type", set()),
    ],
)
def test_a_table_lists_the_choices_of_its_parameter(
    ninepc, table: str, column: str, parameter: str, left_out: set[str]
) -> None:
    choices = [choice.label for choice in ninepc.parameter(parameter).choices]
    assert list(ninepc.tables[table].column(column)) == [c for c in choices if c not in left_out]


def test_the_patch_codes_of_the_axis_modules_go_by_their_power(ninepc) -> None:
    """Page 37-3 exchanges names, not powers (erratum e-1780-names)."""
    codes, powers = (ninepc.tables["amplifier-codes"].column(name) for name in ("Code", "Power"))
    choices = [choice for choice in ninepc.parameter("servo.amplifier_type").choices if choice.raw]
    assert [(c.raw, c.key) for c in choices] == [
        (n, f"kw{p:.0f}") for n, p in zip(codes, powers, strict=True)
    ]


def test_the_defaults_of_the_axis_types_are_those_of_the_table(ninepc) -> None:
    default = ninepc.parameter("axis.type").default
    found = [
        default.instances.get(f"{axis:.0f}", default.value)
        for axis, _, _ in ninepc.tables["axis-type-defaults"].rows
    ]
    assert list(ninepc.tables["axis-type-defaults"].column("Axis Type")) == found


def test_the_function_codes_of_the_dac_monitor_are_those_of_its_rule(ninepc) -> None:
    (rule,) = (rule for rule in ninepc.rules if rule.id == "9pc.patch.dac-code")
    codes = ninepc.tables["A.B"].column("Function Code")
    assert f"(code - n) in {list(codes)}" in rule.check


def test_the_modal_groups_name_the_codes_that_parameters_offer(ninepc) -> None:
    """Chapter 18: the choices of a parameter named after its codes are codes of the table."""
    codes = {code.lower() for row in ninepc.tables["modal-groups"].rows for code in row[1:5]}
    for name in (
        "motion",
        "plane",
        "distance_mode",
        "tool_length",
        "radius_diameter",
        "zones",
        "path_mode",
        "comp_corner",
        "short_block",
        "accdec_mode",
        "synch_mode",
    ):
        assert {c.key for c in ninepc.parameter(f"powerup.{name}").choices or ()} <= codes, name


def test_what_can_be_tuned_on_line_is_what_the_screens_of_chapter_36_name(ninepc) -> None:
    tunable = {name for name, parameter in ninepc.parameters.items() if parameter.tunable}
    assert tunable == set(ninepc.tables["online-screens"].params)
