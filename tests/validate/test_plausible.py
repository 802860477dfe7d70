"""What no manual prints: like axes, usual figures, smooth tables, rows and axis words.
All of it is a recommendation.
"""

from collections.abc import Sequence
from pathlib import Path
from random import Random

import pytest
from plausible_machines import RECIPES, false_findings, plausible_machines
from rule_machines import FAMILIES, machines, sound
from typical_machines import WRITERS, machine

from amp_studio.files import ParameterFile, new_file, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.schema import Address, Value
from amp_studio.validate import Finding, Validator, explain, read_builder_rules
from amp_studio.validate.plausible.relations import misfit
from tests.campaigns import CAMPAIGN


def example(name: str) -> ParameterFile:
    return open_file(next((examples_folder() / name).glob("*.amp"))).file


def found(file: ParameterFile, address: Address, value: Value) -> list[Finding]:
    """Return what experience finds after one edit; a full run finds the same."""
    validator = Validator(file)
    assert [f for f in validator.run() if f.rule.startswith("plausible.")] == []
    file.set_checked({address: value}, force="a slip")
    now = [f for f in validator.update([address]) if f.rule.startswith("plausible.")]
    assert now == [f for f in Validator(file).run() if f.rule.startswith("plausible.")]
    return now


@pytest.mark.parametrize("path", sorted(examples_folder().glob("*/*.amp")), ids=lambda path: path.stem)
def test_an_example_has_nothing_to_ask_about(path: Path) -> None:
    assert [f.message for f in Validator(open_file(path).file).run()] == []


@pytest.mark.parametrize(("family", "name"), [(f, n) for f in FAMILIES for n in machines(f)["machines"]])
def test_nor_has_a_sound_machine(family: str, name: str) -> None:
    assert [f.message for f in Validator(sound(family, name)).run() if f.rule.startswith("plausible.")] == []


def test_nor_have_plausible_machines_of_every_family() -> None:
    assert set(RECIPES) <= set(FAMILIES)
    assert false_findings(40 if CAMPAIGN else 1) == []


def test_plausible_machines_are_other_machines() -> None:
    base = example("grblhal-router")
    for file in plausible_machines("grblhal", 5):
        assert sum(value != base.values[address] for address, value in file.values.items()) > 8


def test_one_of_three_like_axes_that_is_ten_times_too_high_is_asked_about() -> None:
    file = example("acromill-router")
    (finding,) = found(file, ("axes.inposition_band", "Y"), Value(0.01, "in"))
    assert finding.severity == "advice"
    assert not finding.fix
    assert finding.causes == (("axes.inposition_band", "Y"),)
    assert finding.compared == (("axes.inposition_band", "X"), ("axes.inposition_band", "Z"))
    assert "0.01 in on Y and 0.001 in on X (ten times the other)" in finding.message
    assert "ours, not the manual's" in finding.cited
    assert finding.page is None
    validator = Validator(file)
    validator.run()
    assert explain(validator, finding).title == "Like axes that differ in one value"


def test_of_two_like_axes_both_are_asked_about() -> None:
    file = example("mill-1394")
    finding = next(f for f in found(file, ("home.speed_off_switch", "1"), Value(2.2333, "mm/s")))
    assert {address[1] for address in finding.causes} == {"1", "2"}


def test_what_differs_among_like_axes_is_no_matter() -> None:
    assert found(example("acromill-router"), ("axes.soft_limit_minus", "Y"), Value(-30.0, "in")) == []
    assert found(example("acromill-router"), ("axes.pulses_per_unit", "Y"), Value(40960.0, "counts/in")) == []
    (tenth,) = found(example("acromill-router"), ("axes.pulses_per_unit", "Y"), Value(2048.0, "counts/in"))
    assert "(a tenth of the other)" in tenth.message


