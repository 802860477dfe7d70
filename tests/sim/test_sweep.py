"""A sweep has the figures of single runs, whatever computes it, and goes on where it was stopped."""

import json
import os
import signal
import socket
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from amp_studio.drawing import scene_in_words
from amp_studio.files import ParameterFile, content_of, open_file
from amp_studio.report import language_of
from amp_studio.sim import SimulationError, SweepWay, simulate, sweep
from amp_studio.sim.axis.moves import move_of, until_of
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.law import AxisLaw, law_of
from amp_studio.sim.picture import plot_svg
from amp_studio.sim.sweep_picture import sweep_picture
from amp_studio.sim.variations.batch import FIGURES, run_batch
from amp_studio.sim.variations.composed import ComposedAxes, agrees
from amp_studio.sim.variations.job import Axes, SweepJob
from amp_studio.sim.variations.plan import points_of, read_varied
from amp_studio.sim.variations.worker import SweepWorker, WorkerEndedError
from amp_studio.sim.write import trace_summary, trace_text
from tests.campaigns import some

EXAMPLES = Path(__file__).parents[2] / "examples"
MOVE = {"move.distance": 2.0, "move.duration": 0.2}
MILL = "mill-1394/MILL_1394.amp"
AXES = (
    ("57c422b-label-press/LABEL_PRESS.amp", "X"),
    ("acromill-router/ROUTER.amp", "X"),
    ("lathe-ls176/LATHE_LS176.amp", "1"),
    (MILL, "3"),
    ("num-1060-mill/MILL_1060.amp", "0"),
    ("syntec-mill/SYNTEC_MILL.amp", "1"),
)
ALONE = SweepWay(cores=1)


def file_of(example: str) -> ParameterFile:
    return open_file(EXAMPLES / example).file


@pytest.mark.parametrize(("example", "axis"), some(AXES, 3))
def test_a_variation_has_the_figures_of_its_own_run(example: str, axis: str) -> None:
    file = file_of(example)
    over = {
        "sweep.over": "model.viscous_friction=0:0.4:2;model.delay=0.1:1.3:2",
        "sweep.figure": "settle_time",
    }
    trace = sweep(file, axis, {**over, **MOVE}, "metric", way=ALONE)
    for row in range(4):
        varied = {name: float(trace.columns[name][row]) for name in trace.over}
        single = simulate(file, "step", axis, {**varied, **trace.move, **MOVE}, "metric", advise=False).result
        for name in FIGURES[1:-1]:
            found = float(trace.columns[name][row])
            assert single[name][0] == (
                None if np.isnan(found) else pytest.approx(found, rel=1e-12, abs=1e-15)
            ), name


def test_parameters_are_varied_as_the_control_can_have_them() -> None:
    file = file_of(MILL)
    over = {"sweep.over": "1350@3=0.5:1.5:3;servo.velocity_proportional_gain=1000:2000:3"}
    trace = sweep(file, "3", {**over, "sweep.figure": "Ms"}, way=ALONE)
    assert trace.rows == 9
    assert trace.result["count"] == (9.0, "")
    assert set(trace.columns["sound"]) <= {0.0, 1.0}
    out_of_range = sweep(
        file, "3", {"sweep.over": "servo.initial_gain=1:1000:2", "sweep.figure": "Ms"}, way=ALONE
    )
    assert out_of_range.result["not_possible"][0] == 1.0


