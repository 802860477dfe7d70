"""Downloads into the folder of a LinuxCNC whose disk fails as a seed chooses."""

import random
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any
from unittest import mock

from amp_studio.families.linuxcnc.control import driver as linuxcnc
from amp_studio.families.linuxcnc.control.content import Configuration
from amp_studio.files import ParameterFile, SaveError
from amp_studio.schema import Value
from amp_studio.transfer.client.exchange import Outcome
from amp_studio.transfer.links import Endpoint
from amp_studio.transfer.links.link import Link

from .downloads import Values, download_under_faults, forgetting

FILES = {
    "mill.ini": b"[EMC]\nMACHINE = mill\n#INCLUDE joints.inc\n#INCLUDE axes.inc\n[HAL]\nHALFILE = m.hal\n",
    "joints.inc": b"# by hand\n[JOINT_0]\nFERROR = 1.5\nMAX_LIMIT = 8\n",
    "axes.inc": b"[AXIS_X]\nMAX_VELOCITY = 30\n",
    "m.hal": b"setp pid.0.Pgain 3\n",
}
VALUES = (
    (("emc.machine", ""), Value("other")),
    (("joint.ferror", "0"), Value(2.25, "mm")),
    (("joint.max_limit", "0"), Value(9.0, "mm")),
    (("axis.max_velocity", "X"), Value(45.0, "mm/s")),
)
_write = linuxcnc.write_atomic


class FolderFaults:
    """The folder of a configuration. ``full`` is the write from which on the disk takes nothing,
    ``once`` the only one that it does not take.
    """

    memory = None

    def __init__(self, folder: Path) -> None:
        folder.mkdir()
        for name, text in FILES.items():
            (folder / name).write_bytes(text)
        self.files_at_control = folder
        self.clock = mock.Mock(now=0.0)
        self.wrap: Callable[[Link], Link] = lambda link: link
        self.driver = linuxcnc.ConfigurationDriver(Endpoint("folder", device=str(folder / "mill.ini")))
        self.writes: Callable[..., str] = _write

    def progress(self, stage: str, done: int, total: int) -> None:
        """Nobody is asked for anything."""

    def present(self) -> Values:
        return {path.name: path.read_text("latin-1") for path in self.files_at_control.iterdir()}

    def names(self, content: bytes) -> Values:
        files = Configuration.read(content).files
        return {name or "mill.ini": text.decode("latin-1") for name, text in files.items()}

    def arm(self, faults: Mapping[str, int]) -> None:
        count = 0

        def written(*arguments: Any, **options: Any) -> str:
            nonlocal count
            count += 1
            if count == faults.get("once") or count >= faults.get("full", count + 1):
                raise SaveError(f"{arguments[0]} cannot be written: No space left on device")
            return _write(*arguments, **options)

        self.writes = forgetting(faults, written)

    def write(self, *arguments: Any, **options: Any) -> str:
        """Write a file of the folder, or not: ``arm``."""
        return self.writes(*arguments, **options)

    def power_cycle(self) -> None:
        raise AssertionError("a folder has no power of its own")

    def left_over(self, ended: Outcome | Exception, faults: Mapping[str, int]) -> list[str]:
        return [f"{path.name} is left" for path in self.files_at_control.glob(".*")]


def folder_run(chance: random.Random, folder: Path, faults: Mapping[str, int] | None) -> list[str]:
    """Download into the folder of a configuration."""
    if faults is None:
        # A write that is lost is found by reading back alone, for which there is no time after Ctrl-C.
        ways = chance.choice([("full", "once", "stop"), ("forget",)])
        count = min(len(ways), chance.choice([0, 1, 1, 2]))
        faults = {way: chance.randrange(1, 6) for way in chance.sample(ways, count)}
    bench = FolderFaults(folder / "mill")
    file: ParameterFile = bench.driver.decode(bench.driver.fetch())
    file.take({**file.values, **dict(chance.sample(VALUES, chance.randrange(1, 5)))})
    with mock.patch.object(linuxcnc, "write_atomic", bench.write):
        found = download_under_faults(bench, file, faults, chance, folder / "copies")
    return [f"{dict(faults)}: {each}" for each in found]
