"""A file and a project with Hebrew names in the window."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt

from amp_studio.files import Document, Project, ProjectInfo
from amp_studio.files.notes import set_value_note
from amp_studio.ui.main_window import MainWindow

EXCESS = ("servo.excess_error", "1")
NOTE, ISOLATED = "סטייה -3.5 mm בציר X", "\u2068סטייה \u2066-3.5 mm\u2069 בציר X\u2069"


def test_names_and_notes_from_right_to_left_are_parted_from_what_is_beside_them(
    open_window: Callable[..., MainWindow], tmp_path: Path, example: bytes
) -> None:
    """The number and the ending of a name went to its other side, and a sign behind its number."""
    path = tmp_path / "קו 4" / "כרסומת 3.amp"
    path.parent.mkdir()
    path.write_bytes(example)
    with Document.open(path) as document:
        set_value_note(document.file, EXCESS, NOTE)
        document.save()
    Project.create(path.parent, ProjectInfo("קו 4", "9pc"))
    window = open_window(path)
    name, project = "\u2068כרסומת \u20663\u2069.amp\u2069", "\u2068קו \u20664\u2069\u2069"
    assert window.windowTitle() == f"{name}[*] — {project} — AMP Studio"
    window.go_to(EXCESS)
    tip = window.table_view.currentIndex().data(Qt.ItemDataRole.ToolTipRole)
    assert f"Note: {ISOLATED}" in tip
    assert ISOLATED in window.page_in_front.detail.page.toPlainText()
