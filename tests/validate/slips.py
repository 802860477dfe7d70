"""A campaign against the findings: slips of one value,
planted one at a time into the sound examples of every family.

``campaign(share, seed)`` counts what share of them brings a new finding; ``make slips`` plants every slip and
prints the table, ``test_slips.py`` a few of them. A slip is what a hand or a unit does to one value; no slip
is drawn that the file could not hold (a half of an odd number of a parameter without fractions is rounded).
"""

import argparse
import re
from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from random import Random

from amp_studio.files import ParameterFile, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.schema import Address, Value, show_value, written
from amp_studio.schema.units import dimension
from amp_studio.validate import Earlier, Validator
from amp_studio.validate.findings_between import new_findings

FACTORS = {"x 10": 10.0, "/ 10": 0.1, "x 25.4": 25.4, "sign": -1.0, "zero": 0.0, "x 2": 2.0}
"""What a hand or a unit does to a number."""
OTHER_FACTORS = {
    "x 100": 100.0,
    "/ 25.4": 1 / 25.4,
    "x 60": 60.0,
    "/ 60": 1 / 60,
    "x 1000": 1e3,
    "/ 1000": 1e-3,
    "x 5": 5.0,
}
"""Of which no fact was chosen with an eye on the campaign: they judge the facts."""
KINDS = ("x 10", "/ 10", "x 25.4", "sign", "zero", "x 2", "swapped", "neighbour", "bit", "choice")
NEIGHBOURS = re.compile(r"(\d)(?=(\.?)(\d))")
"""Two neighbouring digits, a point between them or not."""


@dataclass(frozen=True)
class Slip:
    """One value that went wrong."""

    kind: str
    address: Address
    value: Value


def slips(file: ParameterFile, random: Random, factors: Mapping[str, float] = FACTORS) -> Iterator[Slip]:
    """Yield every slip of a file, in the manual's order:
    of each active value one of every kind that it can have.
    """
    active = [a for a in file.addresses() if a in file.values and file.evaluation.state(a).is_active]
    for at, address in enumerate(active):
        parameter, value = file.schema.parameters[address[0]], file.values[address]
        if parameter.type in ("integer", "real") and isinstance(value.value, int | float):
            for kind, raw in _numbers(value.value, factors):
                number = round(raw) if parameter.type == "integer" else raw
                if number != value.value:
                    yield Slip(kind, address, Value(number, value.unit))
            neighbour = _neighbour(file, active, at)
            if neighbour is not None:
                yield Slip("neighbour", address, neighbour)
        elif parameter.type == "bits" and isinstance(value.value, int):
            bits = [bit.bit for bit in parameter.bits or ()] or list(range(8))
            yield Slip("bit", address, Value(value.value ^ (1 << random.choice(bits)), value.unit))
        elif parameter.choices:
            is_yes_no = parameter.type == "boolean"
            others = [c.key == "yes" if is_yes_no else c.key for c in parameter.choices]
            others = [key for key in others if key != value.value]
            if others:
                yield Slip("choice", address, Value(random.choice(others)))


def _numbers(number: int | float, factors: Mapping[str, float]) -> Iterator[tuple[str, int | float]]:
    """Yield what becomes of a number, rounded as a person would write it."""
    if number == 0:
        return
    for kind, factor in factors.items():
        yield kind, float(f"{number * factor:.12g}")
    text = repr(number)
    for found in NEIGHBOURS.finditer(text) if "e" not in text else ():
        first, point, second = found.groups()
        begins = not text[: found.start()].strip("-")
        if first != second and not (begins and second == "0" and not point):  # nobody writes 0200 for 2000
            yield (
                "swapped",
                type(number)(text[: found.start()] + second + point + first + text[found.end(3) :]),
            )
            return


def _neighbour(file: ParameterFile, active: list[Address], at: int) -> Value | None:
    """Return the value of the nearest parameter that measures the same and has another value:
    a wrong row was read.
    """
    address = active[at]
    own, kind = file.values[address], file.schema.parameters[address[0]].type
    near = sorted(range(max(0, at - 12), min(len(active), at + 13)), key=lambda n: (abs(n - at), -n))
    for other in (active[n] for n in near):
        found = file.values[other]
        alike = dimension(found.unit) == dimension(own.unit) and file.schema.parameters[other[0]].type == kind
        if alike and found.value != own.value:
            return found
    return None


