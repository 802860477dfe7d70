"""The plant: one physics step of drive and mechanics over flat arrays, compiled with the kernel or run as it stands.

``m`` is the array of `machine.machine_array`, ``x`` the state. Torque is constant over a step, so that one rigid mass moves
exactly; two masses move by drift, kick, drift (the leapfrog scheme, E. Hairer, C. Lubich, G. Wanner, Geometric Numerical
Integration, 2006), of second order and without a drift of energy. Dry friction after D. Karnopp, Computer Simulation of
Stick-Slip Friction in Mechanical Dynamic Systems (ASME Journal of Dynamic Systems, Measurement, and Control 107, 1985);
backlash as a spring with a gap, that can push but not pull.
"""

from __future__ import annotations

import math

from .arrays import Vector
from .machine import (
    ACCELERATION,
    COULOMB,
    DAMPING,
    DELAY_SHARE,
    DELAY_STEPS,
    GRAVITY,
    HALF_GAP,
    LAG,
    LAG_MEAN,
    LOAD_ACCELERATION,
    MOTOR_ACCELERATION,
    MOTOR_COULOMB,
    MOTOR_STATIC,
    MOTOR_VISCOUS,
    OUTPUT_LIMIT,
    SPRING,
    STATIC,
    STIFFNESS,
    TORQUE_NEGATIVE,
    TORQUE_POSITIVE,
    TWO_MASSES,
    VELOCITY_GAIN,
    VELOCITY_INTEGRAL,
    VELOCITY_PER_OUTPUT,
    VISCOUS,
)

MOTOR_POSITION, MOTOR_SPEED, LOAD_POSITION, LOAD_SPEED = 0, 1, 2, 3
TORQUE = 4
"""Torque of the motor at the end of the last step."""
ERROR_SUM = 5
"""u: integral of the velocity error in a drive with a velocity loop."""
SLOT = 6
"""Place of the next output in the delay line."""
SAMPLES, COMMAND_TIME, SHARE, PIECE = 7, 8, 9, 10
"""Servo samples since the start; time, s, and piece of the command; share of the feedrate."""
RESTLESS, ENDED = 11, 12
"""Sample of the last motion, sample at which the command ended (-1 before)."""
LINE = 16
"""Start of the delay line: the outputs of the last physics steps."""


def state_size(delay_steps: int) -> int:
    """Return the length of the state."""
    return LINE + delay_steps + 2


def delayed(m: Vector, x: Vector, output: float) -> float:
    """Return the output that reaches the drive in this step, limited; the mean where a step sees two of them."""
    if m[OUTPUT_LIMIT] < math.inf:
        output = min(max(output, -m[OUTPUT_LIMIT]), m[OUTPUT_LIMIT])
    if m[DELAY_STEPS] == 0.0 and m[DELAY_SHARE] == 0.0:
        return output
    length = int(m[DELAY_STEPS]) + 2
    slot = int(x[SLOT])
    x[LINE + slot] = output
    newer = slot - int(m[DELAY_STEPS])
    if newer < 0:
        newer += length
    older = newer - 1
    if older < 0:
        older += length
    following = slot + 1
    x[SLOT] = float(following) if following < length else 0.0
    return (1.0 - m[DELAY_SHARE]) * x[LINE + newer] + m[DELAY_SHARE] * x[LINE + older]


def motor_torque(m: Vector, x: Vector, output: float, h: float) -> float:
    """Return the mean torque of the motor in a step of ``h`` s, and put the torque at its end into the state."""
    target = output
    if m[VELOCITY_PER_OUTPUT] > 0.0:
        error = m[VELOCITY_PER_OUTPUT] * output - x[MOTOR_SPEED]
        asked = m[VELOCITY_GAIN] * (error + m[VELOCITY_INTEGRAL] * x[ERROR_SUM])
        target = min(max(asked, -m[TORQUE_NEGATIVE]), m[TORQUE_POSITIVE])
        if target == asked or error * asked < 0.0:  # at its limit it does not sum what would go further
            x[ERROR_SUM] += h * error
    else:
        target = min(max(target, -m[TORQUE_NEGATIVE]), m[TORQUE_POSITIVE])
    mean = target + (x[TORQUE] - target) * m[LAG_MEAN]
    x[TORQUE] = target + (x[TORQUE] - target) * m[LAG]
    return mean


