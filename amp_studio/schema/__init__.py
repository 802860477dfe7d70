"""What a parameter is: family, group, parameter, instance, unit, choice, state, range.

Loads ``parameter_db`` once into a compiled cache and answers questions about
it; every other room asks here and knows no parameter by heart.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .address import Address, UnknownParameterError, read_address, whole_of, written
    from .addressing import (
        ResolvedAddress,
        axis_group,
        axis_name,
        is_fitted,
        resolve_address,
        resolve_addresses,
        resolve_all,
        resolve_axis,
        unknown,
    )
    from .bit_fields import field_at, field_value, labels_of_word, with_field
    from .catalog import Schema, load_schema
    from .cel_engine import WORD_FUNCTIONS, Context, Program, functions_called
    from .conditions import ACTIVE, Reference, StateInfo
    from .constraint import Limits, bounding, clip, fault, limits
    from .described import DescriptionError, described_schema
    from .described_parameters import (
        DescribedControl,
        DescribedGroup,
        DescribedParameter,
        DescribedSchema,
        group_key,
    )
    from .evaluation import Evaluation, same_key, same_value
    from .expression import (
        ALWAYS_THERE,
        EVALUATION_ERRORS,
        NO_RESULT,
        Circumstances,
        Decision,
        Expression,
        Remembered,
        ValueKey,
        context_of,
        key_of,
        program,
        value_of,
    )
    from .file_error import FileError, ModelError, Slip, read_yaml_file, text_of
    from .folder import cache_folder, database_folder
    from .load import DatabaseError, FactEntry, UnknownFamilyError, family_ids, read_entries
    from .machine_schema import MachineSchema, labelled
    from .model import (
        ArcTolerance,
        AxisDeclaration,
        AxisField,
        AxisProfile,
        Bit,
        BoundRef,
        BuilderRule,
        CamRoles,
        Choice,
        CodeGroup,
        Commissioning,
        ControlMessage,
        Default,
        Direction,
        Erratum,
        ErrorRoles,
        FactTexts,
        Family,
        GearRoles,
        Group,
        Guide,
        GuideStep,
        HelpNote,
        HomePlace,
        JogRoles,
        LoopBlock,
        LoopRoles,
        MacroCall,
        Messages,
        Model,
        MotionFacts,
        Parameter,
        ParameterId,
        ParameterState,
        ProgramCode,
        ProgramPath,
        RampKind,
        RampRoles,
        Range,
        Rule,
        Scope,
        Severity,
        SpanRole,
        StateRule,
        Storage,
        Suppression,
        Table,
        TableRoles,
        TimeOf,
        TravelRoles,
        Usual,
        WayToControl,
        WordUse,
        ZoneRole,
    )
    from .model.compiled_json import record_text
    from .model.motion import NO_MOTION
    from .model.parameter import ValueType
    from .model.plausible import AmongAxes, Gears, Proportion, Quotient, Towards, TravelEnds, TravelSpan
    from .model_errors import read_model
    from .nearest import close_matches, did_you_mean, unknown_name
    from .quoting import quoted, short
    from .registration import (
        Registration,
        added_facts,
        load_part,
        registered_families,
        registration_of,
        why_not_simulated,
    )
    from .regular_file import HARMLESS, NO_LINK, demand_file, read_file, read_table_text
    from .scales import read_real, real_value, size_of, unit_size
    from .storage import (
        WORD,
        StorageError,
        choice_of,
        code_of,
        exact,
        from_stored,
        is_low_first,
        register_number,
        shown_number,
        single,
        stored_number,
        stored_unit,
        to_figure,
        to_stored,
        value_of_register,
        value_of_stored,
        value_of_words,
        words_of,
        words_taken,
    )
    from .translation.places import figures_in
    from .translation.program_texts import program_texts
    from .translation.text_direction import isolated, isolated_path
    from .translation.texts import NO_TEXTS, fact_texts
    from .units import (
        UNITS,
        UnitError,
        angular,
        canonical,
        canonical_unit,
        convert,
        dimension,
        unit_named,
        unit_text,
    )
    from .value import InvalidValueError, Value
    from .values import (
        MASKED,
        NOT_SET,
        checked,
        choice_key,
        choice_value,
        exact_number,
        is_mask,
        label_of,
        not_readable,
        read_bare_number,
        read_exact,
        read_number,
        read_value,
        show_value,
        write_figure,
        write_number,
        write_value,
    )
    from .visible_text import visible
    from .yaml_reader import (
        KeyPath,
        Span,
        YamlDocument,
        YamlError,
        read_yaml,
        spelled_scalar,
        text_scalar,
        typed_scalar,
    )
else:
    __getattr__ = front_page(__name__)
