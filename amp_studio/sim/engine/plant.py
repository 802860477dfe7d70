"""The plant: one physics step of drive and mechanics over flat arrays,
compiled with the kernel or run as it is.

``m`` is the array of `machine.machine_array`, ``x`` the state. Torque is constant over a step, so that one
rigid mass moves exactly; two masses move by drift, kick, drift (the leapfrog scheme, E. Hairer, C. Lubich, G.
Wanner, Geometric Numerical Integration, 2006), of second order and without a drift of energy. Dry friction
after D. Karnopp, Computer Simulation of Stick-Slip Friction in Mechanical Dynamic Systems (ASME Journal of
Dynamic Systems, Measurement, and Control 107, 1985); backlash as a spring with a gap,
that can push but not pull.
"""

from __future__ import annotations

import math

from .arrays import Vector
from .machine import (
    BRAKE,
    COULOMB,
    DAMPING,
    FROM_TORQUE,
    FROM_WEIGHT,
    GIVEN_BACK,
    GRAVITY,
    HALF_CHANGE,
    HALF_GAP,
    KEEP,
    KICK,
    LAG,
    LAG_MEAN,
    LOAD,
    MOTOR,
    OUTPUT_LIMIT,
    SPRING,
    STATIC,
    STIFFNESS,
    TORQUE_NEGATIVE,
    TORQUE_OF_CHANGE,
    TORQUE_PER_OUTPUT,
    TORQUE_POSITIVE,
    TWO_MASSES,
    VELOCITY_GAIN,
    VELOCITY_INTEGRAL,
    VELOCITY_PER_OUTPUT,
)

PlantState = tuple[float, float, float, float, float, float, float]
"""Motor position and speed, load position and speed, torque of the motor at the end of the last step; in a
drive with a velocity loop the integral of the velocity error (u)
and the torque of friction and load in the last step."""


def delayed(line: Vector, slot: int, steps: int, output: float) -> tuple[float, float]:
    """Return the outputs at the drive at the start of this step and at its end.

    ``line`` are the outputs of the last steps, ``slot`` the place of this one;
    the delay is ``steps`` physics steps, or a share of one more.
    """
    # The line is a ring: its oldest output is written over, so nothing is moved in a step.
    line[slot] = output
    newer = slot - steps
    if newer < 0:
        newer += len(line)
    older = newer - 1
    if older < 0:
        older += len(line)
    return line[older], line[newer]


def _wanted_torque(
    m: Vector, output: float, speed: float, error_sum: float, against: float, h: float
) -> tuple[float, float]:
    """Return the torque that the drive asks its current loop for, limited,
    and the integral of the velocity error.

    ``against`` is the torque of friction and load:
    the speed that it takes in a step the loop gives back in the same step.
    """
    torque, error = output, 0.0
    if m[VELOCITY_PER_OUTPUT] > 0.0:
        if abs(output) > m[OUTPUT_LIMIT]:
            output = math.copysign(m[OUTPUT_LIMIT], output)
        error = m[VELOCITY_PER_OUTPUT] * output - speed
        torque = m[VELOCITY_INTEGRAL] * error_sum - m[VELOCITY_GAIN] * speed + m[GIVEN_BACK] * against
        torque += m[TORQUE_PER_OUTPUT] * output
        error -= m[HALF_CHANGE] * (torque - against)  # in the middle of the step
    # At its limit a drive does not sum what would go further.
    if torque > m[TORQUE_POSITIVE]:
        return m[TORQUE_POSITIVE], error_sum + min(error, 0.0) * h
    if torque < -m[TORQUE_NEGATIVE]:
        return -m[TORQUE_NEGATIVE], error_sum + max(error, 0.0) * h
    return torque, error_sum + error * h


def speed_after(m: Vector, k: int, speed: float, push: float) -> float:
    """Return the speed in u/s after a step under the torque ``push`` and friction,
    of the mass whose figures begin at ``k``.

    A mass at rest stays there until the push is above the static friction; one whose speed changes its sign
    comes to rest unless the push is above it: then friction turns with the speed,
    in the part of the step that is left.
    """
    if speed == 0.0:
        if abs(push) <= m[k + STATIC]:
            return 0.0
        dry = math.copysign(m[k + COULOMB], push)
    else:
        dry = math.copysign(m[k + COULOMB], speed)
    after = m[k + KEEP] * speed + m[k + KICK] * (push - dry)
    if after * dry < 0.0:
        # After the speed was 0, after / (push - dry) of the kick is left, and friction, now against the other
        # way, makes it push + dry.
        return after * (push + dry) / (push - dry) if abs(push) > m[k + STATIC] else 0.0
    return after


