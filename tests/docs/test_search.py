"""The search of the site, asked in a real Chromium on file://: the right page and anchor come first,
without a server.
"""

import json
import os
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import unquote

import pytest
from reference_html import every_number
from reference_search import guide_entries, search_script
from ruamel.yaml import YAML

from amp_studio.schema import load_schema
from tests.report.browser import CHROMIUM, Browser

DOCS = Path(__file__).parents[2] / "docs"
QUERIES: list[tuple[str, str]] = [
    (query, wanted.removeprefix("/") if wanted.startswith("/") else f"reference/{wanted}")
    for query, wanted in YAML(typ="safe").load(Path(__file__).with_name("search_queries.yaml"))
]
FIELD = "form[role=search] input[name=q]"


@pytest.fixture(scope="module")
def script() -> str:
    return search_script(guide_entries(DOCS))


@pytest.fixture(scope="module")
def site(script: str, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A page with the field of the site's pages, and the scripts; or the site that AMP_STUDIO_SITE names."""
    if made := os.environ.get("AMP_STUDIO_SITE"):
        return Path(made).resolve()
    folder = tmp_path_factory.mktemp("site")
    (folder / "_static").mkdir()
    for name, text in {
        "search-entries.js": script,
        "search.js": (DOCS / "_static/search.js").read_text(encoding="utf-8"),
    }.items():
        (folder / "_static" / name).write_text(text, encoding="utf-8")
    form = '<form role="search" action="search.html"><input name="q"></form>'
    head = (
        '<!doctype html><meta charset="utf-8"><html data-content_root="./"><script '
        'src="_static/search.js"></script>'
    )
    for name in (
        "index.html",
        "search.html",
        "reference/9pc/group-home.html",
        "reference/syntec/messages-alarms.html",
    ):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(
            f'{head}<body>{form}<div id="search-results"></div></body></html>', encoding="utf-8"
        )
    return folder


@pytest.fixture(scope="module")
def browser(site: Path) -> Iterator[Browser]:
    if CHROMIUM is None:
        pytest.skip("no Chromium is installed")
    with Browser(site / "index.html") as browser:
        yield browser


@pytest.fixture
def field(browser: Browser, site: Path) -> Browser:
    browser.go((site / "index.html").as_uri())
    browser.click(FIELD)
    browser.until("typeof searchEntries === 'function' && document.querySelector('.suggestions') !== null")
    return browser


def test_what_people_type_has_the_right_place_first(field: Browser) -> None:
    assert len(QUERIES) >= 40
    field.type("1")  # the entries are loaded when somebody searches
    field.until("document.querySelector('.suggestions a') !== null")
    missed = {}
    for query, wanted in QUERIES:
        found = field.value(f"searchSite({json.dumps(query)})")
        if not found or unquote(found[0]) != wanted:
            missed[query] = found[:3]
    assert not missed


def _is(address: str, family: str, wanted: str) -> bool:
    """Whether an address is that of a parameter (``p:``), a message (``m:``) or a group (``g:``) of a
    family.
    """
    schema = load_schema(family)
    kind, key = wanted.split(":", 1)
    page, _, anchor = address.removeprefix(f"reference/{family}/").partition("#")
    if kind == "g":
        return page == f"group-{key}.html"
    numbers = every_number(schema, schema.parameters[key]) if kind == "p" else ()
    return anchor == key or anchor in {f"n-{number}" for number in numbers}


def test_what_the_program_finds_the_site_finds_too(field: Browser) -> None:
    questions = YAML(typ="safe").load(Path(__file__).parents[1] / "find/queries.yaml")
    field.type("1")
    field.until("document.querySelector('.suggestions a') !== null")
    places = []
    for family, query, wanted in questions:
        found = field.value(f"searchSite({json.dumps(f'{query} {family}')})")
        right = [n for n, address in enumerate(found) if _is(unquote(address), family, wanted)]
        places.append(min(right, default=99))
    assert len(places) > 100
    assert sum(place == 0 for place in places) > 0.92 * len(places)
    assert sum(place < 5 for place in places) > 0.96 * len(places)


def test_a_suggestion_is_chosen_by_the_keyboard_and_opened_at_its_anchor(field: Browser) -> None:
    field.type("1300")
    first = "document.querySelector('.suggestions a')"
    field.until(f"{first} !== null && {first}.textContent.includes('1300 Home Calibration')")
    field.press("ArrowDown")
    assert field.value(f"{first}.getAttribute('aria-selected')") == "true"
    field.press("Enter")
    field.until("location.href.endsWith('reference/9pc/group-home.html#n-1300')")


def test_a_suggestion_is_opened_by_a_click(field: Browser) -> None:
    field.type("MOT-022")
    first = "document.querySelector('.suggestions a')"
    field.until(f"{first} !== null && {first}.textContent.includes('Home position inaccurate')")
    field.click(".suggestions a")
    field.until("location.href.endsWith('reference/syntec/messages-alarms.html#mot-022')")


def test_escape_closes_the_suggestions(field: Browser) -> None:
    field.type("home")
    field.until("!document.querySelector('.suggestions').hidden")
    field.press("Escape")
    assert field.value("document.querySelector('.suggestions').hidden")
    assert field.value(f"document.querySelector({json.dumps(FIELD)}).value") == "home"


def test_the_page_of_results_begins_with_the_best_matches(browser: Browser, site: Path) -> None:
    browser.go((site / "search.html").as_uri() + "?q=MOT-022")
    first = "document.querySelector('#search-results ul.search a')"
    browser.until(f"{first} !== null")
    assert browser.value(f"{first}.href").endswith("reference/syntec/messages-alarms.html#mot-022")
    assert browser.value(f"document.querySelector({json.dumps(FIELD)}).value") == "MOT-022"


def test_markup_in_a_question_stays_text(browser: Browser, site: Path) -> None:
    browser.go(
        (site / "search.html").as_uri() + "?q=%3Cimg%20src%3Dx%20onerror%3D%22document.title%3D1%22%3E%20home"
    )
    browser.until("document.querySelector('#search-results ul.search a') !== null")
    assert browser.value("document.querySelector('#search-results img')") is None
