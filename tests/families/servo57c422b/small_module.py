"""A small servo module for the tests of the AutoMax formats: every kind of register once,
and what they all go through.
"""

from pathlib import Path
from textwrap import dedent

import pytest

from amp_studio.files import ParameterFile
from amp_studio.formats import FormatError, ReadOptions, TextFormat, file_of
from amp_studio.schema import Schema, read_address, read_value
from amp_studio.schema.catalog import schema_of
from amp_studio.schema.load import compile_family

FAMILY = """
family: small
name: Small module
document: small-manual
title: Small Manual
machines: [{key: module, name: Module}]
default_machine: module
scopes:
  axis: {instances: [X, Y], label: "{i} axis"}
  register: {instances: [X, Y], label: "{i} axis, point {j}", of: axis}
units: {metric: {}}
effect: {level: command, command: change default setups}
groups: [all]
conditions:
  ratio_of_words: {reads: {modes: r.modes}, when: "bit(modes, 2.0)", why: the ratio is one of two numbers}
"""
REGISTERS = {
    "r.setup": "0: {type: bits, storage: {bits: 16, signed: false, notation: hex}}",
    "r.gain": "3: {type: integer, storage: {bits: 16}}",
    "r.limit": "4: {type: integer, quantity: counts, storage: {bits: 16, signed: false}}",
    "r.byte": "5: {type: integer, storage: {bits: 8}}",
    "r.travel": "11: {type: integer, quantity: counts, storage: {unit: counts, bits: 32, words: 2}}",
    "r.slow": (
        "15: {type: real, unit: counts/s, storage: {unit: counts/s, scale: 65.536, bits: 32, words: 2}}"
    ),
    "r.fast": (
        "17: {type: real, unit: counts/s, storage: {unit: counts/s, scale: 65.536, bits: 32, words: 2,"
        " signed: false}}"
    ),
    "r.ramp": (
        "21: {type: real, unit: counts/s2, storage: {unit: counts/s2, scale: 0.065536, bits: 32, words: 2}}"
    ),
    "r.ratio": (
        "25: {type: real, storage: {scale: 16777216, bits: 32, words: 2}, states: [{state: hidden, when:"
        " ratio_of_words}]}"
    ),
    "r.over": "25: {type: integer, storage: {bits: 16}, states: [{state: hidden, unless: ratio_of_words}]}",
    "r.under": "26: {type: integer, storage: {bits: 16}, states: [{state: hidden, unless: ratio_of_words}]}",
    "r.volts": "28: {type: real, quantity: voltage, storage: {unit: V, scale: 198.4, bits: 16}}",
    "r.modes": "38: {type: bits, storage: {bits: 16, signed: false, notation: hex}}",
    "r.time": "39: {type: real, quantity: time, unit: ms, storage: {unit: ms, scale: 0.8, bits: 16}}",
    "r.sense": (
        "40: {type: choice, choices: [{key: up, label: Up, raw: 1}, {key: down, label: Down, raw: -1}, {key:"
        " odd, label: Odd}]}"
    ),
    "r.marker": (
        '41: {type: boolean, choices: [{key: "yes", label: "On", raw: 1}, {key: "no", label: "Off", raw: 0}]}'
    ),
    "r.mode": "65: {type: bits, storage: {bits: 16, signed: false, notation: hex}, effect: {level: at-once}}",
    "r.status": "72: {type: bits, storage: {bits: 16, signed: false, notation: hex}, access: read}",
    "r.version": "99: {type: text, storage: {notation: ascii, words: 5}, access: read}",
    "r.point": (
        "132: {type: integer, quantity: counts, storage: {unit: counts, bits: 32, words: 2, word_order:"
        " low-first}}"
    ),
}


def small_module(folder: Path) -> Schema:
    """Return the schema of the small module."""
    (folder / "groups").mkdir(parents=True)
    (folder / "tables").mkdir()
    (folder / "family.yaml").write_text(FAMILY, "utf-8")
    (folder / "tables" / "variables.yaml").write_text(
        'tables: [{id: basic-variables, title: Variables, page: "1", head: [Variable, Register],'
        ' rows: [["PGAIN%", 3], ["RATIO!", 25], ["CMD%", 66]]}]\n',
        "utf-8",
    )
    text = 'key: all\nname: All\nchapter: "1"\nparameters:\n'
    for name, register in REGISTERS.items():
        number, _, rest = register.partition(": ")
        numbers = f'{{start: {number}, step: 2048, format: "R{{n}}"}}'
        scope = "axis"
        if name == "r.point":
            scope = 'register, instances: ["X.0..2", "Y.0..2"]'
            numbers = '{starts: {X: 132, Y: 2180}, step: 2, format: "R{n}"}'
        text += (
            f"  - {{id: {name}, name: {name[2:].title()}, scope: {scope}, numbers: {numbers}, {rest[1:-1]},"
            ' help: {what: A register.}, page: "1"}\n'
        )
    (folder / "groups" / "all.yaml").write_text(text, "utf-8")
    return schema_of(compile_family(folder))


def filled(schema: Schema, **message: str) -> ParameterFile:
    """Return a file with values, written as a person does: ``gain_X="3"``, ``point_X__1="-2"`` for
    ``X.1``.
    """
    file = ParameterFile(schema)
    for key, text in message.items():
        name, _, instance = key.partition("_")
        address = read_address(f"r.{name}@{instance.replace('__', '.')}")
        parameter = schema.parameters[address[0]]
        file.set(address, read_value(parameter, text, schema.units_of(parameter)[0]))
    return file


def taken(form: TextFormat, schema: Schema, text: str, *, keep: bool = False) -> ParameterFile:
    """Return the file that a text makes."""
    return file_of(schema, form.read(dedent(text), schema, ReadOptions(keep)), "TRY")


def told(form: TextFormat, schema: Schema, text: str) -> str:
    """Return the error of a text that cannot be meant."""
    with pytest.raises(FormatError) as caught:
        form.read(dedent(text), schema, ReadOptions())
    return str(caught.value)
