"""The format of a paper by the ending of its file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TypeVar

from amp_studio.files import Notify, write_atomic
from amp_studio.report.output.pdf import PdfContent

T = TypeVar("T")


def write_by_ending(
    path: Path, formats: Mapping[str, Callable[[T], bytes]], printed: T, what: str, notify: Notify
) -> None:
    """Write what is printed, whole or not at all, in the format of the path's ending; raises ValueError,
    SaveError.
    """
    render = formats.get(path.suffix.lower())
    if render is None:
        raise ValueError(
            f"{path.name}: unknown format of {what}. Use the file extension {', '.join(formats)}"
        )
    content = render(printed)
    write_atomic(path, content, keep_backup=False, notify=notify)
    if isinstance(content, PdfContent) and content.remark:
        notify(content.remark)
