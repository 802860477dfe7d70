"""Programs on their path: ramps, corners, look-ahead against planners of this test, what limits, contour
error."""

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from amp_studio.assignments import read_assignments
from amp_studio.files import ParameterFile, new_file
from amp_studio.programs import path_letters
from amp_studio.programs.interpreter import tool_path
from amp_studio.sim import (
    PathRules,
    ProgramJob,
    Ramp,
    SimulationError,
    run_axis,
    simulate,
    typed_steps,
    versions,
    what_if,
)
from amp_studio.sim.axis.motion import RunEnd
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.command.changes import change_time, change_way, peaks, reached
from amp_studio.sim.command.pieces import change, length
from amp_studio.sim.law import law_of
from amp_studio.sim.path.contour import distances
from amp_studio.sim.path.moment import moment_in
from amp_studio.sim.path.passes import lowest_sums
from amp_studio.sim.path.picture import MAX_POINTS, PathChoice, path_picture
from amp_studio.sim.path.planned import PlannedProgram
from amp_studio.sim.path.planner import ProgramPlan
from amp_studio.sim.path.profiles import axis_profiles
from amp_studio.sim.path.program import ProgramRun, run_program
from amp_studio.sim.path.result import LinesOfTime, limit_letters, line_columns
from amp_studio.sim.path_rules import Corners, PathLimit
from amp_studio.sim.zones import Zone
from tests.programs.test_block import example

from .real_programs import BASE, OFF, PROGRAMS, RealProgram

LINEAR = Ramp("linear")
ZIGZAG = ["G21 G90", *(f"G1 X{-3 - n * 0.7:.2f} Y{-(n * 7) % 5} F{1500 + 500 * (n % 3)}" for n in range(40))]


@pytest.fixture(scope="module")
def router() -> ParameterFile:
    return example("acromill-router")


def rules(acceleration: float = 500.0, **others: object) -> PathRules:
    """Return rules of a control that keeps an acceleration along the path and slows down in corners."""

    def corner(corners: Corners) -> list[tuple[PathLimit, np.ndarray]]:
        cosine = (corners.before * corners.after).sum(axis=1)
        return [
            (PathLimit(0.0, ("corner", "")), np.where(cosine < 0.99, 5.0 + 10.0 * (1.0 + cosine), np.inf))
        ]

    given = {"feed_ramp": LINEAR, "rapid_ramp": LINEAR, "corner": corner} | others
    limit = (PathLimit(acceleration, ("acceleration", "")),)
    return PathRules(feed_acceleration=limit, rapid_acceleration=limit, **given)


def planned(file: ParameterFile, lines: list[str], with_rules: PathRules) -> ProgramPlan:
    return program_of(file, lines, with_rules).whole


def program_of(file: ParameterFile, lines: list[str], with_rules: PathRules) -> PlannedProgram:
    program = PlannedProgram([tool_path(file, lines)], with_rules)
    program.add_up(0.0)
    return program


def fine_time(plan: ProgramPlan, joint: np.ndarray, top: np.ndarray, acceleration: float) -> float:
    """Return the shortest time on a fine grid of the path: v² rises and falls by at most 2 a ds."""
    steps = np.maximum(np.ceil(plan.geometry.length / 0.001), 1).astype(int)
    ds = np.repeat(plan.geometry.length / steps, steps)
    square = np.concatenate([[0.0], np.repeat(top**2, steps)])
    for n, at in enumerate(np.cumsum(steps)[:-1]):
        square[at] = min(joint[n] ** 2, top[n] ** 2, top[n + 1] ** 2)
    square[-1] = 0.0
    for n in range(len(ds) - 1, -1, -1):
        square[n] = min(square[n], square[n + 1] + 2.0 * acceleration * ds[n])
    for n in range(len(ds)):
        square[n + 1] = min(square[n + 1], square[n] + 2.0 * acceleration * ds[n])
    speed = np.sqrt(square)
    return float((2.0 * ds / (speed[1:] + speed[:-1])).sum())


def test_the_time_is_that_of_a_search_over_a_fine_grid(router: ParameterFile) -> None:
    plan = planned(router, ZIGZAG, rules())
    cosine = (plan.geometry.last[:-1] * plan.geometry.first[1:]).sum(axis=1)
    joint = np.where(cosine < 0.99, 5.0 + 10.0 * (1.0 + cosine), np.inf)
    assert plan.time == pytest.approx(fine_time(plan, joint, plan.programmed, 500.0), rel=2e-3)


