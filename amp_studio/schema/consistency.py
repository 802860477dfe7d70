"""What the fact files of a family name of each other: names that must exist, and only once."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from fnmatch import fnmatchcase
from itertools import chain
from pathlib import Path
from typing import NamedTuple

from .cel_engine import WORD_FUNCTIONS, compile_expression, functions_called
from .model import (
    BoundRef,
    Commissioning,
    Family,
    Group,
    GroupState,
    Messages,
    Parameter,
    Plausible,
    Rule,
    StateRule,
)
from .quoting import quoted
from .yaml_reader import KeyPath


class Inconsistency(NamedTuple):
    """A fault that one file alone does not show; ``group`` is the file's key, None for ``family.yaml``."""

    group: str | None
    place: KeyPath
    what: str


def faults_between(family: Family, groups: tuple[Group, ...]) -> Iterator[Inconsistency]:
    """Yield every name that is used and does not exist, and every duplicate parameter."""
    ids = {p.id for group in groups for p in group.parameters}
    secrets = {p.id for group in groups for p in group.parameters if p.secret}
    yield from _in_family(family, ids)
    yield from faults_of_areas(family)
    seen: set[str] = set()
    for group in groups:
        yield from _in_group_states(family, group)
        for position, parameter in enumerate(group.parameters):
            here: KeyPath = ("parameters", position)
            if parameter.id in seen:
                yield Inconsistency(group.key, (*here, "id"), f"{parameter.id} occurs twice")
            seen.add(parameter.id)
            own = group.own_states(parameter)
            for place, what in (
                *_in_parameter(family, parameter, own, ids),
                *_secret_bounds(parameter, secrets),
            ):
                yield Inconsistency(group.key, (*here, *place), f"{parameter.id}: {what}")


def faults_of_messages(
    files: Mapping[Path, Messages], groups: tuple[Group, ...], rules: tuple[Rule, ...]
) -> Iterator[tuple[Path, KeyPath, str]]:
    """Yield each parameter or rule that a message names and that does not exist, and each duplicate
    message.
    """
    known = {
        "params": {p.id for group in groups for p in group.parameters},
        "rules": {rule.id for rule in rules},
    }
    seen: set[str] = set()
    for path, file in files.items():
        for position, message in enumerate(file.messages):
            here: KeyPath = ("messages", position)
            if message.id in seen:
                yield path, (*here, "id"), f"{message.id} occurs twice"
            seen.add(message.id)
            for key, kind in (("params", "parameter"), ("rules", "rule")):
                for n, name in enumerate(getattr(message, key)):
                    if name not in known[key]:
                        yield path, (*here, key, n), f"{message.id}: there is no {kind} {quoted(name)}"


def _matches_any(pattern: str, names: Iterable[str]) -> bool:
    return any(fnmatchcase(name, pattern) for name in names)


def faults_of_experience(plausible: Plausible, groups: tuple[Group, ...]) -> Iterator[tuple[KeyPath, str]]:
    """Yield each parameter and choice that the facts of experience name and that does not exist,
    and each pattern without any.
    """
    known = {p.id: _choice_keys(p) for group in groups for p in group.parameters}
    yield from _without_match(plausible, known)
    yield from _without_default(plausible, groups)
    for place, name in _places_of_experience(plausible):
        if name not in known:
            yield place, f"there is no parameter {quoted(name)}"
    for name in plausible.usual:
        for n, choice in enumerate(plausible.usual[name].choices):
            # A parameter that does not exist was named above; its choices would be a second fault of one
            # slip.
            if choice not in known.get(name, {choice}):
                yield ("usual", name, "choices", n), f"{quoted(name)} has no choice {quoted(choice)}"


def _choice_keys(parameter: Parameter) -> set[str]:
    return {choice.key for choice in parameter.choices or ()}


def _without_match(plausible: Plausible, known: Mapping[str, object]) -> Iterator[tuple[KeyPath, str]]:
    """Yield each pattern that no parameter matches."""
    for key, patterns in (("unlike", plausible.unlike), ("may_differ", plausible.may_differ)):
        for n, pattern in enumerate(patterns):
            if not _matches_any(pattern, known):
                yield (key, n), f"there is no parameter {quoted(pattern)}"


