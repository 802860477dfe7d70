"""Range, choice, state and cross-parameter findings."""

from __future__ import annotations

import gc
import os
import re
import signal
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import cache, partial
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

from amp_studio.cli.arguments import TEXT, count, is_folder, path_of
from amp_studio.cli.console import print_remark, progress
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.verb import Options, Verb, VerbArgument
from amp_studio.trouble import keep_details

if TYPE_CHECKING:
    from multiprocessing.context import BaseContext

    from amp_studio import MachineParameters
    from amp_studio.cli.checks.cache import CheckCache
    from amp_studio.cli.checks.formats import CheckFormat, CheckResult, FileFindings
    from amp_studio.validate import KeptValidators, Validator

FORMATS = ("text", "json", "sarif", "github", "junit")
"""What is printed; here, because help loads no room (a test compares them)."""

VERB = Verb(
    __doc__,
    VerbArgument("paths", nargs="+", type=path_of, metavar="PATH", help="files, or folders of files"),
    VerbArgument(
        "--jobs", type=count, metavar="N", help="processes that share many files (one for each processor)"
    ),
    VerbArgument(
        "--rules", type=path_of, help="a builder's own rules instead of the rules.yaml beside the file"
    ),
    VerbArgument(
        "--motion", action="store_true", help="check the machine in motion too, as check does (text and JSON)"
    ),
    VerbArgument("--why", action="store_true", help="explain each finding: its rule, the values, the page"),
    VerbArgument("--no-cache", action="store_true", help="check every file, also one whose result is kept"),
    VerbArgument(
        "--format",
        choices=FORMATS,
        default="text",
        help="text, JSON, SARIF 2.1.0, GitHub's workflow commands, or JUnit's XML (default: text)",
    ),
    VerbArgument(
        "--json", dest="format", action="store_const", const="json", help="the same as --format json"
    ),
    *TEXT,
    examples=(
        "amp-studio validate MILL_1394.amp",
        "amp-studio validate MILL_1394.amp --why --json",
        "amp-studio validate MILL_1394.amp --format sarif",
    ),
)

MANY = 50
"""From so many files on it pays to start more processes."""

FAMILIES = 3
"""From so many families on it pays with fewer files too: what takes time is to load a family."""

_STARTS_AT_ONCE = sys.platform == "linux"
"""Whether another process is a copy of this one with all that it has loaded: the program has one thread. On
macOS libraries of the system may not be used in such a copy."""

_FAMILY = re.compile(rb"^family:[ \t]*(.+?)[ \t]*\r?$", re.MULTILINE)

MAX_PROCESSES = 61
"""Processes that Windows lets one wait for."""

AT_A_TIME = 16
"""Files a process is handed at once; of few files each one gets its share."""

_LOOKED_INTO = 20
"""Files of a folder without parameter files of which one may be a control's own text."""

_NAME_ONE = "name a copy of what a control contained by itself: "

WITH_REASONS = ("text", "json")
"""Formats with a place for what ``--why`` explains."""


def run(options: Options) -> int:
    """Check files, and those in folders: 1 where there are errors, 2 where a file cannot be read,
    after the others.
    """
    from amp_studio.cli.checks.formats import CHECK_FORMATS

    _check_options(options)
    form = CHECK_FORMATS[options.format]
    paths, unread = _files(options.paths)
    check = partial(_check, options, len(paths) > 1)
    is_counted = len(paths) > 1 and (form.needs_all or not sys.stdout.isatty())
    checked = []
    for one in chain(_counted(_results(options, check, paths), len(paths) if is_counted else 0), unread):
        checked.append(one)
        _print(form, one)
    if form.needs_all and paths:
        is_alone = form.alone and paths == options.paths[:1]
        _print_document(checked[0].printed if is_alone else form.all(checked), form)
    return _exit_code(checked)


def _exit_code(checked: Sequence[CheckResult]) -> int:
    return 2 if any(one.fault for one in checked) else int(any(one.errors for one in checked))


def _check_options(options: Options) -> None:
    from amp_studio.schema import read_file

    if (options.why or options.motion) and options.format not in WITH_REASONS:
        option = "why" if options.why else "motion"
        raise UsageError(f"--{option} is for the formats {' and '.join(WITH_REASONS)}")
    if options.rules:
        read_file(options.rules)  # one that is not there is a slip of the hand, one that is wrong a finding


def _counted(results: Iterator[CheckResult], total: int) -> Iterator[CheckResult]:
    """Yield results; how many of a total there are is shown after each, unless the total is 0."""
    show = progress() if total else None
    for n, one in enumerate(results, 1):
        yield one
        if show:
            show("checked", n, total)


