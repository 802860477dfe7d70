"""The command lines of the documents: in blocks of code, and in backquotes within the text."""

import re
import shlex
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from amp_studio.cli.errors import UsageError
from amp_studio.cli.parsing import HelpPrinted, parse
from amp_studio.cli.registry import all_verbs
from amp_studio.cli.verb import Verb

ROOT = Path(__file__).parents[2]
PROGRAMS = ("amp-studio", ".venv/bin/amp-studio")
SHELL = (
    "cp",
    "make",
    "pipx",
    "uv",
    "git",
    "py",
    "python",
    "python3",
    "pip",
    "echo",
    "keyring",
    ".",
    "source",
    "mkdir",
    "cd",
    "export",
    r".venv\Scripts\python",
)
"""First words of the other commands that documents have."""
PLACEHOLDER = re.compile(r"\b(VERB|FILE|PATH|OTHER|COPY|ADDRESS|NAME|FOLDER|TARGET|SHA256)\b|…")
"""Marks a form that a person fills in; it is no command that could be run."""
_INLINE = re.compile(r"(?<!`)`([^`]+)`(?!`)")


def documents() -> list[str]:
    """Return every document with commands, by its path."""
    paths = [
        ROOT / "README.md",
        ROOT / "CONTRIBUTING.md",
        *ROOT.glob("docs/**/*.md"),
        *ROOT.glob("examples/*/README.md"),
    ]
    return sorted(page for path in paths if any(lines_of(page := path.relative_to(ROOT).as_posix())))


def text_of(page: str) -> str:
    return (ROOT / page).read_text(encoding="utf-8")


def lines_of(page: str) -> Iterator[str]:
    """Yield each command of a document in its order, without the comment behind it."""
    is_fenced, is_block, paragraph = False, False, [""]
    for line in text_of(page).splitlines():
        bare = line.strip()
        if bare.startswith("```"):
            is_fenced = not is_fenced
        is_block = is_fenced or (line.startswith("    ") and (is_block or paragraph[-1][:1] in ("", "#")))
        if is_block:
            yield from commands_in_text(paragraph)
            if first_word(bare) in (*PROGRAMS, *SHELL):
                yield without_comment(bare)
        elif not bare:
            yield from commands_in_text(paragraph)
        paragraph = [""] if is_block or not bare else [*paragraph, line]
    yield from commands_in_text(paragraph)


def commands_in_text(paragraph: list[str]) -> Iterator[str]:
    """Yield the commands in the backquotes of a paragraph, which may be broken between two lines."""
    for code in _INLINE.findall("\n".join(paragraph)):
        words = code.split()
        if len(words) > 1 and words[0] in (*PROGRAMS, "make", "pipx", "keyring", "source"):
            yield code.replace("\n", " ")


def first_word(line: str) -> str:
    return (line.split() or [""])[0]


def without_comment(line: str) -> str:
    return re.split(r"\s{2,}#|\s# ", line)[0].strip()


@cache
def verbs() -> dict[str, Verb]:
    return all_verbs()


def is_form(line: str) -> bool:
    """Return whether a person has something to fill in before a command can be run."""
    words = shlex.split(line)
    if PLACEHOLDER.search(line):
        return True
    verb = verbs().get(words[1]) if words[0] in PROGRAMS else None
    try:
        if verb is not None:
            parse(words[1], verb, words[2:])
        return False
    except HelpPrinted:
        return False
    except UsageError as error:
        return "Missing: " in str(error)
