"""From an open parameter file to a trace."""

from __future__ import annotations

from collections.abc import Mapping

from amp_studio.files import ParameterFile, fitted_axes
from amp_studio.schema.nearest import unknown_name

from .axis_parameters import ParameterValue
from .law import law_of
from .scenarios import SCENARIOS
from .servo import SimulationError
from .trace import Trace


def simulate(
    file: ParameterFile,
    scenario: str,
    axis: str | None = None,
    settings: Mapping[str, float | str] | None = None,
) -> Trace:
    """Run a scenario with the present values of a file; ``axis`` None means the first fitted axis.

    ``settings`` are settings of the scenario and of the model (``move.feedrate``), in canonical units.
    Raises SimulationError with the parameter that is missing or impossible.
    """
    if scenario not in SCENARIOS:
        raise SimulationError(unknown_name("scenario", scenario, SCENARIOS))
    fitted = fitted_axes(file)
    if not fitted:
        raise SimulationError("No axis is fitted. Set the type of an axis first")
    chosen = axis or fitted[0]
    if chosen not in fitted:
        raise SimulationError(f"Axis {chosen} is not fitted. Fitted: {', '.join(fitted)}")

    family = file.schema.family.family

    def value(parameter_id: str, instance: str) -> ParameterValue:
        return file.evaluation.canonical((parameter_id, instance))

    return SCENARIOS[scenario].run(
        value,
        chosen,
        settings or {},
        family,
        law_of(family).standard_gains(file.schema.tables),
    )