@pytest.mark.parametrize(
    ("param", "value", "words"),
    [
        ("comm.baud_rate", 960, "usual are 300, 600, 1200"),
        ("comm.data_bits", 80, "usual are 7, 8"),
        ("comm.port", -1, "usual are 1, 2, 3, 4"),
        ("control.lead_in_radius", Value(6.35, "in"), "usual is 0.03 to 2 in"),
        ("speeds.trial", Value(-100.0, "in/min"), "usual is 11 to 1900 in/min"),
    ],
)
def test_a_value_that_is_not_usual_is_asked_about(param: str, value: int | Value, words: str) -> None:
    given = value if isinstance(value, Value) else Value(value)
    findings = found(example("acromill-router"), (param, ""), given)
    assert any(words in f.message for f in findings)


def test_a_usual_range_counts_in_every_unit() -> None:
    """0.03 to 2 in are 0.762 to 50.8 mm."""
    assert found(example("acromill-router"), ("control.lead_in_radius", ""), Value(50.0, "mm")) == []
    assert found(example("acromill-router"), ("control.lead_in_radius", ""), Value(51.0, "mm")) != []


def test_a_gain_is_never_negative() -> None:
    findings = found(example("acromill-router"), ("servo.i_gain", "X"), Value(-2.0, "V/count/s"))
    assert any("a negative integral gain has no meaning" in f.message for f in findings)


def test_a_slip_of_the_printed_default_is_asked_about_where_it_has_digits_enough() -> None:
    file = example("mill-1394")
    address: Address = ("feedrate.external_decel_cutting", "")
    assert str(file.default(address))
    assert file.values[address] == file.default(address)
    (finding,) = found(file, address, Value(4.2333, "mm/s"))
    assert "that is ten times the printed default" in finding.message


@pytest.mark.parametrize(
    ("instance", "value", "words"),
    [
        ("1", Value(8.46666, "mm/s"), "twice"),
        ("4", Value(42.3333, "deg/s"), "ten times"),  # the manual prints one number, 37-3
        ("1", Value(0.42333, "mm/s"), "a tenth of"),  # the last digit went
    ],
)
def test_a_default_of_many_digits_is_known_doubled_rounded_and_on_a_rotary_axis(
    instance: str, value: Value, words: str
) -> None:
    findings = found(example("mill-1394"), ("accdec.velocity_step", instance), value)
    assert any(f"{words} the printed default" in f.message for f in findings)


@pytest.mark.parametrize(
    ("name", "address", "value"),
    [
        ("mill-1394", ("macro.m_code", "9001"), Value(1)),
        ("num-1060-mill", ("comm.dnc1_character", "STX"), Value(0x20, "")),
        ("syntec-mill", ("axis.port", "3"), Value(76)),
        ("acromill-router", ("axes.soft_limit_minus", "X"), Value(-711.2, "in")),
        ("linuxcnc-mill", ("joint.max_velocity", "0"), Value(4216.4, "mm/s")),
    ],
)
def test_what_no_manual_bounds_has_a_range_of_experience(name: str, address: Address, value: Value) -> None:
    file = example(name)
    unit = file.values[address].unit
    findings = found(file, address, Value(value.value, unit))
    assert any(f.rule == "plausible.usual" for f in findings)


def test_a_point_of_a_calibration_that_jumps_out_is_asked_about() -> None:
    """Deviations of a screw that was measured: a line, a wave of the screw, and noise of a micrometre."""
    deviations = [0, 2.1, 4.9, 6.8, 9.2, 11.1, 12.7, 13.4, 15.2, 16.1, 18.3, 19.2]
    file = example("mill-1394")
    address = ("calibration.table", "1")

    def jumps(micrometres: Sequence[float]) -> list[str]:
        points = " ".join(f"{-50 * (11 - n)}:{um / 1000:g}" for n, um in enumerate(micrometres))
        file.set(address, Value(f"deviation - mm {points}"))
        return [f.message for f in Validator(file).run() if f.rule == "plausible.jump"]

    assert jumps(deviations) == []
    (message,) = jumps([*deviations[:5], 111, *deviations[6:]])
    assert message.endswith(
        ", -300:0.111 is 0.111 between 0.0092 and 0.0127: it alone jumps out of its table. Is it meant?"
    )
    validator = Validator(file)
    validator.run()
    for text in ("", "deviation - mm 0:0"):
        file.set(address, Value(text))
        assert validator.update([address]) == Validator(file).run()


