"""What a control contains after a download broke off: read from it, setting by setting, or not known."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from amp_studio.transfer import AtControl, TransferError, state_after_break

from .content import GrblContent
from .kind import HOMING, JOG_LIMITS, LOCATE_RATE, PER_AXIS_RATES, RESET_ACTIONS, SEEK_RATE, SOFT_LIMITS
from .numbers import is_shown_as
from .offsets import PUT_BACK, is_same_offset
from .writing import Writing

_MOVED = {
    f"${n}" for n in (HOMING, SOFT_LIMITS, JOG_LIMITS, RESET_ACTIONS, LOCATE_RATE, SEEK_RATE, *PER_AXIS_RATES)
}
"""Settings that another one may have moved."""
_MANY = 3
"""Settings that were not touched and are others now: more than a byte that the line has changed can do."""


def after_break(
    error: TransferError,
    writing: Writing,
    content: GrblContent | None,
    *,
    has_lost_memory: bool = False,
    is_answered: bool = False,
) -> None:
    """Write into the error what the control contains: as it was read since, else what its answers prove.

    ``is_answered`` is whether the line was whole to the end:
    then the control has what it has answered ``ok`` to.
    """
    if content is not None:
        at, new = state_of(writing, content, has_lost_memory=has_lost_memory)
        new = tuple(writing.sent.names) if at == "new" else new
    elif is_answered:
        at, new = writing.sent.answered_state()
    else:
        at, new = ("unknown", tuple(writing.sent.names)) if writing.sent.has_begun else ("old", ())
    # What the memory contains is not what the control shows: it could not be written.
    if error.at_control == "unknown" and at != "defaults":
        at = "unknown"
    error.at_control, error.new = at, new


def state_of(
    writing: Writing, content: GrblContent, *, has_lost_memory: bool = False
) -> tuple[AtControl, tuple[str, ...]]:
    """Return what a control that shows ``content`` contains of a download, and which settings are new."""
    present, names = names_of(writing.present), {f"${n}" for n in writing.settings} | writing.others.keys()
    wanted = _wanted(writing, names, present)
    now = _seen(writing, content, names, present, wanted)
    changed = [n for n in present if n not in names and now.get(n) != present[n]]
    known = {name: now[name] for name in now.keys() & {*present, *wanted}}
    at, new = state_after_break(present, wanted, known)
    # Many others at once: the control has restarted with its defaults.
    if (has_lost_memory and at != "old") or len(changed) >= _MANY:
        return "defaults", _still_new(writing.sent.unanswered, now, wanted)
    return at, new


def _still_new(last: str, now: Mapping[str, str], wanted: Mapping[str, str]) -> tuple[str, ...]:
    """Return the last setting that was sent where a control that has just restarted has still taken it."""
    return (last,) if last and now.get(last) == wanted.get(last) else ()


def _wanted(writing: Writing, names: Collection[str], present: Mapping[str, str]) -> dict[str, str]:
    """Return what the control contains after a whole download, by name."""
    target = names_of(writing.target)
    # Rates of single axes come and go with $22: only what was there or is sent can be old or new.
    wanted = {name: text for name, text in target.items() if name in names or name in present}
    return wanted | {name: text for name, text in present.items() if name not in names}


def _seen(
    writing: Writing,
    content: GrblContent,
    names: Collection[str],
    present: Mapping[str, str],
    wanted: Mapping[str, str],
) -> dict[str, str]:
    """Return what the control shows now, a new value as it was sent."""
    now = names_of(content)
    # $13 may be new: what is shown in another unit is what it was.
    now |= {n: present[n] for n in PUT_BACK if n in present and is_same_offset(writing.present, content, n)}
    for name in {*names} & {*present, *wanted}:
        is_new = _is_shown(writing, content, name, wanted[name], now.get(name, ""))
        # A value that is shown the same before and after is new only if it was sent.
        if is_new and (now.get(name) != present.get(name) or name in writing.sent.names):
            now[name] = wanted[name]
    # The firmware moves these itself: they may be others without the download.
    return now | {name: present[name] for name in (_MOVED - {*names}) & present.keys()}


def names_of(content: GrblContent) -> dict[str, str]:
    """Return what can be written of a content, by name."""
    return {
        **{f"${n}": text for n, text in content.settings.items()},
        **{n: text for n, text in content.offsets.items() if n in PUT_BACK},
        **{f"$N{n}": line for n, line in content.startup.items()},
    }


def _is_shown(writing: Writing, content: GrblContent, name: str, text: str, reported: str) -> bool:
    if name in PUT_BACK:
        return is_same_offset(writing.target, content, name)
    return is_shown_as(text, reported) if name[1:].isdigit() else text == reported
