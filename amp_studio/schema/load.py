"""Reads ``parameter_db`` into one compiled family, and keeps it compiled.

YAML is parsed only when a file of the family has changed: the compiled form
is kept in the user's cache folder, keyed by the content of every file and of
the models. An error in a fact is reported with file and line.
"""

from __future__ import annotations

import hashlib
import logging
from collections.abc import Callable, Collection, Iterable
from functools import cache, partial
from itertools import chain, count, repeat
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from amp_studio.errors import AmpStudioError

from .consistency import faults_between, faults_of_experience, faults_of_messages, faults_of_order
from .file_error import FileError, ModelError, Slip, read_yaml_file
from .folder import cache_folder, database_folder
from .model import (
    Commissioning,
    Errata,
    Erratum,
    Family,
    Group,
    Guide,
    Guides,
    Messages,
    Model,
    MotionFacts,
    PictureRoles,
    Plausible,
    ProgramWords,
    Rule,
    Rules,
    Table,
    Tables,
)
from .model.compiled_json import cached_record, record_text
from .model.family import define_units
from .model.motion import NO_MOTION
from .nearest import unknown_name
from .quoting import LONGEST, quoted, short
from .registration import added_facts
from .role_faults import faults_of_motion, faults_of_pictures, faults_of_program
from .units import UNITS_FILE
from .yaml_reader import KeyPath, YamlDocument

T = TypeVar("T", bound=Model)
D = TypeVar("D", bound=Model | None)
_log = logging.getLogger(__name__)
_MAX_RULES = 2**20
"""Bytes of a file of rules; the largest of our own has 37,000."""
_MAX_FAULTS_LISTED = 9
"""Of one entry, in a message."""
_LANGUAGE = 2
"""Letters of the code of a language."""


class DatabaseError(FileError):
    """A fact file that cannot be used: file, line and what is wrong with it."""


class UnknownFamilyError(AmpStudioError, KeyError):
    """A family that there is not; the text is one clear sentence."""

    def __init__(self, text: str) -> None:
        super().__init__(unknown_name("family", str(text), family_ids()))

    def __str__(self) -> str:
        return str(self.args[0])


class FurtherFacts(Model):
    """What a check does not ask for."""

    errata: tuple[Erratum, ...] = ()
    tables: tuple[Table, ...] = ()
    guides: tuple[Guide, ...] = ()
    messages: tuple[Messages, ...] = ()
    commissioning: Commissioning | None = None
    pictures: PictureRoles = PictureRoles.model_construct()
    program: ProgramWords = ProgramWords.model_construct()
    motion: MotionFacts = NO_MOTION


class Compiled(Model):
    """A family as it is kept in the cache."""

    family: Family
    groups: tuple[Group, ...]
    rules: tuple[Rule, ...]
    plausible: Plausible = Plausible.model_construct()
    further: str
    """``FurtherFacts`` as JSON: to read them takes a twentieth of a start,
    and most starts never ask for them."""


def family_ids() -> tuple[str, ...]:
    """Return the families that have a folder of facts, in alphabetical order."""
    return tuple(sorted({*_own_ids(), *filter(_can_be_loaded, added_facts())}))


@cache
def _can_be_loaded(family_id: str) -> bool:
    """Return whether the facts of another package can be loaded; a fault is reported, so the others work."""
    try:
        load_compiled(family_id)
    except DatabaseError as fault:
        _log.warning("The family %s of another package cannot be used: %s", family_id, fault)
        return False
    return True


def _own_ids() -> set[str]:
    return {path.parent.name for path in database_folder().glob("*/family.yaml")}


def folder_of(family_id: str) -> Path:
    """Return the folder of a family's facts; the other packages are searched for one
    that the program does not have.
    """
    if family_id in _own_ids():
        return database_folder() / family_id
    if (folder := added_facts().get(family_id)) is None:
        raise UnknownFamilyError(family_id)
    return folder


@cache
def load_compiled(family_id: str) -> Compiled:
    """Return the compiled facts of a family; raises UnknownFamilyError, DatabaseError for a bad fact.

    Only the id of a family that is there becomes a part of a path: what a file, an image or a person calls a
    family may be anything.
    """
    folder = folder_of(family_id)
    cached = cache_folder() / f"{family_id}-{content_key(fact_files(folder))}.json"
    found = cached_record(cached, Compiled, family_id, lambda: compile_family(folder))
    define_units(found.family.own_units)  # what is read without a check defines nothing by itself
    return found


