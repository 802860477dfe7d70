"""The real program as the judge: it starts what was exported, and uses the figures that were meant.
Skipped where it is not installed.
"""

from __future__ import annotations

import os
import pwd
import shutil
import socket
import subprocess
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.formats import import_file
from amp_studio.meaning import migrate

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


@pytest.fixture
def running() -> Iterator[ParameterFile]:
    """Migrate the mill, start it without a screen, and give its configuration as it is read."""
    if answers():
        pytest.skip("another LinuxCNC runs on this computer")
    (path,) = (examples_folder() / "mill-1394").glob("*.amp")
    folder = Path(tempfile.mkdtemp(prefix="amp-studio-linuxcnc-"))  # in a folder that another user may enter
    for name, text in migrate(
        open_file(path).file, "linuxcnc", {"home.order": "Z, X Y, B"}
    ).written.texts.items():
        (folder / name).write_text(text)
    for place in (*folder.iterdir(), folder):
        shutil.chown(place, USER)
    command = f"cd '{folder}' && exec env -u DISPLAY linuxcnc MILL_1394.ini"
    program = subprocess.Popen(
        ["su", USER, "-c", command], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    try:
        end = time.monotonic() + SECONDS
        while not answers():
            assert program.poll() is None, "it ended at once"
            assert time.monotonic() < end, "it does not answer"
            select_for(0.3)
        yield import_file(folder / "MILL_1394.ini", "linuxcnc")
    finally:
        if program.poll() is None:
            stop()
        program.wait(20)
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


def test_the_running_program_uses_the_figures_of_the_file(running: ParameterFile) -> None:
    compared = 0
    for address, value in running.values.items():
        if address[0] not in PINS or not running.evaluation.state(address).is_active:
            continue
        pin = f"ini.{address[1].lower()}.{PINS[address[0]]}"
        # halcmd prints seven digits.
        assert float(hal("getp", pin)) == pytest.approx(value.value, rel=1e-6), (pin, value)
        compared += 1
    assert compared == 48
    assert float(hal("getp", "joint.0.f-error-lim")) == pytest.approx(11.0)
    assert float(hal("getp", "ini.3.min_limit")) == -1e99  # no travel limit, as before