@pytest.mark.parametrize("known", [1, 2, 5, 40])
def test_a_short_look_ahead_is_that_of_a_control_that_knows_so_many_blocks(
    router: ParameterFile, known: int
) -> None:
    """Against a planner that begins again at each block, with the blocks it knows, the last one to rest."""
    ahead = PathLimit(float(known), ("ahead", ""))
    plan = planned(router, ZIGZAG, rules(60.0, look_ahead=ahead))
    whole = planned(router, ZIGZAG, rules(60.0, corner=lambda _corners: ()))
    cosine = (plan.geometry.last[:-1] * plan.geometry.first[1:]).sum(axis=1)
    joint = np.where(cosine < 0.99, 5.0 + 10.0 * (1.0 + cosine), np.inf)
    speed, entries, count = 0.0, [], len(plan.entry)
    for n in range(count):
        entries.append(speed)
        following = min(n + 1 + known, count)  # at the start of the next block one more is known
        later = 0.0
        for k in range(following - 1, n, -1):
            most = min(joint[k - 1], plan.programmed[k - 1], plan.programmed[k])
            later = min(most, math.sqrt(later**2 + 120.0 * plan.geometry.length[k]))
        speed = min(later, math.sqrt(speed**2 + 120.0 * plan.geometry.length[n]))
    assert plan.entry.tolist() == pytest.approx(entries)
    assert plan.time >= whole.time


@pytest.mark.parametrize(
    "ramp",
    [Ramp("linear"), Ramp("s-curve", jerk=4000.0), Ramp("sine-squared", time=0.2)],
    ids=lambda r: r.kind,
)
def test_closed_figures_of_changes_are_those_of_their_pieces(ramp: Ramp) -> None:
    for before, after, acceleration in ((0.0, 30.0, 200.0), (12.0, 13.0, 500.0), (5.0, 80.0, 300.0)):
        pieces = change(replace(ramp, acceleration=acceleration), before, after)
        one = np.array([acceleration])
        time = change_time(ramp, np.array([after - before]), one)[0]
        way = change_way(ramp, np.array([before]), np.array([after]), one)[0]
        assert time == pytest.approx(math.fsum(piece.duration for piece in pieces))
        assert way == pytest.approx(length(pieces))
        assert reached(ramp, before, float(way), acceleration) == pytest.approx(after)
        both = np.array([before]), np.array([before]), np.array([2.0 * way])
        peak = peaks(ramp, *both, one * 1e9, one, one)
        assert peak[0] == pytest.approx(after)


def test_no_time_is_shorter_than_that_of_time_optimal_axes(router: ParameterFile) -> None:
    """ruckig, which needs no path: each axis from rest to rest alone is a lower bound of a straight move."""
    ruckig = pytest.importorskip("ruckig")
    plan = planned(router, ["G21", "G0 X-30 Y-40 Z-5"], rules(rapid=(PathLimit(40.0, ("rapid", "")),)))
    trajectory = ruckig.Trajectory(3)
    given = ruckig.InputParameter(3)
    given.current_position, given.target_position = [0.0] * 3, [-30.0, -40.0, -5.0]
    given.max_velocity, given.max_acceleration = [40.0] * 3, [500.0] * 3
    ruckig.Ruckig(3).calculate(given, trajectory)
    assert plan.time >= trajectory.duration


def test_ramps_up_and_down_may_differ(router: ParameterFile) -> None:
    """10 mm at 200 and 800 mm/s2, without a speed that is reached: v² = 2 s a d / (a + d)."""
    slopes = {
        "axis_acceleration": {"X": PathLimit(200.0, ("up", ""))},
        "axis_deceleration": {"X": PathLimit(800.0, ("down", ""))},
    }
    plan = planned(router, ["G21 F60000", "X-10"], PathRules(feed_ramp=LINEAR, rapid_ramp=LINEAR, **slopes))
    peak = math.sqrt(2.0 * 10.0 * 160.0)
    assert plan.peak[0] == pytest.approx(peak)
    assert plan.time == pytest.approx(peak / 200.0 + peak / 800.0)


