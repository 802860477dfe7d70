"""How values are keyed into a 9/PC: the Patch AMP utility (chapter 37).

The manual prints no order for the values. By it Patch AMP checks neither ranges nor what belongs together
(37-1), that Excess Error protects the machine (7-20), and which limits must lie below which (7-20); the
stages follow from that, and the rules of the family decide what they do not.
"""

from __future__ import annotations

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, StorageError, Value, stored_number, stored_unit, to_stored
from amp_studio.sheet import Instruction, Keyed, Keying, Stage, plain_text

MEASURES, CAREFUL, OTHER, WIDER, FASTER = range(5)

_STAGES = (
    Stage(
        "How an axis measures",
        "The control turns every later value in mm or degrees into travel with these; gains have an effect"
        " only with Standard Motor Table Values at No.",
        "7-6, 7-17",
    ),
    Stage(
        "Narrower limits, less speed, gain and torque",
        "A person who is interrupted here leaves a machine that is more careful than before.",
        "7-20",
    ),
    Stage("Other values"),
    Stage("Wider limits", "Excess Error protects machine and people: it opens late.", "7-20"),
    Stage("More speed, acceleration, gain and torque", "Last, when every limit is as it is to be.", "37-1"),
)

_MEASURES = frozenset(
    f"servo.{name}"
    for name in (
        "standard_motor_values",
        "position_loop_type",
        "lead_screw_pitch",
        "position_feedback_type",
        "position_counts",
        "position_sign",
        "position_gear_teeth",
        "position_screw_teeth",
        "velocity_feedback_type",
        "velocity_counts",
        "velocity_sign",
        "velocity_gear_teeth",
        "velocity_screw_teeth",
        "amplifier_type",
        "spindle_motor_teeth",
        "spindle_shaft_teeth",
    )
)

_LIMITS = frozenset(
    (
        "servo.excess_error",
        "servo.feedrate_suppression",
        "servo.gain_break_point",
        "servo.inposition_band",
        "zone.overtravel_used",
        "zone.overtravel_positive",
        "zone.overtravel_negative",
        "deskew.skew_limit",
        "sync.max_deviation",
        "spindle.deviation_tolerance",
        "adaptive.travel_limit",
    )
)

_FAST = frozenset(
    (
        "home.speed_off_switch",
        "servo.initial_gain",
        "servo.gain_break_ratio",
        "servo.feed_forward",
        "servo.velocity_proportional_gain",
        "servo.velocity_integral_gain",
        "servo.peak_current",
        "servo.max_torque_negative",
        "servo.max_torque_positive",
        "servo.hard_stop_detection",
        "servo.hard_stop_holding",
        "servo.max_acceleration",
        "servo.max_motor_speed",
        "servo.analog_positive_voltage",
        "servo.analog_negative_voltage",
        "feedrate.rapid",
        "feedrate.max_cutting",
        "feedrate.external_decel_cutting",
        "feedrate.external_decel_positioning",
        "accdec.velocity_step",
        "accdec.linear_acceleration",
        "accdec.linear_deceleration",
        "accdec.scurve_acceleration",
        "accdec.scurve_deceleration",
        "accdec.jerk",
        "accdec.min_jerk",
        "patch.acc_dec_ramp",
        "spindle.voltage_at_max",
        "spindle.max_speed",
        "spindle.orient_speed",
        "spindle.gain",
        "sync.gain",
        "tapping.max_speed",
        "probing.approach_rate",
        "probing.probe_rate",
        "adaptive.feed_integral_gain",
        "adaptive.feed_proportional_gain",
        "deskew.gain",
    )
)


def _obstacle(file: ParameterFile, address: Address) -> str:
    if address[0] == "patch.internal":
        return "by the manual it is not to be adjusted (page 37-3)"
    if address[0] == "calibration.table":
        return "its points are entered on the screen {AXIS CALIB}, or the file is downloaded (page 36-6)"
    if not file.schema.parameters[address[0]].patchable:
        return "Patch AMP does not offer it: it has to be downloaded (page 37-2)"
    return ""


def _text(file: ParameterFile, address: Address, value: Value) -> Keyed | None:
    """Return the Patch AMP value: always a number, in millimetres,
    degrees or as the table prints it (page 37-3).
    """
    parameter = file.schema.parameters[address[0]]
    if stored_number(parameter, value, turns=file.evaluation.turns(address)) is None:
        return None
    return plain_text(file, address, value)


def _stage(before: ParameterFile, after: ParameterFile, address: Address) -> int:
    """Return the stage of a value: what is opened comes after what is narrowed."""
    if address[0] in _MEASURES:
        return MEASURES
    if address[0] not in _LIMITS | _FAST:
        return OTHER
    old, new = _size(before, address), _size(after, address)
    # What is not known before counts as opened: it comes late.
    if old is not None and new is not None and new < old:
        return CAREFUL
    return WIDER if address[0] in _LIMITS else FASTER


def _size(file: ParameterFile, address: Address) -> float | None:
    """Return how far a limit lets the machine go, or how fast a value makes it; None if it is not known."""
    parameter, value = file.schema.parameters[address[0]], file.get(address)
    if value is None:
        return None
    if address[0] == "zone.overtravel_used":
        return 0.0 if value.value is True else 1.0
    try:
        size = float(
            to_stored(parameter, value, stored_unit(parameter, turns=file.evaluation.turns(address)))
        )
    except StorageError:
        return None
    if address[0] == "zone.overtravel_positive":
        return size
    # The lower end of the travel lets the machine go farther the smaller it is.
    return -size if address[0] == "zone.overtravel_negative" else abs(size)


KEYING = Keying(
    title="Patch AMP sheet",
    obstacle=_obstacle,
    text=_text,
    stages=_STAGES,
    stage=_stage,
    before=(
        Instruction(
            "Patch AMP checks neither ranges nor what belongs together: each value counts as it is keyed in.",
            "37-1",
        ),
        Instruction("Keep what the control contains: {UPDATE BACKUP}, AMP, {TO BACKUP}.", "36-14"),
        Instruction(
            "Place the control in E-Stop and leave it there until the last value has been read back.", "37-3"
        ),
        Instruction(
            "{PASSWORD}: the password of access level 0. Then {SYSTEM SUPORT}, {AMP}, {PATCH AMP} and its"
            " second password.",
            "37-2",
        ),
        Instruction(
            "For each line: {SEARCH NUMBER}, number, [ENTER]; {REPLACE VALUE}, value, [ENTER]; tick it.",
            "37-2, 37-3",
        ),
        Instruction(
            "All values are in millimetres or degrees, whatever the file shows; units of time as in the"
            " line.",
            "37-3",
        ),
    ),
    after=(
        Instruction(
            "{UPDATE & EXIT} stores all values at once; without it none is stored. Leave only where no step"
            " above is open.",
            "37-3",
        ),
        Instruction("Switch the control off and on: then the values become active.", "37-3"),
        Instruction("AMP HAS BEEN MODIFIED BY PATCH AMP appears at every power-up; [CAN] clears it.", "37-3"),
        Instruction("Read each value back in Patch AMP, write down what the screen shows, and compare."),
        Instruction("When the machine runs as it should: {UPDATE BACKUP}, AMP, {TO BACKUP}.", "37-15"),
        Instruction(
            "To end the message for good, upload the AMP file, edit and save it, and download it.", "37-3"
        ),
    ),
)
