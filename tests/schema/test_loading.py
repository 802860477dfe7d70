"""Loading facts: a fault is reported with file and line, and the cache never gives yesterday's facts."""

import json
import os
from pathlib import Path

import pytest

from amp_studio.schema import DatabaseError, compiled_cache, family_ids, load_schema
from amp_studio.schema import load as loading
from amp_studio.schema.catalog import schema_of
from amp_studio.schema.load import compile_family, database_folder, load_compiled
from tests.campaigns import some

GOOD = """
- id: a.speed
  name: Speed
  type: real
  quantity: velocity
  ranges:
    mm/min: [0, 100]
  states:
    - {state: ignored, when: slow}
  default: {value: 5, unit: mm/min, page: "2"}
  help: {what: How fast.}
  page: "1"
- id: a.kind
  name: Kind
  scope: axis
  type: choice
  choices:
    - {key: one, label: One, code: a, raw: 1}
    - {key: two, label: Two, code: b, raw: 2}
  default:
    value: one
    page: "2"
  help: {what: Which kind.}
  page: "1"
"""
SLOW = "conditions:\n  slow:\n    reads: {speed: a.speed}\n    when: speed < 1.0\n    why: too slow\n"


def line_with(path: Path, text: str) -> int:
    """Return the last line of a file that contains a text."""
    return max(n for n, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1) if text in line)


def test_good_facts_load(facts, head) -> None:
    schema = facts.schema(GOOD, head + SLOW)
    assert list(schema.parameters) == ["a.speed", "a.kind"]
    assert schema.group_of["a.kind"].name == "All"


@pytest.mark.parametrize(
    ("old", "new", "marked", "message"),
    [
        (
            "  quantity: velocity",
            "  quantity: velocity\n  unnit: mm",
            "unnit",
            "a.speed: unnit: there is no such key, did you mean 'unit'?",
        ),
        ("  name: Speed\n", "", "- id: a.speed", "a.speed: name: is missing"),
        ("type: real", "type: reel", "type: reel", "a.speed: type: 'reel' is not 'integer', 'real', "),
        ("id: a.kind", "id: a.speed", "- id: a.speed", "a.speed occurs twice"),
        ("id: a.kind", "id: Kind", "- id: Kind", "Kind: id: 'Kind' is no id: small letters"),
        ("value: one", "value: three", "- id: a.kind", "a.kind: default 'three' is not one of its choices"),
        ("label: Two", "label: ONE", "- id: a.kind", "a.kind: two choices share a label"),
        ("key: two", "key: one", "- id: a.kind", "a.kind: two choices share a key"),
        ("code: b", "code: A", "- id: a.kind", "a.kind: two choices share a code"),
        ("mm/min: [0, 100]", "mm/h: [0, 100]", "mm/h", "'mm/h' is no unit"),
        ("mm/min: [0, 100]", "mm/min: [0, fast]", "mm/min: [0, fast]", "a.speed: ranges: mm/min"),
        (
            "mm/min: [0, 100]",
            "mm/min: [0, {param: a.top}]",
            "mm/min: [0",
            "there is no parameter 'a.top' to bound it",
        ),
        ("when: slow", "when: slo", "- {state: ignored", "a.speed: there is no condition 'slo'"),
        (
            "when: slow",
            "when: slow, unless: slow",
            "- {state: ignored",
            "a state takes either 'when' or 'unless'",
        ),
        ("scope: axis", "scope: word", "scope: word", "a.kind: the family has no scope 'word'"),
        (
            'page: "1"\n- id: a.kind',
            "page: page one\n- id: a.kind",
            "page: page one",
            "a.speed: page: 'page one' is no page: written like 7-20",
        ),
        ("name: Kind", "numbers: {format: 'P{x}'}\n  name: Kind", "numbers", "the format 'P{x}' may contain"),
        (
            "name: Kind",
            "numbers: {step: 3}\n  name: Kind",
            "numbers",
            "numbers need 'start', 'listed', 'starts' or a format without",
        ),
        ("name: Kind", "name: Kind\n  name: Sort", "name: Sort", "'name' occurs twice"),
        ("name: Kind", "name: [Kind", "scope: axis", "expected"),
    ],
)
def test_a_fault_in_a_fact_is_reported_with_file_and_line(facts, head, old, new, marked, message) -> None:
    text = GOOD.replace(old, new, 1)
    assert text != GOOD
    with pytest.raises(DatabaseError) as refused:
        facts.schema(text, head + SLOW)
    assert (facts.folder / "groups" / "all.yaml") == refused.value.path
    assert message in refused.value.what
    assert line_with(refused.value.path, marked) == refused.value.line
    assert f"all.yaml, line {refused.value.line}: " in str(refused.value)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("old", "new", "marked", "message"),
    [
        (
            "default_machine: mill",
            "default_machine: mill\ncolour: red",
            "colour",
            "colour: there is no such key",
        ),
        ("length: mm", "length: mn", "length: mn", "'mn' is no unit"),
        ("speed < 1.0", "speed <", "    when: speed <", "condition slow:"),
        ("speed < 1.0", "loop < 1.0", "    when: loop", "condition slow:"),
        (
            "{speed: a.speed}",
            "{speed: a.sped}",
            "    reads:",
            "condition slow reads 'a.sped', which does not exist",
        ),
        (
            "groups: [all]",
            "groups: [all]\nangular_when: turns",
            "angular_when",
            "there is no condition 'turns'",
        ),
        (
            "groups: [all]",
            "groups: [all]\nmachine_parameter: a.b",
            "machine_parameter",
            "there is no parameter 'a.b'",
        ),
    ],
)
def test_a_fault_in_the_family_is_reported_with_file_and_line(facts, head, old, new, marked, message) -> None:
    text = (head + SLOW).replace(old, new, 1)
    with pytest.raises(DatabaseError) as refused:
        facts.schema(GOOD, text)
    assert (refused.value.path.name, message in refused.value.what) == ("family.yaml", True)
    assert line_with(refused.value.path, marked) == refused.value.line


