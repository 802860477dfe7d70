"""One block of a program, word by word, as the file in front has it read; without one, what is active after
power-up.
"""

from __future__ import annotations

from collections.abc import Sequence

from amp_studio.files import ParameterFile
from amp_studio.programs import BlockReader, power_up
from amp_studio.schema import Address
from amp_studio.sim import value_text
from amp_studio.ui.base.translated import sentenced, tr
from amp_studio.ui.forms.form import Field

BlockRows = list[tuple[str, str, str, str]]
"""Word, number, meaning and parameters of each."""


def block_fields() -> Sequence[Field]:
    """Return what is asked for: a block, and where the zero of the program is."""
    return (
        Field(
            "block",
            tr("&Block"),
            hint="G1 X10 F200",
            tip=tr("Enter shows each word as this file has it read; empty, what is active after power-up"),
        ),
        Field(
            "zero",
            tr("&Zero"),
            hint="X0,Y0",
            tip=tr("Where the zero of the program is in the machine; empty takes work coordinates"),
        ),
    )


def block_in_words(file: ParameterFile, text: str) -> tuple[BlockRows, str]:
    """Return the rows of a block, and what is wrong or assumed; of none, what is active after power-up.
    Raises ProgramBlockError.
    """
    family = file.schema.family.family

    def worded(text: str) -> str:
        return sentenced(text, family)

    def named(params: Sequence[Address]) -> str:
        return ", ".join(map(file.machine_schema.label, params))

    if not text.strip():
        found = power_up(file)
        lines = (*found.active, *found.changes, *found.calls)
        rows = [
            (line.code, "", f"{worded(line.what)}: {worded(line.meaning)}", named(line.params))
            for line in lines
        ]
        return rows, tr("What is active after power-up, what changes it, and what calls a program.")
    block = BlockReader(file).read(text)
    rows = [
        (
            word.word,
            "" if word.number is None else worded(value_text(word.number, word.unit, 9)),
            ": ".join(map(worded, filter(None, (word.meaning, word.fault)))),
            named(word.params),
        )
        for word in block.words
    ]
    return rows, "; ".join(map(worded, block.faults or block.assumptions))
