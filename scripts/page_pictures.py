"""Draw the pictures of README and the pages:
each from the state that the commands above it on its page have made.

``screenshots.py`` calls it; the pictures go into ``docs/images``, light and in English,
with a palette so that they stay small.
"""

from __future__ import annotations

import contextlib
import io
import os
import re
import shlex
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from PySide6.QtGui import QImage, QPixmap
    from screenshots import Stage

TOP = Path(__file__).resolve().parents[1]
PAGES = (
    "docs/tutorial.md",
    "docs/howto/check-machine.md",
    "docs/howto/identify-friction.md",
    "docs/howto/add-rule.md",
)
BEGINS_WITH = {
    "docs/howto/add-parameter.md": ("docs/howto/add-family.md",),
    "docs/howto/add-rule.md": ("docs/howto/add-family.md", "docs/howto/add-parameter.md"),
}
"""Page -> those whose files it goes on with."""
IMAGES = TOP / "docs/images"
SIZE = (1200, 660)
COLOURS = 256
RESTED_MS = 1_000
"""Until a selection has rested and the range that the rules allow is looked for."""
FILE = "mill.amp"
_SHOWN = re.compile(r"`([\w./-]+\.[\w.]+)`[^`]*:\n\n```\w+\n(.*?)```", re.DOTALL)
"""A file that a page shows whole: its name in the sentence before the block, which ends with a colon."""


def files_of(page: str) -> dict[str, str]:
    """Return the files that a page shows: name -> content."""
    return dict(_SHOWN.findall((TOP / page).read_text(encoding="utf-8")))


def draw_documents(make_stage: Callable[[], Stage]) -> int:
    """Draw the pictures of all pages, then that of README; returns how many."""
    stage = make_stage()
    count = sum(_draw_page(stage, page) for page in PAGES)
    _save(window(stage, stage.path("mill-1394")), "window")
    stage.close()
    return count + 1


def _draw_page(stage: Stage, page: str) -> int:
    """Run the commands of a page in a separate folder, and draw its pictures between them; returns how
    many.
    """
    folder = stage.files / Path(page).stem
    folder.mkdir()
    count = 0
    for shown in (*BEGINS_WITH.get(page, ()), page):
        for name, text in files_of(shown).items():
            _write(folder / name, text)
    with contextlib.chdir(folder), contextlib.redirect_stdout(io.StringIO()):
        for line in (TOP / page).read_text(encoding="utf-8").splitlines():
            if line.startswith("    amp-studio "):
                _run(line)
            elif line.startswith("!["):
                name = Path(line.partition("](")[2].rstrip(")")).stem
                _save(PICTURES[name](stage, folder / FILE), name)
                _close(stage)  # an open file is locked against the next command
                count += 1
    return count


def _write(path: Path, text: str) -> None:
    """Write a file of a page; a family of facts is known from then on."""
    from amp_studio.schema.registration import Registration, register

    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    if path.name == "family.yaml":
        register(Registration(path.parent.name, facts=path.parent))


def _run(line: str, folder: Path = Path()) -> None:
    """Run a command of the page; one that leaves errors is no failure."""
    from screenshots import MOMENT

    from amp_studio import cli

    verb, *words = shlex.split(line, comments=True)[1:]
    if verb in ("show", "validate", "report") or (verb == "simulate" and "record.csv" not in words):
        return  # they change nothing that a picture shows
    code = cli.run([verb, *words])
    if code > 1:
        raise RuntimeError(f"{line}: exit code {code}")
    for each in folder.glob("*.amp"):
        os.utime(each, (MOMENT, MOMENT))


# -- the pictures ----------------------------------------------------------------------------------


def _shown(stage: Stage, path: Path, *, later: bool = True) -> Any:
    """Return the window with a file, ``later`` with the findings of steps that are not reached."""
    from screenshots import settle

    window = stage.window
    window.resize(*SIZE)
    window.open_first(path)
    window.page.left.show_side("groups")
    window.workspace.show_later(later)
    settle()
    return window


def _close(stage: Stage) -> None:
    for page in list(stage.window.tabs.pages()):
        stage.window.close_page(page)


def _grab(widget: Any) -> QPixmap:
    from PySide6.QtTest import QTest
    from screenshots import picture, settle

    QTest.qWait(RESTED_MS)
    settle()
    return picture(widget)


def new(stage: Stage, _: Path) -> QPixmap:
    """The dialog of a new file, filled in."""
    from amp_studio.ui.dialogs.new_file_dialog import NewFileDialog

    dialog = NewFileDialog(stage.window, "9pc")
    dialog.form.set_answer("machine", "mill")
    dialog.form.set_answer("axes", "X,Y,Z,S")
    dialog.form.set_answer("name", "mill")
    dialog.show()
    taken = _grab(dialog)
    dialog.close()
    return taken


def errors(stage: Stage, path: Path) -> QPixmap:
    """The new file, calm: what is as delivered is a state."""
    window = _shown(stage, path, later=False)
    window.go_to(("servo.hardware_type", "1"))
    window.show_panel("Findings")
    return _grab(window)