def test_a_point_of_a_cam_that_jumps_out_is_asked_about_and_a_corner_is_not() -> None:
    file = example("57c422b-label-press")
    finding, drift = found(file, ("cam.time_points", "Y.5"), Value(141, "counts"))
    assert (finding.rule, drift.rule) == ("plausible.jump", "plausible.not-closed")
    assert "between" in finding.message
    corner = example("57c422b-label-press")
    corner.set_checked(
        {("cam.time_points", f"Y.{n}"): Value(min(n, 16) * 100, "counts") for n in range(32)},
        force="a corner",
    )
    assert [f for f in Validator(corner).run() if f.rule == "plausible.jump"] == []


def test_a_row_that_is_off_by_a_slip_is_asked_about() -> None:
    findings = found(example("num-1060-mill"), ("misc.potentiometer", "3"), Value(210, "%"))
    finding = next(each for each in findings if each.rule == "plausible.row")
    assert "two digits swapped against the 120 %" in finding.message
    assert found(example("num-1060-mill"), ("misc.potentiometer", "3"), Value(100, "%")) == []


def test_a_bit_of_an_axis_that_is_not_there_is_asked_about() -> None:
    (finding,) = found(example("num-1060-mill"), ("axes.modulo", ""), Value(0x48))
    assert finding.message.endswith("has the bit of axis 6, which is not there. Is it meant?")


def test_a_zone_outside_the_travel_is_asked_about_whichever_of_them_slipped() -> None:
    """The travel of X is -500 to 8 mm, its zone 2 from -498 to -420 mm, and it homes at 6 mm."""
    findings = found(example("mill-1394"), ("zone.limit2_min", "1"), Value(-4980.0, "mm"))
    (message,) = [f.message for f in findings if f.rule == "plausible.outside-travel"]
    assert message.endswith("is -4980 mm, outside the travel of its axis from -500 mm to 8 mm. Is it meant?")
    findings = found(example("mill-1394"), ("zone.overtravel_negative", "1"), Value(-50.0, "mm"))
    outside = {f.causes[0][0] for f in findings if f.rule == "plausible.outside-travel"}
    assert outside == {"zone.limit2_min", "zone.limit2_max", "zone.limit3_min", "zone.limit3_max"}


def test_what_decides_which_axes_there_are_is_a_reason_to_check_all() -> None:
    file = example("acromill-router")
    validator = Validator(file)
    validator.run()
    for address, value in (
        (("axes.inposition_band", "Z"), Value(0.01, "in")),
        (("view.number_of_axes", ""), Value(2)),
        (("view.number_of_axes", ""), Value(3)),
    ):
        file.set_checked({address: value}, force="a test")
        assert validator.update([address]) == Validator(file).run()


def test_what_is_intended_is_suppressed_as_any_finding(tmp_path: Path) -> None:
    rules = tmp_path / "rules.yaml"
    rules.write_text(
        "suppressions:\n"
        "  - {rule: plausible.alike, params: [axes.inposition_band@Y], reason: worn scale, by: M. Brandt}\n",
        encoding="utf-8",
    )
    file = example("acromill-router")
    file.set(("axes.inposition_band", "Y"), Value(0.01, "in"))
    validator = Validator(file, read_builder_rules(rules, file.schema))
    assert [f.rule for f in validator.run()] == []
    assert [s.finding.rule for s in validator.suppressed] == ["plausible.alike"]


def test_a_value_out_of_its_range_is_not_asked_about_too() -> None:
    file = example("mill-1394")
    file.set_checked({("tool.pocket_count", ""): Value(-24)}, force="a slip")
    assert [f.rule for f in Validator(file).run() if ("tool.pocket_count", "") in f.causes] == [
        "schema.range"
    ]


def rules(file: ParameterFile, *edits: tuple[Address, Value]) -> list[str]:
    """Return the rules of experience after some edits, and that every order of looking finds the same."""
    validator = Validator(file)
    validator.run()
    file.set_checked(dict(edits), force="a test")
    now = validator.update([address for address, _ in edits])
    assert now == Validator(file).run()
    return [f.rule for f in now if f.rule.startswith("plausible.")]


