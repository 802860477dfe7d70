"""What the help has besides the arguments of a verb; in the man page too. Nothing here loads a schema:
help must come at once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from .candidates import families
from .registry import summaries
from .verb import Verb

PROGRAM = "amp-studio"
ABOUT = (
    "Edit, check, print and exchange the parameters of a machine control. Without a verb: the desktop"
    " program, on the files that are named."
)
EXIT_CODES = (
    "0  done, nothing wrong",
    "1  done; what was checked has errors, or the two sides differ",
    "2  the input cannot be used; nothing was changed",
    "3  something was changed before it failed; the message describes the present state",
    "4  it is not known whether the control changed; the message explains how to find out",
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
    (
        "=25.4/5000           an expression: 1340==25.4/5000, 1750='=Y*1.1' (the parameter on axis Y),"
        " 1350='=rapid@X*0.05'"
    ),
    "not-set              clears the value: 1300=not-set (an empty value is refused)",
    "Units: mm, in, deg, mm/min, ipm, deg/min, rpm, ms, s, %, V, Hz",
)
_ADDRESSES = (
    "tcp://HOST:PORT      a control in the network",
    "tls://HOST:PORT      the same over TLS: ?ca=FILE.pem or ?fingerprint=sha256:… checks its certificate",
    "/dev/ttyUSB0, COM3   serial:/dev/ttyUSB0?baud=9600&bits=7&parity=even&stop=2&flow=xonxoff",
    "rfc2217://HOST:PORT  a serial port of a device server, with the same options",
    "folder:PATH          a folder, or a file of it, that a control reads when it starts",
    "pty:                 (emulate only) make a terminal and print its name",
    "?protocol=NAME       how it is spoken to, where its family has several ways",
    "Passwords come from AMP_STUDIO_PASSWORD, the system's keyring, or a question at the terminal.",
)


def _scenarios() -> Sequence[str]:
    from amp_studio.scenarios import scenario_names

    return (", ".join(scenario_names()),)


def _formats() -> Sequence[str]:
    from amp_studio.family_places import own_formats

    # Names alone: the help of one verb must not load the formats of all families.
    formats = {"csv": "table of values, of every family (.csv)", **own_formats()}
    return tuple(f"{name:20} {what}" for name, what in formats.items())


SECTIONS: Mapping[str, Callable[[], Sequence[str]]] = {
    "families": lambda: (", ".join(families()),),
    "scenarios": _scenarios,
    "PARAM": lambda: _PARAMETERS,
    "VALUE": lambda: _VALUES,
    "FORMAT": _formats,
    "ADDRESS": lambda: _ADDRESSES,
}
"""Title -> its lines, of what several verbs take and their help explains."""


def sections(verb: Verb | None = None) -> Iterator[tuple[str, Sequence[str]]]:
    """Yield what comes below the help of a verb, or of the program: a title and its lines."""
    for title in verb.sections if verb else ("families",):
        yield title, SECTIONS[title]()
    if verb:
        yield "examples", verb.examples
    yield "exit codes", EXIT_CODES


def help_of(arguments: str, verb: Verb) -> str:
    """Return the help of a verb: its arguments, and what comes below them."""
    return _joined(arguments, sections(verb))


def program_help() -> str:
    """Return the help of the program: every verb in its group."""
    from textwrap import wrap

    groups = []
    for heading, verbs in summaries().items():
        lines = []
        for name, summary in verbs.items():
            first, *more = wrap(summary, 62)
            lines += [f"{name:14}{first}", *(f"{'':14}{line}" for line in more)]
        groups.append((heading, lines))
    usage = f"usage: {PROGRAM} [-h] [--version] VERB ..."
    options = ("-h, --help    show this help message and exit", "--version     show the version and exit")
    about = "\n".join(wrap(ABOUT, 78))
    return _joined(f"{usage}\n\n{about}", [*groups, ("options", options), *sections()])


def _joined(text: str, below: Iterable[tuple[str, Sequence[str]]]) -> str:
    parts = (f"{title}:\n" + "\n".join(f"  {line}" for line in lines) for title, lines in below)
    return "\n\n".join([text.rstrip(), *parts]) + "\n"
