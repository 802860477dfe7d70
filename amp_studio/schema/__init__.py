"""What a parameter is: family, group, parameter, instance, unit, choice, state, range.

Loads ``parameter_db`` once into a compiled cache and answers questions about
it; every other room asks here and knows no parameter by heart.
"""

from .address import Address, UnknownParameterError, part_of, read_address, written
from .addressing import (
    Meant,
    addresses_meant,
    all_meant,
    axis_group,
    axis_meant,
    axis_name,
    is_fitted,
    meant,
    unknown,
)
from .bit_fields import field_at, field_value, with_field
from .catalog import Schema, load_schema
from .conditions import ACTIVE, Reference, StateInfo
from .constraint import Limits, bounding, clip, fault, limits
from .evaluation import Evaluation, same_value
from .expression import canonical_value, program
from .file_error import FileError
from .folder import database_folder
from .load import DatabaseError, FactEntry, UnknownFamilyError, family_ids, read_entries
from .machine_schema import MachineSchema, labelled
from .model import (
    AxisProfile,
    BuilderRule,
    Choice,
    Condition,
    Erratum,
    Group,
    Parameter,
    Plausible,
    Rule,
    Suppression,
    Table,
    Usual,
)
from .scales import Size, read_real, real_value, size_of
from .units import UnitError, angular, canonical, canonical_unit, convert, dimension, shown, unit_named
from .value import InvalidValueError, Value
from .values import (
    MASKED,
    checked,
    is_mask,
    label_of,
    not_readable,
    read_number,
    read_value,
    show_value,
    write_figure,
    write_number,
    write_value,
)

__all__ = [
    "ACTIVE",
    "MASKED",
    "Address",
    "AxisProfile",
    "BuilderRule",
    "Choice",
    "Condition",
    "DatabaseError",
    "Erratum",
    "Evaluation",
    "FactEntry",
    "FileError",
    "Group",
    "InvalidValueError",
    "Limits",
    "MachineSchema",
    "Meant",
    "Parameter",
    "Plausible",
    "Reference",
    "Rule",
    "Schema",
    "Size",
    "StateInfo",
    "Suppression",
    "Table",
    "UnitError",
    "UnknownFamilyError",
    "UnknownParameterError",
    "Usual",
    "Value",
    "addresses_meant",
    "all_meant",
    "angular",
    "axis_group",
    "axis_meant",
    "axis_name",
    "bounding",
    "canonical",
    "canonical_unit",
    "canonical_value",
    "checked",
    "clip",
    "convert",
    "database_folder",
    "dimension",
    "family_ids",
    "fault",
    "field_at",
    "field_value",
    "is_fitted",
    "is_mask",
    "label_of",
    "labelled",
    "limits",
    "load_schema",
    "meant",
    "not_readable",
    "part_of",
    "program",
    "read_address",
    "read_entries",
    "read_number",
    "read_real",
    "read_value",
    "real_value",
    "same_value",
    "show_value",
    "shown",
    "size_of",
    "unit_named",
    "unknown",
    "with_field",
    "write_figure",
    "write_number",
    "write_value",
    "written",
]
