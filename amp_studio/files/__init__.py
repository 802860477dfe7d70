"""Parameter files and projects: values in memory, on disk, and what becomes of them.

Saves are atomic and leave a backup, unsaved work survives a killed program,
two programs on one file notice each other, and a file that is not fully
understood is refused or kept whole.
"""

from .atomic import ChangedOnDiskError, Notify, SaveError, check_output, digest_of, write_atomic
from .axes import (
    AxisError,
    axis_instances,
    axis_title,
    axis_type,
    copy_axis,
    delete_axis,
    fitted_axes,
    name_axes,
    retype_axis,
)
from .creation import new_file
from .diff import Comparison, Conflict, Difference, compare, merge
from .document import Document, HistoryEntry, Unsaved, recover_backup
from .lock import InUseError
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
from .paths import backup_path, is_there, real_path, same_file, text_of_name
from .project import ENDING, InvalidNameError, Project, ProjectInfo
from .storage import FORMAT, Opened, ParameterFileError, content_of, open_file, read_content, save_file

__all__ = [
    "ENDING",
    "FORMAT",
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
    "Notify",
    "Opened",
    "ParameterFile",
    "ParameterFileError",
    "Project",
    "ProjectInfo",
    "RangeError",
    "SaveError",
    "Unsaved",
    "axis_instances",
    "axis_title",
    "axis_type",
    "backup_path",
    "check_output",
    "compare",
    "content_of",
    "copy_axis",
    "delete_axis",
    "describe",
    "digest_of",
    "fill_defaults",
    "fitted_axes",
    "is_there",
    "merge",
    "name_axes",
    "new_file",
    "open_file",
    "read_content",
    "real_path",
    "recover_backup",
    "retype_axis",
    "same_file",
    "save_file",
    "secret_values",
    "text_of_name",
    "without_secrets",
    "write_atomic",
]
