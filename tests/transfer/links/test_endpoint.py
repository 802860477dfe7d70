"""An address is written in one of three forms, and what is wrong with another is said in one sentence."""

from __future__ import annotations

import pytest

from amp_studio.transfer.links.endpoint import Endpoint, parse_endpoint


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("tcp://127.0.0.1:7090", Endpoint("tcp", host="127.0.0.1", port=7090)),
        ("tcp://cnc-1.works.local:0", Endpoint("tcp", host="cnc-1.works.local", port=0)),
        ("tcp://[::1]:7090", Endpoint("tcp", host="::1", port=7090)),
        ("serial:/dev/ttyUSB0", Endpoint("serial", device="/dev/ttyUSB0", baud=115_200)),
        ("serial:/dev/ttyUSB0?baud=9600", Endpoint("serial", device="/dev/ttyUSB0", baud=9600)),
        ("serial:COM3", Endpoint("serial", device="COM3")),
        ("com12", Endpoint("serial", device="COM12")),
        (" pty: ", Endpoint("pty")),
        ("tcp://cnc:7090?protocol=house", Endpoint("tcp", host="cnc", port=7090, protocol="house")),
        (
            "/dev/ttyS0?protocol=house&baud=9600",
            Endpoint("serial", device="/dev/ttyS0", baud=9600, protocol="house"),
        ),
    ],
)
def test_the_forms_of_an_address(text: str, expected: Endpoint) -> None:
    assert parse_endpoint(text) == expected
    assert parse_endpoint(str(expected)) == expected, "what is printed can be read again"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "no address"),
        ("machine.amp", "no address"),
        ("tcp://host", "tcp://host:port"),
        ("tcp://host:99999", "65535"),
        ("tcp://:7090", "tcp://host:port"),
        ("tcp://host:70x", "tcp://host:port"),
        ("tcp://ho st:7090", "tcp://host:port"),
        ("serial:", "names no port"),
        ("serial:/dev/ttyS0\n?", "names no port"),
        ("serial: COM3?", "names no port"),
        ("serial:?baud=9600", "names no port"),
        ("serial:/dev/ttyS0?baud=fast", "rate 'fast'"),
        ("serial:/dev/ttyS0?baud=0", "rate '0'"),
        ("serial:/dev/ttyS0?parity=even", "only 'baud' and 'protocol'"),
        ("serial:/dev/ttyS0?baud=9600&baud=300", "sets 'baud' twice"),
        ("tcp://host:70?speed=9600", "only 'protocol'"),
        ("tcp://host:70?protocol=", "names no protocol"),
        ("tcp://host:70?protocol=../x", "names no protocol"),
        ("pty:/dev/pts/3", "no address"),
        ("udp://host:1", "no address"),
        ("x" * 5000, "…' is no address"),
        ("tcp://host:70\n?protocol=\x1b[2J", r"\n?protocol=\u001b[2J"),
    ],
)
def test_what_is_no_address_is_refused_in_one_sentence(text: str, said: str) -> None:
    with pytest.raises(ValueError, match=r".") as caught:
        parse_endpoint(text)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 200
