"""The files that lie beside a parameter file and count when it is checked: their names alone.

A run that finds all its results kept asks for no more, so that nothing else is loaded with this.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path

from amp_studio.files import RECORD, backup_path, history_path, is_of_machine, real_path

RULES_FILE = "rules.yaml"
"""A builder's own rules, for the files of their folder."""

LARGEST_FLEET = 40
"""Machines in a folder that are compared; more of them are no fleet that is looked after by hand."""


def companions_of(path: Path) -> list[Path]:
    """Return what ``earlier_beside`` reads beside what a file names itself; not all of it is there.
    Raises OSError.
    """
    real = real_path(path)
    return [backup_path(real), history_path(real), real.with_name(RECORD), *fleet_of(real)]


def companion_names(name: str, machines: Iterable[str]) -> list[str]:
    """Return the names of the same, of a file that is no link, where ``machines`` are those of its folder."""
    return [f"{name}.bak", f"{name}.history", RECORD, *(other for other in machines if other != name)]


def machines_of(folder: Path) -> tuple[str, ...]:
    """Return the names of the parameter files of a folder; none where there are too few or too many.
    Raises OSError.
    """
    # The time of a folder changes whenever a name comes or goes, and only names are asked for.
    return _machines_in(folder, folder.stat().st_mtime_ns)


def fleet_of(path: Path) -> list[Path]:
    """Return the other parameter files in the folder of a file; none where there are too few or too many.
    Raises OSError.
    """
    return [path.with_name(name) for name in machines_of(path.parent) if name != path.name]


@lru_cache(maxsize=16)
def _machines_in(folder: Path, changed: int) -> tuple[str, ...]:  # noqa: ARG001  # another one after a change of the folder
    names = sorted(each.name for each in folder.iterdir() if is_of_machine(each.name))
    # The file itself and three others: values_of_fleet asks for three that agree.
    return tuple(names) if 4 <= len(names) <= LARGEST_FLEET else ()
