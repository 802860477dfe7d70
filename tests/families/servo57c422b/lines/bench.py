"""A driver at an emulated rack, in a simulated time; faults may be put on each line."""

from collections.abc import Callable
from pathlib import Path

from amp_studio.families.servo57c422b.emulated.rack import Rack
from amp_studio.families.servo57c422b.lines.driver import RegisterDriver
from amp_studio.transfer import Waiting
from amp_studio.transfer.emulated.line_device import DeviceSetup
from amp_studio.transfer.emulated.memory import Memory
from amp_studio.transfer.links.link import Link, LinkError
from tests.transfer.device_line import DeviceLine
from tests.transfer.null_modem import VirtualClock


class RackBench:
    """``wrap`` may put faults on each line; ``is_up`` is whether anybody listens."""

    def __init__(self, folder: Path) -> None:
        self.clock = VirtualClock()
        self.wrap: Callable[[Link], Link] = lambda link: link
        self.is_up = True
        self.rack = Rack(DeviceSetup("57c422b", Memory(folder), print))
        self.driver = RegisterDriver(self._open, Waiting(self.clock, self.clock.sleep))

    @property
    def words(self) -> list[int]:
        """The registers of the module."""
        return self.rack.module.words

    def _open(self, _look: Callable[[], None]) -> Link:
        if not self.is_up:
            raise LinkError("bench", "nothing listens there")
        self.rack.connected()
        return self.wrap(DeviceLine(self.rack, self.clock))
