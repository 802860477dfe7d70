"""How the axes of a migrated machine home: the keys of each joint, and a grade for each concept."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from amp_studio.meaning import (
    AxisMeaning,
    GradeKind,
    MigrationQuestion,
    WrittenMachine,
    inwards_high,
    inwards_low,
    not_above,
)

from .migrated_ini import MigratedIni, taken_from

NOT_HOMED = ("", "none", "coded")
_SIGNED = r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)"
_INSIDE = 0.01
"""mm or deg by which the place of home has to be inside the limits."""


@dataclass(frozen=True)
class HomeKeys:
    """Writes the homing of one joint after the other."""

    out: WrittenMachine
    ini: MigratedIni
    answers: Mapping[str, str]

    def write(self, axis: AxisMeaning, j: str, step: int | None) -> None:
        kind, search, leave = axis.choice("home.kind"), axis.number("home.search"), axis.number("home.leave")
        towards = axis.number("home.towards")
        if search is None and towards is not None and kind not in (*NOT_HOMED, "absolute"):
            search, leave = self._asked_speed(axis, towards)
        if kind == "absolute":
            self._place_lost(axis)
        else:
            self._home_place(axis, j)
        if kind in NOT_HOMED:
            self._not_homed(axis, kind)
            return
        if step is not None:
            self.ini.put(j, "HOME_SEQUENCE", str(step), "answered")
        if kind == "absolute":
            self._absolute(axis, j)
            return
        if search is not None and leave is not None:
            self._home_speeds(axis, j, search, leave, alone=kind == "marker")
        else:
            self._search_open(axis, j)
        self._index(axis, j, kind)

    def _place_lost(self, axis: AxisMeaning) -> None:
        """Grade the place of an absolute encoder."""
        for concept in ("home.coordinate", "home.offset"):
            self.out.grade(
                axis,
                concept,
                "not_possible",
                loses="the place where the old control took the position over: it kept it in its memory",
                do="measure what the encoder reports where the old control shows 0",
            )

    def _search_open(self, axis: AxisMeaning, j: str) -> None:
        """Grade the speeds of an axis as long as the question about them is open."""
        for concept in ("home.search", "home.leave", "home.towards"):
            self.out.grade(
                axis,
                concept,
                "approximate",
                f"[{j}]HOME_SEARCH_VEL",
                "left out",
                "a search of the switch",
                "no search until the question is answered",
                "neither",
            )

    def _index(self, axis: AxisMeaning, j: str, kind: str) -> None:
        """Write whether an axis homes to a marker, and grade to which."""
        index = "NO" if kind == "switch" else "YES"
        self.ini.put(j, "HOME_USE_INDEX", index, taken_from(axis, "home.kind", "approximate"))
        nearest = kind == "switch-nearest-marker"
        if nearest:
            self.out.measure.append(
                f"{axis.letter}: distance from the switch to the nearest marker; where it is behind, zero"
                " moves by one turn of the encoder"
            )
        self.out.grade(
            axis,
            "home.kind",
            "approximate" if nearest else "exact",
            f"[{j}]HOME_USE_INDEX",
            index,
            "the marker nearest to the switch, on either side" if nearest else "the next marker",
            "the next marker in the direction of the latch",
            "neither: measure the distance from the switch to the marker",
        )

    def _not_homed(self, axis: AxisMeaning, kind: str) -> None:
        """Grade the homing of an axis that LinuxCNC cannot home as the old control did."""
        loses, do = "homing as it was", "choose a way of homing at the new control"
        if kind == "coded":
            loses = "homing over distance-coded markers"
            do = "a home switch, or a card that reads the coded markers and gives the position"
        for concept in ("home.kind", "home.search", "home.leave", "home.towards"):
            self.out.grade(axis, concept, "not_possible", loses=loses, do=do)
        self.out.measure.append(
            f"{axis.letter}: how it homes; Home All leaves it out until then, and no program runs before"
            " every joint is homed"
        )

    def _absolute(self, axis: AxisMeaning, j: str) -> None:
        """Write and grade an axis whose encoder knows its position: what it reports at zero is in no file."""
        question = MigrationQuestion(
            f"home.encoder.{axis.name}",
            f"Which position does the encoder of {axis.name} report at the new card where the old control"
            f" shows 0, in {'deg' if axis.turns else 'mm'}?",
        )
        found = self.out.answer(question, self.answers, _SIGNED)
        if found:
            self.ini.put(j, "HOME_ABSOLUTE_ENCODER", "2", taken_from(axis, "home.kind", "exact"))
            # The encoder's reading and the offset add up to 0 there.
            self.ini.put(j, "HOME_OFFSET", inwards_high(0.0 - float(found)), "answered")
        self.out.grade(
            axis,
            "home.kind",
            "exact",
            f"[{j}]HOME_ABSOLUTE_ENCODER",
            "2" if found else "left out until answered",
        )
        for concept in ("home.search", "home.leave", "home.towards"):
            self.out.grade(axis, concept, "exact", f"[{j}]HOME_SEARCH_VEL", "left out: nothing moves")

    def _asked_speed(self, axis: AxisMeaning, towards: float) -> tuple[float | None, float | None]:
        """Return the speeds of search and latch that a user enters, with direction; None until then."""
        unit = "deg/min" if axis.turns else "mm/min"
        question = MigrationQuestion(
            f"home.speed.{axis.name}",
            f"With which speed does {axis.name} search its switch, in {unit}? The PLC of the old control"
            " set it.",
        )
        speed = self.out.number(question, self.answers)
        return (speed * towards, -speed * towards / 10.0) if speed else (None, None)

    def _home_place(self, axis: AxisMeaning, j: str) -> None:
        """Write where a joint is after homing, and where its switch or marker is."""
        at, offset = axis.number("home.coordinate"), axis.number("home.offset")
        if at is None:
            return
        low, high = (
            axis.number(c) if axis.choice("travel.kind") == "limits" else None
            for c in ("travel.low", "travel.high")
        )
        # The final move of homing ends within a micrometre of HOME, and beyond a limit by any amount is an
        # error that ends the homing of the other joints (C1507; seen with 2.9.0~pre1).
        room = _INSIDE if low is None or high is None or high - low > 2.0 * _INSIDE else 0.0
        least, most = at if low is None else low + room, at if high is None else high - room
        within = min(max(at, least), most)
        outcome: GradeKind = "exact" if within == at else "approximate"
        # Rounded into the travel: a last decimal outward would be an error at every homing.
        text = inwards_low(within) if within == least else inwards_high(within)
        self.ini.put(j, "HOME", text, taken_from(axis, "home.coordinate", outcome))
        self.out.grade(
            axis,
            "home.coordinate",
            outcome,
            f"[{j}]HOME",
            text,
            f"it stays at {at:g}, at its limit or beyond",
            f"it goes on to {_INSIDE:g} inside the limit, where the homing is no error",
            "the new one",
        )
        self.ini.put(
            j,
            "HOME_OFFSET",
            inwards_high(at if offset is None else offset),
            taken_from(axis, "home.offset", "exact"),
        )
        self.out.grade(
            axis, "home.offset", "exact", f"[{j}]HOME_OFFSET", inwards_high(at if offset is None else offset)
        )

    def _home_speeds(self, axis: AxisMeaning, j: str, search: float, leave: float, *, alone: bool) -> None:
        """Write the speeds of search, latch and final move, at most the rapid speed."""
        rapid = axis.number("rapid") or abs(search)
        # Without a switch there is no search: the latch goes to the marker.
        first = 0.0 if alone else math.copysign(min(abs(search), rapid), search)
        latch = search if alone else leave
        slow = math.copysign(min(abs(latch), rapid), latch)
        opposite = alone or search * leave < 0.0
        self.ini.put(j, "HOME_SEARCH_VEL", not_above(first / 60.0), taken_from(axis, "home.search", "exact"))
        self.ini.put(
            j,
            "HOME_LATCH_VEL",
            not_above(slow / 60.0),
            taken_from(axis, "home.leave", "exact" if opposite else "approximate"),
        )
        self.ini.put(j, "HOME_FINAL_VEL", not_above(abs(slow) / 60.0))
        limited = abs(search) > rapid
        self.out.grade(
            axis,
            "home.search",
            "approximate" if limited else "exact",
            f"[{j}]HOME_SEARCH_VEL",
            not_above(first / 60.0),
            "it searches faster than the rapid speed",
            "with the rapid speed",
            "the new one",
        )
        self.out.grade(axis, "home.towards", "exact", f"[{j}]HOME_SEARCH_VEL", not_above(first / 60.0))
        self.out.grade(
            axis,
            "home.leave",
            "exact" if opposite else "approximate",
            f"[{j}]HOME_LATCH_VEL",
            not_above(slow / 60.0),
            "it runs on through the switch",
            "it backs off, and comes again in the same direction",
            "the new one needs room before the switch",
        )
