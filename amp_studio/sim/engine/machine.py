"""The machine of one axis without its control: mechanics, drive and measuring devices, as plain figures.

Lengths are in the unit u of the axis (mm or deg), times in s. "Output" is what the law gives to the drive, in
the law's own unit. Torque is in the unit of the output where the output is a torque (``velocity_per_output``
0), in % of rated torque where the drive closes a velocity loop itself.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from amp_studio.sim.errors import SimulationError

_CONTACT = 150.0
"""Hz: resonance of motor and load in contact, of an axis that has backlash but no given resonance;
an assumption."""
_CONTACT_DAMPING = 1.0
"""Damping ratio of that contact: it adds no further oscillation; an assumption."""
_RESONANCE_DAMPING = 0.05
"""Damping ratio of a resonance that is given without one; an assumption."""

LARGEST = {
    "acceleration_per_output": 1e12,
    "inertia_ratio": 1e4,
    "coulomb_friction": 1e9,
    "static_friction": 1e9,
    "backlash": 1e6,
    "damping": 10.0,
    "gravity": 1e9,
    "delay": 1.0,
}
"""The largest figures of a machine that are simulated; in u and s."""

_STIFFEST = 1e7
"""1/s: the highest rate of a machine that is simulated."""

_INERTIA_ASSUMED = 1.0
"""Load inertia / motor inertia of an axis with two masses and no given ratio; an assumption."""


@dataclass(frozen=True)
class Machine:
    """The machine of one axis; raises SimulationError for impossible figures."""

    acceleration_per_output: float
    """u/s2 for one unit of torque, motor and load together, without friction."""
    inertia_ratio: float = 0.0
    """Inertia of the load / inertia of the motor. It only divides the axis in two masses; it does not change
    the acceleration."""
    viscous_friction: float = 0.0
    """Torque for 1 u/s."""
    coulomb_friction: float = 0.0
    """Torque while the axis moves."""
    static_friction: float = 0.0
    """Torque that starts an axis at rest; below ``coulomb_friction`` it is taken as that."""
    motor_friction: float = 0.0
    """Share of the friction on the motor's side, 0 to 1."""
    backlash: float = 0.0
    """u between both directions."""
    resonance: float = 0.0
    """Hz: motor and load against each other; 0 for one rigid mass."""
    damping: float | None = None
    """Damping ratio of motor and load against each other; None for that of a contact or of a resonance."""
    gravity: float = 0.0
    """Torque that balances the weight of the axis; a positive one acts in the negative direction."""
    brake: float = 0.0
    """Torque of a brake that closes when an alarm takes the output from the drive."""
    spring: float = 0.0
    """Torque for 1 u away from the start."""
    velocity_per_output: float = 0.0
    """u/s for one unit of output of a drive that closes a velocity loop; 0 for a drive that gives a
    torque."""
    velocity_bandwidth: float = 0.0
    """Hz: the velocity loop of such a drive."""
    velocity_integral: float = 0.0
    """1/s: reciprocal of its integral time; 0 for none."""
    bandwidth: float = 0.0
    """Hz: current loop; 0 for an ideal one."""
    delay: float = 0.0
    """s from a sample to its effect on the drive."""
    output_limit: float = math.inf
    torque_limit_positive: float = math.inf
    torque_limit_negative: float = math.inf
    """As a positive number."""
    motor_count: float = 0.0
    """u for one count of the motor's device; 0 for an ideal one."""
    position_count: float = 0.0
    """u for one count of the position device."""
    load_sensor: bool = False
    """Whether the position device is at the load (a scale), not at the motor."""

    def __post_init__(self) -> None:
        for name, figure in vars(self).items():
            if figure is None:
                continue
            value = float(figure)
            if math.isnan(value) or (math.isinf(value) and "limit" not in name):
                raise SimulationError(f"{words(name)} of the machine is {value:g}; it must be finite")
            if value < 0.0 and name != "gravity":
                raise SimulationError(f"{words(name)} of the machine is {value:g}; it must not be negative")
            if abs(value) > LARGEST.get(name, math.inf):
                raise SimulationError(
                    f"{words(name)} of the machine is {value:g}; at most {LARGEST[name]:g} is simulated"
                )
        if self.acceleration_per_output == 0.0:
            raise SimulationError("The acceleration per output of the machine is 0; it must be above 0")
        if self.motor_friction > 1.0:
            raise SimulationError(f"The motor's share of the friction is {self.motor_friction:g}; at most 1")
        if self.velocity_per_output > 0.0 and self.velocity_bandwidth == 0.0:
            raise SimulationError("The velocity loop of the drive has no bandwidth; it must be above 0 Hz")
        # Written with "not", so that a rate that is no number (0 times infinity) is refused too.
        if not self.fastest <= _STIFFEST:
            raise SimulationError(f"The machine is too stiff to simulate ({self.fastest:.6g} 1/s)")

    @property
    def two_masses(self) -> bool:
        """Whether motor and load move apart."""
        return self.resonance > 0.0 or self.backlash > 0.0

    @property
    def coupling(self) -> tuple[float, float, float]:
        """Frequency (Hz) and damping ratio of motor and load against each other,
        inertia of the load / inertia of the motor.
        """
        usual = _RESONANCE_DAMPING if self.resonance > 0.0 else _CONTACT_DAMPING
        return (
            self.resonance or _CONTACT,
            usual if self.damping is None else self.damping,
            self.inertia_ratio or _INERTIA_ASSUMED,
        )

    @property
    def fastest(self) -> float:
        """The fastest rate in 1/s that the physics step has to resolve."""
        # Each a rate in 1/s: viscous friction, coupling, spring, velocity loop of the drive and its
        # integral.
        rates = [self.acceleration_per_output * self.viscous_friction]
        if self.two_masses:
            rates.append(2.0 * math.pi * self.coupling[0])
        if self.spring > 0.0:
            rates.append(math.sqrt(self.acceleration_per_output * self.spring))
        if self.velocity_per_output > 0.0:
            loop = 2.0 * math.pi * self.velocity_bandwidth
            rates += [loop, math.sqrt(loop * self.velocity_integral)]
        return max(rates)


