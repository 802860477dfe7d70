"""Examples with other limits, signs, homing and units, migrated and started in the real program: its pins
have the figures that the old file means, and every joint homes to where its file has it.

``python -m tests.families.linuxcnc.mutated_migrations [NUMBER ...]`` runs them, as root and with a user
``cnc``.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from math import isclose
from pathlib import Path

from amp_studio import AmpStudioError
from amp_studio.assignments import read_assignments
from amp_studio.families.linuxcnc.control.running import pins_of, values_of
from amp_studio.files import ParameterFile, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.formats import import_file
from amp_studio.meaning import Migration, migrate

from .test_real_program import USER, has_user

NO_LIMIT = 1e99
SECONDS = 150
"""Until it is homed: a Syntec has no acceleration that is known, and LinuxCNC takes 1 mm/s2."""
ANSWERS = (("feedback.sign.", "+"), ("home.speed.", "600"), ("home.encoder.", "120.5"), ("counts.", "4000"))
"""To every question whose id begins so; the axes home one after the other."""
ENDS = {
    "mill-1394": "++++",
    "lathe-ls176": "++",
    "num-1060-mill": "--+.",
    "syntec-mill": "----",
    "acromill-router": "+++",
    "grblhal-router": "--+",
    "57c422b-label-press": "..",
}
"""Example -> the end at which the home switch of each joint is in the old file, "." without one: 1010 (page
5-15), P15 (7-8), Pr861 (2.2.2.3), the direction of AcroMill (65) and $23 (S2427). Never read from what was
written."""
SWITCH = 5.0
"""mm or deg from the start to each switch."""


@dataclass(frozen=True)
class Mutation:
    """An example with other values, and the pins that it must bring."""

    example: str
    what: str
    values: dict[str, str] = field(default_factory=dict)
    pins: dict[str, float] = field(default_factory=dict)
    ends: str = ""
    """Where the switches are, if not where they are in the example."""
    zero: float | None = None
    """The coordinate of the first joint's marker in the old file, of its switch without one."""
    counts: float = 0.0
    """What the encoder of the first joint counts in a unit, with its sign; 0 for none between motor and
    loop.
    """
    answers: dict[str, str] = field(default_factory=dict)
    homes: bool = True
    compared: int = 16
    """How many values of the file the program has to use at least."""
    refused: bool = False


def _limits(low: float, high: float) -> dict[str, float]:
    return {"ini.0.min_limit": low, "ini.0.max_limit": high, "ini.x.min_limit": low, "ini.x.max_limit": high}


