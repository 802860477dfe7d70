"""The command line: every verb of the program without a display.

Exit codes: 0 done and nothing wrong; 1 done, and what was checked has errors;
2 the input cannot be used (one line on standard error, nothing written).
argparse is used because it answers misuse with exit code 2 and costs no start-up time;
the module of a verb, with the rooms it needs, is loaded when the verb is called.
"""

from __future__ import annotations

import io
import sys
from collections.abc import Sequence
from importlib import import_module
from typing import NoReturn

from amp_studio.schema import DatabaseFault, UnknownParameter, ValueFault

from .console import UsageFault
from .parser import parser

FAULT = 2


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run one verb and exit with its code; without a verb the desktop program opens."""
    for stream in (sys.stdout, sys.stderr):  # a sign that the terminal does not have is no reason to stop
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    sys.exit(run(sys.argv[1:] if arguments is None else arguments))


def run(arguments: Sequence[str]) -> int:
    """Run one verb and return its exit code."""
    if not arguments:
        from amp_studio.ui import main as desktop

        return desktop([])
    try:
        options = parser().parse_args(arguments)
        verb = getattr(import_module(f".{options.module}", __name__), options.verb)
        return int(verb(options))
    except (UsageFault, UnknownParameter, ValueFault, DatabaseFault) as error:
        return _refuse(str(error))
    except BrokenPipeError:
        sys.stderr.close()
        return FAULT
    except KeyboardInterrupt:
        return _refuse("stopped")
    except (ValueError, OSError) as error:
        return _refuse(_one_line(error))


def _one_line(error: Exception) -> str:
    if isinstance(error, OSError) and error.strerror and error.filename:
        return f"{error.filename}: {error.strerror}"
    return " ".join(str(error).split())


def _refuse(text: str) -> int:
    print(f"amp-studio: {text}", file=sys.stderr)
    return FAULT
