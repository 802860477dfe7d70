"""What verbs are made of: the parser of one, the kinds of their arguments, and options that several have."""

from __future__ import annotations

import argparse
import os
import re
from pathlib import Path
from typing import Any, NoReturn

from .errors import UsageError
from .manual import sections
from .misuse import in_plain_words, unexpected, unknown

_USUAL = {
    "path": "parameter file (.amp)",
    "family": "control family",
    "param": "number or id of a parameter",
    "params": "numbers or ids of parameters",
    "assignments": "parameter and its new value",
    "machine": "machine type: mill, lathe, …",
    "group": "only the parameters of this group",
    "table": "the table to print",
    "formula": "the formula to calculate",
    "arguments": "the values the formula needs",
    "text": "a control's own text file",
    "address": "where the control is reached",
    "a": "file, or address of a control",
    "b": "file, or address of a control",
    "base": "what both sides began with",
    "ours": "our side, which is kept in a conflict that is not settled",
    "theirs": "the other side",
    "scenario": "what is simulated",
    "axis": "axis by its letter or number (default: the first)",
    "output": "file to write",
    "sort": "order of the values (default: group)",
    "changed-only": "only values that differ from the printed default, or have none",
    "listen": "where the control is reached",
    "to": "where the control is reached",
    "source": "where the control is reached",
    "control": "where the control is reached",
    "shell": "bash, zsh or fish",
}
"""Name of an argument -> its help where a verb has no other."""


class VerbParser(argparse.ArgumentParser):
    """An argument parser that reports what is wrong in one line, and whose help ends with examples."""

    def __init__(self, *, verb: str = "", **how: Any) -> None:
        self.verb = verb
        self._is_adding = False
        super().__init__(**how)

    def add_argument(self, *names: Any, **how: Any) -> argparse.Action:
        """Add an argument, with the usual help where none is given."""
        usual = _USUAL.get(how.get("dest") or names[-1].lstrip("-"))
        self._is_adding = True
        try:
            return super().add_argument(*names, **({"help": usual} if usual else {}) | how)
        finally:
            self._is_adding = False

    def _get_formatter(self) -> argparse.HelpFormatter:
        """Return what writes help; argparse asks for one with each argument, for which the terminal need not be measured."""
        return argparse.HelpFormatter(self.prog, width=80) if self._is_adding else super()._get_formatter()

    def error(self, message: str) -> NoReturn:
        raise UsageError(f"{in_plain_words(message)} (see '{self.prog} --help')")

    def format_help(self) -> str:
        """Return the help of argparse with what comes below it."""
        below = (
            f"{title}:\n" + "\n".join(f"  {line}" for line in lines) for title, lines in sections(self.verb)
        )
        return "\n\n".join([super().format_help().rstrip(), *below]) + "\n"

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Parse; an unknown option is reported before what is missing because of it."""
        for text in () if args is None else args:
            if text == "--" or not (self.verb or text.startswith("-")):
                break  # what follows are no options, or those of the verb
            name = text.partition("=")[0]
            known = list(self._option_string_actions)
            if name.startswith("--") and not any(option.startswith(name) for option in known):
                self.error(unknown("option", name, known))
        found, unknown_texts = super().parse_known_args(args, namespace)
        if self.verb:
            unknown_texts = self._placed(found, unknown_texts)
        if self.verb and unknown_texts:
            self.error(unexpected(unknown_texts, self._option_string_actions))
        return found, unknown_texts

    def _placed(self, found: argparse.Namespace, texts: list[str]) -> list[str]:
        """Give optional arguments what came behind an option, which argparse does not; return what is left over."""
        for action in self._actions:
            may_take = not action.option_strings and action.nargs == "?" and texts
            if may_take and not texts[0].startswith("-") and getattr(found, action.dest) is None:
                value = self._get_value(action, texts.pop(0))
                self._check_value(action, value)
                setattr(found, action.dest, value)
        return texts

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is not None and value not in action.choices:
            self.error(unknown(_named(action), str(value), action.choices))


def _named(action: argparse.Action) -> str:
    """Return what a person calls an argument."""
    return (action.option_strings or [str(action.metavar or action.dest).lower()])[-1].lstrip("-")


class _NotAsked(argparse.ArgumentParser):
    """In the place of the parser of a verb that is not on the command line; it takes arguments and keeps none."""

    def __init__(self) -> None:
        pass

    def add_argument(self, *_names: Any, **_how: Any) -> Any:
        """Add nothing."""


class Verbs:
    """The verbs of the program, or the one of them that is ``asked``: to make all of them takes a third of a start."""

    def __init__(self, top: argparse.ArgumentParser, asked: str) -> None:
        self._asked = asked
        self._made = top.add_subparsers(metavar="VERB", required=True, parser_class=VerbParser, prog=top.prog)

    def add(self, name: str, module: str, summary: str, writes: str = "") -> argparse.ArgumentParser:
        """Add a verb; ``writes`` names the option whose file it may replace."""
        if self._asked and name != self._asked:
            return _NotAsked()
        text = f"{summary[0].upper()}{summary[1:]}."
        sub: argparse.ArgumentParser = self._made.add_parser(name, help=summary, description=text, verb=name)
        sub.set_defaults(verb=f"{name}_verb", module=module, writes=writes.split())
        return sub

    @property
    def is_known(self) -> bool:
        """Whether the verb that was asked is one."""
        return bool(self._made.choices)


# -- options that several verbs have ---------------------------------------------------------------------------


def json_option(sub: argparse.ArgumentParser) -> None:
    """Add --json."""
    sub.add_argument("--json", action="store_true", help="print one JSON document")


def language_option(sub: argparse.ArgumentParser) -> None:
    """Add --language, of a document."""
    sub.add_argument(
        "--language",
        choices=("en", "de"),
        default="en",
        help="language of the report's own words (default: en)",
    )


def text_options(sub: argparse.ArgumentParser) -> None:
    """Add what is known of a control's own text that is named in place of a parameter file."""
    sub.add_argument("--family", help="of a control's own text: its family, where the text does not show it")
    sub.add_argument(
        "--machine",
        metavar="TYPE",
        help="of a control's own text: its machine type, where the text shall not decide",
    )


