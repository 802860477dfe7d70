"""What is wrong with data that do not fit a model, in plain words:
the one place where pydantic's errors become sentences.
"""

from __future__ import annotations

from collections.abc import Iterable
from types import UnionType
from typing import Annotated, Any, TypeVar, Union, get_args, get_origin, get_type_hints

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from .file_error import ModelError, Slip
from .model.record import PAGE_PATTERN, Model
from .nearest import did_you_mean
from .quoting import quoted
from .yaml_reader import KeyPath

_LONGEST = 500
"""Characters of a sentence; a value that it repeats may be of any length."""

T = TypeVar("T", bound=Model)


def read_model(kind: type[T], data: Any, family: object = None) -> T:
    """Return data from outside as a record; raises ModelError. Names of lists mean those of the family."""
    try:
        return kind.model_validate(data, family)
    except ValidationError as error:
        raise ModelError(_slips(error, data, kind)) from None


def _slips(error: ValidationError, data: object, model: type[Model]) -> list[Slip]:
    """Return what is wrong; a key that is mistyped is not missing as well."""
    wrong = error.errors(include_url=False)
    missing = [each["loc"] for each in wrong if each["type"] == "missing"]
    slips: dict[KeyPath, str] = {}
    supposed: set[KeyPath] = set()
    for each in wrong:
        place = each["loc"]
        if each["type"] == "unexpected_keyword_argument":
            record, key = place[:-1], str(place[-1])
            # ``naem`` beside a missing ``name`` is one slip, not two.
            lacking = [str(at[-1]) for at in missing if at[:-1] == record]
            supposed |= {(*record, name) for name in lacking if did_you_mean(key, [name])}
            known = lacking if did_you_mean(key, lacking) else list(_keys_at(model, record))
            slips.setdefault(place, f"there is no such key{did_you_mean(key, known)}")
        elif each["type"] != "missing":
            slips.setdefault(_in_data(place, data), _sentence(each))
    slips |= {at: "is missing" for at in missing if at not in supposed}
    return [(place, " ".join(what.split())[:_LONGEST]) for place, what in slips.items()]


def _keys_at(kind: Any, place: KeyPath) -> Iterable[str]:
    """Return the keys of the record at a place of what a type describes."""
    origin, inner = get_origin(kind), get_args(kind)
    if origin is Annotated:
        return _keys_at(inner[0], place)
    if origin in (Union, UnionType):
        return [key for one in inner for key in _keys_at(one, place)]
    if isinstance(kind, type) and issubclass(kind, Model):
        if not place:
            return kind.fields
        field = get_type_hints(kind).get(str(place[0])) if str(place[0]) in kind.fields else None
        return _keys_at(field, place[1:]) if field else ()
    if origin in (tuple, dict) and place:
        return _keys_at(inner[0 if origin is tuple else 1], place[1:])
    return ()


def _in_data(place: KeyPath, data: Any) -> KeyPath:
    """Return the place without what pydantic adds to it: which of several types it has tried."""
    # pydantic puts the names of types it has tried into the path; the data know no such step.
    for n, step in enumerate(place):
        try:
            data = data[step]
        except (LookupError, TypeError):
            return place[:n]
    return place


def _sentence(error: ErrorDetails) -> str:
    """Return what is wrong with a value."""
    given, details = error["input"], error.get("ctx", {})
    match error["type"]:
        case "literal_error":
            known = [word.strip("'") for word in details["expected"].replace(" or ", ", ").split(", ")]
            near = did_you_mean(given, known) if isinstance(given, str) else ""
            return f"{quoted(str(given))} is not {details['expected']}{near}"
        case "string_type":
            return "is empty" if given is None else f"must be a text: put {quoted(str(given))} in quotes"
        case "string_pattern_mismatch":
            return f"{quoted(given)} is {_pattern_in_words(details['pattern'])}"
        case kind:
            return _SENTENCES.get(kind, error["msg"].removeprefix("Value error, "))


def _pattern_in_words(pattern: str) -> str:
    """Return what a text is not that does not have a pattern, and how that is written."""
    if pattern == PAGE_PATTERN:
        return "no page: written like 7-20, A-5 or 102"
    if "\\." in pattern:
        return "no id: small letters and digits with a point between, like works.lathe-rapid"
    return "no key: small letters, digits and _ . + - without a blank"


_SENTENCES = {
    "string_too_short": "is empty",
    **dict.fromkeys(("bool_type", "bool_parsing"), "must be true or false"),
    **dict.fromkeys(("float_type", "float_parsing"), "must be a number"),
    **dict.fromkeys(("int_type", "int_parsing", "int_from_float"), "must be a whole number"),
    **dict.fromkeys(("dict_type", "dataclass_type"), "must be names with what they are: {name: ...}"),
    **dict.fromkeys(("tuple_type", "list_type"), "must be a list: [...]"),
}
"""The type of pydantic's error -> what is wrong with a value."""
