"""What the help menu does: the keys, the folder of the log, and a text to report a problem with."""

from __future__ import annotations

import platform
from pathlib import Path

from PySide6.QtCore import QUrl, qVersion
from PySide6.QtGui import QDesktopServices

from amp_studio.files import write_atomic
from amp_studio.trouble import last_details, log_folder
from amp_studio.ui.base.ask_path import ask_to_save
from amp_studio.ui.base.questions import ask
from amp_studio.ui.base.translated import tr, written_to
from amp_studio.ui.window.studio_window import StudioWindow
from amp_studio.version import __version__


def open_manual(window: StudioWindow, page: str = "") -> None:
    """Open the manual of the program at one of its pages, else where it was."""
    from amp_studio.ui.dialogs.manual_window import TUTORIAL, ManualWindow

    opened = window.beside.again(ManualWindow)
    if opened is None:
        opened = ManualWindow(window)
        window.beside.show(opened)
        page = page or TUTORIAL
    if page:
        opened.show_page(page)


def open_tutorial(window: StudioWindow) -> None:
    """Open the manual at the first mill that is brought to zero errors."""
    from amp_studio.ui.dialogs.manual_window import TUTORIAL

    open_manual(window, TUTORIAL)


def open_log_folder(_: StudioWindow) -> None:
    """Open the folder in which the details of faults are kept; raises OSError where it cannot be made."""
    log_folder().mkdir(parents=True, exist_ok=True)
    QDesktopServices.openUrl(QUrl.fromLocalFile(str(log_folder())))


def report_problem(window: StudioWindow) -> None:
    """Write a text file for a report; what is of the machine is in it only with a yes of the person."""
    with_machine = False
    if window.workspace is not None or last_details():
        question = tr(
            "May the report name the family and the findings of the open file, and the message of the last"
            " fault?\n\nThey can contain names and values of your machine. Without them it has versions and"
            " settings alone."
        )
        yes, no = tr("&With Them"), tr("With&out Them")
        answer = ask(window, tr("Report a Problem"), question, yes, no, tr("Cancel"), default=1)
        if answer not in (yes, no):
            return
        with_machine = answer == yes
    near = Path.home() / "amp-studio-problem.txt"
    if path := ask_to_save(window, tr("Report a Problem"), near, "Text (*.txt)"):
        write_atomic(path, _problem_text(window, with_machine).encode(), keep_backup=False)
        window.show_status(written_to(path))


def _problem_text(window: StudioWindow, with_machine: bool) -> str:
    """Return the text of a report: versions, settings, the last fault;
    ``with_machine`` adds what may be of the machine.
    """
    size, settings = window.size(), window.settings
    lines = [
        "What happened, and what did you expect?",
        "",
        "",
        f"AMP Studio {__version__}, Python {platform.python_version()}, Qt {qVersion()}",
        f"{platform.system()} {platform.release()} {platform.machine()}",
        f"Language {settings.language()}, theme {settings.theme()}",
        f"Window {size.width()} x {size.height()}, scale {window.devicePixelRatio():g}",
    ]
    details = last_details().splitlines()
    frames = [line for line in details if line.startswith('  File "')]
    if details:
        lines += ["", "The last fault:", *(details if with_machine else map(_own_place, frames))]
    if with_machine and window.workspace is not None:
        workspace = window.workspace
        lines += ["", f"Family {workspace.file.schema.family.family}, machine type {workspace.file.machine}"]
        lines += [f"{finding.severity}: {finding.message}" for finding in workspace.findings]
    return "\n".join(lines) + "\n"


def _own_place(line: str) -> str:
    """Return a line of a traceback without the folders, which name the person."""
    head, _, rest = line.partition('"')
    path, _, end = rest.partition('"')
    return f"{head}{Path(path.replace(chr(92), '/')).name}{end}"
