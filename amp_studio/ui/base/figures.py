"""Values and figures as the language of the window writes them: a German one with a decimal comma.

What is typed may have either sign; editors and the clipboard have a point.
"""

from __future__ import annotations

import re
import textwrap
from functools import cache

from amp_studio import schema
from amp_studio.drawing import THIN, grouped
from amp_studio.schema import UNITS, Limits, Parameter, Value
from amp_studio.validate import Finding

from .translated import message_in_words, tr, unit_in_words, worded_finding

_NUMBER = re.compile(r"(?<![\w.$@])(?<!figure )[-−]?\d+\.\d+(?![\w]|\.\d)")
"""A number in a sentence; no address (``P3N0.5``, ``$22.0``), version, network address, printed figure."""
_POINT = re.compile(r"(?<=\d)\.(?=\d)")
_MINUS = re.compile(r"^-(?=\d)")
_POWER = re.compile(r"(?<=\d)e([+-]?)0*(\d+)")
_EXPONENT = re.compile(r"(?<![\w.,])\d+(?:[.,]\d+)?e[-+]?\d+(?!\w)")
_FIGURE = re.compile(r"(?<![^\s(])[-−]?\d+(?:\.\d+)?(?:e[+-]?\d+)?(?![\w.]*\w)")
"""A number in a text that has no address: a range, or the value beside the name of a parameter."""
_TIP_WIDTH, _TIP_LINES = 100, 24
"""Letters of a line of a tip, and its lines at most: a note may have 4,000 letters."""
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def written(figure: str) -> str:
    """Return a number with the decimal separator of the language, a minus as wide as a digit and its digits
    in groups; ``1e-07`` is 1 × 10⁻⁷.
    """
    return grouped(typed(figure))


def typed(figure: str) -> str:
    """Return as ``written`` without groups: for a field in which it is typed."""
    figure = _MINUS.sub("−", figure)
    return _POWER.sub(_power, _POINT.sub(tr(".", "decimal sign"), figure))


def _power(match: re.Match[str]) -> str:
    return f"{THIN}×{THIN}10" + (match[1].strip("+") + match[2]).translate(_RAISED)


def range_in_words(allowed: Limits) -> str:
    """Return a range as the language writes it: ``−999 999.99 to 999 999.99 mm``."""
    return with_groups(message_in_words(allowed.text()).replace(" °", "°"))


def with_groups(text: str) -> str:
    """Return a text without addresses with its numbers as the language writes them, and in groups."""
    return _FIGURE.sub(lambda found: written(found[0]), text)


def sentence(text: str) -> str:
    """Return a message that was made below the window (what is allowed, why a value is refused)
    with its numbers as the language writes them.
    """
    return with_measures(with_figures(message_in_words(text)))


def finding_in_words(finding: Finding) -> str:
    """Return the message of a finding in the language of the window, with its figures."""
    return with_measures(worded_finding(finding))


def with_measures(text: str) -> str:
    """Return a sentence with its quantities in groups, and powers as a person writes them; numbers of
    parameters, blocks and registers have no unit and stay.
    """
    text = _EXPONENT.sub(lambda found: written(found[0]), text)
    return _quantities(frozenset(map(unit_in_words, UNITS))).sub(lambda found: grouped(found[0]), text)


@cache
def _quantities(units: frozenset[str]) -> re.Pattern[str]:
    """Return what finds numbers of five digits or more before a unit, or before the end of its range."""
    spelled = "|".join(map(re.escape, sorted(units - {""}, key=len, reverse=True)))
    unit = rf"[ {THIN}]?(?:{spelled})(?![\w/])"
    number = r"\d+(?:[.,]\d+)?"
    return re.compile(rf"(?<![\w.,@$/-])[-−]?\d{{5,}}(?:[.,]\d+)?(?={unit}| (?:to|bis) [-−]?{number}{unit})")


def with_figures(text: str) -> str:
    """Return a text with its numbers as the language writes them; addresses stay."""
    point = tr(".", "decimal sign")
    return text if point == "." else _NUMBER.sub(lambda found: found[0].replace(".", point), text)


def as_tip(text: str) -> str:
    """Return a text in lines that a screen has room for: Qt makes one line of a paragraph."""
    lines = [line for part in text.split("\n") for line in textwrap.wrap(part, _TIP_WIDTH) or [""]]
    return "\n".join([*lines[:_TIP_LINES], *(["…"] if len(lines) > _TIP_LINES else [])])


def unbroken(text: str) -> str:
    """Return HTML whose numbers stay in one line: Qt makes a blank of the narrow space."""
    return text.replace(THIN, "\u00a0")


def show_value(parameter: Parameter, value: Value | None, *, secrets: bool = False) -> str:
    """Write a value for a person; texts, choices and secrets stay as they are, and so do words of a
    control.
    """
    text = schema.show_value(parameter, value, secrets=secrets)
    is_number = value is not None and isinstance(value.value, (int, float)) and not parameter.choices
    if value is None or not is_number or parameter.secret:
        return text
    unit = schema.unit_text(value.unit)
    return written(text.removesuffix(unit) + unit_in_words(value.unit))


def write_figure(number: float) -> str:
    """Write a calculated number with the digits that matter."""
    return written(schema.write_figure(number))
