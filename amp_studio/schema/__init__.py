"""What a parameter is: family, group, parameter, instance, unit, choice, state, range.

Loads ``parameter_db`` once into a compiled cache and answers questions about
it; every other room asks here and knows no parameter by heart.
"""

from .catalog import Address, Schema, UnknownParameter, labelled, load_schema, part_of, read_address, written
from .conditions import IN_FORCE, Reading, StateInfo, program
from .constraint import Limits, bounding, clip, fault, limits
from .file_error import FileError
from .load import DatabaseFault, Entry, UnknownFamilyError, database_folder, family_ids, read_entries
from .model import (
    AxisProfile,
    BuilderRule,
    Choice,
    Condition,
    Erratum,
    Group,
    Parameter,
    Rule,
    Suppression,
    Table,
)
from .situation import Situation, canonical_value, same_value
from .units import UnitError, angular, canonical, canonical_unit, convert, dimension, shown, unit_named
from .values import (
    MASKED,
    Value,
    ValueFault,
    field_at,
    field_value,
    is_mask,
    label_of,
    not_readable,
    read_number,
    read_value,
    show_value,
    with_field,
    write_number,
    write_value,
)

__all__ = [
    "IN_FORCE",
    "MASKED",
    "Address",
    "AxisProfile",
    "BuilderRule",
    "Choice",
    "Condition",
    "DatabaseFault",
    "Entry",
    "Erratum",
    "FileError",
    "Group",
    "Limits",
    "Parameter",
    "Reading",
    "Rule",
    "Schema",
    "Situation",
    "StateInfo",
    "Suppression",
    "Table",
    "UnitError",
    "UnknownFamilyError",
    "UnknownParameter",
    "Value",
    "ValueFault",
    "angular",
    "bounding",
    "canonical",
    "canonical_unit",
    "canonical_value",
    "clip",
    "convert",
    "database_folder",
    "dimension",
    "family_ids",
    "fault",
    "field_at",
    "field_value",
    "is_mask",
    "label_of",
    "labelled",
    "limits",
    "load_schema",
    "not_readable",
    "part_of",
    "program",
    "read_address",
    "read_entries",
    "read_number",
    "read_value",
    "same_value",
    "show_value",
    "shown",
    "unit_named",
    "with_field",
    "write_number",
    "write_value",
    "written",
]
