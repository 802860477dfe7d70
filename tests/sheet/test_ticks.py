"""The ticks of a sheet are on the disk at once, and count as long as nothing else has to be keyed in."""

from pathlib import Path

import pytest

from amp_studio.sheet import Ticks, TicksError, make_sheet, ticks_path
from tests.campaigns import some


@pytest.fixture
def sheet(present, changed):
    """Return a sheet with two entries."""
    return make_sheet(changed({"1750": "40 mm", "1740": "39 mm"}), present)


def test_who_is_interrupted_finds_every_tick_again(tmp_path: Path, sheet) -> None:
    path = ticks_path(tmp_path / "mill.amp")
    first = Ticks(path, sheet)
    first.tick([sheet.entries[0]])
    first.read_back(sheet.entries[0], "40.0")
    again = Ticks(path, sheet)
    assert (path.name, again.done) == ("mill.amp.ticks.json", 1)
    assert sheet.entries[0] in again
    assert sheet.entries[1] not in again
    assert again.screen_text == {sheet.entries[0].number: "40.0"}
    again.tick(sheet.entries, on=False)
    assert Ticks(path, sheet).done == 0


def test_a_tick_of_a_value_that_has_changed_since_is_gone(tmp_path: Path, sheet, present, changed) -> None:
    path = tmp_path / "mill.amp.ticks.json"
    Ticks(path, sheet).tick(sheet.entries)
    other = Ticks(path, make_sheet(changed({"1750": "41 mm", "1740": "39 mm"}), present))
    assert (other.done, other.forgotten) == (1, 1)


def test_what_the_control_contains_by_now_is_off_the_sheet_without_a_word(
    tmp_path: Path, sheet, changed
) -> None:
    path = tmp_path / "mill.amp.ticks.json"
    Ticks(path, sheet).tick(sheet.entries)
    left = Ticks(path, make_sheet(changed({"1750": "40 mm", "1740": "39 mm"}), changed({"1750": "40 mm"})))
    assert (left.done, left.forgotten) == (1, 0)


@pytest.mark.parametrize(
    "content", some(["", "[]", '{"ticks": 3}', '{"ticks": [{"number": 1}]}', "[" * 100_000, "\x00"], 2)
)
def test_a_damaged_file_of_ticks_is_refused_and_left_alone(tmp_path: Path, sheet, content: str) -> None:
    path = tmp_path / "mill.amp.ticks.json"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(TicksError, match="is no list of ticks of a sheet: move it away to start again"):
        Ticks(path, sheet)
    assert path.read_text(encoding="utf-8") == content
