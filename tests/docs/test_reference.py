"""The generated reference: everything is on it once, its links lead somewhere,
and the check of links sees what is broken.
"""

import functools
import json
import re
from collections import Counter
from html import escape, unescape
from pathlib import Path
from urllib.parse import unquote

import pytest
from check_links import faults
from reference_html import heading_id
from reference_manual import cited_pages
from reference_messages import ONLY_PRINTED
from reference_search import addresses, search_script
from write_reference import reference

from amp_studio.schema import family_ids, load_schema, read_address
from tests.campaigns import some


@functools.cache
def anchors_of(text: str) -> set[str]:
    """The anchors of a page: those that are written, and those that Sphinx makes of its headings."""
    headings = (line.lstrip("# ").replace("\\", "") for line in text.splitlines() if line.startswith("#"))
    return {*re.findall(' id="(.*?)"', text), *map(heading_id, headings)}


@pytest.fixture(scope="module")
def pages() -> dict[str, str]:
    return reference()


@pytest.mark.parametrize("family", some(family_ids(), 2))
def test_every_parameter_rule_and_message_has_one_place(family: str, pages: dict[str, str]) -> None:
    schema = load_schema(family)
    here = "".join(text for name, text in pages.items() if name.startswith(f"{family}/"))
    places, anchors = Counter(re.findall('<a id="(.*?)"></a>', here)), anchors_of(here)
    rules = [rule.id for rule in schema.rules]
    for name in (*schema.parameters, *rules):
        assert places[escape(name)] == 1, name
    for message in schema.messages.values():
        assert message.id in anchors
        assert escape(message.causes[0] if message.causes else message.reaction) in here
        assert (
            f"messages.html#{message.id}" in pages["messages.md"] or f'#{message.id}"' in pages["messages.md"]
        )
    for erratum in schema.errata.values():
        assert erratum.id in anchors_of(pages[f"{family}/errata.md"])


def test_every_link_leads_to_an_anchor(pages: dict[str, str], tmp_path: Path) -> None:
    few = {
        name: text for name, text in pages.items() if name.startswith("acromill/")
    }  # all others: make docs
    for name, text in (few | {"index.md": ""}).items():
        path = tmp_path / "reference" / name.replace(".md", ".html")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(
            "".join(f'<a id="{name}">' for name in anchors_of(text)) + re.sub(" id=.*?>", ">", text),
            encoding="utf-8",
        )
    (tmp_path / "schema.html").write_text("<p>", encoding="utf-8")
    found, count, links = faults(tmp_path)
    assert (found, count) == ([], len(few) + 2)
    assert links > 1_000


@pytest.mark.parametrize("family", family_ids())
def test_every_message_shows_how_to_find_its_cause_or_that_nothing_is_printed(
    family: str, pages: dict[str, str]
) -> None:
    schema = load_schema(family)
    for every in schema.message_lists:
        _, *sections = re.split("^## ", pages[f"{family}/messages-{every.id}.md"], flags=re.MULTILINE)
        assert len(sections) == len(every.messages)
        for message, section in zip(every.messages, sections, strict=True):
            steps = re.findall("<li>(.+)</li>", section)
            sentence = [
                *message.causes,
                *message.cures,
                *(name for name in message.params if name in schema.parameters),
            ]
            assert len(steps) >= len(sentence), message.id
            for name in (*message.params, *message.rules):
                assert f'#{escape(name)}"' in section, (message.id, name)
            assert (ONLY_PRINTED in section) == (not steps), message.id


def test_a_message_without_a_printed_cause_leads_to_its_parameters_and_their_rules(
    pages: dict[str, str],
) -> None:
    alarms = pages["grblhal/messages-alarms.md"]
    (section,) = re.findall(r"^## ALARM\\:2 Soft limit\n.*?(?=^## )", alarms, re.MULTILINE | re.DOTALL)
    assert "No cause is printed." in section
    order = [
        section.index(place)
        for place in ("#limits.soft", "rules.html#grblhal.limits.no-travel", "#axis.max_travel")
    ]
    assert order == sorted(order)


def test_a_page_of_the_printed_manual_leads_to_what_is_taken_from_it(pages: dict[str, str]) -> None:
    (row,) = re.findall(' id="page-7-20">.*?(?= id=)', pages["9pc/pages.md"], re.DOTALL)
    for sentence in (
        "servo.excess_error",
        "messages-amp-messages.html#excess-following-error",
        "9pc.servo.excess-margin",
        "e-1750-range",
    ):
        assert sentence in row
    assert 'page <a href="pages.html#page-7-20">7-20</a>' in pages["9pc/group-servo_position.md"]


