"""The comparison as a merge tool: its result goes to one file, and the exit code is known from how it
ended.
"""

from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from amp_studio import cli
from amp_studio.files import Document, Merge, ParameterFile, SaveError, new_file, open_file
from amp_studio.schema import Value
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.merge import program as merge_program
from amp_studio.ui.merge.columns import BASE
from amp_studio.ui.merge.program import tool_window
from amp_studio.ui.merge.window import MergeWindow

from .conftest import WAIT_MS

CALIBRATION = ("home.calibration", "1")


@pytest.fixture
def three(tmp_path: Path) -> list[Path]:
    """Return base, ours and theirs, with one conflict."""
    paths = []
    for name, value in (("base", 0.0), ("ours", 1.0), ("theirs", 2.0)):
        file = new_file("9pc", "mill", ["X"])
        file.set(CALIBRATION, Value(value, "mm"))
        paths.append(tmp_path / f"{name}.amp")
        Document.create(file, paths[-1]).close()
    return paths


def displayed(three: list[Path], write, qtbot: QtBot) -> MergeWindow:
    """Return the window of the three."""
    base, ours, theirs = (open_file(path).file for path in three)
    workspace = Workspace(Document.view(three[1]))
    window = tool_window(Merge(ours, theirs, base), workspace, Path("merged.amp"), write)
    window.show()
    qtbot.waitUntil(window.isVisible, timeout=WAIT_MS)
    return window


def test_the_result_is_written_once_its_conflict_is_settled_and_the_window_closes(
    three, qtbot: QtBot
) -> None:
    written: list[ParameterFile] = []
    window = displayed(three, written.append, qtbot)
    assert BASE in window.chosen
    assert not window.outcome.merge.isVisible()
    assert not window.outcome.save.isEnabled()
    window.model.choose(window.merge.conflicts, "b")
    window.outcome.save.click()
    assert [file.get(CALIBRATION) for file in written] == [Value(2.0, "mm")]
    assert (window.property("written"), window.isVisible()) == (True, False)


def test_what_cannot_be_written_is_shown_and_the_window_stays(three, qtbot: QtBot) -> None:
    def refuse(_: ParameterFile) -> None:
        raise SaveError("the disk is full")

    window = displayed(three, refuse, qtbot)
    window.model.choose(window.merge.conflicts, "b")
    window.outcome.save.click()
    assert (window.message.text.text(), window.property("written")) == ("the disk is full", None)
    assert window.isVisible()
    window.close()


@pytest.mark.parametrize(("is_saved", "code"), [(True, 0), (False, 1)])
def test_the_exit_code_is_that_of_a_merge(
    three, monkeypatch, tmp_path: Path, is_saved: bool, code: int
) -> None:
    def user(merge: Merge, ours: Path, output: Path, write) -> bool:
        if is_saved:
            write(merge.result())
        return is_saved

    monkeypatch.setattr(merge_program, "merge_in_window", user)
    out = tmp_path / "merged.amp"
    arguments = ["merge", *map(str, three), "-o", str(out), "--window", "--take", "theirs"]
    assert cli.run(arguments) == code
    assert out.exists() == is_saved
