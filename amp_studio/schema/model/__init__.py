"""The words the parameter database is written in.

Every YAML file under ``parameter_db`` is read into these models, and into
nothing else: what a family can describe is exactly what is here. A model
forbids unknown keys, so a typing error in a fact cannot hide.

``docs/schema.md`` explains the same words to somebody who writes YAML.
"""

from .documents import (
    Errata,
    Erratum,
    Guide,
    Guides,
    GuideStep,
    Statement,
    Table,
    Tables,
)
from .family import (
    AxisProfile,
    Condition,
    Family,
    MachineType,
    ScopeInfo,
    UnitScale,
    UnitSize,
)
from .group import Group, GroupState
from .parameter import (
    Bit,
    Bound,
    BoundRef,
    Choice,
    Default,
    Effect,
    Help,
    Layout,
    Need,
    Numbers,
    Parameter,
    ParameterState,
    Quantity,
    Range,
    RangeVariant,
    StateRule,
    Storage,
    ValueType,
)
from .record import (
    Instances,
    Key,
    Model,
    Page,
    ParameterId,
    Scope,
    Unit,
)
from .rule import (
    Assignment,
    BuilderRule,
    Fix,
    Rule,
    Rules,
    Severity,
    Suppression,
)

__all__ = [
    "Assignment",
    "AxisProfile",
    "Bit",
    "Bound",
    "BoundRef",
    "BuilderRule",
    "Choice",
    "Condition",
    "Default",
    "Effect",
    "Errata",
    "Erratum",
    "Family",
    "Fix",
    "Group",
    "GroupState",
    "Guide",
    "GuideStep",
    "Guides",
    "Help",
    "Instances",
    "Key",
    "Layout",
    "MachineType",
    "Model",
    "Need",
    "Numbers",
    "Page",
    "Parameter",
    "ParameterId",
    "ParameterState",
    "Quantity",
    "Range",
    "RangeVariant",
    "Rule",
    "Rules",
    "Scope",
    "ScopeInfo",
    "Severity",
    "StateRule",
    "Statement",
    "Storage",
    "Suppression",
    "Table",
    "Tables",
    "Unit",
    "UnitScale",
    "UnitSize",
    "ValueType",
]
