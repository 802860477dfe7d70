"""One 9/PC axis as a file would give it, bound by the law of the family."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from amp_studio.families.ninepc.law import bind
from amp_studio.schema import load_schema
from amp_studio.sim.axis_parameters import AxisParameters, ParameterValue
from amp_studio.sim.law import AxisLaw
from amp_studio.sim.model import with_model

VALUES: dict[str, ParameterValue] = {
    "axis.type": "linear",
    "servo.hardware_type": "sercos",
    "servo.loop_type": "digital",
    "servo.position_loop_type": "closed",
    "servo.sercos_cycle": 1.0,
    "servo.standard_motor_values": False,
    "servo.motor_type": "b410g",
    "servo.load_inertia_ratio": "r0",
    "servo.position_feedback_type": "hiperface-incremental",
    "servo.position_counts": 2097152.0,
    "servo.position_gear_teeth": 1.0,
    "servo.position_screw_teeth": 1.0,
    "servo.velocity_gear_teeth": 1.0,
    "servo.velocity_screw_teeth": 1.0,
    "servo.velocity_counts": 2097152.0,
    "servo.lead_screw_pitch": 10.0,
    "servo.initial_gain": 1.0,
    "servo.gain_break_point": 200.0,
    "servo.gain_break_ratio": 1.0,
    "servo.feed_forward": 0.0,
    "servo.inposition_band": 0.0254,
    "servo.feedrate_suppression": 203.2,
    "servo.excess_error": 203.2,
    "servo.velocity_proportional_gain": 1500.0,
    "servo.velocity_integral_gain": 0.0,
    "servo.integrator_discharge": 1.0,
    "servo.max_torque_positive": 200.0,
    "servo.max_torque_negative": 200.0,
    "servo.peak_current": "p300",
    "servo.torque_filter": 10000.0,
    "feedrate.rapid": 15000.0,
    "feedrate.max_cutting": 15000.0,
    "accdec.positioning_mode": "linear",
    "accdec.linear_acceleration": 500.0,
    "accdec.linear_deceleration": 0.0,
}

EVERYWHERE = (
    "servo.sercos_cycle",
    "servo.standard_motor_values",
    "accdec.positioning_mode",
    "accdec.programmed_delay",
    "timing.fine_foreground",
    "timing.scans_per_logic",
)

DAC_PLACES = {
    "patch.dac_monitor": ("2", "3"),
    "spindle.voltage_at_max": ("1.1", "2.1"),
    "spindle.max_speed": ("1.1", "2.1"),
}
"""Instances behind 86 and 87, 820 and 830, 910 and 930; a test sets `parameter@instance`."""

Values = dict[str, ParameterValue]
Axis = Callable[..., AxisLaw]


@pytest.fixture(scope="session")
def axis() -> Axis:
    """Return a function that gives the axis with some values changed (None: not set)
    and machine figures by name.
    """

    def bound(values: Values | None = None, settings: Values | None = None, **machine: float) -> AxisLaw:
        merged = {**VALUES, **(values or {})}

        def value(parameter: str, instance: str) -> ParameterValue:
            if parameter.startswith("deskew.") or parameter == "axis.name":
                return None
            if parameter in DAC_PLACES:
                assert instance in DAC_PLACES[parameter]
                return merged.get(f"{parameter}@{instance}")
            known = ("",) if parameter in EVERYWHERE else ("1",)
            assert instance in known, f"{parameter} was asked for at '{instance}'"
            return merged.get(parameter)

        read = AxisParameters(value, "1", settings or {}, load_schema("9pc").tables)
        law = with_model(bind(read), read)
        read.refuse_unused()
        return replace(law, machine=replace(law.machine, **machine)) if machine else law

    return bound
