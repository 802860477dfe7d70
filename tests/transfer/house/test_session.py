"""A session on a good line: what it asks, sends and fetches, and how it is broken off."""

import threading
from collections.abc import Callable
from typing import Any

import pytest

from amp_studio.transfer.emulated.faults import Faults
from amp_studio.transfer.errors import CancelledError
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.house.frame import encode_frame
from amp_studio.transfer.house.message import Ack, Flags, pack
from tests.transfer.images import NEW, OLD, send, sha


def test_a_hello_reports_who_the_control_is(rig: Callable[..., Any], control: Callable[..., Any]) -> None:
    welcome = rig(control=control()).session().hello()
    assert (welcome.family, welcome.signature, welcome.name, welcome.revision) == (
        "9pc",
        "s1",
        "CNC_1",
        "3.05",
    )
    assert (welcome.size, welcome.sha256) == (len(OLD), sha(OLD))
    assert Flags(welcome.flags) == Flags.ESTOP | Flags.RUNNING | Flags.AUTOSTART


def test_an_image_goes_there_and_comes_back(rig: Callable[..., Any], control: Callable[..., Any]) -> None:
    made = rig(control=control())
    session = made.session()
    assert session.fetch() == OLD
    sent = send(session)
    assert sent.committed.sha256 == sha(NEW)
    assert session.wait_restarted(sent.committed.incarnation, 10).incarnation == 2
    assert session.fetch() == NEW
    assert made.control.memory.read("previous.img") == OLD


def test_progress_is_reported_to_the_last_byte(rig: Callable[..., Any], control: Callable[..., Any]) -> None:
    reported: list[tuple[str, int, int]] = []
    session = rig(control=control()).session()
    session.fetch(Exchange(lambda *step: reported.append(step)))
    send(session, progress=lambda *step: reported.append(step))
    for stage, total in (("upload", len(OLD)), ("download", len(NEW)), ("commit", 1)):
        steps = [done for name, done, _ in reported if name == stage]
        assert steps == sorted(steps)
        assert steps[-1] == total
        assert {of for name, _, of in reported if name == stage} == {total}


def test_an_empty_image_is_an_image_too(rig: Callable[..., Any], new_control: Callable[..., Any]) -> None:
    session = rig(control=new_control(initial=b"")).session()
    assert session.fetch() == b""
    send(session, NEW, b"")
    session.wait_restarted(1, 10)
    send(session, b"", NEW)
    session.wait_restarted(2, 10)
    assert session.fetch() == b""


# -- cancel and restart ----------------------------------------------------------------------------


def test_a_cancel_in_the_middle_leaves_the_old_image_and_nothing_staged(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(control=control(), bytes_per_second=960)
    cancel = threading.Event()
    cancelled_at = []

    def halfway(stage: str, done: int, total: int) -> None:
        if stage == "download" and done * 2 > total and not cancelled_at:
            cancelled_at.append(made.clock.now)
            cancel.set()

    with pytest.raises(CancelledError) as caught:
        send(made.session(), cancel=cancel, progress=halfway)
    assert caught.value.at_control == "old"
    assert str(caught.value) == "stopped; nothing was replaced in the control"
    assert made.control.image == OLD
    assert not [name for name in made.control.memory.names() if name.startswith("staged-")]
    assert made.clock.now - cancelled_at[0] < 0.6


def test_a_cancel_of_an_upload_and_of_a_waiting_session(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    cancel = threading.Event()
    cancel.set()
    made = rig(control=control())
    with pytest.raises(CancelledError):
        made.session().fetch(Exchange(cancel=cancel))
    made = rig(Faults(silent=True), control=control())
    with pytest.raises(CancelledError):
        made.session().hello(Exchange(cancel=cancel))
    assert made.clock.now < 0.2


def test_a_cancel_after_the_commit_was_asked_for_comes_too_late(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(control=control())
    cancel = threading.Event()

    def late(stage: str, done: int, total: int) -> None:
        if stage == "commit":
            cancel.set()

    assert send(made.session(), cancel=cancel, progress=late).committed.sha256 == sha(NEW)
    assert made.control.image == NEW


def test_a_keyboard_interrupt_throws_the_staged_bytes_away(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(control=control())

    def interrupt(stage: str, done: int, total: int) -> None:
        if done > 60:
            raise KeyboardInterrupt

    with pytest.raises(CancelledError, match="stopped; nothing was replaced"):
        send(made.session(), progress=interrupt)
    assert not [name for name in made.control.memory.names() if name.startswith("staged-")]


def test_a_restart_by_hand_is_waited_for(rig: Callable[..., Any], control: Callable[..., Any]) -> None:
    made = rig(control=control(autostart=False))
    session = made.session()
    sent = send(session)
    assert not sent.committed.restarting
    assert session.hello().flags & Flags.RESTART_NEEDED
    made.modem.restart()
    welcome = session.wait_restarted(sent.committed.incarnation, 10)
    assert welcome.incarnation == 2
    assert not welcome.flags & Flags.RESTART_NEEDED


def test_a_control_that_does_not_come_back_is_not_waited_for_for_ever(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(control=control(), lines=1)
    session = made.session()
    sent = send(session)
    assert session.wait_restarted(sent.committed.incarnation, 5) is None


def test_answers_to_an_earlier_client_are_not_taken(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    """On a serial line the answers to a client that is gone may still be on their way."""
    made = rig(control=control())
    connect = made.modem.connect
    stale = b"".join(encode_frame(pack(Ack(len(NEW)), number)) for number in range(1, 400))

    def with_stale_answers() -> Any:
        link = connect()
        link._to_client.append((0.0, stale))
        return link

    made.modem.connect = with_stale_answers
    send(made.session())
    assert made.control.image == NEW
