"""Text from a file or a control, made safe to show: characters that steer a terminal become visible."""

from __future__ import annotations

import json
import re

_STEERING = (
    "[\x00-\x1f\x7f-\x9f\xad\u0600-\u0605\u061c\u06dd\u070f\u0890\u0891\u08e2\u180e\u200b-\u200f\u2028-\u202e\u2060-\u206f"
    "\ud800-\udfff\ufeff\ufff9-\ufffb\U000110bd\U000110cd\U00013430-\U00013438\U0001bca0-\U0001bca3"
    "\U0001d173-\U0001d17a\U000e0001\U000e0020-\U000e007f]"
)
"""Unicode's categories Cc, Cf, Cs, Zl and Zp: control characters, marks of writing direction,
line separators, surrogates."""


def visible(text: str, keep: str = "") -> str:
    r"""Return a text with every control character as JSON writes it (``\u001b``); those in ``keep`` stay.

    A JSON document stays the same document.
    """
    return re.sub(_STEERING, lambda found: found[0] if found[0] in keep else json.dumps(found[0])[1:-1], text)
