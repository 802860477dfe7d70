"""The unit of the 9/PC's velocity loop gains, and the inertia they work on: an inference,
tested in tests/families/ninepc.

The manual prints no unit for Velocity Proportional Gain (VPG) and Velocity Integral Gain (VIG).
All that it prints about them fits one:

    torque / rated torque = (VPG e + VIG sum(e)) / 65536

e is the velocity error of the motor in rad/s, summed once a velocity sample of 1 ms; the inertia belongs to
the axis. The evidence, with what it decides:

- Each column of Tables 7.B and 7.C is its first cell times 1 + load inertia ratio (7-55, 7-56; one cell of 36
  is printed 17460 for 17476): the gain is torque per velocity error, and the inertia is not in it. Windings
  of one motor share a cell, so the torque is a share of rated torque, not amperes. The lead of the screw is
  in no table: the error is an angle.
- The bounds 3277, 10923 and 1092 times the position gain (7-54, 7-56) are 65536 / 20, / 6 and / 60, which by
  the manual convert to inverse milliseconds, the position gain being 60 / gain in them (7-25). So 65536 is 1
  per ms for both
  gains: the proportional one on an axis of 1000 rad/s2 at rated torque (`NOMINAL`), the integral one where
  the sum grows once a millisecond.
- On that axis the two upper bounds together are a damping of 0.65 at gain 1, the usual design of a cascade.
- A factor of 2 more torque (value / 65536 of the 200 % limit) would put cells of Table 7.B beyond the
  stability of a loop that also ends appendix A between 5 and 10; a factor of 1 does not.
- Appendix A (A-8 to A-10) ends with VPG / VIG between 5 and 10 and then in an oscillation that no VPG stops.
  That ratio is the integral time in samples, and the oscillation comes where it is shorter than the lag of
  the loop: 3 to 5 samples in all. Half a sample of hold and half of difference leave 2 to 4: `DELAY` and
  `CURRENT_LOOP` are taken from that.

What does not fit is a note of the result (`law_notes.py`): the 7xx motors, whose two cells are 120 to 220
apart where all others are 14 to 25; an axis too heavy for 1500; the smooth overshoot of large systems.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from amp_studio.schema import Table
from amp_studio.sim import SimulationError

from .law_facts import MOTION

FULL = 65536.0
"""Gain for rated torque at a velocity error (or sum) of 1 rad/s."""
VELOCITY_PERIOD = MOTION.value("velocity_period")
"""s between two samples of the velocity loop."""
DELAY = MOTION.value("delay")
"""s from a sample to its torque command."""
CURRENT_LOOP = MOTION.value("current_loop")
"""Hz: the current loop."""


def lag_of(delay: float, bandwidth: float, torque_filter: float = math.inf) -> float:
    """Return the whole lag of the velocity loop in s: half a sample of hold and half of difference, the delay
    in s, current loop (0: ideal) and torque filter in Hz.
    """
    current = 1.0 / (2.0 * math.pi * bandwidth) if bandwidth > 0.0 else 0.0
    return VELOCITY_PERIOD + delay + current + 1.0 / (2.0 * math.pi * torque_filter)


LAG = lag_of(DELAY, CURRENT_LOOP)
"""s: of an axis without torque filter."""
NOMINAL = MOTION.value("rated_acceleration")
"""rad/s2 at rated torque of the axis that the printed bounds are about."""
SEPARATE = 3.0
"""Least ratio of velocity loop to position loop (7-54: 3277 / 65536 per ms to gain / 60 per ms), below which
a closed position loop overshoots."""

_ASSUMED_MOTORS = {
    frame: (MOTION.value(f"torque_{frame}"), MOTION.value(f"inertia_{frame}")) for frame in ("b410", "b420")
}
"""Frame -> rated torque in N m and inertia in lb in s2."""
_DATA_SHEET = "an excerpt of the maker's data sheet 1326AB Torque Plus (within 10 %), not from a manual"
OWN_TORQUE, OWN_INERTIA = "model.motor_torque", "model.motor_inertia"
"""N m and kg m² of the motor, when they are set."""
_LB_IN_S2 = 0.112984829
"""kg m² of 1 lb in s2."""
UNUSUAL_FRAMES = ("b7",)
"""Motors whose cells of Tables 7.B and 7.C fit no unit together."""


@dataclass(frozen=True)
class Inertia:
    """What an axis accelerates with: rad/s2 of its motor at rated torque, load included, and why it is
    taken.
    """

    acceleration: float
    why: str


def torque_for(gain: float, travel: float) -> float:
    """Return the torque in % of rated torque for a velocity error (or a sum of them) of 1 u/s;
    ``travel`` is u for a turn of the motor.
    """
    return 100.0 * gain / FULL * 2.0 * math.pi / travel


def acceleration_for(rotation: float, travel: float) -> float:
    """Return u/s2 for 1 % of rated torque from rad/s2 at rated torque."""
    return rotation * travel / (2.0 * math.pi) / 100.0


def loop_rate(proportional: float, rotation: float) -> float:
    """Return the rate in 1/s of the velocity loop: VPG / 65536 x rad/s2 at rated torque."""
    return proportional / FULL * rotation


def gain_for_rate(rate: float, rotation: float) -> float:
    """Return the Velocity Proportional Gain of a loop rate in 1/s."""
    return rate * FULL / rotation


def highest_rate(lag: float = LAG, integral_time: float = math.inf) -> float:
    """Return the loop rate in 1/s at which the rigid velocity loop oscillates; 0 where it does at any rate.

    Crossing of -180 degrees of rate (1 + 1 / (s Ti)) exp(-s lag) / s with the lag as one dead time:
    atan(w Ti) = w lag.
    """
    if math.isinf(integral_time):
        # Without an integral part it is rate exp(-s lag) / s, whose phase is -180 degrees at w lag = pi /
        # 2.
        return 0.5 * math.pi / lag
    if integral_time <= lag:
        return 0.0
    # Beyond, the phase of the dead time alone is past -90 degrees, and the atan cannot make up for it.
    low, high = 0.0, 0.5 * math.pi / lag
    # Halved 60 times an interval is as narrow as a float.
    for _ in range(60):
        middle = 0.5 * (low + high)
        if math.atan(middle * integral_time) > middle * lag:
            low = middle
        else:
            high = middle
    return low * low * integral_time / math.hypot(1.0, low * integral_time)


def frame_acceleration(frame: str) -> float:
    """Return rad/s2 of a motor alone at its rated torque."""
    torque, inertia = _ASSUMED_MOTORS[frame]
    return torque / (inertia * _LB_IN_S2)


def standard_gains(tables: Mapping[str, Table], motor: str, ratio: int) -> tuple[float, float] | None:
    """Return the cells of Tables 7.B and 7.C (7-55, 7-56) of a motor type at 1 : ratio;
    None where one table has no such motor.
    """
    columns = [tables[name].column(motor.upper()) if name in tables else None for name in ("7.B", "7.C")]
    if columns[0] is None or columns[1] is None:
        return None
    return float(columns[0][ratio]), float(columns[1][ratio])


def _typical_rate(tables: Mapping[str, Table]) -> float:
    """Return the velocity loop in 1/s that Table 7.B gives the motors whose data are assumed:
    the geometric mean.
    """
    rates = []
    for frame in _ASSUMED_MOTORS:
        column = tables["7.B"].column(f"{frame.upper()}{'G' if frame == 'b410' else 'E'}")
        assert column is not None
        rates.append(loop_rate(float(column[0]), frame_acceleration(frame)))
    return math.exp(sum(map(math.log, rates)) / len(rates))


def inertia_of(
    motor: str,
    ratio: int,
    tables: Mapping[str, Table],
    torque: float | None = None,
    inertia: float | None = None,
) -> Inertia:
    """Return what a digital axis accelerates with, from Motor Type and Load Inertia Ratio (7-71, 7-72).

    ``torque`` in N m and ``inertia`` in kg m² are those of the motor where they are set. Raises
    SimulationError where one is set and the other unknown.
    """
    name, loaded = f"1326AB-{motor.upper()}", f"Load Inertia Ratio 1 : {ratio} (7-71)"
    frame = _ASSUMED_MOTORS.get(motor[:4])
    if torque is not None or inertia is not None:
        return _of_set_motor(name, frame, ratio, torque, inertia)
    column = tables["7.B"].column(motor.upper()) if "7.B" in tables else None
    if frame is not None:
        return Inertia(
            frame_acceleration(motor[:4]) / (1.0 + ratio),
            f"A {name} is taken to have {OWN_TORQUE} = {frame[0]:g} N m (rated) and {OWN_INERTIA} ="
            f" {frame[1] * _LB_IN_S2:.6f} kg m², from {_DATA_SHEET}, with {loaded}.",
        )
    if column is not None:
        rate = _typical_rate(tables)
        return Inertia(
            rate * FULL / float(column[0]) / (1.0 + ratio),
            f"The manual has no data of a {name}: its cell of Table 7.B (7-55) is taken to give a velocity"
            f" loop of {rate:.0f} 1/s, the mean of the 410 and 420 frames, whose torque and inertia are from"
            f" {_DATA_SHEET}, with {loaded}; set {OWN_TORQUE} and {OWN_INERTIA}.",
        )
    return Inertia(
        NOMINAL,
        f"Nothing is known of the motor and its load: {NOMINAL:.0f} rad/s2 at rated torque, the axis that the"
        f" bounds of 7-54 are about; set {OWN_TORQUE} and {OWN_INERTIA}.",
    )


def _of_set_motor(
    name: str, frame: tuple[float, float] | None, ratio: int, torque: float | None, inertia: float | None
) -> Inertia:
    """Return what an axis accelerates with whose motor has a torque (N m) or an inertia (kg m²) that was
    set.
    """
    why = []
    if torque is None:
        if frame is None:
            raise SimulationError(
                f"The rated torque of a {name} is not known: set {OWN_TORQUE} too", OWN_TORQUE
            )
        torque = frame[0]
        why.append(f"{OWN_TORQUE} of a {name} is taken as {torque:g} N m")
    if inertia is None:
        if frame is None:
            raise SimulationError(f"The inertia of a {name} is not known: set {OWN_INERTIA} too", OWN_INERTIA)
        inertia = frame[1] * _LB_IN_S2
        why.append(f"{OWN_INERTIA} of a {name} is taken as {inertia:.6f} kg m²")
    return Inertia(torque / inertia / (1.0 + ratio), f"{why[0]}, from {_DATA_SHEET}." if why else "")
