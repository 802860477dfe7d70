"""What comes next in an exchange, by how far it is: what the one button does and why it is off, and what the
message above the table states, with its answers. Only read here; the page acts.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from amp_studio.files import ParameterFile
from amp_studio.ui.base.places import finding_text
from amp_studio.ui.base.translated import message_in_words, tr
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.message_bar import MessageKind

from .conditions import conditions_of
from .session import ControlSession
from .session_words import ControlBackup, doubts_of, error_in_words, text_of_failure, text_of_one

if TYPE_CHECKING:
    from amp_studio.transfer import ControlIdentity

ExchangeDirection = Literal["compare", "send", "read", "hand"]
"""What is done with the control; "hand" is the sheet of values that a person keys in at it."""
BarAnswer = Literal["ask", "accept errors", "write one"]
"""What a button of the message does: asks the control for its state, sends the file with its errors, writes
one value."""


@dataclass(frozen=True, slots=True)
class PrimaryButton:
    """The one button of the page."""

    text: str = ""
    """Empty where there is nothing to do."""
    why_off: str = ""
    """What it waits for; empty where it can be pressed."""


@dataclass(frozen=True, slots=True)
class BarMessage:
    """What is missing or how it ended, how severe it is, and what can be done about it."""

    text: str
    kind: MessageKind
    answers: tuple[tuple[str, BarAnswer], ...] = ()


@dataclass(frozen=True, slots=True)
class PageState:
    """What is chosen on the page of a control, and how far its exchange is."""

    direction: ExchangeDirection
    workspace: Workspace | None
    """The file in front; None where a control is read into a new one."""
    backup: ControlBackup | None
    """What is to be restored, in the place of the file."""
    session: ControlSession | None
    file: ParameterFile | None
    """The side that is not the control: the file in front, or that of the backup."""
    to_send: int
    """How many values the control gets that it does not contain."""
    kept: int
    """How many values keep the control's side, or are taken from it into the file when it is read."""
    has_rows: bool
    """Whether any value differs."""
    has_dangers: bool
    """Whether a value that would be sent can be dangerous."""
    is_checked: bool
    """Whether the user has confirmed that he checked those."""
    accepted_errors: bool
    asks_one: str = ""
    """What is to be known of a value that is to be written alone; empty while none is."""


# -- the one button --------------------------------------------------------------------


def primary_button(state: PageState) -> PrimaryButton:
    """Return what the one button does in a state."""
    session = state.session
    if session is None or session.is_busy:
        return PrimaryButton()
    # With a password missing the field above tries again: the same without one would only fail once more.
    if session.phase == "away" and session.error and not session.lacks_password:
        return PrimaryButton(tr("Try Again"))
    if session.phase in ("away", "failed"):
        if session.lacks_password:
            return PrimaryButton(tr("Try Again") if session.must_wait else "")
        return PrimaryButton(tr("Connect and Read"))
    if session.phase == "done":
        return PrimaryButton(tr("Back to the Values"))
    if state.direction == "read":
        return _button_of_reading(state, session)
    if state.direction == "compare":
        count = state.to_send
        return PrimaryButton(tr("Send %n Values to the Control…", "", count) if count else "")
    return _button_of_sending(state, session)


def _button_of_sending(state: PageState, session: ControlSession) -> PrimaryButton:
    if state.backup is not None:
        return PrimaryButton(
            tr("Restore {name}").format(name=state.backup.path.name), _why_not_sent(state, session)
        )
    text = tr("Send %n Values to the Control", "", state.to_send)
    if state.workspace is not None and state.workspace.is_dirty and state.workspace.may_edit:
        text = tr("Save and Send %n Values to the Control", "", state.to_send)
    if not state.to_send and not _differs_elsewhere(state, session):
        return PrimaryButton(text, tr("No difference: there is nothing to send."))
    return PrimaryButton(text, _why_not_sent(state, session))


def _button_of_reading(state: PageState, session: ControlSession) -> PrimaryButton:
    if session.seen is None or session.seen.file is None:
        return PrimaryButton(tr("Save as a New File…"), tr("Nothing that can be read is in the control."))
    workspace, count = state.workspace, state.kept
    if workspace is None or session.present(workspace.file) is None or not count:
        return PrimaryButton(tr("Save as a New File…"))
    text = tr("Take %n Values into {name}", "", count).format(name=workspace.path.stem)
    return PrimaryButton(text, "" if workspace.may_edit else tr("The file is read-only."))


