"""An axis of LinuxCNC with plain kinematics: its joint's loop and following error, homing, limits.
Lines are of 2.9.8 (family.yaml).
"""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING

from amp_studio.files import ParameterFile, fitted_axes
from amp_studio.sim import (
    AlarmText,
    AxisLaw,
    AxisParameters,
    Homing,
    Jogging,
    Law,
    Machine,
    Prediction,
    Ramp,
    SimulationError,
    Source,
    Travel,
)

from . import law_sample as loop
from .kinematics import joint_letters
from .law_facts import MOTION, ids

if TYPE_CHECKING:
    pass

_NO_LOOP = (
    "ASSUMED: the file has no P for the joint, so its HAL closes the loop elsewhere: a loop of 100 1/s with"
    " full feed-forward."
)
RAMP = "The ramp is that of G61, jogs and homing; with G64 a path has half of it (measured on 2.9.0~pre1)."
_HOMED = (
    (
        "Search, back at the latch speed or, where it has the sign of the search, off and onto the switch"
        " again, to the switch or marker, which gets Position of the Switch, and the final move to Home"
        " (H796 to H1330)."
    ),
    "It rests on the switch for 0.1 s before it goes back (measured on 2.9.0~pre1).",
    "Speeds of homing are at most that of the joint, and its acceleration counts (measured on 2.9.0~pre1).",
    "ASSUMED: markers 10 mm or deg apart, unless move.turn gives another distance.",
)
ENCODER = "ASSUMED: the absolute encoder shows 0 where the axis begins."
_LIMITED = (
    "A block beyond a limit is refused before it begins; a jog ends at it (CM218). Both ends may be reached."
    " An arc that ends inside is begun, and stops once it has passed the limit (measured on 2.9.0~pre1)."
)


def axes(file: ParameterFile) -> tuple[str, ...]:
    """Return the axes that have a joint of plain kinematics."""
    kinematics, joints = file.get((ids.kins_kinematics, "")), file.get((ids.kins_joints, ""))
    letters = joint_letters(
        str(kinematics.value) if kinematics else None, _count(joints.value if joints else 0)
    )
    return tuple(axis for axis in fitted_axes(file) if axis in letters)


def _count(value: object) -> int:
    return int(value) if isinstance(value, (int, float)) else 0


class _Joint:
    """The values of the joint of an axis; the first one where it has several."""

    def __init__(self, read: AxisParameters) -> None:
        kinematics = read.value(ids.kins_kinematics, everywhere=True)
        letters = joint_letters(
            str(kinematics or ""), int(read.optional(ids.kins_joints, everywhere=True) or 0.0)
        )
        if read.axis not in letters:
            raise SimulationError(
                f"Axis {read.axis} has no joint in Kinematics ({kinematics}): only trivkins is simulated",
                ids.kins_kinematics,
            )
        self.read, self.instance = read, str(letters.index(read.axis))

    def optional(self, parameter: str) -> float | None:
        """Return a number, None where it is not set."""
        return self.read.optional(ids[f"joint_{parameter}"], at=self.instance)

    def number(self, parameter: str, otherwise: float) -> float:
        """Return a number, or what LinuxCNC takes where there is none."""
        found = self.optional(parameter)
        return otherwise if found is None else found

    def called(self, parameter: str) -> str:
        """Return what a sentence calls a parameter."""
        return self.read.called(ids[f"joint_{parameter}"], at=self.instance)

    def value(self, parameter: str) -> object:
        """Return any value."""
        return self.read.value(ids[f"joint_{parameter}"], at=self.instance)


def bind(read: AxisParameters) -> AxisLaw:
    """Return one axis; raises SimulationError naming what is missing or impossible."""
    joint = _Joint(read)
    top, ramp = read.above_zero(ids.axis_max_velocity) / 60.0, read.above_zero(ids.max_acceleration)
    fastest = joint.number("max_velocity", 60.0) / 60.0
    if not fastest > 0.0:
        raise SimulationError(
            f"{joint.called('max_velocity')} of axis {read.axis} is {fastest:g}; it must be above 0",
            ids.joint_max_velocity,
        )
    unit = "deg" if joint.value("type") == "angular" or read.axis in "ABC" else "mm"
    gain, forward = joint.optional("pid_p"), joint.optional("pid_ff1")
    notes = [RAMP] + ([] if gain else [_NO_LOOP])
    ferror = joint.number("ferror", 1.0)
    # Without MIN_FERROR LinuxCNC takes FERROR for it.
    least = joint.number("min_ferror", ferror)
    rate = gain or MOTION.value("position_gain")
    # Without a loop in the file the joint follows as the assumed one does, feed-forward included.
    share = (forward or 0.0) if gain else MOTION.value("feed_forward")
    limit = f"joint {joint.instance} following error"
    return AxisLaw(
        axis=read.axis,
        unit=unit,
        title="LinuxCNC: PID loop with feed-forward of speed, velocity drive, straight ramps",
        position_sample=loop.position_sample,
        velocity_sample=None,
        parameters=[rate, share, ferror, least, fastest],
        state_size=1,
        servo_period=(read.optional(ids.servo_period, everywhere=True) or 1.0) / 1000.0,
        velocity_period=(read.optional(ids.servo_period, everywhere=True) or 1.0) / 1000.0,
        machine=Machine(
            # High on purpose: of the drive nothing is known but that it follows its speed.
            acceleration_per_output=1e4,
            velocity_per_output=1.0,
            velocity_bandwidth=MOTION.value("velocity_bandwidth"),
        ),
        output_unit=f"{unit}/s",
        position_rate=rate,
        feedrate=top,
        # No such band is in the file: a tenth of the error that is allowed at rest.
        inposition_band=max(least / 10.0, 1e-6),
        ramps={"linear": Ramp("linear", acceleration=ramp), "none": Ramp()},
        monitors=(("following_error_limit", unit),),
        alarms={
            1: AlarmText(
                limit,
                f"the following error passes its limit, {least:g} {unit} at standstill and"
                f" {max(ferror, least):g} {unit} at full speed",
            )
        },
        predict=lambda speed: {
            "steady_following_error": Prediction(abs(speed) * (1.0 - share) / rate, unit, "D1169")
        },
        limits={"ferror": ferror, "min_ferror": least},
        stops_at="ferror",
        sources={
            "feedrate": Source(ids.axis_max_velocity, 1.0),
            "acceleration": Source(ids.max_acceleration),
        },
        gains=(),
        assumptions=tuple(notes),
        assumed=MOTION.reasons("velocity_bandwidth"),
        homing=partial(homing, joint),
        jogging=partial(jogging, read, top),
        travel=partial(travel, read),
    )