def brake(m: Vector) -> None:
    """Close the brake: dry friction at the load, for the rest of the run."""
    # Of the one mass, and of the load of two: the machine uses one of them.
    for k in (0, LOAD):
        m[k + COULOMB] += m[BRAKE]
        m[k + STATIC] += m[BRAKE]


def stretch(gap: float, twist: float, half: float) -> float:
    """Return the mean stretch of a spring with ``gap`` u of play to each side, in u, over a step that takes
    its twist from ``twist - half`` to ``twist + half``.

    The mean of the whole way, not the stretch in its middle: so contact takes up and gives back the same
    energy, wherever in a step it begins.
    """
    # In contact for the whole step, then never, then for a part of it: there the mean is the area under the
    # line of the stretch.
    if abs(twist) - abs(half) >= gap:
        return twist - math.copysign(gap, twist)
    if abs(twist) + abs(half) <= gap:
        return 0.0
    after, before = max(abs(twist + half) - gap, 0.0), max(abs(twist - half) - gap, 0.0)
    return 0.25 * (after * after - before * before) / half


def _coupling_torque(
    m: Vector, twist: float, half: float, difference: float, torque: float, weight: float
) -> float:
    """Return the torque from motor to load; ``twist`` in u and ``difference`` in u/s, motor less load,
    ``half`` the change of the twist in half a step.
    """
    stretched = stretch(m[HALF_GAP], twist, half)
    if stretched == 0.0:
        return 0.0
    coupling = m[STIFFNESS] * stretched + (m[DAMPING] * difference - m[FROM_WEIGHT] * weight)
    coupling += m[FROM_TORQUE] * torque
    # A spring with a gap pushes only: damping alone must not make it pull while it lets go.
    if m[HALF_GAP] > 0.0 and coupling * stretched < 0.0:
        return 0.0
    return coupling


def advance(
    m: Vector,
    motor_position: float,
    motor: float,
    load_position: float,
    load: float,
    torque: float,
    error_sum: float,
    against: float,
    output: float,
    h: float,
) -> PlantState:
    """Return the state of the plant one physics step of ``h`` s later; ``output`` is what reaches the
    drive.
    """
    target, error_sum = _wanted_torque(m, output, motor, error_sum, against, h)
    mean = target
    if m[LAG_MEAN] > 0.0:  # a current loop that is not ideal
        mean = target + (torque - target) * m[LAG_MEAN]
        target += (torque - target) * m[LAG]
    torque = target
    # Half the drift before the kick and half after it: positions and speeds are known at the same moments,
    # and the scheme stays of second order.
    motor_position += 0.5 * h * motor
    if m[TWO_MASSES] == 0.0:
        push = mean - m[GRAVITY] - m[SPRING] * motor_position
        before, motor = motor, speed_after(m, 0, motor, push)
        motor_position += 0.5 * h * motor
        # Torque that became no speed: friction and load, which the drive gives back in the next step.
        against = mean - m[TORQUE_OF_CHANGE] * (motor - before)
        return motor_position, motor, motor_position, motor, torque, error_sum, against
    load_position += 0.5 * h * load
    weight = -m[GRAVITY] - m[SPRING] * load_position
    twist, difference = motor_position - load_position, motor - load
    coupling = _coupling_torque(m, twist, 0.5 * h * difference, difference, mean, weight)
    before, motor = motor, speed_after(m, MOTOR, motor, mean - coupling)
    load = speed_after(m, LOAD, load, coupling + weight)
    motor_position += 0.5 * h * motor
    load_position += 0.5 * h * load
    # As above, of the motor: the drive closes its loop on it, not on the load.
    against = mean - m[TORQUE_OF_CHANGE] * (motor - before)
    return motor_position, motor, load_position, load, torque, error_sum, against