@pytest.mark.parametrize(
    ("text", "pages"),
    [
        ("(page 7-20)", ["7-20"]),
        ("bandwidth is needed (pages 3-5 and 3-6).", ["3-5", "3-6"]),
        ("pages 1.5.1, 1.5.2 and A-1: it", ["1.5.1", "1.5.2", "A-1"]),
        ("the page of its own", []),
    ],
)
def test_the_pages_that_a_text_cites_are_read(text: str, pages: list[str]) -> None:
    assert cited_pages(text) == pages


def test_a_style_that_is_loaded_from_the_network_is_found(tmp_path: Path) -> None:
    (tmp_path / "a.html").write_text("<p>", encoding="utf-8")
    (tmp_path / "a.css").write_text(
        "@import 'https://example.org/f.css'; p { background: url(b.svg) }", encoding="utf-8"
    )
    assert faults(tmp_path)[0] == ["a.css: loads https://example.org/f.css"]


def test_what_the_search_leads_to_is_checked(tmp_path: Path) -> None:
    (tmp_path / "_static").mkdir()
    (tmp_path / "index.html").write_text('<p id="here">', encoding="utf-8")
    entries = [["guide", title, f"index.html#{title}", [], "", ""] for title in ("here", "gone")]
    script = f"searchEntries({json.dumps([{'folder': '', 'entries': entries}])});"
    (tmp_path / "_static/search-entries.js").write_text(script, encoding="utf-8")
    assert faults(tmp_path)[0] == ["search: index.html#gone has no such anchor"]


def test_every_entry_of_the_search_leads_to_an_anchor(pages: dict[str, str]) -> None:
    entries = [unquote(address) for address in addresses(search_script([]))]
    assert len(entries) > 3_000
    for address in entries:
        name, _, anchor = address.removeprefix("reference/").partition("#")
        assert not anchor or anchor in anchors_of(pages[name.replace(".html", ".md")]), address


@pytest.mark.parametrize("family", family_ids())
def test_the_section_of_each_parameter_has_all_that_is_known_of_it(
    family: str, pages: dict[str, str]
) -> None:
    schema = load_schema(family)
    for group in schema.groups:
        _, *sections = re.split("^## ", pages[f"{family}/group-{group.key}.md"], flags=re.MULTILINE)
        for parameter, section in zip(group.parameters, sections, strict=True):
            text = " ".join(unescape(section).split())
            helped = parameter.help
            notes = [n.says for n in (*helped.danger, *helped.warning, *helped.note)]
            errata = [r.says for e in parameter.errata for r in schema.errata[e].readings]
            labels = [choice.label for choice in parameter.choices or ()]
            for sentence in (
                helped.what,
                helped.find,
                helped.wrong,
                *notes,
                *errata,
                *labels,
                f">{parameter.page}</a>",
            ):
                assert " ".join(sentence.split()) in text, (parameter.id, sentence)
            reading = [
                r.id
                for r in schema.rules
                if any(read_address(read)[0] == parameter.id for read in r.reads.values())
            ]
            saying = [m.id for m in schema.messages_of(parameter.id)]
            for anchor in (*helped.related, *reading, *saying):
                assert f'#{anchor}"' in section, (parameter.id, anchor)


def test_a_number_leads_to_its_parameter(pages: dict[str, str]) -> None:
    assert '<a href="group-servo_position.html#n-2750">Excess Error</a>, Axis 2' in pages["9pc/numbers.md"]
    assert "2750</td><td>" in pages["9pc/numbers.md"]  # the search drops a word that is only a number
    position = pages["9pc/group-servo_position.md"]
    (section,) = re.findall(r"^## 1750 Excess Error\n.*?(?=^## )", position, re.MULTILINE | re.DOTALL)
    for sentence in (
        "0 to 214.1 mm",
        "page 7-20",
        "messages-amp-messages.html#excess-following-error",
        "rules.html#9pc.servo.excess-margin",
        "commissioning.html#step-6",
        "minimum_excess_error(",
    ):
        assert sentence in section, sentence


@pytest.mark.parametrize(
    ("link", "fault"),
    [
        ('<b id="here">', "the anchor here is there twice"),
        ('<a href="none.html">', "none.html is not there"),
        ('<a href="#none">', "#none has no such anchor"),
        ('<a href="../else.html">', "../else.html leads out of the site"),
        ('<script src="https://example.org/x.js"></script>', "loads https://example.org/x.js"),
    ],
)
def test_a_broken_link_is_found(link: str, fault: str, tmp_path: Path) -> None:
    site = tmp_path / "site"
    site.mkdir()
    (site / "a.html").write_text(f'<p id="here"><a href="#here">{link}', encoding="utf-8")
    assert faults(site)[0] == [f"a.html: {fault}"]
