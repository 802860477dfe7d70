"""The words of severities and states, counts as a person reads them, and texts as paper takes them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from amp_studio.validate import SEVERITIES, Finding

NO_BREAK = "\u00a0"
_SEVERITIES = {"advice": "recommendation", "suppressed": "suppressed finding"}
_STATES = {"in-force": "active", "ignored": "ignored", "unusable": "not available", "hidden": "hidden"}


def severity_name(severity: str) -> str:
    """Return the name of a severity: ``error``, ``warning``, ``recommendation``."""
    return _SEVERITIES.get(severity, severity)


def state_name(state: str) -> str:
    """Return the name of a parameter's state: ``active``, ``ignored``, ``not available``, ``hidden``."""
    return _STATES.get(state, state)


def counted(number: int, noun: str, none: str = "0") -> str:
    """Return ``1 error``, ``2 errors``, ``3 recommendations``; ``none`` replaces the number 0."""
    return f"{number or none} {severity_name(noun)}{'' if number == 1 else 's'}"


def delivered_text(findings: Sequence[Finding], steps: Sequence[int]) -> str:
    """Return what is as delivered, and in which steps it is set: ``as delivered, to be set in step 3 of
    commissioning: 6 errors``; "" for nothing.
    """
    counts = [(s, sum(f.severity == s for f in findings)) for s in SEVERITIES]
    text = ", ".join(counted(count, severity) for severity, count in counts if count)
    numbers = f"step{'' if len(steps) == 1 else 's'} {', '.join(map(str, steps))}"
    return f"as delivered, to be set in {numbers} of commissioning: {text}" if text else ""


def joined_places(places: Iterable[str]) -> str:
    """Return ``Axis 1 X, 2 Y``: a common first word is not repeated. The letter that two axes share is."""
    texts, word = [], ""
    for place in places:
        first, _, rest = place.partition(" ")
        texts.append(rest if rest and first == word and not rest.startswith("(") else place)
        word = first
    return ", ".join(texts)


def note_lines(text: str) -> list[str]:
    """Return the lines of what a person wrote; blanks at the start of one are kept on paper."""
    lines = text.expandtabs(4).splitlines()
    return [NO_BREAK * (len(line) - len(line.lstrip(" "))) + line.strip(" ") for line in lines]


def printable(text: str) -> str:
    """Return a text without control characters for printers, terminals and text direction."""
    # Nearly all are: each text of a report passes here.
    if text.isprintable():
        return text
    # Line by line: a drawing is long, and but for its ends of lines there is nothing in it to take away.
    return " ".join(line if line.isprintable() else _printable(line) for line in text.split("\n"))


def _printable(line: str) -> str:
    return "".join(c if c.isprintable() or c == NO_BREAK else " " for c in line)
