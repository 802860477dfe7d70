"""The machine in a frequency response: plants that scipy made, not the simulator, and what is refused."""

import json
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from amp_studio import cli
from amp_studio.files import open_file
from amp_studio.sim import SimulationError, identify_response, machine_settings, simulate
from amp_studio.sim.identification.machine_file import machine_for, machine_text, read_machine
from amp_studio.sim.identification.plant_fit import _Shape, fit_plant
from amp_studio.sim.identification.response import coherent, response_of_text
from tests.campaigns import CAMPAIGN

MILL = Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"
FREQUENCIES = np.geomspace(2.0, 400.0, 100 if CAMPAIGN else 30)
TOLERANCE = 0.03


def hidden_plant(seed: int) -> tuple[dict[str, float], np.ndarray, str]:
    """Return the figures of a machine and its response, by scipy's state space of two masses (or one)
    and a delay.
    """
    from scipy import signal

    dice = np.random.default_rng(seed)
    size, delay = math.exp(dice.uniform(1.5, 8.0)), dice.uniform(0.5e-3, 4e-3)
    friction = dice.uniform(2.0, 6.0) * 2.0 * math.pi / size
    figures = {"acceleration_per_output": size, "viscous_friction": friction, "delay": delay}
    a, b = np.array([[-size * friction]]), np.array([[size]])
    if seed % 3:
        ratio, resonance, damping = dice.uniform(0.4, 3.0), dice.uniform(40.0, 150.0), dice.uniform(0.01, 0.1)
        figures |= {"resonance": resonance, "inertia_ratio": ratio}
        motor, load = size * (1.0 + ratio), size * (1.0 + ratio) / ratio
        stiffness = (2.0 * math.pi * resonance) ** 2 / (motor + load)
        slip = 2.0 * damping * 2.0 * math.pi * resonance / (motor + load)
        a = np.array(
            [
                [-motor * (slip + friction / (1.0 + ratio)), motor * slip, -motor * stiffness],
                [load * slip, -load * (slip + friction * ratio / (1.0 + ratio)), load * stiffness],
                [1.0, -1.0, 0.0],
            ]
        )
        b = np.array([[motor], [0.0], [0.0]])
    quantity = ("position", "velocity")[seed % 2]
    c, omega = np.eye(len(a))[:1], 2.0 * math.pi * FREQUENCIES
    _, response = signal.StateSpace(a, b, c, [[0.0]]).freqresp(omega)
    noise = 0.01 * (dice.standard_normal(len(omega)) + 1j * dice.standard_normal(len(omega)))
    response = response * np.exp(-1j * omega * delay + noise)
    return figures, response / (1j * omega) if quantity == "position" else response, quantity


@pytest.mark.parametrize("seed", range(4 if CAMPAIGN else 1))
def test_a_hidden_plant_is_found_within_three_percent(seed: int) -> None:
    figures, response, quantity = hidden_plant(seed)
    # One mass fits either quantity nearly as well, which takes the longest to find out.
    known = None if CAMPAIGN or seed % 3 else quantity
    found = fit_plant(coherent(FREQUENCIES, response, None), known)
    assert found.quantity == quantity
    for name, value in figures.items():
        there, error = found.figures[name]
        allowed = 4.0 * error / value if name == "viscous_friction" else 0.0
        assert there == pytest.approx(value, rel=max(TOLERANCE, allowed)), name


def table(frequency: np.ndarray, response: np.ndarray, coherence: float | None = None) -> str:
    head = "frequency_hz,gain_db,phase_deg" + (",coherence" if coherence is not None else "")
    gain, phase = 20.0 * np.log10(np.abs(response)), np.degrees(np.angle(response))
    last = "" if coherence is None else f",{coherence}"
    rows = [
        f"{f!r},{g!r},{p!r}{last}"
        for f, g, p in zip(*map(np.ndarray.tolist, (frequency, gain, phase)), strict=True)
    ]
    return "\n".join([head, *rows]) + "\n"