def homing(joint: _Joint) -> Homing:
    """Return the sequence of one joint; raises SimulationError for one that LinuxCNC refuses."""
    fastest = joint.number("max_velocity", 60.0) / 60.0
    encoder = joint.value("home_absolute_encoder")
    is_absolute = encoder in ("with-final-move", "without-final-move")
    has_index = joint.value("home_use_index") in (True, "yes")
    search, latch = _search_and_latch(joint, fastest, is_absolute=is_absolute, has_index=has_index)
    sequence = joint.optional("home_sequence")
    home, offset = joint.number("home", 0.0), joint.number("home_offset", 0.0)
    final = joint.number("home_final_velocity", -60.0) / 60.0
    moves = encoder != "without-final-move"
    return Homing(
        approach=search,
        leave=latch,
        again=abs(latch) if search * latch > 0.0 else 0.0,
        marker="next" if has_index else "none",
        turn=MOTION.value("marker_distance"),
        coordinate=home if moves else offset,
        final=0.0 if not moves else min(final, fastest) if final > 0.0 else fastest,
        offset=home - offset if moves else 0.0,
        # The joints of a negative step make the final move together; its order is the same.
        order=None if sequence is None else abs(int(sequence)),
        pause=MOTION.value("home_pause"),
        ramp=Ramp("linear", acceleration=joint.number("max_acceleration", 1.0)),
        speeds={
            "approach": ids.joint_home_search_velocity,
            "leave": ids.joint_home_latch_velocity,
            "again": ids.joint_home_latch_velocity,
            **({"final": ids.joint_home_final_velocity} if final > 0.0 else {}),
        },
        page="H796",
        notes=(*_HOMED, ENCODER) if is_absolute else _HOMED,
    )


def _search_and_latch(
    joint: _Joint, fastest: float, *, is_absolute: bool, has_index: bool
) -> tuple[float, float]:
    """Return both velocities; raises SimulationError for a pair that LinuxCNC refuses."""
    search, latch = (
        _at_most(fastest, joint.number(name, 0.0) / 60.0)
        for name in ("home_search_velocity", "home_latch_velocity")
    )
    if is_absolute:  # its place is known: no switch and no marker is looked for
        return 0.0, 0.0
    if (search != 0.0 and latch == 0.0) or (search == 0.0 and latch != 0.0 and not has_index):
        raise SimulationError(
            "A search needs a latch, and a latch a search or a marker (H817, H828): the joint cannot be"
            " homed",
            ids.joint_home_latch_velocity,
        )
    return search, latch


def _at_most(fastest: float, velocity: float) -> float:
    return math.copysign(min(abs(velocity), fastest), velocity)


def jogging(read: AxisParameters, top: float) -> Jogging:
    """Return the speeds of a jog: those of the screen, at most that of the axis."""
    speeds = {"greatest": top}
    for name, parameter in (("first", ids.jog_default), ("screen", ids.jog_greatest)):
        speed = read.optional(parameter, everywhere=True)
        if speed:
            speeds[name] = min(speed / 60.0, top)
    return Jogging(
        speeds, page="X122", notes=("An operator chooses the speed of a jog; at most that of the axis.",)
    )


def travel(read: AxisParameters) -> Travel:
    """Return the limits of a homed axis; none where there is no key."""
    low, high = read.optional(ids.min_limit), read.optional(ids.max_limit)
    edges = (-math.inf if low is None else low, math.inf if high is None else high)
    limits = {"the limit of the axis": edges}
    return Travel(limits, "exceed limit", "CM218", (_LIMITED,), refuses=True, begins_arcs=True)


LAW = Law(bind, axes, path="amp_studio.families.linuxcnc.law_path:path_rules")
