"""The man page, from the parser and what comes below its help."""

from __future__ import annotations

import argparse
from collections.abc import Iterator

from amp_studio.version import __version__

from .manual import EXIT_CODES, sections
from .parser import parser, verbs_of


def man_verb(options: argparse.Namespace) -> int:  # noqa: ARG001  # every verb takes them
    """Print the man page."""
    print(man_page(), end="")
    return 0


def man_page() -> str:
    """Return the man page as troff."""
    top = parser()
    lines = [
        f'.TH AMP-STUDIO 1 "" "amp-studio {__version__}" "User Commands"',
        ".SH NAME", _plain(f"amp-studio - {(top.description or '').partition('. ')[0].rstrip('.').lower()}"),
        ".SH SYNOPSIS", r".B amp\-studio", r".I VERB", "[argument ...]",
        ".SH DESCRIPTION", _plain(top.description or ""),
        ".SH VERBS",
    ]  # fmt: skip
    for name, sub in verbs_of(top).items():
        lines += [f".SS {_plain(name)}", _plain(sub.description or ""), ".PP", _usage(sub)]
        for action in sub._actions:
            if action.help and action.dest != "help":
                names = ", ".join(action.option_strings) or str(action.metavar or action.dest)
                lines += [".TP", rf"\fB{_plain(names)}\fR", _plain(action.help)]
        lines += _blocks(list(sections(name))[:-1])
    lines += [".SH EXIT STATUS", ".nf", *map(_plain, EXIT_CODES), ".fi"]
    return "\n".join(lines) + "\n"


def _usage(sub: argparse.ArgumentParser) -> str:
    return _plain(" ".join(sub.format_usage().removeprefix("usage: ").split()))


def _blocks(found: list[tuple[str, tuple[str, ...]]]) -> Iterator[str]:
    for title, lines in found:
        yield from (".PP", _plain(f"{title}:"), ".RS", ".nf", *map(_plain, lines), ".fi", ".RE")


def _plain(text: str) -> str:
    """Return a text with nothing in it that troff would take for its own."""
    escaped = text.replace("\\", r"\e").replace("-", r"\-").replace("%%", "%").replace("…", "...")
    return rf"\&{escaped}" if escaped.startswith((".", "'")) else escaped