def test_a_group_file_that_is_missing_empty_or_another_is_reported(facts, head) -> None:
    facts.write("family.yaml", head)
    with pytest.raises(DatabaseError, match=r"all\.yaml: .*No such file"):
        compile_family(facts.folder)
    facts.write("groups/all.yaml", "")
    with pytest.raises(DatabaseError, match=r"all\.yaml, line 1: "):
        compile_family(facts.folder)
    facts.group("  []", key="all").write_text('key: other\nname: All\nchapter: "1"\nparameters: []\n')
    with pytest.raises(DatabaseError, match=r"all\.yaml, line 1: its key is 'other'"):
        compile_family(facts.folder)
    (facts.folder / "groups" / "all.yaml").write_bytes(b"key: all\nname: \xff\n")
    with pytest.raises(DatabaseError, match=r"all\.yaml, line 2: is not UTF-8 text"):
        compile_family(facts.folder)


def test_a_fault_in_a_rule_is_reported_with_file_line_and_rule(facts, head) -> None:
    facts.write("family.yaml", head + SLOW)
    facts.group(GOOD)
    path = facts.write(
        "rules/all.yaml",
        """\
        rules:
          - id: small.order
            title: Order
            severity: fatal
            reads: {a: a.speed}
            check: a > 0.0
            message: no
            page: "1"
        """,
    )
    with pytest.raises(DatabaseError) as refused:
        compile_family(facts.folder)
    assert (4, path) == (refused.value.line, refused.value.path)
    assert refused.value.what.startswith("small.order: severity: ")


def test_an_unknown_family_is_a_key_error() -> None:
    with pytest.raises(KeyError, match="no-such-family"):
        load_schema("no-such-family")