def _print_document(document: str, form: CheckFormat) -> None:
    """Print the one document about all files, as far as the terminal can show its characters."""
    is_utf8 = (sys.stdout.encoding or "").lower() == "utf-8"
    if document:
        print(document if is_utf8 else form.in_ascii(document))


def _results(
    options: Options, check: Callable[[Path], CheckResult], paths: Sequence[Path]
) -> Iterator[CheckResult]:
    """Yield the results of files in their order; those of several are kept for the next run."""
    if len(paths) < 2 or options.no_cache or options.motion:
        yield from _results_in_order(check, paths, options.jobs)
        return
    from amp_studio.cli.checks.cache import CheckCache  # a file alone is checked before its database is open

    cache = CheckCache(options)
    keys = cache.keys(paths)
    kept = cache.read(keys, paths)
    fresh = _results_in_order(check, [path for path in paths if path not in kept], options.jobs)
    made: list[CheckResult] = []
    for path in paths:
        if path in kept:
            yield kept[path]
        else:
            made.append(next(fresh))
            yield made[-1]
    _keep(cache, made, dict(zip(paths, keys, strict=True)))


def _keep(cache: CheckCache, made: Sequence[CheckResult], keys: Mapping[Path, bytes | None]) -> None:
    """Keep new results; a file that was changed while it was checked has that of one content or the other."""
    unchanged = {
        key: one
        for one, key in zip(made, cache.keys(one.path for one in made), strict=True)
        if key and key == keys[one.path] and not one.fault
    }
    cache.write(unchanged, used=keys.values())


def _print(form: CheckFormat, one: CheckResult) -> None:
    """Print the notes and the fault of a file, and its result where that need not wait for the others."""
    for text in (*one.notes, *([f"amp-studio: {one.fault}"] if one.fault else [])):
        print_remark(text)
    if not form.needs_all and (text := form.line_of(one)):
        print(text)


def _files(paths: Sequence[Path]) -> tuple[list[Path], list[CheckResult]]:
    """Return files as they are named, those in folders in the order of their names,
    and which folders cannot be read.
    """
    from amp_studio.cli.checks.formats import CheckResult
    from amp_studio.files import ENDING, is_of_machine

    found: list[Path] = []
    unread: list[CheckResult] = []
    copies: list[Path] = []

    def skip(error: OSError) -> None:
        folder = Path(error.filename)
        unread.append(CheckResult(folder, fault=f"{folder}: cannot be read: {error.strerror}"))

    for path in paths:
        if not is_folder(path):
            found.append(path)
            continue
        before = len(unread)
        names = ((folder, name) for folder, _, names in os.walk(path, onerror=skip) for name in names)
        files = sorted(
            (Path(folder, name) for folder, name in names if name.endswith(ENDING)), key=lambda f: f.parts
        )
        inside = [file for file in files if is_of_machine(file.name)]
        kept = [file for file in files if not is_of_machine(file.name)]
        if inside:
            copies += kept
        elif before == len(unread):
            instead = f" of machines; {_NAME_ONE}{kept[0]}" if kept else _texts_in(path)
            unread.append(CheckResult(path, fault=f"{path}: contains no {ENDING} files{instead}"))
        found += inside
    if copies:
        print_remark(f"left out: {len(copies)}; {_NAME_ONE}{copies[0]}")
    return found, unread


def _texts_in(folder: Path) -> str:
    """Return how to check a control's own texts in a folder without parameter files; "" where the first of
    its files are none.
    """
    from amp_studio.files import ParameterFileError
    from amp_studio.formats import is_text_of_control

    with suppress(OSError, ParameterFileError):
        for each in sorted(folder.iterdir())[:_LOOKED_INTO]:
            if each.is_file() and is_text_of_control(each):
                return f"; name a control's own text by itself: {each}"
    return ""