def test_a_9pc_keeps_each_axis_to_its_feedrates_ramps_and_velocity_step() -> None:
    """Pages 9-1, 9-2, 10-7 to 10-10, of the example: 5000 and 10000 mm/min, 694.4 mm/s2, 4.23333 mm/s."""
    file = example("mill-1394")
    text = "G21 G90|G00 X60. Y60.|G01 X120. F9999.|Y0.|M03|G61 X0.|M30"
    plan = run(file, text, with_contour=False).plan.whole
    speeds = [10000.0 / 60.0 * math.sqrt(2.0), *[5000.0 / 60.0] * 3]
    assert plan.peak.tolist() == pytest.approx(speeds, rel=1e-9)
    assert plan.leave[1] == pytest.approx(4.23333, rel=1e-4)
    named = {limit.param for limit in plan.causes if limit.param}
    assert {("accdec.linear_acceleration", "1"), ("feedrate.max_cutting", "1")} <= named
    assert plan.acceleration[0] == pytest.approx(694.4 * math.sqrt(2.0))
    arc = run(file, "G21|G02 X30. Y30. I15. J0", with_contour=False)
    assert "G02 is not simulated" in arc.alarms[0].message


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.name)
def test_a_program_takes_the_time_that_a_real_grblhal_needed(program: RealProgram) -> None:
    """Within 1 %, most within 0.2 %: `real_programs.py` has what was measured, and how."""
    file = new_file("grblhal", "grblhal", ["X", "Y", "Z"])
    settings = {**BASE, **program.settings}
    known = {f"${number}": f"{value:g}" for number, value in settings.items() if number not in OFF}
    file.set_checked(read_assignments(file, known.items()))
    job = ProgramJob(program.lines, start=[0.0, 0.0, 0.0], with_contour=False)
    found = job.run(file)
    first = found.plan.whole.start[
        np.flatnonzero(found.plan.whole.geometry.length)[0]
    ]  # its time begins with the first move
    assert found.plan.time - first == pytest.approx(program.time, rel=0.01)
    assert (250.0 * found.plan.whole.geometry.ends[-1]).tolist() == pytest.approx(program.end, abs=0.501)


def test_every_second_is_given_to_one_limit(router: ParameterFile) -> None:
    plan = program_of(router, ZIGZAG, rules())
    assert plan.time_by_cause.sum() == pytest.approx(plan.time)
    assert sum(row["time_s"] for row in LinesOfTime(plan)) == pytest.approx(plan.time, abs=1e-4)
    named = {limit.param: time for limit, time in zip(plan.causes, plan.time_by_cause, strict=True)}
    assert named["acceleration", ""] > 0.0


def run(file: ParameterFile, text: str, **given: bool) -> ProgramRun:
    return run_program(file, [tool_path(file, [block.strip() for block in text.split("|")])], **given)


def test_an_acromill_goes_from_rest_to_rest_in_rapid(router: ParameterFile) -> None:
    """Page 26: 100 in/min in rapid, Master Rapid ACC/DEC 100 in/s2."""
    found = run(router, "G20|G0 X-2|G0 X-4", with_contour=False)
    speed, slope = 100.0 / 60.0, 100.0
    assert found.plan.time == pytest.approx(2.0 * (2.0 / speed + speed / slope))
    assert found.plan.whole.entry.tolist() == [0.0, 0.0]


def test_an_acromill_stops_after_a_block_of_g9_and_after_each_of_g61(router: ParameterFile) -> None:
    """Pages 27 and 33: exact stop in the in-position band."""
    planned = run(router, "G20 F60|G1 X-1|X-2|G9 X-3|X-4|G61 X-5|X-6", with_contour=False).plan
    left = planned.whole.leave.tolist()
    assert left[0] > 0.0
    assert left[1] > 0.0
    assert left[2] == 0.0
    assert left[4:] == [0.0, 0.0]


def test_overrides_are_clamped_by_the_machine_and_ignored_under_g63(router: ParameterFile) -> None:
    path = tool_path(router, ["G20 F150", "G1 X-4", "G63 X-8"])
    peaks_of = run_program(router, [path], override=2.0, with_contour=False).plan.whole.peak * 60.0 / 25.4
    highest = 200.0
    assert peaks_of.tolist() == pytest.approx([highest, 150.0])


