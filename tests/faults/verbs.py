"""Fails every call of the system that a writing verb makes in its folder, one run a call,
and looks what it left behind.
"""

import errno
import os
import random
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from tempfile import gettempdir

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
LOOKS, LOCKS = ("stat64", "lstat64", "fstat64"), (".lock", ".holder")
ERRORS = (errno.ENOSPC, errno.EIO, errno.EACCES, errno.EDQUOT, errno.EROFS)

VERBS: tuple[tuple[str, ...], ...] = (
    ("set", "mill.amp", "1350=7 ipm"),
    ("new", "9pc", "new.amp", "--axes", "X,Y"),
    ("fix", "lathe.amp"),
    ("guide", "mill.amp", "--done", "dual"),
    ("note", "mill.amp", "1300", "measured on Monday"),
    ("axis", "mill.amp", "swap", "1", "2"),
    ("calibrate", "mill.amp", "--axis", "X", "--from", "laser.csv", "--sign", "measured-target"),
    ("sheet", "mill.amp", "--against", "ours.amp", "--tick", "1300"),
    ("merge", "mill.amp", "mill.amp", "ours.amp", "-o", "merged.amp"),
    ("import", "values.csv", "-o", "imported.amp", "--family", "9pc"),
    ("export", "mill.amp", "-o", "out.csv"),
    ("diff", "mill.amp", "ours.amp", "-o", "differences.csv"),
    ("compare", "mill.amp", "ours.amp", "-o", "machines.csv"),
    ("form", "9pc", "--machine", "mill", "-o", "form.csv"),
    ("guide", "mill.amp", "-o", "steps.txt"),
    ("sheet", "mill.amp", "--against", "ours.amp", "-o", "sheet.txt"),
    ("picture", "mill.amp", "ramps", "-o", "ramps.svg"),
    ("report", "mill.amp", "-o", "report.txt"),
    ("report", "mill.amp", "-o", "report.html"),
    ("report", "mill.amp", "-o", "report.pdf"),
    ("simulate", "mill.amp", "step", "--axis", "1", "-o", "step.csv"),
    ("simulate", "mill.amp", "step", "--axis", "1", "-o", "step.svg"),
)
"""Every verb that writes files and needs no control."""


def compiler() -> str | None:
    """Return the C compiler that the failing calls are made with; None where there is none."""
    return shutil.which("cc") if sys.platform == "linux" else None


@cache
def library() -> str:
    """Return the library that is loaded before the program, so that its calls fail."""
    source = Path(__file__).with_name("failing_calls.c")
    library = Path(gettempdir()) / f"amp-studio-failing-calls-{os.getpid()}.so"
    subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", library, source, "-ldl"], check=True)
    return str(library)


def fail_each_call(
    verb: tuple[str, ...], seed: int, folder: Path, most: int | None = None
) -> tuple[int, list[str]]:
    """Run a verb with its first call failing, its second, and so on; returns how many runs,
    and what was not true of them.

    The error and whether all later calls fail too are chosen by the seed; ``most`` ends it earlier.
    """
    chance, found, at = random.Random(f"{seed} {verb}"), [], 0
    wanted = _wanted(verb, folder / "whole")
    while most is None or at < most:
        at += 1
        work = folder / f"run-{at}"
        lay_out(work)
        number, for_ever = chance.choice(ERRORS), chance.random() < 0.3
        log = folder / f"log-{at}"
        env = {
            "LD_PRELOAD": library(),
            "FAULT_FOLDER": str(work),
            "FAULT_AT": str(at),
            "FAULT_ERRNO": str(number),
            "FAULT_LOG": str(log),
        } | ({"FAULT_FOREVER": "1"} if for_ever else {})
        before = contents(work)
        code, message = _run(verb, work, env)
        lines = log.read_text(encoding="utf-8").splitlines() if log.exists() else []
        failed = [(call, Path(path).name) for _, call, path in (line.split(" ", 2) for line in lines)]
        how = (
            f"{' '.join(verb)}, seed {seed}, call {at} ({failed[:1]}, {os.strerror(number)}, for ever:"
            f" {for_ever})"
        )
        found += [
            f"{how}: {what}" for what in _violations(code, message, before, contents(work), wanted, failed)
        ]
        shutil.rmtree(work)
        if not failed:
            return at, found
    return at, found


def lay_out(work: Path) -> None:
    """Make the folder in which a verb works."""
    work.mkdir(parents=True)
    source = _prepared()
    for path in source.iterdir():
        shutil.copy(path, work / path.name)


