"""A driver at an emulated ACR card, in a simulated time; faults may be put on each line and into the save."""

from collections.abc import Callable
from pathlib import Path

from amp_studio.families.acromill.emulated.card import AcrCard
from amp_studio.families.acromill.lines.driver import MetricTerminalDriver, TerminalDriver
from amp_studio.transfer import Waiting
from amp_studio.transfer.emulated.line_device import DeviceSetup
from amp_studio.transfer.emulated.memory import Memory
from amp_studio.transfer.links.link import Link, LinkError
from tests.transfer.device_line import DeviceLine
from tests.transfer.null_modem import VirtualClock


class CardBench:
    def __init__(self, folder: Path, system: str = "inch") -> None:
        self.folder = folder
        self.clock = VirtualClock()
        self.wrap: Callable[[Link], Link] = lambda link: link
        self.is_up = True
        self.lines: list[DeviceLine] = []
        self.card = self.switch_on()
        kind = MetricTerminalDriver if system == "metric" else TerminalDriver
        self.driver = kind(self._open, Waiting(self.clock, self.clock.sleep))

    def switch_on(self) -> AcrCard:
        """Begin with what is saved."""
        self.card = AcrCard(DeviceSetup("acromill", Memory(self.folder), print))
        return self.card

    def execute(self, line: str) -> list[str]:
        """Do a command at another terminal of the card."""
        return self.card.settings.execute(line)

    def _open(self, _look: Callable[[], None]) -> Link:
        if not self.is_up:
            raise LinkError("bench", "nothing listens there")
        line = DeviceLine(self.card, self.clock)
        self.card.connected()
        self.lines.append(line)
        return self.wrap(line)