def _without_default(plausible: Plausible, groups: tuple[Group, ...]) -> Iterator[tuple[KeyPath, str]]:
    """Yield each parameter that seldom has its default, and has none."""
    without = {p.id for group in groups for p in group.parameters if p.default is None}
    for n, name in enumerate(plausible.seldom):
        if name in without:
            yield ("seldom", n), f"{quoted(name)} has no printed default"


def _places_of_experience(plausible: Plausible) -> Iterator[tuple[KeyPath, str]]:
    """Yield place and name of each parameter that the facts of experience name."""
    for key, entries in _named_by_experience(plausible).items():
        for n, names in enumerate(entries):
            yield from (((key, n), name) for name in names)
    yield from ((("usual", name), name) for name in plausible.usual)
    yield from ((("equal_rows", name), name) for name in plausible.equal_rows)


def _named_by_experience(plausible: Plausible) -> dict[str, tuple[tuple[str, ...], ...]]:
    """Return list of the facts of experience -> the parameters that each of its entries names."""
    return {
        "smooth": tuple(zip(plausible.smooth)),
        "steps": tuple(zip(plausible.steps)),
        "axis_words": tuple(zip(plausible.axis_words)),
        "within": tuple(
            (travel.low, travel.high, *travel.inside, *travel.strokes) for travel in plausible.within
        ),
        "same": plausible.same,
        "twins": plausible.twins,
        "twins_where": ((plausible.twins_where.param,),) if plausible.twins_where else (),
        "ladders": plausible.ladders,
        "quotients": tuple((one.of, one.over) for one in plausible.quotients),
        "among_axes": tuple((one.of, one.over or one.of) for one in plausible.among_axes),
        "table": tuple(zip(plausible.table)),
        "upright": tuple(zip(plausible.upright)),
        "uniform": tuple(zip(plausible.uniform)),
        "counted": tuple(zip(plausible.counted)),
        "signed": tuple(zip(plausible.signed)),
        "towards": tuple((one.speed, one.place, one.low, one.high) for one in plausible.towards),
        "travels": tuple((one.high, one.low or one.high) for one in plausible.travels),
        "gears": tuple((one.low, one.high) for one in plausible.gears),
        "proportions": tuple((*one.part_of, *one.as_of) for one in plausible.proportions),
        "seldom": tuple(zip(plausible.seldom)),
        "needs": tuple(plausible.needs.items()),
        "not_above": tuple((one.limit, *one.are) for one in plausible.not_above),
    }


def _in_conditions(family: Family, ids: set[str]) -> Iterator[Inconsistency]:
    """Yield each condition that cannot be compiled, and what the conditions read that does not exist."""
    for name, condition in family.conditions.items():
        here: KeyPath = ("conditions", name)
        try:
            unknown = sorted(functions_called(compile_expression(condition.when)) - WORD_FUNCTIONS.keys())
            if unknown:
                what = f"condition {name} calls {quoted(unknown[0])}, which is no function"
                yield Inconsistency(None, (*here, "when"), what)
        except ValueError as error:
            yield Inconsistency(None, (*here, "when"), f"condition {name}: {_first_line(error)}")
        for short, text in condition.reads.items():
            if text.partition("@")[0] not in ids:
                what = f"condition {name} reads {quoted(text)}, which does not exist"
                yield Inconsistency(None, (*here, "reads", short), what)


def _in_family(family: Family, ids: set[str]) -> Iterator[Inconsistency]:
    """Yield what ``family.yaml`` names that does not exist: parameters, conditions, sizes of units."""
    yield from _in_conditions(family, ids)
    if family.angular_when is not None and family.angular_when not in family.conditions:
        yield Inconsistency(None, ("angular_when",), f"there is no condition {quoted(family.angular_when)}")
    yield from _axis_faults(family, ids)
    for unit, scale in family.scales.items():
        for kind in ("length", "angle"):
            size = getattr(scale, kind)
            if size is not None and size.param not in ids:
                what = f"there is no parameter {quoted(size.param)}"
                yield Inconsistency(None, ("scales", unit, kind, "param"), what)
    for key in ("machine_parameter", "unit_parameter"):
        named = getattr(family, key)
        if named is not None and named not in ids:
            yield Inconsistency(None, (key,), f"there is no parameter {quoted(named)}")


