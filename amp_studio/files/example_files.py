"""The example machines that come with the program. They are copied, never edited where they lie."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path

from .paths import ENDING
from .project import Project
from .reading import ParameterFileError


@dataclass(frozen=True)
class Example:
    """One example machine."""

    path: Path
    family: str
    title: str
    """What machine it is: ``Lathe with a distance-coded scale``."""
    description: str
    """The first paragraph about it."""


def examples_folder() -> Path:
    """Return where the examples are: inside the installed package, or at the top of the checkout."""
    package = Path(__file__).resolve().parents[1]
    inside = package / "examples"
    return inside if inside.is_dir() else package.parent / "examples"


@cache
def examples() -> tuple[Example, ...]:
    """Return the examples in the order of their families; one that cannot be read is left out."""
    found = []
    for path in examples_folder().glob(f"*/*{ENDING}"):
        try:
            family = Project.open(path.parent).info.family
            text = path.with_name("README.md").read_text(encoding="utf-8")
        except (OSError, ParameterFileError):
            continue
        head, _, rest = text.partition("\n")
        paragraph = rest.strip().partition("\n\n")[0]
        found.append(Example(path, family, head.lstrip("# ").strip(), " ".join(paragraph.split())))
    return tuple(sorted(found, key=lambda e: (e.family, e.title)))
