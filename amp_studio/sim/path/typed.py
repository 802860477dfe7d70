"""What a person types for a program: places of axes, and other values of parameters."""

from __future__ import annotations

import re
from collections.abc import Sequence

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, InvalidValueError, UnknownParameterError, Value, quoted
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.unit_system import MM_PER_INCH, length_unit, path_error_unit
from amp_studio.validate import read_plain

from .job import scaled

_PLACE = re.compile(r"([A-Z])([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+))")
_STEPS = re.compile(
    r"([+-]?[0-9]+(?:\.[0-9]+)?)(%)? ?: ?([+-]?[0-9]+(?:\.[0-9]+)?)(%)?(?: ?: ?([0-9]{1,4}))?"
)
MAX_STEPS = 100
_ERROR = re.compile(r"([0-9]+\.?[0-9]*|\.[0-9]+) ?(um|mm|in)?")
_SHARE = re.compile(r"([+-][0-9]+(?:\.[0-9]+)?) ?%")


def typed_places(text: str, file: ParameterFile) -> dict[str, float]:
    """Return axis letter -> place in mm or deg of ``X10,Y-20`` in the unit of the file; raises
    SimulationError.
    """
    size = MM_PER_INCH if length_unit(file) == "in" else 1.0
    found: dict[str, float] = {}
    for part in text.upper().split(","):
        word = _PLACE.fullmatch(part.strip())
        if word is None or word[1] in found:
            raise SimulationError(f"{quoted(text)} has to be places of axes, as X10,Y-20")
        found[word[1]] = float(word[2]) * size
    return found


def typed_error(text: str, file: ParameterFile) -> float:
    """Return an error of a path in mm: a number in the unit in which one is shown, or with a unit. Raises
    SimulationError.
    """
    word = _ERROR.fullmatch(text.strip().replace(",", ".").replace("\u00b5", "u").replace("\u03bc", "u"))
    if word is None or float(word[1]) <= 0.0:
        raise SimulationError(f"{quoted(text)} has to be an error above 0, as 30 or 0.03 mm")
    _, per_mm = path_error_unit(length_unit(file))
    return float(word[1]) * {"um": 1e-3, "mm": 1.0, "in": MM_PER_INCH, None: 1.0 / per_mm}[word[2]]


def typed_values(file: ParameterFile, texts: Sequence[str]) -> dict[Address, Value]:
    """Return the values of ``PARAM=VALUE`` and ``PARAM=+20%``; raises SimulationError."""
    found: dict[Address, Value] = {}
    for text in texts:
        param, sign, wanted = text.partition("=")
        if not sign or not param.strip() or not wanted.strip():
            raise SimulationError(f"{quoted(text)} is not PARAM=VALUE")
        try:
            address = file.find(param.strip())
            present = file.get(address)
            share = _SHARE.fullmatch(wanted.strip())
            # For a value that is a percentage itself, +20% is that value, not a share of it.
            if share is not None and (present is None or present.unit != "%"):
                found[address] = scaled(file, address, 1.0 + float(share[1]) / 100.0)
            else:
                found[address] = read_plain(file, address, wanted.strip(), lambda at: _unit(file, at))
        except (InvalidValueError, UnknownParameterError) as error:
            raise SimulationError(f"{error}") from None
    return found


def typed_steps(file: ParameterFile, text: str) -> list[dict[Address, Value]]:
    """Return the values of ``PARAM=FROM:TO:STEPS``, ends included; without steps there are five.

    FROM and TO are numbers, or both shares as -20%. Raises SimulationError.
    """
    param, _, wanted = text.partition("=")
    match = _STEPS.fullmatch(wanted.strip())
    if match is None or bool(match[2]) != bool(match[4]):
        raise SimulationError(
            f"{quoted(text)} is not PARAM=FROM:TO:STEPS, as 1210=200:800:4 or 1210=-20%:+20%"
        )
    first, last, count = float(match[1]), float(match[3]), int(match[5] or 5)
    if not 2 <= count <= MAX_STEPS:
        raise SimulationError(f"{quoted(text)} has {count} steps; it takes 2 to {MAX_STEPS}")
    steps = [first + (last - first) * n / (count - 1) for n in range(count)]
    # `_SHARE` knows a share by its sign.
    sign = "+" if match[2] else ""
    return [typed_values(file, [f"{param}={each:{sign}.9g}{'%' if match[2] else ''}"]) for each in steps]


def _unit(file: ParameterFile, address: Address) -> str:
    """Return the unit of a number without one: that of the present value, else the file's."""
    present = file.get(address)
    return present.unit if present and present.unit else file.evaluation.unit(address, file.header.units)
