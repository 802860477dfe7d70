"""A file for reading, whatever it is: a parameter file, or a control's own text in its place."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from amp_studio.files import ENDING, ParameterFile, ParameterFileError, file_content, read_content

from .import_export import all_formats, import_file
from .report_pdf import HEAD, is_pdf
from .text_format import FamilyNotGivenError, FormatError, plain_content, text_to_recognise


def is_text_of_control(path: Path) -> bool:
    """Return whether a file is a control's own text, or a report with its machine; raises ParameterFileError
    where it cannot be read.
    """
    return path.suffix.casefold() != ENDING and _is_text(file_content(path))


def is_parameter_file(path: Path) -> bool:
    """Return whether a file begins as a parameter file does, whatever it is called (a backup); raises
    ParameterFileError where it cannot be read.
    """
    content = file_content(path)
    return not is_pdf(content) and HEAD.search(content) is not None


def _is_text(content: bytes) -> bool:
    if is_pdf(content):
        return True
    text = text_to_recognise(plain_content(content))
    return not HEAD.search(content) and any(each.recognises(text) for each in all_formats())


def open_for_reading(
    path: Path,
    notify: Callable[[str], None] = lambda _message: None,
    *,
    family: str | None = None,
    machine: str = "",
) -> ParameterFile:
    """Return the parameters of a parameter file or of a control's own text; raises ParameterFileError.

    ``notify`` is called with what a person should know of a text that was taken; ``family`` and ``machine``
    are those of a text that shall not decide by itself. Raises UnknownFamilyError.
    """
    content = file_content(path)
    if path.suffix.casefold() == ENDING or not _is_text(content):
        return read_content(path, content)
    try:
        return import_file(path, family, machine=machine, notify=notify)
    except FamilyNotGivenError as error:
        raise ParameterFileError(path, None, f"{error}: name the family") from None
    except FormatError as error:
        raise ParameterFileError(path, error.line, error.what) from None
    except OSError as error:
        raise ParameterFileError(path, None, f"cannot be read: {error.strerror}") from None
