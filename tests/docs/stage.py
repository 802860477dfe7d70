"""Where the commands of a document are run: an empty folder, with the controls that it names."""

import os
import shlex
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from amp_studio import cli
from amp_studio.schema import load_schema
from amp_studio.schema.load import load_compiled
from amp_studio.schema.registration import Registration, register, unregister
from amp_studio.sim.scenarios import SCENARIOS
from amp_studio.sim.tuning.solver import Search
from tests.campaigns import CAMPAIGN
from tests.forked import Program, start_program

from .pages import PROGRAMS, ROOT


def leave_out_what_takes_long(patch: pytest.MonkeyPatch) -> None:
    """Outside of a campaign set no PDF, print changed values alone, without pictures and motion, let nothing
    search for other gains, check one move alone, sweep few frequencies and few gains, and compute no contour
    error: tests/report, tests/test_dossier.py, tests/cli/test_check.py, tests/cli/test_program_verb.py and
    tests/sim do so.
    """
    if not CAMPAIGN:
        patch.setattr("amp_studio.sim.motion_check.SCENARIOS", {"step": SCENARIOS["step"]})
        patch.setattr("amp_studio.sim.scenarios.frequency.POINTS", 2)
        patch.setattr("amp_studio.sim.variations.scenario.SIDE", 2)
        patch.setattr("amp_studio.sim.path.program._contour", lambda plan, axes: (None, "not computed here"))
        patch.setattr("amp_studio.report.output.pdf.set_pdf", lambda source, options: (b"%PDF-1.7", ""))
        patch.setattr("amp_studio.report.build.drawings", lambda file, language: ())
        patch.setattr(
            "amp_studio.report.build._is_printed", lambda row, contents: row.is_changed or row.forced
        )
        patch.setattr("amp_studio.dossier._SCENARIOS", ())
        patch.setattr("amp_studio.sim.tuning.solver.Search.best", present_gains)
        patch.setattr("amp_studio.sim.run.recommendations", lambda trial, scenario, own: (tuple(own), ()))


def present_gains(search: Search, levels: object, level: int) -> tuple[float, ...]:
    return tuple(gain.present_size for gain in search.gains)


OF_A_PLANT = "192.168.0.5"
"""Host of a document's control that listens for a whole network."""


class Stage:
    """The present folder, and what is put in the place of an address or a device that is not here:
    a free port, a pseudo terminal.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.replaced: dict[str, str] = {}
        """A text of the document -> what is used here."""
        self._controls: list[Program] = []
        self._families: list[str] = []

    def here(self, line: str) -> str:
        """Return a command with the addresses that are used here."""
        for text, used in self.replaced.items():
            line = line.replace(text, used)
        return line

    def run(self, line: str) -> int:
        """Run one command and return its exit code."""
        words = shlex.split(self.here(line))
        if words[0] == "make":
            return subprocess.run(
                ["make", "--dry-run", *words[1:]], cwd=ROOT, stdout=subprocess.DEVNULL, check=False
            ).returncode
        if words[0] not in PROGRAMS:
            return self._in_a_shell(line)
        if words[1] == "emulate":
            self._listen(words[2:])
            return 0
        return cli.run(words[1:])

    def _in_a_shell(self, line: str) -> int:
        """Run a command of the system, in a shell that finds the program."""
        program = self.folder / "bin" / "amp-studio"
        program.parent.mkdir(exist_ok=True)
        program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m amp_studio.cli "$@"\n', encoding="utf-8")
        program.chmod(0o755)
        env = {
            **os.environ,
            "PATH": f"{program.parent}{os.pathsep}{os.environ['PATH']}",
            "PYTHONPATH": str(ROOT),
        }
        return subprocess.run([shutil.which("bash") or "sh", "-c", line], env=env, check=False).returncode

    def _listen(self, words: list[str]) -> None:
        """Start the control of a document at its address; where the port is taken, at a free one,
        which the next commands get.
        """
        place = urlsplit(words[words.index("--listen") + 1])
        control, at = self.control(words)
        if not at:  # somebody else listens there
            free = [word.replace(f":{place.port}", ":0") for word in words]
            control, at = self.control(free)
        assert at, control.communicate()[1]
        if place.port:
            used = urlsplit(at).port
            hosts = {"127.0.0.1": "127.0.0.1", "localhost": "localhost", OF_A_PLANT: "127.0.0.1"}
            self.replaced |= {f"{host}:{place.port}": f"{here}:{used}" for host, here in hosts.items()}

    def control(self, words: list[str]) -> tuple[Program, str]:
        """Start an emulated control; returns it and where it listens, "" where it has ended."""
        control = start_program("emulate", *words)
        self._controls.append(control)
        return control, control.stdout.readline().strip().removeprefix("listening on ")

    def keys_of(self, control: Program) -> Callable[[str], None]:
        """Return what presses a key of a control."""

        def press(key: str) -> None:
            control.stdin.write(f"{key}\n")
            control.stdin.flush()

        return press

    def write(self, files: dict[str, str]) -> None:
        """Write the files that a document shows; a family of facts among them is known from now on."""
        for name, text in files.items():
            path = self.folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
            if path.name == "family.yaml" and path.parent.name not in self._families:
                self._families.append(path.parent.name)
                register(Registration(path.parent.name, facts=path.parent))

    def close(self) -> None:
        """End every control, and forget the families of the document."""
        for family in self._families:
            unregister(family)
        if self._families:
            load_compiled.cache_clear()
            load_schema.cache_clear()
        for control in self._controls:
            control.kill()
            control.communicate()
