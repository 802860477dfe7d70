"""The ACR command script with any values, and other forms of commands than AcroMill has."""

import re
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from amp_studio.families.acromill.formats.acr_command import commands_of
from amp_studio.families.acromill.formats.acr_script import FORMAT
from amp_studio.files import Header, ParameterFile, content_of
from amp_studio.files.reading import read_content
from amp_studio.formats import FormatError, ReadOptions, file_of
from amp_studio.schema import Schema, Value, load_schema, read_address
from amp_studio.schema.catalog import schema_of
from amp_studio.schema.load import compile_family
from tests.campaigns import examples
from tests.families.acromill.test_acr_script import message_of, mill
from tests.families.servo57c422b.small_module import taken, told

MILL = load_schema("acromill")
AXES = "XYZABCUV"


# -- properties

SETTINGS = [s for command in commands_of(MILL, "mill") for s in command.settings]
FIGURES = st.one_of(
    st.integers(-(10**6), 10**6).map(float),
    st.floats(-1e9, 1e9),
    st.floats(-1e-6, 1e-6),
    st.sampled_from([5e-324, 1.7976931348623157e308, -0.0, 0.1 + 0.2]),
)


@given(
    data=st.data(),
    chosen=st.lists(st.sampled_from(SETTINGS), unique=True),
    system=st.sampled_from(["inch", "metric"]),
)
@settings(max_examples=examples(60))
def test_a_value_in_the_unit_of_its_figure_comes_back_exactly(
    data: st.DataObject, chosen: list[object], system: str
) -> None:
    file = mill()
    file.set(("control.default_units", ""), Value(system))
    for setting in chosen:
        for address in setting.addresses:
            parameter = MILL.parameter(address[0])
            unit = (parameter.storage.unit if parameter.storage else None) or MILL.unit(
                parameter, system, False
            )
            number = data.draw(FIGURES if parameter.type == "real" else st.integers(-(2**31), 2**31))
            file.set(address, Value(number, unit))
    text = FORMAT.write(file)
    assert not re.search(r"[0-9]e[+-]?[0-9]", text, re.IGNORECASE), "no figure has an exponent"
    back = file_of(MILL, FORMAT.read(text, MILL, ReadOptions()), "TRY")
    assert back.values == file.values
    assert FORMAT.write(back) == text


@given(
    lines=st.lists(
        st.sampled_from(
            [
                "PROG0",
                "HALT",
                "",
                "  ",
                "REM x",
                "TLM X4",
                "PPU X1",
                "EXC AXIS2 -0.5",
                "DAC1 GAIN 2",
                "NOTCH Y(1, 2)",
                "P7=8",
                "10 LD 769",
                "P12341=P12336",
                "{axes.pulses_per_unit@X}",
                "{{line 1}",
                "{line 1}",
                "TLM X",
                "REM units inch",
                "RES X #",
            ]
        )
    )
)
def test_a_script_with_other_commands_comes_back_as_it_was(lines: list[str]) -> None:
    text = "\n".join(lines)
    file = file_of(MILL, FORMAT.read(text, MILL, ReadOptions(keep_unknown=True)), "TRY")
    if file.unknown:
        assert FORMAT.write(file) == text
        again = read_content(Path("TRY.amp"), content_of(file))
        assert FORMAT.write(again) == text


@given(
    text=st.lists(
        st.sampled_from(
            [
                "PPU",
                "X",
                "Y",
                "EXC",
                "AXIS0",
                "AXIS9",
                " ",
                "4",
                "-",
                ".5",
                "E",
                "(",
                ")",
                ",",
                "NOTCH",
                "P",
                "=",
                "DAC0",
                "GAIN",
                "\n",
                "\r\n",
                "\t",
                "REM",
                "é",
                "{",
                "}",
                "#",
                "1E999",
                "REM units inch\n",
                "units",
            ]
        ),
        max_size=12,
    ).map("".join),
    keep=st.booleans(),
)
def test_any_text_is_read_or_told_with_its_line(text: str, keep: bool) -> None:
    place = None
    try:
        file = file_of(MILL, FORMAT.read(text, MILL, ReadOptions(keep)), "TRY")
    except FormatError as fault:
        place = fault.line or 0
    if place is None:
        FORMAT.write(file)
    else:
        assert 1 <= place <= text.count("\n") + 1


# -- other forms that a family may have

