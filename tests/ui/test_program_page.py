"""The page of blocks and programs."""

from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest
from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QSize, Qt
from PySide6.QtWidgets import QStyledItemDelegate, QStyleOptionViewItem
from pytestqt.qtbot import QtBot

from amp_studio.assignments import read_assignments
from amp_studio.drawing import Picture
from amp_studio.files import SavedVersion, open_file
from amp_studio.schema import Address, Value
from amp_studio.ui.base.task import Task
from amp_studio.ui.motion.program_page import FIRST, ProgramPage
from amp_studio.ui.motion.program_play import STEPS
from amp_studio.ui.motion.program_tables import TableLook, fill, read_table

from .conftest import WAIT_MS

ROUTER = Path(__file__).parents[2] / "examples" / "acromill-router"


PROGRAM = """N10 G20 G90 G17 G62
N20 G0 X-1 Y0
N30 G1 X-1.2 F190
N40 G3 X-1.5 Y-0.3 I-1.2 J-0.3
N50 G0 X0 Y0
N60 M2
"""
"""Two seconds of the machine: each of them takes a tenth of one of the processor, for every run."""


@pytest.fixture
def plate(tmp_path: Path) -> Path:
    """Return a short program for the router, with an arc and the way back."""
    path = tmp_path / "plate.nc"
    path.write_text(PROGRAM)
    return path


@pytest.fixture
def applied() -> list[dict[Address, Value]]:
    return []


@pytest.fixture
def window(qtbot: QtBot, applied: list[dict[Address, Value]]) -> Iterator[ProgramPage]:
    file = open_file(ROUTER / "ROUTER.amp").file

    def apply(values: Mapping[Address, Value]) -> bool:
        applied.append(dict(values))
        file.take(values)
        return True

    def earlier() -> list[SavedVersion]:
        slow = file.copy()
        slow.set_checked(read_assignments(slow, [("speeds.rapid", "50 in/min")]))
        return [SavedVersion("2026-11-21T10:00:00+00:00", ("speeds.rapid",), slow)]

    made = ProgramPage(file.copy, apply, earlier=earlier)
    qtbot.addWidget(made)
    yield made
    Task.end_all()


def enter(window: ProgramPage, key: str, text: str) -> None:
    form = window.change_form if key == "change" else window.form
    form.set_answer(key, text)
    form.entered.emit(key)


def test_a_typed_block_is_read_word_by_word(window: ProgramPage) -> None:
    enter(window, "block", "G1 X-10.5 F20")
    texts = [window.words.item(n, 1).text() for n in range(window.words.rowCount())]
    assert texts == ["1", "-10.5 in", "20 in/min"]
    enter(window, "block", "X@")
    assert "is no word" in window.summary.text()


def test_a_program_shows_its_time_what_limits_it_and_another_value(
    window: ProgramPage, plate: Path, qtbot: QtBot, applied: list[dict[Address, Value]]
) -> None:
    enter(window, "change", "speeds.rapid=150")
    assert "Open a part program first" in window.summary.text()
    window.open_program(plate)
    qtbot.waitUntil(lambda: window.outcome is not None, timeout=10 * WAIT_MS)
    assert window.title.text().startswith("plate.nc: 6 blocks")
    assert "feed as programmed" in [window.limits.item(n, 1).text() for n in range(window.limits.rowCount())]
    limits = [window.limits.item(n, 1).text() for n in range(window.limits.rowCount())]
    assert [text for text in limits if "speeds." in text] == [], "a parameter has its name, not its id"
    row = limits.index("Rapid Speed")
    window.limits.cellActivated.emit(row, 1)
    assert window.change_form.answer("change") == "speeds.rapid=+20%", "and is tried as it is typed"
    assert [window.lines.item(n, 1).text() for n in (3, 4)] == ["A", "R"]
    assert window.plot.picture is not None
    window.view.buttons["tilted"].click()
    enter(window, "change", "speeds.rapid=150; speeds.min_corner=+20%")
    qtbot.waitUntil(lambda: window.tries.table.rowCount() == 1, timeout=10 * WAIT_MS)
    assert window.tries.table.item(0, 2).text().startswith("−")
    assert window.tries.apply_button.text() == "&Apply 2 to File"
    window.tries.apply_button.click()
    assert applied == [
        {("speeds.rapid", ""): Value(150.0, "in/min"), ("speeds.min_corner", ""): Value(6.0, "in/min")}
    ]
    before = window.outcome
    qtbot.waitUntil(lambda: window.outcome is not before, timeout=10 * WAIT_MS)  # under the file of now
    assert window.outcome.plan.time < before.plan.time