def test_the_map_without_a_word_shows_two_gains_their_safe_region_and_the_present_point(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("amp_studio.sim.variations.scenario.SIDE", 4)
    trace = sweep(file_of(MILL), "1", {}, way=ALONE)
    assert trace.over == ("servo.initial_gain", "servo.velocity_proportional_gain")
    safe = trace.columns["safe"] == 1.0
    assert 0 < safe.sum() < trace.rows
    assert (trace.columns["Ms"][safe] <= 1.6).all()
    summary = trace_summary(trace)
    assert summary["present"]["servo.velocity_proportional_gain"]["value"] == 6000.0
    best = summary["best"]["figures"]["stiffness"]["value"]
    assert best == min(trace.columns["stiffness"][safe]) == summary["result"]["best"]["value"]
    drawn = plot_svg(trace)
    assert "present" in drawn
    assert drawn.count("<rect") > trace.rows / 2
    assert "percentiles" in trace_text(trace)


def test_samples_are_those_of_their_seed_and_fill_their_distribution() -> None:
    file = file_of(MILL)
    varied = (
        read_varied(file, "1", "model.inertia_ratio=1:3"),
        read_varied(file, "1", "model.resonance=80+-4"),
    )
    points = points_of(varied, 1000, 7)
    assert np.array_equal(points, points_of(varied, 1000, 7))
    assert not np.array_equal(points, points_of(varied, 1000, 8))
    assert points[:, 0].mean() == pytest.approx(2.0, abs=2e-3)
    assert np.percentile(points[:, 1], 84.13) == pytest.approx(84.0, abs=0.1)
    assert sorted(np.floor((points[:, 0] - 1.0) * 500.0)) == list(range(1000))  # one in each part


@pytest.mark.parametrize(
    ("weight", "quantiles"),
    [
        ("10:30", {5: 11.0, 25: 15.0, 50: 20.0, 75: 25.0, 95: 29.0}),
        ("20+-2", {5: 16.710, 25: 18.651, 75: 21.349, 95: 23.290}),
    ],
)
def test_percentiles_of_an_uncertain_machine_are_those_by_hand(
    weight: str, quantiles: dict[int, float]
) -> None:
    """A weight is added to the torque of the ramp, as it is below its limit: the percentiles are those of the
    weight and the torque without it.
    """
    file, move = file_of(AXES[4][0]), {"move.distance": 10.0, "move.duration": 0.5}
    over = {"sweep.over": f"model.gravity={weight}", "sweep.samples": 400, "sweep.figure": "peak_torque"}
    trace = sweep(file, "0", {**over, **move}, way=ALONE)
    without = simulate(file, "step", "0", move, advise=False).result["peak_torque"][0]
    for part, by_hand in quantiles.items():
        assert trace.result[f"peak_torque_p{part}"] == (pytest.approx(without + by_hand, abs=0.5), "%"), part


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("servo.initial_gain", "does not say what is varied"),
        ("servo.initial_gain=1", "no range"),
        ("servo.initial_gain=2:1:5", "the first one must be the smaller"),
        ("servo.initial_gain=1:2", "no number of steps"),
        ("servo.initial_gain=1:2:1.5", "must be a whole number"),
        ("model.nonsense=1:2:3", "Unknown setting"),
        ("no.such=1:2:3", "no.such"),
        ("model.delay=1:2:3;model.delay=1:2:3", "varied twice"),
        ("model.delay=1+-2", "say how many"),
    ],
)
def test_what_cannot_be_varied_is_one_sentence(text: str, message: str) -> None:
    with pytest.raises(SimulationError, match=message):
        simulate(file_of(MILL), "sweep", "1", {"sweep.over": text})


class Stopped(Exception):
    """A person stops the sweep."""


@pytest.mark.parametrize(
    ("over", "reason"),
    [
        ("servo.initial_gain=0.5:1.5:100;model.inertia_ratio=0.5:2:100", "inertia_ratio divides an axis"),
        ("servo.initial_gain=100:200:90;model.delay=1:2:90", "Initial Gain of Position Loop 100 is outside"),
    ],
)
def test_a_sweep_of_which_nothing_is_possible_is_refused_before_it_begins(over: str, reason: str) -> None:
    """It computed all of them, counted to 100 %, and refused then."""
    seen: list[str] = []
    way = SweepWay(cores=1, progress=lambda stage, _done, _total: seen.append(stage))
    with pytest.raises(SimulationError, match=reason):
        sweep(file_of(MILL), "1", {"sweep.over": over}, "metric", way=way)
    assert seen == []


