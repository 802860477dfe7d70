"""A machine description as settings of grblHAL. What was measured on its simulator is decision 0076."""

from __future__ import annotations

import re
from collections.abc import Mapping

from amp_studio.meaning import (
    AxisMeaning,
    Graded,
    MachineMeaning,
    MigrationQuestion,
    WrittenMachine,
    inwards_high,
    not_above,
)

LETTERS, _TURNING, _LEAST = "XYZABCUV", "ABC", 3
_HOMING = 1 | 4 | 8 | 512
"""$22: on, needed at the start, home is zero, rates of each axis."""
_OPEN_LOOP = (
    "steps are counted, and nothing is measured",
    "take a drive that reports its faults, and wire its alarm to the stop",
)


def migrate(machine: MachineMeaning, answers: Mapping[str, str]) -> WrittenMachine:
    """Return the settings of a machine, with a grade for each concept."""
    return _SettingsWriter(machine, answers).written()


class _SettingsWriter:
    def __init__(self, machine: MachineMeaning, answers: Mapping[str, str]) -> None:
        self.machine, self.answers, self.out = machine, answers, WrittenMachine()
        self.values: dict[int, str] = {}
        self.startup = "G21 G90 G94"
        self._play_back: bool | None = None

    def written(self) -> WrittenMachine:
        """Return all of it."""
        places = [
            (axis, LETTERS.index(letter)) for axis in self.machine.axes if (letter := self._letter(axis))
        ]
        self._homing(places)
        for axis, place in places:
            self._axis(axis, place)
        self._spindle()
        # $22 first: soft limits are refused without it (error:10), and the rates of each axis are there with
        # its bit 9 alone (error:53).
        order = sorted(self.values, key=lambda n: (n != 22, n))
        name = re.sub(r"[^A-Za-z0-9_-]+", "_", self.machine.name).strip("_") or "machine"
        lines = [f"; {self.machine.name or name}, migrated: send from the first line to the last"]
        self.out.texts[f"{name}.settings"] = "\n".join(
            (*lines, *(f"${n}={self.values[n]}" for n in order), f"$N0={self.startup}", "")
        )
        self.out.less_safe.insert(0, "no axis is measured: a lost step or a blocked axis is not noticed")
        return self.out

    def _letter(self, axis: AxisMeaning) -> str:
        """Return the letter of an axis; asked for where it has none of its kind, "" while that is open."""
        taken = [a.letter for a in self.machine.axes if a is not axis]
        free = [x for x in LETTERS if (x in _TURNING) == axis.turns and x not in taken]
        if axis.letter in free:
            return axis.letter
        what = "turns" if axis.turns else "does not turn"
        sources = axis.figures["kind"].sources if "kind" in axis.figures else ()
        question = MigrationQuestion(
            f"letter.{axis.letter}",
            f"Axis {axis.letter} {what}: which letter shall it have ({', '.join(free)})?",
            sources,
        )
        return self.out.answer(question, self.answers, f"[{''.join(free)}]").upper()

    def _homing(self, places: list[tuple[AxisMeaning, int]]) -> None:
        """Write what is for all axes that home: direction, order, and how far off the switch."""
        homed = [
            (axis, place)
            for axis, place in places
            if axis.number("home.search") or axis.number("home.towards")
        ]
        if not homed:
            self.out.less_safe.append("no axis is homed, and so there are no soft limits")
            return
        self.values |= {22: str(_HOMING), 20: "1"}
        minus = sum(
            1 << place
            for axis, place in homed
            if (axis.number("home.search") or axis.number("home.towards") or 0.0) < 0.0
        )
        self.values[23] = str(minus)
        steps = self.out.home_steps([LETTERS[place] for _, place in homed], self.answers)
        for at, step in enumerate(steps[:6]):
            self.values[44 + at] = str(
                sum(1 << LETTERS.index(letter) for letter in step if letter in LETTERS)
            )
        question = MigrationQuestion(
            "home.pull_off", "How far from its switch does an axis stop after homing, in mm ($27)?"
        )
        if number := self.out.number(question, self.answers):
            self.values[27] = not_above(number)

    def _axis(self, axis: AxisMeaning, n: int) -> None:
        """Write and grade the settings of one axis."""
        self.out.grade(
            axis,
            "kind",
            "approximate" if axis.turns else "exact",
            "$376" if axis.turns else "",
            "a bit" if axis.turns else LETTERS[n],
            "an axis that turns, with its range",
            "degrees are counted on and on",
            "neither",
        )
        if axis.turns:
            self.values[376] = str(int(self.values.get(376, "0")) | 1 << n - _LEAST)
        question = MigrationQuestion(
            f"steps.{axis.letter}",
            f"How many steps make 1 {'degree' if axis.turns else 'mm'} of {axis.letter} at the new motor"
            f" (${100 + n})?",
        )
        if number := self.out.number(question, self.answers):
            self.values[100 + n] = not_above(number)
        if rapid := axis.number("rapid"):
            self.values[110 + n] = _thousandth(rapid)
            self.out.grade(axis, "rapid", "exact", f"${110 + n}", self.values[110 + n])
        if ramp := axis.number("acceleration"):
            self.values[120 + n] = _thousandth(ramp)
            kind = axis.choice("ramp.kind") or "trapezoid"
            for concept in ("acceleration", "ramp.kind"):
                self.out.grade(
                    axis,
                    concept,
                    "approximate",
                    f"${120 + n}",
                    self.values[120 + n],
                    f"a {kind} ramp",
                    "a straight ramp",
                    "the old one where it is smoother",
                )
        self._travel(axis, n)
        self._home(axis, n)
        self._backlash(axis, n)
        self._lost(axis)
        self.out.measure.append(
            f"{axis.letter}: direction, steps against a gauge, the way it needs to stop at each end"
        )

    def _backlash(self, axis: AxisMeaning, n: int) -> None:
        """Write and grade what one axis loses at a reversal, which only some builds take back."""
        if (play := axis.number("backlash")) is None:
            return
        if play > 0.0 and not self._takes_play_back():
            self.out.grade(
                axis,
                "backlash",
                "not_possible",
                loses=f"{play:g} at each reversal, which the old control took back",
                do="a build with backlash compensation, or a mechanism without play",
            )
            return
        value = _thousandth(play)
        if play > 0.0:
            self.values[160 + n] = value
        self.out.grade(
            axis,
            "backlash",
            "approximate",
            f"${160 + n}",
            value,
            "added at each reversal",
            "the same, in a build that has it" if play > 0.0 else "left out: there is none",
            "neither",
        )

    def _takes_play_back(self) -> bool:
        """Return whether the firmware is built with backlash compensation; asked once."""
        if self._play_back is None:
            question = MigrationQuestion(
                "build.backlash",
                "Is the firmware built with backlash compensation, which brings $160 and on (yes or no)?",
            )
            self._play_back = self.out.answer(question, self.answers, "yes|no").lower() == "yes"
        return self._play_back

    def _travel(self, axis: AxisMeaning, n: int) -> None:
        """Write and grade the travel of one axis, which the firmware counts from home."""
        low, high, home = (axis.number(c) for c in ("travel.low", "travel.high", "home.coordinate"))
        limits = axis.choice("travel.kind") == "limits" and low is not None and high is not None
        key = f"${130 + n}"
        if not limits or low is None or high is None:
            self.values[130 + n] = "0"
            for concept in ("travel.kind", "travel.low", "travel.high"):
                self.out.grade(axis, concept, "exact", key, "0: no limit")
            return
        # The firmware knows only a length from home: home outside of the travel is taken as its nearer
        # end.
        at = min(max(home or 0.0, low), high)
        minus = (axis.number("home.search") or axis.number("home.towards") or 0.0) < 0.0
        self.values[130 + n] = _thousandth(high - at if minus else at - low)
        old = f"from {low:g} to {high:g}"
        new = (
            f"{self.values[130 + n]} from home to the {'plus' if minus else 'minus'} side; what is beyond"
            " home is lost, and home is 0"
        )
        for concept in ("travel.kind", "travel.low", "travel.high"):
            self.out.grade(axis, concept, "approximate", key, self.values[130 + n], old, new, "the new one")
        self.out.measure.append(
            f"{axis.letter}: every machine coordinate (G53, G28, work offsets) moves by {-at:g}, because home"
            " is 0"
        )

    def _home(self, axis: AxisMeaning, n: int) -> None:
        """Write the rates of homing of one axis, and grade what becomes of its home position."""
        search, leave = axis.number("home.search"), axis.number("home.leave")
        if search:
            # Homing never faster than the axis may go.
            self.values[190 + n] = _thousandth(min(abs(search), axis.number("rapid") or abs(search)), 1)
            self.out.grade(axis, "home.search", "exact", f"$23, ${190 + n}", self.values[190 + n])
        self.out.grade(axis, "home.towards", "exact", "$23", "a bit")
        if leave:
            self.values[180 + n] = _thousandth(min(abs(leave), axis.number("rapid") or abs(leave)), 1)
            self.out.grade(
                axis,
                "home.leave",
                "approximate",
                f"${180 + n}",
                self.values[180 + n],
                "it leaves the switch to its marker",
                "it touches the switch again with it",
                "neither",
            )
        for concept in ("home.coordinate", "home.offset"):
            self.out.grade(
                axis,
                concept,
                "approximate",
                "$22",
                str(_HOMING),
                "home has its coordinate",
                "home is 0",
                "neither: programs with G53 are to be changed",
            )
        self.out.grade(
            axis,
            "home.kind",
            "not_possible",
            loses="the marker: home is where the switch is",
            do="a switch that repeats to the accuracy of the work",
        )
        self.out.grade(
            axis,
            "home.second",
            "not_possible",
            loses="the place of G30",
            do="go there after homing, and G30.1",
        )

    def _lost(self, axis: AxisMeaning) -> None:
        """Grade what a control without feedback has nothing for."""
        for concept, what in (
            ("error.limit", "the limit of the following error"),
            ("gain", "the position loop"),
            ("feed_forward", "feed-forward"),
            ("scale", "the feedback"),
        ):
            self.out.grade(axis, concept, "not_possible", loses=f"{what}: {_OPEN_LOOP[0]}", do=_OPEN_LOOP[1])
        self.out.grade(
            axis,
            "jerk",
            "not_possible",
            loses="the limited jerk",
            do="a build with jerk, or a lower acceleration",
        )
        self.out.grade(axis, "jog", "not_possible", loses="the jog speeds", do="set them in the sender")
        self.out.grade(
            axis,
            "rollover",
            "not_possible",
            loses="the turn of a rotary axis: positions grow on and on",
            do="programs with absolute angles are to be changed",
        )
        if axis.number("feed.ceiling") is not None:
            self.out.grade(
                axis,
                "feed.ceiling",
                "not_possible",
                loses="the ceiling of the cutting speed: F runs up to the rapid speed",
                do="look at the F words of programs",
            )
            self.out.less_safe.append(f"{axis.letter}: no ceiling of the cutting speed")

    def _spindle(self) -> None:
        """Write and grade the speeds of the spindle and the modes at the start."""
        for concept, number, choose in (("spindle.greatest", 30, max), ("spindle.least", 31, min)):
            figure = self.machine.figures.get(concept)
            listed = figure.value if figure and isinstance(figure.value, list) else []
            speeds = [float(v) for v in listed if isinstance(v, (int, float)) and v > 0.0]
            if speeds or number == 31:
                self.values[number] = _thousandth(choose(speeds, default=0.0))
                self.out.graded.append(
                    Graded(
                        "",
                        concept,
                        "approximate",
                        f"${number}",
                        self.values[number],
                        "one range for each gear",
                        "one range for all gears",
                        "the old one",
                    )
                )
        if figure := self.machine.figures.get("startup"):
            # Without an encoder at the spindle the firmware refuses G95 (error:20), and with it the whole
            # line: the modes beside it would be lost without a word.
            per_turn = "G95" in str(figure.value)
            self.startup = str(figure.value).replace("G95", "G94")
            same = "the same modes, run after a reset"
            if per_turn:
                same += ", but for G95, which needs an encoder at the spindle: programs have to name it"
                self.out.less_safe.append("after power-up a feed is for a minute, no longer for a turn (G95)")
            self.out.graded.append(
                Graded(
                    "",
                    "startup",
                    "approximate",
                    "$N0",
                    self.startup,
                    "the modes after power-up",
                    same,
                    "neither",
                )
            )


def _thousandth(value: float, decimals: int = 3) -> str:
    """Return a number with the decimals that the control shows, rounded down: never beyond, never above."""
    scale = 10**decimals
    # The 1e-6 keeps 1.001 from becoming 1, which its binary form would be rounded down to.
    return inwards_high(int(float(inwards_high(value)) * scale + 1e-6) / scale)
