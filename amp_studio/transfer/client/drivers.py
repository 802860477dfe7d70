"""Which driver speaks to a control: named in the endpoint, registered by the family, or the house
protocol.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from amp_studio.schema import load_part, load_schema, quoted, registered_families, registration_of
from amp_studio.transfer.driver import ControlDriver, DriverFactory, Recognised
from amp_studio.transfer.errors import NoConnectionError
from amp_studio.transfer.exchange import QUIET, Exchange
from amp_studio.transfer.links import (
    Endpoint,
    EndpointError,
    Link,
    LinkError,
    PasswordError,
    connect,
    parse_endpoint,
)
from amp_studio.transfer.waiting import Waiting
from amp_studio.transfer.ways import HOUSE, folder_protocols, in_order_of_ways

RECOGNISED, RECOGNISED_SERIAL = 0.3, 2.5
"""Seconds in which a control may answer by which it is known;
one on a serial line may restart when it is opened."""
ASK_AGAIN = 0.15  # seconds
LONGEST_GREETING = 4_096  # bytes

GATEWAY = {HOUSE: "amp_studio.transfer.house.driver:HouseDriver.at"}
"""The protocol of gateways, and of the emulated controls
of families whose controls themselves cannot be spoken to."""


def open_driver(endpoint: Endpoint | str, family: str = "") -> ControlDriver:
    """Return the driver for a control, which must be of ``family`` where one is given;
    connects to nothing yet.

    ``?protocol=NAME`` of the endpoint chooses; else it is the first way to its controls that the family's
    facts list. Raises EndpointError for text that is no endpoint, for an unknown protocol,
    and for a family to whose controls no way is known.
    """
    place = parse_endpoint(endpoint) if isinstance(endpoint, str) else endpoint
    offered = protocols_of(family)
    if not offered:
        error = EndpointError(f"{load_schema(family).family.by_hand}: print a sheet of what to key in")
        error.is_keyed_in = True
        raise error
    name = place.protocol or next(iter(offered))
    if place.kind == "folder":
        name = next((each for each in folder_protocols() if each in offered), "")
        if not name:
            raise EndpointError(
                f"no control of {family} reads its parameters in a folder: {quoted(str(place))}"
            )
    if name not in offered:
        of = f" of {family}" if family else ""
        raise EndpointError(f"Unknown protocol {quoted(name)}{of}. Known: {', '.join(offered)}")
    factory: DriverFactory = load_part(offered[name])
    return factory(place, family)


def open_driver_at(address: str, family: str = "", exchange: Exchange = QUIET) -> ControlDriver:
    """Return the driver for a control, whose protocol is found out where neither it nor a family is named.

    Only what does nothing to any machine is sent for that: the frames of the house protocol may contain what
    a Grbl takes for a feed hold or a reset. Raises as ``open_driver``, CancelledError, and NoConnectionError
    where its password is not known; any other control that cannot be reached is left to the driver.
    """
    place = parse_endpoint(address)
    if not family and not place.protocol and place.kind != "folder":
        try:
            place = replace(place, protocol=_recognise(place, exchange))
        except PasswordError as error:  # tried again it would be one more wrong guess
            raise NoConnectionError(f"no connection to the control ({error})", "") from error
        except LinkError:
            pass
    return open_driver(place, family)


def who_answers(address: str, exchange: Exchange = QUIET) -> str:
    """Return the protocol of what answers at an address, if it is known by its answer, else "". Only what
    does nothing to any machine is sent. Raises EndpointError, CancelledError.
    """
    try:
        return _recognise(parse_endpoint(address), exchange)
    except LinkError:
        return ""


def _recognise(place: Endpoint, exchange: Exchange) -> str:
    """Return the protocol of a control that is known by its answer; "" for any other. Raises LinkError,
    CancelledError.
    """
    places = (registration_of(family).recognised for family in registered_families())
    known: list[Recognised] = [load_part(part) for part in places if part]
    waiting = Waiting()
    waiting.begin(exchange)
    link = connect(place, look=waiting.look)
    try:
        seconds = RECOGNISED_SERIAL if place.kind == "serial" else RECOGNISED
        return _answered_protocol(link, waiting, known, waiting.now() + seconds)
    finally:
        link.close()


def _answered_protocol(link: Link, waiting: Waiting, known: Sequence[Recognised], end: float) -> str:
    """Return the protocol whose question is answered on a line until a moment; "" where none is."""
    received = b""
    while (left := end - waiting.now()) > 0 and len(received) < LONGEST_GREETING:
        waiting.look()
        if not received or received.endswith(b"\n"):
            for each in known:
                link.write(each.question)
        received += link.read(min(left, ASK_AGAIN))
        for each in known:
            if each.answer.search(received):
                return each.protocol
    return ""


def protocols_of(family: str) -> dict[str, str]:
    """Return protocol -> its driver, the usual one first; those of all families where none is named.

    A family whose facts list no way to its controls has those that it registers, and no gateway.
    """
    if not family:
        return {
            **GATEWAY,
            **{n: p for f in registered_families() for n, p in registration_of(f).drivers.items()},
        }
    return in_order_of_ways(family, registration_of(family).drivers, GATEWAY[HOUSE])