def words(name: str) -> str:
    """Return the name of a figure as words."""
    return name.replace("_", " ").capitalize()


# -- the flat array for the plant (`plant.py`) ------------------------------------------------------

KEEP, KICK, COULOMB, STATIC = 0, 1, 2, 3
"""Of the one mass: share of the speed that viscous friction leaves after a step, u/s for one unit of torque
in a step, dry friction in motion and at rest.
Of motor and load of two masses the same four from MOTOR and LOAD on."""
MOTOR, LOAD = 4, 8
STIFFNESS, DAMPING, HALF_GAP = 12, 13, 14
"""Of the coupling, by the mean difference of speeds in a step: torque for 1 u of stretch,
for 1 u/s at its start, u."""
FROM_TORQUE, FROM_WEIGHT = 15, 16
"""Torque in the coupling for one unit of torque on the motor, on the load."""
GRAVITY, SPRING = 17, 18
LAG, LAG_MEAN = 20, 21
"""What is left of a difference between wanted and present torque after one physics step,
and its mean in the step."""
DELAY_STEPS, DELAY_SHARE = 22, 23
"""Delay as whole physics steps and the share of one more."""
OUTPUT_LIMIT, TORQUE_POSITIVE, TORQUE_NEGATIVE = 24, 25, 26
VELOCITY_PER_OUTPUT, VELOCITY_GAIN, VELOCITY_INTEGRAL, TORQUE_PER_OUTPUT = 27, 28, 29, 19
"""u/s for one unit of output, torque for 1 u/s, torque for 1 u of the integral,
torque for one unit of output."""
MOTOR_COUNT, POSITION_COUNT, LOAD_SENSOR, TWO_MASSES = 30, 31, 32, 33
MOTOR_COUNTS, POSITION_COUNTS = 34, 35
"""Counts in 1 u."""
BRAKE = 36
GIVEN_BACK, TORQUE_OF_CHANGE, HALF_CHANGE = 37, 38, 39
"""Of a drive with a velocity loop: share of the torque against it in a step, torque for a change of 1 u/s in
a step, u/s in half a step for one unit of torque."""
SIZE = 40

WHOLE = 1e-9
"""A delay that is so near to a whole number of physics steps is one."""


