"""The state of an exchange in words: what the control contains, by what that is proven, what is doubtful."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from amp_studio.schema import visible
from amp_studio.ui.base.time_words import in_words
from amp_studio.ui.base.translated import message_in_words, tr

from .session import ControlSession

if TYPE_CHECKING:
    from amp_studio.transfer import TransferError
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
        if session.lacks_password or not session.error:
            return ""
        return tr(  # why it was not reached is in the bar above
            "What {name} contains is not known.\nTry again when it is switched on and connected, compare the"
            " file with a backup of it (page Compare),\nor practise with an emulated control (menu Control)."
        ).format(name=name)
    if session.seen.why_unreadable:
        return message_in_words(session.seen.why_unreadable)
    if not session.seen.content:
        return tr("The control contains no parameters.")
    return summary or text_of_reading(session.seen.when)


def text_of_reading(when: datetime) -> str:
    """Return when a control was read."""
    return tr("Read at {time}").format(time=in_words(when, datetime.now(UTC).astimezone()))


def error_in_words(session: ControlSession) -> str:
    """Return why a control was not reached, as a sentence."""
    text = message_in_words(session.error)
    return text[:1].upper() + text[1:]


def text_of_proof(session: ControlSession, name: str) -> str:
    """Return what a control contains after a download, and by what that is proven."""
    assert session.outcome is not None
    outcome = session.outcome
    head = tr("{name} contains all new values.").format(name=name)
    if session.backup_name:
        head = tr("{name} contains what is in {backup}.").format(name=name, backup=session.backup_name)
    lines = [head, message_in_words(outcome.text)]
    if session.sent.kept:
        lines.append(tr("Kept as they were: {names}").format(names=", ".join(session.sent.kept)))
    before = hashlib.sha256(session.replaced).hexdigest()
    text = tr("Checksum before {before}, now {now}")
    lines.append(text.format(before=before[:12], now=outcome.sha256[:12]))
    return "\n\n".join(lines)


def text_of_end(session: ControlSession, name: str) -> str:
    """Return what a control contains after an exchange, however that ended."""
    if session.phase == "failed":
        return text_of_failure(session)
    return text_of_one(session) or text_of_proof(session, name)


def text_of_failure(session: ControlSession) -> str:
    """Return one of four sentences about what the control contains, and why."""
    if session.outcome is not None:
        return message_in_words(session.outcome.text)
    failure = session.failure
    # Without a failure of the transfer it broke before anything was sent.
    state = failure.at_control or "old" if failure is not None else "old"
    head = _heads(session.backup_name).get(state, tr("It is not known what the control contains."))
    if state == "old" and not session.has_sent:
        head = tr("Nothing was sent to the control.")
    elif session.sent.is_one:
        head = _heads_of_one().get(state, head)
    # Some of both, or not known: gains and limits may not fit each other.
    danger = "" if state in ("old", "new") else tr("Do not move the machine before it was read.")
    why = f"{_why(session)}."
    return " ".join(filter(None, (head, danger, why[:1].upper() + why[1:], *_details(failure, state))))


def _why(session: ControlSession) -> str:
    """Return what happened, without what an error states of the control: that is the head."""
    failure = session.failure
    if failure is None:
        return message_in_words(session.error).rstrip(".")
    return message_in_words("; ".join(filter(None, (failure.what, str(failure.confirmed or "")))))


def _details(failure: TransferError | None, state: str) -> Iterator[str]:
    """Yield which values are new where some are, and where what the control contained before is kept."""
    if failure is None or state == "old":
        return
    if state == "new" and not failure.new:
        yield tr("It was not read back.")
    elif failure.new and state != "new":
        yield tr("New, as far as is known: {names}.").format(names=", ".join(map(visible, failure.new)))
    if failure.kept:
        yield tr("What it contained before is kept in {kept}.").format(kept=failure.kept)


def text_of_one(session: ControlSession) -> str:
    """Return that a value alone was written, and by what that is proven; empty where none was."""
    if session.outcome is None or not session.sent.is_one:
        return ""
    return ". ".join(filter(None, (*session.sent.lines, message_in_words(session.outcome.text))))


def _heads_of_one() -> dict[str, str]:
    return {
        "old": tr("The control contains the old value."),
        "new": tr("The control contains the new value."),
    }


def _heads(backup: str) -> dict[str, str]:
    """Return what the control contains, by what is proven: the values of a backup are older ones, so they are
    not called new.
    """
    lost = {"defaults": tr("The control has lost its memory and contains its defaults.")}
    if backup:
        return {
            "old": tr("The control contains what it contained before."),
            "new": tr("The control contains what is in {backup}.").format(backup=backup),
            "mixed": tr("The control contains some of both: of {backup} and of before.").format(
                backup=backup
            ),
            **lost,
        }
    return {
        **lost,
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
        if session.stage == "commit":  # either may come of it
            return tr("Cancel")
        is_new = session.stage in ("restart", "verify")
        return tr("Cancel, Keep All New Values") if is_new else tr("Cancel, Keep All Old Values")
    return tr("Cancel, Leave What Is Confirmed")
