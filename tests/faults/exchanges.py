"""Fails every call of the system that a verb makes in its folder while it exchanges with a control,
one run a call.

Afterwards the exit code is true of the control and of the folder,
and what was kept or fetched is whole or not there.
"""

import hashlib
import os
import random
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from tests.cli.stopped_exchanges import emulated

from .verbs import ERRORS, EXAMPLES, LOCKS, compiler, contents, library

VERBS = ("download", "restore", "upload as image", "upload as file")
MAX_EXCHANGES = 200
"""Calls of one verb; the longest has some 70."""
NAMES = ("one", "other")


def fail_calls_of_exchanges(seed: int, runs: int, folder: Path) -> list[str]:
    """Fail the calls of so many verbs, beginning with that of the seed; returns what was not true."""
    if compiler() is None:
        return []
    found = []
    with emulated(folder / "control") as (_, address):
        ready = _ready(folder / "ready", address)
        for number in range(runs):
            verb = VERBS[(seed + number) % len(VERBS)]
            tried, faults = _fail_each(verb, seed, folder, ready, address)
            found += faults
            print(f"  {verb}: {tried} calls, {len(faults)} violations", file=sys.stderr)
    return found


def _ready(folder: Path, address: str) -> dict[str, bytes]:
    """Return the files of the verbs: two parameter files that differ in one value,
    and their images with digests.
    """
    folder.mkdir()
    for name in NAMES:
        shutil.copy(EXAMPLES / "mill-1394" / "MILL_1394.amp", folder / f"{name}.amp")
    for arguments in (
        ("set", folder / "other.amp", "1300=3"),
        *(
            command
            for name in NAMES
            for command in (
                ("download", folder / f"{name}.amp", "--to", address, "--keep", folder.parent),
                ("upload", "--from", address, "-o", folder / f"{name}.img"),
            )
        ),
    ):
        code, text = _program(*arguments)
        assert code == 0, text
    wanted = {f"{name}.{ending}" for name in NAMES for ending in ("amp", "img", "img.sha256")}
    return {name: content for name, content in contents(folder).items() if name in wanted}


def _program(*arguments: object, **env: str) -> tuple[int, str]:
    command = [sys.executable, "-m", "amp_studio.cli", *map(str, arguments)]
    ended = subprocess.run(
        command, capture_output=True, text=True, check=False, env=os.environ | env, timeout=120
    )
    return ended.returncode, ended.stderr


def _fail_each(
    verb: str, seed: int, folder: Path, ready: dict[str, bytes], address: str
) -> tuple[int, list[str]]:
    """Run a verb with its first call failing, its second, and so on; returns how many runs,
    and what was not true of them.
    """
    found, active = list[str](), folder / "control" / "active.img"
    for at in range(1, MAX_EXCHANGES):
        chance = random.Random(f"{seed} {verb} {at}")
        work, log = folder / "work", folder / "log"
        work.mkdir()
        for name, content in ready.items():
            (work / name).write_bytes(content)
        old = active.read_bytes()
        other = "one" if old == ready["other.img"] else "other"
        command, made = {
            "download": (("download", work / f"{other}.amp", "--to", address), ""),
            "restore": (("restore", work / f"{other}.img", "--to", address), ""),
            "upload as image": (("upload", "--from", address, "-o", work / "x.img"), "x.img"),
            "upload as file": (("upload", "--from", address, "-o", work / "x.amp"), "x.amp"),
        }[verb]
        env = {
            "LD_PRELOAD": library(),
            "FAULT_FOLDER": str(work),
            "FAULT_AT": str(at),
            "FAULT_LOG": str(log),
            "FAULT_ERRNO": str(chance.choice(ERRORS)),
        } | ({"FAULT_FOREVER": "1"} if chance.random() < 0.3 else {})
        code, text = _program(*command, **env)
        failed = [line.split(" ", 2)[1:] for line in log.read_text().splitlines()] if log.exists() else []
        faults = _violations(code, text, old, active.read_bytes(), ready, contents(work), made, failed)
        found += [f"{verb}, seed {seed}, call {at} ({failed[:1]}, {env}): {fault}" for fault in faults]
        shutil.rmtree(work)
        log.unlink(missing_ok=True)
        if not failed:
            return at, found
    return MAX_EXCHANGES, [*found, f"{verb} makes no end of calls"]


def _violations(
    code: int,
    text: str,
    old: bytes,
    now: bytes,
    ready: dict[str, bytes],
    after: dict[str, bytes],
    made: str,
    failed: list[list[str]],
) -> Iterator[str]:
    """Yield what is not as promised."""
    is_changed = now != old
    copies = [name for name in after if ".before-" in name and name.endswith(".img")]
    if code not in (0, 2, 3) or "Traceback" in text:
        yield f"exit {code}: {text}"
    if is_changed and [after[name] for name in copies] != [old]:
        yield "the control was changed, and what it contained was not kept"
    if now not in (ready["one.img"], ready["other.img"]):
        yield "the control contains neither"
    for name in (*copies, *({made} & after.keys() if made.endswith(".img") else ())):
        digest = after.get(f"{name}.sha256", b"")
        if after[name] != old or digest[:64].decode() != hashlib.sha256(old).hexdigest():
            yield f"{name} is not what the control contained, with its digest (exit {code}: {text})"
    done = made in after if made else is_changed
    if (code == 0 and not done) or (code == 2 and done) or (code == 3 and not done):
        yield f"exit {code}, and {made or 'the control'} is {'' if done else 'not '}changed: {text}"
    kept_by = {Path(path).name for call, path in failed if call == "unlink" or path.endswith(LOCKS)}
    may_be_new = {
        *ready,
        "exchanges.jsonl",
        made,
        f"{made}.sha256",
        *copies,
        *(f"{name}.sha256" for name in copies),
        *(name.replace(".img", ".amp") for name in copies),
    }
    if left := set(after) - may_be_new - kept_by:
        yield f"left behind: {sorted(left)}"
    if code == 2 and (left := set(after) - set(ready) - kept_by - {"exchanges.jsonl"}):
        yield f"exit 2, and left behind: {sorted(left)}"
