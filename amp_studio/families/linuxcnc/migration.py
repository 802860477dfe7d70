"""A machine description as a configuration of LinuxCNC.
What was measured on the real program is decision 0076.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

from amp_studio.meaning import (
    AxisMeaning,
    Graded,
    MachineMeaning,
    WrittenMachine,
    inwards_high,
    inwards_low,
    not_above,
)

from .kinematics import LETTERS
from .migrated_ini import MigratedIni, taken_from
from .migration_home import NOT_HOMED, HomeKeys
from .offsets import numbered_parameters, tool_table
from .template import hal_template

_TURNING = "ABC"


def migrate(machine: MachineMeaning, answers: Mapping[str, str]) -> WrittenMachine:
    """Return the configuration folder of a machine, with a grade for each concept."""
    return _Migration(machine, answers).written()


class _Migration:
    def __init__(self, machine: MachineMeaning, answers: Mapping[str, str]) -> None:
        self.machine, self.answers = machine, answers
        self.out, self.ini = WrittenMachine(), MigratedIni()
        self.name = re.sub(r"[^A-Za-z0-9_-]+", "_", machine.name).strip("_") or "machine"
        self.letters = {axis.instance: self._letter(axis) for axis in machine.axes}
        order = sorted(
            (a for a in machine.axes if self.letters[a.instance]),
            key=lambda a: LETTERS.index(self.letters[a.instance]),
        )
        self.axes = {axis.instance: joint for joint, axis in enumerate(order)}
        self.ordered = order

    def written(self) -> WrittenMachine:
        """Return all of it."""
        asked = {}
        for question in self.machine.questions:
            if question.is_number:
                self.out.number(question, self.answers)
            else:
                asked[question.id] = self.out.answer(question, self.answers, "[+-]")
        steps = self._home_order()
        self._programs()
        self._path()
        for axis in self.ordered:
            self._joint(axis, asked.get(f"feedback.sign.{axis.name}", ""), steps)
        self._spindle()
        self._startup()
        texts = self.out.texts
        texts[f"{self.name}.ini"] = self.ini.text(self.machine.name or self.name)
        texts["machine.hal"] = hal_template([bool(axis.number("gain")) for axis in self.ordered])
        texts[f"{self.name}.var"] = numbered_parameters(
            ((a, self.letters[a.instance]) for a in self.ordered), self.out
        )
        texts["tool.tbl"] = tool_table(self.machine, self.out)
        return self.out

    # -- the whole machine
    # ---------------------------------------------------------------------------------------------

    def _letter(self, axis: AxisMeaning) -> str:
        """Return the letter of an axis; LinuxCNC turns A, B and C, and no other (X44)."""
        alike = [x for x in LETTERS if (x in _TURNING) == axis.turns]
        return self.out.letter(axis, self.machine.axes, alike, self.answers)

    def _home_order(self) -> dict[str, int]:
        """Return letter -> step of Home All; empty where it was not answered."""
        homed = [a for a in self.ordered if a.choice("home.kind") not in NOT_HOMED]
        if not homed:
            return {}
        steps = self.out.home_steps([self.letters[a.instance] for a in homed], self.answers)
        return {letter: n for n, step in enumerate(steps) for letter in step}

    def _programs(self) -> None:
        """Write which programs run and which files they read."""
        put, letters = self.ini.put, [self.letters[a.instance] for a in self.ordered]
        put("EMC", "VERSION", "1.1")
        put("EMC", "MACHINE", self.machine.name or self.name)
        put(
            "DISPLAY",
            "DISPLAY",
            "linuxcncrsh",
            "without a screen, to try it; axis, gmoccapy or qtvcp for one",
        )
        put("DISPLAY", "POSITION_FEEDBACK", "ACTUAL")
        put("TASK", "TASK", "milltask")
        put("TASK", "CYCLE_TIME", "0.010")
        put("RS274NGC", "PARAMETER_FILE", f"{self.name}.var")
        put("EMCMOT", "EMCMOT", "motmod")
        put("EMCMOT", "COMM_TIMEOUT", "1.0")
        put("EMCMOT", "SERVO_PERIOD", "1000000")
        put("EMCIO", "EMCIO", "io")
        put("EMCIO", "CYCLE_TIME", "0.100")
        put("EMCIO", "TOOL_TABLE", "tool.tbl")
        put("HAL", "HALFILE", "machine.hal", "a template: it moves nothing until it is wired")
        put("KINS", "KINEMATICS", f"trivkins coordinates={''.join(letters)}")
        put("KINS", "JOINTS", str(len(letters)))
        put("TRAJ", "COORDINATES", " ".join(letters))
        put("TRAJ", "LINEAR_UNITS", "mm")
        put("TRAJ", "ANGULAR_UNITS", "degree")
        put("TRAJ", "SPINDLES", "1")

    def _path(self) -> None:
        """Write and grade the speeds along a path and of jogs."""
        linear = [axis.number("rapid") for axis in self.ordered if not axis.turns]
        if linear and all(linear):
            # A limit below the diagonal would slow moves of several axes that the old control made
            # faster.
            norm = math.sqrt(sum((speed or 0.0) ** 2 for speed in linear)) / 60.0
            self.ini.put("TRAJ", "MAX_LINEAR_VELOCITY", not_above(norm), "the diagonal of the axes")
        jogs = [axis.number("jog") for axis in self.ordered if not axis.turns]
        speeds = [speed for speed in jogs if speed]
        if speeds:
            self.ini.put(
                "DISPLAY",
                "MAX_LINEAR_VELOCITY",
                not_above(min(speeds) / 60.0),
                "the slowest of the fastest jogs",
            )
            self.ini.put("DISPLAY", "DEFAULT_LINEAR_VELOCITY", not_above(min(speeds) / 600.0))
        for axis in self.ordered:
            self.out.grade(
                axis,
                "jog",
                "approximate",
                "[DISPLAY]MAX_LINEAR_VELOCITY",
                not_above(min(speeds) / 60.0) if speeds else "",
                "each axis has its own jog speeds",
                "one greatest jog speed for all linear axes, the least of them",
                "the new one",
            )

    def _spindle(self) -> None:
        """Write and grade the speeds of the spindle."""
        greatest, least = self._speeds("spindle.greatest"), self._speeds("spindle.least")
        if not greatest:
            self.out.less_safe.append(
                "the spindle has no greatest speed: the old file has none that is active"
            )
            return
        most, slow = max(greatest), min(least, default=0.0)
        section = "SPINDLE_0"
        for key, value in (
            ("MAX_FORWARD_VELOCITY", most),
            ("MIN_FORWARD_VELOCITY", slow),
            ("MAX_REVERSE_VELOCITY", most),
            ("MIN_REVERSE_VELOCITY", slow),
        ):
            self.ini.put(section, key, not_above(value))
        for key, value in (("MAX_VELOCITY", most), ("MIN_VELOCITY", slow)):
            self.ini.put(
                section,
                key,
                not_above(value),
                "the same for the 2.9.0~pre1 of Debian 12, which reads this name",
            )
        gears = (
            "one range for each gear",
            "one range for all gears: the gears and their voltages are a matter of HAL",
            "the old one",
        )
        self.out.graded += [
            Graded(
                "",
                "spindle.greatest",
                "approximate",
                "[SPINDLE_0]MAX_FORWARD_VELOCITY",
                not_above(most),
                *gears,
            ),
            Graded(
                "", "spindle.least", "approximate", "[SPINDLE_0]MIN_FORWARD_VELOCITY", not_above(slow), *gears
            ),
        ]
        self.out.measure.append("volts per rpm of each gear of the spindle")

    def _speeds(self, concept: str) -> list[float]:
        """Return the speeds above 0 of a concept, one for each gear."""
        figure = self.machine.figures.get(concept)
        values = figure.value if figure else None
        listed = values if isinstance(values, list) else [values]
        return [
            float(v) for v in listed if isinstance(v, (int, float)) and not isinstance(v, bool) and v > 0.0
        ]

    def _startup(self) -> None:
        """Write and grade the modes at the start."""
        figure = self.machine.figures.get("startup")
        code = f"{figure.value if figure else 'G21 G90 G94'} G17 G40 G49 G54 G64 P0.01 G80 G97"
        self.ini.put("RS274NGC", "RS274NGC_STARTUP_CODE", code)
        self.out.graded.append(
            Graded(
                "",
                "startup",
                "approximate",
                "[RS274NGC]RS274NGC_STARTUP_CODE",
                code,
                "the modes after power-up",
                "the same modes; G64 P0.01 rounds corners by a hundredth",
                "neither",
            )
        )

    # -- one axis
    # ------------------------------------------------------------------------------------------------------

    def _joint(self, axis: AxisMeaning, sign: str, steps: Mapping[str, int]) -> None:
        """Write an axis: its joint, travel, speeds, loop and homing."""
        joint, letter = self.axes[axis.instance], self.letters[axis.instance]
        j, a = f"JOINT_{joint}", f"AXIS_{letter}"
        self.ini.put(j, "TYPE", "ANGULAR" if axis.turns else "LINEAR", taken_from(axis, "kind", "exact"))
        self.out.grade(axis, "kind", "exact", f"[{j}]TYPE", "ANGULAR" if axis.turns else "LINEAR")
        self._travel(axis, j, a)
        self._motion(axis, j, a)
        self._loop(axis, j, sign)
        HomeKeys(self.out, self.ini, self.answers).write(axis, j, steps.get(letter))
        if axis.number("feed.ceiling") is not None:
            self.out.grade(
                axis,
                "feed.ceiling",
                "not_possible",
                loses="the ceiling of the cutting speed: F runs up to the rapid speed",
                do="look at the F words of programs",
            )
            self.out.less_safe.append(
                f"{axis.letter}: no ceiling of the cutting speed; a program with a large F cuts at it, up to"
                " the rapid speed"
            )
        self.out.measure.append(
            f"{axis.letter}: direction and scale of the feedback against a gauge, the way it needs to stop at"
            " each end, backlash, and the sign of the output to its drive (OUTPUT_SCALE)"
        )
        if voltage := axis.number("output.sign"):
            way = "positive" if voltage > 0.0 else "negative"
            self.out.grade(
                axis,
                "output.sign",
                "approximate",
                f"[{j}]OUTPUT_SCALE",
                "above 0" if voltage > 0.0 else "below 0",
                f"a {way} voltage moves it in its positive direction",
                "the same where the drive and its wires stay; the key is not written, as its size is the new"
                " card's",
                "neither: try it with the motor off its load",
            )

    def _travel(self, axis: AxisMeaning, j: str, a: str) -> None:
        """Write the limits of an axis, and whether it goes round."""
        kind = axis.choice("travel.kind")
        for concept, key, rounded in (
            ("travel.low", "MIN_LIMIT", inwards_low),
            ("travel.high", "MAX_LIMIT", inwards_high),
        ):
            value = axis.number(concept)
            if kind == "limits" and value is not None:
                for section in (j, a):
                    self.ini.put(section, key, rounded(value), taken_from(axis, concept, "exact"))
                self.out.grade(axis, concept, "exact", f"[{j}]{key}, [{a}]{key}", rounded(value))
            else:
                self.out.grade(axis, concept, "exact", f"[{j}]{key}, [{a}]{key}", "left out")
        self.out.grade(
            axis,
            "travel.kind",
            "exact",
            f"[{j}]MIN_LIMIT, [{j}]MAX_LIMIT",
            "written" if kind == "limits" else "left out",
        )
        self._less_travel(axis, kind)
        if axis.turns and (axis.number("rollover") or kind == "modulo"):
            self.ini.put(a, "WRAPPED_ROTARY", "1", taken_from(axis, "rollover", "approximate"))
            self.out.grade(
                axis,
                "rollover",
                "approximate",
                f"[{a}]WRAPPED_ROTARY",
                "1",
                "a turn is from 0 to 360, and the position starts again",
                "positions go on past a turn, and the sign of the word is the direction",
                "neither: try it without a part",
            )

    def _less_travel(self, axis: AxisMeaning, kind: str) -> None:
        """Say which limits are not there."""
        if not kind:
            self.out.less_safe.append(f"{axis.letter}: its travel limits are not known; none was written")
        elif kind == "limits":
            for end, concept in (("lower", "travel.low"), ("upper", "travel.high")):
                if axis.number(concept) is None:
                    self.out.less_safe.append(f"{axis.letter}: no travel limit at its {end} end")
        elif not axis.turns:
            self.out.less_safe.append(f"{axis.letter}: no travel limits, as before")

    def _motion(self, axis: AxisMeaning, j: str, a: str) -> None:
        """Write the greatest speed and acceleration of an axis."""
        rapid, ramp = axis.number("rapid"), axis.number("acceleration")
        if rapid:
            for section in (j, a):
                self.ini.put(
                    section, "MAX_VELOCITY", not_above(rapid / 60.0), taken_from(axis, "rapid", "exact")
                )
            self.out.grade(
                axis, "rapid", "exact", f"[{j}]MAX_VELOCITY, [{a}]MAX_VELOCITY", not_above(rapid / 60.0)
            )
        else:
            self.out.less_safe.append(f"{axis.letter}: no rapid speed is known; LinuxCNC takes 1 unit/s")
        if ramp:
            for section in (j, a):
                self.ini.put(
                    section,
                    "MAX_ACCELERATION",
                    not_above(ramp),
                    taken_from(axis, "acceleration", "approximate"),
                )
            kind = axis.choice("ramp.kind") or "trapezoid"
            now = "a straight ramp with it in jogs, homing and G61; G64 has half of it"
            self.out.grade(
                axis,
                "acceleration",
                "approximate",
                f"[{j}]MAX_ACCELERATION",
                not_above(ramp),
                f"a {kind} ramp",
                now,
                "the new one is gentler on paths",
            )
            self.out.grade(
                axis,
                "ramp.kind",
                "approximate",
                f"[{j}]MAX_ACCELERATION",
                not_above(ramp),
                f"a {kind} ramp",
                now,
                "the old one where it is smoother",
            )
        else:
            self.out.measure.append(
                f"{axis.letter}: acceleration; none is known, and LinuxCNC takes 1 unit/s2 until"
                " MAX_ACCELERATION is there"
            )
        if axis.number("jerk"):
            self.out.grade(
                axis,
                "jerk",
                "not_possible",
                loses="the limited jerk of positioning",
                do="MAX_JERK of LinuxCNC 2.10, or a lower acceleration",
            )

    def _loop(self, axis: AxisMeaning, j: str, sign: str) -> None:
        """Write the limit of the following error, the gains, backlash and scale of a joint."""
        limit, gain, forward = axis.number("error.limit"), axis.number("gain"), axis.number("feed_forward")
        if limit:
            # The old control has one limit at every speed; with both alike LinuxCNC has too.
            for key in ("FERROR", "MIN_FERROR"):
                self.ini.put(j, key, not_above(limit), taken_from(axis, "error.limit", "exact"))
            self.out.grade(axis, "error.limit", "exact", f"[{j}]FERROR, [{j}]MIN_FERROR", not_above(limit))
            self.out.measure.append(
                f"{axis.letter}: greatest following error in a rapid move; then FERROR as narrow as it works"
            )
        else:
            self.out.less_safe.append(
                f"{axis.letter}: no limit of the following error is known; LinuxCNC takes 1 unit"
            )
        if gain:
            self.ini.put(j, "P", not_above(gain), taken_from(axis, "gain", "exact"))
            self.out.grade(axis, "gain", "exact", f"[{j}]P", not_above(gain))
        self.ini.put(j, "FF1", not_above(forward or 0.0), taken_from(axis, "feed_forward", "exact"))
        self.out.grade(axis, "feed_forward", "exact", f"[{j}]FF1", not_above(forward or 0.0))
        # 0 is no limit.
        self.ini.put(j, "MAX_OUTPUT", "0")
        if (play := axis.number("backlash")) is not None:
            self.ini.put(j, "BACKLASH", not_above(play), taken_from(axis, "backlash", "approximate"))
            self.out.grade(
                axis,
                "backlash",
                "approximate",
                f"[{j}]BACKLASH",
                not_above(play),
                "the whole of it is added in one direction",
                "half of it is added in each direction: zero moves by half",
                "neither: measure it again",
            )
        if (scale := axis.number("scale")) is not None:
            value = f"{'-' if sign.startswith('-') else ''}{scale:.9g}" if sign in ("+", "-") else ""
            if value:
                self.ini.put(j, "ENCODER_SCALE", value, taken_from(axis, "scale", "exact"))
            self.out.grade(axis, "scale", "exact", f"[{j}]ENCODER_SCALE", value or f"{scale:.9g}, sign open")
