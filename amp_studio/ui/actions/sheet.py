"""Makes the sheet of values to key in by hand, against the chosen control or against a file or kept copy."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from amp_studio.files import ParameterFile, open_file
from amp_studio.ui.base.ask_path import ask_to_open
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.translated import facts_in_words, message_in_words, tr
from amp_studio.validate import rules_beside

if TYPE_CHECKING:
    from amp_studio.ui.control.page import ControlPage


def sheet_of_control(page: ControlPage) -> None:
    """Make the sheet against what the chosen control contains, which is read first if that is not known."""
    from amp_studio.sheet import SheetError
    from amp_studio.transfer.client import sha256

    session = page.session
    if session is None:
        page.hand.bar.say(tr("Choose a control at the left, or take a file."), "warning")
    elif session.seen is None or session.phase != "ready":
        page.read_for_sheet()
    elif session.seen.file is None:
        page.hand.bar.say(session.seen.why_unreadable or tr("The control contains no parameters."), "warning")
    else:
        against = f"{session.address}, sha256 {sha256(session.seen.content)[:12]}…"
        try:
            _make(page, session.seen.file, against, session.seen)
        except SheetError as error:
            page.hand.bar.say(message_in_words(str(error)), "warning")


def sheet_of_file(page: ControlPage) -> None:
    """Ask for a file or backup with what the control contains; raises the errors of reading it,
    and SheetError.
    """
    assert page.workspace is not None
    kinds = tr("Parameter files and backups of a control (*.amp *.img);;All files (*)")
    if path := ask_to_open(page, tr("What the control contains"), page.workspace.path.parent, kinds):
        _make(page, in_background(page, tr("Opening"), partial(_read, path)), path.name)


def _make(page: ControlPage, present: ParameterFile, against: str, seen: object = None) -> None:
    from amp_studio.sheet import Sheet, Ticks, make_sheet, ticks_path

    workspace = page.workspace
    assert workspace is not None

    def make() -> tuple[Sheet, Ticks]:
        own = rules_beside(workspace.path, workspace.file)
        sheet = make_sheet(
            workspace.file,
            present,
            of=workspace.path.name,
            against=against,
            own=own,
            secrets=workspace.secrets,
            message=facts_in_words(workspace.file.schema).cited,
        )
        return sheet, Ticks(ticks_path(workspace.path), sheet)

    page.hand.make(make, seen)


def _read(path: Path) -> ParameterFile:
    from amp_studio.transfer.client import open_copy

    if path.suffix != ".img":
        return open_file(path).file
    copy = open_copy(path)
    if copy.file is None:
        raise ValueError(tr("{name} cannot be read: {why}.").format(name=path.name, why=copy.fault))
    return copy.file
