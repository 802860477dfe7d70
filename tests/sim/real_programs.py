"""Short programs and the times that a real grblHAL needed for them: the firmware's own simulator counts
ticks.

``python -m tests.sim.real_programs`` measures them again (``make peers`` builds the simulator; minutes).
"""

import math
import random
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

FIRMWARE = Path(__file__).resolve().parents[2] / "build" / "peers" / "grblhal" / "grblHAL_sim"
OFF = ("20", "21", "22", "13")
"""Limits, homing and reports in inches: off."""
BASE: dict[str, float] = (
    dict.fromkeys(("100", "101", "102"), 250)
    | {"110": 6000, "111": 6000, "112": 3000, "120": 500, "121": 500, "122": 300}
    | {"11": 0.01, "12": 0.002, "398": 100}
    | dict.fromkeys(OFF, 0)
)
"""Settings by number: alike in all but for what a program has."""


@dataclass(frozen=True)
class RealProgram:
    """A program, its further settings, and what was measured."""

    name: str
    lines: tuple[str, ...]
    settings: dict[str, float]
    time: float
    """s from the start of its first block to its last step."""
    end: tuple[int, ...]
    """Where the axes were then, in steps."""


SPINDLE = ("M3 S1000", "G1 X20 F1500", "X40", "M5", "X60", "G4 P0.5", "X80")

SHIFTS = (
    "F1500",
    "G1 X10",
    "G92 X0",
    "X10",
    "G10 L2 P1 X2",
    "X20",
    "G10 L2 P2 X5",
    "X30",
    "G10 L2 P1 Y1",
    "X0",
)


def _with_dwells(count: int) -> tuple[str, ...]:
    """Return moves of 2 mm with a dwell between each two: one behind the last would be in the time."""
    return tuple(block for n in range(1, count + 1) for block in (f"G1 X{2 * n}", "G4 P0.1"))[:-1]


def _short(count: int) -> tuple[str, ...]:
    """Return moves of about 0.2 mm with a corner between each two, which need a slow move before them: else
    they are over before the simulator has read the next ones (89 took 2.155 s in the place of 2.122).
    """
    return tuple(f"X{0.2 * n:.1f} Y{0.1 * (n % 3):.1f}" for n in range(1, count + 1))


def _arcs(count: int) -> tuple[str, ...]:
    """Return arcs of radius 2 to 10 mm one after the other, one to the left, one to the right."""
    lines, here, chance = ["F1500"], (0.0, 0.0), random.Random(1)
    for n in range(count):
        radius, angle = 2.0 + 8.0 * chance.random(), math.tau * chance.random()
        turn = (0.5 + 1.5 * chance.random()) * (1.5 if n % 2 else -1.5)
        i, j = radius * math.cos(angle), radius * math.sin(angle)
        end = angle + math.pi + turn
        x, y = here[0] + i + radius * math.cos(end), here[1] + j + radius * math.sin(end)
        lines.append(f"G{3 if n % 2 else 2} X{x:.3f} Y{y:.3f} I{i:.4f} J{j:.4f}")
        here = round(x, 3), round(y, 3)
    return tuple(lines)


def _programs() -> list[RealProgram]:
    made = [
        ("rapid", ("G0 X40", "G0 X0"), {}),
        ("diagonal", ("G0 X30 Y20 Z5", "X0"), {"120": 300}),
        ("feed", ("G1 X20 F1200", "X40 F2400", "X60 F600"), {}),
        ("square", ("G1 X20 F3000", "Y20", "X0", "Y0"), {}),
        ("square-exact", ("G1 X20 F3000", "Y20", "X0", "Y0"), {"11": 0.2}),
        ("zigzag", ("F4000", *(f"G1 X{3 * n} Y{5 * (n % 2)}" for n in range(1, 12))), {}),
        ("acute", ("F3000", "G1 X15 Y2", "X0 Y4", "X15 Y6", "X0 Y8"), {}),
        ("circle", ("G2 X0 Y0 I8 J0 F3000", "G1 X-5"), {}),
        ("circle-coarse", ("G3 X0 Y0 I6 J2 F2500", "G1 X-5"), {"12": 0.05}),
        ("rounded", ("F3000", "G1 X20", "G3 X25 Y5 I0 J5", "G1 Y20", "G2 X30 Y25 R5", "G1 X45"), {}),
        ("helix", ("G17 G2 X0 Y0 Z-4 I5 J0 F2000", "G1 X-5"), {}),
        ("plane-zx", ("G18 G2 X10 Z0 I5 K0 F2000", "G1 X20"), {"122": 150}),
        ("inch", ("G20 G1 X1 F100", "Y0.5", "X0"), {}),
        ("slow-z", ("F3000 G1 X10 Z-3", "X20 Z0", "X30 Z-3"), {"112": 600, "122": 80}),
        ("uneven", ("F5000 G1 X20 Y10", "X40 Y0", "X30 Y-15"), {"120": 200, "121": 800}),
        ("mixed", ("G0 X10 Y10", "G1 Z-2 F600", "X30 F3000", "G0 Z2", "X0 Y0"), {}),
        ("incremental", ("G91 F2500", *("G1 X2 Y1", "X2 Y-1") * 8), {"11": 0.002}),
        ("spindle", (*SPINDLE, "M3", "X100", "M8", "X120"), {"394": 0.5}),
        ("spindle-delays", SPINDLE, {"394": 1.5, "539": 1}),
        ("new-speed", ("M3 S1000", "G1 X10 F1500", "X20 S2000", "X30 S2000", "X40 S1500", "X50"), {}),
        (
            "coolant",
            ("F1500", "M7", "G1 X10", "M8", "X20", "M7", "X30", "M9", "X40", "M9", "X50"),
            {"673": 0.5},
        ),
        ("stops", ("F1500", *_with_dwells(6)), {}),
        ("many-stops", ("F2500", *(b for n in range(1, 21) for b in (f"G1 X{3 * n}", f"M{8 + n % 2}"))), {}),
        ("arcs", _arcs(10), {}),
        ("many-arcs", _arcs(40), {}),
        ("work-systems", ("F1500", "G55 G1 X20", "G54 Y10", "G54 X30", "G56 X0"), {}),
        ("shifts", SHIFTS, {}),
        ("shifts-in-motion", SHIFTS, {"10": 255}),
        ("overrides", ("F1500", "M48", "G1 X10", "M49", "Y10", "M49", "X20", "M48 X0"), {}),
        ("short-blocks", ("G1 X-5 F300", "X0 F3000", *_short(89)), {}),
        ("inverse-time", ("G93 G1 X20 F60", "X40 Y10 F90", "G94 X50 F1500"), {}),
    ]
    return [
        RealProgram(name, ("G21 G90", *lines), own, *MEASURED.get(name, (0, ()))) for name, lines, own in made
    ]


