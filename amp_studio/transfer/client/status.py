"""The status of a control, over one line that stays open between two questions."""

from __future__ import annotations

from amp_studio.transfer.driver import ControlDriver
from amp_studio.transfer.links import parse_endpoint
from amp_studio.transfer.status import ControlStatus, ShowsStatus
from amp_studio.transfer.ways import SCREEN

from .drivers import open_driver_at
from .screen import ScreenReader


class StatusReader:
    """Asks one control what it is doing; raises TransferError. Closed by the one who made it."""

    def __init__(self, address: str, family: str = "") -> None:
        place = parse_endpoint(address)
        self._asked: ControlDriver | ScreenReader = (
            ScreenReader(place) if place.protocol == SCREEN else open_driver_at(address, family)
        )

    def read(self) -> ControlStatus:
        """Return the status now; of a protocol without one, who answers and whether it is in E-stop."""
        if isinstance(self._asked, ShowsStatus | ScreenReader):
            return self._asked.status()
        known = self._asked.identify()
        state = "" if known.in_estop is None else "E-stop" if known.in_estop else "ready"
        return ControlStatus(
            known.family,
            known.protocol,
            known.name,
            state,
            assumptions=("This protocol shows neither positions nor faults.",),
        )

    def close(self) -> None:
        """Close the line."""
        self._asked.close()
