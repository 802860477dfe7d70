"""Properties of the AutoMax texts: what is written is read, to the register's resolution;
what is kept comes back.
"""

from hypothesis import given, settings
from hypothesis import strategies as st

from amp_studio.families.servo57c422b.formats.automax import TABLE, TASK
from amp_studio.families.servo57c422b.formats.registers import Registers, is_writable
from amp_studio.files import ParameterFile
from amp_studio.formats import FormatError, ReadOptions, file_of
from amp_studio.schema import Address, Schema, Value
from amp_studio.schema.storage import is_signed, register_number, value_of_register
from tests.campaigns import examples

FORMS = st.sampled_from([TABLE, TASK])


@st.composite
def files(draw: st.DrawFn, schema: Schema) -> ParameterFile:
    """Return a file with some values that fit their registers, as a person gives them: not to the count."""
    file = ParameterFile(schema)
    registers = Registers(schema, "module")
    for address in draw(st.lists(st.sampled_from(sorted(registers.first)), unique=True)):
        parameter = registers.parameter(address)
        if parameter.access == "read":
            continue
        if parameter.choices:
            coded = [c.key for c in parameter.choices if c.raw is not None]
            key = draw(st.sampled_from(coded))
            file.set(address, Value(key == "yes" if parameter.type == "boolean" else key))
            continue
        bits, scale = parameter.storage.bits, parameter.storage.scale
        low, high = (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) if is_signed(parameter) else (0, 2**bits - 1)
        whole = draw(st.one_of(st.integers(low, high), st.sampled_from([low, high, 0, 1])))
        number = whole if parameter.type != "real" else draw(st.sampled_from([whole, 0.6 * whole])) / scale
        file.set(address, Value(number, registers.unit(address)))
    return file


def as_held(file: ParameterFile) -> dict[Address, Value]:
    """Return the content of the registers for a file, in the words of the schema."""
    registers = Registers(file.schema, file.machine)
    found = {}
    for address, value in file.values.items():
        if is_writable(file, address):
            parameter, unit = registers.parameter(address), registers.unit(address)
            found[address] = value_of_register(parameter, register_number(parameter, value, unit), unit)
    return found


@given(data=st.data(), form=FORMS)
@settings(max_examples=examples(60))
def test_what_is_written_is_read_to_the_resolution_of_its_register(
    module: Schema, data: st.DataObject, form: object
) -> None:
    file = data.draw(files(module))
    text = form.write(file)
    back = file_of(module, form.read(text, module, ReadOptions()), "TRY")
    assert back.values == as_held(file)
    again = form.write(back)
    assert file_of(module, form.read(again, module, ReadOptions()), "TRY").values == back.values
    assert as_held(back) == back.values, "from then on nothing changes"


STATEMENTS = st.sampled_from(
    [
        "GOSUB 2000",
        "DELAY 2 TICKS",
        "A%=B% AND 037FH",
        'PRINT "a \\ ! b"',
        "IF A@ THEN PGAIN%=1",
        "FAULT@=(A%<>0)",
        "{3}",
        "CMD%=01H",
        "WAIT ON &\n X",
        "REG_300%=1",
    ]
)
REMARKS = st.sampled_from(["", " ", "! remark \\ {3}", "REM\tPGAIN%=1"])


@st.composite
def tasks(draw: st.DrawFn) -> str:
    """Return a task with settings and other statements, written as the program writes settings."""
    names = draw(
        st.lists(
            st.sampled_from(["PGAIN%", "REG_4%", "REG_11!", "REG_2051%", "RATIO!", "REG_38%"]), unique=True
        )
    )
    settled = [
        f"{n}={draw(st.sampled_from(['0', '5', '77']))}" if n != "REG_38%" else "REG_38%=02H" for n in names
    ]
    statements = draw(st.permutations(settled + draw(st.lists(STATEMENTS, max_size=6))))
    text, number = "", 10
    while statements:
        count = draw(st.integers(1, 3))
        here, statements = list(statements[:count]), statements[count:]
        if any(s.startswith("IF") for s in here[:-1]):
            here = [s for s in here if not s.startswith("IF")]
        remark = draw(REMARKS)
        text += f"{number} " + " \\".join(here) + (" \\" if remark.strip() else "") + remark + "\n"
        number += draw(st.integers(1, 10))
    return text


@given(task=tasks())
def test_a_task_with_other_statements_comes_back_as_it_was(module: Schema, task: str) -> None:
    file = file_of(module, TASK.read(task, module, ReadOptions(keep_unknown=True)), "TRY")
    if file.unknown:
        assert TASK.write(file) == task
    else:
        assert file.header.extra == {}


@given(
    text=st.lists(
        st.sampled_from(
            [
                "1",
                "3",
                "11",
                "12",
                " ",
                "\t",
                "!",
                "\\",
                "&",
                "\n",
                "\r\n",
                "R3 5",
                "PGAIN%",
                "=",
                "-",
                "0FFH",
                "REG_11!",
                "REM",
                '"',
                "{3}",
                "IF ",
                "é",
                ".",
                "99999999999",
                "\x1a",
                "REG_65536%",
                "H",
            ]
        ),
        max_size=12,
    ).map("".join),
    form=FORMS,
    keep=st.booleans(),
)
def test_any_text_is_read_or_told_with_its_line(module: Schema, text: str, form: object, keep: bool) -> None:
    place = None
    try:
        file = file_of(module, form.read(text, module, ReadOptions(keep)), "TRY")
    except FormatError as fault:
        place = fault.line or 0
    if place is None:
        form.write(file)
    else:
        assert 1 <= place <= text.count("\n") + 1
