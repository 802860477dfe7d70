"""What docs/formats.md and the pages below it describe is what the formats do."""

import re
from pathlib import Path
from textwrap import dedent

import pytest
from ruamel.yaml import YAML

from amp_studio.families.num.formats.layout import TableLayout
from amp_studio.families.num.formats.table import FORMAT
from amp_studio.formats import all_formats
from amp_studio.formats.import_export import families_of
from amp_studio.schema import Schema
from tests.families.num.small_num import SAMPLE, taken


@pytest.fixture(scope="module")
def page(checkout: Path) -> str:
    """Return all pages as one."""
    pages = (checkout / "docs" / "formats.md", *sorted((checkout / "docs" / "formats").glob("*.md")))
    return "\n".join(path.read_text(encoding="utf-8") for path in pages)


def block(page: str, first: str) -> str:
    """Return the indented block that begins with a line."""
    return dedent(re.search(rf"(?m)^    {first}\n(?:    .*\n|\n(?=    ))*", page)[0])


def test_every_format_has_its_line_and_its_section(page: str) -> None:
    for found in all_formats():
        own = families_of(found)
        families = ", ".join(f"`{family}`" for family in own) if own else "all"
        endings = ", ".join(f"`{ending}`" for ending in found.endings)
        assert re.search(rf"(?m)^\| `{found.key}` \| .* \| {families} \| {endings} \|$", page), found.key
        assert re.search(rf"(?m)^## .* \(`{found.key}`\)$", page), found.key


def test_what_a_file_remembers_of_a_table_may_be_written_as_the_page_shows(page: str, num: Schema) -> None:
    reported = YAML(typ="safe").load(block(page, "num_table:"))["num_table"]
    assert TableLayout.from_header(reported).as_header() == reported
    file = taken(num, SAMPLE)
    file.header.extra["num_table"] = reported
    text = FORMAT.write(file)
    assert text.startswith("%12345678 Machine 7;13\r\nP0N0;04\r\n")
    assert "\r\nP9N0:t0n32;0A\r\n#0 1 2 FF " in text
    assert "\r\nP9N10;05\r\n#FF FF " in text
    assert text.endswith("\r\n\x13\r\n\x1a")


def test_kept_words_may_be_written_as_the_page_shows(page: str, num: Schema) -> None:
    file = taken(num, SAMPLE)
    file.unknown.update(
        YAML(typ="safe").load(block(page[page.index("## NUM parameter table") :], "values:"))["values"]
    )
    assert FORMAT.write(file).endswith("\nP12N10:t1n12;0C\n#3 4;04\nP130N0;06\n#5;02\n\x13")
