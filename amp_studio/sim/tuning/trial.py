"""Other values of a parameter, tried on an axis without a change to the file."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from amp_studio.files import ParameterFile, RangeError
from amp_studio.schema import Address, Value, limits
from amp_studio.sim.axis_parameters import ParameterValue
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw


def address_of(file: ParameterFile, parameter: str, axis: str) -> Address | None:
    """Return the address of a parameter that a result for an axis names; None if it is not one of the
    file's.
    """
    found = file.schema.parameters.get(parameter)
    if found is None:
        return None
    instances = file.machine_schema.instances(found)
    if axis in instances:
        return parameter, axis
    return (parameter, instances[0]) if len(instances) == 1 else None


def named_parameter(file: ParameterFile, parameter: str, axis: str) -> str:
    """Return how a parameter that a result for an axis names is written: as ``set`` reads it."""
    address = address_of(file, parameter, axis)
    return file.machine_schema.short(address) if address else parameter


def called_parameter(file: ParameterFile, parameter: str, axis: str) -> str:
    """Return what a parameter that a result for an axis names is called: its number and name."""
    address = address_of(file, parameter, axis)
    return file.machine_schema.named(address) if address else parameter


class Trial:
    """One axis of a file, bound with other values one after the other."""

    def __init__(
        self,
        file: ParameterFile,
        bind: Callable[[ParameterFile], AxisLaw],
        settings: Mapping[str, ParameterValue] | None = None,
    ) -> None:
        self._file, self._bind = file.copy(), bind
        self.settings = settings or {}
        """The settings of its machine that ``bind`` uses."""
        self.axis = bind(self._file)
        """The axis as it is."""

    @property
    def file(self) -> ParameterFile:
        """Its file, a copy that nothing else changes."""
        return self._file

    def value(self, parameter: str) -> Value | None:
        """Return the number that a parameter has; None if it has none."""
        address = address_of(self._file, parameter, self.axis.axis)
        value = self._file.get(address) if address else None
        return (
            value
            if value and isinstance(value.value, (int, float)) and not isinstance(value.value, bool)
            else None
        )

    def range_of(self, parameter: str) -> tuple[float | None, float | None]:
        """Return the bounds of a parameter in the unit that its value has; None where there is none."""
        address, value = address_of(self._file, parameter, self.axis.axis), self.value(parameter)
        found = limits(self._file.evaluation, address, value.unit) if address and value else None
        return (found.low, found.high) if found else (None, None)

    def decimals(self, parameter: str) -> int | None:
        """Return the decimals that the control keeps of a parameter; None where all."""
        storage = self._file.schema.parameters[parameter].storage
        return storage.decimals if storage else None

    def unit(self, parameter: str) -> str:
        """Return the unit in which a number of a parameter is written."""
        value = self.value(parameter)
        return value.unit if value else next(iter(self._file.schema.parameters[parameter].ranges or {}), "")

    def called(self, parameter: str) -> str:
        """Return what a sentence calls a parameter: its number and name."""
        return called_parameter(self._file, parameter, self.axis.axis)

    def _written(self, parameter: str, number: float, old: Value | None) -> Value:
        """Return a number as the value of a parameter: whole where the present one is."""
        is_whole = old is not None and isinstance(old.value, int)
        return Value(int(number) if is_whole else number, self.unit(parameter))

    def bound(self, numbers: Mapping[str, float]) -> AxisLaw | None:
        """Return the axis with other values of parameters;
        None if one is out of range or it cannot be simulated.
        """
        wanted: dict[Address, Value] = {}
        for parameter, number in numbers.items():
            address, old = address_of(self._file, parameter, self.axis.axis), self.value(parameter)
            if address is None:
                return None
            wanted[address] = self._written(parameter, number, old)
        before = {address: self._file.get(address) for address in wanted}
        try:
            self._file.set_checked(wanted)
            return self._bind(self._file)
        except (RangeError, SimulationError):
            return None
        finally:
            # Unchecked: the value of the file may itself be out of range, and has to come back.
            for address, value in before.items():
                self._file.set(address, value)
