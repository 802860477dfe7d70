"""The parameter table with which an emulated NUM control is delivered: printed defaults,
and 0 where none is printed.
"""

from __future__ import annotations

import re

from amp_studio.families.num.formats.table import FORMAT
from amp_studio.families.num.formats.words import words_of
from amp_studio.files import new_file


def delivered_table(family: str) -> bytes:
    """Return every word of every parameter whose type is printed, as lines of a table with Xoff behind
    them.
    """
    file = new_file(family)
    known, words = words_of(file.schema, file.machine), dict[tuple[int, int], str]()
    parameter, first = 0, 0
    for line in FORMAT.write(file).splitlines():
        text = line.rpartition(";")[0]
        if match := re.match(r"P([0-9]+)N([0-9]+)", text):
            parameter, first = int(match[1]), int(match[2])
        elif text.startswith("#"):
            for n, word in enumerate(text[1:].split(" ")):
                words[parameter, first + n] = word
    lines = ["%00000000"]
    for parameter, (code, count) in sorted(known.heads.items()):
        for first in range(0, count, 10):
            here = range(first, min(first + 10, count))
            lines.append(f"P{parameter}N{first}:t{code}n{count}")
            zero = "00000000" if code == 6 else "0"
            lines.append("#" + " ".join(words.get((parameter, n), zero) for n in here))
    return "".join(f"{line};{len(line):02X}\n" for line in lines).encode("ascii") + b"\x13"
