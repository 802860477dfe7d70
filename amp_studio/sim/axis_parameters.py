"""Reads the parameters of one axis for a simulation; errors name the missing parameter.

A parameter file is one function here: the value of a parameter by id and instance, in the
canonical unit of its quantity, a choice as its key, yes/no as a bool, None if it is not set.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from amp_studio.schema import Address, Table

from .errors import SimulationError

ParameterValue = float | str | bool | None
ReadParameter = Callable[[str, str], ParameterValue]
"""value(parameter id, instance) -> ParameterValue; the instance of a global parameter is ''."""


def _by_id(address: Address) -> str:
    return address[0]


class AxisParameters:
    """The values of one axis; overrides come first, and their use is recorded."""

    def __init__(
        self,
        value: ReadParameter,
        axis: str,
        overrides: Mapping[str, ParameterValue],
        tables: Mapping[str, Table] | None = None,
        machine: str = "",
        application: str = "",
        label: Callable[[Address], str] = _by_id,
    ) -> None:
        self._value, self.axis, self._overrides = value, axis, dict(overrides)
        self._label = label
        """What a parameter is called in an error: its number and name, where the schema is at hand."""
        self.tables = tables or {}
        """The printed tables of the family by name."""
        self.machine, self.application = machine, application
        """Machine type and application of the file."""
        self._used: set[str] = set()

    def of(self, axis: str) -> AxisParameters:
        """Return the values of another axis of the same file."""
        # The overrides are of one axis; for another one they would be wrong values.
        return AxisParameters(self._value, axis, {}, self.tables, self.machine, self.application, self._label)

    def is_overridden(self, parameter: str) -> bool:
        """Return whether a value is overridden."""
        return self._overrides.get(parameter) is not None

    def value(self, parameter: str, *, everywhere: bool = False, at: str | None = None) -> ParameterValue:
        """Return a value or None; ``everywhere`` for a parameter that does not belong to an axis, ``at`` for
        an instance that is not the axis.
        """
        if parameter in self._overrides:
            self._used.add(parameter)
            return self._overrides[parameter]
        # The figures of the machine are in no file: without an override there is none.
        if parameter.startswith("model."):
            return None
        return self._value(*self._address(parameter, everywhere=everywhere, at=at))

    def number(self, parameter: str, *, everywhere: bool = False, at: str | None = None) -> float:
        """Return a number; raises SimulationError if it is not set or not a number."""
        figure = self.value(parameter, everywhere=everywhere, at=at)
        if figure is None:
            raise self._missing(self._address(parameter, everywhere=everywhere, at=at))
        return self._float(parameter, figure)

    def optional(self, parameter: str, *, everywhere: bool = False, at: str | None = None) -> float | None:
        """Return a number, or None if it is not set; raises SimulationError for anything else."""
        figure = self.value(parameter, everywhere=everywhere, at=at)
        return None if figure is None else self._float(parameter, figure)

    def within(self, parameter: str, least: float, most: float, *, everywhere: bool = False) -> float:
        """Return a number from ``least`` to ``most``;
        raises SimulationError for one that no motion could be computed with.
        """
        figure = self.number(parameter, everywhere=everywhere)
        if not least <= figure <= most:
            raise SimulationError(
                f"{self.called(parameter, everywhere=everywhere)} of axis {self.axis} is"
                f" {figure:g}; it can be simulated from {least:g} to {most:g}",
                parameter,
            )
        return figure

    def above_zero(self, parameter: str, most: float = 1e9) -> float:
        """Return a number above 0, ``most`` at most; raises SimulationError for another one."""
        figure = self.number(parameter)
        if figure <= 0.0:
            raise SimulationError(
                f"{self.called(parameter)} of axis {self.axis} is {figure:g}; it must be above 0", parameter
            )
        return self.within(parameter, 0.0, most)

    def require(self, addresses: Iterable[Address]) -> None:
        """Raise one SimulationError with all of these parameters that are not set."""
        missing = [address for address in addresses if self.value(address[0], at=address[1]) is None]
        if missing:
            raise SimulationError(
                f"The simulation of axis {self.axis} needs values that are not set:"
                f" {', '.join(map(self._name, missing))}",
                missing[0][0],
            )

    def called(self, parameter: str, *, everywhere: bool = False, at: str | None = None) -> str:
        """Return what a sentence calls a parameter: its number and name; a setting keeps its id."""
        return self._name(self._address(parameter, everywhere=everywhere, at=at))

    def choice(self, parameter: str, *, everywhere: bool = False) -> str:
        """Return the key of a choice; raises SimulationError if it is not set."""
        key = self.value(parameter, everywhere=everywhere)
        if key is None:
            raise self._missing(self._address(parameter, everywhere=everywhere))
        return str(key)

    def _missing(self, address: Address) -> SimulationError:
        """Return the error for a parameter that is not set."""
        return SimulationError(
            f"{self._name(address)} is not set for axis {self.axis}. The simulation needs it: set a value",
            address[0],
        )

    def _address(self, parameter: str, *, everywhere: bool = False, at: str | None = None) -> Address:
        return parameter, ("" if everywhere else self.axis) if at is None else at

    def _name(self, address: Address) -> str:
        return address[0] if address[0].startswith("model.") else self._label(address)

    def refuse_unused(self) -> None:
        """Raise SimulationError for an override that was not used, so that a typing error is noticed."""
        # Only known after the axis is bound: which parameters a law reads depends on the values of others.
        for parameter in self._overrides:
            if parameter not in self._used:
                raise SimulationError(
                    f"{self.called(parameter)} is not used in the simulation of axis {self.axis}", parameter
                )

    def _float(self, parameter: str, figure: ParameterValue) -> float:
        # A bool is an int in Python: yes would go on as 1.0.
        if isinstance(figure, (bool, str)) or figure is None:
            raise SimulationError(
                f"{self.called(parameter)} of axis {self.axis} is {figure!r}, not a number", parameter
            )
        return float(figure)
