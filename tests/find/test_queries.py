"""How often what people type finds what they want, with their slips: counted over a list written
beforehand.
"""

from functools import cache
from pathlib import Path

from ruamel.yaml import YAML

from amp_studio.find import Finder
from amp_studio.schema import load_schema

QUERIES: list[list[str]] = YAML(typ="safe").load(Path(__file__).with_name("queries.yaml").read_text("utf-8"))
KINDS = {"parameter": "p", "choice": "p", "value": "p", "message": "m", "group": "g"}


@cache
def finder_of(family: str) -> Finder:
    schema = load_schema(family)
    return Finder(schema, schema.family.default_machine)


def place(family: str, query: str, wanted: str) -> int:
    """Return at which place what is wanted was found; 0 for not at all."""
    hits = finder_of(family).find(query)
    found = list(dict.fromkeys(f"{KINDS[hit.kind]}:{hit.key}" for hit in hits))
    return found.index(wanted) + 1 if wanted in found else 0


def test_nine_of_ten_questions_find_it_at_once_and_nearly_all_among_the_first_five() -> None:
    places = {(family, query): place(family, query, wanted) for family, query, wanted in QUERIES}
    first = [asked for asked, at in places.items() if at == 1]
    among_five = [asked for asked, at in places.items() if 0 < at <= 5]
    assert len(places) >= 240
    assert len(first) >= 0.95 * len(places), {asked: at for asked, at in places.items() if at != 1}
    assert len(among_five) >= 0.98 * len(places), {
        asked: at for asked, at in places.items() if not 0 < at <= 5
    }
