"""A template of a project to begin with: commented, with logo, colours, header and a chapter."""

from __future__ import annotations

from pathlib import Path

from .templates import OWN

_STARTING = Path(__file__).parents[1] / "starting"
NAME = "report.typ.j2"


def write_starting_template(folder: Path) -> Path:
    """Write the template into the folder ``templates`` of a project; returns its path.

    Raises FileExistsError where there is one; a logo that is already there stays.
    Raises OSError where it cannot be written.
    """
    own = folder / OWN
    path = own / NAME
    own.mkdir(exist_ok=True)
    try:
        _write_new(path)
    except FileExistsError:
        raise FileExistsError(f"{path} exists already: it is left as it is") from None
    if not (own / "logo.svg").exists():
        _write_new(own / "logo.svg")
    return path


def _write_new(path: Path) -> None:
    with path.open("xb") as file:
        file.write((_STARTING / path.name).read_bytes())
