"""A simulated motion as a file: asked for, and written as figures, as a picture or as a document."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtWidgets import QWidget

from amp_studio.files import ParameterFile
from amp_studio.motion_paper import PAPERS, write_motion_paper
from amp_studio.sim import Trace, write_trace
from amp_studio.ui.base.ask_path import ask_to_save
from amp_studio.ui.base.translated import language_of_window

_ENDINGS = "SVG (*.svg);;PNG (*.png);;CSV (*.csv);;PDF (*.pdf)"


def ask_where(parent: QWidget, file: Path, trace: Trace) -> Path | None:
    """Ask where a trace is written; beside ``file`` first, with the extension of the chosen format."""
    proposed = file.with_name(f"{file.stem}-{trace.scenario}-{trace.axis}.svg")
    return ask_to_save(parent, parent.tr("Save"), proposed, _ENDINGS)


def write_motion(
    path: Path,
    file: ParameterFile,
    name: str,
    trace: Trace,
    before: Trace | None,
    chart: str,
    machine: Sequence[tuple[str, str, str]],
) -> list[str]:
    """Write the trace of a file; return the messages about it.

    ``machine`` are the figures that were typed, for a document: name, value, where it is from.

    Raises:
        OSError: The file cannot be written.
        ValueError: The file extension is of no format.
    """
    notes: list[str] = []
    if path.suffix.lower() in PAPERS:
        write_motion_paper(
            file,
            name,
            trace,
            path,
            notes.append,
            before=before,
            chart=chart,
            machine=list(machine),
            language=language_of_window(),
        )
    else:
        write_trace(trace, path, notes.append, before=before, chart=chart)
    return notes
