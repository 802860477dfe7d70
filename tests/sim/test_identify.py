"""From a record to the machine of an axis, and back:
what the simulator was given is what its trace is identified as.
"""

from pathlib import Path

import numpy as np
import pytest

from amp_studio.files import new_file, open_file
from amp_studio.sim import (
    SimulationError,
    identified_text,
    identify,
    machine_for,
    machine_settings,
    plot_svg,
    read_machine,
    simulate,
    write_machine,
)
from amp_studio.sim.write import trace_csv

EXAMPLES = Path(__file__).parents[2] / "examples"
MILL = open_file(EXAMPLES / "mill-1394/MILL_1394.amp").file
GIVEN = {"model.viscous_friction": 0.4, "model.coulomb_friction": 3.0, "model.gravity": 2.0}


@pytest.fixture(scope="module")
def record(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the trace of a homing: fast onto the switch, slowly off it."""
    path = tmp_path_factory.mktemp("record") / "home.csv"
    path.write_text(trace_csv(simulate(MILL, "home", "1", GIVEN)))
    return path


def test_the_machine_that_the_simulator_moved_is_found_in_its_trace(record: Path) -> None:
    found = identify(MILL, record, "1")
    value = {name: figure[0] for name, figure in found.result.items()}
    assert value["acceleration_per_output"] == pytest.approx(27.7764, rel=1e-3)
    assert value["viscous_friction"] == pytest.approx(0.4, rel=0.01)
    assert value["coulomb_friction"] == pytest.approx(3.0, rel=0.001)
    assert value["gravity"] == pytest.approx(2.0, rel=0.001)
    assert (value["torque_forward"], value["torque_backward"]) == (
        pytest.approx(5.0, rel=0.001),
        pytest.approx(-1.0, rel=0.001),
    )
    assert found.result["r_squared"] == (pytest.approx(1.0, abs=1e-4), "")
    assert not found.doubts


def test_an_axis_without_friction_has_none(tmp_path: Path) -> None:
    path = tmp_path / "home.csv"
    path.write_text(trace_csv(simulate(MILL, "home", "1")))
    value = {name: figure[0] for name, figure in identify(MILL, path, "1").result.items()}
    assert [value[name] for name in ("viscous_friction", "coulomb_friction", "gravity")] == pytest.approx(
        [0, 0, 0], abs=1e-3
    )


def test_a_file_in_inches_gets_its_figures_in_inches(record: Path) -> None:
    assert machine_settings(identify(MILL, record, "1", system="inch"))[
        "model.acceleration_per_output"
    ].endswith(" in/s2")


def test_what_was_written_moves_the_axis_as_before(record: Path, tmp_path: Path) -> None:
    found = identify(MILL, record, "1")
    path = tmp_path / "machine.yaml"
    write_machine(found, "9pc", path)
    axis, settings = machine_for(MILL, read_machine(path), None)
    assert (axis, settings) == ("1", machine_settings(found))
    expected = simulate(MILL, "step", "1", GIVEN).result["peak_torque"][0]
    assert simulate(MILL, "step", axis, settings).result["peak_torque"][0] == pytest.approx(
        expected, rel=1e-3
    )


def test_a_machine_in_inches_is_the_same_machine(record: Path, tmp_path: Path) -> None:
    write_machine(identify(MILL, record, "1", system="inch"), "9pc", tmp_path / "inch.yaml")
    _, settings = machine_for(MILL, read_machine(tmp_path / "inch.yaml"), "1")
    trace = simulate(MILL, "step", "1", settings)
    assert trace.result["peak_torque"][0] == pytest.approx(
        simulate(MILL, "step", "1", GIVEN).result["peak_torque"][0], rel=1e-3
    )


def test_an_axis_that_turns_has_its_acceleration_in_degrees(tmp_path: Path) -> None:
    (tmp_path / "b.yaml").write_text(
        "family: 9pc\naxis: B\ntorque: '%'\nmodel: {acceleration_per_output: 30 deg/s2}\n"
    )
    axis, settings = machine_for(MILL, read_machine(tmp_path / "b.yaml"), None)
    assert not [
        text
        for text in simulate(MILL, "step", axis, settings, advise=False).assumptions
        if "acceleration_per_output" in text
    ]


def test_a_table_that_begins_again_after_a_turn_is_followed(tmp_path: Path) -> None:
    time = np.arange(0.0, 12.0, 0.005)
    angle, speed = 900.0 * np.sin(0.9 * time), 810.0 * np.cos(0.9 * time)
    torque = -0.02 * 729.0 * np.sin(0.9 * time) + 0.003 * speed + 2.0 * np.sign(speed)
    rows = zip(time, angle % 360.0, torque, strict=True)
    path = tmp_path / "table.csv"
    path.write_text(
        "time (s),position (deg),torque (%)\n" + "".join(f"{t:.3f},{a:.3f},{u:.2f}\n" for t, a, u in rows)
    )
    found = identify(MILL, path, "4").result
    assert found["acceleration_per_output"] == (pytest.approx(50.0, rel=0.01), "deg/s2")
    assert found["coulomb_friction"][0] == pytest.approx(2.0, rel=0.02)


def test_the_picture_has_measured_and_predicted_torque(record: Path) -> None:
    picture = plot_svg(identify(MILL, record, "1"))
    for words in ("measured", "predicted", "measured less predicted, where used (%)", "r² 1", "gravity 2 %"):
        assert f">{words}<" in picture or words in picture


def test_the_figures_are_reported_with_their_standard_errors(record: Path) -> None:
    text = identified_text(identify(MILL, record, "1"))
    assert "identify, axis 1 (X): home.csv: " in text
    assert " ± " in text.splitlines()[1]
    assert "mm/s2 for 1 %" in text
    assert "The dry friction is taken as equal in both directions" in text


# -- what does not fit


def test_a_torque_in_amperes_needs_its_scale(record: Path, tmp_path: Path) -> None:
    head, *rows = record.read_text().splitlines()
    path = tmp_path / "amperes.csv"
    columns = [head.split(",").index(name) for name in ("time_s", "velocity [mm/min]", "torque [%]")]
    cells = [[row.split(",")[n] for n in columns] for row in rows[::4]]
    path.write_text(
        "time (s),velocity (mm/min),current (A)\n"
        + "".join(f"{t},{v},{0.05 * float(i)}\n" for t, v, i in cells)
    )
    with pytest.raises(
        SimulationError, match=r"in A, that of axis 1 in %: give how much is 1 %, as '0\.056 A'"
    ):
        identify(MILL, path, "1")
    with pytest.raises(SimulationError, match="The scale is in Nm, and the torque of the record in A"):
        identify(MILL, path, "1", "0.05 Nm")
    found = identify(MILL, path, "1", "50 mA")
    assert found.result["coulomb_friction"][0] == pytest.approx(3.0, rel=0.01)


def test_a_record_of_a_slide_is_none_of_a_rotary_axis(record: Path) -> None:
    with pytest.raises(SimulationError, match="the axis moves in deg"):
        identify(MILL, record, "4")


def test_a_family_without_a_law_shows_it(record: Path) -> None:
    with pytest.raises(SimulationError, match="stepper motors"):
        identify(new_file("grblhal"), record)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            "family: acromill\naxis: X\ntorque: V\nmodel: {gravity: 1}\n",
            "is of family acromill, and the file of 9pc",
        ),
        (
            "family: 9pc\naxis: X\ntorque: V\nmodel: {gravity: 1}\n",
            "has torques in V, and axis X has them in %",
        ),
        ("family: 9pc\naxis: Q\ntorque: '%'\nmodel: {gravity: 1}\n", "Axis Q is not fitted"),
        ("family: 9pc\naxis: X\ntorque: '%'\n", "describes no machine: it has no 'model'"),
        ("[1, 2]", "describes no machine"),
        ("family: 9pc\naxis: X\ntorque: '%'\nmodel: {}\nmachine: 5\n", "'machine' is no entry of a machine"),
        ("family: 9pc\naxis: [X]\ntorque: '%'\nmodel: {}\n", "'axis' must be a number or a short text"),
        (
            "family: 9pc\naxis: X\ntorque: '%'\nmodel: {gravity: true}\n",
            "'gravity' must be a number or a short text",
        ),
        ("family: 9pc\naxis: X: Y\n", "line 2"),
    ],
)
def test_a_machine_that_does_not_fit_is_refused(text: str, words: str, tmp_path: Path) -> None:
    path = tmp_path / "machine.yaml"
    path.write_text(text)
    with pytest.raises(SimulationError) as caught:
        machine_for(MILL, read_machine(path), None)
    assert words in str(caught.value)


def test_a_machine_of_another_axis_is_refused(record: Path, tmp_path: Path) -> None:
    write_machine(identify(MILL, record, "1"), "9pc", tmp_path / "x.yaml")
    with pytest.raises(SimulationError, match=r"x\.yaml is of axis X, not of Y: identify that axis too"):
        machine_for(MILL, read_machine(tmp_path / "x.yaml"), "2")


def test_an_unknown_figure_is_refused_when_it_is_used(tmp_path: Path) -> None:
    path = tmp_path / "machine.yaml"
    path.write_text("family: 9pc\naxis: X\ntorque: '%'\nmodel: {gravty: 1}\n")
    axis, settings = machine_for(MILL, read_machine(path), None)
    with pytest.raises(SimulationError, match=r"model\.gravty is not used"):
        simulate(MILL, "step", axis, settings)
