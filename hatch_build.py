"""Puts the man page and the completions of the shells into the wheel; they are made of the verbs, by which
nothing but Python's own library is loaded.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

SHARED = {
    "man": "share/man/man1/amp-studio.1",
    "completion bash": "share/bash-completion/completions/amp-studio",
    "completion zsh": "share/zsh/site-functions/_amp-studio",
    "completion fish": "share/fish/vendor_completions.d/amp-studio.fish",
}
"""Verb that prints a file -> where a system looks for it, below the prefix of an installation."""


_PROGRAM = (
    "import sys; sys.path.insert(0, sys.argv.pop(1)); from amp_studio.cli import run; run(sys.argv[1:])"
)


class SharedFilesHook(BuildHookInterface):
    """Makes the files for a wheel; an editable install has none."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Write the files below ``build/share`` and list them for the wheel."""
        if self.target_name != "wheel" or version == "editable":
            return
        for verb, place in SHARED.items():
            made = Path(self.root, "build", place)
            made.parent.mkdir(parents=True, exist_ok=True)
            command = [sys.executable, "-c", _PROGRAM, self.root, *verb.split()]
            made.write_bytes(subprocess.run(command, check=True, capture_output=True).stdout)
            build_data["shared_data"][str(made)] = place
