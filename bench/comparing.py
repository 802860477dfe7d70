"""Three full NUM files in the window that compares and merges: until it is painted, and until a filter is."""

import shutil
import time
from collections.abc import Iterator
from itertools import cycle
from pathlib import Path

from desktop import until_painted
from measure import Measure, timed

OPEN, CHOICE = 0.150, 0.050
"""Seconds until three full files are compared and painted, or filtered; and a choice with its findings."""
EXAMPLE = Path(__file__).resolve().parent.parent / "examples" / "num-1060-mill" / "MILL_1060.amp"


def measures(folder: Path, times: int) -> Iterator[Measure]:
    """Yield how long the comparison takes to open, to filter and to follow a choice."""
    from PySide6.QtCore import QSettings
    from PySide6.QtWidgets import QApplication

    from amp_studio.files import Document, Merge, ParameterFile
    from amp_studio.schema import Value
    from amp_studio.ui.base.workspace import Workspace
    from amp_studio.ui.merge.model import BASE, A, B
    from amp_studio.ui.merge.sources import MergeSource, MergeSources
    from amp_studio.ui.merge.window import MergeWindow

    QSettings.setPath(QSettings.Format.NativeFormat, QSettings.Scope.UserScope, str(folder))
    application = QApplication.instance() or QApplication(["bench"])
    path = Path(shutil.copy(EXAMPLE, folder / "COMPARED.amp"))
    workspace = Workspace(Document.open(path))
    base = workspace.file.copy()
    for address in base.addresses():
        parameter = base.schema.parameters[address[0]]
        if address not in base.values and parameter.type in ("integer", "bits"):
            base.values[address] = Value(3, base.evaluation.unit(address, "metric"))

    def changed(every: int, by: int) -> ParameterFile:
        file = base.copy()
        for address, value in list(base.values.items())[::every]:
            if isinstance(value.value, (int, float)) and not isinstance(value.value, bool):
                file.values[address] = Value(value.value + by, value.unit)
        return file

    a, b = changed(7, 1), changed(5, 2)
    yield Measure(
        f"three NUM files of {len(base.values):,} values compared", timed(lambda: Merge(a, b, base), times)
    )
    sources = {A: MergeSource("A", "", a), B: MergeSource("B", "", b), BASE: MergeSource("0", "", base)}
    shown = MergeWindow(workspace, MergeSources(workspace), list, lambda _file: None)
    shown.resize(1440, 900)
    shown.show()
    application.processEvents()

    def checked() -> None:
        end = time.monotonic() + 30.0
        while not shown.check.is_ready and time.monotonic() < end:
            application.processEvents()

    opened = until_painted(lambda: shown.show_merge(sources))
    yield Measure("a comparison of three, painted", timed(opened, times, before=checked), OPEN)
    checked()
    texts = cycle(["gain", "", "p21", "speed"])
    typed = until_painted(lambda: shown.view.search.setText(next(texts)))
    yield Measure("a comparison filtered, painted", timed(typed, times), OPEN)
    shown.view.only_differences.setChecked(False)
    yield Measure("all rows of a comparison filtered, painted", timed(typed, times), OPEN)
    shown.view.search.clear()
    shown.view.only_differences.setChecked(True)
    rows, sides = shown.merge.conflicts[:1], cycle(["a", "b"])
    chosen = until_painted(lambda: shown.model.choose(rows, next(sides)))
    yield Measure("a side taken with its findings, painted", timed(chosen, times), CHOICE)
    shown.close()
    workspace.close()
