"""Reads ``parameter_db`` into one compiled family, and keeps it compiled.

YAML is parsed only when a file of the family has changed: the compiled form
is JSON in the user's cache folder, keyed by the content of every file and of
the models. A fault in a fact is told with file and line.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import tempfile
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import platformdirs
from pydantic import TypeAdapter, ValidationError
from pydantic_core import ErrorDetails

from .consistency import Place, faults_between
from .model import Errata, Erratum, Family, Group, Guide, Guides, Model, Rule, Rules, Table, Tables

T = TypeVar("T", bound=Model)


class DatabaseFault(Exception):
    """A fact file that cannot be used: file, line and what is wrong with it."""

    def __init__(self, path: Path, line: int | None, what: str) -> None:
        self.path, self.line, self.what = path, line, what
        super().__init__(f"{path}{f', line {line}' if line else ''}: {what}")


class Compiled(Model):
    """A family as it is kept in the cache."""

    family: Family
    groups: tuple[Group, ...]
    rules: tuple[Rule, ...]
    errata: tuple[Erratum, ...]
    tables: tuple[Table, ...]
    guides: tuple[Guide, ...] = ()


def database_folder() -> Path:
    """Return the folder of facts: inside the installed package, or at the top of the checkout."""
    package = Path(__file__).resolve().parent.parent
    inside = package / "parameter_db"
    return inside if inside.is_dir() else package.parent / "parameter_db"


def family_ids() -> tuple[str, ...]:
    """Return the families that have a folder of facts, in alphabetical order."""
    return tuple(sorted(p.parent.name for p in database_folder().glob("*/family.yaml")))


@cache
def load_compiled(family_id: str) -> Compiled:
    """Return the compiled facts of a family; raises KeyError for an unknown one, DatabaseFault for a bad fact."""
    folder = database_folder() / family_id
    if not (folder / "family.yaml").is_file():
        raise KeyError(family_id)
    files = sorted(p for p in folder.rglob("*.yaml"))
    key = _content_key(files)
    cached = Path(platformdirs.user_cache_dir("amp-studio")) / f"{family_id}-{key}.json"
    try:
        return Compiled.model_validate_json(cached.read_bytes())
    except (OSError, ValidationError):
        pass
    compiled = compile_family(folder)
    _keep(cached, compiled)
    return compiled


def compile_family(folder: Path) -> Compiled:
    """Parse and check every fact file of one family; raises DatabaseFault with file and line."""
    family = _read(folder / "family.yaml", Family)
    groups = tuple(_read(folder / "groups" / f"{key}.yaml", Group) for key in family.groups)
    for key, group in zip(family.groups, groups, strict=True):
        if group.key != key:
            raise DatabaseFault(folder / "groups" / f"{key}.yaml", 1, f"its key is '{group.key}'")
    rules = tuple(rule for path in _of(family, folder / "rules") for rule in _read(path, Rules).rules)
    errata = tuple(e for path in _of(family, folder / "errata") for e in _read(path, Errata).errata)
    tables = tuple(t for path in sorted(folder.glob("tables/*.yaml")) for t in _read(path, Tables).tables)
    guides = tuple(g for path in sorted(folder.glob("guides/*.yaml")) for g in _read(path, Guides).guides)
    fault = next(iter(faults_between(family, groups)), None)
    if fault is not None:
        path = folder / (f"groups/{fault.group}.yaml" if fault.group else "family.yaml")
        raise DatabaseFault(path, _line_of(path, fault.place), fault.what)
    return Compiled(family=family, groups=groups, rules=rules, errata=errata, tables=tables, guides=guides)


def _of(family: Family, folder: Path) -> list[Path]:
    """Return the files of a folder in the order of the groups they are called after; others stand behind."""
    order = {key: n for n, key in enumerate(family.groups)}
    return sorted(folder.glob("*.yaml"), key=lambda path: (order.get(path.stem, len(order)), path.name))


def read_entries(
    path: Path, models: Mapping[str, type[Model]]
) -> tuple[list[tuple[Model, int | None]], list[DatabaseFault]]:
    """Read a file of named lists entry by entry: those that can be used, with their lines, and what is wrong with the others.

    ``models`` says which lists there may be, and of what.
    """
    try:
        data = _parsed(path)
    except DatabaseFault as fault:
        return [], [fault]
    if not isinstance(data, dict):
        return [], [] if data is None else [DatabaseFault(path, 1, f"holds no {' and no '.join(models)}")]
    entries: list[tuple[Model, int | None]] = []
    faults: list[DatabaseFault] = []
    for key, listed in data.items():
        if key not in models or not isinstance(listed, list):
            said = f"{key}: is no list" if key in models else f"{key}: here stand {', '.join(models)}"
            faults.append(DatabaseFault(path, _line_of(path, (str(key),)), said))
            continue
        for n, entry in enumerate(listed):
            try:
                entries.append((_valid(path, entry, models[key], (key, n)), _line_of(path, (key, n))))
            except DatabaseFault as fault:
                faults.append(fault)
    return entries, faults


def _read(path: Path, model: type[T]) -> T:
    return _valid(path, _parsed(path), model)


def _parsed(path: Path) -> Any:
    """Return what a YAML file holds; raises DatabaseFault."""
    from ruamel.yaml import YAML
    from ruamel.yaml.error import MarkedYAMLError, YAMLError

    try:
        return YAML(typ="safe").load(path.read_text(encoding="utf-8"))
    except MarkedYAMLError as error:
        mark = error.problem_mark
        raise DatabaseFault(path, mark.line + 1 if mark else None, str(error.problem)) from None
    except (YAMLError, UnicodeDecodeError, OSError) as error:
        raise DatabaseFault(path, None, str(error).splitlines()[0]) from None


def _valid(path: Path, data: Any, model: type[T], place: Place = ()) -> T:
    """Return data of a file as a model; raises DatabaseFault. ``place`` is where the data stand in the file."""
    try:
        return TypeAdapter(model).validate_python(data)
    except ValidationError as error:
        first = error.errors()[0]
        line = _line_of(path, (*place, *first["loc"]))
        raise DatabaseFault(path, line, f"{_place(data, first)}{first['msg']}") from None


def _line_of(path: Path, place: Place) -> int | None:
    """Return the line of a place in a file by walking the YAML once more with its line marks."""
    from ruamel.yaml import YAML

    node = YAML(typ="rt").load(path.read_text(encoding="utf-8"))
    line: int | None = 1
    for step in place:
        try:
            marks = node.lc
            line = (marks.key(step) if isinstance(step, str) else marks.item(step))[0] + 1
            node = node[step]
        except (AttributeError, KeyError, TypeError, IndexError):
            break
    return line


def _place(data: object, fault: ErrorDetails) -> str:
    """Name the parameter or rule a fault lies in, and the key."""
    where, node = [str(data["id"])] if isinstance(data, dict) and "id" in data else [], data
    for step in fault["loc"]:
        try:
            node = node[step]  # type: ignore[index]  # walks plain YAML of unknown shape
        except (KeyError, TypeError, IndexError):
            where.append(str(step))
            break
        if isinstance(node, dict) and "id" in node:
            where = [str(node["id"])]
        elif isinstance(step, str):
            where.append(step)
    return ": ".join(where) + ": " if where else ""


def _content_key(files: list[Path]) -> str:
    digest = hashlib.sha256()
    for path in [Path(__file__).with_name("model.py"), *files]:
        content = path.read_bytes()
        digest.update(f"{path.name}:{len(content)}:".encode())
        digest.update(content)
    return digest.hexdigest()[:24]


def _keep(cached: Path, compiled: Compiled) -> None:
    """Write the cache file; a cache that cannot be written costs time only."""
    name = ""
    try:
        cached.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=cached.parent, suffix=".tmp")
        with os.fdopen(handle, "w", encoding="utf-8") as stream:
            stream.write(compiled.model_dump_json(exclude_defaults=True))
        os.replace(name, cached)
        for old in cached.parent.glob(f"{cached.name.rsplit('-', 1)[0]}-*.json"):
            if old != cached:
                old.unlink(missing_ok=True)
    except OSError:
        if name:
            with contextlib.suppress(OSError):
                os.unlink(name)
