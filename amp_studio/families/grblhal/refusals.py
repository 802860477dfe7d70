"""What a control means by ``error:N``, in sentences of our own for what a download can meet (errors.h)."""

from __future__ import annotations

import re
from collections.abc import Mapping

from amp_studio.schema import visible

from .content import GrblContent
from .line import GrblRefusalError

_TEXTS = {
    3: "it does not know this command",
    4: "the value must not be negative",
    5: "homing is not enabled ($22)",
    6: "the step pulse is too short",
    8: "the machine moves or is in a feed hold: it takes settings at rest only",
    9: "it is locked: unlock it ($X) or home it ($H) first",
    10: "soft limits need homing ($22)",
    11: "the line is too long",
    12: "steps per mm times the maximum rate are more steps than it can make with this step pulse ($0)",
    14: "the line is too long to be stored",
    17: "laser mode needs a spindle output with PWM",
    39: "the value is out of range",
    49: "its self test has failed: it has to be switched off and on",
    50: "its emergency stop is active",
    52: "the value is out of range",
    53: "this build does not have the setting, or an option hides it",
    56: "the coordinate system is locked ($486)",
    77: "it asks for a password",
    78: "it does not allow this",
    79: "an alarm has to be cleared first",
}
MAY_WAIT = frozenset({4, 5, 6, 10, 12, 17, 52, 53})
"""Refusals that may end once another setting is written."""

_CODE = re.compile(r"\[ERRORCODE:(\d+)\|[^|]*\|(.*)\]")


def refusal_text(refusal: GrblRefusalError, names: Mapping[int, str], content: GrblContent | None) -> str:
    """Return a sentence about a refusal, with the name of the setting."""
    why = _TEXTS.get(refusal.code) or _own_text(refusal.code, content)
    match = re.match(r"\$(\d+)=", refusal.command)
    name = names.get(int(match[1]), "") if match else ""
    command = visible(refusal.command[:80])
    named = f"{command} ({name})" if name else command
    return f"the control refuses {named}: {why} (error {refusal.code})"


def _own_text(code: int, content: GrblContent | None) -> str:
    """Return the text that the control's own list has for a code."""
    for line in content.enumerations.get("$EE", ()) if content else ():
        match = _CODE.fullmatch(line)
        if match and int(match[1]) == code and match[2]:
            return visible(match[2])[:200].rstrip(".")
    return "it gives no reason"
