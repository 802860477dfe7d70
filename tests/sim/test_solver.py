"""The solver finds the stiffest sound gains, whatever the file has now, and has nothing to add to them.

``make test`` tunes the machines that are tuned in a second; ``make campaign`` those with three gains and two
loops too, and ``make tunings`` 300 random ones.
"""

import math
from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.sim import SimulationError, Trace, address_of, simulate
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.law import law_of
from amp_studio.sim.tuning.advice import OTHER_SIGN
from amp_studio.sim.tuning.aims import AIMS
from amp_studio.sim.tuning.gains import gains_of
from amp_studio.sim.tuning.levels import Candidate, levels_of
from amp_studio.sim.tuning.loops import SOUND
from amp_studio.sim.tuning.solver import solve
from amp_studio.sim.tuning.trial import Trial
from tests.campaigns import CAMPAIGN
from tests.sim.tuning_campaign import Plant, faults, random_plants

EXAMPLES = Path(__file__).parents[2] / "examples"
AXES = [("num-1060-mill/MILL_1060.amp", "0"), ("syntec-mill/SYNTEC_MILL.amp", "1")]
DEAR_AXES = [
    ("57c422b-label-press/LABEL_PRESS.amp", "Y"),
    ("acromill-router/ROUTER.amp", "X"),
    ("mill-1394/MILL_1394.amp", "3"),
]


def file_of(example: str) -> ParameterFile:
    return open_file(EXAMPLES / example).file


def apply(file: ParameterFile, trace: Trace) -> None:
    for each in trace.recommendations:
        address = address_of(file, each.parameter, trace.axis)
        old = file.get(address)
        whole = old is None or isinstance(old.value, int)
        file.set(address, Value(int(each.value) if whole else each.value, each.unit))


@pytest.mark.parametrize(("example", "axis"), AXES + (DEAR_AXES if CAMPAIGN else []))
def test_what_tune_advises_is_sound_and_a_second_run_has_nothing_to_add(example: str, axis: str) -> None:
    file = file_of(example)
    first = simulate(file, "tune", axis)
    result = first.result
    assert result["Ms"][0] <= SOUND.sensitivity
    assert result["phase_margin"][0] >= SOUND.phase
    assert result["gain_margin"][0] >= SOUND.gain
    apply(file, first)
    second = simulate(file, "tune", axis)
    assert second.recommendations == ()
    assert (
        second.result["stiffness"] == second.result["stiffness_before"] == pytest.approx(result["stiffness"])
    )
    assert simulate(file, "frequency", axis, {"move.points": 2}).recommendations == ()


@pytest.mark.parametrize(("example", "axis"), AXES + (DEAR_AXES if CAMPAIGN else []))
def test_each_aim_keeps_its_numbers_and_stiff_is_stiffer_than_normal_than_quiet(
    example: str, axis: str
) -> None:
    file, gives = file_of(example), []
    law = law_of(file.schema.family.family)
    trial = Trial(file, lambda other: bind_axis(other, law, axis))
    for word in ("quiet", "normal", "stiff"):
        solved = solve(trial, AIMS[word])
        assert solved.level == 0
        assert levels_of(AIMS[word])[0].keeps(solved.after, 1.0)
        gives.append(sum(solved.after.loops.yields))
    assert gives == sorted(gives, reverse=True)


def test_a_contour_gives_axes_whose_gains_are_other_words_one_position_gain() -> None:
    file = file_of("num-1060-mill/MILL_1060.amp")
    file.set(("servo.max_speed", "1"), Value(12000, "mm/min"))  # what a count of its gain is worth
    words, rates = set(), []
    for axis in ("0", "1"):
        trace = simulate(file, "tune", axis, {"tune.for": "contour"})
        apply(file, trace)
        words.add(file.get(("servo.loop_gain", axis)))
        rates.append(bind_axis(file, law_of("num"), axis).position_rate)
        assert any("The position gain is the one that all axes" in text for text in trace.assumptions)
    assert len(words) == 2
    assert max(rates) / min(rates) < 1.01


