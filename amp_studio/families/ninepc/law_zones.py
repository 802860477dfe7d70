"""Programmable zones 2 and 3 of a 9/PC over the axes of a group (6-3 to 6-9)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Literal

from amp_studio.sim import BoundMachine, Zone

from .law_facts import ids

ON = {"g22": ("2", "3"), "g22.1": ("3",), "g23": (), "g23.1": ("2",)}
"""G code at power-up (524) -> zones that are on (16-16)."""
_GROUPS = ("g1", "g2", "g3")
NOTE = (
    "Zones count for the place of the axes alone: length and radius of the tool do not count (6-1). ASSUMED:"
    " the axes stop as at an overtravel; no stop is printed."
)
_THIRD = "Zone 3 keeps the axes inside if they are in it when it is switched on, else outside (6-2)."


_KINDS: Mapping[str, tuple[Literal["outside", "by start"], tuple[str, ...]]] = {
    "2": ("outside", (NOTE,)),
    "3": ("by start", (NOTE, _THIRD)),
}
"""Programmable zone -> on which side of it axes may be, and notes."""


def zones(machine: BoundMachine, axes: Sequence[str]) -> Iterator[Zone]:
    """Yield the zones of every group that these axes are in;
    an axis of no group is open to its overtravels (6-4).
    """
    read = machine.parameters
    count = read.optional(ids.group_count, everywhere=True)
    on = ON.get(str(read.value(ids.powerup_zones, everywhere=True) or ""), ())
    for n, group in enumerate(_GROUPS, 1):
        if count is not None and n > int(count):
            return  # 0 switches the zones off (6-6)
        members = [axis for axis in machine.fitted if machine.read(axis).value(ids.zone_group) == group]
        if not any(axis in axes for axis in members):
            continue
        for zone in _KINDS:
            if sides := _sides(machine, zone, members):
                side, notes = _KINDS[zone]
                yield Zone(
                    f"programmable zone {zone}, group {n}",
                    sides,
                    side,
                    is_on=zone in on,
                    code=f"ZONE {zone}",
                    page="6-3 to 6-9",
                    notes=notes,
                )


def _sides(machine: BoundMachine, zone: str, axes: Sequence[str]) -> dict[str, tuple[float, float]]:
    """Return axis -> limits of a zone, of the axes that have both."""
    sides = {}
    for axis in axes:
        read = machine.read(axis)
        low, high = (read.optional(ids[f"zone_limit{zone}_{side}"]) for side in ("min", "max"))
        # Equal or crossed limits enclose nothing, so that there is no zone.
        if low is not None and high is not None and low < high:
            sides[axis] = (low, high)
    return sides