def _of_9pc() -> Iterator[Mutation]:
    mill = "mill-1394"
    yield Mutation(mill, "as it is", {}, _limits(-500.0, 8.0), zero=6.0)
    yield Mutation(mill, "limits", {"1320": "7 mm", "1330": "-250 mm"}, _limits(-250.0, 7.0))
    minus = {"1010": "minus", "1002": "positive", "1310": "-490 mm"}
    yield Mutation(mill, "minus homing", minus, {"ini.0.home": -490.0}, ends="-+++", zero=-490.0)
    yield Mutation(mill, "gain 2", {"1710": "2"}, {"pid.0.Pgain": 100.0 / 3.0})
    yield Mutation(mill, "no overtravel", {"1020": "no"}, _limits(-NO_LIMIT, NO_LIMIT))
    yield Mutation(
        mill, "inch limits", {"1320": "0.25 in", "1330": "-10 in", "1310": "0.2 in"}, _limits(-254.0, 6.35)
    )
    yield Mutation(mill, "slow", {"1203": "3000 mm/min"}, {"ini.0.max_velocity": 50.0})
    yield Mutation(mill, "slower down", {"1211": "300 mm/s2"}, {"ini.0.max_acceleration": 300.0})
    yield Mutation(mill, "reversal error", {"1340": "0.01 mm"}, {"ini.0.backlash": 0.01})
    home = {"ini.0.home": 6.0, "ini.0.home_offset": 4.5}
    yield Mutation(mill, "calibration", {"1300": "1.5 mm"}, home, zero=4.5)
    yield Mutation(mill, "crossed limits", {"1320": "-500 mm", "1330": "8 mm"}, refused=True)
    yield Mutation(mill, "limits of Y", {"2320": "50 mm", "2330": "-60 mm"}, {"ini.1.min_limit": -60.0})
    yield Mutation(mill, "one side of zero", {"1330": "1 mm"}, _limits(1.0, 8.0))
    yield Mutation(
        mill, "following error", {"1750": "2.5 mm"}, {"ini.0.ferror": 2.5, "ini.0.min_ferror": 2.5}
    )
    yield Mutation(mill, "negative backlash", {"1340": "-0.02 mm"}, {"ini.0.backlash": 0.02})
    yield Mutation(mill, "very slow", {"1203": "60 mm/min"}, {"ini.0.max_velocity": 1.0})
    yield Mutation(mill, "no overtravel of Z", {"3020": "no"}, {"ini.2.max_limit": NO_LIMIT})
    inch = {"1330": "-20 in", "1203": "100 ipm", "1310": "0.1 in", "1750": "0.1 in"}
    yield Mutation(
        mill, "all in inch", inch, {"ini.0.min_limit": -508.0, "ini.0.home": 2.54, "ini.0.ferror": 2.54}
    )
    minus_x, counts = {"feedback.sign.X": "-"}, 2097152 / 12.7
    yield Mutation(mill, "encoder that counts back", counts=-counts, answers=minus_x, zero=6.0)
    yield Mutation(mill, "encoder that counts on", {"1595": "Minus"}, counts=counts, zero=6.0)
    one_sign = {"1010": "minus", "1310": "-490 mm"}
    yield Mutation(mill, "search and latch of one sign", one_sign, {"ini.0.home": -490.0}, ends="-+++")
    lathe = "lathe-ls176"
    minus_limits = {"1330": "-20 mm", "1320": "-1 mm"}
    yield Mutation(lathe, "minus limits", minus_limits, _limits(-20.0, -1.0), homes=False)
    yield Mutation(lathe, "as it is", {}, _limits(-8.0, 155.0), homes=False)
    yield Mutation(lathe, "limits", {"1320": "152 mm"}, _limits(-8.0, 152.0), homes=False)


