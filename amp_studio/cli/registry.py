"""Finds the verbs: every file in a folder of ``verbs`` is one, and is loaded when it is asked for."""

from __future__ import annotations

import os
from importlib import import_module

TYPE_CHECKING = False  # the typing module is not loaded for it
if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any

    from .verb import Verb

GROUPS = {
    "facts": "What the manuals say",
    "files": "Parameter files",
    "checks": "Findings and differences",
    "documents": "Documents and text formats",
    "controls": "Controls",
    "motion": "The machine in motion",
    "shell": "This program",
}
"""Folder of ``verbs`` -> its heading, in the order of the help."""
_FOLDER = f"{os.path.dirname(__file__)}/verbs"  # noqa: PTH120  # pathlib takes 4 ms to load


def _modules(group: str) -> Iterator[tuple[str, str]]:
    """Yield verb and module of each file of a folder;
    a word of Python has ``_`` behind it as the name of a file.
    """
    for file in sorted(os.listdir(f"{_FOLDER}/{group}")):  # noqa: PTH208  # see above
        module = file.removesuffix(".py")
        if module not in (file, "__init__"):
            yield module.rstrip("_").replace("_", "-"), module


def verb_names() -> dict[str, str]:
    """Return verb -> its module, group by group."""
    return {
        verb: f"{__package__}.verbs.{group}.{module}" for group in GROUPS for verb, module in _modules(group)
    }


def module_of(verb: str) -> Any:
    """Return the module of a verb, with its ``VERB`` and its ``run``; raises KeyError."""
    return import_module(verb_names()[verb])


def all_verbs() -> dict[str, Verb]:
    """Return name -> verb, of all of them."""
    return {name: import_module(module).VERB for name, module in verb_names().items()}


def summaries() -> dict[str, dict[str, str]]:
    """Return heading -> verb -> what it is for, from the docstrings of the files:
    to load all of them takes 50 ms.
    """
    found: dict[str, dict[str, str]] = {}
    for group, heading in GROUPS.items():
        verbs = found[heading] = {}
        for verb, module in _modules(group):
            with open(f"{_FOLDER}/{group}/{module}.py", encoding="utf-8") as file:  # noqa: PTH123  # see above
                sentence = " ".join(file.read(1000).split('"""')[1].split())
            verbs[verb] = f"{sentence[0].lower()}{sentence[1:].rstrip('.')}"
    return found
