"""Which families bring code and where their records are, without loading any:
help and completion come at once.

The program's families are listed in ``amp_studio/families``. Another package brings one by an entry point of
the group
``amp_studio.families``: the id of the family, and ``module:NAME`` of its record (docs/family-code.md).
"""

from __future__ import annotations

import os
import sys
from functools import cache
from importlib import import_module
from pathlib import Path

_GROUP = "amp_studio.families"
"""Group of entry points, and the module with the program's own table."""


def own_places() -> dict[str, str]:
    """Return family -> place of its record, of the families of the program."""
    places: dict[str, str] = import_module(_GROUP).FAMILIES
    return places


def own_formats() -> dict[str, str]:
    """Return name -> what it is and its endings, of the text formats of the program's families."""
    formats: dict[str, dict[str, str]] = import_module(_GROUP).FORMATS
    return {name: what for each in formats.values() for name, what in each.items()}


@cache
def installed_places() -> dict[str, str]:
    """Return the same of the families of other packages; an id of the program's own stays the program's."""
    if not any(map(_has_families, sys.path)):
        return {}
    from importlib.metadata import entry_points

    own = own_places()
    return {each.name: each.value for each in entry_points(group=_GROUP) if each.name not in own}


def _has_families(folder: str) -> bool:
    """Return whether a package in a folder of the path brings a family.

    A look into the files takes 2 ms for eighty packages; loading importlib.metadata, to ask it, takes 35,
    which every start would pay for the few who have such a package.
    """
    try:
        with os.scandir(folder or os.curdir) as entries:
            packages = [entry.path for entry in entries if entry.name.endswith("-info")]
    except OSError:  # no folder: the zip archive of the standard library
        return False
    for package in packages:
        try:
            if f"[{_GROUP}]" in Path(package, "entry_points.txt").read_text("utf-8"):
                return True
        except (OSError, ValueError):  # most have none
            continue
    return False
