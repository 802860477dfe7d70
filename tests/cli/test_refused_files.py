"""A file that cannot be used: every verb reports it in one line, ends with 2, and writes nothing."""

from pathlib import Path

import pytest

from amp_studio.schema import family_ids
from tests.campaigns import some

KNOWN = ", ".join(family_ids())

VERBS = {
    "get": lambda bad, good, out: ("get", bad),
    "get one": lambda bad, good, out: ("get", bad, "1300", "--json"),
    "set": lambda bad, good, out: ("set", bad, "1300=1"),
    "set by force": lambda bad, good, out: ("set", bad, "1300=1", "--force"),
    "validate": lambda bad, good, out: ("validate", bad),
    "validate json": lambda bad, good, out: ("validate", bad, "--json"),
    "diff a": lambda bad, good, out: ("diff", bad, good),
    "diff b": lambda bad, good, out: ("diff", good, bad, "--json"),
    "merge base": lambda bad, good, out: ("merge", bad, good, good, "-o", out),
    "merge ours": lambda bad, good, out: ("merge", good, bad, good, "-o", out),
    "merge theirs": lambda bad, good, out: ("merge", good, good, bad, "-o", out),
    "report": lambda bad, good, out: ("report", bad, "-o", out.with_suffix(".txt")),
    "simulate": lambda bad, good, out: ("simulate", bad, "step", "-o", out.with_suffix(".csv")),
}
"""Every verb that reads a file, with the bad file in each place it can be."""

HEAD = b"amp_studio: 1\nfamily: 9pc\n"
GOOD = (
    HEAD + b"values:\n  control.type: Mill\n  axis.type@1: linear\n  axis.name@1: X\n  home.calibration@1: 0"
    b" mm\n...\n"
)
BAD = {
    "empty": b"",
    "truncated": GOOD[:-12],
    "no end mark": HEAD + b"values:\n  axis.type@1: linear\n",
    "duplicate": HEAD + b"values:\n  axis.type@1: linear\n  axis.type@1: rotary\n...\n",
    "newer": b"amp_studio: 9\nfamily: 9pc\n...\n",
    "another family": b"amp_studio: 1\nfamily: fanuc\n...\n",
    "not text": HEAD + b"name: \xff\n...\n",
    "not YAML": HEAD + b"values: [\n...\n",
    "no number": HEAD + b"values:\n  home.calibration@1: five mm\n...\n",
    "another program's": b"<html></html>\n",
}


@pytest.mark.parametrize("verb", some(VERBS, 4))
@pytest.mark.parametrize("kind", [*BAD, "missing", "folder"])
def test_a_file_that_cannot_be_used_is_refused_by_every_verb(
    amp, tmp_path: Path, folder, verb: str, kind: str
) -> None:
    bad, good, out = tmp_path / "bad.amp", tmp_path / "good.amp", tmp_path / "out.amp"
    good.write_bytes(GOOD)
    if kind == "folder":
        bad.mkdir()
    elif kind != "missing":
        bad.write_bytes(BAD[kind])
    before = folder()
    refused = amp(*VERBS[verb](bad, good, out))
    assert refused.code == 2
    assert str(bad) in refused.err
    assert before == folder()


def test_the_good_file_of_these_stories_is_good(amp, tmp_path: Path) -> None:
    (tmp_path / "good.amp").write_bytes(GOOD)
    assert amp("get", tmp_path / "good.amp", "1300", "--json").json["values"][0]["value"] == 0


@pytest.mark.parametrize(
    ("kind", "message"),
    [
        ("duplicate", "bad.amp, line 5: 'axis.type@1' occurs twice"),
        ("newer", "bad.amp, line 1: was written by a newer AMP Studio (file format 9, known: 1)"),
        ("no end mark", "ends without its end mark '...': it has been cut off"),
        ("no number", "bad.amp, line 4: home.calibration@1: 'five mm' is not a number"),
        ("another family", f"bad.amp, line 2: Unknown family 'fanuc'. Known: {KNOWN}"),
        ("not text", "bad.amp, line 3: is not UTF-8 text"),
    ],
)
def test_the_line_shows_what_is_wrong_and_where(amp, tmp_path: Path, kind: str, message: str) -> None:
    (tmp_path / "bad.amp").write_bytes(BAD[kind])
    assert message in amp("get", tmp_path / "bad.amp").err


def test_a_fault_in_the_facts_is_reported_in_one_line(amp, mill: Path, tmp_path: Path, monkeypatch) -> None:
    from amp_studio.schema import DatabaseError

    def broken(_: str) -> None:
        raise DatabaseError(tmp_path / "family.yaml", 3, "colour: there is no such key")

    monkeypatch.setattr("amp_studio.schema.load_schema", broken)
    for arguments in (("families",), ("schema", "9pc"), ("new", "9pc", tmp_path / "x.amp")):
        refused = amp(*arguments)
        assert (refused.code, "family.yaml, line 3: colour" in refused.err) == (2, True)


def test_stopping_it_is_reported_and_ends_with_2(amp, mill: Path, monkeypatch) -> None:
    def stop(*_: object) -> int:
        raise KeyboardInterrupt

    monkeypatch.setattr("amp_studio.cli.verbs.files.get.opened", stop)
    assert (amp("get", mill).code, amp("get", mill).err) == (2, "amp-studio: stopped\n")
