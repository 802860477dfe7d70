"""The record of tunings: one line of JSON for each, appended to ``tunings.jsonl`` in the folder of the file.

Nothing is ever taken out of it: a gain that was changed again since is a later line.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from math import isfinite
from pathlib import Path

from amp_studio.files import (
    TUNINGS,
    ParameterFile,
    SaveError,
    append_line,
    now,
    real_path,
    text_of_name,
    user,
)
from amp_studio.schema import UnknownParameterError, read_file
from amp_studio.sim.rounding import value_text
from amp_studio.sim.trace import Trace

from .trial import address_of, named_parameter

_BEFORE, _ASSUMED = "_before", "ASSUMED: "
_LONGEST = 300


@dataclass(frozen=True)
class RecordedTuning:
    """The gains of one axis before and after, with what the loop had and what the machine was taken for.

    ``when``     UTC; ``who``: name of the user; ``file``: the name of the parameter file
    ``axis``     number and letter; ``aim``: quiet, normal, stiff, contour
    ``gains``    (parameter as it is typed, name, before, after), values with their units
    ``figures``  (name, before, after, unit): Ms, margins, bandwidth, stiffness; None for an unstable loop
    ``plant``    (figure, value, how it is known: assumed and why, or the file that identify wrote)
    """

    when: str
    who: str
    file: str
    axis: str
    aim: str
    gains: tuple[tuple[str, str, str, str], ...]
    figures: tuple[tuple[str, float | None, float | None, str], ...]
    plant: tuple[tuple[str, str, str], ...]
    note: str = ""


def recorded_tuning(
    file: ParameterFile,
    beside: Path,
    trace: Trace,
    aim: str,
    machine: Sequence[tuple[str, str, str]] = (),
    note: str = "",
) -> RecordedTuning:
    """Return what ``tune`` found for a file as it was before, at this moment and by this user.

    ``machine`` is what was given of the machine: figure, value, and where it is from.
    """
    gains = []
    for each in trace.recommendations:
        address = address_of(file, each.parameter, trace.axis)
        present, known = file.get(address) if address else None, file.schema.parameters.get(each.parameter)
        gains.append(
            (
                named_parameter(file, each.parameter, trace.axis),
                known.name if known else each.parameter,
                "" if present is None else value_text(float(present.value), present.unit, 9),
                value_text(each.value, each.unit, 9),
            )
        )
    figures = tuple(
        (name, trace.result[f"{name}{_BEFORE}"][0], value, unit)
        for name, (value, unit) in trace.result.items()
        if f"{name}{_BEFORE}" in trace.result
    )
    given = {name for name, _, _ in machine}
    texts = (
        text.removeprefix(_ASSUMED) for text in trace.assumptions if text.startswith(f"{_ASSUMED}model.")
    )
    assumed = [
        (name, value, f"assumed: {why}")
        for name, value, why in (_parted(text) for text in texts)
        if name not in given
    ]
    place = text_of_name(real_path(beside).name)
    plant = (*machine, *assumed)
    return RecordedTuning(
        now(), user(), place, trace.axis_title, aim, tuple(gains), figures, plant, note[:_LONGEST]
    )


def value_at(file: ParameterFile, number: str) -> str:
    """Return the present value of a parameter by the name that a record has for it, as the record writes it;
    empty where there is none.
    """
    try:
        present = file.get(file.find(number))
    except UnknownParameterError:
        return ""
    return "" if present is None else value_text(float(present.value), present.unit, 9)


def _parted(text: str) -> tuple[str, str, str]:
    """Return figure, value and reason of an assumption, ``model.delay = 1.5 ms. Computing …``."""
    name, _, rest = text.partition(" = ")
    value, _, why = rest.partition(". ")
    return name, value.rstrip("."), why


def add_tuning(beside: Path, tuning: RecordedTuning) -> None:
    """Append a tuning to the record in the folder of a file; raises SaveError."""
    line = json.dumps(asdict(tuning), ensure_ascii=True) + "\n"
    try:
        place = real_path(beside).parent / TUNINGS
        append_line(place, line.encode(), like=place.parent)
    except OSError as error:
        why = error.strerror or error
        raise SaveError(f"the tuning could not be recorded in {TUNINGS}: {why}") from error


def read_tunings(beside: Path) -> list[RecordedTuning]:
    """Return the tunings of a file, oldest first; a line that is none is left out, and stays where it is.

    Raises OSError where there is a record that cannot be read.
    """
    real = real_path(beside)
    try:
        content = read_file(real.parent / TUNINGS, follow=False, tail=True)
    except FileNotFoundError:
        return []
    name = text_of_name(real.name)
    found = (_tuning(line) for line in content.decode("utf-8", "replace").split("\n"))
    return [each for each in found if each is not None and each.file == name]


def _tuning(line: str) -> RecordedTuning | None:
    """Return the tuning of a line; None for what this program has not written so."""
    try:
        entry = json.loads(line)
        texts = {name: entry[name] for name in ("when", "who", "file", "axis", "aim", "note")}
        gains = tuple((str(a), str(b), str(c), str(d)) for a, b, c, d in entry["gains"])
        figures = tuple((str(n), _number(a), _number(b), str(u)) for n, a, b, u in entry["figures"])
        plant = tuple((str(a), str(b), str(c)) for a, b, c in entry["plant"])
        if not all(isinstance(text, str) for text in texts.values()):
            return None
        return RecordedTuning(**texts, gains=gains, figures=figures, plant=plant)
    except (ValueError, TypeError, LookupError, RecursionError, OverflowError):
        return None


def _number(value: object) -> float | None:
    if value is None:
        return None
    if isinstance(value, (int, float)) and not isinstance(value, bool) and isfinite(value):
        return float(value)
    raise ValueError("a figure is a finite number or none")
