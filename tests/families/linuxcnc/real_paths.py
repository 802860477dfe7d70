"""Short programs and the times that a real LinuxCNC needed for them: its own servo thread counts the cycles.

``python -m tests.families.linuxcnc.real_paths [NAME ...]`` measures them again, as root and with a user
``cnc``.
"""

import math
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

import numpy as np

from amp_studio.formats import import_file
from amp_studio.sim import ProgramJob, ProgramRun
from amp_studio.sim.path.profiles import path_points

USER = "cnc"
LIMITS = {"X": (100.0, 500.0), "Y": (100.0, 500.0), "Z": (50.0, 300.0)}
UNEVEN = {"X": (120.0, 300.0), "Y": (60.0, 900.0), "Z": (50.0, 300.0)}
"""Axis -> mm/s, mm/s2."""


@dataclass(frozen=True)
class RealPath:
    """A program and what was measured."""

    name: str
    lines: tuple[str, ...]
    limits: dict[str, tuple[float, float]]


def _programs() -> list[RealPath]:
    square = ("G1 X20 F3000", "Y20", "X0", "Y0")
    zigzag = ("F4000", *(f"G1 X{3 * n} Y{5 * (n % 2)}" for n in range(1, 12)))
    short = ("F3000", *(f"G1 X{0.4 * n:.1f} Y{6 * math.sin(0.12 * n):.3f}" for n in range(1, 60)))
    hexagon = tuple(
        f"G1 X{10 - 10 * math.cos(n):.3f} Y{10 * math.sin(n):.3f}" for n in (1, 2, 3, 4, 5, 6.283185)
    )
    made: list[tuple[str, tuple[str, ...], dict[str, tuple[float, float]]]] = [
        ("rapid", ("G61", "G0 X40", "G0 X0"), LIMITS),
        ("diagonal", ("G61", "G0 X30 Y20 Z5", "X0"), UNEVEN),
        ("square", ("G61", *square), LIMITS),
        ("square-stop", ("G61.1", *square), LIMITS),
        ("square-rounded", ("G64 P0.05", *square), LIMITS),
        ("square-wide", ("G64 P1", *square), LIMITS),
        ("square-free", ("G64", *square), LIMITS),
        ("zigzag", ("G61", *zigzag), LIMITS),
        ("zigzag-rounded", ("G64 P0.1", *zigzag), UNEVEN),
        ("acute", ("G64 P0.2", "F3000", "G1 X15 Y2", "X0 Y4", "X15 Y6", "X0 Y8"), LIMITS),
        ("short", ("G61", *short), LIMITS),
        ("short-rounded", ("G64 P0.01 Q0", *short), LIMITS),
        ("short-joined", ("G64 P0.05", *short), LIMITS),
        ("hexagon", ("G64 P0.02", "F2500", *hexagon), LIMITS),
        ("circle", ("G61", "G2 X0 Y0 I8 J0 F3000", "G1 X-5"), LIMITS),
        ("slot", ("G64 P0.05", "F3000", "G1 X20", "G3 X20 Y10 I0 J5", "G1 X0", "G3 X0 Y0 I0 J-5"), LIMITS),
        ("helix", ("G61", "G17 G2 X0 Y0 Z-4 I5 J0 F2000", "G1 X-5"), UNEVEN),
        ("plane-zx", ("G61", "G18 G2 X10 Z0 I5 K0 F2000", "G1 X20"), UNEVEN),
        ("space", ("G64 P0.1", "F3000 G1 X10 Z-3", "X20 Y4 Z0", "X30 Y0 Z-3", "X40"), UNEVEN),
        ("mixed", ("G64 P0.05", "G0 X10 Y10", "G1 Z-2 F600", "X30 F3000", "Y20", "G0 Z2", "X0 Y0"), LIMITS),
        ("inch", ("G61", "G20", "G1 X1 F100", "Y0.5", "G21 X0 F200", "X5"), LIMITS),
        ("inverse-time", ("G61", "G93 G1 X20 F60", "X40 Y10 F90", "G94 X50 F1500"), LIMITS),
    ]
    return [RealPath(name, ("G21 G90 G17", *lines, "M2"), limits) for name, lines, limits in made]


