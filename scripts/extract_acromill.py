"""Extract the rows of the tables of system parameters from the text of the AcroMill user's guide.

    python scripts/extract_acromill.py GUIDE.txt -o tests/manual/acromill.yaml

GUIDE.txt is the scanned guide as plain text, the cells of its tables separated by tabs. Written are name, typical
value, default value and unit of each row, with the line and the table it stands in, and the lists of gains of appendix C.
The descriptions are left out. ``tests/manual`` holds the database against the rest.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from manual_facts import cut

HEAD = """Bare facts of the AcroMill user's guide, written by scripts/extract_acromill.py. Not to be edited by hand:
where the scanned text misleads the extractor, the test beside it says so."""

TABLE = "Parameter\tTypical Value\tDefault Value\tUnits\tDescription"
UNIT = re.compile(r"volts|second|Inch|Boolean|Sign|Float|NA|Integer|Degrees|Radians")
GAIN = re.compile(r"(PGAIN|IGAIN|IDELAY|ILIMIT|DWIDTH|DGAIN|FFVEL|FFACC|TLM)\s+(\d*\.?\d+)$")


@dataclass(frozen=True)
class Row:
    """A row of a table of parameters, as printed."""

    line: int
    table: int
    """Which of the tables, in the order of the guide, from 1."""
    name: str
    typical: str
    default: str
    unit: str


@dataclass(frozen=True)
class Gain:
    """A gain in one of the lists of appendix C."""

    line: int
    name: str
    value: str


def rows(lines: Sequence[str]) -> Iterator[Row]:
    """Yield the rows of every table; what else has tabs is a screen, whose cells are no units."""
    table = 0
    for number, line in enumerate(lines, 1):
        cells = [cut(cell) for cell in line.split("\t")]
        if line.strip() == TABLE:
            table += 1
        elif table and len(cells) > 4 and UNIT.match(cells[3]):
            yield Row(number, table, *cells[:4])


def gains(lines: Sequence[str]) -> Iterator[Gain]:
    """Yield the gains of the lists of appendix C, each list in the order of its lines."""
    for number, line in enumerate(lines, 1):
        if found := GAIN.match(line.strip()):
            yield Gain(number, found[1], found[2])


def written(found: dict[str, list[Row] | list[Gain]]) -> str:
    """Return the facts as YAML, one fact a line."""
    text = "".join(f"# {line}\n" for line in HEAD.splitlines())
    for kind, facts in found.items():
        text += f"\n{kind}:\n"
        for fact in facts:
            cells = ", ".join(
                f"{key}: {json.dumps(value, ensure_ascii=False)}" for key, value in asdict(fact).items()
            )
            text += f"- {{{cells}}}\n"
    return text


def main() -> int:
    """Write the facts of a guide; returns the exit code."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("manual", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True)
    options = parser.parse_args()
    lines = options.manual.read_text("utf-8").splitlines()
    found: dict[str, list[Row] | list[Gain]] = {"rows": list(rows(lines)), "gains": list(gains(lines))}
    options.output.write_text(written(found), "utf-8")
    print(f"{len(found['rows'])} rows, {len(found['gains'])} gains", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
