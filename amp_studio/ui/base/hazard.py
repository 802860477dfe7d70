"""Danger, warning and note as a machine manual has them: the sign, the signal word,
and the statement beside it.
"""

from __future__ import annotations

import html
from typing import Literal

from .theme import Token, colour, icon_html
from .translated import tr

Grade = Literal["danger", "warning", "note"]

_STYLE: dict[Grade, tuple[Token, Token, str]] = {
    "danger": ("error", "errorbg", "warning-fill"),
    "warning": ("warn", "warnbg", "warning-fill"),
    "note": ("rec", "recbg", "info"),
}
"""Grade -> its ink, its ground and its sign."""


def hazard_html(grade: Grade, *statements: str) -> str:
    """Return statements of the manual in one box, a line each, for a page of HTML in the window."""
    words: dict[Grade, str] = {"danger": tr("Danger"), "warning": tr("Warning"), "note": tr("Note")}
    colour_name, background, symbol = _STYLE[grade]
    word = words[grade].upper() if grade == "danger" else words[grade]
    lines = "<br>".join(map(html.escape, statements))
    bar, fill = colour(colour_name).name(), colour(background).name()
    return (
        '<table width="100%" cellspacing="0" cellpadding="6" style="margin-bottom:6px"><tr>'
        f'<td width="1" style="background-color:{bar}; padding:0px 2px"></td>'
        f'<td style="background-color:{fill}">{icon_html(symbol, colour_name)} '
        f'<b style="color:{bar}">{word}</b><br>{lines}</td></tr></table>'
    )
