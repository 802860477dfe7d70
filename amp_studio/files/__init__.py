"""Parameter files and projects: values in memory, on disk, and what becomes of them.

Saves are atomic and leave a backup, unsaved work survives a killed program,
two programs on one file notice each other, and a file that is not fully
understood is refused or kept whole.

What this page loads when it is first asked for is needed to change files, not to check them.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from .atomic import ChangedOnDiskError, Notify, SaveError, check_output, digest_of, was_replaced, write_atomic
from .parameter_file import (
    Change,
    Header,
    ParameterFile,
    RangeError,
    describe,
    fill_defaults,
    secret_values,
    without_secrets,
)
from .paths import ENDING, backup_path, is_there, real_path, same_file, text_of_name
from .reading import FORMAT, Opened, ParameterFileError, open_file, read_content
from .storage import content_of, save_file

if TYPE_CHECKING:
    from .axes import (
        AxisError,
        alike_axes,
        are_alike,
        axis_head,
        axis_instances,
        axis_kind,
        axis_letter,
        axis_profile,
        axis_title,
        axis_type,
        fitted_axes,
        shown_axes,
        unlike_axes,
    )
    from .axis_abilities import (
        letters_offered,
        parameters_of_axes,
        places_offered,
        why_axes_are_fixed,
        why_letters_are_fixed,
        why_types_are_fixed,
    )
    from .axis_fitting import add_axis, delete_axis, name_axes, rename_axis, retype_axis
    from .axis_values import AxisDifference, compare_axes, copy_axis, swap_axes
    from .creation import new_file
    from .diff import Comparison, Conflict, Difference, compare, merge
    from .document import Document, HistoryEntry, Unsaved, recover_backup
    from .lock import InUseError
    from .merging import Merge, Row, RowGroup, Typed
    from .project import InvalidNameError, Project, ProjectInfo

_PLACES = {
    "AxisDifference": "axis_values",
    "AxisError": "axes",
    "Comparison": "diff",
    "Conflict": "diff",
    "Difference": "diff",
    "Document": "document",
    "HistoryEntry": "document",
    "InUseError": "lock",
    "InvalidNameError": "project",
    "Merge": "merging",
    "Project": "project",
    "ProjectInfo": "project",
    "Row": "merging",
    "RowGroup": "merging",
    "Typed": "merging",
    "Unsaved": "document",
    "add_axis": "axis_fitting",
    "alike_axes": "axes",
    "are_alike": "axes",
    "axis_head": "axes",
    "axis_instances": "axes",
    "letters_offered": "axis_abilities",
    "places_offered": "axis_abilities",
    "axis_kind": "axes",
    "axis_letter": "axes",
    "axis_profile": "axes",
    "axis_title": "axes",
    "axis_type": "axes",
    "compare": "diff",
    "compare_axes": "axis_values",
    "copy_axis": "axis_values",
    "delete_axis": "axis_fitting",
    "fitted_axes": "axes",
    "merge": "diff",
    "name_axes": "axis_fitting",
    "new_file": "creation",
    "parameters_of_axes": "axis_abilities",
    "recover_backup": "document",
    "rename_axis": "axis_fitting",
    "retype_axis": "axis_fitting",
    "shown_axes": "axes",
    "swap_axes": "axis_values",
    "why_axes_are_fixed": "axis_abilities",
    "why_letters_are_fixed": "axis_abilities",
    "why_types_are_fixed": "axis_abilities",
    "unlike_axes": "axes",
}
"""Name -> its module."""


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__} has no attribute {name}")
    found = globals()[name] = getattr(import_module(f".{_PLACES[name]}", __name__), name)
    return found


__all__ = [
    "ENDING",
    "FORMAT",
    "AxisDifference",
    "AxisError",
    "Change",
    "ChangedOnDiskError",
    "Comparison",
    "Conflict",
    "Difference",
    "Document",
    "Header",
    "HistoryEntry",
    "InUseError",
    "InvalidNameError",
    "Merge",
    "Notify",
    "Opened",
    "ParameterFile",
    "ParameterFileError",
    "Project",
    "ProjectInfo",
    "RangeError",
    "Row",
    "RowGroup",
    "SaveError",
    "Typed",
    "Unsaved",
    "add_axis",
    "alike_axes",
    "are_alike",
    "axis_head",
    "axis_instances",
    "axis_kind",
    "axis_letter",
    "axis_profile",
    "axis_title",
    "axis_type",
    "backup_path",
    "check_output",
    "compare",
    "compare_axes",
    "content_of",
    "copy_axis",
    "delete_axis",
    "describe",
    "digest_of",
    "fill_defaults",
    "fitted_axes",
    "is_there",
    "letters_offered",
    "merge",
    "name_axes",
    "new_file",
    "open_file",
    "parameters_of_axes",
    "places_offered",
    "read_content",
    "real_path",
    "recover_backup",
    "rename_axis",
    "retype_axis",
    "same_file",
    "save_file",
    "secret_values",
    "shown_axes",
    "swap_axes",
    "text_of_name",
    "unlike_axes",
    "was_replaced",
    "why_axes_are_fixed",
    "why_letters_are_fixed",
    "why_types_are_fixed",
    "without_secrets",
    "write_atomic",
]