def fixes(stage: Stage, path: Path) -> QPixmap:
    """Every suggested fix, to be chosen from."""
    from amp_studio.ui.findings.dialogs import FixSeveralDialog

    window = _shown(stage, path)
    dialog = FixSeveralDialog(window.workspace, window.workspace.listed, window)
    dialog.resize(760, 300)
    dialog.show()
    taken = _grab(dialog)
    dialog.close()
    return taken


def loops(stage: Stage, path: Path) -> QPixmap:
    """The loops of four axes, and what the check finds now."""
    window = _shown(stage, path)
    window.go_to(("servo.loop_type", "1"))
    window.show_panel("Findings")
    return _grab(window)


def axes(stage: Stage, path: Path) -> QPixmap:
    """Three axes that are alike."""
    window = _shown(stage, path)
    window.go_to(("servo.excess_error", "1"))
    return _grab(window)


def done(stage: Stage, path: Path) -> QPixmap:
    """No error is left."""
    window = _shown(stage, path)
    window.go_to(("servo.excess_error", "1"))
    window.show_panel("Findings")
    return _grab(window)


def motion(stage: Stage, path: Path) -> QPixmap:
    """A move of the X axis."""
    from screenshots import settle

    from amp_studio.ui.base.task import Task

    window = _shown(stage, path)
    window.go_to(("feedrate.rapid", "1"))
    window.menus["view.motion"].trigger()
    view = window.page.pages["motion"]
    settle(lambda: view.trace is not None and not Task.running)
    taken = _grab(window)
    window.page.show_page("")
    return taken


def machine(stage: Stage, path: Path) -> QPixmap:
    """The machine checked, with a homing on a switch that is too short for its speed."""
    from screenshots import settle

    from amp_studio.ui.base.task import Task

    window = _shown(stage, path)
    window.menus["view.check"].trigger()
    page = window.page.pages["check"]
    settle(lambda: page.checks and not Task.running)
    page.choose("home", "1")
    page.card.length.setText("5 mm")
    page.card.length.returnPressed.emit()
    settle()
    taken = _grab(window)
    window.page.show_page("")
    return taken


def record(stage: Stage, path: Path) -> QPixmap:
    """The fit of a record."""
    from screenshots import settle

    from amp_studio.files import open_file
    from amp_studio.ui.base.task import Task
    from amp_studio.ui.motion.identify_dialog import IdentifyDialog

    dialog = IdentifyDialog(open_file(path).file, "1", path.with_name("record.csv"), stage.window)
    dialog.resize(1000, 560)
    dialog.show()
    settle(lambda: not Task.running)
    taken = _grab(dialog)
    dialog.close()
    return taken


def rule(stage: Stage, path: Path) -> QPixmap:
    """The drive of the how-tos with what its rule finds."""
    window = _shown(stage, path.with_name("fast.amp"))
    window.go_to(("motion.speed", ""))
    window.show_panel("Findings")
    return _grab(window)


def window(stage: Stage, path: Path) -> QPixmap:
    """The example mill with a value that a rule finds wrong."""
    _run(f"amp-studio set {shlex.quote(str(path))} 1750='4 mm'", path.parent)
    shown = _shown(stage, path)
    shown.go_to(("servo.excess_error", "1"))
    shown.show_panel("Findings")
    return _grab(shown)


PICTURES: dict[str, Callable[[Stage, Path], QPixmap]] = {
    "window": window,
    "tutorial-new": new,
    "tutorial-errors": errors,
    "tutorial-fixes": fixes,
    "tutorial-loops": loops,
    "tutorial-axes": axes,
    "tutorial-done": done,
    "tutorial-motion": motion,
    "machine": machine,
    "record": record,
    "rule": rule,
}
"""Name of a file in ``docs/images`` -> what draws it."""


# -- files -----------------------------------------------------------------------------------------


def _save(taken: QPixmap, name: str) -> None:
    """Write a picture with a palette; raises OSError where it cannot."""
    path = IMAGES / f"{name}.png"
    if not with_palette(taken.toImage()).save(str(path), quality=0):
        raise OSError(f"{path} could not be written")


def with_palette(image: QImage) -> QImage:
    """Return an image in its most frequent colours, each other one as the nearest of them."""
    import numpy as np
    from PySide6.QtGui import QImage

    image = image.convertToFormat(QImage.Format.Format_RGB32)
    height, width = image.height(), image.width()
    pixels = np.frombuffer(image.constBits(), np.uint32).reshape(height, image.bytesPerLine() // 4)[:, :width]
    found, place, count = np.unique(pixels, return_inverse=True, return_counts=True)
    kept = found[np.sort(np.argsort(-count, kind="stable")[:COLOURS])]
    parts = [(colours >> shift & 255).astype(np.int32) for colours in (found, kept) for shift in (16, 8, 0)]
    all_of, few = np.stack(parts[:3], 1), np.stack(parts[3:], 1)
    nearest = np.concatenate(
        [
            np.argmin(((block[:, None] - few[None]) ** 2).sum(2), 1)
            for block in np.array_split(all_of, max(1, len(all_of) // 1000))
        ]
    )
    indices = np.zeros((height, (width + 3) // 4 * 4), np.uint8)
    indices[:, :width] = nearest[place].reshape(height, width)
    made = QImage(indices.tobytes(), width, height, indices.shape[1], QImage.Format.Format_Indexed8)
    made.setColorTable([int(colour) | 0xFF000000 for colour in kept])
    return made.copy()