def test_corners_of_g62_are_slow_and_those_of_g64_are_not(router: ParameterFile) -> None:
    """Page 61: Acute Angle1 90 in the example, Min Corner Speed 5 in/min."""
    slow = run(router, "G20 F100 G62|X-2|Y-2", with_contour=False).plan.whole
    cutting = run(router, "G20 F100 G64|X-2|Y-2", with_contour=False).plan.whole
    assert slow.leave[0] * 60.0 / 25.4 == pytest.approx(5.0)
    assert cutting.leave[0] * 60.0 / 25.4 == pytest.approx(100.0)


def test_the_first_block_beyond_a_soft_limit_is_named(router: ParameterFile) -> None:
    found = run(router, "G20 F100|X-2|G3 X-2 Y0 I-2 J-0.5|G1 Z-9", with_contour=False)
    assert [(alarm.line, alarm.code) for alarm in found.alarms] == [(4, "SOFT LIMIT")]
    over = run(router, "G20 F100|X-2|G3 X-2 Y0 I-2 J-2|G1 X-3", with_contour=False)
    assert over.alarms == ()
    arc = run(router, "G20 F100|Y-4|G3 X0 Y-3.9 I0 J-3.95|G1 X-3", with_contour=False)
    assert arc.alarms == ()


def test_the_command_of_the_axes_is_the_planned_path(router: ParameterFile) -> None:
    found = run(router, "G20 F100|X-2|G3 X-3 Y-1 I-2 J-1|G0 Z-1", with_contour=False)
    law = law_of("acromill")
    for n, profile in enumerate(axis_profiles(found.plan.whole)):
        axis = bind_axis(router, law, found.plan.path.axes[n])
        motion = run_axis(axis, profile, RunEnd(found.plan.time))
        command, time = motion.columns["command_position"], motion.columns["time_s"]
        assert np.abs(np.diff(command)).max() <= 100.0 * 25.4 / 60.0 * np.diff(time).max() * 1.01
        assert command[-1] == pytest.approx(found.plan.whole.geometry.ends[-1, n], abs=1e-3)


def test_the_contour_error_of_a_circle_is_its_radius_error(router: ParameterFile) -> None:
    found = run(router, "G21|G200 F1|F4000|X-40|G3 X-40 Y0 I-20 J0", with_contour=True)
    assert found.contour is not None
    contour = found.contour
    assert contour.largest >= contour.p95 > 0.0
    row = contour.row == 1
    assert row.sum() > 100
    assert np.median(contour.error[row]) < 0.01


@pytest.mark.parametrize(("feed", "radius"), [(4000, 5), (2500, 2)])
def test_the_contour_error_of_a_circle_is_that_of_the_servo_scenario(feed: int, radius: int) -> None:
    """Small circles, 7 µm off: that of a large one is near a count (1.2 µm), where its sign changes."""
    soft = {"p_gain": "0.02", "i_gain": "0", "vel_ffwd": "0", "acc_ffwd": "0"}
    file = example("acromill-router", **{f"servo.{n}@{axis}": v for axis in "XY" for n, v in soft.items()})
    circle = simulate(file, "circle", "X", {"move.feedrate": f"{feed} mm/min", "move.radius": f"{radius} mm"})
    radius_error, unit = circle.result["radius_error"]
    assert unit == "in"
    turns = "|".join([f"G3 X-40 Y-40 I-{radius} J0"] * 3)
    found = run(file, f"G21|G200 F1|F{feed} X-40 Y-40|{turns}").contour
    assert found is not None
    assert np.mean(found.error[found.row == 2]) == pytest.approx(25.4 * abs(radius_error), rel=0.05)


def test_the_distance_from_a_path_is_to_the_part_that_is_intended() -> None:
    points = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 0.2], [0.0, 0.2]])
    place = np.array([[5.0, 0.15], [10.0, -0.1], [9.95, 0.1]])
    commanded = np.array([[5.0, 0.0], [10.0, 0.0], [10.0, 0.1]])
    found = distances(place, commanded, np.array([5.0, 10.0, 10.1]), points)
    assert found.tolist() == pytest.approx([0.15, 0.1, 0.05])


def test_a_program_is_cancelled_by_its_progress(router: ParameterFile) -> None:
    class StopAskedError(Exception):
        pass

    def stop(_what: str, _share: float) -> None:
        raise StopAskedError

    with pytest.raises(StopAskedError):
        ProgramJob(ZIGZAG).run(router, stop)


