"""The web page: whole in itself, its links lead somewhere, its texts are escaped."""

from html.parser import HTMLParser

import pytest

from amp_studio.files import ParameterFile
from amp_studio.report import SORTS, Contents
from amp_studio.report.build import build_report
from amp_studio.report.contents import Sort
from amp_studio.report.output.page import render_html
from tests.campaigns import some

VOID = {"meta", "link", "br", "input", "col", "img", "hr"}


class Reader(HTMLParser):
    """Collects ids, links and texts, and finds tags that are not closed in their order."""

    def __init__(self) -> None:
        super().__init__()
        self.ids: list[str] = []
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.texts: list[str] = []
        self._open: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        known = dict(attrs)
        self.ids += [v for k, v in attrs if k == "id" and v]
        self.links += [v for k, v in attrs if k == "href" and v]
        self.loaded += [
            k for k in ("src", "srcset", "data") if k in known and not str(known[k]).startswith("data:")
        ] + ([tag] if tag == "link" else [])
        if tag not in VOID:
            self._open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self._open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.texts.append(data)


def read(file: ParameterFile, sort: Sort = "group") -> tuple[Reader, str]:
    page = render_html(build_report(file, Contents(sort))).decode()
    reader = Reader()
    reader.feed(page)
    return reader, page


@pytest.mark.parametrize("sort", some(SORTS))
def test_every_link_leads_to_a_place_on_the_page(mill: ParameterFile, sort: Sort) -> None:
    reader, _ = read(mill, sort)
    assert len(set(reader.ids)) == len(reader.ids), "an id names one place"
    assert {link[1:] for link in reader.links} <= set(reader.ids)
    assert "#servo.gain_break_point@1" in reader.links, "a finding leads to its value"


def test_nothing_is_loaded_from_elsewhere(mill: ParameterFile) -> None:
    reader, page = read(mill)
    assert reader.loaded == []
    assert all(link.startswith("#") for link in reader.links)
    assert not any(word in page for word in ("http:", "https:", "@import", "url("))


def test_a_text_stays_a_text(mill: ParameterFile) -> None:
    mill.header.name = '<b onclick="x">Mill</b> & Co'
    mill.forced[("servo.gain_break_point", "1")] = '"><script>alert(1)</script>'
    reader, page = read(mill)
    assert '<b onclick="x">Mill</b> & Co' in reader.texts
    assert '"><script>alert(1)</script>' in reader.texts
    assert page.count("<script>") == 1, "the page's own search"


def test_every_value_is_on_the_page(mill: ParameterFile) -> None:
    reader, _ = read(mill)
    assert {r.anchor for r in build_report(mill).rows()} <= set(reader.ids)
    assert {"12", ".5", "−2", ".54", "999999"} <= {t.strip() for t in reader.texts}
