"""What is wrong with a command line, in plain words: argparse names its own parts and no nearest option."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

_PLAIN = (
    (r"the following arguments are required: (.*)", r"Missing: \1"),
    (r"unrecognized arguments: (.*)", r"Unexpected: \1"),
    (r"ambiguous option: (\S+) could match (.*)", r"'\1' is the beginning of several options: \2"),
    (r"argument (\S+): expected one argument", r"\1 needs a value"),
    (r"argument (\S+): expected at least one argument", r"\1 needs at least one value"),
    (r"argument (\S+): ignored explicit argument (.*)", r"\1 takes no value, and was given \2"),
    (r"argument (\S+): (.*)", r"\1: \2"),
)


def in_plain_words(message: str) -> str:
    """Return a message of argparse in plain words; one that is not known stays as it is."""
    for pattern, plain in _PLAIN:
        if found := re.fullmatch(pattern, message, re.DOTALL):
            return found.expand(plain)
    return message


def unknown(what: str, name: str, known: Iterable[str]) -> str:
    """Return the message for an unknown name, with the nearest known ones."""
    from amp_studio.schema.nearest import unknown_name  # the rooms are loaded when they are needed

    return unknown_name(what, name, known)


def unexpected(texts: Sequence[str], options: Iterable[str]) -> str:
    """Return the message for arguments that a verb has no place for."""
    option = next((text for text in texts if text.startswith("-") and text != "--"), None)
    if option is not None:
        return unknown("option", option.partition("=")[0], options)
    return f"Unexpected argument{'s' if len(texts) > 1 else ''}: {' '.join(texts)}"