@pytest.mark.parametrize(
    ("over", "refused", "which", "reason"),
    [
        (
            "servo.initial_gain=-10:40:6;model.delay=1:2:3",
            9,
            "servo.initial_gain -10 … 0, servo.initial_gain 40",
            "Initial Gain of Position Loop -10 is outside 0 to 30",
        ),
        ("model.resonance=0:100:5;model.inertia_ratio=1:2:3", 3, "model.resonance 0", "one rigid mass"),
    ],
)
def test_a_sweep_names_how_many_of_it_are_refused_which_and_why(
    over: str, refused: int, which: str, reason: str
) -> None:
    trace = sweep(file_of(MILL), "1", {"sweep.over": over, "sweep.figure": "Ms"}, way=ALONE)
    assert trace.result["not_possible"] == (float(refused), "")
    first, *_ = trace.doubts
    assert first.startswith(f"{refused} of {trace.rows} variations are not possible ({which}): ")
    assert reason in first
    german = language_of("de", "9pc").sentence(first)
    assert german.startswith(
        f"{refused} von {trace.rows} Varianten sind nicht möglich ({which.replace('-', '−')}): "
    )
    assert " is " not in german


def test_a_variation_that_runs_away_is_possible_and_not_safe(monkeypatch: pytest.MonkeyPatch) -> None:
    """It was counted with those that the file refuses."""

    def runs_away(*_args: object) -> None:
        raise SimulationError("Axis 0 runs away: its loop is not stable")

    monkeypatch.setattr("amp_studio.sim.variations.batch.run_prepared", runs_away)
    given = {"sweep.over": "model.delay=1:2:2", "sweep.figure": "settle_time", **MOVE}
    trace = sweep(file_of("num-1060-mill/MILL_1060.amp"), "0", given, way=ALONE)
    assert (trace.result["not_possible"], trace.result["safe"]) == ((0.0, ""), (0.0, "%"))


