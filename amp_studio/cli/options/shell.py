"""The completion and the man page."""

from __future__ import annotations

from amp_studio.cli.arguments import Verbs


def add(verbs: Verbs) -> None:
    """Add the completion and the man page."""
    sub = verbs.add("completion", "completion", "print the completion script of a shell")
    sub.add_argument("shell", choices=("bash", "zsh", "fish"))
    verbs.add("man", "man_page", "print the man page")
