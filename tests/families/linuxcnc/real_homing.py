"""Homings of a real LinuxCNC without motors, with a switch of its HAL: where it turns, where it ends and how
long it takes, and what it does at a limit.

``python -m tests.families.linuxcnc.real_homing`` measures them again, as root and with a user ``cnc``.
"""

import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from amp_studio.formats import import_file
from amp_studio.sim import Trace, simulate

from .real_paths import HAL, LIMITS, ini, moving_rows, real_run


@dataclass(frozen=True)
class RealHoming:
    """How the three axes are homed, and the edges of their switches from the start, mm."""

    name: str
    homes: dict[str, str]
    edges: dict[str, float]


@dataclass(frozen=True)
class Course:
    """What one axis did, from its start in mm and s."""

    turns: tuple[float, ...]
    """Where it turned round, the last one where it ended."""
    time: float
    """From the first cycle that moves to the last one."""


def _keys(home: float, offset: float, search: float, latch: float, final: float) -> str:
    return (
        f"HOME = {home}|HOME_OFFSET = {offset}|HOME_SEARCH_VEL = {search}|HOME_LATCH_VEL = {latch}"
        f"|HOME_FINAL_VEL = {final}"
    )


HOMINGS = (
    RealHoming(
        "off the switch",
        {"X": _keys(10, 12, 40, -4, 25), "Y": _keys(5, -2, -60, 5, 30), "Z": _keys(0, 0, 20, -2, 10)},
        {"X": 30.0, "Y": -25.0, "Z": 12.0},
    ),
    RealHoming(
        "far home",
        {"X": _keys(-40, 0, 80, -8, 60), "Y": _keys(60, 0, -80, 2, 100), "Z": _keys(-3, 2, -10, 1, 50)},
        {"X": 20.0, "Y": -40.0, "Z": -5.0},
    ),
)
MEASURED = {
    "off the switch": {
        "X": Course((31.6, 27.998), 1.515),
        "Y": Course((-28.62, -17.9975), 1.732),
        "Z": Course((12.66, 11.994, 11.9997), 1.151),
    },
    "far home": {
        "X": Course((26.4, -20.004), 2.203),
        "Y": Course((-46.4, 20.001), 4.85),
        "Z": Course((-5.17, -4.998, -9.9992), 1.089),
    },
}
"""On 28 November 2026, 2.9.0~pre1 of Debian 12."""
LIMIT = ("Linear move on line 0 would exceed X's positive limit", 500.0)
"""What it answers to G0 to 501 mm where 500 is the limit, and where a jog against it ends, mm."""

SWITCHES = "loadrt comp names=switch.0,switch.1,switch.2\n"
SCREEN = '''#!/usr/bin/python3
"""Homes all axes and has their positions written cycle by cycle; then tries a limit."""
import pathlib, subprocess, time
import linuxcnc
command, status, errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()
def wait(reached):
    for _ in range(6000):
        status.poll()
        if reached():
            return
        time.sleep(0.01)
    raise SystemExit("it does not end")
command.state(linuxcnc.STATE_ESTOP_RESET); command.wait_complete()
command.state(linuxcnc.STATE_ON); command.wait_complete()
command.mode(linuxcnc.MODE_MANUAL); command.wait_complete()
with open("home.txt", "w") as out:
    sampler = subprocess.Popen(["halsampler", "-t"], stdout=out)
    subprocess.run(["halcmd", "setp", "sampler.0.enable", "1"])
    time.sleep(0.1)
    command.home(-1); wait(lambda: all(status.homed[:3]) and status.inpos)
    time.sleep(0.2)
    subprocess.run(["halcmd", "setp", "sampler.0.enable", "0"])
    time.sleep(0.3)
    sampler.terminate(); sampler.wait()
command.mode(linuxcnc.MODE_MDI); command.wait_complete()
while errors.poll():
    pass
command.mdi("G21 G90 G0 X501"); command.wait_complete()
time.sleep(0.3)
kind, text = errors.poll() or (0, "")
command.mode(linuxcnc.MODE_MANUAL); command.wait_complete()
command.teleop_enable(1); command.wait_complete()
command.jog(linuxcnc.JOG_CONTINUOUS, False, 0, 100.0)
time.sleep(8.0)
status.poll()
pathlib.Path("limit.txt").write_text(f"{text}\\n{status.joint_actual_position[0]}\\n")
'''


def _hal(edges: dict[str, float]) -> str:
    lines = [SWITCHES]
    for n, (axis, edge) in enumerate(edges.items()):
        ports = ("in0", "in1") if edge > 0.0 else ("in1", "in0")  # comp: whether in1 is above in0
        lines += [
            f"addf switch.{n} servo-thread",
            f"setp switch.{n}.{ports[0]} {edge}",
            f"setp switch.{n}.hyst 0",
            f"net {axis.lower()} => switch.{n}.{ports[1]}",
            f"net home.{n} switch.{n}.out => joint.{n}.home-sw-in",
        ]
    return HAL + "\n".join(lines) + "\n"


def measured(homing: RealHoming) -> tuple[dict[str, Course], tuple[str, float]]:
    """Return what the real control does."""
    texts = {"a.ini": ini(LIMITS, homing.homes), "a.hal": _hal(homing.edges), "screen.py": SCREEN}
    with real_run(texts) as folder:
        rows = np.array(moving_rows(folder / "home.txt"))
        words, place = (folder / "limit.txt").read_text().strip().rsplit("\n", 1)
    found = {axis: _course(np.arange(len(rows)) * 0.001, rows[:, n]) for n, axis in enumerate(homing.homes)}
    return found, (words, float(place))


def simulated(homing: RealHoming, axis: str) -> tuple[Course, Trace]:
    """Return what the axis does here, by its command, and the whole result."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "a.ini").write_text(ini(LIMITS, homing.homes))
        file = import_file(Path(folder) / "a.ini", "linuxcnc")
    trace = simulate(file, "home", axis, {"move.switch": abs(homing.edges[axis])})
    return _course(trace.columns["time_s"], trace.columns["command_position"]), trace


def _course(time: np.ndarray, place: np.ndarray) -> Course:
    steps = np.diff(place)
    moving = np.flatnonzero(np.abs(steps) > 1e-9)
    signs = np.sign(steps[moving])
    turns = [float(place[moving[n] + 1] - place[0]) for n in np.flatnonzero(np.diff(signs))]
    end = float(place[moving[-1] + 1] - place[0])
    return Course(
        tuple(round(each, 4) for each in (*turns, end)),
        round(float(time[moving[-1] + 1] - time[moving[0]]), 3),
    )


if __name__ == "__main__":
    for each in HOMINGS:
        if len(sys.argv) < 2 or each.name in sys.argv[1:]:
            courses, limit = measured(each)
            print(f'    "{each.name}": {courses},\n# {limit}', flush=True)
