"""Travel and counts of the 9/PC's measuring devices (7-33 to 7-53, B-2)."""

from __future__ import annotations

from dataclasses import dataclass

from amp_studio.sim import AxisParameters, SimulationError

from .law_facts import ids
from .law_reading import above_zero, if_set

_POSITION_TEETH = (ids.position_gear_teeth, ids.position_screw_teeth)
_VELOCITY_TEETH = (ids.velocity_gear_teeth, ids.velocity_screw_teeth)
_OWN_TRAVEL = "model.travel_per_turn"
_SCALES = ("aqb-no-marker", "aqb-one-marker", "dcm")
"""Linear scales: they measure the load (7-32, B-1)."""


@dataclass(frozen=True)
class Feedback:
    """Lengths in the unit u of the axis."""

    turn: float
    """u for a turn of the lead screw or table."""
    motor_turn: float
    """u for a turn of the motor."""
    position_count: float
    motor_count: float
    on_load: bool
    """Whether the position device is a scale at the load."""


def feedback_of(read: AxisParameters, unit: str, *, digital: bool, notes: list[str]) -> Feedback:
    """Return the devices of an axis; raises SimulationError where a parameter is not set or impossible."""
    device = read.choice(ids.position_feedback_type)
    if device == "none":
        raise SimulationError(f"Axis {read.axis} has no position feedback", ids.position_feedback_type)
    turn = _turn(read, unit, device, digital=digital, notes=notes)
    counts = above_zero(read, ids.position_counts)
    if device == "dcm":
        # The counts of a coded scale are those within its smaller period.
        count = above_zero(read, ids.dcm_small_period) / counts
    else:
        gear, screw = (above_zero(read, name) for name in _POSITION_TEETH)
        count = turn * gear / (counts * screw)
        notes.append("One electrical cycle of the feedback device is taken as one turn: one marker (7-33).")
    # An analog drive closes the velocity loop itself: the control has no motor device to count.
    if not digital:
        return Feedback(turn, turn, count, 0.0, device in _SCALES)
    gear, screw = (1.0 if read.optional(name) is None else above_zero(read, name) for name in _VELOCITY_TEETH)
    motor_turn = turn * gear / screw
    velocity_counts = if_set(read, ids.velocity_counts)
    motor_count = motor_turn / velocity_counts if velocity_counts else 0.0
    return Feedback(turn, motor_turn, count, motor_count, device in _SCALES)


def _turn(read: AxisParameters, unit: str, device: str, *, digital: bool, notes: list[str]) -> float:
    """Return how far the axis goes in one turn of the device, in its unit."""
    if read.optional(_OWN_TRAVEL) is not None:
        return above_zero(read, _OWN_TRAVEL)
    if unit == "deg":
        notes.append(
            "The manual prints Lead Screw Thread Pitch in mm and inches only (7-17): one turn behind the"
            f" gears of this rotary axis is assumed to be 360 deg; set {_OWN_TRAVEL} for another value."
        )
        return 360.0
    if device == "dcm" and not digital and read.optional(ids.lead_screw_pitch) is None:
        return above_zero(read, ids.dcm_small_period)  # nothing but the counts needs the pitch there (B-2)
    return above_zero(read, ids.lead_screw_pitch)
