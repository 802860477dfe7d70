"""Reads a command line with argparse, of whose parts only the documented ones are used;
misuse is answered in plain words.

docs/decisions/0008-argparse.md has why it is argparse, with what others cost.
"""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import Any, NoReturn

from .errors import UsageError
from .manual import PROGRAM, help_of
from .verb import Options, Verb, VerbArgument

_PLAIN = (
    (r"the following arguments are required: (.*)", r"Missing: \1"),
    (r"unrecognized arguments: (.*)", r"Unexpected: \1"),
    (r"ambiguous option: (\S+) could match (.*)", r"'\1' is the beginning of several options: \2"),
    (r"argument (\S+): expected one argument", r"\1 needs a value"),
    (r"argument (\S+): expected at least one argument", r"\1 needs at least one value"),
    (r"argument (\S+): ignored explicit argument (.*)", r"\1 takes no value, and was given \2"),
    # Of every other message about an argument, and so the last.
    (r"argument (\S+): (.*)", r"\1: \2"),
)
"""What argparse writes -> what a user reads: it names its own parts."""
_MINUS_AND_FIGURE = re.compile(r"-[0-9.]")


class HelpPrinted(Exception):  # it is no error
    """Help was asked for and has been printed."""


class _OneFile(argparse.Action):
    """Keeps the file that is to be written: of two, argparse would forget the first without a word."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,  # noqa: ARG002  # as argparse calls it
    ) -> None:
        if (first := getattr(namespace, self.dest)) is not None:
            parser.error(f"{self.option_strings[0]} names one file, and was given {first} and {values}")
        setattr(namespace, self.dest, values)


class _Parser(argparse.ArgumentParser):
    """A parser of argparse that raises what is wrong, and prints the help of this program."""

    def __init__(self, name: str, verb: Verb) -> None:
        # With each argument argparse asks for a formatter, which would measure the terminal if it were not
        # given a width.
        super().__init__(
            prog=f"{PROGRAM} {name}",
            description=verb.about,
            formatter_class=partial(argparse.HelpFormatter, width=80),
        )
        self.verb = verb
        for argument in verb.arguments:
            # argparse fills ``%(…)s`` into a help text: a per cent sign has to be doubled.
            self.add_argument(
                *argument.names, help=argument.help.replace("%", "%%"), **self._options(argument)
            )

    def _options(self, argument: VerbArgument) -> dict[str, Any]:
        """Return the arguments of ``add_argument``; a choice is read here,
        because an unknown one is answered with the nearest.
        """
        how = dict(argument.how)
        if "type" in how:
            how["type"] = _in_words(how["type"])
        if choices := how.pop("choices", None):
            how |= {"type": self._one_of(argument, choices), "metavar": f"{{{','.join(choices)}}}"}
        if "-o" in argument.names:
            how.setdefault("action", _OneFile)
        if not argument.is_option:
            how.setdefault("metavar", argument.label)
            if how.get("nargs") == "*":
                how.setdefault("default", [])  # else Python 3.11 calls it missing where another one is
        return how

    def _one_of(self, argument: VerbArgument, choices: Sequence[str]) -> Callable[[str], str]:
        def read(text: str) -> str:
            if text not in choices:
                self.error(_unknown(argument.label.rpartition(" ")[2].lstrip("-").lower(), text, choices))
            return text

        return read

    def error(self, message: str) -> NoReturn:
        raise UsageError(f"{_in_plain_words(message)} (see '{self.prog} --help')")

    def print_help(self, file: Any = None) -> None:
        self.formatter_class = argparse.HelpFormatter
        print(help_of(self.format_help(), self.verb), end="", file=file)

    def exit(self, status: int = 0, message: str | None = None) -> NoReturn:  # noqa: ARG002  # as argparse calls it
        raise HelpPrinted


def _in_words(kind: Callable[[str], Any]) -> Callable[[str], Any]:
    """Return the reader of a value whose refusals argparse repeats;
    those of a ValueError it puts into its own words.
    """

    def read(text: str) -> Any:
        try:
            return kind(text)
        except ValueError as error:
            raise argparse.ArgumentTypeError(str(error)) from None

    return read


def usage_of(name: str, verb: Verb) -> str:
    """Return how a verb is called, in one line."""
    return " ".join(_Parser(name, verb).format_usage().removeprefix("usage: ").split())


def help_text(name: str, verb: Verb) -> str:
    """Return the whole help of a verb."""
    return help_of(_Parser(name, verb).format_help(), verb)


def parse(name: str, verb: Verb, words: Sequence[str]) -> Options:
    """Return what the words behind a verb mean; raises UsageError, and HelpPrinted where help was asked
    for.
    """
    parser = _Parser(name, verb)
    _check_options(parser, words)
    words = _with_signed(verb, words)
    found, left = parser.parse_known_args(words, Options())
    if left and not any(word.startswith("-") for word in left):
        # argparse gives an optional word nothing where it comes behind an option; this one does, and takes
        # longer.
        found, left = parser.parse_known_intermixed_args(words, Options())
    if left:
        parser.error(_unexpected(left, verb.options))
    found.verb = name
    return found


def refuse_program(word: str, verbs: Iterable[str]) -> NoReturn:
    """Refuse the first word of a command line, which is no verb and no option of the program;
    raises UsageError.
    """
    known, what = (("-h", "--help", "--version"), "option") if word.startswith("-") else (verbs, "verb")
    raise UsageError(f"{_unknown(what, word, known)} (see '{PROGRAM} --help')")


def _check_options(parser: _Parser, words: Sequence[str]) -> None:
    """Refuse an unknown option before what is missing because of it."""
    options = parser.verb.options
    for word in words:
        if word == "--":
            return
        name = word.partition("=")[0]
        # The beginning of an option is one: argparse completes it, or names those that it could be.
        if name.startswith("--") and not any(option.startswith(name) for option in options):
            parser.error(_unknown("option", name, options))


def _with_signed(verb: Verb, words: Sequence[str]) -> list[str]:
    """Return words in which a value that begins with a minus and a figure is joined to its option:
    alone it looks like one.
    """
    signed = {name for each in verb.arguments if each.signed for name in each.names}
    joined: list[str] = []
    for word in words:
        if joined and joined[-1] in signed and _MINUS_AND_FIGURE.match(word):
            joined[-1] += f"={word}"
        else:
            joined.append(word)
    return joined


def _in_plain_words(message: str) -> str:
    """Return a message of argparse in plain words; one that is not known stays as it is."""
    for pattern, plain in _PLAIN:
        if match := re.fullmatch(pattern, message, re.DOTALL):
            return match.expand(plain)
    return message


def _unknown(what: str, name: str, known: Iterable[str]) -> str:
    """Return the message for an unknown name, with the nearest known ones."""
    from amp_studio.schema import unknown_name

    return unknown_name(what, name, known)


def _unexpected(words: Sequence[str], options: Iterable[str]) -> str:
    """Return the message for words that a verb has no place for."""
    option = next((word for word in words if word.startswith("-") and word != "--"), None)
    if option is not None:
        return _unknown("option", option.partition("=")[0], options)
    return f"Unexpected argument{'s' if len(words) > 1 else ''}: {' '.join(words)}"
