"""The entries of a file of a builder's rules as models, and what is wrong with their keys and texts in plain words."""

from __future__ import annotations

from collections.abc import Mapping, Sized
from typing import Any, TypeVar

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from amp_studio.schema.model import Model
from amp_studio.schema.yaml_reader import KeyPath

from .expression_tree import shown
from .nearest import did_you_mean

T = TypeVar("T", bound=Model)
Slip = tuple[KeyPath, str]
"""Where in an entry something is wrong, and what."""

MOST = {
    "id": 100, "title": 200, "message": 2000, "page": 200, "family": 50, "reads": 100, "optional": 100, "any_state": 100,
    "values": 50, "units": 50, "fix": 20, "effective": 20, "blames": 100, "compares": 100, "rule": 100, "params": 1000, "reason": 2000, "by": 200,
}  # fmt: skip
"""Characters of a text, items of a list."""
_NEUTRAL = {"id": "a.a", "title": "", "severity": "error", "check": "true", "message": ""}
"""What stands for a key that cannot be used, while the others are looked at."""


def entry_model(data: Any, model: type[T]) -> tuple[T | None, list[Slip]]:
    """Return an entry and what is wrong with it.

    With slips it is what is left of the entry, only for finding more of them; None where nothing is.
    """
    if not isinstance(data, dict):
        return None, [((), "must be a mapping: lines of a key, a colon and what it is")]
    slips: list[Slip] = [
        ((key,), f"is too long: {len(data[key]):,}, and {most:,} are the most")
        for key, most in MOST.items()
        if isinstance(data.get(key), Sized) and len(data[key]) > most
    ]
    long = {place[0] for place, _ in slips}
    data = {key: value for key, value in data.items() if key not in long}
    try:
        found = model.model_validate(data)
    except ValidationError as error:
        wrong = error.errors(include_url=False)
        slips += [slip for slip in _slips(wrong, model) if not slip[0] or slip[0][0] not in long]
        return _left(data, {e["loc"][0] for e in wrong if e["loc"]}, model), slips
    return found, slips


def _left(data: Mapping[Any, Any], wrong: set[Any], model: type[T]) -> T | None:
    if "reads" in wrong:
        return None  # every name would be an unknown one
    neutral: dict[str, Any] = {key: value for key, value in _NEUTRAL.items() if key in model.model_fields}
    if "values" in wrong and isinstance(data.get("values"), dict):
        neutral["values"] = {str(name): "null" for name in data["values"]}  # the message may show them
    try:
        return model.model_validate(neutral | {key: value for key, value in data.items() if key not in wrong})
    except ValidationError:
        return None


def _slips(wrong: list[ErrorDetails], model: type[Model]) -> list[Slip]:
    """Return errors in plain words; a key that is mistyped is not missing as well."""
    missing = [str(e["loc"][0]) for e in wrong if e["type"] == "missing" and len(e["loc"]) == 1]
    meant: set[str] = set()
    found: list[Slip] = []
    for error in wrong:
        place: KeyPath = error["loc"]
        if error["type"] == "extra_forbidden" and len(place) == 1:
            known = missing if did_you_mean(str(place[0]), missing) else list(model.model_fields)
            meant |= {key for key in missing if did_you_mean(str(place[0]), [key])}
            found.append((place, f"there is no such key{did_you_mean(str(place[0]), known)}"))
        elif error["type"] != "missing":
            found.append((place, _plain(error)))
    return found + [
        (tuple(e["loc"]), "is missing") for e in wrong if e["type"] == "missing" and e["loc"][-1] not in meant
    ]


def _plain(error: ErrorDetails) -> str:
    """Return what is wrong with a value."""
    given = error["input"]
    match error["type"]:
        case "literal_error":
            known = ["error", "warning", "advice"] if error["loc"] == ("severity",) else []
            near = did_you_mean(given, known) if isinstance(given, str) else ""
            return f"{shown(str(given))} is not {error.get('ctx', {}).get('expected', 'known')}{near}"
        case "string_type":
            return "is empty" if given is None else f"must be a text: put {shown(str(given))} in quotes"
        case "string_pattern_mismatch":
            return f"{shown(str(given))} is no id: small letters and digits with a point between, like works.lathe-rapid"
        case "string_too_short":
            return "is empty"
        case "bool_type" | "bool_parsing":
            return "must be true or false"
        case "dict_type" | "model_type" | "model_attributes_type":
            return "must be names with what they are: {name: ...}"
        case "tuple_type" | "list_type":
            return "must be a list: [...]"
        case "extra_forbidden":
            return "there is no such key"
        case _:
            return error["msg"].removeprefix("Value error, ")
