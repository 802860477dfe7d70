"""Makes the sheet of values to key in by hand, against a file, a kept copy, or the control."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from PySide6.QtWidgets import QFileDialog

from amp_studio.files import ParameterFile, open_file
from amp_studio.ui.base.questions import ask
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.translated import tr
from amp_studio.ui.control.exchange import ControlExchange
from amp_studio.validate import rules_beside

_FILES = "Parameter files and backups of a control (*.amp *.img);;All files (*)"


def enter_by_hand(control: ControlExchange) -> None:
    """Ask what the control contains and show what has to be keyed in; raises the errors of both sides."""
    from amp_studio.sheet import Sheet, Ticks, make_sheet, ticks_path
    from amp_studio.ui.control.sheet_dialog import SheetDialog

    window = control.window
    workspace = window.workspace
    assert workspace is not None
    question = tr(
        "The sheet lists the values that differ from what the control contains.\n\nWhere is that known from?"
    )
    answer = ask(
        window, tr("Enter Values by Hand"), question, tr("The &Control"), tr("A &File"), tr("Cancel")
    )
    found = (
        _of_control(control)
        if answer == tr("The &Control")
        else _of_file(control)
        if answer == tr("A &File")
        else None
    )
    if found is None:
        return
    present, against = found

    def make() -> tuple[Sheet, Ticks]:
        own = rules_beside(workspace.path, workspace.file)
        sheet = make_sheet(workspace.file, present, of=workspace.path.name, against=against, own=own,
                           secrets=workspace.secrets)  # fmt: skip
        return sheet, Ticks(ticks_path(workspace.path), sheet)

    SheetDialog(workspace, make, window).show()


def _of_control(control: ControlExchange) -> tuple[ParameterFile, str] | None:
    address = control.chosen_address()
    if address is None:
        return None
    from amp_studio.transfer import decode_content
    from amp_studio.transfer.client import sha256

    workspace = control.window.workspace
    assert workspace is not None
    content = control.fetch(address, tr("Enter Values by Hand"), workspace.file.schema.family.family)
    present = decode_content(content)
    control.remember(workspace, present)
    return present, f"{address}, sha256 {sha256(content)[:12]}…"


def _of_file(control: ControlExchange) -> tuple[ParameterFile, str] | None:
    window = control.window
    assert window.workspace is not None
    folder = str(window.workspace.path.parent)
    text, _ = QFileDialog.getOpenFileName(window, tr("What the control contains"), folder, _FILES)
    if not text:
        return None
    path = Path(text)
    return in_background(window, tr("Opening"), partial(_read, path)), path.name


def _read(path: Path) -> ParameterFile:
    from amp_studio.transfer.client import open_copy

    if path.suffix != ".img":
        return open_file(path).file
    copy = open_copy(path)
    if copy.file is None:
        raise ValueError(tr("{name} cannot be read: {why}.").format(name=path.name, why=copy.fault))
    return copy.file
