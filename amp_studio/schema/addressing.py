"""What a person means by a number, an id or the letter of an axis:
the one place where every verb looks it up.

    1300                 the manual's own number, here of axis 1
    61                   a number without the letters before it (Pr61, R3, $130)
    P21                  a number of several words: all of them, or the only one
    P3N0.5               a bit, or the field that begins at it, of a packed word
    home.calibration@1   id and instance
    home.calibration@X   the axis by the letter that the file gives it
    1300@X               the parameter that has this number on any axis, on axis X

Case does not matter. A number that is printed for several parameters means one that exists for the file's
machine; where that leaves more than one, the first in the manual's order, so that every verb takes the same.
"""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterator, Sequence
from functools import partial
from typing import NamedTuple, Protocol

from .address import Address, UnknownParameterError, whole_of, written
from .bit_fields import field_at, field_value
from .catalog import Schema
from .conditions import StateInfo
from .machine_schema import MachineSchema
from .model import Parameter, Scope
from .nearest import close_matches, unknown_name
from .quoting import quoted, short
from .values import label_of

_NEAREST = 3
_LONGEST_NUMBER = 16


class FileState(Protocol):
    """What the meaning of a text depends on in a file: its machine type,
    and the values and states of its parameters.
    """

    @property
    def schema(self) -> Schema: ...
    @property
    def machine_schema(self) -> MachineSchema: ...
    def canonical(self, address: Address) -> float | str | bool | None: ...
    def scope(self, address: Address) -> Scope | None: ...
    def state(self, address: Address) -> StateInfo: ...
    def is_true(self, name: str, instance: str, scope: str | None = None) -> bool: ...
    def least_hidden(self, claims: list[Address]) -> list[Address]: ...


class ResolvedAddress(NamedTuple):
    """What a text addresses."""

    address: Address
    bit: int | None = None
    """The bit of a packed word, where the text names one."""
    number: str = ""
    """The number in the text; empty where it is an id."""
    others: tuple[Address, ...] = ()
    """Further instances that the manual prints this number for."""

    def remark(self, schema: Schema) -> str:
        """Return a message with the parameter that an ambiguous number means; empty where there is but
        one.
        """
        if not self.others:
            return ""

        def named(address: Address) -> str:
            return f"{schema.parameters[address[0]].name} ({written(address)})"

        count = {2: "two", 3: "three"}.get(len(self.others) + 1, str(len(self.others) + 1))
        rest = " and ".join(map(named, self.others))
        return (
            f"{self.number} is printed for {count} parameters: taken is {named(self.address)}; "
            f"the other{'s are' if len(self.others) > 1 else ' is'} {rest}"
        )


def resolve_address(evaluation: FileState, text: str) -> ResolvedAddress:
    """Return the one instance, or the bit of it, that a text addresses;
    raises UnknownParameterError with one sentence.
    """
    try:
        return _whole(evaluation, text)
    except UnknownParameterError:
        # Only now: the text as a whole may be a number with a point.
        head, _, bit = text.strip().rpartition(".")
        if not re.fullmatch("[0-9]{1,2}", bit):
            raise
        with contextlib.suppress(UnknownParameterError):
            word = _whole(evaluation, head)
            if evaluation.schema.parameters[word.address[0]].type == "bits":
                return ResolvedAddress(word.address, int(bit), word.number, word.others)
        raise


def resolve_all(evaluation: FileState, text: str) -> list[ResolvedAddress]:
    """Return every instance that a text addresses where several are welcome: all words of ``P21``, and an id
    alone on all axes; raises UnknownParameterError.
    """
    parameter = evaluation.schema.parameters.get(text.strip().casefold())
    if parameter is not None:
        # An id alone means all its instances; a number is printed for one.
        several = [(parameter.id, instance) for instance in evaluation.machine_schema.instances(parameter)]
        several = _existing(evaluation, several)
    else:
        several = _words(evaluation, text)
    return [ResolvedAddress(each) for each in several] or [resolve_address(evaluation, text)]


def resolve_addresses(evaluation: FileState, text: str) -> list[Address]:
    """Return the values that a text means where several are welcome: of a bit its word.

    Raises UnknownParameterError.
    """
    return [found.address for found in resolve_all(evaluation, text)]


def _whole(evaluation: FileState, text: str) -> ResolvedAddress:
    """Return what a text without a bit means: an id, a number, the one word of a number, or a number on an
    axis.
    """
    schema, text = evaluation.schema, text.strip()
    name, _, instance = text.partition("@")
    parameter = schema.parameters.get(name.casefold())
    if parameter is not None:
        return ResolvedAddress((parameter.id, _instance(evaluation, parameter, instance, text)))
    existing = _claims(evaluation, text)
    # Before the words of a number: a parameter with exactly this number is meant, if there is one.
    if existing:
        others = [a for a in evaluation.machine_schema.claims(text) if a != existing[0]]
        return ResolvedAddress(existing[0], None, text, tuple(others))
    if words := _words(evaluation, text):
        return ResolvedAddress(_only_word(evaluation, words, text), None, text)
    if instance and (same := _words(evaluation, name) or _claims(evaluation, name)):
        parameter = schema.parameters[same[0][0]]
        return ResolvedAddress((parameter.id, _instance(evaluation, parameter, instance, text)), None, name)
    raise UnknownParameterError(*unknown(schema, text))


