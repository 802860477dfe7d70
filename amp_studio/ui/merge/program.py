"""The comparison as a separate program: a merge tool for git and for scripts."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtWidgets import QApplication

from amp_studio.files import Document, Merge, ParameterFile
from amp_studio.ui.base.ask_path import ask_to_open
from amp_studio.ui.base.garbage import collect_by_timer
from amp_studio.ui.base.task import Task
from amp_studio.ui.base.theme import apply_style
from amp_studio.ui.base.translated import tr
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.window.settings import UserSettings

from .columns import BASE, A, B
from .comparisons import parameter_files
from .sources import MergeSource, MergeSources, Offer, ReadSource
from .window import MergeWindow


def merge_in_window(merge: Merge, ours: Path, output: Path, write: Callable[[ParameterFile], object]) -> bool:
    """Show a merge in a window until it is closed; returns whether its result was written.

    ``ours`` stays as it is. An error of ``write`` is shown, and the window stays open.
    """
    application = QApplication.instance() or QApplication(["amp-studio"])
    application.setApplicationName("AMP Studio")
    application.setOrganizationName("AMP Studio")
    collect_by_timer()
    apply_style(UserSettings().theme())
    workspace = Workspace(Document.view(ours))
    window = tool_window(merge, workspace, output, write)
    window.show()
    application.exec()
    Task.end_all()
    workspace.close()
    return bool(window.property("written"))


def tool_window(
    merge: Merge, workspace: Workspace, output: Path, write: Callable[[ParameterFile], object]
) -> MergeWindow:
    """Return the window of a merge whose result goes to ``output`` alone;
    its property ``written`` is true once that was written.
    """

    def save(result: ParameterFile) -> None:
        try:
            write(result)
        except (OSError, ValueError) as error:
            window.message.say(str(error), "error")
            return
        window.setProperty("written", True)
        window.close()

    def ask_file() -> ReadSource | None:
        path = ask_to_open(window, tr("Compare with"), sources.folder, parameter_files())
        return sources.from_copy(sources.other_file, path) if path else None

    sources = MergeSources(workspace)
    offers = [(tr("Other Files"), [Offer(tr("Another &File…"), ask_file)])]
    window = MergeWindow(workspace, sources, lambda: offers, save)
    window.outcome.merge.hide()
    window.outcome.save.setText(tr("&Save {file}").format(file=output.name.replace("&", "&&")))
    window.outcome.save.setProperty("primary", True)
    chosen = {
        A: MergeSource(tr("Ours"), workspace.path.name, merge.a),
        B: MergeSource(tr("Theirs"), "", merge.b),
    }
    base = {} if merge.base is None else {BASE: MergeSource(tr("Base"), "", merge.base)}
    window.show_merge(chosen | base)
    for row in window.merge.differing:
        if (choice := merge.choices.get(row.id)) is not None:
            window.model.choose([row], choice)
    window.head.target = tr("goes to {file}").format(file=output.name)
    return window
