"""Asks where the paper of a comparison goes, and writes it in a thread."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from PySide6.QtWidgets import QWidget

from amp_studio.files import Merge, Side, check_output
from amp_studio.ui.base.ask_path import ask_to_save
from amp_studio.ui.base.modal import is_alive
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.translated import tr
from amp_studio.ui.dialogs.file_dialogs import PAPER_KINDS
from amp_studio.ui.forms.message_bar import MessageBar

from .columns import SIDES
from .sources import MergeSource


def save_merge_report(
    window: QWidget, merge: Merge, chosen: Mapping[int, MergeSource], beside: Path, bar: MessageBar
) -> None:
    """Write a comparison as a paper; shows where it is, or the error.
    ``beside`` is the file that is compared.
    """
    title = tr("Report of the comparison")
    near = beside.with_name(f"{beside.stem}-comparison.pdf")
    path = ask_to_save(window, title, near, PAPER_KINDS)
    if path is None:
        return
    names: dict[Side, str] = {
        SIDES[column]: f"{source.title}, {source.detail}" if source.detail else source.title
        for column, source in sorted(chosen.items())
    }
    try:
        check_output(path, beside)
        in_background(window, title, lambda: _write(merge, names, path))
    except (OSError, ValueError) as error:
        fault = str(error)
    else:
        fault = ""
    if not is_alive(bar):  # the window was closed meanwhile
        return
    if fault:
        bar.say(fault, "error")
    else:
        bar.say(tr("{file} written.").format(file=path.name))


def _write(merge: Merge, names: Mapping[Side, str], path: Path) -> None:
    from amp_studio.report import merge_paper, write_paper

    write_paper(merge_paper(merge, names), path)
