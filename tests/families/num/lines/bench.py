"""A driver at an emulated NUM control, and a person at its keys who does what the driver's progress asks
for.
"""

from collections.abc import Callable
from pathlib import Path

from amp_studio.families.num.emulated.control import NumControl
from amp_studio.families.num.lines.driver import CheckingPeripheralDriver, PeripheralDriver
from amp_studio.transfer import Waiting
from amp_studio.transfer.emulated.line_device import DeviceSetup
from amp_studio.transfer.emulated.memory import Memory
from amp_studio.transfer.links.link import Link
from amp_studio.transfer.waiting import OPERATOR
from tests.transfer.device_line import DeviceLine
from tests.transfer.null_modem import VirtualClock


class NumBench:
    """``wrap`` may put faults on each line; ``unload_keys`` are pressed between Enter and start."""

    def __init__(
        self, folder: Path, *, parity: str = "even", is_checked: bool = False, has_checked: bool = False
    ) -> None:
        self.folder = folder
        self.clock = VirtualClock()
        self.screen: list[str] = []
        self.texts: list[str] = []
        self.unload_keys: list[str] = []
        self.wrap: Callable[[Link], Link] = lambda link: link
        self.refuses: set[str] = set()
        """What the person does not do: "unload", "load"."""
        self.lines: list[DeviceLine] = []
        self.control = self.switch_on()
        self.press(f"parity {parity}")
        kind = CheckingPeripheralDriver if has_checked else PeripheralDriver
        self.driver = kind(self._open, Waiting(self.clock, self.clock.sleep))
        self.driver.is_checked = is_checked

    def switch_on(self) -> NumControl:
        self.control = NumControl(DeviceSetup("num", Memory(self.folder), self.screen.append))
        return self.control

    def press(self, *keys: str) -> None:
        for key in keys:
            self.screen.append(self.control.operate(key))

    def progress(self, stage: str, done: int, total: int) -> None:
        if total != OPERATOR:
            return
        self.texts.append(stage)
        for operation, menu in (("unload", "3 UNLOAD"), ("load", "2 LOAD"), ("verify", "4 CHECK")):
            if menu in stage and operation not in self.refuses:
                self.press("exit", operation, "enter")
                if operation == "unload":
                    self.press(*self.unload_keys, "start")

    def words(self, parameter: int) -> list[str]:
        return self.control._parameters.words[parameter]

    def _open(self, _look: Callable[[], None]) -> Link:
        line = DeviceLine(self.control, self.clock)
        self.lines.append(line)
        return self.wrap(line)
