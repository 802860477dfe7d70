"""Steps, speeds and ramps."""

from __future__ import annotations

from amp_studio.validate import not_negative, positive


def steps_per_unit(motor_steps: float, microsteps: float, travel: float) -> float:
    """Steps for one mm of an axis that moves ``travel`` mm with a turn of the motor: 200 steps,
    16 microsteps, 5 mm: 640.
    """
    turn = positive("The steps of a turn", motor_steps) * positive("The microsteps", microsteps)
    return turn / positive("The travel of a turn", travel)


def step_rate(rate: float, steps: float) -> float:
    """Steps in a second at a speed per minute (S2243): 3000 mm/min with 80 steps/mm are 4000 Hz."""
    return not_negative("The rate", rate) * not_negative("The steps", steps) / 60.0


def ramp_travel(rate: float, acceleration: float) -> float:
    """Travel on which an axis comes up to a speed per minute and stops again:
    3000 mm/min at 500 mm/s² need 5 mm.
    """
    speed = not_negative("The rate", rate) / 60.0
    return speed * speed / positive("The acceleration", acceleration)
