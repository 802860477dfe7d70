"""What comes below the help of a verb, in the man page too.

Nothing here loads a schema: help must come at once.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

from amp_studio.family_places import installed_places, own_formats
from amp_studio.scenarios import scenario_names

from .examples import EXAMPLES

EXIT_CODES = (
    "0  done, nothing wrong",
    "1  done; what was checked has errors, or the two sides differ",
    "2  the input cannot be used; nothing was changed",
    "3  something was changed before it failed; the message describes the present state",
    "4  it is not known whether the control changed; the message explains how to find out",
)
_FAMILY = ("schema", "show", "tables", "find", "calculate", "new", "guide", "form", "import", "emulate")
_PARAM = ("show", "set", "get", "note", "guide", "fix", "merge", "sheet", "simulate")
_ADDRESS = (
    "diff",
    "sheet",
    "emulate",
    "identify",
    "download",
    "verify",
    "upload",
    "restore",
    "send",
    "receive",
)
_PARAMETERS = (
    "1300                 the number in the manual",
    "home.calibration@X   id and axis, by letter or number",
    "P3N0.5               one bit of a packed word",
    "P21                  every word of a number (get, show)",
)
_VALUES = (
    "12.5, '10 ipm'       a number, in the unit of entry or with its unit",
    "yes, no              yes/no, or the label or letter of a choice (a)",
    "raw:-1               what the control stores",
    "0x05                 a mask; by the labels of its bits: 'Axis 1, Axis 5'; bit by bit: P3N0.5=yes",
    "=25.4/5000           an expression: 1340==25.4/5000, 1750='=Y*1.1' (the parameter on axis Y), 1350='=rapid@X*0.05'",
    "not-set              clears the value: 1300=not-set (an empty value is refused)",
    "Units: mm, in, deg, mm/min, ipm, deg/min, rpm, ms, s, %, V, Hz",
)
_ADDRESSES = (
    "tcp://HOST:PORT      a control in the network",
    "tls://HOST:PORT      the same over TLS: ?ca=FILE.pem or ?fingerprint=sha256:… checks its certificate",
    "/dev/ttyUSB0, COM3   serial:/dev/ttyUSB0?baud=9600&bits=7&parity=even&stop=2&flow=xonxoff",
    "rfc2217://HOST:PORT  a serial port of a device server, with the same options",
    "pty:                 (emulate only) make a terminal and print its name",
    "?protocol=NAME       how it is spoken to, where its family has several ways",
    "Passwords come from AMP_STUDIO_PASSWORD, the system's keyring, or a question at the terminal.",
)


def families() -> tuple[str, ...]:
    """Return the families, as ``family_ids`` of the schema does, without loading it."""
    package = Path(__file__).resolve().parent.parent
    folders = (package / "parameter_db", package.parent / "parameter_db")
    own = {p.parent.name for folder in folders for p in folder.glob("*/family.yaml")} | set(
        installed_places()
    )
    registration = sys.modules.get("amp_studio.schema.registration")  # who registers a family has loaded it
    return tuple(sorted(own | set(registration.added_facts() if registration else ())))


def example_names() -> tuple[str, ...]:
    """Return the folders of the example machines, without reading them."""
    package = Path(__file__).resolve().parent.parent
    folders = (package / "examples", package.parent / "examples")
    return tuple(sorted({p.parent.name for folder in folders for p in folder.glob("*/*.amp")}))


def sections(verb: str) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Yield what comes below the help of a verb, or of the program (""): a title and its lines."""
    if verb in ("", *_FAMILY):
        yield "families", (", ".join(families()),)
    if verb == "simulate":
        yield "scenarios", (", ".join(scenario_names()),)
    if verb in _PARAM:
        yield "PARAM", _PARAMETERS
    if verb in ("set", "simulate"):
        yield "VALUE", _VALUES
    if verb in ("import", "export"):
        formats = {"csv": "table of values, of every family (.csv)", **own_formats()}
        yield "FORMAT", tuple(f"{name:20} {what}" for name, what in formats.items())
    if verb in _ADDRESS:
        yield "ADDRESS", _ADDRESSES
    if verb in EXAMPLES:
        yield "examples", EXAMPLES[verb]
    yield "exit codes", EXIT_CODES