def test_a_num_has_other_ramps_for_g0_and_passes_corners_at_its_approach_speed() -> None:
    """Pages 6-10 and 6-36: the second word of P32 is of fast moves; P33 bounds the speed between blocks."""
    file = example("num-1060-mill")
    speeds = (("servo.approach_speed@0", "600 mm/min"), ("servo.approach_speed@1", "600 mm/min"))
    file.set_checked(read_assignments(file, speeds))
    job = ProgramJob(["G0 X-10", "G1 X-20 F3000", "Y-20", "G9 X-10"], [0.0] * 4, with_contour=False)
    plan = job.run(file).plan.whole
    own = [file.evaluation.canonical((f"servo.acceleration_{kind}", "0")) for kind in ("fast", "work")]
    assert plan.acceleration[:2].tolist() == pytest.approx(own)
    assert plan.leave[1] == pytest.approx(10.0)
    assert plan.rest[-1] > 0.0


def test_a_syntec_runs_rapid_moves_from_rest_to_rest_and_names_what_it_does_not() -> None:
    file = example("syntec-mill")
    run = ProgramJob(["G91 G00 X-20", "Y-10", "G01 X1"], with_contour=False).run(file)
    assert run.plan.whole.leave.tolist() == [0.0, 0.0]
    assert run.alarms[-1].message == "G01 is a code that no page here names"


@pytest.mark.parametrize(
    ("text", "start", "message"),
    [
        (
            "G00 X-470.",
            (-200.0, -50.0, -400.0),
            "programmable zone 2, group 1 is met at X -420, Y -50, Z -400",
        ),
        ("G00 X-470.", (-200.0, -50.0, -5.0), ""),  # Z is not in it
        ("G23|G00 X-470.", (-200.0, -50.0, -400.0), ""),
        ("G23.1|G00 X-470.", (-200.0, -50.0, -400.0), "zone 2, group 1 is met at X -420"),
        ("G22.1|G00 X-470.", (-200.0, -50.0, -400.0), ""),
        ("G00 X-370.", (-200.0, -200.0, -400.0), "zone 3, group 1 is met at X -350"),  # inside where it is on
        ("G23|G00 X-370.|G22|X-200.", (-200.0, -200.0, -400.0), "zone 3, group 1 is met at X -350"),
    ],
)
def test_zones_of_power_up_and_of_the_program_are_met(
    text: str, start: tuple[float, ...], message: str
) -> None:
    """Pages 6-2 to 6-9 and 18-7: zone 2 keeps out; zone 3 in, or out where the axes are out when it is on."""
    file = example("mill-1394")
    places = dict(zip("XYZ", start, strict=True))
    job = ProgramJob(
        text.split("|"),
        [places.get(letter, 0.0) for letter in path_letters(file)],
        {"X": 0.0},
        with_contour=False,
    )
    met = [alarm.message for alarm in job.run(file).alarms if "zone" in alarm.message]
    assert len(met) == bool(message)
    assert all(message in each for each in met)


def test_a_zone_of_a_syntec_is_read_ahead() -> None:
    """Slides 3.2 and 3.3: X 10 to 25, Y 15 to 30, Z 0 to 20 of the example, on by Pr3838; G23 switches it
    off.
    """
    file = example("syntec-mill")
    start = [{"Y": 20.0, "Z": 10.0}.get(letter, 0.0) for letter in path_letters(file)]
    for text, code in ((["G00 X30"], "COR-040"), (["G23", "G00 X30"], "")):
        alarms = ProgramJob(text, start, {"X": 0.0}, with_contour=False).run(file).alarms
        met = [alarm for alarm in alarms if "software stroke limit 2" in alarm.message]
        assert [alarm.code for alarm in met] == [code] * bool(code)
        assert all("X 10, Y 20, Z 10" in alarm.message for alarm in met)