MEASURED: dict[str, tuple[float, tuple[int, ...]]] = {
    "rapid": (1.2040, (0, 0, 0)),
    "diagonal": (1.2600, (0, 5000, 1250)),
    "feed": (3.5629, (15000, 0, 0)),
    "square": (1.9540, (0, 0, 0)),
    "square-exact": (1.8200, (0, 0, 0)),
    "zigzag": (2.1241, (8250, 1250, 0)),
    "acute": (1.5986, (0, 2000, 0)),
    "circle": (1.2909, (-1250, 0, 0)),
    "circle-coarse": (1.4488, (-1250, 0, 0)),
    "rounded": (1.4160, (11250, 6250, 0)),
    "helix": (1.2180, (-1250, 0, -1000)),
    "plane-zx": (1.0379, (5000, 0, 0)),
    "inch": (1.7249, (0, 3175, 0)),
    "slow-z": (1.2180, (7500, 0, -750)),
    "uneven": (1.6300, (7500, -3750, 0)),
    "mixed": (1.6880, (0, 0, 500)),
    "incremental": (1.8758, (8000, 0, 0)),
    "spindle": (6.0523, (30000, 0, 0)),
    "spindle-delays": (4.8549, (20000, 0, 0)),
    "arcs": (3.9386, (4811, 5221, 0)),
    "new-speed": (2.1516, (12500, 0, 0)),
    "coolant": (2.6560, (12500, 0, 0)),
    "stops": (1.2786, (3000, 0, 0)),
    "many-stops": (3.0373, (15000, 0, 0)),
    "many-arcs": (18.6494, (17073, -11385, 0)),
    "inverse-time": (2.1415, (12500, 2500, 0)),
    "work-systems": (2.9866, (0, 2500, 0)),
    "shifts": (3.0826, (3000, 0, 0)),
    "shifts-in-motion": (2.9807, (3000, 0, 0)),
    "short-blocks": (3.2931, (4450, 50, 0)),
    "overrides": (2.1875, (0, 2500, 0)),
}
"""On 28 to 30 November 2026, core 1.1f build 20260817, at 0.03 or 0.06 of the true time: unpaced (-t 0)
"many-arcs" took 18.94 s, likely because that clock runs on while the firmware computes. A pause before
the first move is not in the time. "spindle" and "many-stops" are at 0.02 ("spindle" took 6.0888 s at
0.06). "stops" took 1.3100 s at 0.2, 1.2835 at 0.06 and 1.2786 at 0.02 (here 1.2800): after a stop the
simulator gives the firmware one character a pass of its main loop (mcu.c, simulate_serial), and a pass
waits for the other thread. No row is written while the planner is empty (grbl_interface.c, print_steps),
so a dwell behind the last move would be in the time."""


def measured(program: RealProgram) -> tuple[float, tuple[int, ...]]:
    """Return the time of a program on the real firmware in s, and where its axes are at the end in steps."""
    settings = [f"${number}={value:g}" for number, value in {**BASE, **program.settings}.items()]
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        text = "\n".join(["$X", *settings, *program.lines]) + "\n"
        if program.settings.get("398", BASE["398"]) != 100:  # counts from the next start on
            _run(place, "\n".join(["$X", *settings]) + "\n")
        _run(place, text)
        rows = [line for line in (place / "steps").read_text().splitlines() if line[:1] == " "]
    start = previous = None
    end, at = 0.0, (0, 0, 0)
    for row in rows:
        moment, _, figures = row.strip().partition(" ")
        places = tuple(int(each) for each in figures.split(",")[:3])
        start = float(moment) if start is None else start
        if previous is not None and places != previous:
            end, at = float(moment), places
        previous = places
    return end - (start or 0.0), at


def _run(folder: Path, text: str) -> None:
    (folder / "program").write_text(text + "\x06")  # control-F ends it when it is idle
    command = [
        FIRMWARE,
        "-n",
        "-t",
        "0.06",
        "-r",
        "0.001",
        "-e",
        folder / "EEPROM.DAT",
        "-s",
        folder / "steps",
    ]
    with (folder / "program").open() as given, (folder / "answers").open("w") as answers:
        process = subprocess.Popen(command, cwd=folder, stdin=given, stdout=answers, stderr=answers)
        try:
            process.wait(400)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


PROGRAMS = _programs()

if __name__ == "__main__":
    chosen = sys.argv[1:]
    for each in PROGRAMS:
        if not chosen or each.name in chosen:
            seconds, places = measured(each)
            print(f'    "{each.name}": ({seconds:.4f}, {places}),', flush=True)