def test_every_family_with_a_folder_is_known() -> None:
    assert "9pc" in family_ids()
    assert tuple(sorted(family_ids())) == family_ids()
    assert all((database_folder() / name / "family.yaml").is_file() for name in family_ids())


# -- the cache ----------------------------------------------------------------------------------------


@pytest.fixture
def database(facts, head, monkeypatch, tmp_path: Path) -> Path:
    """Return a folder of facts with one small family, and a separate cache;
    the folder is read again each time.
    """
    facts.write("family.yaml", head + SLOW)
    facts.group(GOOD)
    monkeypatch.setattr(loading, "database_folder", lambda: facts.folder.parent)
    monkeypatch.setattr(loading, "cache_folder", lambda: tmp_path / "cache")
    return facts.folder.parent


def load():
    """Load the small family as a new process would."""
    return load_compiled.__wrapped__("small")


def cached(tmp_path: Path) -> list[Path]:
    """Return what lies in the cache."""
    return sorted((tmp_path / "cache").iterdir())


def count_parsing(monkeypatch) -> list[Path]:
    """Return a list that grows with every fact file that is parsed."""
    parsed: list[Path] = []
    original = loading._read
    monkeypatch.setattr(loading, "_read", lambda path, model: (parsed.append(path), original(path, model))[1])
    return parsed


def test_what_comes_from_the_cache_is_what_was_compiled_and_costs_no_parsing(database, monkeypatch) -> None:
    first, parsed = load(), count_parsing(monkeypatch)
    second = load()
    assert first == second
    assert schema_of(first).signature == schema_of(second).signature
    assert parsed == []


def test_the_real_families_come_from_the_cache_as_they_were_compiled(monkeypatch, tmp_path) -> None:
    monkeypatch.setattr(loading, "cache_folder", lambda: tmp_path / "cache")
    for family in some(family_ids()):
        compiled = load_compiled.__wrapped__(family)
        assert compiled == load_compiled.__wrapped__(family), "compiled first, then taken from the cache"
    assert compiled == compile_family(database_folder() / family)


@pytest.mark.parametrize(
    "content",
    [b"", b"{", b"null", b"[]", b"{}", b"\xff\xfe", b'{"family": {}}', b'{"family": "9pc"', bytes(range(64))],
)
def test_a_cache_file_that_cannot_be_read_is_made_again(database, tmp_path, content: bytes) -> None:
    expected = load()
    (path,) = cached(tmp_path)
    whole = path.read_bytes()
    path.write_bytes(content)
    assert expected == load()
    assert whole == path.read_bytes()


def test_a_cache_cut_off_anywhere_is_made_again(database, tmp_path) -> None:
    expected = load()
    (path,) = cached(tmp_path)
    whole = path.read_bytes()
    for length in range(0, len(whole), 97):
        path.write_bytes(whole[:length])
        assert expected == load()
        assert whole == path.read_bytes()


def test_a_cache_that_cannot_be_written_costs_nothing_but_time(database, tmp_path, monkeypatch) -> None:
    expected = load()
    (path,) = cached(tmp_path)
    path.unlink()
    path.mkdir()  # a folder is where the file should be
    assert expected == load()
    assert [path] == cached(tmp_path), "and no temporary file is left"
    path.rmdir()

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(compiled_cache.os, "replace", full)
    assert expected == load()
    assert cached(tmp_path) == []


def test_a_changed_fact_is_seen_at_once_and_the_old_cache_goes(database, tmp_path) -> None:
    first = load()
    (old,) = cached(tmp_path)
    path = database / "small" / "groups" / "all.yaml"
    path.write_text(path.read_text().replace("How fast.", "How very fast."))
    second = load()
    (new,) = cached(tmp_path)
    assert (first.groups[0].parameters[0].help.what, second.groups[0].parameters[0].help.what) == (
        "How fast.",
        "How very fast.",
    )
    assert old != new


