"""Damaged control images, as many as are wanted, the same for the same seed."""

import random
from collections.abc import Iterator
from pathlib import Path

from amp_studio.files import content_of
from amp_studio.files.reading import read_content
from amp_studio.transfer.image import ImageError, decode_image, encode_image

FIELDS = (
    "",
    "0",
    "-0",
    "0 mm",
    "0.0 mm",
    "1 in",
    "1e300",
    "1e999",
    "-1e999",
    "nan",
    "inf",
    "-inf mm",
    "1e-400 mm",
    "5e-324 mm",
    "9007199254740993",
    "1" * 400,
    "0x10",
    "$10",
    "1,5 mm",
    "1'000 mm",
    "٣ mm",
    "1 mm ",
    " 1 mm",
    "1 furlong",
    "1 deg",
    "1 Hz",
    "100 %",
    "true",
    "yes",
    "True",
    "no",
    "raw:",
    "raw:1",
    "raw:-1",
    "raw:01",
    "raw:+1",
    "raw:1 ",
    "raw:1.5",
    "raw:" + "9" * 5000,
    "raw:²",
    "text:",
    "text:X",
    "text:a\\",
    "text:\\q",
    "text:\\x41",
    "text:\\x1b",
    "text:\x1b[2J",
    "text:=1+1",
    "text: blank ",
    "text:'",
    "text:a: b # c",
    "text:\u2028",
    "text:\ufeff",
    "text:" + "a" * 3000,
    "3.4",
    "text:3.4",
    "text:03.4",
    "text:999.4",
    "a\tb",
    "\x00",
    "...",
    "---",
    "!!int 5",
    "*a",
    "&a b",
    "{",
    "[",
)
ENTRIES = (
    "",
    "@",
    "@1",
    "no.such",
    "../../etc",
    "home.calibration",
    "home.calibration@",
    "home.calibration@99",
    "home.calibration@1@1",
    "control.type@1",
    "x" * 3000,
)
HEADS = (
    "",
    "junk",
    "../../../tmp/x",
    "/etc/passwd",
    "9pc",
    "num",
    "syntec",
    "lathe",
    "mill",
    "a\\",
    "a\\nb",
    "\\x1b",
    "a'b",
    "x: y",
    "- a",
    "null",
    " blank ",
    "0",
    "1e5",
    "yes",
    "#",
    "\u2028",
    "é" * 300,
)


def mutants(image: bytes, seed: int, count: int) -> Iterator[bytes]:
    """Yield ``count`` images that were damaged once or a few times: in a field, a line, a byte."""
    chance = random.Random(seed)
    for _ in range(count):
        damaged = image
        for _ in range(chance.choice((1, 1, 1, 2, 3))):
            damaged = chance.choice((_field, _field, _entry, _head, _lines, _bytes))(damaged, chance)
        yield damaged


def fault_of(image: bytes) -> str:
    """Return why an image is refused, "" where it is taken; raises whatever else goes wrong,
    AssertionError too.

    One that is taken comes back byte for byte, and so it does by way of a file on disk.
    """
    try:
        file = decode_image(image)
    except ImageError as error:
        message = str(error)
        assert message.replace("\u2028", "").replace("\ufeff", "").isprintable(), repr(message)
        assert len(message) < 700, message
        return message
    assert encode_image(file) == image
    again = read_content(Path("x.amp"), content_of(file))
    assert again.values == file.values
    assert encode_image(again) == image
    return ""


def _field(image: bytes, chance: random.Random) -> bytes:
    return _part(image, chance, 2, chance.choice(FIELDS))


def _entry(image: bytes, chance: random.Random) -> bytes:
    return _part(image, chance, chance.choice((0, 1)), chance.choice(ENTRIES))


def _part(image: bytes, chance: random.Random, part: int, text: str) -> bytes:
    """Put a text in the place of a part of a record, or of a piece of it."""
    lines = image.split(b"\n")
    at = chance.randrange(len(lines))
    parts = lines[at].split(b"\t")
    if len(parts) != 3:
        return image
    old = parts[part]
    cut = chance.choice((0, 0, chance.randint(0, len(old))))
    parts[part] = old[:cut] + text.encode()
    lines[at] = b"\t".join(parts)
    return b"\n".join(lines)


def _head(image: bytes, chance: random.Random) -> bytes:
    lines = image.split(b"\n")
    at = chance.randrange(min(6, len(lines)))
    key = lines[at].partition(b" ")[0]
    lines[at] = key + chance.choice((b" ", b" ", b"")) + chance.choice(HEADS).encode()
    return b"\n".join(lines)


def _lines(image: bytes, chance: random.Random) -> bytes:
    """Drop, double, swap or shorten lines; half of the time the last one counts them rightly anyway."""
    lines = image.split(b"\n")
    at, other = chance.randrange(len(lines)), chance.randrange(len(lines))
    match chance.randrange(4):
        case 0:
            del lines[at]
        case 1:
            lines.insert(at, lines[other])
        case 2:
            lines[at], lines[other] = lines[other], lines[at]
        case _:
            lines = lines[:at]
    if chance.random() < 0.5 and len(lines) >= 8:
        lines[-2:] = [b"end %d" % (len(lines) - 8), b""]
    return b"\n".join(lines)


def _bytes(image: bytes, chance: random.Random) -> bytes:
    at = chance.randint(0, len(image))
    length = chance.choice((0, 1, 1, 2, 30))
    junk = chance.choice(
        (chance.randbytes(length), b"\t", b"\n", b"\\", b" ", b"\r", b"", b"\xef\xbb\xbf", b"0", b"-")
    )
    return image[:at] + junk + image[at + length :]
