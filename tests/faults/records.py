"""Damaged records of drives and descriptions of machines: each is refused in one line,
or gives finite figures.
"""

import json
import math
from dataclasses import asdict
from functools import cache
from pathlib import Path

import numpy as np

from amp_studio.files import TUNINGS, ParameterFile, ParameterFileError, open_file
from amp_studio.sim import SimulationError, machine_for, read_machine, simulate
from amp_studio.sim.identification.drive_record import drive_record_of, speed_factor
from amp_studio.sim.identification.friction import fit_friction
from amp_studio.sim.identification.recording import read_recording
from amp_studio.sim.identification.response import response_of_text
from amp_studio.sim.tuning.record import RecordedTuning, add_tuning, read_tunings
from amp_studio.sim.variations.job import SweepJob
from amp_studio.sim.variations.running import DoneChunks

from .texts import REPOSITORY, mutants, violations

MACHINES = (
    (
        "# machine\nfamily: 9pc\naxis: X\ntorque: '%'\nmodel:\n  acceleration_per_output: 41.5 mm/s2\n "
        " viscous_friction: '0.35'\n  coulomb_friction: 2\n  gravity: -0.1\nidentified:\n  record:"
        " drive.csv\n"
    ),
    "family: 9pc\naxis: '2'\ntorque: '%'\nmodel: {backlash: 0.01 mm, delay: 1.5, resonance: 60}\n",
)


def _record(head: str, separator: str, decimal: str) -> str:
    time = np.arange(0.0, 3.0, 0.02)
    velocity = 80.0 * np.sin(6.0 * time)
    torque = 9.6 * np.cos(6.0 * time) + 0.03 * velocity + 2.0 * np.sign(velocity) + 0.5
    rows = zip(time, velocity, torque, strict=True)
    return f"{head}\n" + "".join(
        separator.join(f"{n:.3f}" for n in row).replace(".", decimal) + "\n" for row in rows
    )


RECORDS = (
    _record("time (s),velocity (mm/s),torque (%)", ",", "."),
    "Drive 1\n" + _record("Zeit [s];Lage [mm];Strom [A]", ";", ","),
    _record("t\tv\ttorque\ns\tmm/min\t%", "\t", "."),
)


def fuzz_records(seed: int, count: int) -> list[str]:
    """Damage records; a fit that comes out is a number with a standard error."""

    def look(text: str) -> None:
        found = drive_record_of(text)
        factor = speed_factor(found, "mm")
        if found.velocity is not None:
            fit = fit_friction(found.time, found.torque, velocity=found.velocity * factor)
        else:
            assert found.position is not None
            fit = fit_friction(found.time, found.torque, position=found.position * factor)
        assert np.isfinite(fit.coefficients).all()
        assert np.isfinite(fit.covariance).all()
        assert math.isfinite(fit.r_squared)

    return violations(mutants(RECORDS, seed, count), look, (SimulationError,))


RESPONSES = (
    "frequency_hz,gain_db,phase_deg,coherence\n"
    + "".join(f"{n},{-20.0 - n},{-90.0 - n},0.9\n" for n in range(1, 40)),
    "Frequenz [Hz];Gain [dB];Phase [deg]\n" + "".join(f"{n},5;{-n},25;-90\n" for n in range(1, 30)),
)


def fuzz_responses(seed: int, count: int) -> list[str]:
    """Damage frequency responses; one that is taken has finite numbers only."""

    def look(text: str) -> None:
        found = response_of_text(text)
        assert np.isfinite(found.frequency).all()
        assert np.isfinite(found.response).all()
        assert np.isfinite(found.weights).all()

    return violations(mutants(RESPONSES, seed, count), look, (SimulationError,))


def fuzz_sweep_parts(folder: Path, seed: int, count: int) -> list[str]:
    """Damage what is kept of a stopped sweep: a part is used as it was written, or not at all."""
    job, points = SweepJob(b"", "1", (), (), (), motion=False, loops=True), np.zeros((4, 1))
    output, whole = folder / "map.csv", np.arange(14.0).reshape(2, 7)
    kept = DoneChunks.beside(output, job, points)
    kept.add(0, whole)
    kept.add(2, whole)
    path = output.with_name("map.csv.part")
    texts = (path.read_text(),)

    def look(text: str) -> None:
        path.write_bytes(text.encode("utf-8", "surrogatepass"))
        for start, part in DoneChunks.beside(output, job, points).done.items():
            assert start in (0, 2), start
            assert np.array_equal(part, whole)

    return violations(mutants(texts, seed, count), look, ())


@cache
def _mill() -> ParameterFile:
    return open_file(REPOSITORY / "examples/mill-1394/MILL_1394.amp").file


ADVISED = 100
"""Runs from which on gains are sought too, which takes a second a machine."""


def fuzz_machines(folder: Path, seed: int, count: int) -> list[str]:
    """Damage descriptions of machines, and move the axis with what is taken."""
    path = folder / "machine.yaml"

    def look(text: str) -> None:
        path.write_bytes(text.encode("utf-8", "surrogatepass"))
        axis, settings = machine_for(_mill(), read_machine(path), None)
        simulate(_mill(), "velocity", axis, {**settings, "move.duration": 0.02}, advise=count > ADVISED)

    return violations(mutants(MACHINES, seed, count), look, (SimulationError, ParameterFileError))


TUNING = RecordedTuning(
    when="2026-11-29T12:00:00Z",
    who="a fitter",
    file="x.amp",
    axis="1 (X)",
    aim="stiff",
    gains=(("1340@1", "Initial Gain of Position Loop", "1 1/s", "2 1/s"),),
    figures=(("Ms", 1.2, None, ""),),
    plant=(("inertia", "0.002 kg m2", "assumed"),),
)


def fuzz_tunings(folder: Path, seed: int, count: int) -> list[str]:
    """Damage a record of tunings and append one more to it, which is found; damage a recording of signals,
    which has finite numbers and a rising time where it is taken.
    """
    path, table = folder / "x.amp", folder / "recording.csv"
    path.write_bytes(b"")
    record = json.dumps(asdict(TUNING)) + "\n"
    signals = "time (s),position (mm),following error (mm)\n" + "".join(
        f"{n / 100},{n * 0.1},{0.01 * n}\n" for n in range(30)
    )

    def look(text: str) -> None:
        content = text.encode("utf-8", "surrogatepass")
        (folder / TUNINGS).write_bytes(content)
        add_tuning(path, TUNING)
        assert read_tunings(path)[-1] == TUNING
        table.write_bytes(content)
        found = read_recording(table)
        assert (np.diff(found.time) > 0).all()
        assert all(np.isfinite(each).all() for each in found.signals.values())

    figures = record.replace("1.2", "1" + "0" * 400)
    texts = [record, record + record, signals, figures, "[" * 200_000, '{"gains": ' * 100_000]
    return violations(mutants(texts, seed, count), look, (SimulationError,))
