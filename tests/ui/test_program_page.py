"""The page of blocks and programs."""

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QSize, Qt
from PySide6.QtWidgets import QStyledItemDelegate, QStyleOptionViewItem
from pytestqt.qtbot import QtBot

from amp_studio.assignments import read_assignments
from amp_studio.drawing import Picture
from amp_studio.files import SavedVersion, open_file
from amp_studio.schema import Address, Value
from amp_studio.ui.base.task import Task
from amp_studio.ui.program.block_list import BlockModel, BlockTable, kinds_of
from amp_studio.ui.program.page import FIRST, ProgramPage
from amp_studio.ui.program.play import STEPS
from amp_studio.ui.program.tables import TableLook, fill, read_table

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


def cell(window: ProgramPage, row: int, column: int) -> str:
    """Return what a row of the list of blocks shows."""
    return str(window.lines.blocks.index(row, column).data() or "")


def blocks_of(window: ProgramPage) -> list[str]:
    return [cell(window, row, 0) for row in range(window.lines.blocks.rowCount())]


def enter(window: ProgramPage, key: str, text: str) -> None:
    form = window.change_form if key == "change" else window.form
    form.set_answer(key, text)
    form.entered.emit(key)


def test_a_typed_block_is_read_word_by_word(window: ProgramPage) -> None:
    enter(window, "block", "G1 X-10.5 F20")
    texts = [window.words.item(n, 1).text() for n in range(window.words.rowCount())]
    assert texts == ["1", "−10.5 in", "20 in/min"]
    enter(window, "block", "X@")
    assert "is no word" in window.summary.text()


def test_a_program_shows_its_time_what_limits_it_and_another_value(
    window: ProgramPage, plate: Path, qtbot: QtBot, applied: list[dict[Address, Value]]
) -> None:
    enter(window, "change", "speeds.rapid=150")
    assert "Open a part program first" in window.summary.text()
    window.open_program(plate)
    qtbot.waitUntil(lambda: window.outcome is not None, timeout=10 * WAIT_MS)
    assert window.path.title.text().startswith("plate.nc: 6 blocks")
    assert "feed as programmed" in [window.limits.item(n, 1).text() for n in range(window.limits.rowCount())]
    limits = [window.limits.item(n, 1).text() for n in range(window.limits.rowCount())]
    assert [text for text in limits if "speeds." in text] == [], "a parameter has its name, not its id"
    row = limits.index("Rapid Speed")
    window.limits.cellActivated.emit(row, 1)
    assert window.change_form.answer("change") == "speeds.rapid=+20%", "and is tried as it is typed"
    assert [cell(window, n, 1) for n in (3, 4)] == ["A", "R"]
    assert window.path.plot.picture is not None
    window.path.view.buttons["tilted"].click()
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
        window.path.colours.buttons[colours].click()
        assert window.path.plot.picture is not None
        assert window.path.plot.picture.above is not None
        assert words in window.path.plot.picture.above.subtitle


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
    window: ProgramPage, plate: Path, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    window.open_program(plate)
    qtbot.waitUntil(lambda: window.outcome is not None, timeout=10 * WAIT_MS)
    assert window.outcome is not None
    assert sum(part.seconds for part in window.path.bar.parts) == pytest.approx(
        window.outcome.plan.time, rel=1e-4
    )
    assert "feed as programmed" in window.path.bar.accessibleDescription()
    seen: list[tuple[str, tuple[float, float], float, str]] = []
    monkeypatch.setattr(window.path.plot, "show_now", lambda *now: seen.append(now))
    window.play.slider.setValue(STEPS)
    name, place, time, reading = seen[-1]
    # The picture is in inches, as the file is.
    ends = (window.outcome.plan.whole.geometry.ends[-1][:2] / 25.4).tolist()
    assert list(place) == pytest.approx(ends)
    assert name == "N50: 0 in/min"
    assert time == pytest.approx(window.outcome.plan.time)
    assert reading.startswith("now ")
    assert window.lines.line() - 1 == window.outcome.plan.whole.path.line[-1] - 1
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
    whole = blocks_of(window)
    letters = [cell(window, n, 1) for n in range(len(whole))]
    qtbot.keyClick(window.lines, Qt.Key.Key_1)
    first = window.limits.item(0, 0).text()
    assert window.path.filter.letter == first
    assert window.limits.item(0, 1).text() == "Rapid Speed"
    assert blocks_of(window) == [text for text, letter in zip(whole, letters, strict=True) if letter == "R"]
    scene = window.path.plot.picture.above
    assert scene is not None
    assert {text.text for text in scene.texts} == {"R"}, "and the path has the colour of that limit alone"
    assert "before" in {line.sort for line in scene.lines}
    qtbot.keyClick(window.lines, Qt.Key.Key_7)
    assert blocks_of(window) == ["N60 G41 X-1"]
    qtbot.keyClick(window.lines, Qt.Key.Key_0)
    assert blocks_of(window) == whole
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
    draw = window.path.plot.draw

    def seen(picture: Picture) -> None:
        titles.append(window.path.title.text())
        draw(picture)

    monkeypatch.setattr(window.path.plot, "draw", seen)
    window.open_program(path)
    qtbot.waitUntil(lambda: window.outcome is not None, timeout=WAIT_MS)
    assert titles[0] == f"long.nc: the first {FIRST} blocks"
    assert window.path.title.text().startswith(f"long.nc: {3 * FIRST + 1} blocks")


