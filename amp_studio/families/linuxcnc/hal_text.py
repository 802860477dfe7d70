"""What a HAL file does with the values of a configuration: which pins it sets to them.
It is read and never written.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

_REFERENCE = re.compile(r"\[([A-Za-z0-9_]+)\]\(?([A-Za-z0-9_]+)\)?")
_SET = re.compile(r"\s*(?:setp\s+(\S+)|sets\s+(\S+))", re.IGNORECASE)


def references(text: str) -> Iterator[tuple[int, str, str]]:
    """Yield line, ``[JOINT_0]P``, and the pin or signal that the line sets to it; "" for another use."""
    for number, row in enumerate(text.splitlines(), 1):
        # A remark names keys without using them.
        line = row.split("#")[0]
        match = _SET.match(line)
        for each in _REFERENCE.finditer(line):
            yield number, f"[{each[1]}]{each[2]}", (match[1] or match[2]) if match else ""
