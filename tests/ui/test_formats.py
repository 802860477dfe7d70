"""Import and export of the text formats of controls and their tools."""

from pathlib import Path

from amp_studio.files import open_file
from amp_studio.schema import Value
from amp_studio.ui.main_window import MainWindow

from .conftest import User, action

CALIBRATION = ("home.calibration", "1")


def test_what_is_exported_can_be_imported_again(window: MainWindow, user: User, tmp_path: Path) -> None:
    before = dict(window.workspace.file.values)
    window.menus["view.secrets"].trigger()
    user.chooses(tmp_path / "mill.csv")
    action(window, "Export").trigger()
    assert (tmp_path / "mill.csv").is_file()

    user.chooses(tmp_path / "mill.csv", tmp_path / "again.amp")
    action(window, "Import").trigger()
    assert window.workspace.path == tmp_path / "again.amp"
    assert window.workspace.file.values == before
    assert window.workspace.file.header.name == "again"


def test_a_text_that_cannot_be_understood_makes_no_file(
    window: MainWindow, user: User, tmp_path: Path
) -> None:
    displayed = window.workspace.path
    (tmp_path / "bad.patch").write_text("# Patch sheet of X\n# machine mill\n1300\tfast\n", "utf-8")
    user.chooses(tmp_path / "bad.patch")
    action(window, "Import").trigger()
    assert "line 3, column 6: " in user.reads()
    assert window.workspace.path == displayed


def test_what_is_not_understood_is_kept_only_where_that_is_wanted(
    window: MainWindow, user: User, tmp_path: Path
) -> None:
    sheet = tmp_path / "odd.patch"
    sheet.write_text("# Patch sheet of X\n# machine mill\n1300\t1\tmm\n99999\t5\n", "utf-8")
    user.chooses(sheet)
    user.answers("Cancel")
    action(window, "Import").trigger()
    assert "line 4, column 1" in user.asked[-1]

    user.chooses(sheet, tmp_path / "odd.amp")
    user.answers("Keep Them")
    action(window, "Import").trigger()
    assert open_file(tmp_path / "odd.amp").file.unknown == {"99999": "5"}


def test_values_that_are_not_allowed_are_taken_only_where_that_is_wanted(
    window: MainWindow, user: User, tmp_path: Path
) -> None:
    table = tmp_path / "far.csv"
    table.write_text("id,instance,value,unit\nhome.calibration,1,9999999,mm\n", "utf-8")
    user.chooses(table)
    user.answers("Cancel")
    action(window, "Import").trigger()
    assert "One value is not allowed" in user.asked[-1]

    user.chooses(table, tmp_path / "far.amp")
    user.answers("Import and Mark")
    action(window, "Import").trigger()
    file = open_file(tmp_path / "far.amp").file
    assert file.get(CALIBRATION) == Value(9999999.0, "mm")
    assert file.forced[CALIBRATION].endswith("by an import")


def test_what_a_text_leaves_out_is_shown(window: MainWindow, user: User, tmp_path: Path) -> None:
    (tmp_path / "num.txt").write_bytes(b"%00000000;09\nP5N0:t0n2;09\n#1;02\n\x13")
    user.chooses(tmp_path / "num.txt", tmp_path / "num.amp")
    action(window, "Import").trigger()
    assert window.workspace.path == tmp_path / "num.amp"
    assert "; the table does not contain these words: P5N1" in window.statusBar().currentMessage()


LISTING = "".join(f"${n}=100\n" for n in (0, 1, 11, 24, 25, 27, 30, 100, 101, 102, 110, 111, 112))


def test_the_machine_type_and_one_of_several_listings_are_asked_for(
    window: MainWindow, user: User, tmp_path: Path
) -> None:
    log = tmp_path / "log.txt"
    log.write_text(
        f"First mill:\n{LISTING}\nSecond mill:\n{LISTING.replace('$110=100', '$110=200')}", "utf-8"
    )
    user.chooses(log, tmp_path / "first.amp")
    user.types("1: line 2, 'First mill:'", "Grbl 1.1")
    action(window, "Import").trigger()
    file = open_file(tmp_path / "first.amp").file
    assert (file.machine, file.values["axis.max_rate", "X"]) == ("grbl-1.1", Value(100.0, "mm/min"))


def test_an_export_shows_what_it_leaves_out_before_it_writes(
    window: MainWindow, user: User, tmp_path: Path
) -> None:
    user.chooses(tmp_path / "mill.patch")
    user.answers("Cancel")
    action(window, "Export").trigger()
    total = len(window.workspace.file.values)
    assert f"mill.patch: 296 of {total} values go across as they are." in user.asked[-1]
    assert "6 values changed by rounding: 1203 10000 mm/min -> 166.66667 mm/s" in user.asked[-1]
    assert not (tmp_path / "mill.patch").exists()

    user.chooses(tmp_path / "mill.patch")
    user.answers("Export")
    action(window, "Export").trigger()
    assert (tmp_path / "mill.patch").exists()
    assert window.statusBar().currentMessage().endswith(f"mill.patch written (296 of {total} values)")
