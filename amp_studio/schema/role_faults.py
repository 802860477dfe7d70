"""What is wrong with the roles of a family's pictures, of the words of its programs and of its motion:
parameters and choices that there are not.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from .model import Group, MacroCall, Model, MotionFacts, Parameter, PictureRoles, ProgramWords
from .model.pictures import Direction, ForbiddenSide, RampRoles, ZoneRole, parameters_named
from .quoting import quoted
from .yaml_reader import KeyPath

_PARAMETERS = frozenset(
    (
        "param",
        "params",
        "leading",
        "trailing",
        "format",
        "integrand",
        "incremental",
        "power_up",
        "call",
        "program",
        "in_mdi",
        "integrand_params",
    )
)


def faults_of_pictures(pictures: PictureRoles, groups: tuple[Group, ...]) -> Iterator[tuple[KeyPath, str]]:
    """Yield each fault with its place in the file."""
    known = {p.id: p for group in groups for p in group.parameters}
    for place, named in parameters_named(pictures):
        if named not in known:
            yield place, f"there is no parameter {quoted(named)}"
    travel = pictures.travel
    if travel is not None:
        for n, zone in enumerate(travel.zones):
            yield from _in_zone(zone, known, ("travel", "zones", n))
        for way in ("towards", "off"):
            direction = getattr(travel.home, way, None)
            if direction is not None:
                yield from _in_direction(direction, known, ("travel", "home", way))
    if pictures.ramps is not None:
        yield from _in_ramps(pictures.ramps, known)


def _in_zone(zone: ZoneRole, known: dict[str, Parameter], place: KeyPath) -> Iterator[tuple[KeyPath, str]]:
    if zone.group is not None and zone.group_none is not None:
        yield from _not_offered(zone.group, (zone.group_none,), known, (*place, "group_none"))
    side: ForbiddenSide | None = zone.forbidden_by
    if side is not None:
        for name in ("inside", "outside"):
            yield from _not_offered(side.param, getattr(side, name), known, (*place, "forbidden_by", name))


def _in_direction(
    direction: Direction, known: dict[str, Parameter], place: KeyPath
) -> Iterator[tuple[KeyPath, str]]:
    for name in ("plus", "minus"):
        yield from _not_offered(direction.param, getattr(direction, name), known, (*place, name))


def _in_ramps(ramps: RampRoles, known: dict[str, Parameter]) -> Iterator[tuple[KeyPath, str]]:
    for n, kind in enumerate(ramps.kinds):
        place: KeyPath = ("ramps", "kinds", n, "modes")
        if kind.modes and ramps.mode is None:
            yield place, "there is no mode that chooses"
        elif ramps.mode is not None and ramps.mode_bit is None:
            yield from _not_offered(ramps.mode, kind.modes, known, place)


def _not_offered(
    parameter: str, keys: tuple[str, ...], known: dict[str, Parameter], place: KeyPath
) -> Iterator[tuple[KeyPath, str]]:
    if parameter in known:
        offered = {choice.key for choice in known[parameter].choices or ()}
        for key in keys:
            if key not in offered:
                yield place, f"{quoted(key)} is no choice of {parameter}"


def faults_of_program(program: ProgramWords, groups: tuple[Group, ...]) -> Iterator[tuple[KeyPath, str]]:
    """Yield each fault with its place in the file."""
    known = {p.id: p for group in groups for p in group.parameters}
    for place, named in _named(program, ()):
        if named not in known:
            yield place, f"there is no parameter {quoted(named)}"
    yield from _faults_of_choices(program, known)


def _faults_of_choices(
    program: ProgramWords, known: Mapping[str, Parameter]
) -> Iterator[tuple[KeyPath, str]]:
    """Yield each code whose choice the parameter of its group does not have."""
    for n, group in enumerate(program.groups):
        parameter = known.get(group.power_up or "")
        # A code without a choice is one that no power-up parameter selects.
        offered = {None, *(c.key for c in (parameter and parameter.choices) or ())}
        for m, code in enumerate(group.codes):
            if code.choice not in offered:
                yield ("groups", n, "codes", m, "choice"), f"there is no choice {quoted(str(code.choice))}"


def faults_of_motion(motion: MotionFacts, groups: tuple[Group, ...]) -> Iterator[tuple[KeyPath, str]]:
    """Yield each fault with its place in the file."""
    known = {p.id for group in groups for p in group.parameters}
    for role, named in motion.params.items():
        if named not in known:
            yield ("params", role), f"there is no parameter {quoted(named)}"


def _named(model: Model, place: KeyPath) -> Iterator[tuple[KeyPath, str]]:
    """Yield the parameters that a record of program facts names, each with its place in the file."""
    for name, value in model.items():
        several = isinstance(value, tuple)
        for n, entry in enumerate(value if several else (value,)):
            here = (*place, name, n) if several else (*place, name)
            if isinstance(entry, Model):
                yield from _named(entry, here)
            # ``code`` is a text of the program everywhere but in a macro call, where it names a parameter.
            elif isinstance(entry, str) and (
                name in _PARAMETERS or (name == "code" and isinstance(model, MacroCall))
            ):
                yield here, entry