def _first_line(error: Exception) -> str:
    return str(error).splitlines()[0]


def _axis_faults(family: Family, ids: set[str]) -> Iterator[Inconsistency]:
    """Yield every parameter and condition by which a family declares its axes that does not exist."""
    declared = family.declared_axes
    if declared is None:
        return
    params: dict[KeyPath, str | None] = {
        ("name", "param"): declared.name.param if declared.name else None,
        ("group", "param"): declared.group.param if declared.group else None,
        ("group_count",): declared.group_count,
        ("count",): declared.count,
        ("letters",): declared.letters,
        **{("flags", n): flag for n, flag in enumerate(declared.flags)},
    }
    conditions: dict[KeyPath, str | None] = {
        ("absent_when",): declared.absent_when,
        **{("other_uses", condition): condition for condition in declared.other_uses},
    }
    for kind, used, known in (
        ("parameter", params, ids),
        ("condition", conditions, family.conditions.keys()),
    ):
        for place, named in used.items():
            if named is not None and named not in known:
                yield Inconsistency(None, ("declared_axes", *place), f"there is no {kind} {quoted(named)}")


def _in_group_states(family: Family, group: Group) -> Iterator[Inconsistency]:
    """Yield what is wrong with the states of a group: an unknown condition, and one that no parameter
    gets.
    """
    for key in ("states", "last_states"):
        for n, state in enumerate(getattr(group, key)):
            for place, what in (*_in_state(family, state), *_without_parameter(group, state)):
                yield Inconsistency(group.key, (key, n, *place), what)


def _without_parameter(group: Group, state: GroupState) -> Iterator[tuple[KeyPath, str]]:
    """Yield place and text of what a state of a group names that no parameter of it has or is."""
    if state.scope is not None and not any(state.scope in p.scopes for p in group.parameters):
        yield ("scope",), f"no parameter here has scope {quoted(state.scope)}"
    ids = {p.id for p in group.parameters}
    for at, named in enumerate(state.not_for):
        if named not in ids:
            yield ("not_for", at), f"there is no parameter {quoted(named)} here"


def _in_state(family: Family, state: StateRule) -> Iterator[tuple[KeyPath, str]]:
    if (state.when or state.unless) not in family.conditions:
        yield (
            ("when" if state.when else "unless",),
            f"there is no condition {quoted(state.when or str(state.unless))}",
        )


def _in_parameter(
    family: Family, parameter: Parameter, own_states: range, ids: set[str]
) -> Iterator[tuple[KeyPath, str]]:
    """Yield what a parameter names that does not exist, with the place in its own entry."""
    if parameter.angular_when is not None and parameter.angular_when not in family.conditions:
        yield ("angular_when",), f"there is no condition {quoted(parameter.angular_when)}"
    # Only its own: those of the group are reported once, at the group.
    for n, state in enumerate(parameter.states[i] for i in own_states):
        for place, what in _in_state(family, state):
            yield ("states", n, *place), what
    for n, variant in enumerate(parameter.range_variants):
        if variant.when not in family.conditions:
            yield ("range_variants", n, "when"), f"there is no condition {quoted(variant.when)}"
    yield from _in_commands(parameter, ids)
    yield from _in_bounds(parameter, ids)
    for place, scope in _all_scopes(parameter):
        if scope not in family.scopes:
            yield place, f"the family has no scope {quoted(scope)}"


