"""The real program as the judge: it starts what was exported, and uses the figures that were meant.
Skipped where it is not installed.
"""

import os
import pwd
import shutil
import socket
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from amp_studio import MachineParameters, connect
from amp_studio.families.linuxcnc.control import running as running_program
from amp_studio.families.linuxcnc.control.driver import IN_USE
from amp_studio.files import open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.formats import import_file
from amp_studio.meaning import migrate
from amp_studio.schema import Value
from amp_studio.transfer import ControlStatus

USER = "cnc"
SECONDS = 40.0
"""Until the program answers; it takes about 6."""
PINS = {
    "joint.min_limit": "min_limit",
    "joint.max_limit": "max_limit",
    "joint.max_velocity": "max_velocity",
    "joint.home": "home",
    "joint.max_acceleration": "max_acceleration",
    "joint.ferror": "ferror",
    "joint.min_ferror": "min_ferror",
    "joint.home_offset": "home_offset",
    "joint.home_sequence": "home_sequence",
    "joint.backlash": "backlash",
    "axis.min_limit": "min_limit",
    "axis.max_limit": "max_limit",
    "axis.max_velocity": "max_velocity",
}


def has_user() -> bool:
    return any(entry.pw_name == USER for entry in pwd.getpwall())


pytestmark = pytest.mark.skipif(
    not (shutil.which("linuxcnc") and os.geteuid() == 0 and has_user()),
    reason="needs Debian's linuxcnc-uspace, root, and a user cnc: LinuxCNC refuses root",
)


def hal(*words: str) -> str:
    """Return what halcmd prints, as the user that the program runs as."""
    asked = subprocess.run(
        ["su", USER, "-c", f"halcmd {' '.join(words)}"], capture_output=True, text=True, check=False
    )
    return asked.stdout.strip()


def answers() -> bool:
    try:
        socket.create_connection(("127.0.0.1", 5007), 1).close()
    except OSError:
        return False
    return bool(hal("getp", "ini.traj_max_velocity"))


def with_switches(hal: str) -> str:
    """Return the HAL of a migration with a simulated home switch at the end of each joint's travel."""
    lines = ["loadrt sim_home_switch names=" + ",".join(f"switch.{n}" for n in range(4))]
    for n in range(4):
        lines += [
            f"addf switch.{n} servo-thread",
            f"setp switch.{n}.home-pos 5",
            f"net feedback.{n} => switch.{n}.cur-pos",
            f"net home.{n} switch.{n}.home-sw => joint.{n}.home-sw-in",
        ]
    return "\n".join((hal, *lines, ""))


