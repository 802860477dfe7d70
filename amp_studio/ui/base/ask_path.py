"""Asks for a file in the file dialog of the system."""

from __future__ import annotations

import re
from pathlib import Path

from PySide6.QtWidgets import QFileDialog, QWidget

from .questions import ask
from .translated import tr


def ask_to_open(parent: QWidget, title: str, near: Path | str, kinds: str) -> Path | None:
    """Ask for a file that is there; None where nothing was chosen."""
    text, _ = QFileDialog.getOpenFileName(parent, title, str(near), kinds)
    return Path(text) if text else None


def ask_to_save(parent: QWidget, title: str, near: Path | str, kinds: str) -> Path | None:
    """Ask where something is written: a name without an ending gets that of the chosen kind.
    None where nothing was chosen, or an existing file is to stay.
    """
    text, chosen = QFileDialog.getSaveFileName(parent, title, str(near), kinds)
    path, ending = Path(text), re.search(r"\*(\.\w+)", chosen or kinds)
    if not text:
        return None
    # An ending that was typed has precedence over the kind that was chosen.
    if path.suffix or ending is None:
        return path
    path = path.with_suffix(ending[1])
    # The dialog has asked about the name that was typed, not about this one.
    if path.exists():
        question = tr("{name} already exists. Replace it?").format(name=path.name)
        if ask(parent, title, question, tr("&Replace"), tr("Cancel"), default=1) != tr("&Replace"):
            return None
    return path