def _only_word(evaluation: FileState, words: Sequence[Address], text: str) -> Address:
    """Return the one word that a number has; raises UnknownParameterError where it has several."""
    if len(words) == 1:
        return words[0]
    first, last = (evaluation.machine_schema.number(a) for a in (words[0], words[-1]))
    raise UnknownParameterError(f"{quoted(text)} has {len(words)} words, {first} to {last}: name one of them")


def _claims(evaluation: FileState, text: str) -> list[Address]:
    """Return the parameters that a number is printed for, those that exist for this machine if any does."""
    claims = evaluation.machine_schema.addressed_by(text)
    # Where all are hidden, the one for whose absence there is the least reason is the likeliest.
    return [a for a in claims if evaluation.state(a).state != "hidden"] or evaluation.least_hidden(claims)


def _words(evaluation: FileState, text: str) -> list[Address]:
    """Return the words of a number that has several (P21), those that exist for this machine if any does."""
    return _existing(evaluation, evaluation.machine_schema.words(text))


def _existing(evaluation: FileState, addresses: list[Address]) -> list[Address]:
    """Return those that exist for this machine if any does, else all."""
    return [a for a in addresses if evaluation.state(a).state != "hidden"] or addresses


# -- instances


def _of_letter(evaluation: FileState, parameter: Parameter, instance: str) -> list[str]:
    """Return the instances of a parameter of the axes that are called by a letter: ``X``, ``X.2``."""
    here = evaluation.machine_schema
    if not instance or not here.kin(evaluation.scope((parameter.id, "")), "axis"):
        return []
    letter, point, part = instance.partition(".")
    named = (axis + point + part for axis in _axes_named(evaluation, letter))
    return [each for each in named if each in here.instances(parameter)]


def _instance(evaluation: FileState, parameter: Parameter, instance: str, text: str) -> str:
    """Return the instance that is named by itself, or by the letter of its axis;
    raises UnknownParameterError.
    """
    instances = evaluation.machine_schema.instances(parameter)
    if instance in instances:
        return instance
    # An instance by its own name comes before an axis by the letter that the file gives it.
    alike = [i for i in instances if i and i.casefold() == instance.casefold()]
    alike = alike or _of_letter(evaluation, parameter, instance)
    if len(alike) == 1:
        return alike[0]
    if alike:
        named = " and ".join(map(whole_of, alike))
        ways = " or ".join(f"{parameter.id}@{i}" for i in alike)
        raise UnknownParameterError(
            f"{quoted(text)}: the axes {named} are all named {instance.upper()}: write {ways}"
        )
    letters = "" if len(instances) < 2 else _letters(evaluation, parameter)
    way = "" if instance or not instances[1:] else f": write {text}@{instances[0]}"
    raise UnknownParameterError(f"{quoted(text)}: {parameter.name} {_offered(instances)}{letters}{way}")


def _letters(evaluation: FileState, parameter: Parameter) -> str:
    """Return the letters of the axes that can name the instances of a parameter."""
    if not evaluation.machine_schema.kin(evaluation.scope((parameter.id, "")), "axis"):
        return ""
    letters = dict.fromkeys(name for axis, name in _axis_names(evaluation) if is_fitted(evaluation, axis))
    return f", or an axis by its letter: {', '.join(letters)}" if letters else ""


def resolve_axis(evaluation: FileState, instances: tuple[str, ...], text: str) -> str:
    """Return the axis that is named by itself or by its letter; raises UnknownParameterError."""
    found = [i for i in instances if i.casefold() == text.casefold()] or _axes_named(evaluation, text)
    if len(found) == 1:
        return found[0]
    if found:
        raise UnknownParameterError(
            f"the axes {' and '.join(found)} are all named {text.upper()}; give it by number"
        )
    fitted = [axis for axis in instances if is_fitted(evaluation, axis)]
    names = [axis_name(evaluation, axis) or axis for axis in fitted or instances]
    raise UnknownParameterError(unknown_name("axis", text, names))


def axis_name(evaluation: FileState, axis: str) -> str:
    """Return the letter that a file gives an axis; "" where it gives none."""
    naming = _naming(evaluation)
    if naming is None or axis not in evaluation.machine_schema.instances(
        evaluation.schema.parameters[naming[0]]
    ):
        return ""
    return _label(evaluation, *naming, axis)


def _axes_named(evaluation: FileState, letter: str) -> list[str]:
    """Return the axes that the file gives a letter, fitted ones where there are any."""
    found = [axis for axis, name in _axis_names(evaluation) if name.casefold() == letter.casefold()]
    # A letter that was left at an axis which is not there makes no choice of two.
    return [axis for axis in found if is_fitted(evaluation, axis)] or found


