"""Reads figures that a motion can be computed with;
an absurd one is refused with its parameter and the reason.
"""

from __future__ import annotations

from amp_studio.sim import AxisParameters, SimulationError

SMALLEST, LARGEST = 1e-9, 1e9
"""Beyond both no figure of a machine is, in any unit of these parameters."""


def above_zero(read: AxisParameters, name: str, *, everywhere: bool = False) -> float:
    """Return a figure that must be above 0; raises SimulationError where it is not set or impossible."""
    value = read.number(name, everywhere=everywhere)
    demand(read, name, value, value > 0.0, "must be above 0", everywhere=everywhere)
    return value


def not_negative(read: AxisParameters, name: str, *, most: float = LARGEST, unit: str = "") -> float:
    """Return a figure from 0 to ``most``; raises SimulationError where it is not set or impossible."""
    value = read.number(name)
    demand(read, name, value, value >= 0.0, "must not be negative")
    demand(read, name, value, value <= most, f"must be {most:g}{unit} or less")
    return value


def if_set(read: AxisParameters, name: str, otherwise: float = 0.0) -> float:
    """Return a figure that must not be negative; ``otherwise`` where it is not set."""
    return otherwise if read.optional(name) is None else not_negative(read, name)


def demand(
    read: AxisParameters, name: str, value: float, good: bool, what: str, *, everywhere: bool = False
) -> None:
    """Raise SimulationError with the reason ``what`` unless a value is good, and for one beyond all
    machines.
    """
    parameter = read.called(name, everywhere=everywhere)
    if not good:
        raise SimulationError(f"{parameter} is {value:g}; it {what}", name)
    if value != 0.0 and not SMALLEST <= abs(value) <= LARGEST:
        raise SimulationError(
            f"{parameter} is {value:g}, which no machine has; it must be from {SMALLEST:g} to {LARGEST:g}",
            name,
        )