PROGRAMS = _programs()
MEASURED: dict[str, tuple[float, float]] = {
    "rapid": (1.202, 0.00000),
    "diagonal": (1.336, 0.00001),
    "square": (2.049, 0.00000),
    "square-stop": (2.002, 0.00004),
    "square-rounded": (2.073, 0.00007),
    "square-wide": (1.859, 0.00007),
    "square-free": (1.517, 0.00005),
    "zigzag": (2.323, 0.00003),
    "zigzag-rounded": (2.459, 0.00004),
    "acute": (1.705, 0.00007),
    "short": (4.103, 0.00000),
    "short-rounded": (1.040, 0.00007),
    "short-joined": (1.014, 0.00007),
    "hexagon": (1.892, 0.00007),
    "circle": (1.441, 0.00005),
    "slot": (1.716, 0.00007),
    "helix": (1.379, 0.00004),
    "plane-zx": (1.145, 0.00004),
    "space": (1.348, 0.00006),
    "mixed": (2.228, 0.00007),
    "inch": (1.780, 0.00003),
    "inverse-time": (2.237, 0.00000),
}
"""s from the first cycle that moves to the last one, and how far its positions were at most from the path
that is planned here, in mm: on 29 November 2026, 2.9.0~pre1 of Debian 12."""

UNMOVED = "HOME = 0|HOME_OFFSET = 0|HOME_SEARCH_VEL = 0|HOME_LATCH_VEL = 0"
"""An axis that is called 0 where it is."""

HAL = """
loadrt trivkins coordinates=XYZ
loadrt motmod servo_period_nsec=1000000 num_joints=3
loadrt sampler depth=30000 cfg=fff
addf motion-command-handler servo-thread
addf motion-controller servo-thread
addf sampler.0 servo-thread
net x joint.0.motor-pos-cmd => joint.0.motor-pos-fb sampler.0.pin.0
net y joint.1.motor-pos-cmd => joint.1.motor-pos-fb sampler.0.pin.1
net z joint.2.motor-pos-cmd => joint.2.motor-pos-fb sampler.0.pin.2
setp sampler.0.enable 0
net estop iocontrol.0.user-enable-out iocontrol.0.emc-enable-in
net prepare iocontrol.0.tool-prepare iocontrol.0.tool-prepared
net change iocontrol.0.tool-change iocontrol.0.tool-changed
"""
SCREEN = '''#!/usr/bin/python3
"""Runs each program from the origin, and has its positions written cycle by cycle."""
import pathlib, subprocess, sys, time
import linuxcnc
here = pathlib.Path(__file__).parent
command, status = linuxcnc.command(), linuxcnc.stat()
def wait(reached):
    for _ in range(60000):
        status.poll()
        if reached():
            return
        time.sleep(0.005)
    raise SystemExit("it does not end")
command.state(linuxcnc.STATE_ESTOP_RESET); command.wait_complete()
command.state(linuxcnc.STATE_ON); command.wait_complete()
command.mode(linuxcnc.MODE_MANUAL); command.wait_complete()
command.home(-1); wait(lambda: all(status.homed[:3]))
for program in sorted(here.glob("*.ngc")):
    command.mode(linuxcnc.MODE_MDI); command.wait_complete()
    command.mdi("G21 G90 G17 G40 G49 G94 G54 G61 G0 X0 Y0 Z0"); command.wait_complete()
    wait(lambda: status.inpos and status.interp_state == linuxcnc.INTERP_IDLE)
    time.sleep(0.1)
    with program.with_suffix(".txt").open("w") as out:
        sampler = subprocess.Popen(["halsampler", "-t"], stdout=out)
        subprocess.run(["halcmd", "setp", "sampler.0.enable", "1"])
        time.sleep(0.1)
        command.mode(linuxcnc.MODE_AUTO); command.wait_complete()
        command.program_open(str(program)); command.auto(linuxcnc.AUTO_RUN, 1)
        wait(lambda: status.interp_state != linuxcnc.INTERP_IDLE)
        wait(lambda: status.interp_state == linuxcnc.INTERP_IDLE and status.inpos)
        time.sleep(0.1)
        subprocess.run(["halcmd", "setp", "sampler.0.enable", "0"])
        time.sleep(0.3)
        sampler.terminate(); sampler.wait()
'''


def ini(limits: dict[str, tuple[float, float]], homes: Mapping[str, str] = MappingProxyType({})) -> str:
    """Return the configuration of a machine without motors; ``homes`` has the keys of how an axis is homed,
    by axis.
    """
    lines = ["[EMC]", "VERSION = 1.1", "[DISPLAY]", "DISPLAY = ./screen.py", "MAX_FEED_OVERRIDE = 1.2"]
    lines += ["[RS274NGC]", "PARAMETER_FILE = a.var", "[EMCMOT]", "EMCMOT = motmod", "SERVO_PERIOD = 1000000"]
    lines += [
        "COMM_TIMEOUT = 4",
        "[TASK]",
        "TASK = milltask",
        "CYCLE_TIME = 0.001",
        "[HAL]",
        "HALFILE = a.hal",
    ]
    lines += ["[TRAJ]", "COORDINATES = X Y Z", "LINEAR_UNITS = mm", "ANGULAR_UNITS = degree"]
    lines += ["DEFAULT_LINEAR_VELOCITY = 20", "MAX_LINEAR_VELOCITY = 300", "[EMCIO]", "EMCIO = io"]
    lines += ["CYCLE_TIME = 0.1", "TOOL_TABLE = a.tbl"]
    lines += ["[KINS]", "KINEMATICS = trivkins coordinates=XYZ", "JOINTS = 3"]
    for n, (axis, (speed, ramp)) in enumerate(limits.items()):
        own = [f"MAX_VELOCITY = {speed}", f"MAX_ACCELERATION = {ramp}", "MIN_LIMIT = -500", "MAX_LIMIT = 500"]
        keys = homes.get(axis, UNMOVED).split("|")
        given = {key.split(" = ")[0] for key in keys}
        others = [line for line in own if line.split(" = ")[0] not in given]
        lines += [
            f"[AXIS_{axis}]",
            *own,
            f"[JOINT_{n}]",
            "TYPE = LINEAR",
            *others,
            "HOME_SEQUENCE = 0",
            *keys,
        ]
        lines += ["FERROR = 50", "MIN_FERROR = 10"]
    return "\n".join(lines) + "\n"