def test_every_fact_file_counts_for_the_key_of_the_cache(database, tmp_path) -> None:
    keys = []
    for name, text in (
        ("", ""),
        ("errata/one.yaml", "errata: []\n"),
        ("tables/one.yaml", "tables: []\n"),
        ("rules/one.yaml", "rules: []\n"),
        ("rules/one.yaml", "rules: []\n# a comment\n"),
    ):
        if name:
            (database / "small" / name).parent.mkdir(exist_ok=True)
            (database / "small" / name).write_text(text)
        load()
        keys.append(cached(tmp_path)[0].name)
    assert len(set(keys)) == 5


def test_the_cache_of_another_family_stays(database, tmp_path, facts) -> None:
    load()
    other = tmp_path / "cache" / "another-0123.json"
    other.write_text(json.dumps({}))
    path = facts.folder / "groups" / "all.yaml"
    path.write_text(path.read_text() + "# changed\n")
    load()
    assert other in cached(tmp_path)
    assert len(cached(tmp_path)) == 2


def warned(caplog) -> list[str]:
    """Return what the log warns of."""
    return [record.getMessage() for record in caplog.records if record.levelname == "WARNING"]


def test_a_cache_that_was_changed_but_is_still_json_is_made_again_and_named(
    database, tmp_path, caplog
) -> None:
    expected = load()
    (path,) = cached(tmp_path)
    whole = path.read_bytes()
    path.write_bytes(whole.replace(b'"Speed"', b'"Spend"'))
    assert path.read_bytes() != whole
    assert (load(), path.read_bytes()) == (expected, whole)
    assert warned(caplog) == [
        f"{path} cannot be used and is made again: its content is not what was kept there"
    ]


@pytest.mark.skipif(os.name != "posix", reason="Windows has neither pipes nor devices in a folder")
@pytest.mark.parametrize(
    "kind", ["pipe", "folder", "device", "link to a device", "link to nothing", "link to itself", "garbage"]
)
def test_whatever_lies_where_the_cache_should_is_named_and_neither_waited_for_nor_followed(
    database, tmp_path, caplog, kind: str
) -> None:
    expected = load()
    (path,) = cached(tmp_path)
    whole = path.read_bytes()
    path.unlink()
    elsewhere = tmp_path / "elsewhere"
    match kind:
        case "pipe":
            os.mkfifo(path)
        case "folder":
            path.mkdir()
        case "device":
            path.symlink_to("/dev/tty")
        case "link to a device":
            path.symlink_to("/dev/zero")
        case "link to nothing":
            path.symlink_to(elsewhere)
        case "link to itself":
            path.symlink_to(path)
        case "garbage":
            path.write_bytes(b"\0" * 1000)
    assert load() == expected
    if kind == "folder":  # nothing takes its place: it may be somebody's
        assert path.is_dir()
    else:
        assert (path.is_symlink(), path.read_bytes()) == (False, whole)
    assert not elsewhere.exists()
    if kind != "link to nothing":
        assert [
            message.startswith(f"{path} cannot be used and is made again: ") for message in warned(caplog)
        ] == [True]


def test_a_cache_file_of_any_size_is_not_read_whole(database, tmp_path, caplog) -> None:
    expected = load()
    (path,) = cached(tmp_path)
    with path.open("r+b") as stream:
        stream.truncate(2**40)
    assert load() == expected
    assert "Is larger than 64 MiB" in warned(caplog)[0]


def test_the_cache_of_another_family_whose_name_begins_alike_stays(database, tmp_path) -> None:
    load()
    (path,) = cached(tmp_path)
    other = path.with_name("small-er-" + "0" * 24 + ".json")
    older = path.with_name("small-" + "0" * 24 + ".json")
    other.write_bytes(b"")
    older.write_bytes(b"")
    path.unlink()
    load()
    assert (other.exists(), older.exists()) == (True, False)