def secrets_option(sub: argparse.ArgumentParser) -> None:
    """Add --secrets."""
    sub.add_argument("--secrets", action="store_true", help="passwords in clear; they are masked otherwise")


def on_fault_option(sub: argparse.ArgumentParser) -> None:
    """Add what is done with values out of range."""
    sub.add_argument("--on-fault", choices=("ask", "keep", "quit"), default="ask",
                     help="what to do with out-of-range values (default: ask at a terminal, else quit)")  # fmt: skip


# -- kinds of arguments ------------------------------------------------------------------------------------------


def path_of(text: str) -> Path:
    """Return a path; an empty text, as of a variable that is not set, is not the current folder."""
    if not text:
        raise argparse.ArgumentTypeError("the path is empty")
    path = Path(text)
    if text.endswith((os.sep, "/", "/.")) and not _is_folder(path):  # Path forgets what it ended with
        raise argparse.ArgumentTypeError(f"{text} ends like a folder, and there is no such folder")
    return path


def file_or_address(text: str) -> str:
    """Return the path of a file, or the address of a control."""
    if "://" not in text:
        path_of(text)
    return text


def folder(text: str) -> Path:
    """Return the path of a folder, which need not be there."""
    path = Path(text)
    return path if text and not path.exists() else path_of(text)


def _is_folder(path: Path) -> bool:
    try:
        return path.is_dir()
    except OSError:
        return False


def count(text: str) -> int:
    """Return a number from 1 to 100000."""
    if not (text.isdecimal() and 0 < int(text) <= 100_000):
        raise argparse.ArgumentTypeError(f"{text} is no number from 1 to 100000")
    return int(text)


def seconds(text: str) -> float:
    """Return a number of seconds above 0."""
    if not re.fullmatch(r"\d{1,5}(\.\d{1,3})?", text, re.ASCII) or float(text) <= 0:
        raise argparse.ArgumentTypeError(f"{text} is no number of seconds")
    return float(text)
