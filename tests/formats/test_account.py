"""What an export and an import report is what a reading of the text finds, for every format and example."""

from dataclasses import replace
from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, new_file, open_file
from amp_studio.files.example_files import examples
from amp_studio.formats import (
    Account,
    FormatError,
    account_lines,
    export_file,
    formats_of,
    import_file,
    text_lines,
)
from amp_studio.formats.account import UnknownEntry
from amp_studio.formats.import_export import Export
from amp_studio.schema import Value, same_value
from amp_studio.schema.storage import register_number, value_of_register

EVERY = [
    pytest.param(example.path, chosen.key, id=f"{example.path.stem} {chosen.key}")
    for example in examples()
    for chosen in formats_of(example.family)
]


def sent(path: Path, key: str, folder: Path) -> tuple[ParameterFile, Export, ParameterFile]:
    """Return a file, its export, and what the text contains; skips a format that does not take it."""
    file = open_file(path).file
    try:
        export = export_file(file, folder / "text", key, secrets=True)
    except FormatError as error:
        pytest.skip(str(error))
    return (
        file,
        export,
        import_file(folder / "text", file.schema.family.family, format_key=key, machine=file.machine),
    )


@pytest.mark.parametrize(("path", "key"), EVERY)
def test_each_value_is_written_or_rounded_or_missing_as_the_text_is(
    path: Path, key: str, tmp_path: Path
) -> None:
    file, export, back = sent(path, key, tmp_path)
    account = export.account
    missing = {each.address for each in account.not_representable}
    rounded = {each.address: each.after for each in account.rounded}
    assert missing == {a for a in file.values if back.get(a) is None}
    assert rounded == {
        a: v for a, old in file.values.items() if (v := back.get(a)) is not None and not same_value(old, v)
    }
    assert account.written == len(file.values) - len(missing) - len(rounded)
    assert all(each.why for each in account.not_representable)


@pytest.mark.parametrize(("path", "key"), EVERY)
def test_each_value_that_was_read_has_its_line(path: Path, key: str, tmp_path: Path) -> None:
    _, _, back = sent(path, key, tmp_path)
    lines = text_lines(tmp_path / "text", back)
    # The type of a machine and the letters of its axes are in no line of their own.
    assert len(back.values.keys() - lines.keys()) <= 2
    text = (tmp_path / "text").read_bytes().splitlines()
    assert all(text[line - 1].strip() for line in lines.values())


def test_an_entry_is_not_named_where_a_longer_one_is() -> None:
    account = Account(0, ("7", "8"), unknown=(UnknownEntry("$10", 3), UnknownEntry("Grbl 0.8 $4", 0)))
    file = new_file("grblhal")
    assert list(account_lines(file, account, "kept as text: $100, $101, Grbl 0.8 $4")) == [
        "1 unknown entry, kept as text: $10 (line 3)"
    ]
    assert not list(account_lines(file, account, "kept as text: $10; and Grbl 0.8 $4"))


class Searched(str):
    """A text that refuses to be searched: a search for each of 100,000 names took minutes."""

    __slots__ = ()

    def __contains__(self, _part: str) -> bool:
        raise AssertionError("it is searched once for each entry")


def test_the_names_of_all_are_not_searched_for_each_entry() -> None:
    account = Account(0, ("7",), unknown=(UnknownEntry("$10", 0),))
    assert list(account_lines(new_file("grblhal"), account, Searched("kept as text: $100"))) == [
        "1 unknown entry, kept as text: $10"
    ]


@pytest.mark.parametrize(("path", "key"), EVERY)
def test_what_was_exported_once_comes_back_the_same_ever_after(path: Path, key: str, tmp_path: Path) -> None:
    _, first, once = sent(path, key, tmp_path)
    again = export_file(once, tmp_path / "again", key, secrets=True).account
    assert again.rounded == ()
    if not first.account.not_representable:  # else what decides which values exist is not in the text
        assert replace(again, format="") == Account(len(once.values))


def test_a_register_gives_back_the_number_that_was_entered() -> None:
    schema = open_file(next(e.path for e in examples() if e.family == "57c422b")).file.schema
    for name, value in (
        ("command.home_speed_low", Value(1600.0, "counts/s")),
        ("cam.time", Value(12.5, "ms")),
    ):
        parameter = schema.parameters[name]
        number = register_number(parameter, value, value.unit)
        assert value_of_register(parameter, number, value.unit) == value


def test_a_table_contains_an_empty_text(tmp_path: Path) -> None:
    file = new_file("9pc", "mill", ["X"])
    text = next(a for a in file.addresses() if file.schema.parameters[a[0]].type == "text")
    file.set(text, Value(""))
    assert export_file(file, tmp_path / "a.csv").account.rounded == ()
    assert import_file(tmp_path / "a.csv", "9pc").get(text) == Value("")


def test_what_a_file_contains_without_knowing_it_is_named(tmp_path: Path) -> None:
    sheet = tmp_path / "odd.patch"
    sheet.write_text("# Patch sheet of X\n# machine mill\n1300\t1\tmm\n99999\t5\n", "utf-8")
    accounts: list[Account] = []
    file = import_file(sheet, keep_unknown=True, take_account=accounts.append)
    (read,) = accounts
    assert (read.written, read.kept, read.unknown) == (len(file.values), ("5",), (("99999", 4),))
    assert export_file(file, tmp_path / "a.patch").account.kept == ("5",)
    assert export_file(file, tmp_path / "a.csv").account.kept == ("5",)