def _results_in_order(
    check: Callable[[Path], CheckResult], paths: Sequence[Path], jobs: int | None
) -> Iterator[CheckResult]:
    """Yield the results of files, in their order, whichever process is ready first."""
    workers = min(MAX_PROCESSES, jobs or os.cpu_count() or 1)
    if jobs is None and len(paths) < MANY:
        shares = _by_family(paths) if workers > 1 and _STARTS_AT_ONCE else []
        if len(shares) < FAMILIES:
            yield from map(check, paths)
            return
        own = _check_each(check, shares.pop())  # which loads what a check of any family needs
        done = {one.path: one for one in (*own, *_shared(check, shares, min(workers, len(shares))))}
        yield from (done[path] for path in paths)
    elif workers == 1:
        yield from map(check, paths)
    else:
        # Rounded up: of few files each process gets one share.
        size = min(AT_A_TIME, -(-len(paths) // workers))
        yield from _shared(check, [paths[n : n + size] for n in range(0, len(paths), size)], workers)


def _by_family(paths: Sequence[Path]) -> list[list[Path]]:
    """Return files by their family, which a process then loads once; what takes most first, by its length,
    and before it what names no family.
    """
    from amp_studio.schema import read_file

    shares: dict[bytes, list[Path]] = {}
    sizes: dict[bytes, int] = {}
    for path in dict.fromkeys(paths):
        try:
            content = read_file(path)
        except OSError:
            content = b""  # its check reports it
        found = _FAMILY.search(content)
        family = found[1] if found else b""
        shares.setdefault(family, []).append(path)
        sizes[family] = sizes.get(family, 0) + len(content)
    order = sorted(shares, key=lambda family: (not family, sizes[family]), reverse=True)
    return [shares[family] for family in order]


def _shared(
    check: Callable[[Path], CheckResult], shares: Sequence[Sequence[Path]], workers: int
) -> Iterator[CheckResult]:
    """Yield the results of shares of files, in their order."""
    from concurrent.futures.process import (  # a single file need not wait
        BrokenProcessPool,
        ProcessPoolExecutor,
    )

    from amp_studio.cli.checks.formats import CheckResult

    left = list(shares)
    while left:
        try:
            with ProcessPoolExecutor(workers, _context(), initializer=_start) as pool:
                for results in pool.map(partial(_check_each, check), left):
                    # Before they are handed out: where a process ends after this, what is left is checked
                    # again, and nothing twice.
                    left.pop(0)
                    yield from results
        except BrokenProcessPool:  # one of the next files ended its process, for want of memory
            for path in left.pop(0):  # each gets its own
                try:
                    with ProcessPoolExecutor(1, _context(), initializer=_start) as pool:
                        yield pool.submit(check, path).result()
                except BrokenProcessPool:
                    yield CheckResult(path, fault=f"{path}: its check was ended from outside")


def _context() -> BaseContext | None:
    """Return how processes are started: as copies of this one if the system allows it."""
    if not _STARTS_AT_ONCE:
        return None
    import multiprocessing

    return multiprocessing.get_context("fork")


def _check_each(check: Callable[[Path], CheckResult], paths: Sequence[Path]) -> list[CheckResult]:
    return [check(path) for path in paths]


def _start() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the code that waits for the processes ends them
    # A copy shares the memory of this process until it writes there: a collection would write to every
    # object.
    gc.freeze()


def _check(options: Options, is_listed: bool, path: Path) -> CheckResult:
    """Check one file; whatever is wrong with it ends no other's check."""
    from amp_studio.cli.checks.formats import CHECK_FORMATS, CheckResult
    from amp_studio.files import ParameterFileError

    notes: list[str] = []
    try:
        machine = opened(path, options, notes.append)
        own = machine.builder_rules(options.rules)
        with _kept_validators().validator_of(machine.file, machine.source, own) as validator:
            checked = _checked(path, validator, options.why, is_listed)
            bad = 0
            if options.motion:
                found, bad = _in_motion(machine, as_document=options.format == "json")
                checked = replace(checked, motion=found)
            printed = CHECK_FORMATS[options.format].one(checked)
            return CheckResult(path, checked.counts["error"] + bad, printed, tuple(notes))
    except ParameterFileError as fault:
        return CheckResult(path, notes=tuple(notes), fault=str(fault), line=fault.line)
    except UsageError as fault:
        return CheckResult(path, notes=tuple(notes), fault=str(fault))
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # a panic of the rule engine is no Exception
        return CheckResult(path, notes=tuple(notes), fault=f"{path}: {keep_details(error)}")


def _in_motion(machine: MachineParameters, *, as_document: bool) -> tuple[object, int]:
    """Return what the check of the motion found, as text or for a JSON document, and how much of it is
    bad.
    """
    from amp_studio.cli.motion.text import as_json, text
    from amp_studio.sim import SimulationError

    try:
        checks = machine.check_motion()
    except SimulationError as error:
        return (
            {"checks": [], "why": error.what} if as_document else f"not checked in motion: {error.what}"
        ), 0
    found = as_json(machine.file, checks) if as_document else text(machine.file, checks)
    return found, sum(check.verdict == "bad" for check in checks)


def _checked(path: Path, validator: Validator, why: bool, is_listed: bool) -> FileFindings:
    """Return the findings of a file, apart from those about values as delivered,
    of steps that are not reached.
    """
    from amp_studio.cli.checks.formats import FileFindings
    from amp_studio.guide import present

    return FileFindings(path, validator, present(validator, validator.findings()), why, is_listed)


@cache
def _kept_validators() -> KeptValidators:
    """Return the validators of the files that this process has checked."""
    from amp_studio.validate import KeptValidators

    return KeptValidators()
