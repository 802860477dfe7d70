"""The web page in a real browser, with real keys: searching, jumping, help, a phone, paper."""

from collections.abc import Iterator
from itertools import count, pairwise
from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.report import print_report

from .browser import CHROMIUM, Browser

_VISITS = count(1)
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="needs Chromium")


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory, first_mill: ParameterFile) -> Path:
    path = tmp_path_factory.mktemp("page") / "mill.html"
    print_report(first_mill.copy(), path)
    return path


@pytest.fixture(scope="module")
def browser(page: Path) -> Iterator[Browser]:
    with Browser(page) as open_browser:
        yield open_browser


@pytest.fixture(autouse=True)
def reload(browser: Browser, page: Path) -> None:
    browser.go(f"{page.as_uri()}?{next(_VISITS)}")


def found(browser: Browser) -> str:
    return str(browser.value("document.getElementById('found').textContent"))


def row_at(browser: Browser) -> str:
    return str(browser.value("document.querySelector('.at').textContent"))


def test_hits_are_counted_and_enter_jumps_from_one_to_the_next(browser: Browser) -> None:
    browser.click("#search")
    browser.type("home calibration")
    assert found(browser).endswith(" hits")
    count = int(found(browser).split()[0])
    assert count > 1
    browser.press("Enter")
    assert found(browser) == f"1 of {count}"
    first = row_at(browser)
    assert browser.value("document.querySelector('.at mark, .at + .help mark') !== null")
    assert browser.value(
        "(r => r.top >= 0 && r.bottom <= innerHeight)(document.querySelector('.at').getBoundingClientRect())"
    )
    browser.press("Enter")
    assert found(browser) == f"2 of {count}"
    assert row_at(browser) != first
    browser.press("Enter", shift=True)
    assert row_at(browser) == first
    browser.press("Escape")
    assert found(browser) == ""
    assert browser.value("document.querySelector('mark')") is None


def test_the_text_of_a_help_is_found_and_shown_below_its_row(browser: Browser) -> None:
    """Lead Screw Thread Pitch: its help has the example of 5 threads per inch (page 7-17)."""
    browser.click("#search")
    browser.type("threads per inch")
    browser.press("Enter")
    assert "Lead Screw Thread Pitch" in row_at(browser)
    displayed = str(browser.value("document.querySelector('tr.help').textContent"))
    assert "5 threads per inch" in displayed
    assert "page 7-17" in displayed


def test_no_script_of_the_page_fails_and_its_outline_has_no_gap(browser: Browser, page: Path) -> None:
    browser.before_each_page("window.failures = []; addEventListener('error', e => failures.push(e.message))")
    browser.go(f"{page.as_uri()}?errors")
    browser.click("#search")
    browser.type("(")
    browser.press("Enter")
    browser.press("Escape")
    browser.click("#changed")
    assert browser.value("failures") == []
    levels = browser.value("[...document.querySelectorAll('h1,h2,h3,h4')].map(h => +h.tagName[1])")
    assert levels.count(1) == 1
    assert all(b - a <= 1 for a, b in pairwise(levels))
    assert browser.value("document.querySelectorAll('th:not([scope]), img:not([alt])').length") == 0
    assert browser.value("document.querySelectorAll('[src^=http], link, [href^=http]').length") == 0


@pytest.mark.parametrize("typed", ["exess", "excesss", "excass", "execss"])
def test_one_slip_in_a_word_is_forgiven(browser: Browser, typed: str) -> None:
    counts = []
    for word in ("excess error", f"{typed} error"):
        browser.click("#search")
        browser.type(word)
        counts.append(found(browser))
        browser.press("Escape")
    assert counts[0] == counts[1] != "no hits"


def test_a_parameter_is_found_by_its_id(browser: Browser) -> None:
    browser.click("#search")
    browser.type("servo.excess_error")
    browser.press("Enter")
    assert "Excess Error" in row_at(browser)
    assert browser.value("document.querySelector('tr.help')") is None


def test_what_is_nowhere_is_reported(browser: Browser) -> None:
    browser.click("#search")
    browser.type("flux capacitor")
    assert found(browser) == "no hits"
    assert browser.value("document.getElementById('next').disabled")


def test_only_hits_hides_the_rest_of_the_values(browser: Browser) -> None:
    every = browser.value(
        "[...document.querySelectorAll('#values tbody tr')].filter(r => r.offsetParent).length"
    )
    browser.click("#only")
    browser.click("#search")
    browser.type("1750")
    displayed = browser.value(
        "[...document.querySelectorAll('#values tbody tr')].filter(r => r.offsetParent).length"
    )
    assert 0 < displayed < every
    assert "Excess Error" in browser.value("document.getElementById('values').innerText")
    assert "Home Calibration" not in browser.value("document.getElementById('values').innerText")


def test_a_name_opens_its_help_by_mouse_and_by_keyboard(browser: Browser) -> None:
    name = "[data-help='home.calibration']"
    browser.click(name)
    assert "Home" in browser.value("document.querySelector('tr.help').textContent")
    browser.value(f'document.querySelector("{name}").focus()')
    browser.press("Enter")
    assert browser.value("document.querySelector('tr.help')") is None


def test_a_phone_scrolls_the_tables_and_folds_the_contents(page: Path) -> None:
    with Browser(page, 360, 740) as phone:
        assert phone.value("document.documentElement.scrollWidth") == 360, (
            "only the tables are wider than the screen"
        )
        button = phone.value("document.getElementById('next').getBoundingClientRect().height")
        assert button >= 44, "a thumb finds it"
        assert not phone.value("document.getElementById('menu').open")
        phone.click("#menu > summary")
        assert phone.value("document.getElementById('menu').open")
        phone.click("#menu a[href='#findings']")
        assert not phone.value("document.getElementById('menu').open"), "a choice closes it"
        wide = "[...document.querySelectorAll('.wide')].some(w => w.scrollWidth > w.clientWidth)"
        assert phone.value(wide)


def test_no_text_of_a_table_runs_over_the_next_column(browser: Browser, tmp_path: Path) -> None:
    """NUM has the longest numbers (``P9N0, P9N1 … P9N3, P9N24, P9N28``) and columns (``Axis 28
    handwheel``).
    """
    print_report(open_file(examples_folder() / "num-1060-mill" / "MILL_1060.amp").file, tmp_path / "num.html")
    cells = "[...document.querySelectorAll('#values td, #values th')]"
    browser.go((tmp_path / "num.html").as_uri())
    assert browser.value(f"{cells}.length") > 1000
    assert browser.value(f"{cells}.filter(e => e.scrollWidth > e.clientWidth).map(e => e.innerText)") == []


def test_on_paper_there_are_neither_menu_nor_buttons(browser: Browser, tmp_path: Path) -> None:
    printed = browser.pdf()
    assert printed.startswith(b"%PDF")
    (tmp_path / "p.pdf").write_bytes(printed)
    from .test_pdf import poppler, texts_of

    if not poppler.args[0]:
        text = " ".join(texts_of(tmp_path / "p.pdf"))
        assert "Home Calibration" in text
        assert "only hits" not in text
