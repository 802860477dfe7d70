"""A sixth family is facts, its own code and one record: every verb knows it,
and no generic module was touched.
"""

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.cli.candidates import families
from amp_studio.cli.completion import answer
from amp_studio.files import open_file
from amp_studio.schema.registration import register, unregister
from amp_studio.sim import simulate
from tests.families.steps.stepper import FAMILY, REGISTRATION, Driver

CONTROL = "tcp://bench:1"


@pytest.fixture(autouse=True)
def steps() -> Iterator[None]:
    register(REGISTRATION)
    yield
    unregister(FAMILY)
    Driver.BENCH.clear()


@pytest.fixture
def path(tmp_path: Path) -> Path:
    made = tmp_path / "steps.amp"
    assert run(["new", FAMILY, str(made)]) == 0
    assert run(["set", str(made), "10=50000 BLU", "20=60 mm"]) == 0
    return made


def test_it_is_listed_with_the_others(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["families", "--json"]) == 0
    listed = {each["id"]: each for each in json.loads(capsys.readouterr().out)["families"]}
    assert (listed[FAMILY]["name"], listed[FAMILY]["parameters"]) == ("Stepper control", 4)
    assert len(listed) > 5


def test_help_and_completion_name_it(capsys: pytest.CaptureFixture[str]) -> None:
    assert FAMILY in families()
    answer(["new", "st"], "")
    assert capsys.readouterr().out.split() == [FAMILY]


def test_its_rule_resolves_blu_through_the_increment_system(
    path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["validate", str(path)]) == 0, "50000 BLU are 50 mm under IS-B"
    assert run(["set", str(path), "10=70000 BLU"]) == 0
    capsys.readouterr()
    assert run(["validate", str(path), "--json"]) == 1
    found = json.loads(capsys.readouterr().out)["findings"]
    (finding,) = [each for each in found if each["severity"] == "error"]
    assert finding["rule"] == "steps.limit.guide"
    assert finding["message"] == "Stroke Limit 70000 BLU is 70 mm, and the guide has 60 mm."
    assert run(["set", str(path), "1=IS-C"]) == 0
    assert run(["validate", str(path)]) == 0, "70000 BLU are 7 mm under IS-C"


def test_what_one_blu_is_follows_from_the_increment_system_without_a_line_of_code(
    path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["set", str(path), "10=12.5 mm"]) == 0
    capsys.readouterr()
    assert run(["get", str(path), "10"]) == 0
    assert "12500 BLU = 12.5 mm" in capsys.readouterr().out
    assert run(["set", str(path), "1=IS-C"]) == 0
    capsys.readouterr()
    assert run(["get", str(path), "10", "--json"]) == 0
    (row,) = json.loads(capsys.readouterr().out)["values"]
    assert (row["value"], row["unit"], row["real"]) == (12500, "BLU", {"value": 1.25, "unit": "mm"})
    assert run(["set", str(path), "10=0.5 in"]) == 0
    assert open_file(path).file.values["axis.limit", "X"].value == 127000
    assert run(["set", str(path), "10=0.00005 mm"]) == 2
    assert "0.00005 mm is no whole number of BLU, each 0.0001 mm: Stroke Limit" in capsys.readouterr().err


def test_its_own_unit_is_entered_converted_and_checked_like_any_other(
    path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["set", str(path), "30=25400 steps/in"]) == 0, "that is 1000 steps/mm, the bound itself"
    assert open_file(path).file.evaluation.canonical(("axis.density", "X")) == 1000.0
    assert run(["set", str(path), "30=25400.1 steps/in"]) == 2
    assert "25400.1 steps/in is outside 25.4 to 25400 steps/in" in capsys.readouterr().err
    assert run(["set", str(path), "30=5 mm"]) == 2


def test_its_format_is_written_and_recognised(path: Path, tmp_path: Path) -> None:
    text, back = tmp_path / "steps.stp", tmp_path / "back.amp"
    assert run(["export", str(path), "-o", str(text)]) == 0
    assert text.read_text("utf-8") == "(STEPS)\nN1=IS-B\nN10=50000 BLU\nN20=60 mm\n"
    assert run(["import", str(text), "-o", str(back)]) == 0
    assert open_file(back).file.values == open_file(path).file.values


def test_it_is_exchanged_over_its_own_protocol(
    path: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    Driver.BENCH["bench"] = b"what nobody can read"
    assert run(["download", str(path), "--to", CONTROL]) == 0
    (kept,) = tmp_path.glob("steps.before-*.img")
    assert kept.read_bytes() == b"what nobody can read"
    assert run(["verify", str(path), "--with", CONTROL]) == 0
    capsys.readouterr()
    assert run(["identify", f"{CONTROL}?protocol=dnc", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["family"], found["protocol"], found["revision"], found["axes"]) == (
        FAMILY,
        "dnc",
        "7",
        ["X", "Y"],
    )
    assert run(["identify", CONTROL + "?protocol=dnc", "--family", "num"]) == 2, "num does not speak dnc"


def test_a_copy_of_what_it_kept_goes_back_only_where_the_control_can_report(
    path: Path, tmp_path: Path
) -> None:
    Driver.BENCH["bench"] = b"what nobody can read"
    assert run(["download", str(path), "--to", CONTROL]) == 0
    current = Driver.BENCH["bench"]
    (kept,) = tmp_path.glob("steps.before-*.img")
    assert run(["restore", str(kept), "--to", f"{CONTROL}?protocol=dnc"]) == 2
    assert Driver.BENCH["bench"] == current


def test_its_axis_moves_by_its_own_law(path: Path) -> None:
    settings = {"model.rapid": 6000.0, "move.distance": 5.0}
    trace = simulate(open_file(path).file, "step", "X", settings)
    assert trace.model.startswith("stepper axis")
    assert trace.result["distance"] == (5.0, "mm")


def test_no_family_is_loaded_before_it_is_asked_for() -> None:
    script = """
import sys
from amp_studio.schema import load_schema
from amp_studio.validate import Validator
from amp_studio.files import new_file
Validator(new_file("num")).run()
loaded = [name.split(".") for name in sys.modules if name.startswith("amp_studio.families.")]
print(sorted(parts[2] for parts in loaded if len(parts) == 3))
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "['num']"
