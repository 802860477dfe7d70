"""A long program is planned a stretch of rows at a time, which changes no figure and needs no more memory."""

import random
import re
import tracemalloc
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from amp_studio.files import ParameterFile, SaveError
from amp_studio.programs import ToolPath, path_letters, read_program
from amp_studio.programs.source import ProgramLines
from amp_studio.sim import ProgramJob, ProgramRun, moment_at, path_picture, program_csv, program_summary
from amp_studio.sim.path.geometry import geometry_of
from amp_studio.sim.path.kept_columns import KeptColumns
from amp_studio.sim.path.planner import ProgramPlan
from amp_studio.sim.path.result import line_columns
from amp_studio.sim.path.summing import rows_of
from amp_studio.sim.path_rules import Geometry, Indices, row_sums
from tests.programs.test_block import example

ZERO = dict.fromkeys("XYZ", 0.0)
ARCS = ("G2 X{x:.3f} Y{y:.3f} I{i:.3f} J0", "G3 X{x:.3f} Y{y:.3f} I{i:.3f} J0")
KINDS = {
    "grblhal-router": ("", ("G4 P0.2", *ARCS)),
    "acromill-router": ("G62", ("G4 F0.2", "G1 G9 X{x:.3f}", "G1 G61 Y{y:.3f}", "G1 G62 X{x:.3f}", *ARCS)),
    "linuxcnc-mill": (
        "G64 P0.2",
        ("G4 P0.2", "G1 G61 X{x:.3f}", "G1 G64 P0.5 Q0 Y{y:.3f}", "G1 G64 X{x:.3f}"),
    ),
    "mill-1394": ("", ("G1 G61 X{x:.3f}", "G1 G64 Y{y:.3f}")),
    "num-1060-mill": ("", ("G1 G9 X{x:.3f}",)),
}
"""Example -> codes of its first block, and blocks beside straight moves."""


def program_of(name: str, seed: int, count: int) -> list[str]:
    """Return a program of one kind: short and long moves, rapids, dwells, stops, full circles."""
    chance, (codes, others) = random.Random(seed), KINDS[name]
    lines, x, y = [f"{codes} G1 X-30 Y-30 Z-5 F1500"], -30.0, -30.0
    for _ in range(count):
        step = chance.choice((0.05, 0.6, 9.0))
        kind = chance.choice(
            (*["G1 X{x:.3f} Y{y:.3f}"] * 8, "G0 X{x:.3f} Y{y:.3f}", "F900 G1 Z-6 Y{y:.3f}", *others)
        )
        if kind not in ARCS:  # those end where they begin
            x += chance.uniform(-step, step)
            y += chance.uniform(-step, step)
        lines.append(kind.format(x=x, y=y, i=chance.uniform(1.0, 9.0)))
        if "X{x" not in kind or "Y{y" not in kind:
            lines.append(f"G1 X{x:.3f} Y{y:.3f}")
    return lines


def planned_by(stretch: int, patch: pytest.MonkeyPatch, file: ParameterFile, lines: list[str]) -> ProgramRun:
    patch.setattr("amp_studio.sim.path.stretches.STRETCH", stretch)
    patch.setattr("amp_studio.sim.path.job.STRETCH", stretch)
    return ProgramJob(lines, [-1.0] * len(path_letters(file)), ZERO, with_contour=False).run(file)


@pytest.mark.parametrize(
    ("name", "stretch"), [*((name, 17) for name in KINDS if name != "grblhal-router"), ("grblhal-router", 60)]
)
def test_stretches_change_no_figure(name: str, stretch: int, monkeypatch: pytest.MonkeyPatch) -> None:
    file, lines = example(name), program_of(name, stretch, 60)
    whole = planned_by(50_000, monkeypatch, file, lines)
    parts = planned_by(stretch, monkeypatch, file, lines)
    assert len(whole.plan) == 1
    assert len(parts.plan) > 2
    assert whole.plan.path.fault is None
    assert parts.plan.time == pytest.approx(whole.plan.time, rel=1e-11)
    assert parts.plan.moves == whole.plan.moves
    for one, other in zip(whole.plan.time_by_cause, parts.plan.time_by_cause, strict=True):
        assert other == pytest.approx(one, rel=1e-9, abs=1e-9)
    for column in ("entry", "peak", "leave", "start", "rest", "lines"):
        joined = np.concatenate([getattr(each, column) for each in parts.plan])
        assert joined == pytest.approx(getattr(whole.plan.whole, column), rel=1e-9, abs=1e-8)
    assert [(each.line, each.message) for each in parts.alarms] == [
        (each.line, each.message) for each in whole.alarms
    ]
    assert parts.assumptions == whole.assumptions
    (one, one_time), (other, other_time) = (line_columns(run, 40) for run in (whole, parts))
    assert other.tolist() == one.tolist()
    assert other_time == pytest.approx(one_time, rel=1e-9, abs=1e-9)
    begins, others = ([run.plan.listed.begin(n) or -1.0 for n in range(40)] for run in (whole, parts))
    assert others == pytest.approx(begins, rel=1e-9)
    assert [*program_summary(file, parts)["blocks"]] == [*program_summary(file, whole)["blocks"]]
    assert len("".join(program_csv(file, parts)).splitlines()) == whole.plan.whole.entry.size + 1
    for share in (0.0, 0.3, 0.77, 1.0):
        one, other = (moment_at(run.plan, share * whole.plan.time) for run in (whole, parts))
        assert one is not None
        assert other is not None
        assert other.place.tolist() == pytest.approx(one.place.tolist(), abs=1e-6)


