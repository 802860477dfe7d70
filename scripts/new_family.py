"""Write the frame of a control family: facts that load, with one parameter to replace.

    python scripts/new_family.py ld2                 writes parameter_db/ld2
    python scripts/new_family.py ld2 --into FOLDER   writes FOLDER/ld2,
    for another package (docs/family-code.md)

docs/howto/add-family.md goes on from there; `make test TESTS=tests/schema/test_whole_family.py` lists what is
missing.
"""

import argparse
import re
import sys
from pathlib import Path

import write_schemas

from amp_studio.schema import database_folder, family_ids

FILES = {
    "family.yaml": (
        """\
# yaml-language-server: $schema=../schemas/family.schema.json
family: {name}
name: {name}                              # as its users call it
document: {name}-manual
title: {name}, manual                     # as it is on the cover
machines:
  - {{key: machine, name: Machine}}
default_machine: machine
# What can have separate values: here the control, and each axis.
scopes:
  global: {{instances: [""], label: Control}}
  axis: {{instances: [X, Y], label: "{{i}} axis"}}
units:
  metric: {{length: mm, velocity: mm/min}}
# How parameters come into a control. A line or a gateway is added once there is one (docs/family-code.md).
ways:
  - {{way: sheet, what: Values are keyed in at the screens of a {name}}}
effect: {{level: restart}}                # at-once, reset, restart or command: when a change takes effect
groups: [general]                         # in the manual's order; a file in groups/ for each
"""
    ),
    "groups/general.yaml": (
        """\
# yaml-language-server: $schema=../../schemas/group.schema.json
key: general
name: General
chapter: "1"
parameters:
  # Replace this one. What the manual does not print is left out: a default, a range.
  - id: general.example                   # never changes once it is published
    name: Example
    scope: axis
    numbers: {{start: 1, step: 1, format: "P{{n}}"}}   # P1 for X, P2 for Y
    type: real
    quantity: length
    ranges: {{mm: [0, 100]}}
    storage: {{unit: mm, decimals: 2}}
    help:
      what: What it is.
      find: How a user finds its value.
      wrong: What a wrong value does to the machine.
    page: "1"
"""
    ),
}
"""Path below the family's folder -> its text, with the name to fill in."""


def write_family(name: str, folder: Path) -> list[Path]:
    """Write the frame into ``folder``/``name``; raises FileExistsError, and writes nothing, where it
    exists.
    """
    family = folder / name
    family.mkdir(parents=True)
    written = []
    for path, text in FILES.items():
        target = family / path
        target.parent.mkdir(exist_ok=True)
        target.write_text(text.format(name=name), encoding="utf-8")
        written.append(target)
    return written


def main() -> None:
    """Write a family's frame and name the files."""
    parser = argparse.ArgumentParser(description=str(__doc__).partition("\n")[0])
    parser.add_argument("name", help="id of the family: lower-case letters, digits, '-' and '_'")
    parser.add_argument("--into", type=Path, metavar="FOLDER", help="another folder than parameter_db")
    options = parser.parse_args()
    if not re.fullmatch(r"[a-z0-9][a-z0-9_-]*", options.name):
        sys.exit(f"'{options.name}' is no id: lower-case letters, digits, '-' and '_'")
    if options.name in family_ids():
        sys.exit(f"a family '{options.name}' exists already")
    try:
        written = write_family(options.name, options.into or database_folder())
    except OSError as error:
        sys.exit(f"nothing was written: {error.strerror}: {error.filename}")
    for path in written:
        print(path)
    if options.into is None:
        write_schemas.main()


if __name__ == "__main__":
    main()
