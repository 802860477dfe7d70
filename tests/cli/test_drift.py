"""verify --all: every known control of a folder against its file, what drifted since when, and one exit
code.
"""

import json
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from amp_studio import cli
from amp_studio.transfer.client import record
from amp_studio.transfer.client.drift import ControlWithFile, known_controls
from amp_studio.transfer.client.record import RecordedExchange, add_exchange
from tests.forked import emulated

from .conftest import Outcome

DEAD = "tcp://127.0.0.1:1"
"""Nothing listens there."""


def exchange(day: int, verb: str, file: str, control: str, after: str) -> RecordedExchange:
    return RecordedExchange(
        f"2026-03-{day:02}T08:00:00+00:00", "eva", verb, file, "9pc", control, after=after, state="new"
    )


def folder_with(folder: Path, *exchanges: RecordedExchange, files: tuple[str, ...] = ()) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    for name in files:
        (folder / name).write_text("", encoding="utf-8")
    for each in exchanges:
        assert add_exchange(folder / "any.amp", each) == ""
    return folder


def project(folder: Path, control: str) -> Path:
    folder.mkdir(exist_ok=True)
    text = f"amp_studio_project: 1\nname: A\nfamily: 9pc\ncontrol: {control}\n"
    (folder / "project.yaml").write_text(text, encoding="utf-8")
    return folder


def displayed(found: list[ControlWithFile]) -> list[tuple[str, str]]:
    return [(known.address, known.fault or known.path.name) for known in found]


def test_a_control_is_known_with_the_file_that_was_last_put_into_it(tmp_path: Path) -> None:
    folder_with(
        tmp_path / "a",
        exchange(1, "download", "old.amp", "tcp://10.0.0.1:9600", "11"),
        exchange(2, "download", "new.amp", "tcp://10.0.0.1:9600", "22"),
        exchange(3, "verify", "third.amp", "tcp://10.0.0.1:9600", "22"),
        exchange(3, "restore", "two.before-20260302-080000.img", "tcp://10.0.0.2:9600", "33"),
        exchange(4, "verify", "old.amp", "tcp://10.0.0.3:9600", "44"),
        files=("old.amp", "new.amp", "two.amp"),
    )
    assert displayed(known_controls(tmp_path)) == [
        ("tcp://10.0.0.1:9600", "new.amp"),
        ("tcp://10.0.0.2:9600", "two.amp"),
    ]


def test_a_control_of_two_folders_belongs_to_the_later_download(tmp_path: Path) -> None:
    for name, day in (("a", 5), ("b", 7), ("c", 6)):
        folder_with(
            tmp_path / "hall" / name,
            exchange(day, "download", f"{name}.amp", "tcp://10.0.0.1:9600", "11"),
            files=(f"{name}.amp",),
        )
    assert displayed(known_controls(tmp_path)) == [("tcp://10.0.0.1:9600", "b.amp")]


def test_a_project_names_the_control_of_its_one_file(tmp_path: Path) -> None:
    folder_with(project(tmp_path / "a", "tcp://10.0.0.1:9600"), files=("one.amp",))
    folder_with(project(tmp_path / "b", "tcp://10.0.0.2:9600"), files=("one.amp", "two.amp"))
    second, first = displayed(known_controls(tmp_path))
    assert first == (
        "tcp://10.0.0.2:9600",
        f"no download to it is recorded, and {tmp_path / 'b'} has 2 parameter files",
    )
    assert second == ("tcp://10.0.0.1:9600", "one.amp")