def test_a_beginning_that_needs_the_rest_is_left_out(
    window: ProgramPage, tmp_path: Path, qtbot: QtBot
) -> None:
    path = tmp_path / "long.nc"
    path.write_text("G20 G90 G1 F100\nGOTO 9\n" + "X-1.\nX-2.\n" * FIRST + "N9 X-3.\n")
    window.open_program(path)
    qtbot.waitUntil(lambda: window.outcome is not None, timeout=WAIT_MS)
    assert window.path.title.text().startswith("long.nc: 3 blocks")


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


WAVE = ["G20 G90 G17 G62", "G0 X-2 Y-1", "G1 X-8 F190"] + [
    f"N{100 + n} G1 X{-8 + 0.1 * n:.1f} Y{-1 - 0.01 * n:.2f}" for n in range(1, 30)
]


@pytest.fixture
def wave(window: ProgramPage, tmp_path: Path, qtbot: QtBot) -> ProgramPage:
    """Return the page with a program of blocks that are alike."""
    (tmp_path / "wave.nc").write_text("\n".join(WAVE))
    window.show()
    window.open_program(tmp_path / "wave.nc")
    qtbot.waitUntil(lambda: window.outcome is not None, timeout=10 * WAIT_MS)
    return window


def test_blocks_that_are_alike_are_folded(wave: ProgramPage, qtbot: QtBot) -> None:
    folded = blocks_of(wave)
    rows = wave.lines.blocks.rows
    first = rows.letters.tolist().index("A", 4) - 1  # the way back begins on a ramp, and ends on one
    last = len(WAVE) if rows.letters[-1] == "A" else len(WAVE) - 1
    count = last - first - 6
    fold = f"+{count} blocks like these"
    assert count > 15
    assert folded == [*WAVE[: first + 6], f"\u25b8 {fold}", *WAVE[last:]]
    listed_time = float(cell(wave, first + 6, 2).replace(",", "."))
    whole = float(rows.times[first + 7 : last + 1].sum())
    assert listed_time == pytest.approx(whole, rel=5e-3), "with their time together"
    wave.lines.setFocus()
    wave.lines.selectRow(first + 6)
    qtbot.keyClick(wave.lines, Qt.Key.Key_Return)
    assert blocks_of(wave) == [*WAVE[: first + 6], f"\u25be {fold}", *WAVE[first + 6 :]]
    qtbot.keyClick(wave.lines, Qt.Key.Key_Return)
    assert blocks_of(wave) == folded


def test_a_block_is_gone_to_by_its_number_and_its_line(wave: ProgramPage, qtbot: QtBot) -> None:
    assert wave.outcome is not None
    assert wave.go_to()
    wave.go_to_field.setText("n120")
    qtbot.keyClick(wave.go_to_field, Qt.Key.Key_Return)
    assert wave.lines.line() == 23, "its fold is opened"
    assert wave.play.moment == wave.outcome.plan.listed.begin(23)
    assert not wave.go_to_field.isVisible()
    for text, line in (("3", 3), ("N111", 14), ("33", 14), ("N7", 14), ("X", 14)):
        wave.go_to_field.text_requested.emit(text)
        assert wave.lines.line() == line, text
    assert wave.summary.text() == "The program has no block X."
    wave.go_to()
    wave.escape()
    assert not wave.go_to_field.isVisible(), "Esc asks no more, and stays on the page"