def cam(steps: list[int]) -> list[str]:
    edits = [(("cam.time_points", f"Y.{n}"), Value(step, "counts")) for n, step in enumerate(steps)]
    file = example("57c422b-label-press")
    return rules(file, (("cam.points", "Y"), Value(len(steps))), *edits)


def test_a_time_cam_that_nearly_comes_back_drifts_and_one_that_feeds_does_not() -> None:
    """Its values are relative changes of position (4-49): what is left at the end is added each time."""
    out, back = [100, 300, 500, 300, 100], [-100, -300, -500, -300, -100]
    assert "plausible.not-closed" not in cam(out + back + [0, 0])
    assert "plausible.not-closed" in cam(out + back + [0, 10])
    assert "plausible.not-closed" not in cam(out + out + back + [0, 0]), "a pilgrim step"
    assert "plausible.not-closed" not in cam(out + out + [0, 0]), "a feed"


def test_a_time_cam_that_turns_back_in_a_single_step_is_asked_about() -> None:
    forward = [100, 200, 300, 400, 400, 400, 400, 300, 200, 100]
    assert "plausible.turn-back" in cam([*forward[:8], -200, 100])
    assert "plausible.turn-back" not in cam(forward)


@pytest.mark.parametrize(
    ("name", "address", "value", "rule"),
    [
        ("mill-1394", ("accdec.linear_acceleration", "4"), Value(2540.0, "deg/s2"), "plausible.unequal"),
        ("mill-1394", ("jog.increment_third", "4"), Value(0.2, "deg"), "plausible.ladder"),
        ("mill-1394", ("macro.type1_call", "9013"), Value("modal"), "plausible.needs"),
        ("mill-1394", ("powerup.distance_mode", ""), Value("g91"), "plausible.usual"),
        ("mill-1394", ("interrupt.trigger", "2"), Value("level"), "plausible.row"),
        ("num-1060-mill", ("misc.potentiometer", "3"), Value(0, "%"), "plausible.row"),
        ("num-1060-mill", ("qvn.axes", "7"), Value(4), "plausible.row"),
        ("linuxcnc-mill", ("joint.min_limit", "0"), Value(-600.0, "mm"), "plausible.unequal"),
        ("grblhal-router", ("axis.acceleration", "Z"), Value(20000.0, "mm/s2"), "plausible.quotient"),
        ("grblhal-router", ("axis.steps", "Y"), Value(320.0, "steps/mm"), "plausible.table"),
        ("grblhal-router", ("axis.max_travel", "Y"), Value(40.0, "mm"), "plausible.travel"),
        ("grblhal-router", ("axis.max_travel", "Y"), Value(78.0, "mm"), "plausible.travel"),
        ("grblhal-router", ("general.junction_deviation", ""), Value(0.1, "mm"), "plausible.usual"),
        ("grblhal-router", ("spindle.min_speed", ""), Value(600.0, "rpm"), "plausible.proportion"),
        ("grblhal-router", ("general.arc_tolerance", ""), Value(0.02, "mm"), "plausible.seldom"),
        ("num-1060-mill", ("travel.limit_min", "0"), Value(-25400, "iu"), "plausible.travel"),
        ("num-1060-mill", ("travel.limit_min", "0"), Value(1000, "iu"), "plausible.travel"),
        ("num-1060-mill", ("travel.limit_max", "1"), Value(12000, "iu"), "plausible.travel"),
        ("num-1060-mill", ("travel.limit_min", "0"), Value(0, "iu"), "plausible.travel"),
        ("num-1060-mill", ("measure.divi", "0"), Value(51), "plausible.among-axes"),
        ("num-1060-mill", ("spindle.range_min", "1.42"), Value(0, "rpm"), "plausible.gear"),
        ("num-1060-mill", ("spindle.range_max", "1.42"), Value(20000, "rpm"), "plausible.gear"),
        ("num-1060-mill", ("spindle.range_max", "1.44"), Value(2000, "rpm"), "plausible.gear"),
        ("linuxcnc-mill", ("joint.pid_p", "2"), Value(300.0), "plausible.alike"),
        ("linuxcnc-mill", ("joint.home_offset", "0"), Value(152.4, "mm"), "plausible.outside-travel"),
        ("linuxcnc-mill", ("joint.home_search_velocity", "2"), Value(-30.0, "mm/s"), "plausible.towards"),
        ("linuxcnc-mill", ("axis.max_velocity", "X"), Value(125.0, "mm/s"), "plausible.unequal"),
        ("grblhal-router", ("axis.acceleration", "Z"), Value(2000.0, "mm/s2"), "plausible.upright"),
        ("grblhal-router", ("axis.acceleration", "Z"), Value(20.0, "mm/s2"), "plausible.upright"),
        ("grblhal-router", ("axis.max_travel", "Z"), Value(2413.0, "mm"), "plausible.travel"),
        ("syntec-mill", ("axis.servo_mode", "2"), Value("voltage"), "plausible.uniform"),
        ("syntec-mill", ("axis.port", "2"), Value(0), "plausible.counted"),
        ("syntec-mill", ("axis.port", "4"), Value(8), "plausible.counted"),
        ("syntec-mill", ("limit.third_negative", "4"), Value(0, "BLU"), "plausible.travel"),
        ("syntec-mill", ("limit.third_negative", "4"), Value(999999999, "BLU"), "plausible.travel"),
        ("num-1060-mill", ("servo.jog_normal", ""), Value(6000, "mm/min"), "plausible.ladder"),
        ("57c422b-label-press", ("gain.feedforward", "Y"), Value(0), "plausible.among-axes"),
        ("57c422b-label-press", ("gearing.modes", "X"), Value(0x2000), "plausible.usual"),
        (
            "57c422b-label-press",
            ("setup.overtravel_positive", "Y"),
            Value(8400, "counts"),
            "plausible.stroke",
        ),
    ],
)
def test_what_belongs_together_and_does_not_fit_is_asked_about(
    name: str, address: Address, value: Value, rule: str
) -> None:
    findings = found(example(name), address, value)
    finding = next(f for f in findings if f.rule == rule)
    assert (finding.severity, finding.page, finding.message[-12:]) == ("advice", None, "Is it meant?")
    assert "ours, not the manual's" in finding.cited