class Program:
    """The real program in a folder, started and stopped as a person does, and driven over linuxcncrsh."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.control = connect(f"folder:{folder}", "linuxcnc")
        self._process: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        command = f"cd '{self.folder}' && exec env -u DISPLAY linuxcnc MILL_1394.ini"
        self._process = subprocess.Popen(
            ["su", USER, "-c", command], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        end = time.monotonic() + SECONDS
        while not answers():
            assert self._process.poll() is None, "it ended at once"
            assert time.monotonic() < end, "it does not answer"
            select_for(0.3)

    def stop(self) -> None:
        if self._process is not None and self._process.poll() is None:
            stop()
            self._process.wait(20)

    def say(self, *lines: str) -> None:
        """Send commands to linuxcncrsh."""
        with socket.create_connection(("127.0.0.1", 5007), 5) as line:
            for each in ("hello EMC test 1.0", "set enable EMCTOO", *lines):
                line.sendall(f"{each}\r\n".encode())
                select_for(0.2)

    def wait(self, reached: Callable[[ControlStatus], bool], seconds: float = 30.0) -> ControlStatus:
        """Return the first status that is so."""
        end = time.monotonic() + seconds
        while not reached(status := self.control.status()):
            assert time.monotonic() < end, status
            select_for(0.1)
        return status


@pytest.fixture(scope="module")
def running() -> Iterator[Program]:
    """Migrate the mill and start it without a screen."""
    if answers():
        pytest.skip("another LinuxCNC runs on this computer")
    (path,) = (examples_folder() / "mill-1394").glob("*.amp")
    folder = Path(tempfile.mkdtemp(prefix="amp-studio-linuxcnc-"))  # in a folder that another user may enter
    migrated = migrate(open_file(path).file, "linuxcnc", {"home.order": "Z, X Y, B"}).written.texts
    for name, text in migrated.items():
        (folder / name).write_text(with_switches(text) if name == "machine.hal" else text)
    for place in (*folder.iterdir(), folder):
        shutil.chown(place, USER)
    program = Program(folder)
    try:
        program.start()
        yield program
    finally:
        program.stop()
        shutil.rmtree(folder)


def select_for(seconds: float) -> None:
    """Let the other program run."""
    subprocess.run(["sleep", str(seconds)], check=True)


def stop() -> None:
    with socket.create_connection(("127.0.0.1", 5007), 5) as line:
        line.sendall(
            b"hello EMC stop 1.0\r\nset enable EMCTOO\r\nset machine off\r\nset estop on\r\nshutdown\r\n"
        )
        line.settimeout(5)
        try:
            while line.recv(1000):
                pass
        except OSError:
            pass


def test_the_running_program_uses_the_figures_of_the_file(running: Program) -> None:
    file = import_file(running.folder / "MILL_1394.ini", "linuxcnc")
    compared = 0
    for address, value in file.values.items():
        if address[0] not in PINS or not file.evaluation.state(address).is_active:
            continue
        pin = f"ini.{address[1].lower()}.{PINS[address[0]]}"
        # halcmd prints seven digits.
        assert float(hal("getp", pin)) == pytest.approx(value.value, rel=1e-6), (pin, value)
        compared += 1
    assert compared == 48
    assert float(hal("getp", "joint.0.f-error-lim")) == pytest.approx(11.0)
    assert float(hal("getp", "ini.3.min_limit")) == -1e99  # no travel limit, as before
    assert running.control.verify(MachineParameters(file)).agrees
    assert len(running_program.values_in_use(file)) == 53
    assert running.control.identify().notice == IN_USE


def test_a_download_is_used_after_the_next_start(running: Program, tmp_path: Path) -> None:
    """Search by switch alone: the simulated motors have no marker. X is slower and shorter than before."""
    machine = running.control.upload()
    file = machine.file
    for n in range(4):
        file.set(("joint.home_use_index", str(n)), Value(False))
    for scope, name in (("joint", "0"), ("axis", "X")):
        file.set((f"{scope}.max_velocity", name), Value(60.0, "mm/s"))
        file.set((f"{scope}.min_limit", name), Value(-50.0, "mm"))
    outcome = running.control.download(machine, accept_errors=True, keep=tmp_path)
    assert (outcome.verified, outcome.restart) == (True, "needed")
    found = running.control.verify(machine)
    assert {d.address[0] for d in found.in_use} == {
        f"{scope}.{name}" for scope in ("joint", "axis") for name in ("max_velocity", "min_limit")
    }
    running.stop()
    running.start()
    assert running.control.verify(machine).agrees
    hal("setp", "ini.2.max_limit", "1.5")
    assert [d.address for d in running.control.verify(machine).in_use] == [("joint.max_limit", "2")]
    hal("setp", "ini.2.max_limit", "2")


def test_it_homes_and_a_jog_ends_at_the_limit_with_the_greatest_speed_of_the_file(running: Program) -> None:
    running.say("set estop off", "set machine on", "set mode manual", "set home -1")
    homes = pytest.approx([6.0, 4.0, 0.0, 0.0], abs=0.05)
    running.wait(
        lambda now: (
            all(axis.states == ("homed",) and not axis.velocity for axis in now.axes)
            and [axis.position for axis in now.axes] == homes
        ),
        120.0,
    )
    running.say("set teleop_enable on", "set jog X -99999")
    moving = running.wait(lambda now: abs(now.axes[0].velocity or 0.0) > 59.9)
    assert moving.axes[0].velocity == pytest.approx(-60.0, abs=0.01)
    ended = running.wait(
        lambda now: now.axes[0].velocity == 0.0 and abs(now.axes[0].following_error or 0.0) < 0.001
    )
    assert ended.axes[0].position == pytest.approx(-50.0, abs=0.01)
