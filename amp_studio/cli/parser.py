"""The parser of the whole program; the options of each group of verbs are in a module of ``options``."""

from __future__ import annotations

import argparse

from amp_studio.version import __version__

from .arguments import VerbParser, Verbs
from .options import calibration, checks, documents, exchanges, facts, files, motion, shell

GROUPS = (facts, files, checks, documents, exchanges, motion, calibration, shell)
"""Modules with verbs, in the order of the help."""


def parser(asked: str = "") -> argparse.ArgumentParser:
    """Return the parser of every verb; ``module`` and ``verb`` name the function that runs.

    Where there is a verb ``asked``, it is of that one alone.
    """
    top = VerbParser(
        prog="amp-studio",
        description="Edit, check, print and exchange the parameters of a machine control. Without a verb: the desktop program, on the files that are named.",
    )
    top.add_argument("--version", action="version", version=f"amp-studio {__version__}")
    verbs = Verbs(top, asked)
    for group in GROUPS:
        group.add(verbs)
    return parser() if asked and not verbs.is_known else top


def verbs_of(top: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    """Return the parser of each verb."""
    (verbs,) = (action.choices for action in top._actions if isinstance(action.choices, dict))
    return dict(verbs)