def machine_array(machine: Machine, step: float) -> list[float]:
    """Return the figures as the plant uses them with physics steps of ``step`` s; indices as above."""
    m = [0.0] * SIZE
    frequency, damping_ratio, ratio = machine.coupling
    own, total = machine.motor_friction, machine.acceleration_per_output
    # u/s2 for one unit of torque on each mass: their reciprocals, the inertias, add up to that of the axis.
    motor, load = total * (1.0 + ratio), total * (1.0 + ratio) / ratio
    m[KEEP : STATIC + 1] = _mass(machine, total, 1.0, step)
    m[MOTOR : MOTOR + STATIC + 1] = _mass(machine, motor, own, step)
    m[LOAD : LOAD + STATIC + 1] = _mass(machine, load, 1.0 - own, step)
    rate = 2.0 * math.pi * frequency
    # A torque in the coupling changes the difference of both speeds by motor + load: 2 ζ ω and ω² over that
    # are damping and stiffness.
    damping = 2.0 * damping_ratio * rate / (motor + load)
    m[HALF_GAP] = 0.5 * machine.backlash
    # The damping acts on the mean difference of speeds in the step, so that it takes energy out at any step.
    m[DAMPING] = damping / (1.0 + 0.5 * step * (motor + load) * damping)
    m[STIFFNESS] = rate * rate / (motor + load) * (1.0 - 0.5 * step * (motor + load) * m[DAMPING])
    m[FROM_TORQUE], m[FROM_WEIGHT] = (0.5 * step * each * m[DAMPING] for each in (motor, load))
    m[GRAVITY], m[SPRING], m[BRAKE] = machine.gravity, machine.spring, machine.brake
    if machine.bandwidth > 0.0:
        lag = 2.0 * math.pi * machine.bandwidth * step
        # expm1: for a short step 1 - exp(-lag) would lose its digits.
        m[LAG], m[LAG_MEAN] = math.exp(-lag), -math.expm1(-lag) / lag
    m[DELAY_STEPS] = math.floor(machine.delay / step + WHOLE)
    share = machine.delay / step - m[DELAY_STEPS]
    m[DELAY_SHARE] = share if share > WHOLE else 0.0
    m[OUTPUT_LIMIT] = machine.output_limit
    m[TORQUE_POSITIVE], m[TORQUE_NEGATIVE] = machine.torque_limit_positive, machine.torque_limit_negative
    if machine.velocity_per_output == 0.0:
        # Where the output is the torque itself, its limit is one of the torque.
        m[TORQUE_POSITIVE], m[TORQUE_NEGATIVE] = (
            min(limit, machine.output_limit) for limit in m[TORQUE_POSITIVE : TORQUE_NEGATIVE + 1]
        )
    else:
        # So an ideal current loop makes the velocity an exact first-order lag, whatever the step is, and
        # exact under a constant load.
        rate = 2.0 * math.pi * machine.velocity_bandwidth
        share = -math.expm1(-rate * step)
        m[GIVEN_BACK], m[TORQUE_OF_CHANGE] = 1.0 - share / (rate * step), 1.0 / (step * total)
        m[HALF_CHANGE] = 0.5 * step * total
        m[VELOCITY_PER_OUTPUT] = machine.velocity_per_output
        m[VELOCITY_GAIN] = share / step / total
        m[VELOCITY_INTEGRAL] = m[VELOCITY_GAIN] * machine.velocity_integral
        m[TORQUE_PER_OUTPUT] = m[VELOCITY_GAIN] * machine.velocity_per_output
    m[MOTOR_COUNT], m[POSITION_COUNT] = machine.motor_count, machine.position_count
    m[MOTOR_COUNTS], m[POSITION_COUNTS] = (
        1.0 / count if count > 0.0 else 0.0 for count in (machine.motor_count, machine.position_count)
    )
    m[LOAD_SENSOR], m[TWO_MASSES] = float(machine.load_sensor), float(machine.two_masses)
    return m


def _mass(machine: Machine, acceleration: float, share: float, step: float) -> list[float]:
    """Return the four figures of one mass that has this share of the friction;
    viscous friction by the mean speed of a step.
    """
    drag = 0.5 * step * acceleration * machine.viscous_friction * share
    static = max(machine.static_friction, machine.coulomb_friction)
    kick = step * acceleration / (1.0 + drag)
    return [(1.0 - drag) / (1.0 + drag), kick, machine.coulomb_friction * share, static * share]
