"""A family that is nothing like the 9/PC: axes that are always there, words of bits, texts,
machine types in the header.
"""

from pathlib import Path

from amp_studio.schema import Schema
from amp_studio.schema.catalog import schema_of
from amp_studio.schema.load import compile_family

FAMILY = """
family: wide
name: Wide control
document: wide-manual
title: Wide Manual
machines: [{key: small, name: Small machine}, {key: large, name: Large machine}]
default_machine: small
scopes:
  global: {instances: [""], label: Control}
  axis: {instances: ["0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "11"], label: "Axis {i}"}
  word: {instances: ["0", "1", "2"], label: "Word {i}"}
units: {metric: {length: mm}}
effect: {level: restart}
groups: [all]
"""
GROUP = """
key: all
name: Everything
chapter: "1"
parameters:
  - id: axis.position
    name: Position
    scope: axis
    numbers: {format: "P10N{i}"}
    type: real
    quantity: length
    help: {what: A length.}
    page: "1-1"
  - id: word.mode
    name: Mode word
    scope: word
    numbers: {format: "P2N{i}"}
    type: bits
    bits:
      - {bit: 0, label: Axis turns}
      - {bit: 3, label: Second gear}
      - {bit: 4, width: 2, label: Loop,
         choices: [{key: open, label: open, raw: 0}, {key: closed, label: closed, raw: 2}]}
    default: {value: 0, page: "1-2"}
    effect: {level: command, command: load modes}
    help: {what: Bits.}
    page: "1-2"
  - id: machine.name
    name: Name of the machine
    type: text
    help: {what: A text.}
    page: "1-3"
"""


GUIDE = """
guides:
  - id: start
    title: Order of integration
    page: "3-1"
    steps:
      - {title: The words, what: Set the words first., params: [word.mode], page: "3-1"}
      - {title: The axes, params: [axis.position, word.mode], page: "3-2"}
"""


def wide_schema(folder: Path) -> Schema:
    """Write the facts into a folder and return the schema."""
    for name, text in {"family": FAMILY, "groups/all": GROUP, "guides/start": GUIDE}.items():
        path = folder / f"{name}.yaml"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return schema_of(compile_family(folder))
