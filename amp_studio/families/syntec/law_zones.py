"""The second and third software stroke limits of a Syntec control (3.2)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from amp_studio.sim import BoundMachine, Zone

from .law_facts import ids

BLU = 0.001
"""mm or deg (1.2.6)."""
_READ_AHEAD = "COR-040"
NOTE = (
    "A pair counts in either order; equal values switch the axis off (3.2). ASSUMED: the command stops at"
    " once; the slides print the alarms alone."
)
_TIERS = (("2", "second", "MOT-044", "MOT-037", "MOT-038"), ("3", "third", "MOT-045", "MOT-041", "MOT-042"))
"""Number, name of the parameters, code of going in, of leaving at the plus and the minus side."""


def _sides(machine: BoundMachine, name: str) -> Iterator[tuple[str, tuple[float, float]]]:
    """Yield each axis that an area bounds, with its two sides in u; equal ones bound nothing."""
    for axis in machine.fitted:
        own = machine.read(axis)
        first, second = (own.optional(ids[f"limit_{name}_{side}"]) for side in ("negative", "positive"))
        if first is not None and second is not None and first != second:
            yield axis, (min(first, second) * BLU, max(first, second) * BLU)


def zones(machine: BoundMachine, _axes: Sequence[str]) -> Iterator[Zone]:
    """Yield both areas; the second is on by Pr3838, the third by C83 of the PLC."""
    read = machine.parameters
    for number, name, enters, plus, minus in _TIERS:
        sides = dict(_sides(machine, name))
        if not sides:
            continue
        # The scope names the side that is forbidden; a zone names the side on which the axis may be.
        keeps_in = read.value(ids[f"limit_{name}_scope"], everywhere=True) == "outside"
        yield Zone(
            f"software stroke limit {number}",
            sides,
            "inside" if keeps_in else "outside",
            is_on=number == "2" and read.value(ids.second_at_start, everywhere=True) in (True, "yes"),
            code=plus if keeps_in else enters,
            code_plus=plus,
            code_minus=minus,
            page="3.2",
            notes=(NOTE,),
            reads_ahead=_READ_AHEAD,
        )