def _of_others() -> Iterator[Mutation]:
    num = "num-1060-mill"
    yield Mutation(num, "as it is", {}, _limits(-1.0, 600.0))
    yield Mutation(num, "limits", {"P17N0": "-5000", "P17N1": "400000"}, _limits(-5.0, 400.0))
    yield Mutation(num, "plus homing", {"P15N0": "2"}, {"ini.0.home": 0.0}, ends="+-+.", zero=0.0)
    yield Mutation(num, "zero elsewhere", {"P16N0": "5000"}, {"ini.0.home": 5.0}, zero=5.0)
    yield Mutation(num, "no room", {"P17N0": "0", "P17N1": "0"}, _limits(0.0, 0.0), homes=False)
    yield Mutation(num, "error", {"P23N0": "3000"}, {"ini.0.ferror": 3.0})
    yield Mutation(num, "negative backlash", {"P18N0": "-7"}, {"ini.0.backlash": 0.007})
    yield Mutation(num, "rapid", {"P30N0": "6000"}, {"ini.0.max_velocity": 100.0})
    minus = {"P17N0": "-600000", "P17N1": "-1000", "P16N0": "-2000", "P15N0": "2"}
    yield Mutation(num, "minus side", minus, _limits(-600.0, -1.0), ends="+-+.", zero=-2.0)
    yield Mutation(num, "no switch", {"P15N1": "1"}, ends=".-++")
    minus_x = {"feedback.sign.X": "-"}
    yield Mutation(num, "encoder that counts back", counts=-2000.0, answers=minus_x, zero=0.0)
    syntec = "syntec-mill"
    yield Mutation(syntec, "crossed limits", {"Pr2401": "-300000", "Pr2402": "1000"}, refused=True)
    yield Mutation(syntec, "as it is", {}, {**_limits(-2.0, 400.0), "pid.0.Pgain": 30.0}, zero=0.0)
    yield Mutation(syntec, "plus homing", {"Pr861": "positive"}, ends="+---", zero=0.0)
    gain = {"pid.0.Pgain": 2.0, "ini.0.ferror": 400.0, "ini.0.min_ferror": 400.0}
    yield Mutation(syntec, "gain 2", {"servo.loop_gain@1": "2"}, gain)
    yield Mutation(syntec, "inch", {"Pr461": "100 in/min"}, {"ini.0.max_velocity": 42.333333})
    none = {"Pr2401": "999999999", "Pr2402": "-999999999"}
    yield Mutation(syntec, "no limits", none, _limits(-NO_LIMIT, NO_LIMIT))
    yield Mutation(syntec, "another BLU", {"Pr17": "raw:1"}, _limits(-NO_LIMIT, NO_LIMIT))
    yield Mutation(
        syntec, "one side of zero", {"Pr2402": "1000"}, {**_limits(1.0, 400.0), "ini.0.home": 1.01}
    )
    yield Mutation(syntec, "encoder that counts back", counts=-2000.0, answers=minus_x)
    yield Mutation(syntec, "limits", {"Pr2401": "300000", "Pr2402": "-1000"}, _limits(-1.0, 300.0))
    yield Mutation(syntec, "no room", {"Pr2401": "0", "Pr2402": "0"}, _limits(0.0, 0.0), homes=False)
    yield Mutation(syntec, "rapid", {"Pr461": "6000"}, {"ini.0.max_velocity": 100.0})
    router = "acromill-router"
    yield Mutation(router, "as it is", {}, _limits(-711.2, 2.54))
    yield Mutation(
        router,
        "minus homing",
        {"home.direction@X": "neg", "home.preset@X": "-28 in"},
        {"ini.0.home": -711.19},
        ends="-++",
        zero=-711.2,
    )
    yield Mutation(router, "no limits", {"axes.disable_limit@X": "true"}, _limits(-NO_LIMIT, NO_LIMIT))
    yield Mutation(router, "metric limits", {"axes.soft_limit_minus@X": "-500 mm"}, _limits(-500.0, 2.54))
    yield Mutation(router, "home elsewhere", {"home.preset@X": "-1 in"}, {"ini.0.home": -25.4}, zero=-25.4)
    yield Mutation(router, "encoder that counts back", counts=-20480 / 25.4, answers=minus_x)
    crossed = {"axes.soft_limit_minus@X": "1 in", "axes.soft_limit_plus@X": "-1 in"}
    yield Mutation(router, "crossed limits", crossed, refused=True)
    grbl = "grblhal-router"
    yield Mutation(grbl, "slow", {"$110": "60", "$120": "10"}, {"ini.0.max_velocity": 1.0})
    yield Mutation(grbl, "far off the switch", {"$27": "20"})
    yield Mutation(grbl, "as it is", {}, {"ini.0.max_velocity": 133.333333})
    yield Mutation(grbl, "plus homing", {"$23": "0"}, ends="+++")
    yield Mutation(grbl, "no soft limits", {"$20": "no"}, _limits(-NO_LIMIT, NO_LIMIT))
    yield Mutation(grbl, "travel", {"$130": "500 mm"})


def _of_57c422b() -> Iterator[Mutation]:
    """Home, rapid and ramp are in no register whose meaning is known: nothing homes, and LinuxCNC has its
    own.
    """
    press, linear = "57c422b-label-press", {"R0": "0x0404", "R11": "400000", "R13": "-40000", "R8": "8000"}
    none = {**_limits(-NO_LIMIT, NO_LIMIT), "ini.0.max_velocity": 1.0, "ini.0.home_sequence": 999.0}
    yield Mutation(press, "as it is", {}, none, homes=False, compared=8)
    found = {**_limits(-10.0, 100.0), "ini.0.ferror": 2.0, "ini.0.min_ferror": 2.0}
    yield Mutation(press, "linear", linear, found, homes=False, compared=12)
    yield Mutation(
        press,
        "limits",
        linear | {"R11": "-4", "R13": "-399999"},
        _limits(-99.99975, -0.001),
        homes=False,
        compared=12,
    )
    inch = {"counts.X": "101600"}
    found = {**_limits(-0.393700, 3.937007), "ini.0.ferror": 0.07874}
    yield Mutation(press, "other counts", linear, found, answers=inch, homes=False, compared=12)
    yield Mutation(
        press, "minus homing", linear | {"R2": "0x0118"}, {"ini.0.home": 0.0}, homes=False, compared=12
    )
    yield Mutation(press, "gain 2", linear | {"R3": "32767"}, {"pid.0.Pgain": 50.0}, homes=False, compared=12)
    yield Mutation(
        press, "no overtravel", linear | {"R2": "0x001C"}, _limits(-10.0, 100.0), homes=False, compared=12
    )
    crossed = linear | {"R11": "-40000", "R13": "40000"}
    yield Mutation(press, "crossed limits", crossed, _limits(-NO_LIMIT, NO_LIMIT), homes=False, compared=8)
    minus = {"feedback.sign.X": "-"}
    yield Mutation(
        press, "encoder that counts back", linear, counts=-4000.0, answers=minus, homes=False, compared=12
    )
    yield Mutation(
        press, "turned drive", linear | {"R1": "0x0000"}, _limits(-10.0, 100.0), homes=False, compared=12
    )


