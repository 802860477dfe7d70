"""Stops downloads and emulated controls at moments that chance chooses,
and compares the exit code with the truth.

The programs are real ones and so are the signals; a campaign can run many seeds.
"""

import json
import random
import signal
import sys
import time
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

from amp_studio import cli
from tests import forked
from tests.forked import Program

from .stopped import started

LONGEST = 2.0
"""Seconds after the start within which a download is stopped; it takes about as long on a line of this
speed."""
LATEST = 15.0
"""Seconds after the signal by which it has ended, on a busy machine too: it ends within 5,
and would wait for 20 without."""

FAULTS: list[dict[str, Any]] = [{}, {}, {"drop_after_bytes": 20_000}, {"lose_every": 4_001}, {"silent": True}]


def emulated(folder: Path, **faults: Any) -> AbstractContextManager[tuple[Program, str]]:
    """Start an emulated control; gives the process and where it listens."""
    return forked.emulated("9pc", folder, "--faults", json.dumps(faults))


def _command(*arguments: object) -> list[str]:
    return [sys.executable, "-m", "amp_studio.cli", *map(str, arguments)]


def download_while_stopped(path: Path, folder: Path, *, seed: int, rounds: int) -> list[str]:
    """Download a changed file again and again and stop each; return what was not true of it."""
    chance = random.Random(seed)
    faults: list[str] = []
    for number in range(rounds):
        state = folder / f"control-{seed}-{number}"
        assert cli.run(["set", str(path), f"1300={chance.randrange(1, 100_000) / 1000}"]) == 0
        with emulated(state, **chance.choice(FAULTS)) as (_, address):
            before = (state / "active.img").read_bytes()
            delay, signals = chance.uniform(0.1, LONGEST), chance.choice([1, 1, 2])
            number_of = chance.choice([signal.SIGINT, signal.SIGINT, signal.SIGTERM])
            begun = time.monotonic()
            code, out, err = _stopped(path, address, delay, signals, number_of)
            took = time.monotonic() - begun - delay
            changed = (state / "active.img").read_bytes() != before
        fits = {
            0: "complete" in out or "holds exactly" in out,
            2: not changed and "complete" not in out,
            3: changed and "the control contains the new image" in err,
            4: "not known" in err and "amp-studio verify" in err,
            -number_of: not changed and not out,  # before the program has begun
        }.get(code, False)
        if not fits or "Traceback" in err or "ignored" in err or took > LATEST:
            faults.append(
                f"seed {seed}, round {number}, after {delay:.3f} s, {took:.1f} s: {code}, {changed}, {out!r},"
                f" {err!r}"
            )
    return faults


def _stopped(path: Path, address: str, delay: float, signals: int, number: int) -> tuple[int, str, str]:
    with started("download", path, "--to", address, "--accept-errors") as program:
        time.sleep(delay)
        for _ in range(signals):
            program.send_signal(number)
            time.sleep(0.02)
        out, err = program.communicate(timeout=120)
    return program.returncode, out, err


def control_while_stopped(folder: Path, *, seed: int, rounds: int) -> list[str]:
    """Start an emulated control again and again and stop each, some with streams that nobody reads."""
    chance = random.Random(seed)
    faults: list[str] = []
    for number in range(rounds):
        delay = chance.uniform(0.05, 1.5)
        streams = chance.choice(["", ">&-", "2>&-", ">&- 2>&- <&-", "| true", ">/dev/full"])
        state = folder / f"stopped-{seed}-{number}"
        script = f'exec "$@" {streams}' if streams != "| true" else 'exec "$@" > >(true)'
        verb = ("emulate", "9pc", "--listen", "tcp://127.0.0.1:0", "--state", state)
        with started(*verb, shell=script) as program:
            time.sleep(delay)
            program.send_signal(signal.SIGINT)
            out, err = program.communicate(timeout=120)
        # It ends by the signal (-2) where that comes before anything is loaded.
        fits = program.returncode == 0 or (program.returncode in (2, -signal.SIGINT) and not out)
        if not fits or err.strip() or (out and not out.endswith("bye\n")):
            faults.append(
                f"seed {seed}, round {number}, {streams!r}, after {delay:.3f} s: {program.returncode},"
                f" {out!r}, {err!r}"
            )
    return faults
