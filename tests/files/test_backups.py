"""The backup of a save, its recovery, and saving a file by itself."""

from pathlib import Path

import pytest

from amp_studio.files import (
    ChangedOnDiskError,
    Document,
    ParameterFile,
    ParameterFileError,
    backup_path,
    content_of,
    digest_of,
    open_file,
    recover_backup,
)
from amp_studio.files.storage import save_file
from amp_studio.schema import Value

CALIBRATION = ("home.calibration", "1")

# -- backup and recovery


def test_a_backup_is_put_back_and_what_stood_there_becomes_the_backup(
    on_disk: Path, mill: ParameterFile
) -> None:
    first = on_disk.read_bytes()
    mill.set(CALIBRATION, Value(8.0, "mm"))
    save_file(mill, on_disk, digest_of(on_disk))
    second = on_disk.read_bytes()
    assert digest_of(backup_path(on_disk)) == recover_backup(on_disk)
    assert (first, second) == (on_disk.read_bytes(), backup_path(on_disk).read_bytes())
    recover_backup(on_disk)
    assert (second, first) == (on_disk.read_bytes(), backup_path(on_disk).read_bytes())


def test_a_backup_brings_back_a_file_that_is_damaged_or_gone(on_disk: Path, mill: ParameterFile) -> None:
    good = on_disk.read_bytes()
    save_file(mill, on_disk, digest_of(on_disk))
    on_disk.write_bytes(b"\x00\x00")
    recover_backup(on_disk)
    assert good == on_disk.read_bytes()
    backup_path(on_disk).write_bytes(good)
    on_disk.unlink()
    recover_backup(on_disk)
    assert good == on_disk.read_bytes()


def test_a_backup_that_cannot_be_read_is_not_put_in_place(on_disk: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"bench\.amp has no backup"):
        recover_backup(on_disk)
    good = on_disk.read_bytes()
    backup_path(on_disk).write_bytes(good[:200])
    with pytest.raises(ParameterFileError):
        recover_backup(on_disk)
    assert (good, good[:200]) == (on_disk.read_bytes(), backup_path(on_disk).read_bytes())


def test_recovery_does_not_overwrite_what_another_program_saved(on_disk: Path, mill: ParameterFile) -> None:
    opened = digest_of(on_disk)
    backup_path(on_disk).write_bytes(on_disk.read_bytes())
    mill.set(CALIBRATION, Value(8.0, "mm"))
    on_disk.write_bytes(content_of(mill))
    theirs = on_disk.read_bytes()
    with pytest.raises(ChangedOnDiskError):
        recover_backup(on_disk, opened)
    assert theirs == on_disk.read_bytes()


# -- save_file


def test_every_saved_file_carries_the_signature_of_the_schema_it_was_saved_with(
    on_disk: Path, mill: ParameterFile
) -> None:
    assert mill.schema.signature == open_file(on_disk).file.header.signature
    mill.header.signature = "of an older program"
    save_file(mill, on_disk, digest_of(on_disk))
    assert mill.schema.signature == open_file(on_disk).file.header.signature


def test_saving_the_same_twice_gives_the_same_bytes(on_disk: Path) -> None:
    first = on_disk.read_bytes()
    opened = open_file(on_disk)
    assert opened.digest == save_file(opened.file, on_disk, opened.digest)
    assert first == on_disk.read_bytes()


def test_values_stand_in_the_order_of_the_manual(on_disk: Path, mill: ParameterFile) -> None:
    lines = on_disk.read_text(encoding="utf-8").splitlines()
    written = [line.strip().split(":")[0] for line in lines[lines.index("values:") + 1 : -1]]
    expected = [f"{p}@{i}" if i else p for p, i in mill.addresses() if (p, i) in mill.values]
    assert expected == written


def test_a_blank_line_with_a_tab_does_not_keep_a_file_from_being_saved(tmp_path: Path) -> None:
    """YAML takes it behind a bare figure, and no longer when that entry is gone and a remark precedes it."""
    path = tmp_path / "press.amp"
    path.write_bytes(
        b"amp_studio: 1\nfamily: 57c422b\nvalues:\n  setup.encoder@X: '0x1414'    # page 4-48\n"
        b"  gain.proportional@X: 17595\n    \t\n  gain.integral@X: 768\n...\n"
    )
    with Document.open(path) as document:
        document.file.set(("gain.proportional", "X"), None)
        document.save()
    assert b"# page 4-48\n\n  gain.integral@X: 768\n" in path.read_bytes()
