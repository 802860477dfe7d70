"""An address is written in one of three forms, and what is wrong with another is reported in one sentence."""

import tempfile
from pathlib import Path

import pytest

from amp_studio.transfer.client.drivers import open_driver
from amp_studio.transfer.links.endpoint import Endpoint, is_endpoint, parse_endpoint
from amp_studio.transfer.links.serial_settings import SerialSettings


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("tcp://127.0.0.1:7090", Endpoint("tcp", host="127.0.0.1", port=7090)),
        ("tcp://cnc-1.works.local:0", Endpoint("tcp", host="cnc-1.works.local", port=0)),
        ("tcp://[::1]:7090", Endpoint("tcp", host="::1", port=7090)),
        ("serial:/dev/ttyUSB0", Endpoint("serial", device="/dev/ttyUSB0")),
        ("serial:/dev/ttyUSB0?baud=9600", Endpoint("serial", device="/dev/ttyUSB0", baud=9600)),
        ("serial:COM3", Endpoint("serial", device="COM3")),
        ("com12", Endpoint("serial", device="COM12")),
        ("com3?baud=300", Endpoint("serial", device="COM3", baud=300)),
        (
            "serial:/dev/ttyUSB0?baud=9600&bits=7&parity=even&stop=2&flow=xonxoff",
            Endpoint(
                "serial", device="/dev/ttyUSB0", baud=9600, bits=7, parity="even", stop=2, flow="xonxoff"
            ),
        ),
        (
            "/dev/ttyS1?flow=RTSCTS&parity=None",
            Endpoint("serial", device="/dev/ttyS1", flow="rtscts", parity="none"),
        ),
        (
            "rfc2217://192.168.0.9:2217?baud=4800&bits=8",
            Endpoint("rfc2217", host="192.168.0.9", port=2217, baud=4800, bits=8),
        ),
        (
            "tls://cnc:7091?ca=/etc/plant ca.pem",
            Endpoint("tls", host="cnc", port=7091, ca="/etc/plant ca.pem"),
        ),
        (
            "tls://cnc:7091?fingerprint=sha256:" + "AB:" * 31 + "CD",
            Endpoint("tls", host="cnc", port=7091, fingerprint="ab" * 31 + "cd"),
        ),
        ("tls://cnc:1?ca=/etc/a+b%26c.pem", Endpoint("tls", host="cnc", port=1, ca="/etc/a+b&c.pem")),
        (" pty: ", Endpoint("pty")),
        ("pty:?protocol=num", Endpoint("pty", protocol="num")),
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
    ("text", "message"),
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
        ("serial:/dev/ttyS0?speed=9600", "only 'baud', 'bits', 'parity', 'stop', 'flow' and 'protocol'"),
        ("serial:/dev/ttyS0?parity=evn", "sets parity='evn': write parity=none or parity=even or"),
        ("serial:/dev/ttyS0?bits=9", "sets bits='9': write bits=7 or bits=8"),
        ("serial:/dev/ttyS0?stop=0", "write stop=1 or stop=2"),
        ("serial:/dev/ttyS0?flow=dtr", "write flow=none or flow=xonxoff or flow=rtscts"),
        ("serial:loop://", "names no port"),
        ("rfc2217://host", "rfc2217://host:port"),
        ("rfc2217://host:99999", "65535"),
        ("tls://host:7091?fingerprint=12", "64 hexadecimal digits"),
        ("tls://host:7091?ca=", "names no file of certificates"),
        ("loop://", "no address"),
        ("spy:///dev/ttyS0", "no address"),
        ("serial:/dev/ttyS0?baud=9600&baud=300", "sets 'baud' twice"),
        ("tcp://host:70?speed=9600", "only 'protocol'"),
        ("tcp://host:70?protocol=", "names no protocol"),
        ("tcp://host:70?protocol=../x", "names no protocol"),
        ("pty:/dev/pts/3", "no address"),
        ("udp://host:1", "no address"),
        ("x" * 5000, "is no address"),
        ("tcp://host:70\n?protocol=\x1b[2J", r"\n?protocol=\u001b[2J"),
    ],
)
def test_what_is_no_address_is_refused_in_one_sentence(text: str, message: str) -> None:
    with pytest.raises(ValueError, match=r".") as caught:
        parse_endpoint(text)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 300


def test_what_a_user_leaves_open_is_set_by_whoever_speaks_on_the_line() -> None:
    table = SerialSettings(baud=9600, bits=7, parity="even", flow="xonxoff")
    assert parse_endpoint("/dev/ttyS0").serial_settings() == SerialSettings(115_200, 8, "none", 1, "none")
    assert parse_endpoint("/dev/ttyS0").with_usual(table).serial_settings() == table
    given = parse_endpoint("/dev/ttyS0?parity=none&stop=2").with_usual(table).serial_settings()
    assert given == SerialSettings(9600, 7, "none", 2, "xonxoff")
    assert table.bytes_per_second == 960, "a start bit, seven data bits, the parity bit, a stop bit"


@pytest.mark.parametrize("options", ["bits=7", "flow=xonxoff"])
def test_a_line_that_does_not_pass_every_byte_is_refused_before_it_is_opened(options: str) -> None:
    with pytest.raises(ValueError, match="the house protocol needs 8 data bits and no XON/XOFF"):
        open_driver(f"serial:/dev/no-such-port?{options}")


@pytest.mark.skipif(not Path("/dev/shm").is_dir(), reason="a disk in memory below /dev is one of Linux")
def test_a_file_below_dev_is_a_file_and_no_control() -> None:
    with tempfile.NamedTemporaryFile(dir="/dev/shm", suffix=".amp") as file:
        assert not is_endpoint(file.name)
        with pytest.raises(ValueError, match="is no address of a control"):
            parse_endpoint(file.name)
    assert is_endpoint(file.name), "a device may be plugged in later"
    assert is_endpoint("/dev/ttyUSB0?baud=9600")
