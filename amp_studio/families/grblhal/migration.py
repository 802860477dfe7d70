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

_LETTERS, _TURNING, _FIRST_TURNING = "XYZABCUV", "ABC", 3
_HOMING = 1 | 4 | 8 | 512
"""$22: on, needed at the start, home is zero, rates of each axis."""
_WITHOUT_SWITCH = {
    "marker": "homing to a marker without a switch",
    "coded": "homing over distance-coded markers",
    "absolute": "the position that is known without homing",
}
"""Way of homing -> what is lost; none of them is there, as only a switch ends a search (machine_limits.c)."""
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
        for question in self.machine.questions:
            if question.is_number:
                self.out.number(question, self.answers)
        places = [
            (axis, _LETTERS.index(letter)) for axis in self.machine.axes if (letter := self._letter(axis))
        ]
        self._homing(places)
        for axis, place in places:
            self._axis(axis, place)
        self._spindle()
        for concept in ("tool.radius", "tool.wear"):
            self.out.graded.append(
                Graded(
                    "",
                    concept,
                    "not_possible",
                    loses="the radii of tools: there is no cutter compensation",
                    do="let the CAM system compensate",
                )
            )
        # $22 first: soft limits are refused without it (error:10), and the rates of each axis are there with
        # its bit 9 alone (error:53).
        order = sorted(self.values, key=lambda n: (n != 22, n))
        name = re.sub(r"[^A-Za-z0-9_-]+", "_", self.machine.name).strip("_") or "machine"
        lines = [f"; {self.machine.name or name}, migrated: send from the first line to the last"]
        self.out.texts[f"{name}.settings"] = "\n".join(
            (*lines, *(f"${n}={self.values[n]}" for n in order), f"$N0={self.startup}", "")
        )
        # First: of all that is lost this is the most dangerous.
        self.out.less_safe.insert(0, "no axis is measured: a lost step or a blocked axis is not noticed")
        return self.out

    def _letter(self, axis: AxisMeaning) -> str:
        """Return the letter of an axis; asked for where it has none of its kind, "" while that is open."""
        alike = [x for x in _LETTERS if (x in _TURNING) == axis.turns]
        return self.out.letter(axis, self.machine.axes, alike, self.answers)

    def _homing(self, places: list[tuple[AxisMeaning, int]]) -> None:
        """Write what is for all axes that home: direction, order, and how far off the switch."""
        homed = [(axis, place) for axis, place in places if _is_homed(axis)]
        if not homed:
            self.out.less_safe.append("no axis is homed, and so there are no soft limits")
            return
        # With $40 a jog ends at the limit; without it the firmware refuses the jog, and all after it.
        self.values |= {22: str(_HOMING), 20: "1", 40: "1"}
        minus = sum(1 << place for axis, place in homed if _homes_to_minus(axis))
        self.values[23] = str(minus)
        steps = self.out.home_steps([_LETTERS[place] for _, place in homed], self.answers)
        # $44 to $49: the firmware has six phases.
        for at, step in enumerate(steps[:6]):
            self.values[44 + at] = str(
                sum(1 << _LETTERS.index(letter) for letter in step if letter in _LETTERS)
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
            "a bit" if axis.turns else _LETTERS[n],
            "an axis that turns, with its range",
            "degrees are counted on and on",
            "neither",
        )
        if axis.turns:
            self.values[376] = str(int(self.values.get(376, "0")) | 1 << n - _FIRST_TURNING)
        question = MigrationQuestion(
            f"steps.{axis.name}",
            f"How many steps make 1 {'degree' if axis.turns else 'mm'} of {axis.name} at the new motor"
            f" (${100 + n})?",
        )
        if number := self.out.number(question, self.answers):
            self.values[100 + n] = not_above(number)
        if rapid := axis.number("rapid"):
            self.values[110 + n] = _thousandth(rapid)
            self.out.grade(axis, "rapid", "exact", f"${110 + n}", self.values[110 + n])
        else:
            self.out.less_safe.append(f"{axis.letter}: no rapid speed is known; the firmware has its own")
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
        """Write and grade the travel of one axis, which the firmware counts from home. It checks an axis that
        is homed and has a travel above 0, and no other (settings.c, machine_limits.c).
        """
        kind, key, concepts = (
            axis.choice("travel.kind"),
            f"${130 + n}",
            ("travel.kind", "travel.low", "travel.high"),
        )
        if kind in ("none", "modulo") and (axis.turns or not _is_homed(axis)):
            self.values[130 + n] = "0"
            for concept in concepts:
                self.out.grade(axis, concept, "exact", key, "0: no limit")
            if not axis.turns:
                self.out.less_safe.append(f"{axis.letter}: no travel limits, as before")
        elif not _is_homed(axis):
            for concept in concepts:
                self.out.grade(
                    axis,
                    concept,
                    "not_possible",
                    loses="the travel limits: the firmware checks only axes that are homed",
                    do="fit a home switch, and limit switches ($21)",
                )
            self.out.less_safe.append(
                f"{axis.letter}: no travel limits, as the firmware checks only axes that are homed"
            )
        elif way := _way_from_home(axis) or self._asked_way(axis, n):
            self._limited(axis, n, way)

    def _asked_way(self, axis: AxisMeaning, n: int) -> str:
        """Return the way that only a person knows, "" while that is open. With 0 the firmware has no limit,
        and homes an axis that goes straight without moving it.
        """
        sources = [
            source
            for concept in ("travel.kind", "travel.low", "travel.high")
            if concept in axis.figures
            for source in axis.figures[concept].sources
        ]
        question = MigrationQuestion(
            f"travel.{axis.name}",
            f"How far may {axis.name} go from where it is after homing, in {'deg' if axis.turns else 'mm'}"
            f" (${130 + n})? The old file does not say, and with 0 there is no limit.",
            tuple(dict.fromkeys(sources)),
        )
        number = self.out.number(question, self.answers)
        return _thousandth(number) if number else ""

    def _limited(self, axis: AxisMeaning, n: int, way: str) -> None:
        """Write the travel of an axis, which has only a length here, and what of its place is lost."""
        self.values[130 + n] = way
        low, high = axis.number("travel.low"), axis.number("travel.high")
        old = (
            f"from {low:g} to {high:g}"
            if low is not None and high is not None
            else "no limit at one end or both"
        )
        new = (
            f"{way} from home to the {'plus' if _homes_to_minus(axis) else 'minus'} side; what is beyond"
            " home is lost, and home is 0"
        )
        for concept in ("travel.kind", "travel.low", "travel.high"):
            self.out.grade(axis, concept, "approximate", f"${130 + n}", way, old, new, "the new one")
        if (at := axis.number("home.coordinate")) != 0.0:
            moves = "is to be found again" if at is None else f"moves by {-at:g}"
            self.out.measure.append(
                f"{axis.letter}: every machine coordinate (G53, G28, work offsets) {moves}, because home is 0"
            )

    def _home(self, axis: AxisMeaning, n: int) -> None:
        """Write the rates of homing of one axis, and grade what becomes of its home position."""
        if not _is_homed(axis):
            self._not_homed(axis)
            return
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
        if axis.choice("home.kind") == "switch":
            self.out.grade(
                axis,
                "home.kind",
                "approximate",
                "$22",
                str(_HOMING),
                "home is at the switch",
                "home is off the switch by $27",
                "neither",
            )
        else:
            self.out.grade(
                axis,
                "home.kind",
                "not_possible",
                loses="the marker: home is where the switch is",
                do="a switch that repeats to the accuracy of the work",
            )
        self._places(axis)

    def _places(self, axis: AxisMeaning) -> None:
        """Grade the places of an axis that are no settings."""
        for concept, loses, do in (
            ("home.first", "the place of G28", "go there after homing, and G28.1"),
            ("home.second", "the place of G30", "go there after homing, and G30.1"),
            ("work.offsets", "the work offsets", "G10 L2 P1 and on, each less the old coordinate of home"),
        ):
            self.out.grade(axis, concept, "not_possible", loses=loses, do=do)

    def _not_homed(self, axis: AxisMeaning) -> None:
        """Grade the homing of an axis that has no home switch, or whose homing is not known."""
        for concept in axis.figures:
            if concept.startswith("home.") and concept not in ("home.first", "home.second"):
                self.out.grade(
                    axis,
                    concept,
                    "not_possible",
                    loses=_WITHOUT_SWITCH.get(axis.choice("home.kind"), "homing as it was"),
                    do="fit a home switch, and set $22, $23 and $44",
                )
        self._places(axis)

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


