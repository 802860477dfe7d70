"""The entries of a file of a builder's rules as models,
and what is wrong with their keys and texts in plain words.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sized
from typing import Any, TypeVar

from amp_studio.schema import Model, ModelError, Slip

T = TypeVar("T", bound=Model)

_MAX_LENGTHS = {
    "id": 100,
    "title": 200,
    "message": 2000,
    "page": 200,
    "family": 50,
    "reads": 100,
    "optional": 100,
    "any_state": 100,
    "values": 50,
    "units": 50,
    "fix": 20,
    "effective": 20,
    "blames": 100,
    "compares": 100,
    "rule": 100,
    "params": 1000,
    "reason": 2000,
    "by": 200,
}
"""Characters of a text, items of a list."""
_NEUTRAL = {"id": "a.a", "title": "", "severity": "error", "check": "true", "message": ""}
"""What is in the place of a key that cannot be used, while the others are checked."""


def entry_model(data: Any, model: type[T]) -> tuple[T | None, list[Slip]]:
    """Return an entry and what is wrong with it.

    With slips it is what is left of the entry, only for finding more of them; None where nothing is.
    """
    if not isinstance(data, dict):
        return None, [((), "must be a mapping: lines of a key, a colon and what it is")]
    slips: list[Slip] = [
        ((key,), f"is too long: {len(data[key]):,}, and {most:,} are the most")
        for key, most in _MAX_LENGTHS.items()
        if isinstance(data.get(key), Sized) and len(data[key]) > most
    ]
    long = _heads(slips)
    data = {key: value for key, value in data.items() if key not in long}
    from amp_studio.schema import read_model  # most files have no rules beside them, and need no pydantic

    try:
        return read_model(model, data), slips
    except ModelError as error:
        slips += [slip for slip in error.slips if long.isdisjoint(slip[0][:1])]
        return _left(data, _heads(error.slips), model), slips


def _heads(slips: Iterable[Slip]) -> set[str | int]:
    """Return the keys of the entry in which something is wrong."""
    return {place[0] for place, _ in slips if place}


def _left(data: Mapping[Any, Any], wrong: set[Any], model: type[T]) -> T | None:
    """Return the entry without what cannot be used, to find more slips in it; None where there are none."""
    if "reads" in wrong:
        return None  # every name would be an unknown one
    neutral: dict[str, Any] = {key: value for key, value in _NEUTRAL.items() if key in model.fields}
    if "values" in wrong and isinstance(data.get("values"), dict):
        neutral["values"] = {str(name): "null" for name in data["values"]}  # the message may show them
    try:
        return model.model_validate(neutral | {key: value for key, value in data.items() if key not in wrong})
    except ValueError:
        return None