SMALL = """
family: small
name: Small mill
document: small-guide
title: Small Guide
machines: [{key: mill, name: Mill}]
default_machine: mill
scopes: {global: {instances: [""], label: Control}, axis: {instances: [X, X2, W], label: "Axis {i}"}}
units: {metric: {length: mm}}
effect: {level: at-once}
groups: [all]
"""
COMMANDS = """
  - {id: a.sense, name: Sense, type: choice,
     choices: [{key: up, label: Up, raw: 1}, {key: down, label: Down}],
     storage: {command: "SENSE {v}"}, help: {what: A choice.}, page: "1"}
  - {id: a.time, name: Time, scope: axis, type: real, quantity: time, unit: s,
     storage: {unit: ms, scale: 2, decimals: 1, command: "SET TIME{k}: {a.time} {a.sense2}"},
     help: {what: A time.}, page: "1"}
  - {id: a.sense2, name: Word, scope: axis, type: bits,
     storage: {bits: 16, command: "SET TIME{k}: {a.time} {a.sense2}"},
     help: {what: A word.}, page: "1"}
  - {id: a.note, name: Note, type: text, storage: {command: "NOTE {v}"}, help: {what: A text.}, page: "1"}
"""


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> Schema:
    """Return a family with other forms of commands than AcroMill has."""
    folder = tmp_path_factory.mktemp("made") / "small"
    (folder / "groups").mkdir(parents=True)
    (folder / "family.yaml").write_text(SMALL, "utf-8")
    (folder / "groups" / "all.yaml").write_text(
        f'key: all\nname: All\nchapter: "1"\nparameters:\n{COMMANDS}', "utf-8"
    )
    return schema_of(compile_family(folder))


def test_codes_scales_and_decimals_are_those_of_the_schema(small: Schema) -> None:
    file = ParameterFile(small, Header(name="TRY"))
    for name, value in (
        ("a.sense", Value("up")),
        ("a.time@X2", Value(0.01234, "s")),
        ("a.sense2@X2", Value(7)),
    ):
        file.set(read_address(name), value)
    assert FORMAT.write(file).split("\n")[1:] == ["SENSE 1", "SET TIME1: 24.7 7", ""]  # 24.68, to one decimal
    back = taken(FORMAT, small, "SENSE 1\nset time1 : 24.7 7")
    assert message_of(back) == {
        "a.sense": Value("up"),
        "a.time@X2": Value(12.35, "ms"),
        "a.sense2@X2": Value(7),
    }
    assert message_of(taken(FORMAT, small, "SENSE -3")) == {"a.sense": Value("raw:-3")}
    assert told(FORMAT, small, "SENSE .5") == "line 1, column 7: Sense takes whole numbers, not 0.5"


def test_what_has_no_figure_is_told(small: Schema) -> None:
    file = ParameterFile(small)
    for name, value, said in (
        ("a.note", Value("hello"), "a.note: Note is a text, which the control does not store"),
        ("a.sense", Value("down"), "a.sense: no code is printed for 'Down' of Sense"),
    ):
        file.set((name, ""), value)
        with pytest.raises(FormatError, match=said):
            FORMAT.write(file)
        file.set((name, ""), None)


NUMBERED = """
  - {id: rate.max, name: Maximum Rate, scope: axis, numbers: {start: 110, step: 1, format: "${n}"},
     type: real, unit: mm/min, storage: {command: "${n}={v}"}, help: {what: A rate.}, page: "1"}
  - {id: rate.homing, name: Homing Rate, numbers: {start: 25, format: "${n}"}, type: real,
     unit: mm/min, storage: {command: "${n}={v}"}, help: {what: A rate.}, page: "1"}
"""


def test_the_number_in_a_command_is_the_number_that_the_manual_prints(tmp_path: Path) -> None:
    (tmp_path / "small" / "groups").mkdir(parents=True)
    (tmp_path / "small" / "family.yaml").write_text(SMALL, "utf-8")
    group = f'key: all\nname: All\nchapter: "1"\nparameters:\n{NUMBERED}'
    (tmp_path / "small" / "groups" / "all.yaml").write_text(group, "utf-8")
    (command,) = commands_of(schema_of(compile_family(tmp_path / "small")), "mill")
    written = [setting.write(["500"]) for setting in command.settings]
    assert written == ["$110=500", "$111=500", "$112=500", "$25=500"]
    found = command.read("$111=600", 0)
    assert found is not None
    assert (found.setting.addresses, found.figures) == ((("rate.max", "X2"),), (("600", 6),))
    assert command.read("$1=600", 0) is None