def _of_ways_home() -> Iterator[Mutation]:
    """Scales and encoders that are homed without a switch, or not at all."""
    mill, lathe, num, syntec = "mill-1394", "lathe-ls176", "num-1060-mill", "syntec-mill"
    offset = {"ini.0.home_offset": -120.5}
    yield Mutation(mill, "absolute", {"1570": "hiperface-absolute"}, offset, ends=".+++")
    yield Mutation(mill, "no marker", {"1570": "aqb-no-marker"}, {"ini.0.home_sequence": 999.0}, homes=False)
    yield Mutation(mill, "distance-coded", {"1570": "dcm"}, {"ini.0.home_sequence": 999.0}, homes=False)
    yield Mutation(lathe, "one marker", {"1570": "aqb-one-marker"}, {"ini.0.home": 150.0}, homes=False)
    yield Mutation(
        num,
        "absolute",
        {"P34N0": "0x02000000"},
        {"ini.0.home_offset": 120.5},
        ".-+.",
        answers={"home.encoder.X": "-120.5"},
    )
    yield Mutation(num, "coded", {"P34N0": "0x06000000"}, {"ini.0.home_sequence": 999.0}, homes=False)
    yield Mutation(syntec, "index only", {"Pr961": "index-only"}, {"ini.0.home": 0.0}, ends=".---")
    yield Mutation(syntec, "dog only", {"Pr961": "dog-only"}, {"ini.0.home": 0.0}, zero=0.0)


def _of_shapes() -> Iterator[Mutation]:
    """Machines with other axes, and places of home that no limit allows."""
    mill, num, syntec, router = "mill-1394", "num-1060-mill", "syntec-mill", "acromill-router"
    turned = {"ini.3.min_limit": -90.0, "ini.3.max_limit": 90.0}
    yield Mutation(mill, "rotary limits", {"4020": "yes", "4320": "90 deg", "4330": "-90 deg"}, turned)
    alone = {"361": "unfitted", "362": "unfitted", "363": "unfitted"}
    yield Mutation(mill, "single axis", alone, _limits(-500.0, 8.0), ends="+", compared=10)
    six = {"365": "linear", "255": "W", "366": "rotary", "256": "C"}
    yield Mutation(mill, "six axes", six, ends="++++++")
    yield Mutation(mill, "other letters", {"250": "U", "251": "W"})
    beyond = {"ini.0.home": 7.99, "ini.0.max_limit": 8.0}
    yield Mutation(mill, "home above its limit", {"1310": "20 mm"}, beyond)
    yield Mutation(mill, "scale of a count", {"1575": "1", "1590": "1000 mm"}, _limits(-500.0, 8.0))
    yield Mutation(num, "scale of many counts", {"P11N0": "1", "P11N1": "99999"})
    yield Mutation(syntec, "rotary limits", {"Pr2407": "90000", "Pr2408": "-90000"}, turned)
    yield Mutation(router, "turns by its name", {"axes.name@Y": "a"}, refused=True)
    inside = {"ini.0.home": 2.53, "ini.0.max_limit": 2.54}
    yield Mutation(router, "home above its limit", {"home.preset@X": "5 in"}, inside, zero=127.0)


