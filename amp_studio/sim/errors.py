"""The error of the simulator."""

from __future__ import annotations

from amp_studio.errors import AmpStudioError


class SimulationError(AmpStudioError, ValueError):
    """A simulation is not possible; contains a message and the parameter, if there is one."""

    def __init__(self, what: str, parameter: str = "") -> None:
        self.what, self.parameter = what, parameter
        super().__init__(what)