@dataclass
class Count:
    """How many slips were planted, and how many brought a finding."""

    planted: int = 0
    found: int = 0

    @property
    def share(self) -> float:
        """The part that was found."""
        return self.found / self.planted if self.planted else 0.0

    def __str__(self) -> str:
        return f"{self.found:5}/{self.planted:<5}{100 * self.share:3.0f} %"


@dataclass
class Campaign:
    """What came of the slips of some machines: counts by family and kind,
    and the slips that nothing was found of.
    """

    counts: dict[tuple[str, str], Count]
    missed: list[tuple[str, Slip]]

    def total(self, family: str | None = None, kind: str | None = None) -> Count:
        """Return the sum over what is not named."""
        some = [c for (f, k), c in self.counts.items() if family in (None, f) and kind in (None, k)]
        return Count(sum(c.planted for c in some), sum(c.found for c in some))


def examples() -> list[Path]:
    """Return the sound examples."""
    return sorted(examples_folder().glob("*/*.amp"))


def campaign(
    share: float = 1.0, seed: int = 1, *, alone: bool = False, factors: Mapping[str, float] = FACTORS
) -> Campaign:
    """Plant a share of all slips; the same ones for a seed. ``alone``:
    nothing is known of what a file was before.
    """
    done = Campaign(defaultdict(Count), [])
    for path in examples():
        plant(open_file(path).file, share, Random(seed), done, alone=alone, factors=factors)
    return done


def plant(
    file: ParameterFile,
    share: float,
    random: Random,
    done: Campaign,
    *,
    alone: bool,
    factors: Mapping[str, float] = FACTORS,
) -> None:
    """Plant a share of the slips of one machine, and count."""
    validator = Validator(file, earlier=() if alone else (Earlier("in the backup", dict(file.values)),))
    before, family = validator.run(), file.schema.family.family
    for slip in list(slips(file, random, factors)):
        if random.random() >= share:
            continue
        old = file.values[slip.address]
        file.set(slip.address, slip.value)
        found = new_findings(before, validator.update([slip.address]))
        file.set(slip.address, old)
        validator.recheck([slip.address])
        count = done.counts[family, slip.kind]
        count.planted += 1
        count.found += bool(found)
        if not found:
            done.missed.append((file.header.name, slip))


def table(done: Campaign) -> str:
    """Return the counts, a line a kind and a column a family."""
    families = sorted({family for family, _ in done.counts})
    lines = [f"{'':12}" + "".join(f"{name:>17}" for name in (*families, "all"))]
    kinds = dict.fromkeys((*KINDS, *(kind for _, kind in done.counts)))
    for kind in (*(kind for kind in kinds if done.total(kind=kind).planted), None):
        cells = [str(done.total(family, kind)) for family in (*families, None)]
        lines.append(f"{kind or 'all':12}" + "".join(f"{cell:>17}" for cell in cells))
    return "\n".join(lines)


def main() -> None:
    """Print the table, and on request what was not found."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--share", type=float, default=1.0, help="of all slips")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--alone", action="store_true", help="a file of which no backup is known")
    parser.add_argument("--others", action="store_true", help="other factors than the facts were chosen by")
    parser.add_argument("--missed", action="store_true", help="list the slips that bring no finding")
    options = parser.parse_args()
    factors = OTHER_FACTORS if options.others else FACTORS
    done = campaign(options.share, options.seed, alone=options.alone, factors=factors)
    print(table(done))
    if options.missed:
        files = {open_file(path).file.header.name: open_file(path).file for path in examples()}
        for name, slip in done.missed:
            file, parameter = files[name], files[name].schema.parameters[slip.address[0]]
            old = show_value(parameter, file.values[slip.address])
            print(f"{name} {slip.kind}: {written(slip.address)} {old} -> {show_value(parameter, slip.value)}")


if __name__ == "__main__":
    main()