Positions = list[tuple[float, float, float]]


def positions(programs: list[RealPath]) -> dict[str, Positions]:
    """Return the commanded positions of some programs, in mm, servo cycle by servo cycle while they move."""
    found: dict[str, Positions] = {}
    for limits in (LIMITS, UNEVEN):
        own = [program for program in programs if program.limits is limits]
        if own:
            found |= _run(own, limits)
    return found


def _run(programs: list[RealPath], limits: dict[str, tuple[float, float]]) -> dict[str, Positions]:
    texts = {"a.ini": ini(limits), "a.hal": HAL, "screen.py": SCREEN}
    texts |= {f"{program.name}.ngc": "\n".join(program.lines) + "\n" for program in programs}
    with real_run(texts) as folder:
        return {program.name: moving_rows(folder / f"{program.name}.txt") for program in programs}


@contextmanager
def real_run(texts: Mapping[str, str]) -> Iterator[Path]:
    """Run the real program in a folder with some files until its screen ends; the folder has what it
    wrote.
    """
    folder = Path(tempfile.mkdtemp(prefix="amp-studio-paths-"))
    try:
        for name, text in {"a.tbl": "", "a.var": "", **texts}.items():
            (folder / name).write_text(text)
        (folder / "screen.py").chmod(0o755)
        for place in (*folder.iterdir(), folder):
            shutil.chown(place, USER)
        command = f"cd '{folder}' && exec env -u DISPLAY linuxcnc a.ini"
        with (folder / "log").open("w") as log:
            subprocess.run(["su", USER, "-c", command], stdout=log, stderr=log, timeout=600, check=False)
        yield folder
    finally:
        shutil.rmtree(folder)


def moving_rows(path: Path) -> Positions:
    """Return the positions from the last one at rest on to the first one at the end."""
    rows: Positions = []
    for line in path.read_text().splitlines():
        words = line.split()
        if len(words) == 4:
            rows.append((float(words[1]), float(words[2]), float(words[3])))
        elif "overrun" in line and rows:  # at first it counts what nobody read before
            raise AssertionError(f"{path.name}: cycles are missing")
    moving = [n for n in range(1, len(rows)) if rows[n] != rows[n - 1]]
    return rows[moving[0] - 1 : moving[-1] + 1]


def planned(program: RealPath) -> ProgramRun:
    """Return a program as it is planned here."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "a.ini").write_text(ini(program.limits))
        file = import_file(Path(folder) / "a.ini", "linuxcnc")
    rest = dict.fromkeys("XYZ", 0.0)
    return ProgramJob(program.lines, list(rest.values()), rest, with_contour=False).run(file)


def off(places: np.ndarray, path: np.ndarray) -> float:
    """Return how far places are from the straight pieces between points at most, mm."""
    begins, ways = path[:-1], np.diff(path, axis=0)
    sizes = np.maximum((ways * ways).sum(axis=1), 1e-18)
    most = 0.0
    for place in places:
        share = np.clip(((place - begins) * ways).sum(axis=1) / sizes, 0.0, 1.0)
        near = begins + share[:, None] * ways
        most = max(most, float(((place - near) ** 2).sum(axis=1).min()))
    return math.sqrt(most)


if __name__ == "__main__":
    chosen = sys.argv[1:]
    measured = positions([program for program in PROGRAMS if not chosen or program.name in chosen])
    for each in PROGRAMS:
        if each.name in measured:
            rows = np.array(measured[each.name])
            plan = planned(each).plan.whole
            apart, time = off(rows, path_points(plan, 1e-5)[0]), 0.001 * (len(rows) - 1)
            print(
                f'    "{each.name}": ({time:.3f}, {apart:.5f}),  # {100.0 * (plan.time / time - 1.0):+.2f} %',
                flush=True,
            )