def fact_files(folder: Path) -> list[Path]:
    """Return the files of a family's facts without those of other languages, which are in a folder with two
    letters: most starts ask for none.
    """
    return sorted(
        path for path in folder.rglob("*.yaml") if len(path.relative_to(folder).parts[0]) != _LANGUAGE
    )


def compile_family(folder: Path) -> Compiled:
    """Parse and check every fact file of one family; raises DatabaseError with file and line."""
    family = _read(folder / "family.yaml", Family)
    if odd := next((key for key in family.groups if len(key) > LONGEST), None):
        raise DatabaseError(folder / "family.yaml", 1, f"{quoted(odd)} is too long for the key of a group")
    # After the family: groups use its units and its lists of choices and bits.
    groups = tuple(_group(folder / "groups" / f"{key}.yaml", family) for key in family.groups)
    rules = _entries(_of(family, folder / "rules"), Rules, "rules")
    further = FurtherFacts(
        errata=_entries(_of(family, folder / "errata"), Errata, "errata"),
        tables=_entries(sorted(folder.glob("tables/*.yaml")), Tables, "tables"),
        guides=_entries(sorted(folder.glob("guides/*.yaml")), Guides, "guides"),
        messages=_messages(folder, groups, rules),
        commissioning=_optional(folder / "commissioning.yaml", Commissioning, None, faults_of_order, groups),
        pictures=_optional(
            folder / "pictures.yaml", PictureRoles, PictureRoles(), faults_of_pictures, groups
        ),
        program=_optional(folder / "program.yaml", ProgramWords, ProgramWords(), faults_of_program, groups),
        motion=_optional(folder / "motion.yaml", MotionFacts, NO_MOTION, faults_of_motion, groups),
    )
    plausible = _optional(folder / "plausible.yaml", Plausible, Plausible(), faults_of_experience, groups)
    # The first fault alone: the next ones often follow from it.
    if fault := next(iter(faults_between(family, groups)), None):
        path = folder / (f"groups/{fault.group}.yaml" if fault.group else "family.yaml")
        raise DatabaseError(path, _parsed(path).line(fault.place), fault.what)
    # What is written once for several parameters has reached them.
    return Compiled(
        family=family.model_copy(update={"choice_lists": {}, "bit_lists": {}}),
        groups=tuple(group.model_copy(update={"states": (), "last_states": ()}) for group in groups),
        rules=rules,
        plausible=plausible,
        further=record_text(further),
    )


def _entries(paths: Iterable[Path], model: type[Model], key: str) -> tuple[Any, ...]:
    """Return the entries of the list that files of one kind have under a key."""
    return tuple(chain.from_iterable(getattr(_read(path, model), key) for path in paths))


def _group(path: Path, family: Family) -> Group:
    """Return a group of a family; raises DatabaseError where it has not the key that its file is called."""
    group = _read(path, Group, family)
    if group.key != path.stem:
        raise DatabaseError(path, 1, f"its key is {quoted(group.key)}")
    return group


def _optional(
    path: Path,
    model: type[T],
    without: D,
    faults: Callable[[T, tuple[Group, ...]], Iterable[tuple[KeyPath, str]]],
    groups: tuple[Group, ...],
) -> T | D:
    """Return the facts of a file that a family need not have, checked against its groups;
    ``without`` where there is none. Raises DatabaseError with the line of the first fault.
    """
    if not path.is_file():
        return without
    found = _read(path, model)
    if wrong := next(iter(faults(found, groups)), None):
        raise DatabaseError(path, _parsed(path).line(wrong[0]), wrong[1])
    return found


def _messages(folder: Path, groups: tuple[Group, ...], rules: tuple[Rule, ...]) -> tuple[Messages, ...]:
    """Return the files of messages of a family, checked against its groups and rules."""
    messages = {path: _read(path, Messages) for path in sorted(folder.glob("messages/*.yaml"))}
    for path, place, what in faults_of_messages(messages, groups, rules):
        raise DatabaseError(path, _parsed(path).line(place), what)
    return tuple(messages.values())


def _of(family: Family, folder: Path) -> list[Path]:
    """Return the files of a folder in the order of the groups they are called after; others come after
    them.
    """
    order = {key: n for n, key in enumerate(family.groups)}
    return sorted(folder.glob("*.yaml"), key=lambda path: (order.get(path.stem, len(order)), path.name))


class FactEntry(NamedTuple):
    """One item of a named list of a file, unchanged."""

    kind: str
    """The list."""
    data: Any
    line: Callable[[KeyPath], int]
    """Return the line of a place in it."""


