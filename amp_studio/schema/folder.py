"""Where the facts are."""

from __future__ import annotations

from pathlib import Path


def database_folder() -> Path:
    """Return the folder of facts: inside the installed package, or at the top of the checkout."""
    package = Path(__file__).resolve().parent.parent
    inside = package / "parameter_db"
    return inside if inside.is_dir() else package.parent / "parameter_db"