def test_a_program_is_run_over_a_row_of_values_and_under_other_files(router: ParameterFile) -> None:
    job = ProgramJob(["G21 F600", "X-30", "Y-20"], [0.0] * 3, with_contour=False)
    steps = typed_steps(router, "speeds.feed_acc_dec=-20%:+20%:3")
    assert [next(iter(each.values())).value for each in steps] == [80.0, 100.0, 120.0]
    assert [next(iter(each.values())).value for each in typed_steps(router, "speeds.rapid=50:100:2")] == [
        50.0,
        100.0,
    ]
    times = [each.run.plan.time for each in what_if(job, router, steps) if each.run]
    assert times[0] > times[1] > times[2]
    slower = example("acromill-router", **{"speeds.feed_acc_dec": "80 in/s2"})
    other = versions(job, {"older": slower, "another": example("57c422b-label-press")})
    assert other[0].run is not None
    assert other[0].run.plan.time == pytest.approx(times[0])
    assert other[1].run is None
    assert other[1].why_not
    for text in ("speeds.rapid=1:2%", "speeds.rapid=5", "speeds.rapid=1:2:1", "speeds.rapid=1:2:9999"):
        with pytest.raises(SimulationError):
            typed_steps(router, text)


def test_a_moment_is_on_the_path_with_the_speed_of_its_ramp(router: ParameterFile) -> None:
    text = ["G21 G200 F1", "F6000 X-50", "G3 X-60 Y-10 I0 J-10", "G1 Y-30"]
    plan = planned(router, text, rules(500.0))
    moments = [moment_in(plan, float(time)) for time in np.linspace(0.0, plan.time, 2001)]
    places = np.array([each.place for each in moments if each])
    speeds = np.array([each.speed for each in moments if each])
    step = plan.time / 2000.0
    gone = np.linalg.norm(np.diff(places, axis=0), axis=1) / step
    assert np.abs(gone - 0.5 * (speeds[1:] + speeds[:-1])).max() < 1.0
    assert places[0].tolist() == [0.0, 0.0, 0.0]
    assert places[-1].tolist() == pytest.approx([-60.0, -30.0, 0.0])


@pytest.mark.parametrize("count", [1, 2, 511, 512, 513, 3000])
def test_the_passes_of_straight_ramps_are_those_of_a_loop(count: int) -> None:
    """Rows without a way, speeds of 0 and gains without an end included; the loop is what they mean."""
    chance = np.random.default_rng(count)
    bound = chance.uniform(0.0, 2e4, count) * (chance.random(count) > 0.2)
    gain = chance.uniform(0.0, 900.0, max(count - 1, 0)) * (chance.random(max(count - 1, 0)) > 0.1)
    expected = bound.tolist()
    for n in range(1, count):
        expected[n] = min(expected[n], expected[n - 1] + gain[n - 1])
    found = lowest_sums(bound, gain)
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-6)
    free = np.array(expected) == bound
    assert (found[free] == bound[free]).all()


def test_no_limit_has_the_letter_of_rapid() -> None:
    times = np.array([9.0, *range(24, 0, -1)])
    run = cast(ProgramRun, SimpleNamespace(plan=SimpleNamespace(time_by_cause=times)))
    letters = limit_letters(run)
    assert "".join(letters.values()) == "ABCDEFGHIJKLMNOPQSTUVWXYZ"


def test_a_zone_has_its_number_and_not_one_that_begins_so() -> None:
    zone = Zone("programmable zone 12, group 3", {}, "outside", is_on=True, code="")
    assert [number for number in ("", "1", "12", "3", "2") if zone.has_number(number)] == ["12"]


def test_a_picture_has_a_bounded_number_of_points_and_every_limit_of_a_long_program(
    router: ParameterFile,
) -> None:
    """Cut and rapid by turns, an arc among them: each n-th row alone would be of one kind."""
    lines = ["G21 G90 F1000", *("G0 X-9 Y-9", "G1 X-1", "G2 X-3 Y-9 I-2 J-9", "G0 X-1 Y-1") * 5000]
    run = ProgramJob(lines, [0.0] * 3, dict.fromkeys("XYZ", 0.0), with_contour=False).run(router)
    assert run.plan.path.fault is None
    for colours in ("limit", "feed"):
        picture = path_picture(router, run, None, PathChoice(colours))
        for scene in (picture.above, picture.close):
            assert scene is not None
            assert sum(len(line.points) for line in scene.lines) < 2 * MAX_POINTS
            assert {line.dashed for line in scene.lines} == {False, True}
    letters, times = line_columns(run, 4)
    assert letters.tolist() == line_columns(run, len(lines))[0].tolist()[:5]
    assert (letters[2], len(times)) == ("R", 5)
