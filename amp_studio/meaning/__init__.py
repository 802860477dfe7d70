"""What the parameters of a machine mean, whatever the family: read by facts, written for another control,
graded one by one.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .comparison import compare_meanings
    from .description import AxisMeaning, ConceptFigure, MachineMeaning, MigrationQuestion
    from .folder import read_answers, write_migration
    from .migration import (
        MigratedParameter,
        Migration,
        less_safe,
        migrate,
        migration_json,
        targets,
        to_measure,
    )
    from .reading import MeaningError
    from .writing import Graded, GradeKind, TargetError, WrittenMachine, inwards_high, inwards_low, not_above
else:
    __getattr__ = front_page(__name__)