@pytest.mark.skipif(not CAMPAIGN, reason="six searches for two gains; make campaign")
def test_a_contour_gives_all_its_unequal_axes_one_position_gain() -> None:
    file = file_of("lathe-ls176/LATHE_LS176.amp")
    gains = set()
    for axis in ("1", "2"):
        trace = simulate(file, "tune", axis, {"tune.for": "contour"})
        reported = {each.parameter: each.value for each in trace.recommendations}
        gains.add(reported.get("servo.initial_gain", 1.0))
        assert any("The position gain is the one that all axes" in text for text in trace.assumptions)
    assert max(gains) / min(gains) < 1.03


def test_a_word_that_is_no_aim_and_an_open_loop_are_one_sentence() -> None:
    file = file_of("mill-1394/MILL_1394.amp")
    with pytest.raises(SimulationError, match=r"Unknown aim 'loud'. Known: quiet, normal, stiff, contour"):
        simulate(file, "tune", "1", {"tune.for": "loud"})
    file.set(("servo.position_loop_type", "1"), Value("open"))
    with pytest.raises(SimulationError, match="position loop of axis 1 is open"):
        simulate(file, "tune", "1")


@pytest.mark.parametrize(
    "plant", [p for p in random_plants(6, seed=1) if CAMPAIGN or "num" in p.example], ids=str
)
def test_a_grid_search_finds_nothing_that_the_solver_did_not(plant: Plant) -> None:
    """The short version of ``make tunings``."""
    assert list(faults(plant)) == []


def test_an_integral_gain_of_the_other_sign_is_sought_on_the_side_of_the_gain_before_it() -> None:
    """It was sought below 0 only, where none is sound, and a second run then found the one above 0."""
    law, file = law_of("57c422b"), file_of("57c422b-label-press/LABEL_PRESS.amp")
    sound = gains_of(Trial(file, lambda other: bind_axis(other, law, "X")))
    file.set(("gain.integral", "X"), Value(-300))
    gains = gains_of(Trial(file, lambda other: bind_axis(other, law, "X")))
    assert [(each.name, each.low, each.high, each.sign) for each in gains] == [
        (each.name, each.low, each.high, each.sign) for each in sound
    ]
    assert [each.present_size for each in gains] == [78.0, 17595.0, -300.0]


@pytest.mark.skipif(not CAMPAIGN, reason="a search for three gains; make campaign")
def test_a_wrong_sign_of_an_integral_gain_is_mended_at_once() -> None:
    file = file_of("57c422b-label-press/LABEL_PRESS.amp")
    sound = {each.parameter: each.value for each in simulate(file, "tune", "X").recommendations}
    file.set(("gain.integral", "X"), Value(-300))
    trace = simulate(file, "tune", "X")
    assert {each.parameter: each.value for each in trace.recommendations} == sound
    assert [each.price for each in trace.recommendations if each.parameter == "gain.integral"] == [OTHER_SIGN]
    apply(file, trace)
    assert simulate(file, "tune", "X").recommendations == ()


def test_a_candidate_shows_by_how_much_a_count_moves_its_output() -> None:
    law = law_of("57c422b")
    axis = bind_axis(file_of("57c422b-label-press/LABEL_PRESS.amp"), law, "X")
    # Velocity Gain 78 words for a count a scan, of 1984 for 10 V, and the proportional and integral parts on
    # top.
    assert Candidate(axis).jolt == pytest.approx(
        78.0 * (1.0 + (17595.0 + 768.0) / 65536.0) / 1984.0, rel=1e-3
    )
    assert math.isfinite(Candidate(axis).loops.lacks())


@pytest.mark.skipif(not CAMPAIGN, reason="a search for three gains with 75 samples of delay; make campaign")
def test_an_axis_with_a_long_delay_is_as_stiff_as_with_any_other_search() -> None:
    """With fewer tries, as each took a third of a second, its load moved by 408 for one unit of torque, not
    213.
    """
    file = open_file(EXAMPLES / "acromill-router" / "ROUTER.amp").file
    law = law_of("acromill")
    trial = Trial(file, lambda other: bind_axis(other, law, "X", {"model.delay": 30.0}))
    solved = solve(trial, AIMS["normal"])
    assert solved.level == 0
    assert solved.after.loops.yields[0] < 215.0