MUTATIONS = (*_of_9pc(), *_of_others(), *_of_57c422b(), *_of_ways_home(), *_of_shapes())
SCREEN = '''#!/usr/bin/python3
"""Has written what the running program uses, homes all joints, and has written where they are."""
import pathlib, subprocess, time
import linuxcnc
here = pathlib.Path(__file__).parent
command, status = linuxcnc.command(), linuxcnc.stat()
def show(name):
    asked = subprocess.run(["halcmd", "-s", "show", "pin"], capture_output=True, text=True)
    (here / name).write_text(asked.stdout)
time.sleep(0.5)
show("pins.txt")
command.state(linuxcnc.STATE_ESTOP_RESET); command.wait_complete()
command.state(linuxcnc.STATE_ON); command.wait_complete()
command.mode(linuxcnc.MODE_MANUAL); command.wait_complete()
command.teleop_enable(0); command.wait_complete()
command.home(-1)
for _ in range({seconds} * 10):
    status.poll()
    if all(status.homed[n] for n in {joints}):
        break
    time.sleep(0.1)
time.sleep(1.0)
show("homed.txt")
'''


def mutated(mutation: Mutation) -> ParameterFile:
    """Return the example with its other values; a number of a parameter without an axis is its first
    one's.
    """
    file = open_file(next((examples_folder() / mutation.example).glob("*.amp"))).file
    file.set_checked(read_assignments(file, mutation.values.items()), force="a mutation")
    return file


def migrated(file: ParameterFile, own: Mapping[str, str]) -> Migration:
    """Return a file migrated, with every question answered, those in ``own`` otherwise."""
    asked = [question.id for question in migrate(file, "linuxcnc").written.asked]
    axes = [name.rpartition(".")[2] for name in asked if name.startswith("feedback.sign.")] or list("XYZ")
    answers = {name: text for name in asked for start, text in ANSWERS if name.startswith(start)}
    if "home.order" in asked:
        question = next(q.question for q in migrate(file, "linuxcnc").written.asked if q.id == "home.order")
        found = re.search(r"\(([A-Z, ]+)\)", question)
        axes = found[1].split(", ") if found else axes
        answers["home.order"] = ", ".join(axes)
    return migrate(file, "linuxcnc", answers | dict(own))


def with_machine(hal: str, ends: str, counts: float) -> str:
    """Return the HAL of a migration with a simulated switch and marker where the old machine has them, and
    with the first joint's encoder in its loop.
    """
    first, lines = [f"loadrt sim_home_switch names={','.join(f'switch.{n}' for n in range(len(ends)))}"], []
    if counts:
        hal = hal.replace("net feedback.0 table.0.out", "net feedback.0 card.out")
        first += ["loadrt scale names=encoder", "loadrt div2 names=card"]
        lines += [
            "addf encoder servo-thread",
            "addf card servo-thread",
            f"setp encoder.gain {counts!r}",
            "setp card.in1 [JOINT_0]ENCODER_SCALE",
            "net counts encoder.out => card.in0",
            "net place.0 table.0.out => encoder.in",
        ]
    for n, end in enumerate(ends):
        lines += [
            f"addf switch.{n} servo-thread",
            f"setp switch.{n}.home-pos {-SWITCH if end == '-' else SWITCH}",
            f"net {'place' if counts and n == 0 else 'feedback'}.{n} => switch.{n}.cur-pos",
            f"net marker.{n} switch.{n}.index-enable <=> joint.{n}.index-enable",
        ]
        if end != ".":
            lines.append(f"net home.{n} switch.{n}.home-sw => joint.{n}.home-sw-in")
    return "\n".join((*first, hal, *lines, ""))


