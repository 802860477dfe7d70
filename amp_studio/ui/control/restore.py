"""Restores the backup of a control, after showing what that changes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QFileDialog

from amp_studio.files import compare
from amp_studio.files.by_schema import by_schema
from amp_studio.ui.base.modal import run_dialog
from amp_studio.ui.base.questions import ask
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.translated import tr
from amp_studio.validate import Validator, rules_beside

from .exchange import ControlExchange

if TYPE_CHECKING:
    from amp_studio.transfer.client.parameters import Copy, Outcome
    from amp_studio.transfer.exchange import Exchange

COPIES = "Backups of a control (*.img *.before-*.amp);;All files (*)"


def restore(control: ControlExchange) -> None:
    """Ask for a backup and an address, show what would change, then send the backup byte for byte.

    The control's present parameters are saved beside the backup first. Raises the errors of the restore.
    """
    from amp_studio.transfer.client.parameters import open_copy, restore_copy, sha256

    window = control.window
    folder = window.workspace.path.parent if window.workspace else Path()
    text, _ = QFileDialog.getOpenFileName(window, tr("Restore"), str(folder), COPIES)
    if not text:
        return
    path = Path(text)
    copy = in_background(window, tr("Opening"), lambda: open_copy(path))
    _check(copy, path)
    address = control.ask_address(tr("Restore"))
    if address is None:
        return
    present = control.fetch(address, tr("Restore"), copy.family)
    if not _is_wanted(control, copy, path, present):
        return

    notes: list[str] = []

    def work(exchange: Exchange) -> Outcome:
        beside = replace(exchange, keep=path, record=path, notify=notes.append)
        return restore_copy(copy, address, beside, expected=sha256(present))

    outcome = control.run(tr("Restore"), work)
    if outcome.verified:
        control.note(address, "restore", reached=True)
    if outcome.verified and copy.file is not None and window.workspace is not None:
        control.remember(window.workspace, copy.file)
    if notes:
        window.show_status("; ".join(notes))


def _check(copy: Copy, path: Path) -> None:
    """Raise ValueError for a file with errors that is not a proven backup of a control."""
    if copy.file is None or copy.is_kept:
        return
    findings = Validator(copy.file, rules_beside(path, copy.file)).run()
    error = next((f for f in findings if f.severity == "error"), None)
    if error is not None:
        raise ValueError(
            tr("{name} has errors, and there is no control image beside it. First error: {message}").format(
                name=path.name, message=error.message
            )
        )


def _is_wanted(control: ControlExchange, copy: Copy, path: Path, present: bytes) -> bool:
    """Show what would change, or why it cannot be shown; returns whether to restore the backup."""
    from amp_studio.transfer.content import decode_content
    from amp_studio.transfer.image import ImageError

    from .download_preview import DownloadPreview

    doubts = (
        []
        if copy.is_checked
        else [
            tr("There is no digest beside {name}, so its content cannot be checked.").format(name=path.name)
        ]
    )
    now = None
    try:
        now = decode_content(present) if present else None
    except ImageError as error:
        doubts.append(tr("The parameters of the control cannot be shown: {error}.").format(error=error))
    if copy.file is None:
        doubts.append(
            tr("{name} is restored byte for byte, but cannot be shown: {why}.").format(
                name=path.name, why=copy.fault
            )
        )
    elif now is not None and now.schema.family.family != copy.file.schema.family.family:
        doubts.append(tr("The control contains parameters for {name}.").format(name=now.schema.family.name))
    elif now is not None and not doubts:
        secrets = control.window.workspace.secrets if control.window.workspace else False
        found = compare(copy.file.schema, copy.file.values, by_schema(now, copy.file.schema).values)
        preview = DownloadPreview(copy.file, found, control.window, secrets=secrets, title=tr("Restore"))
        return bool(run_dialog(preview))
    question = "\n\n".join(
        [
            *doubts,
            tr("Restore {name}? The control's present parameters are saved first.").format(name=path.name),
        ]
    )
    return ask(control.window, tr("Restore"), question, tr("&Restore"), tr("Cancel"), default=1) == tr(
        "&Restore"
    )