def test_a_sweep_that_was_stopped_goes_on_with_what_it_has(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("amp_studio.sim.variations.running.AT_ONCE", 25)
    seen: list[int] = []

    def stop(_stage: str, done: int, _total: int) -> None:
        seen.append(done)
        if done >= 50:
            raise Stopped

    file, output = file_of("num-1060-mill/MILL_1060.amp"), tmp_path / "map.csv"
    given = {"sweep.over": "model.delay=1:3:90", "sweep.figure": "Ms"}
    with pytest.raises(Stopped):
        sweep(file, "0", given, way=SweepWay(cores=1, progress=stop, output=output))
    again: list[int] = []
    way = SweepWay(cores=1, progress=lambda _stage, done, _total: again.append(done), output=output)
    trace = sweep(file, "0", given, way=way)
    assert again[0] == seen[-1] == 50
    assert not list(tmp_path.iterdir())
    whole = sweep(file, "0", given, way=ALONE)
    assert np.array_equal(trace.columns["Ms"], whole.columns["Ms"])


def test_what_was_kept_of_another_sweep_or_is_damaged_is_not_used(tmp_path: Path) -> None:
    file, output = file_of("num-1060-mill/MILL_1060.amp"), tmp_path / "map.csv"
    given = {"sweep.over": "model.delay=1:3:4", "sweep.figure": "Ms"}
    for text in ("", "{", json.dumps({"sweep": "another"}) + "\n", "\x00\n\x00"):
        output.with_name("map.csv.part").write_text(text)
        seen: list[int] = []
        way = SweepWay(cores=1, progress=lambda _s, done, _t, seen=seen: seen.append(done), output=output)
        assert sweep(file, "0", given, way=way).rows == 4
        assert seen[0] == 0


@pytest.mark.parametrize("machine_code", [False, True])
def test_both_engines_have_equal_figures(machine_code: bool) -> None:
    law, file = law_of("9pc"), file_of(MILL)
    axis = bind_axis(file, law, "3", {"model.coulomb_friction": 2.0})
    moved = move_of(axis, {"move.distance": 1.0})
    runs = [(axis, moved.profile, until_of(axis, moved, 0.05), moved.distance, moved.share_rate)] * 2
    found = run_batch(runs, machine_code=machine_code)
    assert np.array_equal(found[0], found[1], equal_nan=True)
    assert np.array_equal(found, run_batch(runs, machine_code=False), equal_nan=True)


def test_a_scheduler_that_is_none_is_one_sentence() -> None:
    given = {"sweep.over": "model.delay=1:2:2", "sweep.figure": "Ms"}
    with pytest.raises(SimulationError, match="no address of a scheduler"):
        sweep(file_of(MILL), "1", given, way=SweepWay(scheduler="host"))


def test_a_cluster_computes_what_this_computer_does() -> None:
    """A scheduler and a worker of their own processes, by their address."""
    distributed = pytest.importorskip("distributed", reason="the extra 'cluster' is not installed")
    given = {"sweep.over": "model.delay=1:2:300", "sweep.figure": "Ms"}
    file = file_of("num-1060-mill/MILL_1060.amp")
    with distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster:
        there = sweep(file, "0", given, way=SweepWay(scheduler=cluster.scheduler_address))
    here = sweep(file, "0", given, way=ALONE)
    assert np.array_equal(there.columns["Ms"], here.columns["Ms"])


def test_a_cluster_whose_only_worker_is_killed_goes_on_when_it_is_there_again() -> None:
    """The job was data that the worker alone had: what was left could not be computed."""
    distributed = pytest.importorskip("distributed", reason="the extra 'cluster' is not installed")
    given = {"sweep.over": "model.delay=1:2:2000", "sweep.figure": "Ms"}
    file, killed = file_of("num-1060-mill/MILL_1060.amp"), []
    with distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster:

        def kill(_stage: str, done: int, _total: int) -> None:
            if done and not killed:
                killed.append(cluster.workers[0].process.pid)
                os.kill(killed[0], signal.SIGKILL)

        there = sweep(file, "0", given, way=SweepWay(scheduler=cluster.scheduler_address, progress=kill))
    assert killed
    here = sweep(file, "0", given, way=ALONE)
    assert np.array_equal(there.columns["Ms"], here.columns["Ms"])


def test_a_cluster_without_workers_is_one_sentence() -> None:
    distributed = pytest.importorskip("distributed", reason="the extra 'cluster' is not installed")
    given = {"sweep.over": "model.delay=1:2:2", "sweep.figure": "Ms"}
    with (
        distributed.LocalCluster(n_workers=0, dashboard_address=None) as cluster,
        pytest.raises(SimulationError, match="has no workers"),
    ):
        sweep(file_of(MILL), "1", given, way=SweepWay(scheduler=cluster.scheduler_address))


def test_a_port_that_never_answers_is_no_scheduler(monkeypatch: pytest.MonkeyPatch) -> None:
    """A client of distributed waited there for ever."""
    pytest.importorskip("distributed", reason="the extra 'cluster' is not installed")
    monkeypatch.setattr("amp_studio.sim.variations.running.CONNECT_S", 0.2)
    given = {"sweep.over": "model.delay=1:2:2", "sweep.figure": "Ms"}
    with socket.create_server(("127.0.0.1", 0)) as silent:
        there = f"tcp://127.0.0.1:{silent.getsockname()[1]}"
        with pytest.raises(SimulationError, match="No scheduler answers"):
            sweep(file_of(MILL), "1", given, way=SweepWay(scheduler=there))


COMPOSED = (
    (MILL, "3", ("servo.initial_gain=0.5:1.5:4", "servo.velocity_proportional_gain=1000:2000:4")),
    (AXES[0][0], "X", ("R3=50:150:3", "R4=0:20:3")),
    (AXES[1][0], "X", ("servo.p_gain@X=0.0005:0.002:3", "model.viscous_friction=0:0.4:3")),
    (AXES[4][0], "0", ("model.viscous_friction=0:0.4:3", "model.delay=0.1:1.3:3")),
)


@pytest.mark.parametrize(("example", "axis", "over"), COMPOSED)
def test_an_axis_put_together_is_the_bound_one(example: str, axis: str, over: tuple[str, ...]) -> None:
    file = file_of(example)
    varied = tuple(read_varied(file, axis, each) for each in over)
    axes = Axes(SweepJob(content_of(file), axis, (), (), varied, motion=True, loops=False))
    asked: list[Sequence[float]] = []
    grids = [each.grid() for each in varied]
    composed = ComposedAxes(lambda point: (asked.append(point), axes.at(point))[1], grids)
    points = points_of(varied, None, 1).tolist()
    for point in points:
        composed.axis(point)  # every value is tried by now
    tried = len(asked)
    assert all(agrees(composed.axis(point), axes.at(point)) for point in points)
    assert len(asked) == tried, "nothing more was bound"


def test_a_figure_of_two_varied_ones_is_bound_from_the_file() -> None:
    bound = bind_axis(file_of(MILL), law_of("9pc"), "3")
    asked: list[tuple[float, ...]] = []

    def bind(point: Sequence[float]) -> AxisLaw:
        asked.append(tuple(point))
        return replace(bound, position_rate=point[0] * point[1], feedrate=point[0])

    composed = ComposedAxes(bind, ((0.0, 1.0, 2.0), (0.0, 1.0, 3.0)))
    found = composed.axis((2.0, 3.0))
    assert found is not None
    assert (found.position_rate, found.feedrate) == (6.0, 2.0)
    assert asked[-1] == (2.0, 3.0)


SCRIPT = """
import amp_studio as amp
from amp_studio.sim import SweepWay
from amp_studio.sim.variations import running
running.AT_ONCE = 30
print("once")
machine = amp.open({path!r})
given = {{"sweep_over": "model.delay=1:3:90", "sweep_figure": "Ms"}}
one, two = (machine.simulate("sweep", "0", way=SweepWay(cores=cores), **given) for cores in (1, 2))
print((one.columns["Ms"] == two.columns["Ms"]).all())
"""


def test_a_sweep_over_two_cores_is_that_of_one_and_runs_the_script_that_asks_once(tmp_path: Path) -> None:
    script = tmp_path / "machine_of_the_day.py"
    script.write_text(SCRIPT.format(path=str(EXAMPLES / "num-1060-mill/MILL_1060.amp")))
    done = subprocess.run(
        [sys.executable, str(script)], capture_output=True, text=True, timeout=120, check=False
    )
    assert (done.stdout.split(), done.stderr) == (["once", "True"], "")


def test_a_process_apart_that_was_ended_has_no_figures() -> None:
    worker = SweepWorker(None)  # type: ignore[arg-type]  # it is ended before it asks for its job
    worker.end()
    with pytest.raises(WorkerEndedError):
        worker.figures(np.zeros((1, 1)))


def test_a_map_names_its_gains_and_has_german_words() -> None:
    file = file_of(MILL)
    over = "servo.initial_gain=0.5:1:2;servo.velocity_proportional_gain=1000:2000:2"
    picture = sweep_picture(sweep(file, "1", {"sweep.over": over, "move.duration": 0.05}, way=ALONE))
    german = language_of("de", "9pc").sentence
    above, cut = (scene_in_words(each, german) for each in (picture.above, *picture.panels))
    assert (above.title, above.cells.unit, above.x.label) == (
        "Steifigkeit",
        "mm/%",
        "1710 Initial Gain of Position Loop",
    )
    assert above.subtitle == ("nach oben: 1801 Velocity Proportional Gain; blasse Felder sind nicht sicher")
    assert above.texts[0].text == "jetzt"
    assert (cut.title, cut.subtitle) == ("Steifigkeit", "bei 1801 Velocity Proportional Gain = 2000")