def test_a_response_becomes_the_machine_that_everything_runs_on(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    figures, response, _ = hidden_plant(4)
    record, machine = tmp_path / "frf.csv", tmp_path / "machine.yaml"
    record.write_text(table(FREQUENCIES, response, 0.97))
    wanted = ["--frf", record, "--axis", "X", "--json", "-o", machine]
    assert cli.run(["simulate", str(MILL), "identify", *map(str, wanted)]) == 0
    result = json.loads(capsys.readouterr().out)["result"]
    assert result["acceleration_per_output"]["value"] == pytest.approx(
        figures["acceleration_per_output"], rel=TOLERANCE
    )
    assert result["resonance"]["value"] == pytest.approx(figures["resonance"], rel=TOLERANCE)
    assert result["delay"]["value"] == pytest.approx(1e3 * figures["delay"], rel=TOLERANCE)
    assert 0.0 < result["delay"]["uncertainty"] < 0.1
    file = open_file(MILL).file
    axis, settings = machine_for(file, read_machine(machine), None)
    assert {"model.resonance", "model.inertia_ratio", "model.delay", "model.damping"} <= settings.keys()
    assert simulate(file, "frequency", axis, {**settings, "move.points": 2}, advise=False).result["Ms"]


def test_a_resonance_has_its_notch_and_the_picture_both_curves(tmp_path: Path) -> None:
    figures, response, _ = hidden_plant(4)
    record = tmp_path / "frf.csv"
    record.write_text(table(FREQUENCIES, response))
    trace = identify_response(open_file(MILL).file, record, "1")
    (notch,) = trace.recommendations
    assert notch.value == pytest.approx(figures["resonance"], rel=TOLERANCE)
    assert "model.delay: " in machine_text(trace, "9pc").replace("  delay", "model.delay")
    assert machine_settings(trace)["model.resonance"].endswith("Hz")


def test_a_chirp_is_answered_by_h1_within_three_percent(tmp_path: Path) -> None:
    from scipy import signal

    period, size, ratio, resonance = 0.5e-3, 90.0, 1.5, 70.0
    time = np.arange(0.0, 10.0, period)
    torque = 20.0 * signal.chirp(time, 2.0, 10.0, 300.0, method="logarithmic")
    motor, load = size * (1.0 + ratio), size * (1.0 + ratio) / ratio
    stiffness = (2.0 * math.pi * resonance) ** 2 / (motor + load)
    slip = 0.06 * 2.0 * math.pi * resonance / (motor + load)
    a = [
        [-motor * slip, motor * slip, -motor * stiffness],
        [load * slip, -load * slip, load * stiffness],
        [1.0, -1.0, 0.0],
    ]
    _, velocity, _ = signal.lsim(
        signal.StateSpace(a, [[motor], [0.0], [0.0]], [[1.0, 0.0, 0.0]], [[0.0]]), torque, time
    )
    noise = np.random.default_rng(3).standard_normal(len(time)) * 0.02
    record = tmp_path / "chirp.csv"
    rows = [
        f"{t!r},{v!r},{u!r}"
        for t, v, u in zip(time.tolist(), (velocity + noise).tolist(), torque.tolist(), strict=True)
    ]
    record.write_text("\n".join(["time (s),velocity (mm/s),torque (%)", *rows]))
    result = identify_response(open_file(MILL).file, record, "1").result
    assert result["acceleration_per_output"][0] == pytest.approx(size, rel=TOLERANCE)
    assert result["resonance"][0] == pytest.approx(resonance, rel=TOLERANCE)
    assert result["inertia_ratio"][0] == pytest.approx(ratio, rel=TOLERANCE)


def test_dry_friction_in_a_chirp_is_a_doubt_on_friction_and_acceleration(tmp_path: Path) -> None:
    """Velocity by Euler's steps: with 3 % of dry friction the viscous one was 1.28 ± 0.03 %, and is 0.4 %."""
    period, size, viscous, coulomb = 0.5e-3, 40.0, 0.024, 3.0
    time = np.arange(0.0, 8.0, period)
    torque = 25.0 * np.sin(2.0 * math.pi * 2.0 * 8.0 / math.log(150.0) * (150.0 ** (time / 8.0) - 1.0))
    speed = np.zeros_like(time)
    for n in range(len(time) - 1):
        dry = coulomb * math.tanh(speed[n] / 0.2)
        speed[n + 1] = speed[n] + period * size * (torque[n] - viscous * speed[n] - dry)
    record = tmp_path / "chirp.csv"
    rows = zip(time.tolist(), speed.tolist(), torque.tolist(), strict=True)
    heads = "time (s),velocity (mm/s),torque (%)"
    record.write_text("\n".join([heads, *(",".join(map(repr, row)) for row in rows)]))
    trace = identify_response(open_file(MILL).file, record, "1")
    assert trace.result["viscous_friction"][0] > 1.5 * viscous * 1000.0 / 60.0
    assert any("have the dry friction in them" in doubt for doubt in trace.doubts)


def test_two_resonances_are_a_velocity_and_nothing_else() -> None:
    """A position with a third pair that creeps fitted as well, and the velocity was called doubtful."""
    frequency = np.geomspace(2.0, 400.0, 90)
    s, dice = 2j * math.pi * frequency, np.random.default_rng(5)
    response = 27.8 / (s + 0.67) * np.exp(-0.0021 * s)
    for before, at, damping in ((62.0, 84.0, 0.03), (140.0, 171.0, 0.022)):
        zero, pole = 2.0 * math.pi * before, 2.0 * math.pi * at
        response *= (s * s / zero**2 + 2.0 * damping * s / zero + 1.0) / (
            s * s / pole**2 + 2.0 * damping * s / pole + 1.0
        )
    noise = 0.01 * (dice.standard_normal(90) + 1j * dice.standard_normal(90))
    found = fit_plant(coherent(frequency, response * np.exp(noise), None), None)
    assert (found.quantity, found.sure) == ("velocity", True)
    assert [pair.resonance for pair in found.pairs] == pytest.approx([84.0, 171.0], rel=TOLERANCE)
    assert found.figures["acceleration_per_output"][0] == pytest.approx(27.8, rel=TOLERANCE)


@pytest.mark.parametrize(
    ("heads", "columns"),
    [
        (
            "frequency_hz,gain_db,phase_deg",
            lambda f, h: (f, 20.0 * np.log10(abs(h)), np.degrees(np.angle(h))),
        ),
        ("omega (rad/s),gain_abs,phase_rad", lambda f, h: (2.0 * math.pi * f, abs(h), np.angle(h))),
        (
            "frequency [kHz],magnitude [(mm/s)/%],Phase [°]",
            lambda f, h: (f / 1e3, abs(h), np.degrees(np.angle(h))),
        ),
        ("freq,real,imag", lambda f, h: (f, h.real, h.imag)),
        (
            "Frequenz (1/s),Betrag (abs),Winkel (Grad)",
            lambda f, h: (2.0 * math.pi * f, abs(h), np.degrees(np.angle(h))),
        ),
    ],
)
def test_a_response_is_read_in_the_units_of_its_heads(
    heads: str, columns: Callable[..., tuple[np.ndarray, ...]]
) -> None:
    _, response, _ = hidden_plant(1)
    rows = zip(*(each.tolist() for each in columns(FREQUENCIES, response)), strict=True)
    found = response_of_text("\n".join([heads, *(",".join(map(repr, row)) for row in rows)]))
    assert found.frequency == pytest.approx(FREQUENCIES, rel=1e-9)
    assert found.response == pytest.approx(response, rel=1e-9)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a,b,c\n1,2,3\n", "No line has the heads"),
        ("frequency_hz,gain_db,phase_deg\n1,2,3\n", "too few"),
        ("frequency_hz,gain_db,phase_deg\n0,2,3\n", "above 0 Hz"),
        ("frequency_hz,gain_db,phase_deg\n1,x,3\n", "is no number"),
        (table(FREQUENCIES, 1.0 / FREQUENCIES + 0j, 0.7), "coherence is below 0.8"),
        (table(FREQUENCIES, 1.0 / FREQUENCIES + 0j, 1.7), "between 0 and 1"),
        ("frequency_hz,gain,phase_deg\n1,2,-90\n", "gain_db or gain_abs"),
        ("frequency_hz,gain_db,phase\n1,2,-1.6\n", "phase_deg or phase_rad"),
        ("frequency (rpm),gain_db,phase_deg\n1,2,-90\n", "rpm of the frequency is not known"),
    ],
)
def test_what_is_no_response_is_one_sentence(text: str, message: str) -> None:
    with pytest.raises(SimulationError, match=message):
        response_of_text(text)


@pytest.mark.parametrize("at_load", [False, True])
def test_the_slopes_of_the_fit_are_those_of_its_model(at_load: bool) -> None:
    """The formula of each slope against differences of the logarithm, with two pairs."""
    shape = _Shape("velocity", at_load, 2)
    s = 2j * np.pi * np.geomspace(3.0, 300.0, 40)
    there = np.array([4.0, 0.3, 1.5, 5.0, 0.2, -3.0, -3.5, 6.2, -0.4, -2.5, -3.0])
    found = shape.slopes(there, s)
    for n, row in enumerate(found):
        aside = np.zeros_like(there)
        aside[n] = 1e-5
        more, less = shape.response(there + aside, s), shape.response(there - aside, s)
        assert row == pytest.approx(np.log(more / less) / 2e-5, rel=1e-5, abs=1e-7)
