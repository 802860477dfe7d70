"""A control's own text is read wherever a parameter file is read; what writes needs a parameter file."""

from collections.abc import Callable
from pathlib import Path

import pytest

from amp_studio import cli
from tests.campaigns import some

from .conftest import Outcome

LISTING = "".join(
    f"${n}={value}\n"
    for n, value in {
        0: 10,
        1: 25,
        2: 0,
        3: 0,
        4: 0,
        5: 0,
        6: 0,
        10: 1,
        11: 0.01,
        12: 0.002,
        13: 0,
        20: 0,
        21: 0,
        22: 0,
        23: 0,
        24: 25,
        25: 500,
        26: 250,
        27: 1,
        30: 1000,
        31: 0,
        32: 0,
        **{100 + 10 * q + a: 250 for q in range(4) for a in range(3)},
    }.items()
)


@pytest.fixture
def listing(tmp_path: Path) -> Path:
    path = tmp_path / "backup.nc"
    path.write_text(f"Grbl 1.1h ['$' for help]\n{LISTING}ok\n", "utf-8")
    return path


@pytest.fixture
def other(tmp_path: Path) -> Path:
    path = tmp_path / "later.txt"
    path.write_text(LISTING.replace("$110=250", "$110=300"), "utf-8")
    return path


def test_a_listing_is_checked_and_read(amp: Callable[..., Outcome], listing: Path) -> None:
    checked = amp("validate", listing, "--json")
    assert (checked.code, checked.json["errors"]) == (0, 0)
    assert "machine type Grbl 1.1" in checked.err
    assert amp("get", listing, "$110", "--json").json["values"][0]["value"] == 250.0
    assert amp("find", listing, "maximum", "rate").code == 0
    assert amp("guide", listing).code == 0


def test_listings_and_parameter_files_are_compared(
    amp: Callable[..., Outcome], listing: Path, other: Path, tmp_path: Path
) -> None:
    made = tmp_path / "made.amp"
    assert amp("import", listing, "-o", made).code == 0
    assert amp("diff", listing, made).code == 0
    for sides in ((listing, other), (made, other)):
        found = amp("diff", *sides, "--json")
        assert found.code == 1
        assert [(d["param"], d["a"], d["b"]) for d in found.json["differences"]] == [
            ("$110", "250 mm/min", "300 mm/min")
        ]
    assert amp("compare", listing, made, other).code == 1
    assert amp("diff", listing, other, "--base", made).code == 1


def test_listings_are_merged_and_printed(
    amp: Callable[..., Outcome], listing: Path, other: Path, tmp_path: Path
) -> None:
    ours, merged, printed = tmp_path / "ours.grbl", tmp_path / "merged.amp", tmp_path / "report.txt"
    ours.write_text(LISTING.replace("$120=250", "$120=90"), "utf-8")
    assert amp("merge", listing, ours, other, "-o", merged).code == 0
    values = amp("get", merged, "$110", "$120", "--json").json["values"]
    assert [row["value"] for row in values] == [300.0, 90.0]
    assert amp("report", listing, "-o", printed).code == 0
    assert "Grbl 1.1" in printed.read_text("utf-8")
    assert amp("export", listing, "-o", tmp_path / "table.csv").code == 0


def test_what_cannot_be_read_names_its_line_and_what_writes_needs_a_parameter_file(
    amp: Callable[..., Outcome], listing: Path, tmp_path: Path
) -> None:
    broken, text = tmp_path / "broken.nc", tmp_path / "letter.txt"
    broken.write_text(LISTING.replace("$0=10", "$0=1e-5"), "utf-8")
    text.write_text("Dear all\n", "utf-8")
    assert f"{broken}, line 1: $0: '1e-5' is not a number" in amp("validate", broken).err
    assert amp("validate", text).code == 2
    before = listing.read_bytes()
    assert amp("set", listing, "$110=5").code == 2
    assert listing.read_bytes() == before


FEW = "".join(
    f"${n}={value}\n"
    for n, value in {0: 10, 1: 25, 10: 1, 22: 1, 110: 500, 111: 500, 112: 500, 130: 200}.items()
)
"""Settings that any Grbl has: the text does not decide which."""


@pytest.fixture
def few(tmp_path: Path) -> Path:
    path = tmp_path / "few.txt"
    path.write_text(FEW, "utf-8")
    return path


@pytest.mark.parametrize(
    "verb",
    some(
        [
            ("validate", "FEW"),
            ("get", "FEW", "$110"),
            ("report", "FEW", "-o", "report.txt"),
            ("export", "FEW", "-o", "table.csv"),
            ("diff", "FEW", "FEW"),
            ("compare", "FEW", "FEW"),
            ("merge", "FEW", "FEW", "FEW", "-o", "merged.amp"),
            ("verify", "FEW", "--with", "tcp://127.0.0.1:1"),
            ("download", "FEW", "--to", "tcp://127.0.0.1:1"),
        ],
        2,
    ),
)
def test_every_verb_takes_the_machine_type_of_a_text(
    few: Path, verb: tuple[str, ...], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(few.parent)
    words = [str(few) if word == "FEW" else word for word in verb]
    at_a_control = verb[0] in ("verify", "download")
    cli.run(words)
    assert "machine type grblHAL, as none was given. Known: " in capsys.readouterr().err
    (few.parent / "merged.amp").unlink(missing_ok=True)
    code = cli.run([*words, "--family", "grblhal", "--machine", "grbl-1.1"])
    printed = capsys.readouterr()
    (few.parent / "merged.amp").unlink(missing_ok=True)
    assert "machine type" not in printed.err, "nothing was left to be decided"
    assert code == 0 or at_a_control, printed.err
    assert cli.run([*words, "--machine", "saw"]) == 2
    assert "Unknown machine type 'saw'. Known: grblhal, grbl-1.1" in capsys.readouterr().err
    assert cli.run([*words, "--family", "grbll"]) == 2
    assert "Unknown family 'grbll'. Known: " in capsys.readouterr().err


def test_the_machine_type_of_a_text_is_the_one_that_is_named(
    amp: Callable[..., Outcome], few: Path, tmp_path: Path
) -> None:
    merged = tmp_path / "merged.amp"
    assert amp("merge", few, few, few, "-o", merged, "--machine", "grbl-1.1").code == 0
    assert "machine: grbl-1.1" in merged.read_text("utf-8")
    found = amp("validate", few, few, "--machine", "grbl-1.1", "--json")
    assert found.code == 0
    assert "machine type" not in found.err


def test_a_text_longer_than_any_control_writes_is_refused_in_one_line(
    amp: Callable[..., Outcome], tmp_path: Path
) -> None:
    long = tmp_path / "log of a year.txt"
    long.write_text(LISTING + "(" + "x" * 5 * 2**20 + ")\n", "utf-8")
    message = f"amp-studio: {long}: cannot be read: Is larger than 4 MiB, the most that is read\n"
    assert amp("validate", long) == Outcome(2, "", message)
