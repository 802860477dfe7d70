"""Properties of the NUM parameter table: what is written is read, and what is altered is reported."""

from random import Random

from hypothesis import given, settings
from hypothesis import strategies as st

from amp_studio.families.num.formats.table import FORMAT
from amp_studio.families.num.formats.words import words_of
from amp_studio.formats import FormatError, ReadOptions, file_of
from amp_studio.schema import Schema
from tests.campaigns import CAMPAIGN, examples
from tests.families.num.small_num import measured, taken

VALUES = {
    0: (0, 0xFF, "{:X}"),
    1: (-32768, 32767, "{}"),
    2: (-99_999_999, 99_999_999, "{}"),
    4: (0, 99_999_999, "{}"),
    5: (0, 65535, "{}"),
    6: (0, 0xFFFFFFFF, "{:08X}"),
    7: (0, 0xFFFF, "{:X}"),
}
"""Type of words -> lowest and highest value (page 1-3), and how the example of page 13-14 spells them."""

SIGNS = " 0169AEFaf+-.,;:#%PNtn\t\r\n\0\x13\x1a~"


def content(some: Random, code: int, *, alone: bool) -> str:
    """Return what a word of a type may hold, as the control spells it."""
    if code == 8:
        return "".join(
            chr(some.randint(32 if alone else 33, 126)) for _ in range(some.randint(0 if alone else 1, 6))
        )
    if code == 9:
        return repr(some.choice([0.0, some.uniform(-1e6, 1e6), 1e30, 5e-7])).upper().removesuffix(".0")
    low, high, spelled = VALUES[code]
    return spelled.format(some.choice([low, high, 0, 1, some.randint(low, high), some.randint(low, high)]))


def table_of(schema: Schema, some: Random, *, whole: bool) -> str:
    """Return a table as a control would send it, with all words or with most."""
    known, lines = words_of(schema, "cnc"), []
    for a, count in sorted(known.counts.items()):
        code = known.heads[a][0]
        for tens in range(0, count, 10):
            run: list[str] = []
            for n in range(tens, min(tens + 10, count)):
                if whole or some.random() < 0.9:
                    run.append(content(some, code, alone=count == 1))
                elif run:
                    lines += [f"P{a}N{n - len(run)}:t{code}n{count}", "#" + " ".join(run)]
                    run = []
            if run:
                lines += [f"P{a}N{min(tens + 10, count) - len(run)}:t{code}n{count}", "#" + " ".join(run)]
    return measured(*lines)


@given(seed=st.integers(0, 2**32))
@settings(max_examples=examples(50))
def test_what_is_read_is_written_and_read_again(num: Schema, seed: int) -> None:
    table = table_of(num, Random(seed), whole=False)
    file = taken(num, table)
    assert FORMAT.write(file) == table
    assert file.header.extra == {}
    again = taken(num, FORMAT.write(file))
    assert again.values == file.values


def changes(schema: Schema, table: str, altered: str) -> set[str] | None:
    """Return what an altered table means otherwise, None where an error is reported."""
    try:
        read = FORMAT.read(altered, schema, ReadOptions())
    except FormatError:
        return None
    before = FORMAT.read(table, schema, ReadOptions())
    if read.notes != before.notes:
        return None
    assert FORMAT.write(file_of(schema, read, "TRY")) == altered, "what is taken comes back as it was"
    figures = [
        {a: (type(v.value), v.value) for a, v in values.items()} for values in (before.values, read.values)
    ]
    # The unit of a figure may go with a word of bits for the axes that turn; the figure stays.
    found = {str(a) for a in figures[0].keys() | figures[1] if figures[0].get(a) != figures[1].get(a)}
    if read.extra.get("num_table") != before.extra.get("num_table"):
        found.add("layout")
    return found


def says_one_thing(schema: Schema, table: str, at: int, sign: str) -> bool:
    """Return whether an altered byte is reported, or alters one value; of the first line, only what is there.

    Lengths, headers and counts see all but this: a digit (or sign) that becomes another in a number that
    still is one of its type, a letter of a text, and the job reference, which the control itself compares.
    """
    found = changes(schema, table, table[:at] + sign + table[at + 1 :])
    if found is None or sign == table[at]:
        return True
    line = table[:at].rpartition("\n")[2]
    return (
        found == {"layout"} if line.startswith("%") else len(found - {"layout"}) == 1 and line.startswith("#")
    )


@given(seed=st.integers(0, 2**32), place=st.floats(0, 1, exclude_max=True), code=st.integers(0, 127))
@settings(max_examples=examples(200))
def test_an_altered_byte_is_told_or_changes_one_value(
    num: Schema, seed: int, place: float, code: int
) -> None:
    table = table_of(num, Random(seed), whole=True)
    assert says_one_thing(num, table, int(place * len(table)), chr(code))


def test_every_altered_byte_of_a_table_is_told_or_changes_one_value(num: Schema) -> None:
    table = measured(
        "P1N0:t6n2",
        "#00000004 0000000A",
        "P5N0:t0n2",
        "#1 A0",
        "P9N20:t0n32",
        "#FF 1 2 3 4 5 6 7 8 9",
        "P9N30:t0n32",
        "#A B",
        "P18N0:t1n32",
        "#-10 20 3 4 5 6 7 8 9 10",
        "P21N30:t4n32",
        "#1000 2",
        "P96N0:t8n1",
        "#M. E",
        "P97N0:t8n3",
        "#A B CD",
        "P101N0:t7n1",
        "#FF",
        "P113N0:t9n1",
        "#-1.5",
    )
    for at in range(len(table)):
        for sign in SIGNS if CAMPAIGN else SIGNS[at % 5 :: 5]:
            assert says_one_thing(num, table, at, sign), (at, sign)


@given(seed=st.integers(0, 2**32), old=st.booleans(), keep_unknown=st.booleans())
@settings(max_examples=examples(200))
def test_whatever_is_taken_comes_back_as_it_was(
    num: Schema, seed: int, old: bool, keep_unknown: bool
) -> None:
    """A table that somebody edited: blocks moved, cut apart, without types, of other numbers,
    with other figures.
    """
    some = Random(seed)
    lines = [line.rpartition(";")[0] for line in table_of(num, some, whole=False).split("\n")[1:-1]]
    blocks = [
        [head.partition(":")[0] if old else head, data] for head, data in zip(*[iter(lines)] * 2, strict=True)
    ]
    for _ in range(some.randint(0, 6)):
        block = some.choice(blocks)
        edit = some.randint(0, 4)
        if edit == 0:
            blocks.remove(block)
            blocks.insert(some.randint(0, len(blocks)), block)
        elif edit == 1:
            block[1] = block[1].replace("#", some.choice(["#0", "#+", "#-", "#00", "#"]), 1)
        elif edit == 2:
            block[0] = block[0].partition(":")[0]
        elif edit == 3:
            block[0] = block[0].replace("P", some.choice(["P1", "P4"]), 1)
        else:
            block[1] = block[1].rpartition(" ")[0] or block[1]
    table = measured(*(line for block in blocks for line in block))
    try:
        read = FORMAT.read(table, num, ReadOptions(keep_unknown))
    except FormatError:
        return
    assert FORMAT.write(file_of(num, read, "TRY")) == table