@cache
def _prepared() -> Path:
    folder = Path(gettempdir()) / f"amp-studio-faults-prepared-{os.getpid()}"
    folder.mkdir(exist_ok=True)
    shutil.copy(EXAMPLES / "mill-1394" / "MILL_1394.amp", folder / "mill.amp")
    shutil.copy(EXAMPLES / "mill-1394" / "laser-x.csv", folder / "laser.csv")
    shutil.copy(folder / "mill.amp", folder / "ours.amp")
    for verb in (
        ("set", "ours.amp", "1300=3"),
        ("new", "9pc", "lathe.amp"),
        ("export", "mill.amp", "-o", "values.csv"),
    ):
        assert _run(verb, folder, {})[0] == 0
    for name in ("ours.amp.bak", "ours.amp.history"):
        (folder / name).unlink()
    return folder


def _run(verb: tuple[str, ...], work: Path, env: dict[str, str]) -> tuple[int, str]:
    ended = subprocess.run(
        [
            sys.executable,
            "-m",
            "amp_studio.cli",
            verb[0],
            *(str(work / word) if re.fullmatch(r"[a-z]+\.[a-z]+", word) else word for word in verb[1:]),
        ],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | env,
        timeout=120,
    )
    return ended.returncode, ended.stderr


def target_of(before: dict[str, bytes], after: dict[str, bytes]) -> str | None:
    """Return the file that a verb writes: the one that has changed, besides its backup and its history."""
    changed = (name for name in after if after[name] != before.get(name))
    return next((name for name in changed if not name.endswith((".bak", ".history"))), None)


def contents(work: Path) -> dict[str, bytes]:
    """Return the content of every file in a folder."""
    return {path.name: path.read_bytes() for path in work.iterdir() if path.is_file()}


def _wanted(verb: tuple[str, ...], work: Path) -> dict[str, bytes]:
    """Return what the folder contains after the verb when nothing fails."""
    lay_out(work)
    code, message = _run(verb, work, {})
    assert code in (0, 1), message
    return contents(work)


def _violations(
    code: int,
    message: str,
    before: dict[str, bytes],
    after: dict[str, bytes],
    wanted: dict[str, bytes],
    failed: list[tuple[str, str]],
) -> Iterator[str]:
    """Yield what is not as promised."""
    target = target_of(before, wanted)
    assert target is not None
    if "Traceback" in message or "ignored" in message:
        yield message
    changed = after.get(target) != before.get(target)
    # A report has a note where the rules of the builder, or for the checksum the file once more, cannot be
    # read.
    said_so = any(
        words in after.get(target, b"") for words in (b"rules.yaml", b"the file on disk cannot be read")
    )
    if changed and not said_so and not _alike(after.get(target, b""), wanted[target]):
        yield f"{target} is neither the old nor the new one"
    if code == 2 and changed:
        yield f"exit 2, and {target} was changed: {message}"
    if code == 3 and before == after:
        yield f"exit 3, and nothing was changed: {message}"
    if code in (0, 1) and not changed:
        yield f"exit {code}, and {target} was not changed"
    if code not in (0, 1, 2, 3):
        yield f"exit {code}: {message}"
    if code in (2, 3) and len(message.strip().splitlines()) != 1:
        yield f"not one line: {message!r}"
    for name, content in before.items():
        if name != target and after.get(name) != content:
            yield f"{name} was changed"
    if changed and f"{target}.bak" in wanted and after.get(f"{target}.bak") != before[target]:
        yield "the backup is not the previous file"
    may_be_new = {*before, *wanted, f"{target}.bak"} if code != 2 else set(before)
    left = [name for name in after if name not in may_be_new]
    # What cannot be removed stays; a lock that cannot be examined may be another program's, and is left
    # alone, and a backup where it cannot be examined whether its file was replaced.
    kept_by = {name for call, name in failed if call == "unlink" or (call in LOOKS and name.endswith(LOCKS))}
    kept_by |= {f"{target}.bak" for call, name in failed if call in LOOKS and name.endswith(".tmp")}
    if not kept_by >= set(left):
        yield f"left behind: {left}"


def _alike(a: bytes, b: bytes) -> bool:
    """Return whether two contents are the same but for times and the names of folders in them."""
    return _timeless(a) == _timeless(b)


def _timeless(content: bytes) -> bytes:
    content = re.sub(rb"20\d\d-\d\d-\d\d[T ]\d\d:\d\d(:\d\d)?([+-]\d\d:\d\d|Z)?", b"", content)
    content = re.sub(rb"/[^\s<\"]*/(whole|run-\d+)/", b"", content)
    return b"%PDF" if content.startswith(b"%PDF") and content.rstrip().endswith(b"%%EOF") else content


def fail_calls(seed: int, runs: int, folder: Path) -> list[str]:
    """Fail the calls of the writing verbs; ``runs`` under the number of verbs:
    the first few calls of one of them.
    """
    if compiler() is None:
        return []
    if runs < len(VERBS):
        return fail_each_call(VERBS[0], seed, folder, runs)[1]
    found = []
    for number, verb in enumerate(VERBS):
        tried, violations = fail_each_call(verb, seed, folder / str(number))
        found += violations
        print(f"  {' '.join(verb)}: {tried} calls, {len(violations)} violations", file=sys.stderr)
    return found