def _in_bounds(parameter: Parameter, ids: set[str]) -> Iterator[tuple[KeyPath, str]]:
    """Yield every bound of a range that is no parameter."""
    for place, ranges in _all_ranges(parameter):
        for unit, pair in ranges:
            for end, bound in enumerate(pair):
                if isinstance(bound, BoundRef) and bound.param not in ids:
                    what = f"there is no parameter {quoted(bound.param)} to bound it"
                    yield (*place, unit, end, "param"), what


def _in_commands(parameter: Parameter, ids: set[str]) -> Iterator[tuple[KeyPath, str]]:
    """Yield every name in the commands of a parameter that is no parameter."""
    commands: list[tuple[KeyPath, str]] = [(("program",), text) for text in parameter.program]
    if parameter.storage:
        commands.insert(0, (("storage", "command"), parameter.storage.command or ""))
    for place, command in commands:
        for named in re.findall(r"{(.*?)}", command):
            # One letter is filled in by the format itself: instance, place, number and value.
            if named not in ("i", "k", "n", "v") and named not in ids:
                yield place, f"there is no parameter {quoted(named)} for its command"


def _secret_bounds(parameter: Parameter, secrets: set[str]) -> Iterator[tuple[KeyPath, str]]:
    """Yield every bound that is a secret: a message about the range would reveal it."""
    for place, ranges in _all_ranges(parameter):
        for unit, pair in ranges:
            for end, bound in enumerate(pair):
                if isinstance(bound, BoundRef) and bound.param in secrets:
                    yield (*place, unit, end, "param"), f"the secret {quoted(bound.param)} cannot bound it"


def _all_ranges(parameter: Parameter) -> Iterator[tuple[KeyPath, list[tuple[str, tuple[object, object]]]]]:
    yield ("ranges",), list((parameter.ranges or {}).items())
    for n, variant in enumerate(parameter.range_variants):
        yield ("range_variants", n, "ranges"), list(variant.ranges.items())


def _all_scopes(parameter: Parameter) -> Iterator[tuple[KeyPath, str]]:
    if parameter.layouts is None:
        yield ("scope",), parameter.scope
    for n, layout in enumerate(parameter.layouts or ()):
        yield ("layouts", n, "scope"), layout.scope


def faults_of_order(order: Commissioning, groups: tuple[Group, ...]) -> Iterator[tuple[KeyPath, str]]:
    """Yield what is wrong with the steps of a family: what does not exist, and what is in two of them."""
    params = {p.id for p in chain.from_iterable(group.parameters for group in groups)}
    known = {"params": params, "again": params, "groups": {group.key for group in groups}}
    seen: dict[str, set[str]] = {"params": set(), "groups": set(), "id": set()}
    for n, step in enumerate(order.steps):
        if step.id in seen["id"]:
            yield ("steps", n, "id"), f"there are two steps {quoted(step.id)}"
        seen["id"].add(step.id)
        for key, kind in (("params", "parameter"), ("groups", "group"), ("again", "parameter")):
            for at, name in enumerate(getattr(step, key)):
                here: KeyPath = ("steps", n, key, at)
                if name not in known[key]:
                    yield here, f"there is no {kind} {quoted(name)}"
                elif name in seen.get(key, ()):
                    yield here, f"{quoted(name)} is in an earlier step"
                # ``again`` may name a parameter in several steps, and has no entry in ``seen``.
                seen.get(key, set()).add(name)
    yield from _unknown(order.of_one_machine, params)


def _unknown(names: Sequence[str], params: set[str]) -> Iterator[tuple[KeyPath, str]]:
    for at, name in enumerate(names):
        if name not in params:
            yield ("of_one_machine", at), f"there is no parameter {quoted(name)}"


def faults_of_areas(family: Family) -> Iterator[Inconsistency]:
    """Yield where the areas of a family are not all of its groups in their order."""
    listed = [key for area in family.areas for key in area.groups]
    # In the same order too: an area is a head above groups that follow each other.
    if family.areas and listed != list(family.groups):
        odd = next((k for k in listed if k not in family.groups), None) or next(
            (k for k in family.groups if k not in listed), "the groups in their order"
        )
        yield Inconsistency(None, ("areas",), f"the areas do not have each group once: {quoted(odd)}")
