"""The bits of a packed word are set and read one at a time, by number and by label."""

from pathlib import Path

import pytest

from amp_studio.schema import load as loading
from amp_studio.schema import load_schema
from amp_studio.schema.load import load_compiled

# -- words of bits

FAMILY = """
family: words
name: Control of words
document: words
title: Words
machines: [{key: one, name: One}]
default_machine: one
scopes: {word: {instances: ["0", "1"], label: "N{i}"}}
units: {}
effect: {level: reset}
groups: [all]
"""
MASK = """
key: all
name: All
chapter: "1"
parameters:
  - id: axes.displayed
    name: Displayed Axes
    scope: word
    numbers: {format: "P3N{i}"}
    type: bits
    bits:
      - {bit: 0, label: Axis 0}
      - {bit: 5, label: Axis 5}
      - {bit: 8, width: 2, label: Kind,
         choices: [{key: none, label: None, raw: 0}, {key: mask, label: Mask, raw: 2}]}
    default: {value: 1, page: "1"}
    storage: {bits: 16, signed: false, notation: hex}
    help: {what: A bit for each axis.}
    page: "4-10"
"""


@pytest.fixture
def words(amp, tmp_path: Path, monkeypatch):
    """Return the path of a file whose control has words of bits (NUM P3)."""
    (tmp_path / "database" / "words" / "groups").mkdir(parents=True)
    (tmp_path / "database" / "words" / "family.yaml").write_text(FAMILY)
    (tmp_path / "database" / "words" / "groups" / "all.yaml").write_text(MASK)
    monkeypatch.setattr(loading, "database_folder", lambda: tmp_path / "database")
    monkeypatch.setattr(loading, "cache_folder", lambda: tmp_path / "cache")
    load_compiled.cache_clear()
    load_schema.cache_clear()
    path = tmp_path / "words.amp"
    assert amp("new", "words", path).code == 0
    yield path
    load_compiled.cache_clear()
    load_schema.cache_clear()


def test_a_bit_of_a_word_is_set_by_itself(amp, words: Path) -> None:
    message = amp("set", words, "P3N0.5=yes", "P3N0.0=0", "p3n1.8=mask")
    assert (message.code, message.out) == (
        0,
        "P3N0 Displayed Axes: 0x0001 -> 0x0020\nP3N1 Displayed Axes: 0x0001 -> 0x0201\n",
    )
    assert "axes.displayed@0: '0x0020'" in words.read_text()
    rows = amp("get", words, "P3N0.5", "P3N0.0", "P3N1.8", "P3N1", "P3N0.3", "--json").json["values"]
    assert [row["value"] for row in rows] == [1, 0, "Mask", 0x0201, 0]
    assert [row["param"] for row in rows] == ["P3N0.5", "P3N0.0", "P3N1.8", "P3N1", "P3N0.3"]
    assert [row["default"] for row in rows] == [False, False, False, False, True]
    assert "P3N1.8 Kind" in amp("get", words, "P3N1.8").out


@pytest.mark.parametrize(
    ("assignment", "message"),
    [
        ("P3N0.16=1", "Displayed Axes has the bits 0 to 15, not 16"),
        ("P3N0.5=2", "'2' does not fit Axis 5, which takes 0 to 1"),
        ("P3N0.8=1", "1 is no code of Kind in Displayed Axes; nothing was changed"),
        ("P3N0.5=", "no value is given"),
        ("P3N0=0x10000", "Displayed Axes 65536 does not fit its 16 bits; nothing was changed"),
        ("P3N9.5=1", "Unknown parameter 'P3N9.5'"),
    ],
)
def test_a_bit_that_cannot_be_is_refused(amp, words: Path, assignment: str, message: str) -> None:
    before = words.read_bytes()
    refused = amp("set", words, "P3N1=3", assignment)
    assert (refused.code, message in refused.err) == (2, True), refused.err
    assert before == words.read_bytes()
