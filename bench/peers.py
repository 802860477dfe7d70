"""Other ways to do the same, in the same run: what a figure is worth shows beside its neighbour."""

import json
from collections.abc import Iterator
from pathlib import Path

from measure import Measure, timed
from ruamel.yaml import YAML

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import UnitError, convert
from amp_studio.schema.model import BoundRef


def measures(full: Path, times: int) -> Iterator[Measure]:
    """Yield the peers of opening and checking a file."""
    text = full.read_text(encoding="utf-8")
    yield Measure("  peer: YAML alone, ruamel in C", timed(lambda: YAML(typ="safe").load(text), times))
    pure = timed(lambda: YAML(typ="safe", pure=True).load(text), times)
    yield Measure("  peer: YAML alone, ruamel in pure Python", pure)
    document, ranges = _as_json(open_file(full).file)
    yield Measure(
        "  peer: JSON and a loop over the ranges, no rules", timed(lambda: _loop(document, ranges), times)
    )


def _as_json(file: ParameterFile) -> tuple[str, dict[str, tuple[float, float]]]:
    """Return the numbers of a file as JSON, each in the unit of its range, and the ranges with fixed
    bounds.
    """
    entries, ranges = [], {}
    for (parameter_id, instance), value in file.values.items():
        parameter = file.schema.parameters[parameter_id]
        for unit, (low, high) in (parameter.ranges or {}).items():
            if (
                isinstance(value.value, (bool, str))
                or isinstance(low, BoundRef)
                or isinstance(high, BoundRef)
            ):
                continue
            try:
                number = convert(float(value.value), value.unit, unit)
            except UnitError:
                number = float(value.value)
            entries.append([parameter_id, instance, number])
            ranges[parameter_id] = (low if low is not None else -1e300, high if high is not None else 1e300)
            break
    return json.dumps(entries), ranges


def _loop(document: str, ranges: dict[str, tuple[float, float]]) -> list[str]:
    found = []
    for parameter_id, instance, number in json.loads(document):
        low, high = ranges[parameter_id]
        if not low <= number <= high:
            found.append(f"{parameter_id}@{instance}: {number} is outside {low} to {high}")
    return found
