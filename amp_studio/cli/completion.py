"""Shell completion: what the scripts for bash, zsh and fish (``amp-studio completion``) ask the program.

A script hands the line over as it is; what may come next is in the description of the verb, so a new verb or
option completes at once. Where nothing is found the shell offers files.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Sequence

from .registry import module_of, verb_names
from .verb import Verb, VerbArgument


def answer(words: Sequence[str], breaks: str) -> None:
    """Print what may come next, a line each; nothing if that is a file.

    bash gives the line (``--line TEXT``) and is answered from the last of its word ``breaks`` on, as it puts
    the answer there.
    """
    typed = list(words)
    # bash parts words at its own breaks (: and =), so it gives the line as a whole.
    if typed[:1] == ["--line"]:
        typed = _words_of(typed[1] if len(typed) > 1 else "")[1:]
    if not typed:
        return
    *before, current = typed
    begin = (
        max((current.rfind(character) for character in breaks), default=-1) + 1
        if words[:1] == ["--line"]
        else 0
    )
    # Most candidates know nothing of what is typed: the beginning is compared here, for all of them.
    for found in dict.fromkeys(_candidates(before, current)):
        if found.startswith(current):
            print(found[begin:])


def _words_of(line: str) -> list[str]:
    """Part a line that may end inside a word or a quote; the last word is the one that is typed,
    perhaps empty.
    """
    # A line that is still typed may end inside a quote.
    for closing in ("", "'", '"'):
        try:
            words = shlex.split(line + closing)
        except ValueError:
            continue
        return [*words, ""] if not closing and line[-1:].isspace() else words
    return []


def _candidates(before: Sequence[str], current: str) -> Iterator[str]:
    """Yield what may come after the words ``before`` in the place of the one that is typed;
    more than fits is no matter.
    """
    verbs = verb_names()
    if not before:
        yield from (*verbs, "--help", "--version")
        return
    if before[0] not in verbs:
        return
    verb: Verb = module_of(before[0]).VERB
    waiting, values = _parted(verb, before[1:])
    if waiting is not None:
        yield from _values(waiting, values, current)
        return
    if current.startswith("-"):
        yield from verb.options
        return
    places = [argument for argument in verb.arguments if not argument.is_option]
    at = min(len(values), len(places) - 1)
    if places and (len(values) < len(places) or places[at].takes_more):
        yield from _values(places[at], values, current)


def _parted(verb: Verb, words: Sequence[str]) -> tuple[VerbArgument | None, list[str]]:
    """Return the option that waits for its value, if one does,
    and the words that are no options or values of some.
    """
    takes_value = [each for each in verb.arguments if each.is_option and not _is_alone(each)]
    options = {name: argument for argument in takes_value for name in argument.names}
    waiting: VerbArgument | None = None
    values = []
    for word in words:
        if waiting is not None:
            waiting = None
        elif word.startswith("-") and word != "-":
            waiting = options.get(word)
        else:
            values.append(word)
    return waiting, values


def _is_alone(option: VerbArgument) -> bool:
    """Return whether an option takes no value, or several."""
    return option.is_flag or "nargs" in option.how


def _values(argument: VerbArgument, values: Sequence[str], current: str) -> Sequence[str]:
    if argument.choices or argument.completes is None:
        return argument.choices
    return tuple(argument.completes(values[0] if values else "", current))
