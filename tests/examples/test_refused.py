"""Files that must be refused: each with one clear line, exit code 2, and nothing touched."""

import shutil
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.schema import family_ids

KNOWN = ", ".join(family_ids())

FOLDER = Path(__file__).parent / "refused"

REFUSED = {
    "a-picture": ", line 1: is not UTF-8 text",
    "address-twice": ", line 9: 'servo.sercos_cycle' occurs twice",
    "another-kind-of-file": ": is not an AMP Studio parameter file",
    "bad-indent": ", line 7: is not readable: did not find expected key",
    "cut-off-after-a-line": ", line 8: ends without its end mark '...': it has been cut off",
    "cut-off-in-a-key": ", line 8: ends without its end mark '...': it has been cut off",
    "cut-off-in-a-value": ", line 8: ends without its end mark '...': it has been cut off",
    "cut-off-to-nothing": ": is not an AMP Studio parameter file",
    "key-twice": ", line 9: 'home.calibration@1' occurs twice",
    "newer-version": ", line 1: was written by a newer AMP Studio (file format 2, known: 1)",
    "no-family": ": names no control family",
    "no-finite-number": ", line 8: home.calibration@1: '1e999' is too large",
    "no-number": ", line 8: home.calibration@1: 'far' is not a number",
    "no-single-value": ", line 8: home.calibration@1 has no single value",
    "no-unit": ", line 8: home.calibration@1: '1' has no unit: write 1 mm",
    "no-value": ", line 8: home.calibration@1 has no single value",
    "no-whole-number": ", line 8: servo.sercos_cycle: Cycle Time for SERCOS takes whole numbers, not 1.5",
    "not-utf-8": ", line 7: is not UTF-8 text",
    "tab": ", line 8: is not readable: found a tab character that violates indentation",
    "two-ways-to-read": ", line 8: home.calibration@1: '1,234' can be read two ways: write 1234 or 1.2340",
    "unit-of-something-else": ", line 8: home.calibration@1: Home Calibration is given in mm, not in ms",
    "unknown-choice": (
        ", line 8: servo.sercos_baud: '8 MHz' is not a choice of Baud Rate for SERCOS: 2 MHz (a), 4 MHz (b)"
    ),
    "unknown-family": f", line 2: Unknown family '9/series'. Known: {KNOWN}",
    "unknown-machine": ", line 4: machine is 'saw'; known here: lathe, mill",
    "unknown-unit": ", line 8: home.calibration@1: 'furlong' is not a unit; Home Calibration is given in mm",
    "unknown-units": ", line 4: units is 'nautical'; known here: metric, inch",
    "values-as-list": ", line 3: 'values' is not a list of parameters with values",
    "version-in-words": ", line 1: 'one' is no version of the file format",
}


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """Return a copy of the folder, so that a fault cannot damage what is refused."""
    return shutil.copytree(FOLDER, tmp_path / "refused")


def test_the_list_is_complete() -> None:
    assert sorted(REFUSED) == sorted(path.stem for path in FOLDER.iterdir())


@pytest.mark.parametrize("name", sorted(REFUSED))
def test_it_is_refused_with_one_clear_line(copy: Path, name: str, capsys: pytest.CaptureFixture[str]) -> None:
    path = copy / f"{name}.amp"
    assert run(["validate", str(path)]) == 2
    message = capsys.readouterr()
    assert message.out == ""
    assert message.err == f"amp-studio: {path}{REFUSED[name]}\n"


@pytest.mark.parametrize("name", sorted(REFUSED))
def test_it_is_not_touched(copy: Path, name: str, capsys: pytest.CaptureFixture[str]) -> None:
    path = copy / f"{name}.amp"
    before = {p.name: p.read_bytes() for p in copy.iterdir()}
    assert run(["set", str(path), "servo.sercos_cycle=2 ms"]) == 2
    assert run(["report", str(path), "-o", str(copy / "report.txt")]) == 2
    assert before == {p.name: p.read_bytes() for p in copy.iterdir()}
