"""The NUM parameter table with the facts of the real control."""

import random
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.families.num.formats.table import FORMAT
from amp_studio.families.num.formats.words import WORD_TYPES, Spelling, words_of
from amp_studio.files import ParameterFile, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.formats import export_file, import_file
from amp_studio.schema import Schema, Value, load_schema
from amp_studio.validate import Validator
from tests.campaigns import some
from tests.families.num.small_num import SAMPLE, measured, taken

UNTYPED = 115
"""P115 is the one parameter whose type is not printed (page 2-4)."""


@pytest.fixture(scope="module")
def real() -> Schema:
    """Return the real family."""
    return load_schema("num")


def whole(schema: Schema, spelled: dict[int, list[str]]) -> str:
    """Return a table of all words, which take the texts of their type in turn."""
    known, lines = words_of(schema, "cnc"), []
    for a, count in sorted(known.counts.items()):
        code = known.heads[a][0] if a in known.heads else 5
        for b in range(0, count, 10):
            texts = [spelled[code][n % len(spelled[code])] for n in range(b, min(b + 10, count))]
            lines += [f"P{a}N{b}:t{code}n{count}", "#" + " ".join(texts)]
    return measured(*lines)


def test_every_word_is_stored_as_its_type_shows(real: Schema) -> None:
    """Page 1-3 prints what each type is; the facts say it of each parameter once more."""
    for parameter in real.parameters.values():
        if parameter.storage is not None:
            assert Spelling.of(parameter.storage) == WORD_TYPES[parameter.storage.code or 0], parameter.id
    known = words_of(real, "cnc")
    assert known.counts.keys() - known.heads.keys() == {UNTYPED}
    assert all((a, n) in known.meanings for a, count in known.counts.items() for n in range(count))


def test_the_example_of_the_manual_is_a_table_of_the_real_control(real: Schema) -> None:
    file = taken(real, SAMPLE)
    assert file.get(("axes.displayed", "")) == Value(7)
    assert FORMAT.write(file) == SAMPLE


def test_the_table_of_the_example_machine_comes_back(tmp_path: Path) -> None:
    file = open_file(examples_folder() / "num-1060-mill" / "MILL_1060.amp").file
    export_file(file, tmp_path / "mill.par")
    back = import_file(tmp_path / "mill.par")
    assert (back.values, back.header.extra) == (file.values, {})
    export_file(back, tmp_path / "again.par")
    assert (tmp_path / "again.par").read_bytes() == (tmp_path / "mill.par").read_bytes()
    assert not [f for f in Validator(back).run() if f.severity in ("error", "warning")]


@pytest.mark.parametrize("seed", some(range(4), 2))
def test_all_words_of_the_real_control_come_back(real: Schema, seed: int) -> None:
    some = random.Random(seed)
    spelled = {
        code: [
            form.spell(some.choice([0, 1, form.low, form.high, some.randint(form.low, form.high)]))
            for _ in range(7)
        ]
        for code, form in WORD_TYPES.items()
    } | {8: ["M..E"], 9: ["1.5", "-2E+30"]}
    file = taken(real, whole(real, spelled))
    assert len(file.values) == len(words_of(real, "cnc").meanings)
    assert FORMAT.write(file) == whole(real, spelled)
    file.header.extra["num_table"] = {"words": {f"P{UNTYPED}": "t5n1"}}
    assert taken(real, FORMAT.write(file)).values == file.values


def test_the_verbs_take_a_table_and_give_it_back(
    real: Schema, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table = tmp_path / "in.par"
    table.write_bytes(SAMPLE.encode("ascii"))
    assert run(["import", str(table), "-o", str(tmp_path / "machine.amp")]) == 0
    assert "the table does not contain these words: P4N3, P6N5 to P6N8" in capsys.readouterr().err
    assert run(["export", str(tmp_path / "machine.amp"), "-o", str(tmp_path / "out.par")]) == 0
    assert (tmp_path / "out.par").read_bytes() == table.read_bytes()


def test_the_verbs_say_where_a_table_is_wrong_and_make_nothing_of_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table = tmp_path / "in.par"
    table.write_bytes(SAMPLE.replace("#54 A;05", "#54 A;06").encode("ascii"))
    assert run(["import", str(table), "-o", str(tmp_path / "machine.amp")]) == 2
    message = capsys.readouterr().err.strip()
    assert message.endswith("line 17, column 7: the line has 5 characters, 05 in hexadecimal, and gives 06")
    assert not (tmp_path / "machine.amp").exists()


def test_words_of_another_software_are_kept_where_that_is_wanted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table = tmp_path / "in.par"
    text = measured("P0N0:t6n1", "#00000007", "P121N0:t1n12", "#-5 0 0 7")
    table.write_bytes(text.encode("ascii"))
    arguments = ["import", str(table), "-o", str(tmp_path / "machine.amp")]
    assert run(arguments) == 2
    assert "line 4, column 1: NUM 1020/1040/1060 has no P121N0" in capsys.readouterr().err
    assert run([*arguments, "--keep-unknown"]) == 0
    assert "kept as text: P121N0 (line 4)" in capsys.readouterr().err
    assert run(["export", str(tmp_path / "machine.amp"), "-o", str(tmp_path / "out.par")]) == 0
    assert (tmp_path / "out.par").read_bytes() == table.read_bytes()


def test_an_untyped_word_stays_as_it_is_spelled(real: Schema) -> None:
    for table in (measured("P115N0:t7n1", "#00FF"), measured("P115N0", "#00FF")):
        file: ParameterFile = taken(real, table)
        assert file.get(("reserved.p115", "0")) == Value("00FF")
        assert FORMAT.write(file) == table
