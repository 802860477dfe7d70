"""Print the man page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from amp_studio.cli.manual import ABOUT, EXIT_CODES, PROGRAM, sections
from amp_studio.cli.registry import all_verbs
from amp_studio.cli.verb import Options, Verb
from amp_studio.version import __version__

VERB = Verb(__doc__, examples=("amp-studio man",))


def run(options: Options) -> int:  # noqa: ARG001  # every verb takes them
    """Print the man page."""
    print(man_page(), end="")
    return 0


def man_page() -> str:
    """Return the man page as troff."""
    from amp_studio.cli.parsing import usage_of

    lines = [
        f'.TH AMP-STUDIO 1 "" "{PROGRAM} {__version__}" "User Commands"',
        ".SH NAME",
        _plain(f"{PROGRAM} - {ABOUT.partition('. ')[0].lower()}"),
        ".SH SYNOPSIS",
        r".B amp\-studio",
        r".I VERB",
        "[argument ...]",
        ".SH DESCRIPTION",
        _plain(ABOUT),
        ".SH VERBS",
    ]
    for name, verb in all_verbs().items():
        lines += [f".SS {_plain(name)}", _plain(verb.about), ".PP", _plain(usage_of(name, verb))]
        for argument in verb.arguments:
            lines += [".TP", rf"\fB{_plain(argument.label)}\fR", _plain(argument.help)]
        # Without the exit codes, which are the same for all verbs and come once, at the end.
        lines += _blocks(list(sections(verb))[:-1])
    lines += [".SH EXIT STATUS", ".nf", *map(_plain, EXIT_CODES), ".fi"]
    return "\n".join(lines) + "\n"


def _blocks(found: list[tuple[str, Sequence[str]]]) -> Iterator[str]:
    for title, lines in found:
        yield from (".PP", _plain(f"{title}:"), ".RS", ".nf", *map(_plain, lines), ".fi", ".RE")


def _plain(text: str) -> str:
    """Return a text with nothing in it that troff would take for its own."""
    escaped = text.replace("\\", r"\e").replace("-", r"\-").replace("…", "...")
    return rf"\&{escaped}" if escaped.startswith((".", "'")) else escaped
