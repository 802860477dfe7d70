"""Homings of a real LinuxCNC without motors, with a switch of its HAL: where it turns, where it ends and how
long it takes.

``python -m tests.families.linuxcnc.real_homing`` measures them again, as root and with a user ``cnc``.
"""

import sys
import tempfile
from dataclasses import dataclass, field
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
    markers: dict[str, float] = field(default_factory=dict)
    """ms after which a marker comes, from the order to look for it on; none where there is no marker."""


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


INDEX = "|HOME_USE_INDEX = YES|HOME_INDEX_NO_ENCODER_RESET = YES"
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
    RealHoming(
        "markers",
        {
            "X": _keys(10, 12, 40, -4, 25) + INDEX,
            "Y": _keys(-7, -2, -60, 5, 30) + INDEX,
            "Z": _keys(0, 1, -20, -2, 10) + INDEX,
        },
        {"X": 30.0, "Y": -25.0, "Z": -12.0},
        {"X": 500.0, "Y": 300.0, "Z": 700.0},
    ),
    RealHoming(
        "onto the switch again",
        {"X": _keys(10, 12, 40, 4, 25), "Y": _keys(5, -2, -60, -5, 30), "Z": _keys(-4, 0, 20, 2, 10)},
        {"X": 30.0, "Y": -25.0, "Z": 12.0},
    ),
    RealHoming(
        "without a switch",
        {
            "X": _keys(10, 3, 0, 0, 25),
            "Y": _keys(-6, 2, 0, -5, 30) + INDEX,
            "Z": _keys(5, 2, 0, 0, 10) + "|HOME_ABSOLUTE_ENCODER = 1",
        },
        {},
        {"Y": 600.0},
    ),
    RealHoming(
        "faster than the joint",
        {
            "X": _keys(10, 12, 140, -20, 200),
            "Y": _keys(50, 0, -60, 5, -1) + "|MAX_VELOCITY = 45|MAX_ACCELERATION = 150",
            "Z": _keys(30, 0, 20, -2, 0).replace("|HOME_FINAL_VEL = 0", ""),
        },
        {"X": 60.0, "Y": -25.0, "Z": 12.0},
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
    "markers": {
        "X": Course((31.6, 25.994), 2.016),
        "Y": Course((-28.62, -23.47, -28.4925), 1.968),
        "Z": Course((-12.66, -11.3532, -14.4035), 2.204),
    },
    "onto the switch again": {
        "X": Course((31.6, 28.4, 30.016, 28.002), 1.776),
        "Y": Course((-28.62, -21.42, -25.025, -18.0025), 2.065),
        "Z": Course((12.66, 11.3532, 12.0072, 8.0015), 1.804),
    },
    "without a switch": {
        "X": Course((7.0,), 0.333),
        "Y": Course((-10.9825,), 0.94),
        "Z": Course((3.0,), 0.336),
    },
    "faster than the joint": {
        "X": Course((70.0, 57.99), 1.677),
        "Y": Course((-31.77, 25.0041), 3.925),
        "Z": Course((12.66, 11.994, 41.9997), 1.91),
    },
}
"""On 28 November 2026, from the third one on the 30th, 2.9.0~pre1 of Debian 12."""
MARKERS = "loadrt sim_home_switch count=3\n"
SWITCHES = "loadrt comp names=switch.0,switch.1,switch.2\n"
SCREEN = '''#!/usr/bin/python3
"""Homes all axes and has their positions written cycle by cycle."""
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
'''


def _hal(homing: RealHoming) -> str:
    lines = [SWITCHES, MARKERS] if homing.markers else [SWITCHES]
    for axis, delay in homing.markers.items():
        n = "XYZ".index(axis)
        lines += [
            f"addf sim-home-switch.{n} servo-thread",
            f"setp sim-home-switch.{n}.index-delay-ms {delay}",
            f"net {axis.lower()} => sim-home-switch.{n}.cur-pos",
            f"net index.{n} sim-home-switch.{n}.index-enable joint.{n}.index-enable",
        ]
    for axis, edge in homing.edges.items():
        n = "XYZ".index(axis)
        ports = ("in0", "in1") if edge > 0.0 else ("in1", "in0")  # comp: whether in1 is above in0
        lines += [
            f"addf switch.{n} servo-thread",
            f"setp switch.{n}.{ports[0]} {edge}",
            f"setp switch.{n}.hyst 0",
            f"net {axis.lower()} => switch.{n}.{ports[1]}",
            f"net home.{n} switch.{n}.out => joint.{n}.home-sw-in",
        ]
    return HAL + "\n".join(lines) + "\n"


def measured(homing: RealHoming) -> dict[str, Course]:
    """Return what the real control does."""
    texts = {"a.ini": ini(LIMITS, homing.homes), "a.hal": _hal(homing), "screen.py": SCREEN}
    with real_run(texts) as folder:
        rows = np.array(moving_rows(folder / "home.txt"))
    return {axis: _course(np.arange(len(rows)) * 0.001, rows[:, n]) for n, axis in enumerate(homing.homes)}


def simulated(homing: RealHoming, axis: str) -> tuple[Course, Trace]:
    """Return what the axis does here, by its command, and the whole result."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "a.ini").write_text(ini(LIMITS, homing.homes))
        file = import_file(Path(folder) / "a.ini", "linuxcnc")
    move = {"move.switch": abs(homing.edges[axis])} if axis in homing.edges else {}
    if axis in homing.markers:
        move["move.marker"] = _marker(homing, axis)
    trace = simulate(file, "home", axis, move)
    return _course(trace.columns["time_s"], trace.columns["command_position"]), trace


def _marker(homing: RealHoming, axis: str) -> float:
    """Return how far the axis goes before its marker comes, mm; it looks for one from rest, or as it leaves
    its switch.
    """
    latch = abs(float(keys_of(homing, axis)["HOME_LATCH_VEL"]))
    begins = 0.0 if axis in homing.edges else latch * latch / (2.0 * LIMITS[axis][1])
    return latch * homing.markers[axis] / 1000.0 - begins


def keys_of(homing: RealHoming, axis: str) -> dict[str, str]:
    """Return the keys of how an axis is homed."""
    return dict(each.split(" = ") for each in homing.homes[axis].split("|"))


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
            print(f'    "{each.name}": {measured(each)},', flush=True)