def test_rows_are_worked_out_twice_and_taken_where_they_are_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of arcs in pieces this was half of the time: on the way back, on that forward, and for all the rest;
    and all rows were taken for a picture that draws a few.
    """
    counted, taken = list[int](), list[int]()

    def geometry(path: ToolPath, chord: float | None) -> Geometry:
        found = geometry_of(path, chord)
        counted.append(len(found.length))
        return found

    def rows(plan: ProgramPlan, chosen: Indices) -> ProgramPlan:
        taken.append(len(chosen))
        return rows_of(plan, chosen)

    monkeypatch.setattr("amp_studio.sim.path.planner.geometry_of", geometry)
    monkeypatch.setattr("amp_studio.sim.path.summing.rows_of", rows)
    monkeypatch.setattr("amp_studio.sim.path.summing.SAMPLE", 50)
    lines = ["G1 X0 Y0 F900", *(["G2 X0 Y0 I5 J0"] * 20)]
    run = planned_by(200, monkeypatch, example("grblhal-router"), lines)
    assert len(run.plan) > 4
    # Each stretch has the last row of the one before it too, an arc of a hundred pieces.
    assert sum(counted) < 2.0 * (run.plan.rows + 110 * len(run.plan))
    assert max(taken) <= 51


def test_a_sum_of_each_row_is_that_of_numpy() -> None:
    chance = np.random.default_rng(1)
    for columns in range(1, 8):
        values = chance.standard_normal((500, columns)) * 10.0 ** chance.integers(-6, 6, (500, columns))
        assert (row_sums(values) == values.sum(axis=1)).all()


def test_a_zone_that_is_on_in_several_stretches_guards_what_it_did_when_it_was_switched_on(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Page 6-5: zone 3 keeps the axes in where they are in it when it is switched on, and out otherwise."""
    file = example("mill-1394")
    lines = ["G21", "G23|G22", *(f"G00 X-{300 + n}." for n in range(1, 80))]
    lines = [part for line in lines for part in line.split("|")]
    whole = planned_by(50_000, monkeypatch, file, lines)
    parts = planned_by(6, monkeypatch, file, lines)
    assert [(each.line, each.message) for each in parts.alarms] == [
        (each.line, each.message) for each in whole.alarms
    ]


def peak_of(file: ParameterFile, path: Path, blocks: int) -> int:
    """Return the greatest memory in bytes of a run over so many blocks."""
    path.write_text("G1 X-9 F900\n" + "".join(f"X-{n % 60}.5 Y-{n % 7}\n" for n in range(blocks)))
    tracemalloc.start()
    try:
        run = ProgramJob(read_program(path, file), [0.0] * 3, ZERO, with_contour=False).run(file)
        assert run.plan.path.blocks == blocks + 1
        path_picture(file, run)
        for _ in program_csv(file, run):
            pass
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("name", ["grblhal-router", "linuxcnc-mill"])
def test_memory_does_not_grow_with_a_program(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for place in ("stretches.STRETCH", "job.STRETCH", "summing.SAMPLE"):
        monkeypatch.setattr(f"amp_studio.sim.path.{place}", 500)
    monkeypatch.setattr("amp_studio.sim.path.summing.PARTS", 20)
    monkeypatch.setattr("amp_studio.programs.source.IN_MEMORY", 4096)
    file = example(name)
    peak_of(file, tmp_path / "a.nc", 100)
    short, long = (peak_of(file, tmp_path / "a.nc", blocks) for blocks in (1500, 5000))
    # 3500 rows in memory have more than 1 MB.
    assert long - short < 500_000


def test_the_lines_of_a_program_are_those_of_a_list(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("amp_studio.programs.source.IN_MEMORY", 64)
    texts = [f"N{n} X{n * 7 % 13}" for n in range(1300)]
    lines = ProgramLines(texts)
    assert len(lines) == 1300
    assert [*lines] == texts
    assert lines[:3] == texts[:3]
    assert [lines[n] for n in (0, 1299, 511, 512, -1, 3)] == [texts[n] for n in (0, 1299, 511, 512, -1, 3)]
    with pytest.raises(IndexError):
        lines[1300]


@pytest.fixture
def small_disk() -> Iterator[None]:
    resource = pytest.importorskip("resource")
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, hard))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


@pytest.mark.usefixtures("small_disk")
def test_a_full_folder_for_temporary_files_is_named_and_not_the_results() -> None:
    """The error of a file without a name was taken for one of standard output."""
    full = re.escape("the folder for temporary files takes no more: File too large")
    with pytest.raises(SaveError, match=full):
        ProgramLines("G1 X1 F100" for _ in range(30_000))
    kept = KeptColumns()
    kept.add([np.zeros(10_000)])
    with pytest.raises(SaveError, match=full):
        kept.add([np.zeros(10_000)])