def speed_after(
    speed: float, push: float, acceleration: float, viscous: float, coulomb: float, static: float, h: float
) -> float:
    """Return the speed in u/s after ``h`` s under the torque ``push`` and friction.

    A mass at rest stays there until the push is above the static friction; one whose speed changes its sign is at rest.
    """
    if speed == 0.0:
        if abs(push) <= static:
            return 0.0
        dry = math.copysign(coulomb, push)
    else:
        dry = math.copysign(coulomb, speed)
    drag = 0.5 * h * acceleration * viscous
    after = ((1.0 - drag) * speed + h * acceleration * (push - dry)) / (1.0 + drag)
    if after * dry < 0.0:
        return 0.0
    return after


def advance(m: Vector, x: Vector, output: float, h: float) -> None:
    """Move the plant by one physics step of ``h`` s."""
    torque = motor_torque(m, x, delayed(m, x, output), h)
    if m[TWO_MASSES] == 0.0:
        speed, position = x[MOTOR_SPEED], x[MOTOR_POSITION]
        push = torque - m[GRAVITY] - m[SPRING] * (position + 0.5 * h * speed)
        after = speed_after(
            speed,
            push,
            m[ACCELERATION],
            m[VISCOUS] + m[MOTOR_VISCOUS],
            m[COULOMB] + m[MOTOR_COULOMB],
            m[STATIC] + m[MOTOR_STATIC],
            h,
        )
        x[MOTOR_POSITION] = x[LOAD_POSITION] = position + 0.5 * h * (speed + after)
        x[MOTOR_SPEED] = x[LOAD_SPEED] = after
        return
    motor, load = x[MOTOR_SPEED], x[LOAD_SPEED]
    motor_position = x[MOTOR_POSITION] + 0.5 * h * motor
    load_position = x[LOAD_POSITION] + 0.5 * h * load
    weight = -m[GRAVITY] - m[SPRING] * load_position
    coupling = coupling_torque(m, motor_position - load_position, motor - load, torque, weight, h)
    motor = speed_after(
        motor,
        torque - coupling,
        m[MOTOR_ACCELERATION],
        m[MOTOR_VISCOUS],
        m[MOTOR_COULOMB],
        m[MOTOR_STATIC],
        h,
    )
    load = speed_after(load, coupling + weight, m[LOAD_ACCELERATION], m[VISCOUS], m[COULOMB], m[STATIC], h)
    x[MOTOR_SPEED], x[LOAD_SPEED] = motor, load
    x[MOTOR_POSITION] = motor_position + 0.5 * h * motor
    x[LOAD_POSITION] = load_position + 0.5 * h * load


def coupling_torque(
    m: Vector, twist: float, difference: float, torque: float, weight: float, h: float
) -> float:
    """Return the torque from motor to load; ``twist`` in u and ``difference`` in u/s, motor less load.

    The damping acts on the mean difference of speeds in the step, so that it takes energy out at any step.
    """
    if abs(twist) <= m[HALF_GAP]:
        return 0.0
    elastic = m[STIFFNESS] * (twist - math.copysign(m[HALF_GAP], twist))
    both = m[MOTOR_ACCELERATION] + m[LOAD_ACCELERATION]
    kick = m[MOTOR_ACCELERATION] * torque - m[LOAD_ACCELERATION] * weight - both * elastic
    mean = (difference + 0.5 * h * kick) / (1.0 + 0.5 * h * both * m[DAMPING])
    coupling = elastic + m[DAMPING] * mean
    if m[HALF_GAP] > 0.0 and coupling * elastic < 0.0:
        return 0.0
    return coupling
