"""Values and figures as the language of the window writes them: a German one with a decimal comma.

What is typed may have either sign; editors and the clipboard have a point.
"""

from __future__ import annotations

import re

from amp_studio import schema
from amp_studio.schema import Parameter, Value

from .translated import message_in_words, tr, unit_in_words

_NUMBER = re.compile(r"(?<![\w.$@])(?<!figure )[-−]?\d+\.\d+(?![\w]|\.\d)")
"""A number in a sentence; no address (``P3N0.5``, ``$22.0``), version, network address, printed figure."""
_POINT = re.compile(r"(?<=\d)\.(?=\d)")
_MINUS = re.compile(r"^-(?=\d)")
_POWER = re.compile(r"(?<=\d)e([+-]?)0*(\d+)")
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def written(figure: str) -> str:
    """Return a number with the decimal sign of the language and a minus as wide as a digit;
    ``1e-07`` is 1 × 10⁻⁷.
    """
    figure = _MINUS.sub("−", figure)
    return _POWER.sub(_power, _POINT.sub(tr(".", "decimal sign"), figure))


def _power(match: re.Match[str]) -> str:
    return "\u202f×\u202f10" + (match[1].strip("+") + match[2]).translate(_RAISED)


def sentence(text: str) -> str:
    """Return a message that was made below the window (what is allowed, why a value is refused)
    with its numbers as the language writes them.
    """
    return with_figures(message_in_words(text))


def with_figures(text: str) -> str:
    """Return a text with its numbers as the language writes them; addresses stay."""
    point = tr(".", "decimal sign")
    return text if point == "." else _NUMBER.sub(lambda found: found[0].replace(".", point), text)


def show_value(parameter: Parameter, value: Value | None, *, secrets: bool = False) -> str:
    """Write a value for a person; texts, choices and secrets stay as they are, and so do words of a
    control.
    """
    text = schema.show_value(parameter, value, secrets=secrets)
    is_number = value is not None and isinstance(value.value, (int, float)) and not parameter.choices
    if value is None or not is_number or (parameter.secret and not secrets):
        return text
    unit = schema.unit_text(value.unit)
    return written(text.removesuffix(unit) + unit_in_words(value.unit))


def write_figure(number: float) -> str:
    """Write a calculated number with the digits that matter."""
    return written(schema.write_figure(number))
