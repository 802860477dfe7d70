"""The words the parameter database is written in.

Every YAML file under ``parameter_db`` is read into these models, and into nothing else: what a family can
describe is exactly what is here. A model forbids unknown keys, so a typing error in a fact cannot hide.

``docs/schema.md`` explains the same words to a person who writes YAML.
"""

from .commissioning import Commissioning, CommissioningStep, Remainder
from .documents import (
    ControlMessage,
    Errata,
    Erratum,
    Guide,
    Guides,
    GuideStep,
    Messages,
    Reaction,
    Statement,
    Table,
    Tables,
)
from .fact_texts import FactTexts, FactTranslation
from .family import (
    Area,
    AxisDeclaration,
    AxisField,
    AxisProfile,
    Condition,
    Family,
    MachineType,
    ScopeInfo,
    Units,
    UnitScale,
    UnitSize,
    WayToControl,
)
from .group import Group, GroupState
from .motion import AssumedFigure, MotionFacts
from .parameter import (
    Bit,
    Bound,
    BoundRef,
    Choice,
    Default,
    Effect,
    Help,
    HelpNote,
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
from .pictures import (
    CamRoles,
    Direction,
    ErrorRoles,
    GearRoles,
    HomePlace,
    JogRoles,
    LoopBlock,
    LoopRoles,
    PictureRoles,
    RampKind,
    RampRoles,
    ReachRole,
    SpanRole,
    TableRoles,
    TimeOf,
    TravelRoles,
    ZoneRole,
)
from .plausible import Plausible, Usual
from .program import (
    ArcTolerance,
    CodeGroup,
    Letter,
    MacroCall,
    ProgramCode,
    ProgramPath,
    ProgramWords,
    WordUse,
)
from .record import Instances, Key, Model, Page, ParameterId, Scope, Unit
from .rule import Assignment, BuilderRule, Fix, Rule, Rules, Severity, Suppression
from .synonyms import Synonyms
