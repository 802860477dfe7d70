"""The verb that checks parameter files."""

from __future__ import annotations

import argparse
import gc
import os
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from amp_studio.files import ENDING, ParameterFile, ParameterFileError
from amp_studio.report import alike, counted, finding_json, same_finding_text, suppressed_text
from amp_studio.schema.regular_file import read_file
from amp_studio.validate import BuilderRules, Finding, Validator, rules_beside

from .console import note, print_json, progress
from .opened import opened
from .trouble import keep_details

MANY = 50
"""From so many files on it pays to start more processes."""
MOST = 61
"""Processes that Windows lets one wait for."""
AT_A_TIME = 8
"""Files a process is handed at once."""


class CheckResult(NamedTuple):
    """The result of one file; passes from one process to another."""

    path: Path
    errors: int = 0
    result: Any = None
    """Text, or the JSON document."""
    fault: str = ""
    """Why the file cannot be checked."""

    @property
    def json(self) -> Any:
        """An entry of the list of several files: the document, or why there is none."""
        return {"file": str(self.path), "error": self.fault} if self.fault else self.result


def validate_verb(options: argparse.Namespace) -> int:
    """Check files, and those in folders: 1 where there are errors, 2 where a file cannot be read, after the others."""
    if options.rules:
        read_file(
            options.rules
        )  # a file that is not there is a slip of the hand, one that is wrong a finding
    paths, unread = _files(options.paths)
    check = partial(_check, options)
    counts_shown = len(paths) > 1 and (options.json or not sys.stdout.isatty())
    show = progress() if counts_shown else None
    checked = []
    for n, one in enumerate(_each(check, paths, options.jobs), 1):
        checked.append(one)
        if one.fault:
            note(f"amp-studio: {one.fault}")
        elif not options.json:
            print(one.result)
        if show:
            show("checked", n, len(paths))
    for one in unread:
        checked.append(one)
        note(f"amp-studio: {one.fault}")
    good = [one for one in checked if not one.fault]
    if options.json and paths and paths != options.paths[:1]:
        print_json({"files": [one.json for one in checked]})
    elif options.json and good:
        print_json(good[0].result)
    return 2 if len(good) < len(checked) else int(any(one.errors for one in good))


def _files(paths: Sequence[Path]) -> tuple[list[Path], list[CheckResult]]:
    """Return files as they are named, those in folders in the order of their names, and which folders cannot be read."""
    found: list[Path] = []
    unread: list[CheckResult] = []

    def skip(error: OSError) -> None:
        folder = Path(error.filename)
        unread.append(CheckResult(folder, fault=f"{folder}: cannot be read: {error.strerror}"))

    for path in paths:
        if not _is_folder(path):
            found.append(path)
            continue
        before = len(unread)
        names = ((folder, name) for folder, _, names in os.walk(path, onerror=skip) for name in names)
        inside = sorted(Path(folder, name) for folder, name in names if name.endswith(ENDING))
        if not inside and before == len(unread):
            unread.append(CheckResult(path, fault=f"{path}: contains no {ENDING} files"))
        found += inside
    return found, unread


def _is_folder(path: Path) -> bool:
    """Return whether a path is a folder; what cannot be read is reported like an unreadable file."""
    try:
        return path.is_dir()
    except OSError:
        return False


def _each(
    check: Callable[[Path], CheckResult], paths: Sequence[Path], jobs: int | None
) -> Iterator[CheckResult]:
    """Yield the results of files, in their order, whichever process is ready first."""
    wanted = min(MOST, jobs or (os.cpu_count() or 1 if len(paths) >= MANY else 1))
    if wanted == 1:
        yield from map(check, paths)
        return
    from concurrent.futures.process import (  # a single file need not wait
        BrokenProcessPool,
        ProcessPoolExecutor,
    )

    left = list(paths)
    while left:
        try:
            with ProcessPoolExecutor(wanted, initializer=_start) as pool:
                for one in pool.map(check, left, chunksize=AT_A_TIME):
                    left.pop(0)
                    yield one
        except (
            BrokenProcessPool
        ):  # one of the next ones ended its process, for want of memory: each gets its own
            for _ in range(min(AT_A_TIME, len(left))):
                path = left.pop(0)
                try:
                    with ProcessPoolExecutor(1, initializer=_start) as pool:
                        yield pool.submit(check, path).result()
                except BrokenProcessPool:
                    yield CheckResult(path, fault=f"{path}: its check was ended from outside")


def _start() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the code that waits for the processes ends them
    gc.freeze()


def _check(options: argparse.Namespace, path: Path) -> CheckResult:
    """Check one file; whatever is wrong with it ends no other's check."""
    try:
        return _checked(options, path)
    except ParameterFileError as fault:
        return CheckResult(path, fault=str(fault))
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # a panic of the rule engine is no Exception
        return CheckResult(path, fault=f"{path}: {keep_details(error)}")


def _checked(options: argparse.Namespace, path: Path) -> CheckResult:
    file = opened(path)
    validator = Validator(file, _own_rules(options, path, file))
    findings = validator.run()
    counts = {s: sum(f.severity == s for f in findings) for s in ("error", "warning", "advice")}
    if not options.json:
        lines = _lines(validator, findings, counts, path, why=options.why)
        return CheckResult(path, counts["error"], "\n".join(lines))
    return CheckResult(path, counts["error"], {
        "file": str(path), "errors": counts["error"], "warnings": counts["warning"], "advice": counts["advice"],
        "findings": [_json(validator, f, options.why) for f in findings],
        "suppressed": [finding_json(file, s.finding) | {"by": s.suppression.by, "reason": s.suppression.reason}
                       for s in validator.suppressed]})  # fmt: skip


def _own_rules(options: argparse.Namespace, path: Path, file: ParameterFile) -> BuilderRules:
    if not options.rules:
        return rules_beside(path, file.schema)
    from amp_studio.validate import read_builder_rules

    return read_builder_rules(options.rules, file.schema)


def _json(validator: Validator, finding: Finding, why: bool) -> dict[str, Any]:
    found = finding_json(validator.file, finding)
    if why:
        from amp_studio.report import why_parts
        from amp_studio.validate import explain

        parts = why_parts(validator.file, finding, explain(validator, finding))
        found["why"] = [{"title": title, "text": text} for title, text, _ in parts]
    return found


def _reasons(validator: Validator, same: Sequence[Finding]) -> Iterator[str]:
    from amp_studio.report import why_text
    from amp_studio.validate import explain

    return (why_text(validator.file, finding, explain(validator, finding)) for finding in same)


def _lines(
    validator: Validator, findings: Sequence[Finding], counts: dict[str, int], path: Path, *, why: bool
) -> Iterator[str]:
    for same in alike(findings):
        yield same_finding_text(validator.file, same)
        if why:
            yield from _reasons(validator, same)
    for left in validator.suppressed:
        yield suppressed_text(validator.file, left)
    summary = ", ".join(counted(count, severity) for severity, count in counts.items())
    yield f"{path}: {summary}" + (f", {n} suppressed" if (n := len(validator.suppressed)) else "")