@pytest.mark.parametrize(
    ("name", "address", "value"),
    [
        ("acromill-router", ("home.fast_speed", "X"), Value(300.0, "in/min")),
        ("syntec-mill", ("jog.feedrate", "1"), Value(99900.0, "mm/min")),
        ("57c422b-label-press", ("command.home_speed_low", "X"), Value(200000.0, "counts/s")),
        ("linuxcnc-mill", ("joint.home_final_velocity", "0"), Value(400.0, "mm/s")),
        ("grblhal-router", ("tool_change.seek_rate", ""), Value(9000.0, "mm/min")),
    ],
)
def test_homing_and_jogging_above_rapid_are_asked_about(name: str, address: Address, value: Value) -> None:
    file = example(name)
    assert "plausible.above-rapid" in rules(file, (address, value))


@pytest.mark.parametrize(
    "settings",
    [
        {("axis.max_travel", "X"): Value(6200.0, "mm"), ("axis.max_travel", "Y"): Value(1400.0, "mm")},
        {("axis.acceleration", "Y"): Value(250.0, "mm/s2")},
        {("axis.max_rate", "X"): Value(12000.0, "mm/min")},
        {("general.mode", ""): Value("laser_mode")},
        {
            ("homing.locate_rate", ""): Value(25.0, "mm/min"),
            ("homing.seek_rate", ""): Value(5000.0, "mm/min"),
        },
    ],
)
def test_what_published_machines_have_is_not_asked_about(settings: dict[Address, Value]) -> None:
    file = example("grblhal-router")
    file.set_checked(settings, force="as published")
    assert [f.message for f in Validator(file).run() if f.rule.startswith("plausible.")] == []


@pytest.mark.parametrize("family", sorted(WRITERS))
def test_typical_machines_have_nothing_to_ask_about(family: str) -> None:
    """``make campaign`` makes 40; one of them may have a recommendation."""
    random, count = Random(f"{family}1"), 40 if CAMPAIGN else 2
    made = [Validator(machine(family, random)).run() for _ in range(count)]
    assert [f for found in made for f in found if f.severity != "advice"] == []
    assert sum(bool(found) for found in made) <= count // 40, made


