"""The ways to a control of a family, as its facts list them, and what its code registers for each."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from amp_studio.schema import UnknownFamilyError, WayToControl, load_schema, registered_families

HOUSE = "house"
"""The protocol in which a gateway is spoken to."""
SCREEN = "screen"
"""The protocol in the address of the screen of an emulated control."""


def in_order_of_ways(family: str, own: Mapping[str, str], of_gateway: str) -> dict[str, str]:
    """Return protocol -> its part, the usual way first: those that a family registers,
    and ``of_gateway`` if it has one.
    """
    offered = {name: own.get(name, of_gateway) for name in _protocols(family) if name in own or name == HOUSE}
    return {**offered, **{name: place for name, place in own.items() if name not in offered}}


def folder_protocols() -> Iterator[str]:
    """Yield the protocols of all families whose controls read their parameters in a folder."""
    for family in registered_families():
        yield from (way.protocol for way in _ways(family) if way.way == "folder" and way.protocol)


def _protocols(family: str) -> Iterator[str]:
    """Yield the protocols of the ways that the facts of a family list; none for one that is code alone."""
    for each in _ways(family):
        if each.way != "sheet":
            yield each.protocol or HOUSE


def _ways(family: str) -> tuple[WayToControl, ...]:
    try:
        return load_schema(family).family.ways
    except UnknownFamilyError:
        return ()
