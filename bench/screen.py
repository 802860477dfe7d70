"""The desktop program while it is used on the full file, on Qt's offscreen platform."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING

from desktop import painted_table, until_painted, window_with
from measure import Measure, timed, worst

if TYPE_CHECKING:
    from amp_studio.ui.main_window import MainWindow

KEYSTROKE, EDIT, FRAME, SWITCH = 0.030, 0.030, 0.016, 0.100
"""Seconds until all is painted: a key in the find box; an edit and a page of the table, at worst; another
file in front, or another theme."""
EDITS = (
    ("a value", ("servo.excess_error", "1"), ("12 mm", "11 mm")),
    ("a value, 165 findings more and less", ("feedrate.rapid", "1"), ("1 mm/min", "10000 mm/min")),
    ("the type of an axis", ("axis.type", "1"), ("rotary", "linear")),
)
"""What is edited, and what is typed in turn."""


def measures(full: Path, example: Path, times: int) -> Iterator[Measure]:
    """Yield what takes the time of a person at a file, until it is painted."""
    with window_with(full) as window:
        yield _typed(window, times)
        for name, address, texts in EDITS:
            window.go_to(address)
            values = cycle(texts)
            edit = until_painted(lambda: window.edits.commit(address, next(values)))  # noqa: B023  # called here
            yield worst(f"edit of {name}, painted", EDIT, timed(edit, 4 * times))
        yield from _seen(window, times)
    with window_with(example) as window:

        def close() -> None:
            if window.workspace_in_front.path == full:
                window.files.close(window.page_in_front)

        opened = timed(lambda: painted_table(window, full), times, close)
        yield Measure("a full file opened in a running window, painted", opened, SWITCH)


def _typed(window: MainWindow, times: int) -> Measure:
    box = window.finder.box
    box.begin("")
    texts = cycle(["f", "fo", "fol", "foll", "follo", "follow"])
    search = until_painted(lambda: (box.setText(next(texts)), box.search()))
    seconds = timed(search, 6 * times)
    box.clear()
    return Measure("keystroke in the find box, painted", seconds, KEYSTROKE)


def _seen(window: MainWindow, times: int) -> Iterator[Measure]:
    """Yield a page of all parameters, and the other theme."""
    from amp_studio.ui.base.theme import apply_style

    page = window.page_in_front
    page.table.show_parameters(list(page.workspace.file.schema.parameters.values()))
    until_painted(lambda: None)()
    bar, steps = page.table_view.verticalScrollBar(), cycle([1] * 20 + [-1] * 20)
    scroll = until_painted(lambda: bar.setValue(bar.value() + bar.pageStep() * next(steps)))
    yield worst("page of all parameters scrolled, painted", FRAME, timed(scroll, 8 * times))
    themes = cycle(["dark", "light"])
    yield Measure(
        "theme, painted", timed(until_painted(lambda: apply_style(next(themes))), 2 * times), SWITCH
    )
    apply_style("light")
