"""A template of a project to begin with: commented, with logo, colours, header and a chapter."""

from __future__ import annotations

from pathlib import Path

from amp_studio.files import SaveError

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
        _write_new(path)
        if not (own / "logo.svg").exists():
            _write_new(own / "logo.svg")
    except FileExistsError:
        raise SaveError(f"{path} exists already: it is left as it is") from None
    except OSError as error:
        raise SaveError(f"{path} cannot be written: {error.strerror or error}") from error
    return path


def _write_new(path: Path) -> None:
    with path.open("xb") as file:
        file.write((_STARTING / path.name).read_bytes())
