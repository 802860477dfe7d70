"""One axis of an open file with its machine."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, axis_name

from .axis_parameters import AxisParameters, ParameterValue, ReadParameter
from .errors import SimulationError
from .law import AxisLaw, Law
from .model import with_model


def bind_axis(
    file: ParameterFile,
    law: Law,
    axis: str | None = None,
    overrides: Mapping[str, ParameterValue] | None = None,
    on_read: Callable[[Address], None] = lambda _address: None,
) -> AxisLaw:
    """Return one axis of a file, named by itself or its letter, with its machine; ``overrides`` are values by
    parameter id or ``model.*``, ``on_read`` is called with each address that is read.

    Raises SimulationError for an axis that is not fitted, a value that is missing,
    an override that is not used.
    """
    fitted = tuple(law.axes(file))
    if not fitted:
        raise SimulationError(law.motion.without_axes)
    chosen = axis or fitted[0]
    if chosen not in fitted:
        chosen = next((each for each in fitted if axis_name(file.evaluation, each) == chosen.upper()), chosen)
    if chosen not in fitted:
        raise SimulationError(f"Axis {chosen} is not fitted. Fitted: {', '.join(fitted)}")
    read = AxisParameters(
        axis_values(file, on_read),
        chosen,
        overrides or {},
        file.schema.tables,
        file.machine,
        file.header.application,
        parameter_names(file),
    )
    bound = with_model(law.bind(read), read)
    read.refuse_unused()
    return bound


def parameter_names(file: ParameterFile) -> Callable[[Address], str]:
    """Return what errors call a parameter: its number and name, or the name; the error has the axis."""
    schema = file.machine_schema

    def name(address: Address) -> str:
        number, plain = schema.number(address), schema.parameters[address[0]].name
        # A disputed number really belongs to another parameter: it would name that one.
        return f"{number} {plain}" if number and not schema.is_disputed(address[0]) else plain

    return name


def axis_values(
    file: ParameterFile, on_read: Callable[[Address], None] = lambda _address: None
) -> ReadParameter:
    """Return how the values of a file are read; ``on_read`` is called with each address."""

    def value(parameter_id: str, instance: str) -> ParameterValue:
        on_read((parameter_id, instance))
        return file.evaluation.canonical((parameter_id, instance))

    return value
