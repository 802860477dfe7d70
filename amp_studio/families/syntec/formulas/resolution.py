"""Pulses, gears and the length of a pulse: sections 1.2 and 1.3."""

from __future__ import annotations

from amp_studio.validate import finite, positive

STANDARD_BLU = 0.001
"""Length of the BLU as delivered, in mm or deg (page 1.2.6)."""


def axis_move(programmed: float, is_diameter: bool) -> float:
    """Incremental move of an axis: half the programmed figure on a diameter axis (page 1.2.3)."""
    return finite("programmed", programmed) / (2.0 if is_diameter else 1.0)


def encoder_resolution(pulses: float, multiplication: float) -> float:
    """Axis encoder resolution for so many pulses after multiplication, per turn or per mm (page 1.2.5)."""
    return positive("pulses", pulses) / positive("multiplication", multiplication)


def pulses_per_turn(encoder: float, multiplication: float) -> float:
    """Pulses after multiplication: Axis encoder resolution times Resolution multiplication (page 1.3.1)."""
    return positive("encoder", encoder) * positive("multiplication", multiplication)


def scale_pulse_length(encoder: float, multiplication: float) -> float:
    """Length of one pulse of a linear encoder in µm, its resolution in pulses per mm (page 1.2.5)."""
    return 1000.0 / pulses_per_turn(encoder, multiplication)


def motor_turns_per_screw_turn(screw_teeth: float, motor_teeth: float) -> float:
    """Turns of the motor for one of the screw: screw side over motor side (page 1.2.6)."""
    return positive("screw_teeth", screw_teeth) / positive("motor_teeth", motor_teeth)


def travel_per_motor_turn(pitch: float, screw_teeth: float = 1.0, motor_teeth: float = 1.0) -> float:
    """Way of the axis for one turn of the motor, in the unit of the pitch (page 1.2.6)."""
    return (
        positive("pitch", pitch) * positive("motor_teeth", motor_teeth) / positive("screw_teeth", screw_teeth)
    )


def pulse_length(pitch: float, pulses: float, screw_teeth: float = 1.0, motor_teeth: float = 1.0) -> float:
    """Way of the axis for one pulse after multiplication, in the unit of the pitch (page 1.3.1).

    The printed examples leave the gear of 2 : 1 out of this sum and so find 1 µm instead of 0.5 µm.
    """
    return travel_per_motor_turn(pitch, screw_teeth, motor_teeth) / positive("pulses", pulses)


def blu_count(length: float, blu: float = STANDARD_BLU) -> float:
    """Count of BLU of a length in mm or deg, as pitch and limits are entered (page 1.3.1)."""
    return float(round(finite("length", length) / positive("blu", blu)))


def blu_length(count: float, blu: float = STANDARD_BLU) -> float:
    """Length in mm or deg of a count of BLU (page 3.5)."""
    return finite("count", count) * positive("blu", blu)
