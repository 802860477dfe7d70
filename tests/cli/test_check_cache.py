"""validate keeps the results of many files: a run that finds them prints the same,
and checks again whatever may have changed.
"""

import sqlite3
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from amp_studio import cli
from amp_studio.cli.checks import cache as check_cache
from amp_studio.cli.checks.formats import CHECK_FORMATS
from amp_studio.cli.verbs.checks import validate
from amp_studio.files import Document
from amp_studio.validate import companions_of
from tests.campaigns import some


@pytest.fixture
def cache(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the folder of caches of this test, with nothing in it, for a program of one module."""
    folder = tmp_path_factory.mktemp("cache")
    monkeypatch.setattr(check_cache, "cache_folder", lambda: folder / "amp-studio")
    # The digest of the whole program takes 60 ms a run.
    monkeypatch.setattr(check_cache, "_program_folders", lambda: [Path(__file__)])
    return folder / "amp-studio"


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """Return a machine of a family with few values, of which a check is soon done."""
    path = tmp_path_factory.mktemp("small") / "small.amp"
    assert cli.run(["new", "grblhal", str(path), "--axes", "X,Y,Z"]) == 0
    return path.read_bytes()


@pytest.fixture
def machines(amp, tmp_path: Path, small: bytes) -> Path:
    """Return a folder with three machines, one of them with an error that the others do not have."""
    folder = tmp_path / "machines"
    folder.mkdir()
    for n in range(3):
        (folder / f"{n}.amp").write_bytes(small)
    amp("set", folder / "1.amp", "$1=70000", "--force")
    return folder


@pytest.fixture
def checked(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Return a list that gets the name of each file that is checked."""
    names: list[str] = []
    opened = validate.opened

    def watched(path: Path, *more: Any) -> Any:
        names.append(path.name)
        return opened(path, *more)

    monkeypatch.setattr(validate, "opened", watched)
    return names


@pytest.mark.parametrize("form", some(CHECK_FORMATS, 2))
def test_a_second_run_prints_the_same_and_checks_nothing(
    amp, cache: Path, machines: Path, checked: list[str], form: str
) -> None:
    first = amp("validate", machines, "--format", form)
    assert sorted(checked) == ["0.amp", "1.amp", "2.amp"]
    second = amp("validate", machines, "--format", form)
    assert len(checked) == 3
    assert (second.code, second.out, second.err) == (first.code, first.out, first.err)
    assert amp("validate", machines, "--format", form, "--no-cache").out == first.out
    assert len(checked) == 6


def test_only_a_file_that_has_changed_is_checked_again(
    amp, cache: Path, machines: Path, checked: list[str]
) -> None:
    amp("validate", machines)
    amp("set", machines / "2.amp", "$1=80000", "--force")
    checked.clear()
    again = amp("validate", machines)
    assert checked == ["2.amp"]
    assert again.out == amp("validate", machines, "--no-cache").out
    amp("set", machines / "2.amp", "$1=25")
    (machines / "2.amp").write_bytes((machines / "0.amp").read_bytes())
    checked.clear()
    assert amp("validate", machines).out == amp("validate", machines, "--no-cache").out


def change_the_rules(folder: Path) -> None:
    text = "suppressions:\n  - {rule: schema.range, by: M. Weber, reason: an old machine}\n"
    (folder / "rules.yaml").write_text(text, encoding="utf-8")


def test_rules_beside_the_files_that_come_change_or_go_check_all_again(
    amp, cache: Path, machines: Path, checked: list[str]
) -> None:
    plain = amp("validate", machines)
    change_the_rules(machines)
    suppressed = amp("validate", machines)
    assert "M. Weber" in suppressed.out
    (machines / "rules.yaml").write_text("rules: []\n", encoding="utf-8")
    assert amp("validate", machines).out == plain.out
    assert len(checked) == 9
    (machines / "rules.yaml").unlink()
    assert amp("validate", machines).out == plain.out
    assert len(checked) == 9, "without rules nothing has changed since the first run"


@pytest.mark.parametrize("name", ["router.amp", "it's # 1.amp"])
def test_what_machines_were_made_from_is_a_part_of_their_keys(
    amp, cache: Path, tmp_path: Path, small: bytes, checked: list[str], name: str
) -> None:
    origin, folder = tmp_path / name, tmp_path / "made"
    folder.mkdir()
    origin.write_bytes(small)
    for copy in ("a.amp", "b.amp"):
        assert amp("new", "grblhal", folder / copy, "--like", origin).code == 0
    assert "made from" not in amp("validate", folder).out
    amp("validate", folder)
    assert len(checked) == 2
    assert amp("set", origin, "$30=10000").code == 0
    again = amp("validate", folder)
    assert again.out.count(f"a tenth of the 10000 rpm in {name}, which it was made from") == 2
    assert again.out == amp("validate", folder, "--no-cache").out


def test_named_rules_are_a_part_of_what_is_asked(amp, cache: Path, machines: Path, tmp_path: Path) -> None:
    change_the_rules(tmp_path)
    rules = tmp_path / "rules.yaml"
    assert "M. Weber" in amp("validate", machines, "--rules", rules).out
    assert "M. Weber" not in amp("validate", machines).out
    rules.write_text("rules: []\n", encoding="utf-8")
    assert "M. Weber" not in amp("validate", machines, "--rules", rules).out


def test_a_link_to_a_machine_has_the_rules_of_the_folder_that_it_leads_to(
    amp, cache: Path, machines: Path, tmp_path: Path
) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (elsewhere / "1.amp").write_bytes((machines / "1.amp").read_bytes())
    change_the_rules(elsewhere)
    amp("validate", machines)
    (machines / "1.amp").unlink()
    (machines / "1.amp").symlink_to(elsewhere / "1.amp")
    assert "M. Weber" in amp("validate", machines).out


@pytest.mark.parametrize("name", ["module.py", "inner/facts.yaml"])
def test_another_program_or_other_facts_check_all_again(
    amp,
    cache: Path,
    machines: Path,
    checked: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    name: str,
) -> None:
    program = tmp_path / "program"
    (program / "inner").mkdir(parents=True)
    (program / name).write_text("1\n", encoding="utf-8")
    monkeypatch.setattr(check_cache, "_program_folders", lambda: [program])
    amp("validate", machines)
    amp("validate", machines)
    assert len(checked) == 3
    (program / name).write_text("2\n", encoding="utf-8")
    amp("validate", machines)
    assert len(checked) == 6
    assert len(list(cache.glob("checks-*"))) == 1, "what the other program kept is removed"
    (program / name).rename(program / f"a{Path(name).name}")
    amp("validate", machines)
    assert len(checked) == 9


def test_the_code_of_another_package_s_family_is_a_part_of_the_program(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "foreign").mkdir()
    (tmp_path / "foreign" / "__init__.py").write_text("", encoding="utf-8")
    (tmp_path / "alone.py").write_text("", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    places = {"one": "foreign.record:RECORD", "two": "alone:RECORD"}
    monkeypatch.setattr(check_cache, "installed_places", lambda: places)
    names = {part for folder in check_cache._program_folders()[2:] for part in check_cache._contents(folder)}
    assert {str(tmp_path / "foreign" / "__init__.py").encode(), str(tmp_path / "alone.py").encode()} <= names


def test_the_digest_of_the_program_has_its_modules_and_its_facts() -> None:
    package, facts, *_ = check_cache._program_folders()
    names = {part for folder in (package, facts) for part in check_cache._contents(folder)}
    for path in (Path(validate.__file__), facts / "9pc" / "family.yaml"):
        assert str(path).encode() in names
        assert path.read_bytes() in names


def altered(path: Path, statement: str) -> None:
    with sqlite3.connect(path) as database:
        database.execute(statement)
    database.close()


BREAKS: dict[str, Callable[[Path], object]] = {
    "is empty": lambda path: path.write_bytes(b""),
    "is something else": lambda path: path.write_bytes(b"no database" * 1000),
    "is cut off": lambda path: path.write_bytes(path.read_bytes()[:5000]),
    "has another table": lambda path: (path.unlink(), altered(path, "CREATE TABLE result (id INTEGER)")),
    "has another's result": lambda path: altered(
        path, "UPDATE result SET kept = (SELECT max(kept) FROM result)"
    ),
    "has texts": lambda path: altered(path, "UPDATE result SET kept = 'text'"),
    "has an altered result": lambda path: altered(path, "UPDATE result SET kept = x'5b302c2022225d'"),
    "is a folder": lambda path: (path.unlink(), path.mkdir()),
}
"""What is wrong with a cache -> what makes it so."""


@pytest.mark.parametrize("wrong", some(BREAKS, 2))
def test_a_cache_that_cannot_be_used_changes_no_result(amp, cache: Path, machines: Path, wrong: str) -> None:
    first = amp("validate", machines)
    (kept,) = cache.glob("checks-*")
    BREAKS[wrong](kept)
    for _ in range(2):
        again = amp("validate", machines)
        assert (again.code, again.out, again.err) == (first.code, first.out, first.err)


def test_a_cache_that_cannot_be_written_costs_time_only(
    amp, cache: Path, machines: Path, checked: list[str]
) -> None:
    cache.write_text("no folder", encoding="utf-8")
    first = amp("validate", machines)
    assert amp("validate", machines).out == first.out
    assert len(checked) == 6


def test_a_file_that_is_changed_while_it_is_checked_is_checked_again(
    amp, cache: Path, machines: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened, other = validate.opened, (machines / "1.amp").read_bytes()

    def slow(path: Path, *more: Any) -> Any:
        file = opened(path, *more)
        if path.name == "0.amp":
            path.write_bytes(other)
        return file

    with monkeypatch.context() as patch:
        patch.setattr(validate, "opened", slow)
        amp("validate", machines)
    assert amp("validate", machines).out == amp("validate", machines, "--no-cache").out


def test_a_file_that_cannot_be_read_is_read_again(amp, cache: Path, machines: Path, capsys: Any) -> None:
    whole = (machines / "0.amp").read_bytes()
    (machines / "0.amp").write_bytes(whole[:-10])
    for _ in range(2):
        assert cli.run(["validate", str(machines)]) == 2
        assert "it has been cut off" in capsys.readouterr().err
    (machines / "0.amp").write_bytes(whole)
    assert amp("validate", machines).code == 1


def test_a_file_that_is_named_twice_is_printed_twice(amp, cache: Path, machines: Path) -> None:
    first = amp("validate", machines / "0.amp", machines / "0.amp")
    assert amp("validate", machines / "0.amp", machines / "0.amp").out == first.out
    assert first.out.count("0.amp: ") == 2


def test_what_is_remembered_of_a_control_s_own_text_are_its_notes_too(
    amp, cache: Path, tmp_path: Path
) -> None:
    listing = tmp_path / "listing.txt"
    listing.write_text("$0=10\n$1=25\n$130=200\n$131=200\n$132=60\n$999=5\n", encoding="utf-8")
    first = amp("validate", listing, listing)
    assert "999" in first.err
    second = amp("validate", listing, listing)
    assert (second.out, second.err) == (first.out, first.err)


def test_a_cache_that_has_become_large_keeps_the_files_of_this_run(
    amp, cache: Path, machines: Path, checked: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    amp("validate", machines)
    amp("set", machines / "2.amp", "$1=80000", "--force")
    monkeypatch.setattr(check_cache, "_MAX_BYTES", 0)
    amp("validate", machines)
    (kept,) = cache.glob("checks-*")
    with sqlite3.connect(kept) as database:
        (number,) = database.execute("SELECT count(*) FROM result").fetchone()
    database.close()
    assert number == 3
    checked.clear()
    amp("validate", machines)
    assert checked == []


def test_a_file_alone_is_not_kept(amp, cache: Path, machines: Path) -> None:
    amp("validate", machines / "0.amp")
    assert not cache.exists()


@pytest.fixture
def opened_files() -> Iterator[list[str]]:
    """Return a list that gets every path that Python opens during the test;
    a hook stays until the end of the process.
    """
    paths: list[str] = []
    is_on = [True]

    def hook(event: str, arguments: tuple[object, ...]) -> None:
        if is_on[0] and event in ("open", "os.listdir", "os.scandir") and arguments:
            paths.append(str(arguments[0]))

    sys.addaudithook(hook)
    yield paths
    is_on[0] = False


def test_a_check_reads_nothing_that_is_not_in_its_key(amp, machines: Path, opened_files: list[str]) -> None:
    """With all that may lie beside a file: backup, unsaved work, project, record of exchanges.
    The key has them all.
    """
    change_the_rules(machines)
    (machines / "project.yaml").write_text("machines: [0.amp, 1.amp]\n", encoding="utf-8")
    with Document.open(machines / "0.amp") as document:
        document.file.set(document.file.find("$1"), document.file.read(document.file.find("$1"), "1"))
        document.save()
        opened_files.clear()
        amp("validate", machines / "0.amp", machines / "1.amp", "--no-cache", "--why")
    read = {Path(text).name for text in opened_files if text.startswith(str(machines))}
    compared = {each.name for n in "01" for each in companions_of(machines / f"{n}.amp")}
    assert read <= {"0.amp", "1.amp", "rules.yaml", machines.name} | compared, (
        "what is read more belongs into the key (cli/checks/cache.py)"
    )
    assert {"0.amp", "1.amp", "rules.yaml", "0.amp.bak"} <= read


def test_a_folder_is_listed_once_for_all_of_its_files(
    amp, cache: Path, machines: Path, checked: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The way to each of thousands of files, and what lies beside it,
    took half the time of a run with all results kept.
    """
    first = amp("validate", machines)
    real, followed = check_cache.real_path, list[Path]()

    def watched(path: Path) -> Path:
        followed.append(path)
        return real(path)

    monkeypatch.setattr(check_cache, "real_path", watched)
    checked.clear()
    assert amp("validate", machines).out == first.out
    assert (set(followed), checked) == ({machines}, [])
