"""Figures of motion that manuals print, in the scenarios and formulas that a user calls."""

import pytest

from amp_studio.schema import Value, load_schema
from amp_studio.sim import ProgramJob, SimulationError, simulate
from amp_studio.validate import calculate
from tests.programs.test_block import example, read, word


@pytest.mark.parametrize(("cycle", "scans", "points"), [("1", "1", 800), ("4", "2", 1600), ("5", "3", 1334)])
def test_points_of_a_time_cam(cycle: str, scans: str, points: int) -> None:
    """57C422B, page 5-10: scans of 1.25 ms, at most 1915 words."""
    found = calculate("57c422b", "cam_points", {"cycle_s": cycle, "time_scans": scans})
    assert found == points


def test_both_printed_latencies_of_the_registration_are_shown() -> None:
    """57C422B: 25 µs on page 2-4, 50 µs on page A-2; at 100000 counts/min they are 1/24 and 1/12 of a
    count.
    """
    result = simulate(example("57c422b-label-press"), "probe", "X", {"move.speed": 100000.0}).result
    assert result["latency"] == (5e-5, "s")
    errors = [value for name, (value, _) in result.items() if name.startswith("probe_error_")]
    assert errors == pytest.approx([100000 / 60 * 25e-6, 100000 / 60 * 50e-6])


def test_a_homing_counts_its_grid_beyond_a_turn() -> None:
    """Syntec 2.2: with home grid on an index at 35 % is passed, and the next one is at 135 %."""
    assert calculate("syntec", "is_index_ignored", {"grid": "35", "enabled": "yes"}) is True
    assert calculate("syntec", "home_grid", {"turns": "1.35"}) == pytest.approx(135.0)


def test_a_limit_at_zero_has_no_sign() -> None:
    """grblHAL: without a pull-off the soft limit is at the switch, at 0."""
    file = example("grblhal-router")
    file.set(("homing.pull_off", ""), Value(0.0, "mm"))
    assert "soft limit, 0 mm" in simulate(file, "travel", "X", {}).alarms[0].message


@pytest.mark.parametrize("negative", [0, 1])
@pytest.mark.parametrize("place", [0, 250_000, -90_000_000])
def test_the_six_cases_of_homing_of_a_num_end_with_p16_at_the_encoder_zero(negative: int, place: int) -> None:
    """7-5 to 7-7, 7-10: both directions, with the measurement origin at the zero, elsewhere, and outside of
    the travel, which 7-12 allows. Their figures are lost.
    """
    file = example("num-1060-mill")
    file.set(("travel.homing_negative", ""), Value(negative))
    file.set(("travel.switch_position", "0"), Value(place, "iu"))
    found = simulate(file, "home", "0", {}, advise=False).result
    assert found["home_position"] == (place / 1000.0, "mm")
    assert (found["home_from_start"][0] < 0.0) == bool(negative)


def test_limits_of_a_module_in_the_wrong_order_are_a_motion_fault() -> None:
    """57C422B, 4-10: the negative limit must be below the positive one."""
    file = example("57c422b-label-press")
    file.set(("setup.switches", "Y"), Value(0x401))
    file.set(("setup.overtravel_negative", "Y"), Value(90000, "counts"))
    with pytest.raises(SimulationError, match=r"a motion fault \(4-10\)"):
        simulate(file, "travel", "Y", {})


def test_a_num_jogs_at_its_reduced_speed_while_the_plc_asks_for_it() -> None:
    """6-8: word 3 of P31 is that of linear axes, word 4 that of rotary ones."""
    file = example("num-1060-mill")
    file.set(("servo.reduced_speed_linear", ""), Value(300, "mm/min"))
    file.set(("servo.reduced_speed_rotary", ""), Value(200, "deg/min"))
    for axis, speed, unit in (("0", 300.0, "mm/min"), ("3", 200.0, "deg/min")):
        found = simulate(file, "jog", axis, {"move.speed": "reduced", "move.hold": 0.2}, advise=False)
        assert found.result["feedrate"] == (pytest.approx(speed), unit)


PRINTED_WORDS = {
    ("setup.switches", 0x11C): (
        "Home in Negative",
        "Feedback Marker",
        "Overtravel Switches",
        "Drive Fault Input",
    ),
    ("setup.switches", 0x1D): ("Home Switch", "Home in Negative", "Feedback Marker", "Overtravel Switches"),
    ("setup.encoder", 0x1414): ("Feedback", "Rotary", "Gearing", "Rotary"),
    ("setup.drive", 0x2): ("Drive Reference Polarity",),
}
"""57C422B: words of the printed programs (4-48, 5-5, 5-6), and what their comments name, bit by bit."""


def test_the_printed_words_of_a_module_are_the_bits_that_they_are_taken_for() -> None:
    schema = load_schema("57c422b")
    for (parameter, number), names in PRINTED_WORDS.items():
        bits = [each for each in schema.parameters[parameter].bits or () if number >> each.bit & 1]
        assert len(bits) == number.bit_count() == len(names)
        assert [name for name, bit in zip(names, bits, strict=True) if name not in bit.label] == []
    mode = {each.bit: each for each in schema.parameters["control.mode"].bits or ()}
    assert "Profile" in mode[6].label
    assert not (0x0AD | 0x0AF | 0x0BB) >> 6 & 1  # all three masks clear it
    switches = {each.bit: each for each in schema.parameters["setup.switches"].bits or ()}
    assert switches[12].label == "Enable Gearing Marker Pulse"
    assert [bit for bit, each in switches.items() if "inferred" in each.label and not each.unknown] == []


