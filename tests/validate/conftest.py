"""Sound machines, in which nothing is to be found, and for every rule the changes that break it and that just do not."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import pytest
from ruamel.yaml import YAML

from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import Address, Value
from amp_studio.validate import Finding, Validator

Change = Mapping[str, str | None]
"""``id@instance`` -> the value as a person writes it; None takes the value away."""

CONTROL = {
    "feedrate.f1_rapid_override": "25 %",
    "feedrate.use_skip_feedrate": "yes",
    "feedrate.skip_g31": "500 mm/min",
    "feedrate.skip_g31_2": "400 mm/min",
    "feedrate.skip_g31_3": "300 mm/min",
    "feedrate.skip_g31_4": "200 mm/min",
    "feedrate.circular_tolerance": "0.02 mm",
    "feedrate.external_decel_cutting": "600 mm/min",
    "accdec.programmed_delay": "5",
    "timing.fine_foreground": "16 ms",
    "timing.scans_per_logic": "2",
    "timing.logic_warning": "40 ms",
    "servo.sercos_cycle": "2 ms",
    "servo.sercos_baud": "4 MHz",
    "zone.group_count": "2",
    "control.reset_on_estop_reset": "yes",
    "control.trigger_point": "rising",
    "control.dwell_type": "time",
    "control.auxiliary_word": "none",
    "control.block_delete": "whole",
    "control.reset_codes": "yes",
    "control.reset_offsets": "yes",
    "control.cancel_tool_offsets": "no",
    "control.retrace_limit": "5",
    "control.retrace_limit@1": "5",
    "control.retrace_limit@2": "5",
    "control.reset_g92": "yes",
    "control.reset_g92@1": "yes",
    "control.reset_g92@2": "yes",
    "password.character@1": "77",
    "oci.connections": "1",
    "oci.transfer_rate": "100 ms",
    "oci.monitor_interval": "50 ms",
    "oci.foreground_buffer": "500",
    "oci.background_buffer@1": "5000",
    "patch.dac_monitor@2": "0",
    "patch.dac_monitor@3": "0",
}

CYCLES = {
    "cycle.peck_retract": "1 mm",
    "cycle.fine_boring_q": "yes",
    "cycle.fine_boring_shift@17": "Primary axis 1 positive",
    "cycle.fine_boring_shift@18": "Primary axis 2 negative",
    "cycle.fine_boring_shift@19": "Primary axis 1 negative",
    "cycle.clearance": "0.5 mm",
    "cycle.tapping_dwell_ignored": "yes",
    "cycle.rapid_to_hole": "yes",
    "virtual_c.park_location": "Nearest To Machine Zero",
    "probing.probe_length": "80 mm",
    "probing.probe_radius": "3 mm",
    "probing.transition": "Low to High",
}

MILL_CYCLES = CYCLES | {
    "cycle.drilling_axis": "none",
    "cylindrical.feed_axis": "z",
    "cylindrical.park_axis": "y",
    "cylindrical.linear_axis": "x",
    "cylindrical.feed_coordinate": "-300 mm",
    "cylindrical.park_coordinate": "10 mm",
    "probing.approach_distance": "20 mm",
    "probing.tolerance_band": "2 mm",
    "probing.approach_rate": "600 mm/min",
    "probing.probe_rate": "60 mm/min",
}

LATHE_CYCLES = CYCLES | {
    "cycle.drilling_axis": "Axis 2",
    "cycle.pullout_distance": "1.5",
    "cycle.pullout_angle": "45 deg",
    "cycle.min_infeed": "0.03 mm",
    "cycle.finish_allowance": "0.05 mm",
    "cycle.turning_repeat": "no",
    "cycle.grooving_retract": "0.5 mm",
    "roughing.retract": "0.5 mm",
    "roughing.depth_percent": "100 %",
    "roughing.finish_cut": "False",
    "roughing.threshold": "0.1 mm",
    "virtual_c.rotary_axis": "c",
    "virtual_c.end_face_axis": "y",
    "virtual_c.end_face_incremental": "v",
    "virtual_c.end_face_integrand": "j",
    "virtual_c.center_line_axis": "z",
    "virtual_c.auto_home": "no",
}

LOGIC = {f"logic.analog_connector@{n}": "none" for n in range(1, 5)} | {
    f"logic.analog_rack@{n}": "1" for n in range(1, 5)
}

MACROS = (
    {"macro.word_call@T": "yes", "macro.word_call@S": "no", "macro.word_call@B": "no"}
    | {f"macro.type1_call@{n}": "not-used" for n in range(9010, 9020)}
    | {"macro.type1_call@9010": "not-modal", "macro.type1_g_code@9010": "100"}
    | {"macro.type1_call@9019": "modal", "macro.type1_g_code@9019": "109", "macro.modality": "g66"}
    | {"macro.type2_call@1": "not-modal", "macro.type2_g_code@1": "231.6", "macro.type2_program@1": "100"}
    | {"macro.type2_call@2": "modal", "macro.type2_g_code@2": "232", "macro.type2_program@2": "101"}
    | {"macro.type2_call@3": "not-used"}
    | {f"macro.m_code@{n}": "-1" for n in range(9001, 9010)}
    | {"macro.m_code@9002": "102", "macro.m_code@9009": "100"}
    | {"macro.in_mdi": "macro-call", "macro.when_nested": "system-code"}
)
"""A G-code of each type for a modal and one for a simple macro, and two M-codes."""

INTERRUPTS = {"interrupt.enable_m_code": "90", "interrupt.disable_m_code": "91"} | {
    f"interrupt.{name}@{n}": choice
    for name, choice in (("trigger", "edge"), ("call", "macro"), ("service", "delayed"))
    for n in range(4)
}

DRIVEN_TOOLS = {"spindle.gain@2.1": "20"}
"""So high a gain that the spindle taps within the following error of its axis."""

CONTROL |= LOGIC | MACROS | INTERRUPTS


def planes(*axes: str) -> dict[str, str]:
    """Return the planes G17, G18 and G19; each is two primary axes with their parallel ones behind them."""
    fields = ("primary_{}", "parallel_{}_first", "parallel_{}_second")
    return {
        f"plane.{field.format(side)}@{code}": name
        for code, plane in zip((17, 18, 19), axes, strict=True)
        for side, names in enumerate(plane.split() if plane else ("", ""), 1)
        for field, name in zip(fields, [*names, "none", "none", "none"], strict=False)
    }


CONTROL |= {
    "format.leading_zeros": "Disabled",
    "format.trailing_zeros": "Disabled",
    "format.missing_number": "Enabled",
    "letter.d_integer": "2.0",
    "letter.f_per_minute": "4.3-5.2",
    "letter.f_per_revolution": "2.4-3.3",
    "letter.p_dwell": "decimal",
    "letter.p_integer": "5.0",
    "letter.q_word": "3.4-4.3",
    "letter.q_thread_angle": "3.1",
    "letter.r_word": "3.4-4.3",
    "letter.s_css": "4.2-3.3",
    "letter.s_orient": "3.1",
    "letter.s_rpm": "5.0",
    "letter.t_integer": "4",
    "letter.chamfer": "3.4-4.3",
    "powerup.feed_mode": "per-minute",
    "powerup.inch_metric": "metric",
    "powerup.motion": "g01",
    "powerup.distance_mode": "g90",
    "powerup.work_coordinate": "none",
    "powerup.zones": "g23",
    "powerup.return_level": "init-level",
    "powerup.path_mode": "g64",
    "powerup.comp_corner": "g39",
    "powerup.short_block": "g36",
    "powerup.short_block@1": "g36",
    "powerup.short_block@2": "g36",
    "powerup.accdec_mode": "g47",
    "powerup.accdec_mode@1": "g47",
    "powerup.accdec_mode@2": "g47",
    "powerup.synch_mode": "g60",
    "quickpath.angle_word": ",A",
    "quickpath.angle_format": "3.2",
    "quickpath.line_format": "3.4-4.3",
}
"""Words of programs and what the control powers up with."""

MILL_WORDS = {
    "letter.f_inverse_time": "5.3",
    "letter.h_integer": "2.0",
    "letter.h_word": "3.4-4.3",
    "letter.r_angle": "3.3",
    "powerup.plane": "g17",
    "powerup.tool_length": "g49",
}
LATHE_WORDS = {
    "control.threading_word": "lead",
    "letter.d_word": "3.4-4.3",
    "letter.e_threads": "2.4",
    "letter.lead": "2.4-3.3",
    "letter.q_integer": "4.0",
    "powerup.plane": "g18",
    "powerup.radius_diameter": "g07",
}
TABLE = {"axis.rollover": "360", "format.axis_word": "3.3"}
"""What a rotary axis has besides."""

MOVING = {
    "logic.only_axis": "no",
    "axis.integrand_name": "none",
    "control.scaling_allowed": "yes",
    "home.direction_off_switch": "negative",
    "home.calibration": "1.5 mm",
    "home.speed_off_switch": "120 mm/min",
    "home.g28_direction": "plus",
    "home.g28_speed": "3000 mm/min",
    "home.g30_position": "50 mm",
    "zone.group": "g2",
    "zone.limit2_min": "-100 mm",
    "zone.limit2_max": "100 mm",
    "zone.limit3_min": "-50 mm",
    "zone.limit3_max": "50 mm",
    "zone.overtravel_used": "yes",
    "zone.overtravel_positive": "400 mm",
    "zone.overtravel_negative": "-400 mm",
    "feedrate.rapid": "12000 mm/min",
    "feedrate.max_cutting": "6000 mm/min",
    "feedrate.external_decel_positioning": "1000 mm/min",
    "accdec.velocity_step": "100 mm/min",
    "accdec.linear_acceleration": "500 mm/s2",
    "accdec.linear_deceleration": "500 mm/s2",
    "accdec.scurve_acceleration": "600 mm/s2",
    "accdec.scurve_deceleration": "600 mm/s2",
    "accdec.jerk": "5000 mm/s3",
    "accdec.min_jerk": "500 mm/s3",
    "accdec.manual_delay": "5",
    "servo.lead_screw_pitch": "10 mm",
    "servo.excess_error": "15 mm",
    "servo.feedrate_suppression": "13.5 mm",
    "servo.gain_break_point": "8 mm",
    "servo.inposition_band": "0.02 mm",
    "servo.initial_gain": "1",
    "servo.gain_break_ratio": "1",
    "servo.feed_forward": "50 %",
}
"""A slide or a table; the lengths of a table are degrees."""

DIGITAL = {
    "servo.hardware_type": "sercos",
    "servo.loop_type": "digital",
    "servo.position_loop_type": "closed",
    "servo.position_feedback_type": "hiperface-absolute",
    "servo.position_counts": "1048576",
    "servo.velocity_feedback_type": "hiperface-absolute",
    "servo.velocity_counts": "1048576",
    "servo.velocity_proportional_gain": "6000",
    "servo.velocity_integral_gain": "500",
    "servo.peak_current": "300%",
    "servo.motor_type": "b410g",
    "servo.motor_poles": "p4",
    "servo.max_motor_speed": "1400 rpm",
    "servo.motor_rated_current": "5 A",
    "servo.amplifier_type": "kw5",
    "servo.amplifier_rack": "1",
}

ANALOG = {
    "servo.hardware_type": "sercos",
    "servo.loop_type": "analog",
    "servo.position_loop_type": "closed",
    "servo.position_feedback_type": "inc-narrow",
    "servo.position_counts": "8000",
    "servo.velocity_feedback_type": "inc-narrow",
    "servo.velocity_counts": "8000",
    "servo.analog_positive_voltage": "8 V",
    "servo.analog_negative_voltage": "-8 V",
    "servo.max_acceleration": "120000 mm/min/s",
    "servo.amplifier_rack": "1",
}

SERCOS = {
    "servo.hardware_type": "sercos",
    "servo.loop_type": "sercos",
    "servo.position_loop_type": "closed",
    "servo.amplifier_rack": "2",
}


SPINDLE = {
    "zone.group": "none",
    "zone.overtravel_used": "no",
    "accdec.manual_delay": "5",
    "servo.position_loop_type": "open",
    "axis.integrand_name": "none",
    "axis.incremental_name": "none",
    "control.scaling_allowed": "no",
}

SCALE = {"servo.position_feedback_type": "aqb-one-marker", "servo.position_counts": "40000"}
"""A linear scale: its counts over one lead of the screw."""


def connected(output: str, position: str, velocity: str = "none") -> dict[str, str]:
    """Return the connectors of a motor and its devices."""
    return {"servo.output_port": output, "servo.position_port": position, "servo.velocity_port": velocity}


MILL = (
    ("X", MOVING | DIGITAL | connected("mod1", "j1", "j1") | {"axis.integrand_name": "i"}),
    (
        "Y",
        MOVING
        | DIGITAL
        | connected("mod2", "j2", "j2")
        | {"axis.integrand_name": "j", "servo.position_loop_type": "zfe"},
    ),
    ("Z", MOVING | DIGITAL | connected("mod3", "j9", "j3") | {"axis.integrand_name": "k"} | SCALE),
    ("B", MOVING | DIGITAL | connected("mod4", "j4", "j4") | TABLE),
    ("U", MOVING | ANALOG | DIGITAL | connected("mod1", "j1", "j1") | SERCOS | {"axis.integrand_name": "i"}),
    ("V", MOVING | ANALOG | connected("tb2", "j10") | {"axis.integrand_name": "j"}),
    ("S", MOVING | ANALOG | SPINDLE | connected("tb3", "j11") | {"servo.spindle_type": "s1"}),
)
"""Four digital servos (a slide on the device of its motor, one without following error, one on a linear scale, a
table), a drive of another make on the ring, an analog slide and an analog spindle."""

LATHE = (
    (
        "X",
        MOVING
        | DIGITAL
        | connected("mod1", "j1", "j1")
        | {"axis.incremental_name": "u", "axis.integrand_name": "i"},
    ),
    (
        "Z",
        MOVING
        | DIGITAL
        | connected("mod2", "j2", "j2")
        | {"axis.incremental_name": "w", "axis.integrand_name": "k"},
    ),
    (
        "C",
        MOVING | DIGITAL | connected("mod3", "j3", "j3") | TABLE | {"axis.incremental_name": "none"},
    ),
    ("S", MOVING | DIGITAL | SPINDLE | connected("mod4", "j4", "j4") | {"servo.spindle_type": "s1"}),
    ("S", MOVING | ANALOG | SPINDLE | connected("tb2", "j9") | {"servo.spindle_type": "s2"}),
)
"""Two slides, a digital main spindle with its C axis, and an analog spindle for driven tools."""

ROUTER = (
    ("W", MOVING | ANALOG | connected("mod1", "j9") | SERCOS),
    ("X", MOVING | ANALOG | connected("mod1", "j9")),
    ("Y", MOVING | ANALOG | connected("mod2", "j10")),
    ("Z", MOVING | ANALOG | connected("mod3", "j11")),
    ("A", MOVING | ANALOG | connected("mod4", "j12") | TABLE),
    ("U", MOVING | ANALOG | connected("tb2", "j9") | {"servo.amplifier_rack": "3"}),
    ("V", MOVING | ANALOG | connected("tb3", "j10") | {"servo.amplifier_rack": "3"}),
)
"""Analog servos and no digital one, and a drive of another make."""

MACHINES = {
    "mill": (
        "mill",
        CONTROL
        | MILL_WORDS
        | MILL_CYCLES
        | {
            "control.mill_type": "standard",
            "servo.standard_motor_values": "no",
            "cylindrical.rotary_axis": "b",
        }
        | planes("xu yv", "z xu", "yv z"),
        MILL,
    ),
    "lathe": (
        "lathe",
        CONTROL
        | LATHE_WORDS
        | LATHE_CYCLES
        | DRIVEN_TOOLS
        | {"control.lathe_type": "a", "axis.diameter_axis_name": "x"}
        | planes("", "z x", ""),
        LATHE,
    ),
    "router": (
        "mill",
        CONTROL
        | MILL_WORDS
        | MILL_CYCLES
        | {"control.mill_type": "standard", "cylindrical.rotary_axis": "a"}
        | planes("xu yv", "zw xu", "yv zw"),
        ROUTER,
    ),
}


def change(file: ParameterFile, texts: Change) -> list[Address]:
    """Write values into a file as a person would, out of range if it must be; returns where."""
    wanted: dict[Address, Value | None] = {}
    for name, text in texts.items():
        address = file.find(name)
        written = str(text).replace("mm", "deg") if file.situation.turns(address) else str(text)
        wanted[address] = None if text is None else file.read(address, written)
    file.set_many(wanted, force="by a test")
    return list(wanted)


def sound(name: str) -> ParameterFile:
    """Return a machine in which nothing is to be found."""
    machine, control, axes = MACHINES[name]
    file = new_file("9pc", machine, [axis for axis, _ in axes])
    change(file, control)
    change(
        file, {f"{name}@{n}": text for n, (_, texts) in enumerate(axes, 1) for name, text in texts.items()}
    )
    return file


# ------------------------------------------------------------------------- machines that are broken and mended


class Stand:
    """A machine on which changes are tried and taken back."""

    def __init__(self, machine: str) -> None:
        self.file = sound(machine)
        self.validator = Validator(self.file)
        self.findings = self.validator.run()

    @contextmanager
    def changed(self, texts: Change) -> Iterator[tuple[Finding, ...]]:
        """Make changes; gives the findings, and takes the changes back at the end."""
        with self.recorded():
            self.findings = self.validator.update(change(self.file, texts) or self.file.addresses())
            yield self.findings

    @contextmanager
    def recorded(self) -> Iterator[None]:
        """Take back at the end whatever is changed."""
        values, forced = dict(self.file.values), dict(self.file.forced)
        try:
            yield
        finally:
            touched = {
                a for a in values.keys() | self.file.values.keys() if values.get(a) != self.file.values.get(a)
            }
            for address in touched:
                self.file.set(address, values.get(address))
            marks = forced.keys() ^ self.file.forced.keys()
            self.file.forced.clear()
            self.file.forced.update(forced)
            self.findings = self.validator.update(touched | marks)


@cache
def stand(machine: str) -> Stand:
    return Stand(machine)


@dataclass(frozen=True)
class Case:
    """One way to break a rule, and one that nearly does.

    Values are written as a person writes them; the lengths of a table or a spindle are degrees.
    """

    rule: str
    n: int
    of: str
    """The machine it starts from."""
    given: Change = field(default_factory=dict)
    """What is changed beforehand; may cause findings of its own, but not of this rule."""
    breaks: Change | None = None
    times: int = 1
    """How many findings of the rule that gives."""
    holds: Change | None = None
    """A change after which it is not broken: where it can be, the next value on the good side of the bound, or the
    same change where the rule does not apply; {} is the machine as it stands."""

    def __str__(self) -> str:
        return f"{self.rule}-{self.n}"


@cache
def cases() -> tuple[Case, ...]:
    """Read the tables of ``rule_cases/``, one for each file of rules."""
    files = sorted(Path(__file__).with_name("rule_cases").glob("*.yaml"))
    tables = [YAML(typ="safe").load(file.read_text("utf-8")) or {} for file in files]
    written = [item for table in tables for item in table.items()]
    return tuple(Case(rule, n, **row) for rule, rows in written for n, row in enumerate(rows, 1))


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    for name in ("breaks", "holds"):
        if f"case_that_{name}" in metafunc.fixturenames:
            chosen = [case for case in cases() if getattr(case, name) is not None]
            metafunc.parametrize(f"case_that_{name}", chosen, ids=str)


@pytest.fixture(scope="session")
def rule_cases() -> tuple[Case, ...]:
    return cases()


@pytest.fixture(scope="session")
def machine() -> Callable[[str], ParameterFile]:
    """Return what builds a sound machine: ``machine("mill")``."""
    return sound


@pytest.fixture(scope="session")
def stands() -> Callable[[str], Stand]:
    """Return what gives the machine of a type on which changes are tried."""
    return stand