def _axis_names(evaluation: FileState) -> Iterator[tuple[str, str]]:
    """Yield each axis with the name that the file gives it."""
    if (naming := _naming(evaluation)) is None:
        return
    for axis in evaluation.machine_schema.instances(evaluation.schema.parameters[naming[0]]):
        if name := _label(evaluation, *naming, axis):
            yield axis, name


def _naming(evaluation: FileState) -> tuple[str, int | None] | None:
    """Return the parameter that names an axis, and the field of its word where it is one;
    None in a family without.
    """
    family = evaluation.schema.family
    declared = family.declared_axes.name if family.declared_axes else None
    named_by = family.axes.name if family.axes else declared.param if declared else None
    return (named_by, declared.bit if declared else None) if named_by else None


def _label(evaluation: FileState, parameter_id: str, bit: int | None, axis: str) -> str:
    """Return the label of an axis' choice, or of the choice in a field of its word; "" where there is
    none.
    """
    parameter, value = evaluation.schema.parameters[parameter_id], evaluation.canonical((parameter_id, axis))
    if bit is None:
        return label_of(parameter, value) if isinstance(value, str) else ""
    if not isinstance(value, float):
        return ""
    field = field_at(parameter, bit)
    code = field_value(field, int(value))
    return next((c.label for c in field.choices or () if c.raw == code and c.key != "none"), "")


def axis_group(evaluation: FileState, axis: str) -> str:
    """Return the group that a file puts an axis into (``Group 2``); "" in a family without groups of axes."""
    declared = evaluation.schema.family.declared_axes
    if declared is None or declared.group is None:
        return ""
    return _label(evaluation, declared.group.param, declared.group.bit, axis)


def is_fitted(evaluation: FileState, axis: str) -> bool:
    """Return whether an axis is there as a file declares it; where it is not known, it is."""
    profile, declared = evaluation.schema.family.axes, evaluation.schema.family.declared_axes
    if profile is None:
        condition = declared.absent_when if declared else None
        return condition is None or not evaluation.is_true(condition, axis, "axis")
    if profile.fitted_by is not None:
        return evaluation.canonical((profile.fitted_by, axis)) != 0.0
    return evaluation.canonical((profile.type, axis)) not in (None, profile.unfitted)


def _offered(instances: tuple[str, ...]) -> str:
    if not instances:
        return "does not exist on this machine type"
    if instances == ("",):
        return "is one for the whole control, without '@'"
    named = [i for i in instances if i]
    span = f"@{named[0]} to @{named[-1]}" if len(named) > 1 else f"only @{named[0]}"
    return f"has {span}" + (", and one without '@'" if "" in instances else "")


# -- unknown names


def unknown(schema: Schema, text: str) -> tuple[str, partial[list[str]]]:
    """Return the message for an unknown name, and the function that lists the nearest names."""
    return f"Unknown parameter {quoted(text)}", partial(_nearest, schema, text)


_NUMBER_FORM = re.compile(r"[a-z$]*[0-9]+([a-z]+[0-9]*)?(\.[0-9]+)?")


def _nearest(schema: Schema, text: str) -> list[str]:
    """Return the ids and numbers that a person may have meant, nearest first."""
    name, sign, instance = text.partition("@")
    name = name.casefold()
    numbers = list(dict.fromkeys(n for m in schema.family.machines for n in schema.on(m.key).every_number))
    # Bounded, as below: difflib takes the square of the lengths.
    if _NUMBER_FORM.fullmatch(name) and not sign and len(name) < _LONGEST_NUMBER:
        return _nearest_numbers(numbers, name)
    # Ids last: where a name is spelled like an id, the id counts.
    known = {p.name.casefold(): p.id for p in schema.parameters.values()}
    known |= {p.id.partition(".")[2]: p.id for p in schema.parameters.values()}
    known |= dict(zip(schema.parameters, schema.parameters, strict=True))
    found = dict.fromkeys(map(known.__getitem__, close_matches(name[:80], known, 2 * _NEAREST, 0.7)))
    return [f"{n}{sign}{short(instance)}" if n in schema.parameters else n for n in found][:_NEAREST]


def _nearest_numbers(numbers: list[str], text: str) -> list[str]:
    """Return the numbers that look most like one, of those the ones next to it."""
    from difflib import SequenceMatcher

    digits = _figures(text)

    def far(number: str) -> tuple[bool, float, list[int]]:
        # In tenths: of numbers that look about as much alike, the one that is next in value is likelier.
        alike = round(SequenceMatcher(None, text, number.casefold()).ratio(), 1)
        apart = [abs(a - b) for a, b in zip(digits, _figures(number), strict=False)]
        return len(number) != len(text), -alike, apart

    return sorted(numbers, key=far)[:_NEAREST]


def _figures(text: str) -> list[int]:
    return [int(figures) for figures in re.findall("[0-9]{1,9}", text)]
