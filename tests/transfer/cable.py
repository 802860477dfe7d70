"""A cable from a pseudo terminal that carries so many bytes a second and changes some of them on the way."""

from __future__ import annotations

import os
import random
import select
import socket
import subprocess
import threading
import time
import tty
from pathlib import Path


class Cable:
    """Each of its two ends is a port (``port``) or the standard streams of a program (``attach``).

    ``rate`` is in bytes a second each way, None for any; one of so many bytes is changed (``noise``),
    0 for none.
    """

    def __init__(self, rate: float | None = None, noise: int = 0, seed: int = 1) -> None:
        self._rate, self._noise = rate, noise
        self._chance = random.Random(seed)
        self._over = threading.Event()
        self._handles: list[int] = []
        self._pair: list[int] = []
        self.changed = 0
        self._threads: list[threading.Thread] = []

    def attach(self, command: list[str], folder: Path) -> subprocess.Popen[bytes]:
        """Run a program at the other end.

        Not at a terminal: one that flushes its terminal when it ends takes back its last answer there.
        """
        ours, its = socket.socketpair()
        with its:
            process = subprocess.Popen(command, stdin=its, stdout=its, stderr=subprocess.DEVNULL, cwd=folder)
        ours.setblocking(False)
        handle = ours.detach()
        self._handles.append(handle)
        self._connect(handle)
        return process

    def port(self) -> str:
        """Return the name of a port at an end."""
        master, slave = os.openpty()
        tty.setraw(slave)
        os.set_blocking(master, False)
        self._handles += (master, slave)
        self._connect(master)
        return os.ttyname(slave)

    def _connect(self, handle: int) -> None:
        self._pair.append(handle)
        if len(self._pair) < 2:
            return
        near, far = self._pair
        self._threads = [
            threading.Thread(target=self._carry, args=ends, daemon=True)
            for ends in ((near, far), (far, near))
        ]
        for thread in self._threads:
            thread.start()

    def __enter__(self) -> Cable:
        return self

    def __exit__(self, *_: object) -> None:
        self.pull()

    def pull(self) -> None:
        """Take the cable out: both ends are hung up."""
        self._over.set()
        for thread in self._threads:
            thread.join()
        handles, self._handles = self._handles, []
        for handle in handles:
            os.close(handle)

    def _carry(self, source: int, target: int) -> None:
        free_at = time.monotonic()
        while not self._over.is_set():
            if not select.select([source], [], [], 0.02)[0]:
                continue
            try:
                data = os.read(source, 4096 if self._rate is None else max(1, int(self._rate / 100)))
            except OSError:
                return
            if not data:
                return  # the program has ended
            if self._rate is not None:
                free_at = max(free_at, time.monotonic()) + len(data) / self._rate
                time.sleep(max(0.0, free_at - time.monotonic()))
            self._write(target, self._changed(data))

    def _changed(self, data: bytes) -> bytes:
        if not self._noise:
            return data
        changed = bytearray(data)
        for at in range(len(changed)):
            if self._chance.randrange(self._noise) == 0:
                changed[at] ^= 1 << self._chance.randrange(8)
                self.changed += 1
        return bytes(changed)

    def _write(self, target: int, data: bytes) -> None:
        while data and not self._over.is_set():
            if select.select([], [target], [], 0.02)[1]:
                try:
                    data = data[os.write(target, data) :]
                except OSError:
                    return
