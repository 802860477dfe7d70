"""What a Grbl control does with settings in each of the states that it reports
(docs/protocols/grblhal.md).
"""

from __future__ import annotations

import re

from amp_studio.schema import visible

LASTING = ("Idle", "Alarm")
"""States in which the memory is written (protocol.c ``protocol_execute_realtime``)."""
SUSPENDED = ("Hold", "Door")
"""States in which no line is read until a person goes on (protocol.c ``protocol_exec_rt_suspend``)."""

_TEXTS = {
    "Check": "settings written in check mode may be lost at the next reset: leave check mode ($C) first",
    "Hold": "in a feed hold it answers no command: go on or reset it at the machine first",
    "Door": "with the safety door open it answers no command: close the door and go on first",
}


def state_in(line: str) -> str:
    """Return the state in a status report, short and visible; "" for another line."""
    return visible(re.split(r"[|:>]", line[1:])[0][:20]) if line.startswith("<") else ""


def state_text(state: str) -> str:
    """Return why nothing is written in a state, and what to do."""
    return _TEXTS.get(state, "it takes no settings then: bring it to rest first")