def test_changes_that_are_ticked_are_computed_together(
    window: ProgramPage, plate: Path, qtbot: QtBot
) -> None:
    window.open_program(plate)
    qtbot.waitUntil(lambda: window.outcome is not None, timeout=10 * WAIT_MS)
    panel = window.tries
    window.tries.limits_button.click()
    qtbot.waitUntil(lambda: panel.table.rowCount() >= 3, timeout=20 * WAIT_MS)
    assert not panel.apply_button.isEnabled()
    for row in (0, 1):
        panel.table.item(row, 0).setCheckState(Qt.CheckState.Checked)
    qtbot.waitUntil(lambda: "Ticked together" in panel.together.text(), timeout=10 * WAIT_MS)
    assert len(panel.values()) == 2
    rows = panel.table.rowCount()
    panel.earlier_button.click()
    qtbot.waitUntil(lambda: panel.table.rowCount() == rows + 1, timeout=10 * WAIT_MS)
    assert "Rapid Speed" in panel.table.item(rows, 0).text()
    assert panel.table.item(rows, 2).text().startswith("+")
    panel.clear_button.click()
    assert (panel.table.rowCount(), panel.values()) == (0, {})


def test_a_path_is_coloured_by_its_feed_and_by_its_error_too(
    window: ProgramPage, plate: Path, qtbot: QtBot
) -> None:
    window.open_program(plate)
    qtbot.waitUntil(lambda: window.outcome is not None, timeout=10 * WAIT_MS)
    for colours, words in (
        ("feed", "% of the feed"),
        ("error", "% of 0.0001"),
        ("limit", "A feed as programmed"),
    ):
        window.colours.buttons[colours].click()
        assert window.plot.picture is not None
        assert window.plot.picture.above is not None
        assert words in window.plot.picture.above.subtitle


def test_what_cannot_be_read_is_a_sentence(window: ProgramPage, tmp_path: Path, qtbot: QtBot) -> None:
    (tmp_path / "a.nc").write_bytes(bytes(10))
    window.open_program(tmp_path / "a.nc")
    qtbot.waitUntil(lambda: "is no text" in window.summary.text(), timeout=WAIT_MS)
    enter(window, "zero", "here")
    window.open_program(ROUTER / "plate.nc")
    qtbot.waitUntil(lambda: "places of axes" in window.summary.text(), timeout=WAIT_MS)


def test_an_empty_block_shows_what_is_active_after_power_up(window: ProgramPage) -> None:
    enter(window, "block", "")
    texts = [window.words.item(n, 2).text() for n in range(window.words.rowCount())]
    assert "plane: plane of X and Y" in texts


def test_a_moment_of_a_program_is_shown_where_the_axes_are_then(
    window: ProgramPage, plate: Path, qtbot: QtBot
) -> None:
    window.open_program(plate)
    qtbot.waitUntil(lambda: window.outcome is not None, timeout=10 * WAIT_MS)
    assert window.outcome is not None
    assert sum(part.seconds for part in window.bar.parts) == pytest.approx(window.outcome.plan.time, rel=1e-4)
    assert "feed as programmed" in window.bar.accessibleDescription()
    window.play.slider.setValue(STEPS)
    assert window.plot.picture is not None
    scene = window.plot.picture.above
    assert scene is not None
    assert window.outcome.plan.whole.geometry.ends[-1][:2].tolist() == pytest.approx(list(scene.dots[0].at))
    assert window.lines.currentRow() == window.outcome.plan.whole.path.line[-1] - 1
    window.play.button.click()  # from the start again
    assert window.play.slider.value() < STEPS
    assert window.play.button.text() == "&Pause"
    window.play.button.click()
    assert window.play.button.text() == "&Play"


