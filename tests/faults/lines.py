"""Downloads over bad lines: real programs, a real TCP connection or pseudo terminal,
and faults that a seed chooses.
"""

import json
import os
import random
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "57c422b-label-press" / "LABEL_PRESS.amp"
CERTIFICATES = Path(__file__).resolve().parents[1] / "transfer" / "links" / "certificates"
PASSWORD = "correct horse"
DOWNLOADER = (sys.executable, "-m", "amp_studio.cli")
"""The program that downloads."""


def _faults(chance: random.Random) -> dict[str, Any]:
    """Return what goes wrong on one line: cuts, lost and changed bytes, silence, a slow or delayed
    control.
    """
    ways: list[dict[str, Any]] = [
        {"drop_after_bytes": chance.randrange(1, 9_000)},
        {"drop_after_bytes": chance.randrange(200, 3_000), "drops": chance.choice([1, 2, 5])},
        {"corrupt_every": chance.randrange(150, 4_000)},
        {"lose_every": chance.randrange(150, 4_000)},
        {"disk_full_at": chance.randrange(10, 9_000)},
        {"die_at_commit_step": chance.randrange(1, 9)},
        {"silent": True},
    ]
    return {key: value for way in chance.sample(ways, chance.choice([1, 1, 2])) for key, value in way.items()}


def download_over_bad_lines(seed: int, runs: int, folder: Path) -> list[str]:
    """Download to a control behind a bad line; returns what was not true in the program's reports."""
    found = []
    for number in range(runs):
        chance = random.Random(f"{seed} {number}")
        work = folder / f"line-{number}"
        work.mkdir()
        found += [f"seed {seed}, run {number}: {what}" for what in _one(chance, work)]
        shutil.rmtree(work)
    return found


def _program(*arguments: object) -> list[str]:
    return [sys.executable, "-m", "amp_studio.cli", *map(str, arguments)]


def _one(chance: random.Random, work: Path) -> list[str]:
    path, state = work / "press.amp", work / "control"
    shutil.copy(EXAMPLE, path)
    faults = _faults(chance)
    listen = chance.choice(["tcp://127.0.0.1:0", "pty:"])
    secured: list[object] = []
    if listen.startswith("tcp") and chance.random() < 0.5:
        (work / "password").write_text(PASSWORD, encoding="utf-8")
        listen = listen.replace("tcp", "tls")
        secured = [
            "--certificate",
            CERTIFICATES / "control.pem",
            "--key",
            CERTIFICATES / "control.key",
            "--password-file",
            work / "password",
        ]
    command = _program(
        "emulate", "57c422b", "--listen", listen, "--state", state, "--faults", json.dumps(faults), *secured
    )
    kept = None
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as control:
        try:
            assert control.stdout is not None
            address = control.stdout.readline().strip().removeprefix("listening on ")
            old = (state / "active.img").read_bytes()
            kept = _kept_name(address)
            ended = subprocess.run(
                [*DOWNLOADER, "download", str(path), "--to", address, "--accept-errors"],
                capture_output=True,
                text=True,
                check=False,
                timeout=180,
                env=os.environ | ({"AMP_STUDIO_PASSWORD": PASSWORD} if secured else {}),
            )
            content = (state / "active.img").read_bytes()
        finally:
            control.kill()
            if kept is not None:
                os.close(kept)
    return _untrue(ended.returncode, ended.stdout + ended.stderr, old, content, work, f"{listen} {faults}")


def _kept_name(address: str) -> int | None:
    """Hold a pseudo terminal, so that its name goes to no other control while the program waits for a dead
    one.
    """
    if not address.startswith("serial:"):
        return None
    return os.open(address.removeprefix("serial:").partition("?")[0], os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)


def _untrue(code: int, message: str, old: bytes, content: bytes, work: Path, how: str) -> list[str]:
    """Return what does not fit: the exit code and what the control contains, which is whole;
    what it contained is kept.
    """
    found = []
    if not content.endswith(b"\n") or b"\nend " not in content:
        found.append("the control holds half an image")
    fits = {0: content != old, 2: content == old, 3: content != old, 4: True}.get(code, False)
    if not fits or "Traceback" in message:
        found.append(
            f"exit {code}, the control holds the {'old' if content == old else 'new'} image: {message}"
        )
    copies = [path.read_bytes() for path in work.glob("*.before-*.img")]
    if content != old and copies != [old]:
        found.append("what the control contained was not kept")
    return [f"{how}: {what}" for what in found]
