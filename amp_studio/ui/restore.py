"""Puts back what a control held before a download, after showing what that would change."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QFileDialog

from amp_studio.files import compare
from amp_studio.validate import Validator, rules_beside

from .questions import ask
from .task import Progress, in_background

if TYPE_CHECKING:
    from amp_studio.transfer.client.parameters import Copy, Outcome

    from .control_actions import ControlActions

COPIES = "Kept copies (*.img *.before-*.amp);;All files (*)"


def restore(control: ControlActions) -> None:
    """Ask for a kept copy and an address, show what would change, then send the copy byte for byte.

    What the control holds is kept beside the copy first. Raises as the restore itself.
    """
    from amp_studio.transfer.client.parameters import open_copy, restore_copy, sha256

    window = control.window
    folder = window.workspace.path.parent if window.workspace else Path()
    text, _ = QFileDialog.getOpenFileName(window, "Restore", str(folder), COPIES)
    if not text:
        return
    path = Path(text)
    copy = in_background(window, "Opening", lambda: open_copy(path))
    _check(copy, path)
    address = control.ask_address("Restore")
    if address is None:
        return
    family = copy.file.schema.family.family if copy.file and not copy.is_kept else ""
    held = control.fetch(address, "Restore", family)
    if not _is_wanted(control, copy, path, held):
        return

    def work(progress: Progress, cancel: threading.Event) -> Outcome:
        return restore_copy(copy, address, path.parent, path.stem, progress, cancel, expected=sha256(held))

    outcome = control.exchange("Restore", work)
    if outcome.verified and copy.file is not None and window.workspace is not None:
        control.remember(window.workspace, copy.file)


def _check(copy: Copy, path: Path) -> None:
    """Refuse a file with errors of which nothing says that a control held it; raises ValueError."""
    if copy.file is None or copy.is_kept:
        return
    findings = Validator(copy.file, rules_beside(path, copy.file.schema)).run()
    error = next((f for f in findings if f.severity == "error"), None)
    if error is not None:
        raise ValueError(
            f"{path.name} has errors, and no image beside it says that a control held it: {error.message}"
        )


def _is_wanted(control: ControlActions, copy: Copy, path: Path, held: bytes) -> bool:
    """Show what would change, or say why it cannot be shown; tells whether the copy is to go back."""
    from amp_studio.transfer.image import ImageError, decode_image

    from .compare_dialog import DownloadPreview

    doubts = [] if copy.is_checked else [f"No digest lies beside {path.name}, so it goes back unchecked."]
    now = None
    try:
        now = decode_image(held) if held else None
    except ImageError as error:
        doubts.append(f"What the control holds cannot be shown: {error}.")
    if copy.file is None:
        doubts.append(f"{path.name} goes back byte for byte, but cannot be shown: {copy.fault}.")
    elif now is not None and now.schema is not copy.file.schema:
        doubts.append(f"The control holds a file for {now.schema.family.name}.")
    elif now is not None and not doubts:
        secrets = control.window.workspace.secrets if control.window.workspace else False
        found = compare(copy.file.schema, copy.file.values, now.values)
        preview = DownloadPreview(copy.file, found, control.window, secrets=secrets, title="Restore")
        return bool(preview.exec())
    question = "\n\n".join([*doubts, f"Put {path.name} back? What the control holds is kept first."])
    return ask(control.window, "Restore", question, "&Restore", "Cancel", default=1) == "&Restore"