def test_a_file_that_is_gone_is_a_fault(
    amp: Callable[..., Outcome], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder_with(tmp_path / "a", exchange(1, "download", "gone.amp", DEAD, "11"))
    assert cli.run(["verify", "--all", str(tmp_path)]) == 2
    printed = capsys.readouterr().out
    assert "no file" in printed
    assert f"{tmp_path / 'a' / 'gone.amp'}, which was put into it, is not there any more" in printed


@pytest.fixture
def control(tmp_path: Path) -> Iterator[str]:
    """Return the address of an emulated 9/PC in a separate process."""
    with emulated("9pc", tmp_path / "state", "--machine", "mill") as (_, address):
        yield address


@pytest.fixture
def hall(
    amp: Callable[..., Outcome], checkout: Path, control: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Path:
    """Return a folder whose mill.amp went to the control on 1 March; each record after it is a day later."""
    days = iter(f"2026-03-{day:02}T11:00:00+00:00" for day in range(1, 30))
    monkeypatch.setattr(record, "now", lambda: next(days))
    hall = tmp_path / "hall"
    hall.mkdir()
    shutil.copy(checkout / "examples" / "mill-1394" / "MILL_1394.amp", hall / "mill.amp")
    assert amp("download", hall / "mill.amp", "--to", control).code == 0
    return hall


def test_what_drifted_at_the_control_is_known_with_its_days(
    amp: Callable[..., Outcome], control: str, hall: Path, tmp_path: Path
) -> None:
    same = amp("verify", "--all", hall)  # 2 March
    assert (same.code, same.out.splitlines()[-1]) == (0, "1 control: 1 same")

    elsewhere = Path(shutil.copy(hall / "mill.amp", tmp_path / "elsewhere.amp"))
    amp("set", elsewhere, "1750=12 mm")
    assert amp("download", elsewhere, "--to", control).code == 0  # 3 March, recorded elsewhere
    first = amp("verify", "--all", hall, "--json")  # 4 March
    assert first.code == 1
    (one,) = first.json["controls"]
    assert (one["address"], one["file"], one["result"]) == (control, str(hall / "mill.amp"), "differs")
    assert one["since"] == "the control was changed after 2026-03-02 11:00"
    assert [(d["param"], d["a"], d["b"]) for d in one["differences"]] == [("1750", "11 mm", "12 mm")]
    again = amp("verify", "--all", hall)  # 5 March
    assert "the control was changed after 2026-03-02 11:00, and seen so since 2026-03-04 11:00" in again.out
    assert "1750 Excess Error" in again.out
    assert again.out.splitlines()[-1] == "1 control: 1 differs"


def test_what_drifted_in_the_file_and_what_is_not_reached_is_one_page(
    amp: Callable[..., Outcome], control: str, hall: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert amp("download", hall / "mill.amp", "--to", control).code == 0  # 2 March: the last exchange counts
    amp("set", hall / "mill.amp", "1300=2 mm")
    page = tmp_path / "page.html"
    folder_with(project(hall / "b", DEAD), files=("b.amp",))
    shutil.copy(hall / "mill.amp", hall / "b" / "b.amp")
    page.write_text("the page of the day before", "utf-8")
    capsys.readouterr()
    assert cli.run(["verify", "--all", str(hall), "--report", str(page), "--json"]) == 2
    found = json.loads(capsys.readouterr().out)
    assert (found["same"], found["differs"], found["not_reached"]) == (0, 1, 1)
    by_address = {each["address"]: each for each in found["controls"]}
    assert (
        by_address[control]["since"]
        == "the file was changed after 2026-03-02 11:00; the control is as it was left then"
    )
    assert by_address[DEAD]["result"] == "not reached"
    text = page.read_text("utf-8")
    for part in (control, DEAD, "1300 Home Calibration", "not reached", "as it was left then"):
        assert part in text


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        (("--all", "--with", DEAD), "--all compares the known controls: it takes no --with"),
        (("mill.amp",), "verify takes a file and --with ADDRESS, or --all"),
        (("--with", DEAD), "verify takes a file and --with ADDRESS, or --all"),
        (("mill.amp", "--all"), "mill.amp is no folder"),
        (("--all",), " knows no control: no download is recorded there"),
    ],
)
def test_what_cannot_be_understood_is_refused(
    amp: Callable[..., Outcome],
    mill: Path,
    monkeypatch: pytest.MonkeyPatch,
    arguments: tuple[str, ...],
    why: str,
) -> None:
    monkeypatch.chdir(mill.parent)
    refused = amp("verify", *arguments)
    assert refused.code == 2
    assert why in refused.err
