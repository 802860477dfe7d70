"""The generated reference: everything is on it once, its links lead somewhere, and the check of links sees what is broken."""

from __future__ import annotations

import re
from html import escape
from pathlib import Path

import pytest
from check_links import faults
from write_reference import reference

from amp_studio.schema import family_ids, load_schema


@pytest.fixture(scope="module")
def pages() -> dict[str, str]:
    return reference()


@pytest.mark.parametrize("family", family_ids())
def test_every_parameter_rule_and_message_has_one_place(family: str, pages: dict[str, str]) -> None:
    schema = load_schema(family)
    here = "".join(text for name, text in pages.items() if name.startswith(f"{family}/"))
    rules = [rule.id for rule in schema.rules]
    for name in (*schema.parameters, *rules):
        assert here.count(f'<a id="{escape(name)}"></a>') == 1, name
    for message in schema.messages.values():
        assert f'<a id="{escape(message.id)}"></a>' in here
        assert escape(message.causes[0] if message.causes else message.reaction) in here
    for erratum in schema.errata.values():
        assert f'<a id="{erratum.id}"></a>' in pages[f"{family}/errata.md"]


def test_every_link_leads_to_an_anchor(pages: dict[str, str], tmp_path: Path) -> None:
    few = {
        name: text for name, text in pages.items() if name.startswith("acromill/")
    }  # all others: make docs
    for name, text in (few | {"index.md": ""}).items():
        path = tmp_path / "reference" / name.replace(".md", ".html")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    (tmp_path / "schema.html").write_text("<p>", encoding="utf-8")
    found, count, links = faults(tmp_path)
    assert (found, count) == ([], len(few) + 2)
    assert links > 1_000


def test_a_number_leads_to_its_parameter(pages: dict[str, str]) -> None:
    assert '<a href="group-servo_position.html#n-2750">Excess Error</a>, Axis 2' in pages["9pc/numbers.md"]
    assert "2750</td><td>" in pages["9pc/numbers.md"]  # the search drops a word that is only a number
    position = pages["9pc/group-servo_position.md"]
    (section,) = re.findall(r"^## 1750 Excess Error\n.*?(?=^## )", position, re.MULTILINE | re.DOTALL)
    for said in ("0 to 214.1 mm", "page 7-20", "messages-amp-messages.html#excess-following-error",
                 "rules.html#9pc.servo.excess-margin", "commissioning.html#step-6", "minimum_excess_error("):  # fmt: skip
        assert said in section, said


@pytest.mark.parametrize(
    ("link", "fault"),
    [
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
