"""A template of a project to begin with: commented, with logo, colours, header and a chapter."""

from __future__ import annotations

from pathlib import Path

from amp_studio.files import SaveError, is_there, write_atomic

from .templates import OWN

_STARTING = Path(__file__).parents[1] / "starting"
NAME = "report.typ.j2"


def write_starting_template(folder: Path) -> Path:
    """Write the template into the folder ``templates`` of a project; returns its path.

    Raises SaveError where there is one, or where it cannot be written; a logo that is already there stays.
    """
    own = folder / OWN
    path = own / NAME
    try:
        own.mkdir(exist_ok=True)
    except OSError as error:
        raise SaveError(f"{path} cannot be written: {error.strerror or error}") from error
    if is_there(path):
        raise SaveError(f"{path} exists already: it is left as it is")
    # All or nothing: on a full disk an empty template would stay, and be that of every report.
    for name in ("logo.svg", NAME):
        if not is_there(own / name):
            write_atomic(own / name, (_STARTING / name).read_bytes(), None)
    return path
