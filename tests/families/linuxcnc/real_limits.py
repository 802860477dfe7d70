"""What a real LinuxCNC without motors does at the limits of its axes, 500 mm to both sides of the zero.

``python -m tests.families.linuxcnc.real_limits`` measures it again, as root and with a user ``cnc``.
"""

from __future__ import annotations

import json
import tempfile
from pathlib import Path

from amp_studio.formats import import_file
from amp_studio.sim import ProgramJob, ProgramRun

from .real_paths import HAL, LIMITS, ini, real_run

EDGE = 500.0
BLOCKS = {
    "G0 X500": ("", 500.0),
    "G0 X500.001": ("Linear move on line 0 would exceed X's positive limit", 500.0),
    "G1 Y-500.001 F6000": ("Linear move on line 0 would exceed Y's negative limit", 500.0),
    "G0 X0 Y-500": ("", 0.0),
    "G0 Z500.001": ("Linear move on line 0 would exceed Z's positive limit", 0.0),
    "G0 X0 Y0": ("", 0.0),
    "G2 X0 Y0 I260 J0 F6000": ("Exceeded POSITIVE soft limit (500.00000) on joint 0", 513.0815),
}
"""Block -> its first message, and where X is then, mm: one after the other from 0, on 30 November 2026,
2.9.0~pre1 of Debian 12."""
JOGS = (("X", 100.0), ("Y", -100.0), ("Z", 50.0), ("Z", -50.0))
"""Axis and mm/s of a jog that ends at the limit."""
SCREEN = """#!/usr/bin/python3
import json, pathlib, time
import linuxcnc
command, status, errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()
def at_rest():
    time.sleep(0.5)
    for _ in range(6000):
        status.poll()
        if status.inpos and all(abs(joint["velocity"]) < 1e-6 for joint in status.joint[:3]):
            return
        time.sleep(0.01)
    raise SystemExit("it does not end")
command.state(linuxcnc.STATE_ESTOP_RESET); command.wait_complete()
command.state(linuxcnc.STATE_ON); command.wait_complete()
command.mode(linuxcnc.MODE_MANUAL); command.wait_complete()
command.home(-1); at_rest()
jogs = []
command.teleop_enable(1); command.wait_complete()
for axis, speed in JOGS:
    command.jog(linuxcnc.JOG_CONTINUOUS, False, "XYZ".index(axis), speed)
    at_rest()
    jogs.append(status.joint_actual_position["XYZ".index(axis)])
blocks = {}
for block in ("G21 G90 G0 X0 Y0 Z0", *BLOCKS):
    command.mode(linuxcnc.MODE_MDI); command.wait_complete()
    while errors.poll():
        pass
    command.mdi(block); command.wait_complete()
    at_rest()
    blocks[block] = [(errors.poll() or (0, ""))[1].strip(), round(status.joint_actual_position[0], 4)]
pathlib.Path("limits.json").write_text(json.dumps([blocks, jogs]))
"""


def measured() -> tuple[dict[str, tuple[str, float]], list[float]]:
    """Return the first message to each block, with where X is then, and where each jog ends."""
    given = f"JOGS, BLOCKS = {JOGS!r}, {list(BLOCKS)!r}\n"
    screen = SCREEN.replace("import linuxcnc\n", "import linuxcnc\n" + given)
    with real_run({"a.ini": ini(LIMITS), "a.hal": HAL, "screen.py": screen}) as folder:
        blocks, jogs = json.loads((folder / "limits.json").read_text())
    return {block: (words, place) for block, (words, place) in blocks.items() if block in BLOCKS}, jogs


def planned(block: str) -> ProgramRun:
    """Return the block as it is run here from 0."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "a.ini").write_text(ini(LIMITS))
        file = import_file(Path(folder) / "a.ini", "linuxcnc")
    rest = dict.fromkeys("XYZ", 0.0)
    lines = ("G21 G90 G17", block, "M2")
    return ProgramJob(lines, list(rest.values()), rest, with_contour=False).run(file)


if __name__ == "__main__":
    print(measured())