def _differs_elsewhere(state: PageState, session: ControlSession) -> bool:
    """Return whether the content differs though no value does: in its header, for instance."""
    comparison = session.comparison(state.file) if state.file is not None else None
    if comparison is None or comparison.missing:  # what a control does not have is not sent
        return False
    return not comparison.is_same and not state.has_rows


def _why_not_sent(state: PageState, session: ControlSession) -> str:
    """Return what is missing before all is sent."""
    why = why_not_written(state, session)
    if not why and state.has_dangers and not state.is_checked:
        return tr("Waiting: what can be dangerous is not checked")
    return why


def why_not_written(state: PageState, session: ControlSession) -> str:
    """Return what is missing before anything is written, in the order of the conditions."""
    workspace = state.workspace
    if state.file is not None:
        # What is not known (None) does not keep from sending: the driver asks it again before it writes.
        missing = next((c for c in conditions_of(session, state.file) if c.met is False), None)
        if missing is not None:
            return tr("Waiting: {what}").format(what=missing.text)
    # A backup goes back as it was, errors and all: the machine ran with it.
    is_of_file = state.backup is None and workspace is not None
    if is_of_file and not state.accepted_errors and workspace.count("error"):
        return tr("Waiting: the file has errors")
    return ""


# -- the message above the table -------------------------------------------------------


def bar_message(state: PageState) -> BarMessage | None:
    """Return what is missing or how the exchange ended; None where there is nothing to state."""
    session = state.session
    if session is None:
        return None
    if session.is_busy:
        return BarMessage(message_in_words(session.prompt), "advice") if session.prompt else None
    if session.lacks_password:
        return BarMessage(_about_password(session), "warning")
    if session.phase == "away" and session.error:
        return BarMessage(" ".join(_about_reaching(session)), "warning")
    if session.phase == "failed":
        return BarMessage(text_of_failure(session), "error")
    if session.phase == "done":
        return BarMessage(" ".join(map(message_in_words, session.notes)), "advice") if session.notes else None
    if state.direction != "send" or session.seen is None:
        return None
    # None is a control without such a state.
    if session.in_estop is False:
        text = tr("Press E-stop at the machine. While an axis can move, the control takes no parameters.")
        return BarMessage(text, "warning", ((tr("Ask Now"), "ask"),))
    if state.asks_one:
        return BarMessage(state.asks_one, "warning", ((tr("Write It Now"), "write one"),))
    return _message_of_content(state, session.seen.control)


def _message_of_content(state: PageState, control: ControlIdentity) -> BarMessage | None:
    """Return what there is to know about what would be sent, and about the control that gets it."""
    if state.backup is not None:
        doubts = doubts_of(state.backup)
        found = BarMessage(doubts, "warning") if doubts else None
    else:
        workspace = state.workspace
        found = _message_of_file(workspace, state.accepted_errors) if workspace is not None else None
    if found is not None or state.session is None:
        return found
    if control.notice:
        return BarMessage(message_in_words(control.notice), "warning")
    if text := text_of_one(state.session):
        return BarMessage(text, "advice")
    comparison = state.session.comparison(state.file) if state.file is not None else None
    if comparison is not None and comparison.missing and state.to_send:
        why = message_in_words(comparison.missing)
        return BarMessage(tr("A part of the file is not sent: {why}.").format(why=why), "warning")
    return None


def _about_reaching(session: ControlSession) -> Iterator[str]:
    """Yield why a control was not reached, and what to look at where nothing answers."""
    yield f"{error_in_words(session).rstrip('.')}."
    if session.answers:
        text = tr("What answers there speaks {protocol}: another file or another address is needed.")
        yield text.format(protocol=session.answers)
    elif session.is_silent:
        yield tr("Is it switched on, and are cable, address and, on a serial line, the baud rate right?")


def _about_password(session: ControlSession) -> str:
    if session.has_password:
        return tr("{why}. The control asks for its password again.").format(why=error_in_words(session))
    return tr("The control asks for its password. It is known until the program ends.")


def _message_of_file(workspace: Workspace, accepted_errors: bool) -> BarMessage | None:
    """Return what keeps a file from being sent, and what to do about it."""
    errors = [f for f in workspace.findings if f.severity == "error"]
    if errors and not accepted_errors:
        text = tr("The file has {count}, the first: {message}").format(
            count=tr("%n errors", "", len(errors)), message=finding_text(workspace.file, errors[0])
        )
        return BarMessage(text, "error", ((tr("Send It With Its Errors"), "accept errors"),))
    return None
