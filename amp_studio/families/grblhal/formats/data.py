"""Settings of a Grbl as the data of other programs have them, JSON and XML: with or without the sign.

{"key": "$110", "value": "500.000", …}          an object for each setting, as UGS exports them
{"110": 500.0, …}                               a member for each
<setting id="110" value="500"/>                 an element for each
"""

from __future__ import annotations

import re

MARK = "\ufeff"
NUMBER = r"[+-]?(?:[0-9]+(?:\.[0-9]*|,[0-9]+)?|[.,][0-9]+)"
IP = r"(?:[0-9]{1,3}\.){3}[0-9]{1,3}"
_OBJECT = re.compile(r"\{[^{}]{0,4000}\}")
_NAMED = re.compile(r'"\$(0|[1-9][0-9]{0,4})"\s*[,}]')
_ITS_VALUE = re.compile(r'"val(?:ue)?"\s*:\s*(?:"([^"]*)"|(-?[0-9][-+.0-9eE]*|true|false))', re.IGNORECASE)
_N = r"(?:\$|grbl_|s)?(0|[1-9][0-9]{0,2})"
_V = r"([^\s\"'<>,;{}\[\]]{1,40})"
_DATA = tuple(
    re.compile(shape, re.IGNORECASE)
    for shape in (
        rf'"{_N}"\s*:\s*"?{_V}"?(?=\s*[,}}])',
        rf'"(?:id|key|code|nr|no|number|setting|name)"\s*:\s*"?{_N}"?\s*,\s*"val(?:ue)?"\s*:\s*"?{_V}"?',
        rf'<\w+\s+(?:id|key|code|nr|no|number|name)="{_N}"\s+value="{_V}"',
        rf'<\w+\s+(?:id|key|code|nr|no|number|name)="{_N}"\s*>\s*{_V}\s*<',
        rf"<(\w{{2,9}})>\s*{_N}\s*</\1>\s*<value>\s*{_V}\s*</value>",
        rf"<(?:setting|s)_?{_N}>\s*{_V}\s*</",
    )
)
"""Number and value as JSON and XML have them, each shape the one of a whole text."""
_TAG = re.compile(r"<\?[^<>]{0,200}>|</?\w{1,40}/?>")
_OF_EVERY_GRBL = {"100", "110", "120"}
"""Numbers without a sign are settings where these are among them."""
_MIN_SETTINGS, _LONGEST = 8, 400_000


def with_signs(text: str) -> str:
    """Return a text whose settings have their sign: numbers and values of JSON and XML become ``$110=500``
    on the line of the number.
    """
    text = _OBJECT.sub(_in_one_line, text)
    is_data = text.lstrip(f"{MARK} \t\r\n").startswith(("[", "{", "<"))
    for shape in _DATA if is_data else ():
        found = list(shape.finditer(text[:_LONGEST]))
        # Numbers alone are in many texts: only those that look like a whole set of settings are taken.
        if {match.groups()[-2] for match in found} >= _OF_EVERY_GRBL and len(found) >= _MIN_SETTINGS:
            return _TAG.sub(" ", shape.sub(_with_sign, text))
    return text


def _with_sign(match: re.Match[str]) -> str:
    number, value = match.groups()[-2:]
    # As many lines as before: messages name the line of the text.
    return f" ${number}={value} " + "\n" * match[0].count("\n")


def _in_one_line(match: re.Match[str]) -> str:
    """Return an object that names a setting and its value as a setting, on the line of its name;
    any other as it is.
    """
    name, value = _NAMED.search(match[0]), _ITS_VALUE.search(match[0])
    if name is None or value is None:
        return match[0]
    text = value[2] if value[1] is None else value[1]
    lines = match[0].count("\n", 0, name.start())
    return "\n" * lines + f'"${name[1]}": "{text}",' + "\n" * (match[0].count("\n") - lines)