@pytest.mark.parametrize(
    ("name", "edits"),
    [
        ("linuxcnc-mill", [(("joint.encoder_scale", "0"), Value(-1574.803))]),
        ("linuxcnc-mill", [(("joint.output_scale", "1"), Value(-20.0))]),
        ("acromill-router", [(("home.acceleration", axis), Value(100.0, "mm/s2")) for axis in "XYZ"]),
        ("syntec-mill", [(("feed.rapid", "3"), Value(12000, "mm/min"))]),
        ("57c422b-label-press", [(("setup.max_position_error", a), Value(2000, "counts")) for a in "XY"]),
    ],
)
def test_what_typical_machines_have_is_not_asked_about(name: str, edits: list[tuple[Address, Value]]) -> None:
    """A motor mounted the other way, a ramp in mm/s2 as round as the default in inches, a slower head."""
    file = example(name)
    if name == "acromill-router":
        edits += [
            ((f"home.{other}", axis), Value(100.0, "mm/s2"))
            for other in ("deceleration", "stop")
            for axis in "XYZ"
        ]
    assert rules(file, *edits) == []


def test_digits_are_swapped_in_the_figures_that_were_written() -> None:
    """7.5 mm/s and 9 mm/s are 450 and 540 mm/min."""
    speeds = [
        (("joint.home_final_velocity", n), Value(v, "mm/s"))
        for n, v in zip("012", (9.0, 9.0, 7.5), strict=True)
    ]
    assert rules(example("linuxcnc-mill"), *speeds) == []
    swapped = (("joint.home_final_velocity", "2"), Value(19.0, "mm/s"))
    same = [(("joint.home_final_velocity", n), Value(91.0, "mm/s")) for n in "01"]
    assert rules(example("linuxcnc-mill"), swapped, *same) == ["plausible.alike"]


def test_joints_of_other_kinematics_are_no_axes() -> None:
    """A delta has towers as joints, whose travel is not that of X."""
    file = example("linuxcnc-mill")
    unequal = (("joint.max_limit", "0"), Value(12.0, "mm"))
    assert "plausible.unequal" in rules(file, unequal)
    delta = (("kins.kinematics", ""), Value("lineardeltakins"))
    assert "plausible.unequal" not in rules(file, delta)


def test_limits_that_are_not_set_are_no_travels() -> None:
    file = example("syntec-mill")
    zeros = {a: Value(0, v.unit) for a, v in file.values.items() if a[0].startswith("limit.third_")}
    file.set_checked({a: v for a, v in zeros.items() if a[0].endswith("tive")}, force="not used")
    assert [f.message for f in Validator(file).run() if f.rule == "plausible.travel"] == []


def test_a_ladder_that_ends_at_the_greatest_speed_is_one() -> None:
    assert misfit([10, 50, 250, 1000, 5000]) is None
    assert misfit([10, 100, 1000, 10000, 15000]) is None
    assert misfit([1, 10, 20, 50, 100]) is None
    assert misfit([10, 50, 500, 1000, 5000]) == 2
    assert misfit([0.001, 0.01, 0.1, 1, 100]) == 4


def test_what_an_axis_has_not_set_is_not_taken_from_another_one() -> None:
    """A listing in which Y has a rate and no acceleration: that of X is no measure of it."""
    file = new_file("grblhal", None, ["X", "Y", "Z"])
    for n in list(file.values):
        if n[0].startswith("axis."):
            file.set(n, None)
    file.set(("axis.acceleration", "X"), Value(25.0, "mm/s2"))
    file.set(("axis.max_rate", "Y"), Value(5001.0, "mm/min"))
    assert [f.message for f in Validator(file).run() if f.rule == "plausible.quotient"] == []
    file.set(("axis.acceleration", "Y"), Value(25.0, "mm/s2"))
    assert [f.rule for f in Validator(file).run() if f.rule == "plausible.quotient"] == ["plausible.quotient"]
