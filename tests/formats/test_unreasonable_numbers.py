"""Numbers of unreasonable size in the texts of controls: refused in their line, at once,
or kept as what they are.
"""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile
from amp_studio.files.storage import readable_content
from amp_studio.formats import FormatError, import_file
from amp_studio.schema import load_schema
from tests.work import calls_of

HUGE = [
    "1e99999999",
    "1e-99999999",
    "-1E400",
    "9" * 5000,
    "9" * 17,
    "0." + "0" * 5000 + "1",
    "1e-400",
    "9007199254740993",
]
TEXTS = {
    "acr": ("acromill", "PPU X{}\r\n"),
    "csv of a length": ("9pc", "id,instance,value,unit\nhome.calibration,1,{},mm\n"),
    "csv of a whole number": ("57c422b", "id,instance,value,unit\ngain.integral,X,{},\n"),
    "csv of a choice": ("9pc", "id,instance,value,unit\naxis.type,1,raw:{},\n"),
    "patch of a length": ("9pc", "# Patch sheet of x\n# machine mill\n1300\t{}\tmm\tHome Calibration\n"),
    "patch of a choice": ("9pc", "# Patch sheet of x\n# machine mill\n1010\t{}\t\tAxis Type\n"),
    "patch of a whole number": ("9pc", "# Patch sheet of x\n# machine mill\n1755\t{}\t\tinternal\n"),
    "registers": ("57c422b", "! Register table\n4\t{}\n"),
    "register number": ("57c422b", "! Register table\n{}\t4\n"),
    "task": ("57c422b", "10 REG_4%={}\n"),
    "task line": ("57c422b", "{} REG_4%=5\n"),
    "task register": ("57c422b", "10 REG_{}%=5\n"),
    "ballscrew": ("acromill", "X{}E.00325\r\n"),
}


def taken(path: Path, family: str, key: str | None, keep: bool) -> ParameterFile | None:
    """Return the content of a text, None where it is refused."""
    try:
        return import_file(path, family, format_key=key, keep_unknown=keep)
    except FormatError:
        return None


def refused_or_read(path: Path, family: str, key: str, near: bool) -> None:
    """Fail where a text is taken and not as it is; ``near`` where a number may be the nearest double."""
    for keep in (False, True):
        file = taken(path, family, key, keep)
        if file is not None:
            readable_content(file, path.with_name("a.amp"))
            assert keep or near, file.values


@pytest.mark.parametrize("number", HUGE, ids=lambda text: text[:12])
@pytest.mark.parametrize("kind", TEXTS)
def test_a_number_that_no_value_can_be_is_refused_at_once(tmp_path: Path, kind: str, number: str) -> None:
    family, text = TEXTS[kind]
    path = tmp_path / "a.txt"
    path.write_text(text.format(number), newline="")
    key = {
        "acr": "acr",
        "csv": "csv",
        "patch": "patch",
        "regis": "registers",
        "task": "basic",
        "balls": "bsc",
    }
    chosen = next(found for start, found in key.items() if kind.startswith(start))
    load_schema(family)  # which is no part of it
    assert calls_of(lambda: refused_or_read(path, family, chosen, (kind, number) in TAKEN)) < 1_000_000


TAKEN = (
    {(f"{kind} of a length", "9" * 17) for kind in ("csv", "patch")}
    | {("acr", "9" * 17)}
    | {(f"{kind} of a length", "9007199254740993") for kind in ("csv", "patch")}
    | {("acr", "9007199254740993")}
)
"""A real number takes the nearest double, as everywhere."""


@pytest.mark.parametrize(
    ("family", "key", "text"),
    [
        ("acromill", "acr", "PPU X" + "1" * 200_000 + "x\n"),
        ("acromill", "acr", "PPU" + " " * 500_000 + "!\n"),
        ("acromill", "acr", "PPU X1 " + " " * 500_000 + "!\n"),
        ("acromill", "acr", "PPU X4096\n" * 500),
        ("57c422b", "registers", "! Register table\n" + "4\t" + "0" * 500_000 + "x\n"),
        ("57c422b", "registers", "! Register table\n" + "".join(f"{n}\t5\n" for n in range(60_000, 61_000))),
        ("57c422b", "basic", "10 " + "{" * 200_000 + "\n"),
        ("57c422b", "basic", "".join(f"{n} REG_4%=5 &\n" for n in range(8_000))),
        ("57c422b", None, "\n" * 100_000 + "10 x"),
        ("9pc", "csv", "id,value,unit\n" + "a" * 2_000_000 + ",,\n"),
        ("num", "num", "%" + "0" * 500_000),
        ("grblhal", "grbl", "$0=1;" * 1_000),
        ("grblhal", "grbl", "12:00 " * 3_000 + "$0=1"),
        ("grblhal", None, "$0=1" + "\n#" * 3_000),
        ("grblhal", None, "M92 X1 " * 5_000),
    ],
)
def test_a_text_that_is_made_to_cost_time_costs_little(
    tmp_path: Path, family: str, key: str | None, text: str
) -> None:
    path = tmp_path / "a.txt"
    path.write_text(text, newline="")
    load_schema(family)  # which is no part of it
    calls = calls_of(lambda: [taken(path, family, key, keep) for keep in (False, True)])
    assert calls < 100 * len(text) + 100_000, "it grows with the text, not with its square"


def test_a_value_of_a_table_without_its_unit_or_with_that_of_something_else_is_refused(
    tmp_path: Path,
) -> None:
    path = tmp_path / "a.csv"
    for value, unit, message in [
        ("5", "", "'5' has no unit: write 5 mm"),
        ("5", "ms", "given in mm, not in ms"),
        ("5", "furlong", "'furlong' is not a unit"),
        ("", "", None),
        ("5", "MM", None),
    ]:
        path.write_text(f"id,instance,value,unit\nhome.calibration,1,{value},{unit}\n")
        if message is None:
            readable_content(import_file(path, "9pc"), path)
        else:
            with pytest.raises(FormatError, match=message):
                import_file(path, "9pc")
