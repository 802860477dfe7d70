"""The messages of the controls, against a second reading of the manuals and the pages
of the constraining statements.
"""

import re
from functools import lru_cache
from pathlib import Path

import pytest
from ruamel.yaml import YAML

from amp_studio.schema import load_schema
from amp_studio.schema.model import ControlMessage

HERE = Path(__file__).parent
PRINTED: dict[str, dict[str, list[int]]] = YAML(typ="safe").load((HERE / "messages.yaml").read_text("utf-8"))
"""Family -> text or number -> the lines of the manual's text that have it."""
COUNTS = {"9pc": 49, "num": 17, "syntec": 18, "57c422b": 9, "acromill": 7, "grblhal": 111}
PRINTED_TEXTS = [(family, text) for family, texts in PRINTED.items() for text in texts]


def plain(text: str) -> str:
    """Return a text without case and punctuation."""
    return " ".join(re.findall(r"[a-z0-9]+", text.casefold()))


def found(family: str, printed: str) -> ControlMessage | None:
    """Return the message that has a printed text, or the number behind ``error``."""
    number = plain(re.sub(r"^errors?( of type)? ", "", printed))
    for message in load_schema(family).messages.values():
        own = [plain(text) for text in (message.text, message.code, *message.also)]
        if number in own or any(plain(printed) in text for text in own if len(printed) > 12):
            return message
    return None


@lru_cache
def pages(family: str) -> dict[int, str]:
    """Return the page of each line that a list of constraining statements has."""
    lists = (HERE / "constraints").glob(f"{family}*.yaml")
    entries = [entry for path in lists for entry in YAML(typ="safe").load(path.read_text("utf-8"))]
    return {entry["line"]: entry["page"] for entry in entries}


@pytest.mark.parametrize(("family", "printed"), PRINTED_TEXTS)
def test_every_printed_message_is_known_on_each_of_its_pages(family: str, printed: str) -> None:
    message = found(family, printed)
    assert message is not None
    known = {pages(family)[line] for line in PRINTED[family][printed] if line in pages(family)}
    assert known <= set(message.every_page)


@pytest.mark.parametrize("family", PRINTED)
def test_every_text_of_a_message_is_in_the_second_reading(family: str) -> None:
    again = {message.id for text in PRINTED[family] if (message := found(family, text)) is not None}
    printed = {m.id for m in load_schema(family).messages.values() if m.text or m.code.isdigit()}
    assert printed - again == (
        {"watchdog"} if family == "57c422b" else set()
    )  # page 2-3 names it as an output


@pytest.mark.parametrize(("family", "count"), COUNTS.items())
def test_no_message_is_lost(family: str, count: int) -> None:
    assert len(load_schema(family).messages) >= count  # one more needs no line here
