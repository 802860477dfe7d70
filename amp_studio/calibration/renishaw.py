"""The text file of a Renishaw laser (.rtl), as programs that read it show it;
the maker publishes no description.

Sections end with ``::``. ``Targets :`` is followed by the target positions, ``Run Target Data:`` by a line
for each point: run, target, deviation. Target positions are in mm and deviations in µm by those programs, for
linear measurements; for any other kind the units are asked.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction

from .errors import MeasurementError
from .raw import RawRun, RawTable

_SECTION = re.compile(r"([A-Z][A-Z0-9\- ]*)::")
_ENTRY = re.compile(r"([A-Za-z][\w \-]{0,40}?)\s*:\s*(.*)")
_POINT = re.compile(r"([0-9]{1,6})\s+([0-9]{1,6})\s+([+-]?[0-9]{1,12}(?:\.[0-9]{1,12})?)")
_TARGET = re.compile(r"[+-]?[0-9]{1,12}(?:\.[0-9]{1,12})?")


def recognises(text: str) -> bool:
    """Return whether a text is such a file."""
    return "TARGET DATA::" in text and "DEVIATIONS::" in text


def read(text: str, usual_unit: str) -> RawTable:
    """Return the runs of a file; raises MeasurementError."""
    targets: list[Fraction] = []
    runs: dict[int, dict[int, Fraction]] = {}
    facts: dict[str, str] = {}
    for n, section, entry, words in _lines(text):
        if section is None:
            facts[entry] = words
        if entry == "targets" and section in (None, "TARGET DATA"):
            targets += _targets(words, n)
        elif (section, entry) == ("DEVIATIONS", "run target data"):
            _add_point(runs, len(targets), words, n)
    _check_counts(facts, len(targets), len(runs))
    linear = facts.get("filetype", "linear").casefold().startswith("linear") and usual_unit == "mm"
    note = "read as a Renishaw file: target positions in mm, deviations in µm"
    units, notes = (("mm", "um"), (note,)) if linear else (("", ""), ())
    return RawTable(
        tuple(
            # The file names no direction: the order of its targets gives it.
            RawRun(None, tuple((targets[target - 1], by) for target, by in points.items()))
            for _, points in sorted(runs.items())
        ),
        "error",
        *units,
        notes,
    )


def _lines(text: str) -> Iterator[tuple[int, str | None, str, str]]:
    """Yield number, section, entry and words of each line below an entry;
    of the words behind its colon the same, without a section.
    """
    section = entry = ""
    for n, line in enumerate(text.splitlines(), 1):
        words = line.strip()
        if match := _SECTION.fullmatch(words):
            section, entry = match[1], ""
        elif match := _ENTRY.fullmatch(words):
            entry = match[1].casefold()
            yield n, None, entry, match[2]
        elif words:
            yield n, section, entry, words


def _add_point(runs: dict[int, dict[int, Fraction]], targets: int, words: str, n: int) -> None:
    run, target, deviation = _point(words, n)
    if target > targets:
        raise MeasurementError(f"there is no target {target}", n)
    if target in runs.setdefault(run, {}):
        raise MeasurementError(f"run {run} has target {target} twice", n)
    runs[run][target] = deviation


def _targets(words: str, n: int) -> list[Fraction]:
    for word in words.split():
        if not _TARGET.fullmatch(word):
            raise MeasurementError(f"'{word[:40]}' is no target position", n)
    return [Fraction(word) for word in words.split()]


def _point(words: str, n: int) -> tuple[int, int, Fraction]:
    match = _POINT.fullmatch(words)
    if match is None or int(match[2]) < 1:
        raise MeasurementError(f"'{words[:40]}' is not run, target and deviation", n)
    return int(match[1]), int(match[2]), Fraction(match[3])


def _check_counts(facts: dict[str, str], targets: int, runs: int) -> None:
    """Notice a file that was cut off: it names how many targets and runs it has."""
    for key, found in (("target-count", targets), ("run-count", runs)):
        # Nine digits are enough for any count, and keep int() short on a damaged file.
        if key in facts and facts[key].isdecimal() and int(facts[key][:9]) != found:
            raise MeasurementError(f"the file names {facts[key][:9]} as its {key} and contains {found}")
    if not runs:
        raise MeasurementError("the file contains no run")