def test_both_printed_readings_of_coded_homing_are_in_its_result() -> None:
    """9/PC: three markers on 5-5, two on 7-31 and B-1; 1310 is used on 5-14 and not on 5-11."""
    notes = " ".join(simulate(example("lathe-ls176"), "home", "1", {}, advise=False).assumptions)
    assert "pages 7-31 and B-1 say two markers" in notes
    assert "by page 5-11 this position is not used" in notes


def test_the_third_stroke_limit_of_a_syntec_has_its_own_messages() -> None:
    """3.2: MOT-041 and 042 out of it, 045 into it; C83 of the PLC switches it on."""
    file = example("syntec-mill")
    for axis, (low, high) in {"1": (10_000, 25_000), "2": (15_000, 30_000)}.items():
        file.set(("limit.third_negative", axis), Value(low, "BLU"))
        file.set(("limit.third_positive", axis), Value(high, "BLU"))
    move = {"move.start": "0,20", "move.to": "20,20", "move.feedrate": 3000.0, "move.zone": "3"}
    codes = {}
    for scope, start in (("inside", "0,20"), ("outside", "20,20")):
        file.set(("limit.third_scope", ""), Value(scope))
        moved = {**move, "move.start": start, "move.to": "20,20" if scope == "inside" else "30,20"}
        codes[scope] = [alarm.code for alarm in simulate(file, "travel", "1,2", moved).alarms]
    assert codes == {"inside": ["MOT-045"], "outside": ["MOT-041"]}


def test_the_largest_value_of_a_time_cam() -> None:
    """57C422B, 4-50: speed x counts x R129 x 0.00125."""
    given = {"speed": "40", "counts_per_unit": "4000", "time_scans": "1"}
    assert calculate("57c422b", "cam_largest_value", given) == pytest.approx(200.0)


@pytest.mark.parametrize("speed", [600, 1200])
def test_a_num_homes_at_its_jog_speed(speed: int) -> None:
    """7-8, 6-8: word 1 of P31 is the normal JOG speed."""
    file = example("num-1060-mill")
    file.set(("servo.jog_normal", ""), Value(speed, "mm/min"))
    assert simulate(file, "home", "0", {}, advise=False).result["approach_feedrate"][0] == pytest.approx(
        speed
    )


@pytest.mark.parametrize(
    ("tier", "to", "code"),
    [("second", 30, "MOT-037"), ("second", 0, "MOT-038"), ("third", 30, "MOT-041"), ("third", 0, "MOT-042")],
)
def test_each_side_of_the_limits_of_a_syntec_has_its_message(tier: str, to: int, code: str) -> None:
    """3.2: beyond the positive and the negative side."""
    file = example("syntec-mill")
    file.set((f"limit.{tier}_negative", "1"), Value(10_000, "BLU"))
    file.set((f"limit.{tier}_positive", "1"), Value(25_000, "BLU"))
    file.set((f"limit.{tier}_scope", ""), Value("outside"))
    move = {"move.start": "20,20", "move.to": f"{to},20", "move.feedrate": 3000.0}
    zone = {"second": "2", "third": "3"}[tier]
    found = simulate(file, "travel", "1,2", {**move, "move.zone": zone}).alarms
    assert [alarm.code for alarm in found] == [code]


@pytest.mark.parametrize(("code", "first", "step", "program"), [("G", 37, 2, 9010), ("M", 57, 1, 9001)])
def test_codes_of_the_builder_call_all_programs_of_their_row(
    code: str, first: int, step: int, program: int
) -> None:
    """9/PC, 20-5, 20-7: G of 37 to 55 calls 9010 to 9019, M of 57 to 65 calls 9001 to 9009."""
    numbers = [str(101 + n) for n in range({"G": 10, "M": 9}[code])]
    values = {str(first + step * n): number for n, number in enumerate(numbers)}
    modes = {str(38 + 2 * n): "NOT MODAL" for n in range(10)} if code == "G" else {}
    file = example("mill-1394", **values, **modes)
    for n, number in enumerate(numbers):
        assert f"calls the program {program + n}" in read(file, code + number).words[0].meaning


@pytest.mark.parametrize(
    ("param", "letter", "program"), [("33", "T", 9000), ("34", "S", 9029), ("35", "B", 9028)]
)
def test_words_call_their_program(param: str, letter: str, program: int) -> None:
    """9/PC, 20-3."""
    found = word(example("mill-1394", **{param: "True"}), f"{letter}2", letter=letter)
    assert found.meaning == f"calls the program {program} with its number"


def test_a_compatible_acromill_slows_down_in_corners_of_g64_too() -> None:
    """Page 75: Compatibility TRUE is always G62."""
    file, times = example("acromill-router"), {}
    for compatible in (True, False):
        file.set(("compat.no_cutting_mode", ""), Value(compatible))
        for code in ("G62", "G64"):
            path = [code, "G21 G91", "G1 X10 F3000", "X10 Y10", "X-10 Y1"]
            plan = ProgramJob(path, [0.0] * 3, with_contour=False).run(file).plan.whole
            times[compatible, code] = plan.time
    assert times[True, "G64"] == times[True, "G62"] > times[False, "G64"]
