"""simulate identify: a record of a drive becomes the machine that the next simulation moves."""

import re
from pathlib import Path

import pytest

from amp_studio.files import open_file
from amp_studio.sim import simulate
from amp_studio.sim.write import trace_csv

MILL = Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"
GIVEN = (
    "--set",
    "model.viscous_friction=0.4",
    "--set",
    "model.coulomb_friction=3",
    "--set",
    "model.gravity=2",
)


@pytest.fixture(scope="module")
def homing() -> str:
    """Return the trace of a homing, fast onto the switch and slowly off it."""
    given = {text.partition("=")[0]: text.partition("=")[2] for text in GIVEN[1::2]}
    return trace_csv(simulate(open_file(MILL).file, "home", "1", given))


@pytest.fixture
def record(example: Path, homing: str) -> Path:
    path = example.with_name("record.csv")
    path.write_text(homing)
    return path


def test_the_machine_is_written_and_simulated_with(amp, example: Path, record: Path) -> None:
    machine = example.with_name("machine.yaml")
    message = amp("simulate", example, "identify", record, "--axis", "X", "-o", machine)
    assert message.code == 0
    assert re.search(r"Coulomb friction +3\.000", message.out)
    assert machine.read_text().startswith("# The machine of axis X")
    given = amp("simulate", example, "step", *GIVEN, "--json").json["result"]["peak_torque"]["value"]
    found = amp("simulate", example, "step", "--machine", machine, "--json").json["result"]["peak_torque"][
        "value"
    ]
    assert found == pytest.approx(given, rel=1e-3)
    lighter = amp(
        "simulate", example, "step", "--machine", machine, "--set", "model.gravity=0", "--json"
    ).json
    assert lighter["result"]["peak_torque"]["value"] == pytest.approx(given - 2.0, rel=0.01)
    assert example.read_bytes() == MILL.read_bytes()


def test_json_has_each_figure_its_standard_error_and_the_settings(amp, example: Path, record: Path) -> None:
    found = amp("simulate", example, "identify", record, "--axis", "X", "--json").json
    assert (found["scenario"], found["axis"], found["letter"]) == ("identify", "1", "X")
    assert found["result"]["gravity"] == {
        "value": pytest.approx(2.0, rel=1e-3),
        "unit": "%",
        "uncertainty": found["result"]["gravity_standard_error"]["value"],
    }
    assert found["result"]["gravity_standard_error"]["value"] < 0.001
    assert found["result"]["rows_used"]["value"] > 1000
    assert found["machine"].keys() == {
        f"model.{name}"
        for name in ("acceleration_per_output", "viscous_friction", "coulomb_friction", "gravity")
    }


@pytest.mark.parametrize(
    ("name", "begin"),
    [
        ("fit.svg", b"<svg"),
        ("fit.png", b"\x89PNG"),
        ("fit.csv", b"time_s,velocity [mm/min],torque [%],predicted_torque [%],residual [%]"),
    ],
)
def test_the_fit_is_a_picture_or_a_table(amp, example: Path, record: Path, name: str, begin: bytes) -> None:
    assert (
        amp("simulate", example, "identify", record, "--axis", "X", "-o", example.with_name(name)).code == 0
    )
    assert example.with_name(name).read_bytes().startswith(begin)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["identify"], "Name the record: amp-studio simulate "),
        (["identify", "gone.csv"], "No such file"),
        (
            ["identify", "record.csv", "--set", "model.gravity=1"],
            "identify takes neither --set nor --machine",
        ),
        (["identify", "record.csv", "--machine", "record.csv"], "identify takes neither --set nor --machine"),
        (["identify", "record.csv", "--axis", "B"], "the axis moves in deg"),
        (["identify", "record.csv", "-o", "fit.txt"], "unknown format of a trace"),
        (["identify", "record.csv", "-o", "record.csv"], "record.csv"),
        (["identify", "record.csv", "-o", "mill.amp"], "mill.amp"),
        (["identify", "mill.amp"], "mill.amp: No line names the columns"),
        (["step", "record.csv"], "a record and its scale belong to identify, not to step"),
        (["step", "--scale", "5 A"], "a record and its scale belong to identify, not to step"),
        (["step", "--machine", "mill.amp"], "describes no machine"),
        (["step", "--machine", "gone.yaml"], "gone.yaml"),
    ],
)
def test_what_cannot_be_used_is_reported_in_one_line_and_nothing_is_written(
    amp, example: Path, record: Path, monkeypatch: pytest.MonkeyPatch, arguments: list[str], words: str
) -> None:
    monkeypatch.chdir(example.parent)
    before = sorted(path.name for path in example.parent.iterdir()), record.read_bytes()
    message = amp("simulate", "mill.amp", *arguments)
    assert message.code == 2
    assert words in message.err
    assert len(message.err.splitlines()) == 1
    assert (sorted(path.name for path in example.parent.iterdir()), record.read_bytes()) == before


@pytest.mark.parametrize(
    "order", ["--axis X identify record.csv", "identify --axis X record.csv", "identify record.csv --axis X"]
)
def test_options_may_come_before_the_scenario_and_the_record(
    amp, example: Path, record: Path, monkeypatch: pytest.MonkeyPatch, order: str
) -> None:
    monkeypatch.chdir(example.parent)
    assert "axis 1 (X)" in amp("simulate", "mill.amp", *order.split()).out


def test_what_is_too_much_is_still_refused(amp, example: Path) -> None:
    message = amp("simulate", example, "--axis", "X", "step", "record.csv", "more.csv")
    assert (message.code, "Unexpected argument: more.csv" in message.err) == (2, True)


def test_the_list_names_it(amp, example: Path) -> None:
    assert "identify RECORD.csv: inertia, friction and weight" in amp("simulate", example, "--list").out