def test_keys_play_and_list_the_blocks_of_a_limit(window: ProgramPage, plate: Path, qtbot: QtBot) -> None:
    plate.write_text(PROGRAM.replace("N60 M2", "N60 G41 X-1\nN70 X-2"))
    window.show()
    window.open_program(plate)
    qtbot.waitUntil(lambda: window.outcome is not None, timeout=WAIT_MS)
    assert "Blocks that are not run: 2." in window.missing.text()
    window.lines.setFocus()
    qtbot.waitUntil(window.lines.hasFocus, timeout=WAIT_MS)
    letters = [window.lines.item(n, 1).text() for n in range(window.lines.rowCount())]
    qtbot.keyClick(window.lines, Qt.Key.Key_1)
    first = window.limits.item(0, 0).text()
    visible = [n for n in range(window.lines.rowCount()) if not window.lines.isRowHidden(n)]
    assert visible == [n for n, letter in enumerate(letters) if letter == first]
    qtbot.keyClick(window.lines, Qt.Key.Key_1)
    assert not any(window.lines.isRowHidden(n) for n in range(window.lines.rowCount()))
    qtbot.keyClick(window.lines, Qt.Key.Key_Space)
    assert window.play.button.text() == "&Pause"
    qtbot.keyClick(window.lines, Qt.Key.Key_Space)
    assert window.play.button.text() == "&Play"


def test_a_long_program_shows_its_beginning_first(
    window: ProgramPage, tmp_path: Path, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "long.nc"
    path.write_text(
        "G20 G90 G1 F100\n" + "".join(f"X-{1 + n % 7}. Y-{1 + n % 5}.\n" for n in range(3 * FIRST))
    )
    titles: list[str] = []
    draw = window.plot.draw

    def seen(picture: Picture) -> None:
        titles.append(window.title.text())
        draw(picture)

    monkeypatch.setattr(window.plot, "draw", seen)
    window.open_program(path)
    qtbot.waitUntil(lambda: window.outcome is not None, timeout=WAIT_MS)
    assert titles[0] == f"long.nc: the first {FIRST} blocks"
    assert window.title.text().startswith(f"long.nc: {3 * FIRST + 1} blocks")


def test_a_beginning_that_needs_the_rest_is_left_out(
    window: ProgramPage, tmp_path: Path, qtbot: QtBot
) -> None:
    path = tmp_path / "long.nc"
    path.write_text("G20 G90 G1 F100\nGOTO 9\n" + "X-1.\nX-2.\n" * FIRST + "N9 X-3.\n")
    window.open_program(path)
    qtbot.waitUntil(lambda: window.outcome is not None, timeout=WAIT_MS)
    assert window.title.text().startswith("long.nc: 3 blocks")


AnyIndex = QModelIndex | QPersistentModelIndex


class CountingDelegate(QStyledItemDelegate):
    """Counts how often a text is measured."""

    count = 0

    def sizeHint(self, option: QStyleOptionViewItem, index: AnyIndex) -> QSize:  # noqa: N802  # Qt's own name
        self.count += 1
        return super().sizeHint(option, index)


def test_a_table_is_measured_once_for_all_its_texts(qtbot: QtBot) -> None:
    """Filled again while it was seen, 5000 rows took minutes: each text measured a thousand others."""
    table = read_table("blocks", ("Block", "s"), TableLook(figures=(1,)))
    qtbot.addWidget(table)
    counting = CountingDelegate(table)
    table.setItemDelegate(counting)
    with qtbot.waitExposed(table):
        table.show()
    for _ in range(2):
        fill(table, [(f"N{n}", "1") for n in range(400)])
        qtbot.wait(1)
    assert counting.count < 4000
