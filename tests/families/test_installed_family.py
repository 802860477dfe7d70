"""A family of another package: an entry point is enough, and a broken one takes nothing from the others."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from amp_studio.schema import family_ids

Done = subprocess.CompletedProcess[str]
STEPPER = Path(__file__).parent / "steps"


def install(site: Path, module: str, source: str, entries: str) -> None:
    """Put a package into a folder of the path, as pip does."""
    site.mkdir(exist_ok=True)
    (site / f"{module}.py").write_text(source, encoding="utf-8")
    about = site / f"{module}-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text(
        f"Metadata-Version: 2.1\nName: {module}\nVersion: 1.0\n", encoding="utf-8"
    )
    (about / "entry_points.txt").write_text(f"[amp_studio.families]\n{entries}\n", encoding="utf-8")


@pytest.fixture
def site(tmp_path: Path) -> Path:
    """A folder with the stepper control of these tests, as a package."""
    folder = tmp_path / "site"
    source = (STEPPER / "stepper.py").read_text("utf-8")
    install(folder, "stepper_control", source, "steps = stepper_control:REGISTRATION")
    shutil.copytree(STEPPER / "facts", folder / "facts")
    return folder


SEVERAL = """
import json, sys
from amp_studio.cli import run
for arguments in json.loads(sys.argv[1]):
    if run(arguments) != 0:
        sys.exit(" ".join(arguments))
"""
"""Runs several command lines, and ends at the first that fails."""


def program(site: Path, *arguments: str | Path, started: tuple[str, ...] = ("-m", "amp_studio")) -> Done:
    paths = os.pathsep.join([str(site), os.environ.get("PYTHONPATH", "")])
    return subprocess.run(
        [sys.executable, *started, *map(str, arguments)],
        env=os.environ | {"PYTHONPATH": paths},
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )


def test_a_package_brings_a_family(site: Path, tmp_path: Path) -> None:
    path, text, back = (tmp_path / name for name in ("bench.amp", "bench.stp", "back.amp"))
    lines = (
        ("families",),
        ("new", "steps", path),
        ("set", path, "10=50000 BLU", "20=60 mm"),
        ("validate", path),
        ("report", path, "-o", tmp_path / "bench.html"),
        ("export", path, "-o", text),
        ("import", text, "-o", back),
        ("simulate", path, "step", "--set", "model.rapid=6000", "--set", "move.distance=5"),
    )
    done = program(site, json.dumps([[*map(str, line)] for line in lines]), started=("-c", SEVERAL))
    assert (done.returncode, done.stderr) == (0, ""), done.stdout + done.stderr
    assert "Stepper control" in done.stdout
    assert text.read_text("utf-8").startswith("(STEPS)\n"), "by its format"
    assert "steps" in program(site, "new", "--help").stdout


def test_without_the_package_there_is_no_such_family(tmp_path: Path) -> None:
    (tmp_path / "site").mkdir()
    done = program(tmp_path / "site", "new", "steps", tmp_path / "bench.amp")
    assert done.returncode == 2
    assert "Unknown family 'steps'" in done.stderr


def test_packages_that_cannot_be_loaded_are_named_and_left_out(site: Path) -> None:
    reasons = {
        ("raise OSError('no licence')", "one = other1:REGISTRATION"): "no licence",
        ("REGISTRATION = 1", "two = other2:REGISTRATION"): "other2:REGISTRATION is no Registration of two",
        ("", "three = other3:REGISTRATION"): "has no attribute 'REGISTRATION'",
        ("", "four = missing:REGISTRATION"): "No module named 'missing'",
    }
    for n, (source, entry) in enumerate(reasons, 1):
        install(site, f"other{n}", source, entry)
    done = program(site, "families")
    assert done.returncode == 0
    assert "Stepper control" in done.stdout
    for (_, entry), reason in reasons.items():
        name = entry.partition(" ")[0]
        (line,) = (line for line in done.stderr.splitlines() if f"The family {name} of another" in line)
        assert reason in line


def test_a_family_with_a_fault_in_its_facts_is_named_and_left_out(site: Path, tmp_path: Path) -> None:
    """None of the others could be listed, and the window made no new file."""
    path = site / "facts" / "family.yaml"
    path.write_text(path.read_text("utf-8").replace("machines:", "machnes:", 1), "utf-8")
    done = program(site, "families")
    assert done.returncode == 0
    assert "Stepper control" not in done.stdout
    assert {line.split()[0] for line in done.stdout.splitlines()} == {*family_ids()}
    assert "The family steps of another package cannot be used: " in done.stderr
    done = program(site, "new", "steps", tmp_path / "bench.amp")
    assert done.returncode == 2
    assert done.stderr.endswith(f"{path}, line 8: machnes: there is no such key, did you mean 'machines'?\n")


def test_a_package_cannot_replace_a_family_of_the_program(site: Path, tmp_path: Path) -> None:
    own, *_ = family_ids()
    install(site, "other", "raise OSError('loaded')", f"{own} = other:REGISTRATION")
    done = program(site, "new", own, tmp_path / "own.amp")
    assert (done.returncode, done.stderr) == (0, "")
