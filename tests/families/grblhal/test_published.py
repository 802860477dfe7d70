"""Real listings are read as what they are, come back as they were, and are called wrong only where they are."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from amp_studio.cli import run
from amp_studio.formats import export_file, import_file
from amp_studio.schema.yaml_reader import read_yaml
from amp_studio.validate import Validator

LISTINGS: list[dict[str, Any]] = read_yaml(Path(__file__).with_name("listings.yaml").read_text("utf-8")).data[
    "listings"
]
NAMES = [f"{n} {one['name']}" for n, one in enumerate(LISTINGS, 1)]


def settings_of(one: dict[str, Any]) -> dict[str, str]:
    return dict(each.split("=", 1) for each in one["settings"].split())


@pytest.fixture(params=LISTINGS, ids=NAMES)
def listing(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[dict[str, Any], Path]:
    """Return a listing and the text of it."""
    path = tmp_path / "listing.txt"
    path.write_text("".join(f"${n}={text}\n" for n, text in settings_of(request.param).items()), "utf-8")
    return request.param, path


def test_a_published_listing_is_what_the_firmware_takes_it_for(
    listing: tuple[dict[str, Any], Path], tmp_path: Path
) -> None:
    one, path = listing
    notes: list[str] = []
    file = import_file(path, notify=notes.append)
    assert file.machine == one["machine"]
    assert [f.rule for f in Validator(file).run() if f.severity == "error"] == one["errors"]
    assert sum("kept as text" in note for note in notes) <= 2, "one note for all of a kind"
    again = tmp_path / "again.settings"
    export_file(file, again)
    back = dict(line[1:].split("=", 1) for line in again.read_text("utf-8").splitlines())
    assert {n: same(text, back[n]) for n, text in settings_of(one).items()} == settings_of(one)
    assert back.keys() == settings_of(one).keys(), "nothing is added"


def same(text: str, back: str) -> str:
    """Return the text where the other one is the same: a number may be written with more or fewer zeros."""
    try:
        return text if float(text) == float(back) else back
    except ValueError:
        return back


def test_the_verb_takes_it_without_a_question(listing: tuple[dict[str, Any], Path], tmp_path: Path) -> None:
    _, path = listing
    assert run(["import", str(path), "-o", str(tmp_path / "made.amp")]) == 0
