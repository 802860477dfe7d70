"""Runs a verb and returns its exit code; an error is one line: what went wrong, and the state of files."""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, NoReturn

from amp_studio.child_process import declare_command_line
from amp_studio.version import __version__

from .exit_codes import AT_CONTROL, CHANGED, FAULT
from .screen import end_results, flush_results, open_streams, print_notice
from .stopping import ignore_interrupts, raise_on_interrupt, stop_was_requested

if TYPE_CHECKING:
    from .outcome import Target

BEGINNING, END = 1500, 1500
"""Characters of a message that are shown at most."""

_PARAMETER_FILE = ".amp"


def start(arguments: Sequence[str] | None) -> NoReturn:
    """Run one verb on the standard streams and exit with its code."""
    try:
        raise_on_interrupt()
        open_streams()
        declare_command_line()
        code = run_verb(sys.argv[1:] if arguments is None else arguments)
    except KeyboardInterrupt:  # before the verb had begun
        code = FAULT
    ignore_interrupts()
    end_results()
    if stop_was_requested():
        # Run by ``python -m`` CPython would end itself by the signal where it interrupted a text given to
        # exec(), a dataclass for one, or whatever else caught the exception; the exit code would be lost.
        os._exit(code)
    gc.freeze()  # the end of Python would look through all objects for cycles: a third of the time of a check
    sys.exit(code)


def run_verb(arguments: Sequence[str]) -> int:
    """Run one verb and return its exit code."""
    # No arguments, or files that a desktop opens by a double click.
    if all(argument.lower().endswith(_PARAMETER_FILE) for argument in arguments):
        from amp_studio.ui import main as desktop

        return desktop(arguments)
    if arguments[0] == "__complete":  # a shell asks while the user types
        return _complete(arguments[1:])
    replaced: list[Target] = []
    try:
        return _run(arguments, replaced)
    except KeyboardInterrupt:  # also one that came while another refusal was put into words
        # An emulated control that has not begun yet: there is no other way to end it.
        if arguments[0] == "emulate":
            return _quit()
        return _refuse("stopped", replaced)


def _complete(words: Sequence[str]) -> int:
    """Print the completions that a shell asks for; an error prints none."""
    from .completion import answer

    try:
        answer(words, os.environ.get("AMP_STUDIO_BREAKS", ""))
    except Exception:
        return FAULT
    finally:
        end_results()
    return 0


def _run(arguments: Sequence[str], replaced: list[Target]) -> int:
    """Run one verb; ``replaced`` takes the files that it may replace."""
    code: int | None = None
    try:
        code = _call(arguments, replaced)
        if stop_was_requested():
            raise KeyboardInterrupt
        flush_results()
    except BrokenPipeError:  # a reader that has enough is no fault to be shown
        state = _refuse("nobody reads the results any more", replaced, quiet=True)
        # What has been done before is as complete as it was.
        return code if code is not None and state == CHANGED else state
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # a panic of the rule engine is no Exception
        if stop_was_requested():  # what was interrupted may end in any error
            raise KeyboardInterrupt from None
        code = AT_CONTROL.get(getattr(error, "at_control", ""), FAULT)
        return _refuse(_sentence(error) + _way(error, arguments[0]), replaced, code)
    return code


def _print_version() -> None:
    print(f"amp-studio {__version__}")


def _print_help() -> None:
    from .manual import program_help

    print(program_help(), end="")


_OF_THE_PROGRAM = {"--version": _print_version, "-h": _print_help, "--help": _print_help}
"""Options of the program itself, not of one of its verbs."""


def _call(arguments: Sequence[str], replaced: list[Target]) -> int:
    """Do what the first word names, and return the exit code; each module is loaded when it is needed."""
    name, *words = arguments
    if name in _OF_THE_PROGRAM:
        _OF_THE_PROGRAM[name]()
        return 0
    from .parsing import HelpPrinted, parse, refuse_program
    from .registry import module_of, verb_names

    if name not in verb_names():
        refuse_program(name, verb_names())
    module = module_of(name)
    try:
        options = parse(name, module.VERB, words)
    except HelpPrinted:
        return 0
    if module.VERB.writes:
        from .outcome import targets

        replaced += targets([path for each in module.VERB.writes if (path := getattr(options, each))])
    if module.VERB.at_control and sys.stdin is not None and sys.stdin.isatty():
        from .asking import ask_at_terminal

        ask_at_terminal()
    return int(module.run(options))


def _sentence(error: BaseException) -> str:
    """Return the message of an error in one line; an unforeseen one names the file with its details."""
    from amp_studio.schema import DatabaseError, UnknownParameterError
    from amp_studio.trouble import keep_details

    from .errors import UsageError

    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename or 'the results cannot be written'}: {error.strerror}"
    if isinstance(error, (UsageError, UnknownParameterError, DatabaseError, ValueError, OSError)):
        return str(error)
    return keep_details(error)


def _way(error: BaseException, verb: str) -> str:
    """Return where the command line does what an error asks for: its sentence is that of the window too."""
    from .controls.endings import way_to_know
    from .registry import module_of, verb_names

    option = f"--{str(getattr(error, 'parameter', '')).removeprefix('move.')}"
    if verb in verb_names() and option in module_of(verb).VERB.options:
        return f" ({option})"
    if getattr(error, "is_keyed_in", False):
        return " (amp-studio sheet FILE --against OTHER)"
    return way_to_know(getattr(error, "at_control", ""))


def _quit() -> int:
    print("bye")
    end_results()
    return 0


def _one_line(text: str) -> str:
    """Return a message in one line that can be read, whatever the text is that it repeats;
    its end describes the present state.
    """
    line = " ".join(text.split())
    return line if len(line) <= BEGINNING + END else f"{line[:BEGINNING]} … {line[-END:]}"


def _refuse(text: str, replaced: Sequence[Target], code: int = FAULT, *, quiet: bool = False) -> int:
    """Print in one line what went wrong and what is true now, and return the exit code;
    ``quiet`` where nothing has changed.

    ``code`` is that of the state of a control.
    """
    end_results()
    now = "; ".join(filter(None, (target.sentence() for target in replaced)))
    if now or not quiet:
        print_notice(f"amp-studio: {_one_line(text)}{f'; {now}' if now else ''}")
    return max(code, CHANGED) if now else code
