"""One block of a program, word by word, as the file in front has it read; without one, what is active after
power-up.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

import numpy as np

from amp_studio.files import ParameterFile
from amp_studio.programs import BlockReader, power_up
from amp_studio.schema import Address, canonical
from amp_studio.sim import PathMoment, ProgramRun, path_error_text, value_text
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.translated import sentenced, tr, unit_in_words
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
        Field(
            "limit",
            tr("Error limi&t"),
            hint=written("0.03 mm"),
            tip=tr("The contour error that you allow: what is above it is marked, and is not good"),
        ),
    )


def found_line(lines: Sequence[str], text: str) -> int:
    """Return the line, from 1, of what was typed: ``N150`` is the block of that number, ``150`` the line; 0
    without one.
    """
    wanted = text.strip().upper()
    number = re.fullmatch(r"(N?)\s*0*([0-9]{1,9})", wanted)
    if number is None:
        return 0
    if not number[1]:
        return int(number[2]) if 1 <= int(number[2]) <= len(lines) else 0
    # N0150 and N150 are one block, N1500 and N150.5 are others.
    own = re.compile(rf"[ \t/%]*N\s*0*{number[2]}(?![0-9.])", re.IGNORECASE)
    return next((n for n, line in enumerate(lines, 1) if own.match(line)), 0)


def moment_name(block: str, moment: PathMoment, length: str) -> str:
    """Return the block of a moment with its speed: ``N150: 1420 of 4800 mm/min``."""
    number = re.match(r"[ \t/%]*(N\s*[0-9]+)", block, re.IGNORECASE)
    name = number[1].upper() if number else tr("Line {number}").format(number=moment.line)
    size = canonical(1.0, length) / 60.0
    unit = unit_in_words(f"{length}/min")
    speed = written(value_text(moment.speed / size, "", 4))
    if math.isfinite(moment.feed) and moment.feed > 0.0:
        of_feed = written(value_text(moment.feed / size, unit, 4))
        return f"{name}: " + tr("{speed} of {feed}").format(speed=speed, feed=of_feed)
    return f"{name}: {speed} {unit}"


def error_now(run: ProgramRun, time: float, length: str) -> str:
    """Return the contour error at a moment in words; "" without one."""
    contour = run.contour
    if contour is None or not len(contour.time):
        return ""
    # The time bar may be a hair behind the last sample.
    at = min(int(np.searchsorted(contour.time, time)), len(contour.time) - 1)
    return tr("now {error}").format(error=sentenced(path_error_text(float(contour.error[at]), length)))


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
