"""What ``validate`` printed of files, kept between runs: a file is not checked again while nothing has
changed that its result depends on.

A result is found by a digest over all that it depends on: this program with its facts, Python and the
installed packages; what was asked for; the file, the rules beside it and what it is compared with. There is
one database for each state of the program, in the user's cache folder. Its content is never trusted: a result
that is not as it was kept is made again, as is a database that another program wrote or that cannot be read.
A cache that cannot be written costs time only.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import sqlite3
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

from amp_studio.cli.verb import Options
from amp_studio.family_places import installed_places
from amp_studio.files import is_there, origin_named, real_path
from amp_studio.schema import added_facts, cache_folder, database_folder, read_file
from amp_studio.validate import RULES_FILE, companion_names, companions_of, machines_of

from .formats import CHECK_FORMATS, CheckResult

_OWN_OPTIONS = ("paths", "jobs", "no_cache")
"""Options that change no result of a file."""
_MAX_BYTES = 256 * 2**20
"""Of a database, after which only the results of the present run stay in it."""
_AT_ONCE = 500
"""Results that are asked for in one query."""
_LONG_NAME = 60
"""Characters of a name from which those of the files beside it may be too long."""
_PATIENCE_S = 5.0
"""Seconds for another run that writes."""


class _Folder(NamedTuple):
    """What a folder of files contained when it was listed."""

    real: str
    links: Mapping[str, bool]
    """Name -> whether it is a link."""
    machines: tuple[str, ...]
    """The parameter files that are compared with each other."""


class CheckCache:
    """The results that are kept for what a run was asked."""

    def __init__(self, options: Options) -> None:
        given = {name: str(value) for name, value in vars(options).items() if name not in _OWN_OPTIONS}
        # Where a format shortens paths to the present folder, its result is one of that folder.
        here = str(Path.cwd()) if CHECK_FORMATS[options.format].from_here else ""
        self._asked = json.dumps([given, here], sort_keys=True).encode()
        self._rules: Path | None = options.rules
        self._companions: dict[str, bytes] = {}
        self._folders: dict[str, _Folder] = {}
        self._known_rules: dict[str, bytes] = {}
        """File of rules -> what its rules add to a key; a folder of machines has one for all."""
        self._path = cache_folder() / f"checks-{_program_digest()}.sqlite"

    def keys(self, paths: Iterable[Path]) -> list[bytes | None]:
        """Return what the result of each file is found by now; None for a file that cannot be read."""
        self._known_rules.clear()
        self._companions.clear()
        self._folders.clear()
        return [self._key(path) for path in paths]

    def _key(self, path: Path) -> bytes | None:
        """Return what the result of a file is found by; None for a file that cannot be read."""
        text = os.fspath(path)
        try:
            content = read_file(path)
            parent, name = os.path.split(text)  # of thousands of files a Path for each step counts
            folder = self._folder(parent or os.curdir)
            if folder.links.get(name, True) or len(name) > _LONG_NAME:
                # A link leads to another folder; a name that is not listed may be another spelling of one
                # that is.
                real = os.fspath(real_path(path).parent)
                beside = [self._companion(os.fspath(other)) for other in companions_of(path)]
            else:
                real = folder.real
                beside = [
                    self._companion(f"{folder.real}{os.sep}{other}") if other in folder.links else b""
                    for other in companion_names(name, folder.machines)
                ]
            rules = self._rules_part(os.fspath(self._rules or f"{real}{os.sep}{RULES_FILE}"))
            if (origin := origin_named(content, real)) is not None:
                beside.append(self._companion(os.fspath(origin)))
        except OSError:
            return None
        return _digest(self._asked, os.fsencode(text), rules, content, *beside)

    def _folder(self, folder: str) -> _Folder:
        """Return what a folder contains, listed once for all of its files; raises OSError."""
        known = self._folders.get(folder)
        if known is None:
            real = real_path(Path(folder))
            with os.scandir(real) as entries:
                links = {entry.name: entry.is_symlink() for entry in entries}
            known = self._folders[folder] = _Folder(os.fspath(real), links, machines_of(real))
        return known

    def _companion(self, path: str) -> bytes:
        """Return what a file that another one is compared with adds to its key."""
        if path not in self._companions:
            other = Path(path)
            self._companions[path] = _digest(read_file(other)) if is_there(other) else b""
        return self._companions[path]

    def _rules_part(self, rules: str) -> bytes:
        """Return what rules add to a key: their place, which findings name, and their content;
        raises OSError.
        """
        if rules not in self._known_rules:
            path = Path(rules)
            self._known_rules[rules] = _digest(os.fsencode(rules), read_file(path)) if is_there(path) else b""
        return self._known_rules[rules]

    def read(self, keys: Sequence[bytes | None], paths: Sequence[Path]) -> dict[Path, CheckResult]:
        """Return the results that are kept."""
        found: dict[Path, CheckResult] = {}
        by_key = {key: path for key, path in zip(keys, paths, strict=True) if key is not None}
        try:
            with self._database() as database:
                for key, seal, kept in _rows(database, list(by_key)):
                    # A result that was altered, or lies under the key of another, has another seal.
                    if seal == _digest(key, kept):
                        found[by_key[key]] = _result(by_key[key], kept)
        # Whatever is wrong with it: what it contained is worked out again.
        except (sqlite3.Error, OSError, ValueError, TypeError):
            self._remove()
            return {}
        return found

    def write(self, results: Mapping[bytes, CheckResult], used: Iterable[bytes | None]) -> None:
        """Keep results; of a database that has become large, only those and the ones that were ``used``
        stay.
        """
        if not results:
            return
        rows = [(key, _digest(key, kept), kept) for key, one in results.items() for kept in [_kept(one)]]
        with contextlib.suppress(sqlite3.Error, OSError), self._database() as database:
            with database:
                database.executemany("INSERT OR REPLACE INTO result VALUES (?, ?, ?)", rows)
            if self._path.stat().st_size > _MAX_BYTES:
                _shrink(database, {*results, *used})
        self._remove_older()

    @contextlib.contextmanager
    def _database(self) -> Iterator[sqlite3.Connection]:
        """Open the database, which is made where there is none; raises sqlite3.Error, OSError."""
        self._path.parent.mkdir(parents=True, exist_ok=True)
        if not self._path.exists():
            os.close(os.open(self._path, os.O_CREAT | os.O_RDWR, 0o600))  # what it contains is of the files
        with contextlib.closing(sqlite3.connect(self._path, timeout=_PATIENCE_S)) as database:
            # What is lost with the power is made again.
            database.execute("PRAGMA synchronous = OFF")
            database.execute(
                "CREATE TABLE IF NOT EXISTS result (key BLOB PRIMARY KEY, seal BLOB, kept BLOB) WITHOUT ROWID"
            )
            yield database

    def _remove(self) -> None:
        """Remove a database that cannot be used."""
        with contextlib.suppress(OSError):
            self._path.unlink()

    def _remove_older(self) -> None:
        """Remove what other states of the program left."""
        with contextlib.suppress(OSError):
            for old in self._path.parent.glob("checks-*.sqlite*"):
                if not old.name.startswith(self._path.name):
                    old.unlink(missing_ok=True)


def _rows(database: sqlite3.Connection, keys: Sequence[bytes]) -> Iterator[tuple[bytes, bytes, bytes]]:
    for begin in range(0, len(keys), _AT_ONCE):
        some = keys[begin : begin + _AT_ONCE]
        marks = ", ".join("?" * len(some))
        yield from database.execute(f"SELECT key, seal, kept FROM result WHERE key IN ({marks})", some)  # noqa: S608  # only question marks are put in


def _shrink(database: sqlite3.Connection, stay: set[bytes | None]) -> None:
    """Leave the results in a database that ``stay``."""
    keys = [row[0] for row in database.execute("SELECT key FROM result")]
    with database:
        database.executemany("DELETE FROM result WHERE key = ?", [(key,) for key in keys if key not in stay])
    database.execute("VACUUM")


def _kept(one: CheckResult) -> bytes:
    return json.dumps([one.errors, one.printed, *one.notes]).encode()


def _result(path: Path, kept: bytes) -> CheckResult:
    errors, printed, *notes = json.loads(kept)
    return CheckResult(path, errors, printed, tuple(notes))


def _program_digest() -> str:
    """Return a digest over every module and every fact, Python, and the packages that are installed with
    it.
    """
    contents = [part for folder in _program_folders() for part in _contents(folder)]
    sites = [Path(entry) for entry in sys.path if entry.endswith("-packages")]
    # The name of such a folder has the version of the package in it.
    packages = sorted(path.name for site in sites for path in site.glob("*.dist-info"))
    named = json.dumps([sys.version, sorted(added_facts()), packages])
    return _digest(named.encode(), *contents).hex()[:24]


def _program_folders() -> list[Path]:
    """Return the folders of modules and facts, those of families of other packages too."""
    other = dict.fromkeys(place.partition(":")[0].partition(".")[0] for place in installed_places().values())
    specs = [spec for name in other if (spec := find_spec(name)) is not None]
    packages = [
        Path(path) for spec in specs for path in spec.submodule_search_locations or [str(spec.origin)]
    ]
    return [Path(__file__).parents[2], database_folder(), *packages, *added_facts().values()]


def _contents(folder: str | Path) -> Iterator[bytes]:
    """Yield name and content of the modules and facts of a folder, or of one module,
    in the order of their names.
    """
    if Path(folder).is_file():
        yield os.fsencode(folder)
        yield Path(folder).read_bytes()
        return
    with os.scandir(folder) as found:
        entries = sorted(found, key=lambda entry: entry.name)
    for entry in entries:
        if entry.is_dir():
            yield from _contents(entry.path)
        # Templates and texts of the window are in no result of ``validate``.
        elif entry.name.endswith((".py", ".yaml")):
            yield entry.path.encode()
            yield Path(entry.path).read_bytes()


def _digest(*parts: bytes) -> bytes:
    """Return a digest over parts, of which none can be taken for another: their lengths are before them."""
    lengths = b",".join([b"%d" % len(part) for part in parts])
    return hashlib.sha256(b"".join((lengths, b":", *parts))).digest()
