"""A small NUM family for the tests of its parameter table, with a word of every type,
and the manual's own example.
"""

import re
from pathlib import Path

import pytest

from amp_studio.families.num.formats.table import FORMAT
from amp_studio.files import ParameterFile
from amp_studio.formats import FormatError, ReadOptions, file_of
from amp_studio.schema import Schema
from amp_studio.schema.catalog import schema_of
from amp_studio.schema.load import compile_family

XOFF = "\x13"

# The example of page 13-14, without what the page remarks beside it.
SAMPLE = f"""\
%00000000;09
P0N0:t6n1;09
#00000007;09
P1N0:t6n2;09
#00000000 00000000;12
P2N0:t6n1;09
#00000007;09
P3N0:t6n1;09
#00000007;09
P4N0:t0n4;09
#0 0 0;06
P5N0:t0n2;09
#1 0;04
P6N0:t0n9;09
#0 0 0 0 0;0A
P7N0:t0n2;09
#54 A;05
P8N0:t6n1;09
#00000000;09
P9N0:t0n32;0A
#0 1 2 FF FF FF FF FF FF FF;1B
P9N10:t0n32;0B
#FF FF FF FF FF FF FF FF FF FF;1E
P9N20:t0n32;0B
#FF FF FF FF FF FF FF FF FF FF;1E
P9N30:t0n32;0B
#FF FF;06
P10N0:t6n1;0A
#00000000;09
{XOFF}"""

FAMILY = f"""
family: num
name: Small NUM
document: small-manual
title: Small Manual
machines: [{{key: cnc, name: CNC}}]
default_machine: cnc
scopes:
  global: {{instances: [""], label: Control}}
  axis: {{instances: [{", ".join(f'"{n}"' for n in range(32))}], label: "Axis {{i}}"}}
  word: {{instances: ["0", "1"], label: "N{{i}}"}}
units: {{metric: {{length: mm, velocity: mm/min}}}}
angular_when: turns
effect: {{level: reset}}
groups: [all]
conditions:
  turns: {{reads: {{modulo: p.w1_0}}, when: "bit(modulo, double(instance))", why: the axis turns}}
  coarse: {{reads: {{mode: p.w7_0}}, when: mode == 1.0, why: word 0 of P7 is 1}}
"""
FORMS = {
    0: "bits: 8, signed: false, notation: hex",
    1: "bits: 16",
    2: "bits: 32",
    4: "bits: 32, signed: false",
    5: "bits: 16, signed: false",
    6: "bits: 32, signed: false, notation: hex",
    7: "bits: 16, signed: false, notation: hex",
    8: "notation: ascii",
    9: "",
}


def word(number: str, code: int, kind: str = "integer", more: str = "", storage: str = "") -> str:
    """Return a parameter of one word; its id has its number: p.w9_0 is P9N0."""
    name = re.sub(r"P(\d+)N(.*)", r"w\1_\2", number)
    kept = ", ".join(part for part in (f"code: {code}", FORMS[code], storage) if part)
    return (
        f"  - {{id: p.{name}, name: Word {number}, numbers: {{format: {number}}}, type: {kind}, "
        f"storage: {{{kept}}}, help: {{what: A word.}}, page: '1-1'{more}}}\n"
    )


def axes(number: str, code: int, kind: str = "integer", more: str = "", storage: str = "") -> str:
    """Return a parameter of a word for each axis: p.w9 is P9N0 to P9N31."""
    text = word(number.partition("N")[0] + "Nx", code, kind, f", scope: axis{more}", storage)
    return text.replace("_x", "").replace(
        "{format: " + number.partition("N")[0] + "Nx}", number.partition("N")[2]
    )


PARAMETERS = "".join(
    [
        *(word(n, 6, "bits") for n in ("P0N0", "P1N0", "P1N1", "P2N0", "P3N0", "P8N0", "P10N0")),
        *(word(f"P4N{n}", 0) for n in range(5)),
        *(word(f"P5N{n}", 0) for n in range(2)),
        *(word(f"P6N{n}", 0) for n in range(9)),
        *(word(f"P7N{n}", 0, "bits") for n in range(2)),
        axes("P9N{format: 'P9N{i}'}", 0),
        axes(
            "P16N{start: 0, step: 2, format: 'P16N{n}'}",
            2,
            "real",
            ", quantity: length",
            "unit: mm, scale: 1000",
        ),
        axes(
            "P17N{start: 1, step: 2, format: 'P16N{n}'}",
            2,
            "real",
            ", quantity: length",
            "unit: mm, scale: 1000",
        ),
        axes("P18N{format: 'P18N{i}'}", 1),
        axes("P21N{format: 'P21N{i}'}", 4),
        axes("P22N{format: 'P22N{i}'}", 5, "real", ", quantity: time, unit: ms"),
        axes("P30N{format: 'P30N{i}'}", 4, "real", ", quantity: velocity", "unit: mm/min"),
        word("P50N0", 5, more=", states: [{state: hidden, when: coarse}]"),
        word("P50N1", 5, "real", ", unit: s, states: [{state: hidden, unless: coarse}]").replace(
            "numbers: {format: P50N1}", "numbers: {format: P50N0}"
        ),
        word("P96N0", 8, "text"),
        *(word(f"P97N{n}", 8, "text") for n in range(3)),
        word(
            "P98N0",
            0,
            "choice",
            ", choices: [{key: assembler, label: Assembler, raw: 0}, {key: ladder, label: Ladder, raw: 1}]",
        ),
        word("P101N0", 7),
        word("P113N0", 9, "real"),
    ]
)


def small_num(folder: Path, parameters: str = PARAMETERS) -> Schema:
    """Return the family, written into a folder as the real ones are."""
    (folder / "groups").mkdir(parents=True)
    (folder / "family.yaml").write_text(FAMILY, "utf-8")
    group = f'key: all\nname: All\nchapter: "1"\nparameters:\n{parameters}'
    (folder / "groups" / "all.yaml").write_text(group, "utf-8")
    return schema_of(compile_family(folder))


def measured(*lines: str) -> str:
    """Return a table of lines whose lengths are worked out."""
    return "".join(f"{line};{len(line):02X}\n" for line in ("%00000000", *lines)) + XOFF


def taken(schema: Schema, text: str, *, keep_unknown: bool = False) -> ParameterFile:
    """Return the file of a table."""
    return file_of(schema, FORMAT.read(text, schema, ReadOptions(keep_unknown)), "TRY")


def fault(schema: Schema, text: str, *, keep_unknown: bool = False) -> str:
    """Return the error of a table that cannot be taken."""
    with pytest.raises(FormatError) as caught:
        FORMAT.read(text, schema, ReadOptions(keep_unknown))
    return str(caught.value)