def test_arrows_and_clicks_go_from_block_to_block(wave: ProgramPage, qtbot: QtBot) -> None:
    assert wave.outcome is not None
    wave.lines.setFocus()
    wave.lines.selectRow(1)
    qtbot.keyClick(wave.lines, Qt.Key.Key_Right)
    assert (wave.lines.line(), wave.play.moment) == (3, wave.outcome.plan.listed.begin(3))
    qtbot.keyClick(wave.lines, Qt.Key.Key_Left)
    assert wave.lines.line() == 2
    wave.path.plot.setFocus()
    qtbot.keyClick(wave.path.plot, Qt.Key.Key_Right)
    assert wave.lines.line() == 3
    wave.path.plot.pointed.emit(-5.5, -1.24)  # in inches
    end = -8 + 0.1 * (wave.lines.line() - 3)
    assert end == pytest.approx(-5.5, abs=0.11)
    assert wave.limits.item(wave.limits.currentRow(), 0).text() == cell(
        wave, wave.lines.currentIndex().row(), 1
    )
    wave.path.plot.timed.emit(0.0)
    assert wave.lines.line() == 2


def test_a_contour_error_above_the_own_limit_is_not_good(wave: ProgramPage, qtbot: QtBot) -> None:
    assert wave.outcome is not None
    assert wave.outcome.contour is not None
    enter(wave, "change", "speeds.rapid=150")
    qtbot.waitUntil(lambda: wave.tries.table.rowCount() == 1, timeout=10 * WAIT_MS)
    assert not wave.tries.table.item(0, 3).text().startswith("\u26a0")
    wave.path.filter.turn_to("!")
    assert blocks_of(wave) == []
    enter(wave, "limit", f"{500.0 * wave.outcome.contour.largest:.3f} um")  # half of the largest
    not_good = blocks_of(wave)
    assert not_good
    assert set(not_good) < set(WAVE)
    panel = wave.path.plot.panels[-1]
    assert panel.levels[0].name.startswith("own limit")
    assert panel.dots[0].sort == "error"
    assert wave.tries.table.item(0, 3).text().startswith("\u26a0"), "a try that is above it has its mark"
    enter(wave, "limit", "much")
    assert "has to be an error above 0" in wave.summary.text()
    enter(wave, "limit", "")
    assert blocks_of(wave) == []


def test_a_hundred_thousand_blocks_are_folded_by_numbers_alone() -> None:
    lines = [f"N{n} X{n % 7} Y{n % 5}" for n in range(100_000)]
    letters, times = np.full(100_001, "A"), np.ones(100_001)
    letters[50_000] = "B"
    model = BlockModel()
    found = {"B": [50_000]}
    model.show_rows(BlockTable(lines, letters, times, kinds_of(lines, letters), {}, found.__getitem__))
    assert model.rowCount() == 15, "six and a fold, one, six and a fold"
    assert model.row_of(70_000) == 14
    assert model.open_at(70_000) == 13 + 70_000 - 50_005
    model.show_only("B")
    assert [model.line_of(row) for row in range(model.rowCount())] == [50_000]


def test_the_error_of_a_moment_is_read_in_the_heading_and_not_on_the_curves(
    window: ProgramPage, plate: Path, qtbot: QtBot
) -> None:
    """ "now 0.0000532 in" lay on the curve, its band and the colours at their foot."""
    window.resize(1000, 700)
    window.show()
    window.open_program(plate)
    qtbot.waitUntil(lambda: window.outcome is not None and not Task.running, timeout=WAIT_MS)
    window.play.slider.setValue(500)
    window.path.plot.grab()
    plot = window.path.plot
    frame, (at, reading) = plot._frames[-1], plot._now
    box = plot.reading_box(at, reading)
    assert reading.startswith("now ")
    assert box.bottom() <= frame.top
    assert plot._frames[-2].top + plot._frames[-2].height <= box.top()
    assert box.right() <= plot.width()
