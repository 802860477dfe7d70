"""Parameter files and projects: values in memory, on disk, and what becomes of them.

Saves are atomic and leave a backup, unsaved work survives a killed program, two programs on one file notice
each other, and a file that is not fully understood is refused or kept whole.

What this page loads when it is first asked for is needed to change files, not to check them.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .atomic import (
        ChangedOnDiskError,
        Notify,
        SaveError,
        append_line,
        check_output,
        digest_of,
        in_temporary_folder,
        was_replaced,
        write_all,
        write_atomic,
    )
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
        axis_turns,
        fitted_axes,
        other_use,
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
    from .axis_fitting import add_axis, delete_axis, rename_axis, retype_axis
    from .axis_match import as_axis, axis_letters, matched_by_letter
    from .axis_values import AxisDifference, bits_of_axes, compare_axes, copy_axis, swap_axes
    from .block_entry import BlockEntry, EnteredCell, plan_entry, plan_values
    from .creation import MadeLike, made_like, new_file, new_like, of_one_machine
    from .diff import Comparison, Difference, compare, in_one_unit, of_other_schema
    from .document import Document, HistoryEntry, Unsaved, recover_backup
    from .erased import erased_question
    from .example_files import Example, examples, examples_folder
    from .lock import EditLock, InUseError, now, user
    from .merging import (
        ENTRIES,
        FACTS,
        HEADER_TEXTS,
        NOTES,
        Merge,
        MergeChoice,
        Row,
        RowGroup,
        RowId,
        Side,
        Typed,
        in_order,
    )
    from .notes import (
        NoteError,
        all_notes,
        group_note,
        machine_note,
        note_fault,
        set_group_note,
        set_machine_note,
        set_value_note,
        value_note,
    )
    from .origin import origin_named, origin_of, record_origin
    from .other_schema import by_schema
    from .parameter_file import (
        Change,
        Header,
        HeaderSnapshot,
        ParameterFile,
        RangeError,
        describe,
        secret_values,
        without_secrets,
    )
    from .paths import (
        BEFORE,
        ENDING,
        RECORD,
        TUNINGS,
        backup_path,
        history_path,
        is_of_machine,
        is_there,
        is_write_protected,
        parameter_files_in,
        real_path,
        same_file,
        text_of_name,
    )
    from .project import Project, ProjectInfo
    from .range_decisions import RangeDecision, keep, out_of_range, settle
    from .reading import (
        Opened,
        ParameterFileError,
        file_content,
        open_file,
        read_content,
        read_stored,
        value_lines,
    )
    from .spreadsheet import cell_text, text_cell
    from .storage import content_of, readable_content
    from .stored_text import storage_text
    from .times import day_and_time, local_time, with_days_and_times, with_local_times
    from .versions import SavedVersion, before_saves, saved_versions, with_defaults
    from .yaml_text import scalar_text, with_item
else:
    __getattr__ = front_page(__name__)