def _is_homed(axis: AxisMeaning) -> bool:
    """Return whether the firmware can home an axis: in a known direction, to a switch."""
    return axis.choice("home.kind") not in (*_WITHOUT_SWITCH, "none") and bool(
        axis.number("home.search") or axis.number("home.towards")
    )


def _homes_to_minus(axis: AxisMeaning) -> bool:
    return (axis.number("home.search") or axis.number("home.towards") or 0.0) < 0.0


def _way_from_home(axis: AxisMeaning) -> str:
    """Return the length from home to the other end, "" where the old file does not say it or it is 0."""
    low, high, home = (axis.number(c) for c in ("travel.low", "travel.high", "home.coordinate"))
    far, near = (high, low) if _homes_to_minus(axis) else (low, high)
    if axis.choice("travel.kind") != "limits" or far is None or home is None:
        return ""
    # The firmware knows only a length from home: home outside of the travel is taken as its nearer end.
    ends = (far, home if near is None else near)
    way = _thousandth(abs(far - min(max(home, min(ends)), max(ends))))
    return "" if way == "0" else way


def _thousandth(value: float, decimals: int = 3) -> str:
    """Return a number with the decimals that the control shows, rounded down: never beyond, never above."""
    scale = 10**decimals
    # The 1e-6 keeps 1.001 from becoming 1, which its binary form would be rounded down to.
    return inwards_high(int(float(inwards_high(value)) * scale + 1e-6) / scale)
