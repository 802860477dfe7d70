"""Which driver speaks to a control: named in the endpoint, registered by the family, or the house protocol."""

from __future__ import annotations

from amp_studio.schema.quoting import quoted
from amp_studio.schema.registration import load_part, registered_families, registration_of
from amp_studio.transfer.driver import ControlDriver, DriverFactory
from amp_studio.transfer.links.endpoint import Endpoint, parse_endpoint

GENERAL = {"house": "amp_studio.transfer.house.driver:HouseDriver.at"}
"""Protocols of every family: what emulated controls speak."""


def open_driver(endpoint: Endpoint | str, family: str = "") -> ControlDriver:
    """Return the driver for a control, which must be of ``family`` where one is given; connects to nothing yet.

    ``?protocol=NAME`` of the endpoint chooses; else it is the first protocol the family registers, and the house
    protocol where it registers none. Raises ValueError for text that is no endpoint and for an unknown protocol.
    """
    place = parse_endpoint(endpoint) if isinstance(endpoint, str) else endpoint
    offered = protocols_of(family)
    name = place.protocol or next(iter(offered))
    if name not in offered:
        of = f" of {family}" if family else ""
        raise ValueError(f"Unknown protocol {quoted(name)}{of}. Known: {', '.join(offered)}")
    factory: DriverFactory = load_part(offered[name])
    return factory(place, family)


def protocols_of(family: str) -> dict[str, str]:
    """Return protocol -> its driver, the usual one first; those of all families where none is named."""
    if family:
        return {**registration_of(family).drivers, **GENERAL}
    offered = dict(GENERAL)
    for each in registered_families():
        for name, place in registration_of(each).drivers.items():
            offered.setdefault(name, place)
    return offered
