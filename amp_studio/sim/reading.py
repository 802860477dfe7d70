"""Reads the parameters of one axis for a simulation, and says plainly which one is missing.

All it knows of a parameter file is one question: the value of a parameter by id and instance, in the
canonical unit of its quantity, a choice as its key, yes/no as a bool, None where nothing is set.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from .servo import SimulationError

Value = float | str | bool | None
ValueOf = Callable[[str, str], Value]
"""value(parameter id, instance) -> Value; the instance of a global parameter is ''."""
MotorGains = Callable[[str, str], tuple[float, float] | None]
"""gains(motor type, load inertia ratio) -> (velocity proportional gain, velocity integral gain), or None."""


class Readings:
    """The values of one axis, those given by hand first; keeps account of which of those were used."""

    def __init__(self, value: ValueOf, axis: str, overrides: Mapping[str, Value]) -> None:
        self._value, self.axis, self._overrides = value, axis, dict(overrides)
        self._used: set[str] = set()

    def given(self, parameter: str) -> bool:
        """Say whether a value was given by hand."""
        return self._overrides.get(parameter) is not None

    def value(self, parameter: str, *, everywhere: bool = False) -> Value:
        """Return a value or None; ``everywhere`` for a parameter that is not one of the axis."""
        if parameter in self._overrides:
            self._used.add(parameter)
            return self._overrides[parameter]
        return self._value(parameter, "" if everywhere else self.axis)

    def number(self, parameter: str, *, everywhere: bool = False) -> float:
        """Return a number; raises SimulationError where it is not set or not a number."""
        figure = self.value(parameter, everywhere=everywhere)
        if figure is None:
            raise self.missing(parameter)
        return self._float(parameter, figure)

    def optional(self, parameter: str, *, everywhere: bool = False) -> float | None:
        """Return a number, or None where it is not set; raises SimulationError for something else."""
        figure = self.value(parameter, everywhere=everywhere)
        return None if figure is None else self._float(parameter, figure)

    def choice(self, parameter: str, *, everywhere: bool = False) -> str:
        """Return the key of a choice; raises SimulationError where it is not set."""
        key = self.value(parameter, everywhere=everywhere)
        if key is None:
            raise self.missing(parameter)
        return str(key)

    def missing(self, parameter: str) -> SimulationError:
        """Return the error that says a parameter is not set."""
        return SimulationError(
            f"{parameter} is not set for axis {self.axis}; the simulation needs it", parameter
        )

    def refuse_unused(self) -> None:
        """Raise SimulationError for a value given by hand that nothing read, so that a slip cannot hide."""
        for parameter in self._overrides:
            if parameter not in self._used:
                raise SimulationError(
                    f"{parameter} plays no part in the simulation of axis {self.axis}", parameter
                )

    def _float(self, parameter: str, figure: Value) -> float:
        if isinstance(figure, (bool, str)) or figure is None:
            raise SimulationError(f"{parameter} of axis {self.axis} is {figure!r}, not a number", parameter)
        return float(figure)
