"""The state of an exchange in words: what the control contains, by what that is proven, what is doubtful."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from amp_studio.ui.base.time_words import in_words
from amp_studio.ui.base.translated import message_in_words, tr

from .session import ControlSession

if TYPE_CHECKING:
    from amp_studio.transfer.client import Copy


@dataclass(frozen=True, slots=True)
class ControlBackup:
    """What a control contained, and the file in which it is kept."""

    copy: Copy
    path: Path


def text_of_content(session: ControlSession | None, name: str, summary: str) -> str:
    """Return what is in the place of the differences where there are none to list."""
    if session is None:
        return tr(
            "Choose a control at the left, or add one by its address with “+”.\nAn emulated control is in"
            " the menu Control."
        )
    if session.phase == "connecting":
        return tr("Reading what {name} contains …").format(name=name)
    if session.seen is None:
        if session.needs_password or not session.error:
            return ""
        return tr(  # why it was not reached is in the bar above
            "What {name} contains is not known.\nTry again when it is switched on and connected, compare the"
            " file with a backup of it (page Compare),\nor practise with an emulated control (menu Control)."
        ).format(name=name)
    if session.seen.why_unreadable:
        return message_in_words(session.seen.why_unreadable)
    if not session.seen.content:
        return tr("The control contains no parameters.")
    now = datetime.now(UTC).astimezone()
    return summary or tr("Read at {time}").format(time=in_words(session.seen.when, now))


def error_in_words(session: ControlSession) -> str:
    """Return why a control was not reached, as a sentence."""
    text = message_in_words(session.error)
    return text[:1].upper() + text[1:]


def text_of_proof(session: ControlSession, name: str, kept: Sequence[str]) -> str:
    """Return what a control contains after a download, and by what that is proven; ``kept`` are the values
    that stayed as they were.
    """
    assert session.outcome is not None
    outcome, seen = session.outcome, session.seen
    head = tr("{name} contains all new values.").format(name=name)
    if session.backup_name:
        head = tr("{name} contains what is in {backup}.").format(name=name, backup=session.backup_name)
    lines = [head, message_in_words(outcome.text)]
    if kept:
        lines.append(tr("Kept as they were: {names}").format(names=", ".join(kept)))
    if seen is not None:
        before = hashlib.sha256(seen.content).hexdigest()
        text = tr("Checksum before {before}, now {now}")
        lines.append(text.format(before=before[:12], now=outcome.sha256[:12]))
    return "\n\n".join(lines)


def text_of_failure(session: ControlSession) -> str:
    """Return one of four sentences about what the control contains, and why."""
    if session.outcome is not None:
        return message_in_words(session.outcome.text)
    failure = session.failure
    # Without a failure of the transfer it broke before anything was sent.
    state = failure.at_control if failure is not None else "old"
    head = _heads(session.backup_name).get(state or "old", tr("It is not known what the control contains."))
    # Some of both, or not known: gains and limits may not fit each other.
    danger = "" if state in ("old", "", "new") else tr("Do not move the machine before it was read.")
    return " ".join(filter(None, (head, danger, error_in_words(session))))


def _heads(backup: str) -> dict[str, str]:
    """Return what the control contains, by what is proven: the values of a backup are older ones, so they are
    not called new.
    """
    if backup:
        return {
            "old": tr("The control contains what it contained before."),
            "new": tr("The control contains what is in {backup}.").format(backup=backup),
            "mixed": tr("The control contains some of both: of {backup} and of before.").format(
                backup=backup
            ),
        }
    return {
        "old": tr("The control contains all old values."),
        "new": tr("The control contains all new values."),
        "mixed": tr("The control contains some of both: new and old values."),
    }


def doubts_of(backup: ControlBackup) -> str:
    """Return what cannot be checked or shown of a backup; empty for one without doubt."""
    doubts = []
    if not backup.copy.is_checked:
        text = tr("There is no digest beside {name}, so its content cannot be checked.")
        doubts.append(text.format(name=backup.path.name))
    if backup.copy.file is None:
        text = tr("{name} is restored byte for byte, but cannot be shown: {why}.")
        doubts.append(text.format(name=backup.path.name, why=backup.copy.fault))
    return " ".join(doubts)


def text_of_cancel(session: ControlSession | None) -> str:
    """Return what stopping an exchange leaves at the control, as its button has it."""
    if session is None or session.phase != "running" or session.seen is None:
        return tr("Cancel")
    if session.seen.abilities.all_or_nothing:
        return tr("Cancel, Keep All Old Values")
    return tr("Cancel, Leave What Is Confirmed")