def faults(mutation: Mutation) -> Iterator[str]:
    """Yield what the real program does otherwise than the old file means."""
    file = mutated(mutation)
    texts, ends = migrated(file, mutation.answers).written.texts, mutation.ends or ENDS[mutation.example]
    folder = Path(tempfile.mkdtemp(prefix="amp-studio-mutated-"))
    try:
        name = next(each for each in texts if each.endswith(".ini"))
        for each, text in texts.items():
            own = with_machine(text, ends, mutation.counts) if each == "machine.hal" else text
            own = re.sub(r"(?m)^DISPLAY *=.*$", "DISPLAY = ./screen.py", own) if each == name else own
            (folder / each).write_text(own)
        written = import_file(folder / name, "linuxcnc")
        joints = [n for n in range(len(ends)) if is_homed(written, n)]
        (folder / "screen.py").write_text(
            SCREEN.format(seconds=SECONDS if mutation.homes else 0, joints=joints)
        )
        (folder / "screen.py").chmod(0o755)
        for place in (*folder.iterdir(), folder):
            shutil.chown(place, USER)
        command = f"cd '{folder}' && exec env -u DISPLAY linuxcnc {name}"
        with (folder / "log").open("w") as log:
            subprocess.run(
                ["su", USER, "-c", command], stdout=log, stderr=log, timeout=SECONDS + 100, check=False
            )
        if not (folder / "pins.txt").exists():
            yield f"it did not start: {(folder / 'log').read_text()[-600:]}"
            return
        yield from _pins(mutation, written, pins_of((folder / "pins.txt").read_text()))
        if not (folder / "homed.txt").exists():
            yield "it ended before it was homed"
        elif mutation.homes:
            yield from _homes(mutation, written, pins_of((folder / "homed.txt").read_text()), ends)
    finally:
        shutil.rmtree(folder)


def _pins(mutation: Mutation, written: ParameterFile, listed: dict[str, str]) -> Iterator[str]:
    used = values_of(written, listed)
    for address, in_use in used.items():
        if in_use != written.get(address):
            yield f"{address[0]}@{address[1]}: the file has {written.get(address)}, the program uses {in_use}"
    if len(used) < mutation.compared:
        yield f"only {len(used)} values were compared"
    for pin, value in mutation.pins.items():
        found = float(listed.get(pin, "nan"))
        if not isclose(found, value, rel_tol=2e-6, abs_tol=1e-9):
            yield f"{pin} is {found:.9g}, and the old file means {value:.9g}"


def is_homed(written: ParameterFile, joint: int) -> bool:
    """Return whether Home All homes a joint."""
    return written.get(("joint.home_sequence", str(joint))) is not None


def _homes(mutation: Mutation, written: ParameterFile, listed: dict[str, str], ends: str) -> Iterator[str]:
    for n in range(len(ends)):
        absolute = written.get(("joint.home_absolute_encoder", str(n)))
        known = "joint.home_offset" if absolute else "joint.home"  # an encoder that knows its place is 0 here
        home = written.evaluation.canonical((known, str(n)))
        place = float(listed[f"joint.{n}.pos-fb"])
        if not is_homed(written, n):
            if listed[f"joint.{n}.homed"] == "TRUE":
                yield f"joint {n} is homed, and nothing says how"
        elif listed[f"joint.{n}.homed"] != "TRUE":
            yield f"joint {n} is not homed after {SECONDS} s, at {place:.6g}"
        elif abs(place - float(home or 0.0)) > 0.05:
            yield f"joint {n} is homed at {place:.6g}, not {home}"
    if mutation.zero is not None:
        # A marker makes the feedback 0, which the loop in the computer does not: it stays where it was found.
        value = written.get(("joint.home_use_index", "0"))
        switch = 0.0 if value and value.value else (-SWITCH if ends[0] == "-" else SWITCH)
        found = switch - float(listed["joint.0.motor-offset"])
        if abs(found - mutation.zero) > 0.3:
            yield f"joint 0 found its zero at {found:.6g}, and the old file means {mutation.zero:.6g}"


if __name__ == "__main__":
    if not (shutil.which("linuxcnc") and os.geteuid() == 0 and has_user()):
        sys.exit("skipped: needs Debian's linuxcnc-uspace, root and a user cnc")
    bad = 0
    for number in [int(each) for each in sys.argv[1:]] or range(len(MUTATIONS)):
        one = MUTATIONS[number]
        try:
            found = [*faults(one)] or ["as meant"]
            bad += found != ["as meant"] or one.refused
        except AmpStudioError as error:
            found = [f"refused: {error}"]
            bad += not one.refused
        print(f"{number:2} {one.example}, {one.what}: {'; '.join(found)}", flush=True)
    sys.exit(bool(bad))