def read_entries(path: Path, kinds: Collection[str]) -> tuple[list[FactEntry], list[DatabaseError]]:
    """Read a file of named lists: every item of one, and what is wrong with the lists."""
    try:
        document = read_yaml_file(path, DatabaseError, most=_MAX_RULES)
    except DatabaseError as fault:
        return [], [fault]
    data = document.data
    if not isinstance(data, dict):
        return [], [] if data is None else [DatabaseError(path, 1, f"has no {' and no '.join(kinds)}")]
    entries: list[FactEntry] = []
    faults: list[DatabaseError] = []
    for key, listed in data.items():
        if key in kinds and isinstance(listed, list):
            lines = (partial(_line_of, document, (key, n)) for n in count())
            entries += map(FactEntry, repeat(key), listed, lines)
        elif listed is not None or key not in kinds:
            what = "is no list" if key in kinds else f"this file contains only {', '.join(kinds)}"
            faults.append(DatabaseError(path, document.line((key,)), f"{short(str(key))}: {what}"))
    return entries, faults


def _line_of(document: YamlDocument, entry: KeyPath, place: KeyPath) -> int:
    return document.line((*entry, *place))


def _read(path: Path, model: type[T], family: Family | None = None) -> T:
    """Return a fact file as a model; names of lists mean those of the family."""
    document = _parsed(path)
    return _valid(path, document, document.data, model, family)


def read_facts(path: Path, model: type[T]) -> tuple[T, Callable[[KeyPath], int]]:
    """Return a fact file as a model, and what returns the line of a place in it; raises DatabaseError."""
    document = _parsed(path)
    return _valid(path, document, document.data, model, None), document.line


def _parsed(path: Path) -> YamlDocument:
    """Return the document of a fact file; raises DatabaseError."""
    return read_yaml_file(path, DatabaseError, references=True)


def _valid(path: Path, document: YamlDocument, data: Any, model: type[T], family: Family | None) -> T:
    """Return data of a fact file as a model; raises DatabaseError with all slips of its first wrong entry."""
    from .model_errors import read_model  # a start reads compiled facts, and needs no pydantic

    try:
        return read_model(model, data, family)
    except ModelError as error:
        raise _error_of(path, document, error.slips) from None
    # A file may be nested deeper than Python follows.
    except RecursionError:
        raise DatabaseError(path, 1, "is too deep") from None


def _error_of(path: Path, document: YamlDocument, slips: list[Slip]) -> DatabaseError:
    """Return all that is wrong with the first entry of a file in which something is, as one error."""
    slips = sorted(slips, key=lambda slip: document.line(slip[0]))
    entry, name = _entry(document.data, slips[0][0])
    first = document.line(slips[0][0])
    messages = []
    for place, what in slips:
        if _entry(document.data, place)[0] == entry:
            line = document.line(place)
            keys = [short(key) for key in place[len(entry) :] if isinstance(key, str)]
            messages.append(": ".join([*keys, what]) + (f" (line {line})" if line != first else ""))
    more = f"; and {len(messages) - _MAX_FAULTS_LISTED} more" if len(messages) > _MAX_FAULTS_LISTED else ""
    return DatabaseError(path, first, f"{name}{'; '.join(messages[:_MAX_FAULTS_LISTED])}{more}")


def _entry(data: Any, place: KeyPath) -> tuple[KeyPath, str]:
    """Return where the innermost entry with an id begins that a place lies in, and the id;
    else the whole file.
    """
    entry: KeyPath = ()
    name = ""
    for n in range(len(place) + 1):
        if isinstance(data, dict) and "id" in data:
            entry, name = place[:n], f"{short(str(data['id']))}: "
        try:
            data = data[place[n]]
        except (LookupError, TypeError):
            break
    return entry, name


def content_key(files: list[Path]) -> str:
    """Return a checksum over fact files and over what compiles them."""
    digest = hashlib.sha256()
    here = Path(__file__).parent
    # What gives the compiled facts their form: a change of it must not meet facts in the form of before.
    own = (*sorted((here / "model").glob("*.py")), Path(__file__), here / "compiled_cache.py", UNITS_FILE)
    for path in [*own, *files]:
        content = path.read_bytes()
        # With name and length: a text that moves from one file to the next makes another key.
        digest.update(f"{path.name}:{len(content)}:".encode())
        digest.update(content)
    return digest.hexdigest()[:24]
