"""The database of AcroMill holds what the tables of its guide print, or an erratum says why not.

The rows in acromill.yaml were taken from the guide without a look at the database (scripts/extract_acromill.py).
"""

from __future__ import annotations

from pathlib import Path

import pytest
from ruamel.yaml import YAML

from amp_studio.files import new_file
from amp_studio.schema import Parameter, Schema, load_schema, show_value

FACTS = YAML(typ="safe").load(Path(__file__).with_name("acromill.yaml").read_text("utf-8"))
TABLES = ("servo", "axes", "control", "control", "home", "jog", "io", "speeds", "spindle", "tool")
"""Group of each table, in the order of the guide."""

NAMES = {
    "HandwheelRatio": "Handwheel Ratio",  # two words on the screen
    "At Zero Output": "At Zero Input",  # erratum e-at-zero-name
}
DEFAULTS = {
    "Spindle OFF Output": "-1",  # erratum e-spindle-off-default
    "Axis Name": "X",  # X,Y... one letter for each axis
}
RAMPS = ("Home Acceleration", "Home Deceleration", "Home STP")  # erratum e-home-ramp-units
QUANTITIES = {
    "Inch or mm per sec per sec": "acceleration",
    "Inch or mm per second": "velocity",
    "Inch or mm per minute": "velocity",
    "Inch or mm": "length",
    "Degrees": "angle",
    "volts": "voltage",
    "second": "time",
}
UNITS = {
    "volts/pulses of following error": "V/count",
    "volts/second/pulses of following error": "V/count/s",
    "volts/pulses of following error/second": "Vs/count",
    "volts/incoming setpoint pulses/second": "Vs/count",
    "volts/incoming setpoint pulses/sec ²": "Vs2/count",
    "Radians": "rad",
}
TYPES = {"Integer": ("integer", "bits"), "Boolean": ("boolean",), "Float": ("real",), "Sign": ("choice",)}


@pytest.fixture(scope="module")
def acromill() -> Schema:
    return load_schema("acromill")


def described(schema: Schema, row: dict[str, str]) -> Parameter:
    """Return the parameter of a row; the chapter on cutter compensation repeats three of the Control tab."""
    name = NAMES.get(row["name"], row["name"])
    group = TABLES[int(row["table"]) - 1]
    named = [p for p in schema.parameters.values() if p.name == name]
    (found,) = [p for p in named if schema.group_of[p.id].key == group] or [
        p for p in named if schema.group_of[p.id].key == "control"
    ]
    return found


ROWS = pytest.mark.parametrize("row", FACTS["rows"], ids=lambda row: f"{row['line']} {row['name']}")


@ROWS
def test_a_default_is_the_printed_one(acromill: Schema, row: dict[str, str]) -> None:
    parameter = described(acromill, row)
    file = new_file("acromill")
    default = file.default((parameter.id, acromill.instances(parameter, "mill")[0]))
    printed = DEFAULTS.get(row["name"], row["default"])
    if printed == "NA":
        assert default is None
        return
    assert default is not None
    if parameter.type in ("real", "integer", "bits"):
        assert float("-1" if printed == "Disable" else printed) == default.value
    else:
        assert printed.casefold() == show_value(parameter, default).casefold()


@ROWS
def test_a_unit_is_the_printed_one(acromill: Schema, row: dict[str, str]) -> None:
    parameter, printed = described(acromill, row), row["unit"].rstrip(".")
    printed = "Inch or mm per sec per sec" if row["name"] in RAMPS else printed
    if printed in UNITS:
        assert parameter.unit == UNITS[printed]
    elif printed in TYPES:
        assert parameter.type in TYPES[printed]
    elif parameter.type == "choice":
        assert printed in ("NA", "Inch or mm")  # Default Units
    elif printed != "NA":
        assert parameter.quantity == next(QUANTITIES[unit] for unit in QUANTITIES if printed.startswith(unit))


@ROWS
def test_a_typical_value_that_is_not_the_default_is_told(acromill: Schema, row: dict[str, str]) -> None:
    typical = row["typical"]
    if typical != row["default"] and typical not in (
        "Machine+",
        "Machine-",
        "User Choice",
        "User Defined",
        "X,Y....",
    ):
        told = described(acromill, row).help
        assert typical in f"{told.what} {told.find} {told.wrong}"


SCREEN_ONLY = {
    "control.angular_acc_threshold",
    "control.corner_arc_threshold",
    "control.ignore_cycle_start",
    "control.perpendicular_axis",
    "control.inverted_inputs",
    "control.inverted_outputs",
    "speeds.rapid",
}
"""Parameters of these tabs that no table has: errata e-control-fields, e-logic-masks and e-rapid-speed."""


def test_no_tab_with_a_table_has_a_parameter_that_the_guide_does_not_have(acromill: Schema) -> None:
    rows = {described(acromill, row).id for row in FACTS["rows"]}
    held = {p.id for p in acromill.parameters.values() if acromill.group_of[p.id].key in TABLES}
    assert held - rows == SCREEN_ONLY


def test_the_runs_of_the_tuning_procedure_are_the_printed_lists(acromill: Schema) -> None:
    table = acromill.tables["tuning-runs"]
    for name in ("PGAIN", "IGAIN", "IDELAY", "ILIMIT", "DWIDTH", "DGAIN", "FFVEL", "FFACC", "TLM"):
        printed = [float(gain["value"]) for gain in FACTS["gains"] if gain["name"] == name]
        assert list(table.column(name) or ()) == printed
