"""A value that became ten times itself, or its negative, since the file was another one is asked about;
nothing else is.
"""

import json
import shutil
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.files import Document, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.schema import Value
from amp_studio.validate import Earlier, Validator, earlier_beside

ASKED = "plausible.earlier"


@pytest.fixture
def machine(tmp_path: Path) -> Path:
    """Return a copy of the router, whose Z has a rate of 2000 mm/min and a travel of 95 mm."""
    path = tmp_path / "router.amp"
    shutil.copy(next((examples_folder() / "grblhal-router").glob("*.amp")), path)
    return path


def asked(path: Path) -> list[str]:
    file = open_file(path).file
    findings = Validator(file, earlier=earlier_beside(path, file)).run()
    return [f.message for f in findings if f.rule == ASKED]


def test_a_slip_is_asked_about_until_the_backup_has_it_too(machine: Path) -> None:
    assert asked(machine) == []
    assert run(["set", str(machine), "$132=950"]) == 0
    (message,) = asked(machine)
    assert "950 mm, ten times the 95 mm in the backup. Is it meant?" in message
    assert run(["set", str(machine), "$131=800"]) == 0
    assert asked(machine) == []


def test_a_change_that_is_no_slip_is_no_question(machine: Path) -> None:
    assert run(["set", str(machine), "$132=190", "$131=800", "$130=123.4"]) == 0
    assert asked(machine) == []


def test_what_a_control_got_last_is_known_by_the_history(machine: Path) -> None:
    for assignment in ("$131=800", "$132=950", "$130=900"):
        assert run(["set", str(machine), assignment]) == 0
    assert asked(machine) == []
    entry = {"when": "2020-01-02T08:00:00+00:00", "verb": "download", "file": machine.name, "state": "new"}
    machine.with_name("exchanges.jsonl").write_text(f"no line\n{json.dumps(entry)}\n", "utf-8")
    (message,) = asked(machine)
    assert "ten times the 95 mm in the download of 2020-01-02" in message


def test_what_it_was_made_from_is_known_by_its_header(machine: Path, tmp_path: Path) -> None:
    (tmp_path / "new").mkdir()
    path = tmp_path / "new" / "second.amp"
    assert run(["new", "grblhal", str(path), "--like", str(machine)]) == 0
    assert "made_from: ../router.amp" in path.read_text("utf-8")
    assert run(["set", str(path), "$132=950", "$112=1500"]) == 0  # a travel is of one machine alone
    path.with_name("second.amp.bak").unlink()
    assert asked(path) == []
    assert run(["set", str(path), "$30=2400"]) == 0
    path.with_name("second.amp.bak").unlink()
    (message,) = asked(path)
    assert "is 2400 rpm, a tenth of the 24000 rpm in router.amp, which it was made from." in message


def test_an_origin_that_no_system_can_name_is_none(machine: Path) -> None:
    """A NUL in a path is a ValueError of Python, not an OSError: the check ended in it."""
    plain = asked(machine)
    machine.write_bytes(machine.read_bytes().replace(b"values:", b'made_from: "a\\0b"\nvalues:', 1))
    assert asked(machine) == plain


def test_saving_under_another_name_notes_the_first(machine: Path, tmp_path: Path) -> None:
    with Document.open(machine) as document, document.save_as(tmp_path / "copy.amp"):
        pass
    assert "made_from: router.amp" in (tmp_path / "copy.amp").read_text("utf-8")


def test_three_other_machines_in_the_folder_are_a_fleet(machine: Path, tmp_path: Path) -> None:
    for name in "abc":
        shutil.copy(machine, tmp_path / f"{name}.amp")
    assert run(["set", str(machine), "$30=2400"]) == 0
    machine.with_name("router.amp.bak").unlink()
    (message,) = asked(machine)
    assert message.endswith("a tenth of the 24000 rpm of 3 other machines in its folder. Is it meant?")
    # What the control contained before a download lies there too and is no machine.
    (tmp_path / "c.amp").rename(tmp_path / "a.before-20261130-140500.amp")
    assert asked(machine) == []


def test_what_differs_in_many_values_is_another_machine(machine: Path) -> None:
    file = open_file(machine).file
    was = {
        address: Value(value.value * 10, value.unit)
        for address, value in file.values.items()
        if isinstance(value.value, float)
    }
    assert len(was) > 10
    assert [
        f for f in Validator(file, earlier=(Earlier("in the backup", was),)).run() if f.rule == ASKED
    ] == []


def test_an_edit_finds_what_a_full_check_finds(machine: Path) -> None:
    file = open_file(machine).file
    earlier = (Earlier("in the saved file", dict(file.values)),)
    validator = Validator(file, earlier=earlier)
    before = validator.run()
    for value in (200.0, 2000.0):
        file.set(("axis.max_rate", "Z"), Value(value, "mm/min"))
        assert validator.update([("axis.max_rate", "Z")]) == Validator(file, earlier=earlier).run()
    assert validator.findings() == before


@pytest.mark.parametrize("content", [b"", b"\xff\xfe", b"format: 1\n"])
def test_a_backup_that_cannot_be_read_is_no_fault(machine: Path, content: bytes) -> None:
    machine.with_name("router.amp.bak").write_bytes(content)
    assert asked(machine) == []


def test_the_kept_result_of_many_files_is_made_again_when_a_backup_changes(
    machine: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = tmp_path / "other.amp"
    shutil.copy(machine, other)
    assert run(["set", str(machine), "$132=950"]) == 0

    def displayed() -> str:
        capsys.readouterr()
        run(["validate", str(machine), str(other)])
        return capsys.readouterr().out

    assert "in the backup" in displayed()
    assert "in the backup" in displayed()
    shutil.copy(machine, machine.with_name("router.amp.bak"))
    assert "in the backup" not in displayed()
