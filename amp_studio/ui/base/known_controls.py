"""The controls that were reached from this computer: address, family,
and how the last exchange with each ended.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass, replace
from datetime import UTC, datetime
from typing import Literal, get_args

ControlVerb = Literal["connect", "download", "verify", "upload", "restore"]
MAX_CONTROLS = 12
"""Controls that are remembered."""
_LONGEST = 500
"""Most characters of a part that is remembered."""


@dataclass(frozen=True)
class KnownControl:
    """One control, as it was at the last exchange."""

    address: str
    family: str = ""
    name: str = ""
    """What it calls itself."""
    verb: ControlVerb = "connect"
    when: str = ""
    """ISO time of the last exchange, in UTC."""
    reached: bool = True
    """Whether it answered."""

    @property
    def moment(self) -> datetime | None:
        """The local time of the last exchange; None where it is not known."""
        try:
            return datetime.fromisoformat(self.when).astimezone()
        except (ValueError, OverflowError, OSError):
            return None


def read_controls(kept: object) -> list[KnownControl]:
    """Return what was stored, the latest first; an entry that cannot be used is left out."""
    texts = kept if isinstance(kept, list) else [kept]
    found = (_read(text) for text in texts[:MAX_CONTROLS] if isinstance(text, str))
    return [control for control in found if control is not None]


def _read(text: str) -> KnownControl | None:
    try:
        data = json.loads(text)
    except (ValueError, RecursionError):
        return None
    if not isinstance(data, dict):
        return None
    texts = {k: data.get(k, "") for k in ("address", "family", "name", "verb", "when")}
    if not all(isinstance(v, str) and len(v) <= _LONGEST for v in texts.values()) or not texts["address"]:
        return None
    written, usual = texts.pop("verb"), KnownControl.verb
    verb = next((each for each in get_args(ControlVerb) if each == written), usual)
    return KnownControl(**texts, verb=verb, reached=data.get("reached") is not False)


def stored_controls(controls: Iterable[KnownControl]) -> list[str]:
    """Return controls as texts for the settings."""
    return [json.dumps(asdict(control)) for control in controls]


def with_exchange(
    known: list[KnownControl],
    address: str,
    verb: ControlVerb,
    *,
    reached: bool,
    family: str = "",
    name: str = "",
    now: datetime | None = None,
) -> list[KnownControl]:
    """Return the controls after an exchange with one, which comes first;
    what it did not say stays as it was known.
    """
    before = next((each for each in known if each.address == address), KnownControl(address))
    when = (now or datetime.now(UTC)).isoformat(timespec="seconds")
    after = replace(
        before,
        verb=verb,
        reached=reached,
        when=when,
        family=family or before.family,
        name=name or before.name,
    )
    return [after, *(each for each in known if each.address != address)][:MAX_CONTROLS]
