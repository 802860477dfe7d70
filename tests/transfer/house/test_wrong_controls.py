"""Controls that refuse, that are silent, stuck or busy, that forget, or that do not keep to the protocol."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, ClassVar

import pytest

from amp_studio.transfer.client.exchange import upload
from amp_studio.transfer.emulated.faults import Faults
from amp_studio.transfer.emulated.responder import Responder
from amp_studio.transfer.errors import (
    ControlFullError,
    ControlSilentError,
    ImageChangedError,
    ImageDamagedError,
    ImageRejectedError,
    NoConnectionError,
    NotInEmergencyStopError,
    ProtocolMismatchError,
    SignatureMismatchError,
    TransferError,
    WrongFamilyError,
)
from amp_studio.transfer.exchange import Replacement
from amp_studio.transfer.house.driver import HouseDriver
from amp_studio.transfer.house.message import Ack, Code, Data, Gap, Hello, Message, OpenUpload, Read, Refused
from amp_studio.transfer.links.link import LinkError
from tests.transfer.images import NEW, OLD, send


def test_nothing_listens(rig: Callable[..., Any], control: Callable[..., Any]) -> None:
    with pytest.raises(NoConnectionError, match="nothing was replaced"):
        rig(control=control(), lines=0).session().hello()


def test_a_silent_control_is_given_up_soon(rig: Callable[..., Any], control: Callable[..., Any]) -> None:
    made = rig(Faults(silent=True), control=control())
    with pytest.raises(ControlSilentError, match="does not answer"):
        made.session().hello()
    assert made.clock.now < 6


def test_another_family_is_not_touched(rig: Callable[..., Any], control: Callable[..., Any]) -> None:
    with pytest.raises(WrongFamilyError, match="is of the family 9pc, not num"):
        rig(control=control(), family="num").session().hello()


def test_another_control_after_a_reconnection_is_noticed(
    rig: Callable[..., Any], control: Callable[..., Any], new_control: Callable[..., Any]
) -> None:
    made = rig(Faults(drop_after_bytes=500), control=control())
    other = rig(control=new_control(initial=OLD))
    other.control.identity = type(other.control.identity)("9pc", "s1", "CNC_2", "3.05")
    session = made.session()
    session.hello()
    made.modem.connect = other.modem.connect
    with pytest.raises(ProtocolMismatchError, match=r"another control answers.*CNC_2"):
        send(session)
    assert other.control.image == OLD


def test_another_control_after_the_commit_was_asked_for_leaves_the_end_unknown(
    rig: Callable[..., Any], control: Callable[..., Any], new_control: Callable[..., Any]
) -> None:
    made, other = rig(control=control()), rig(control=new_control(initial=OLD))
    other.control.identity = type(other.control.identity)("9pc", "s1", "CNC_2", "3.05")
    session = made.session()

    def move_the_cable(stage: str, done: int, total: int) -> None:
        if stage == "commit" and done == 0:
            made.modem.connect = other.modem.connect
            session._line._talk.link.close()

    with pytest.raises(ProtocolMismatchError) as caught:
        send(session, progress=move_the_cable)
    assert caught.value.at_control == "unknown"


@pytest.mark.parametrize(
    ("prepare", "kind"),
    [
        (lambda control: control.set_estop(False), NotInEmergencyStopError),
        (lambda control: control.patch(lambda image: image + b"x"), ImageChangedError),
        (lambda control: setattr(control.memory, "full_at", 100), ControlFullError),
        (lambda control: setattr(control, "_capacity", 100), ControlFullError),
        (lambda control: setattr(control, "_accept", int), ImageRejectedError),
    ],
)
def test_a_refusal_becomes_an_error_that_shows_nothing_was_replaced(
    rig: Callable[..., Any],
    control: Callable[..., Any],
    prepare: Callable[[Any], None],
    kind: type[TransferError],
) -> None:
    made = rig(control=control())
    prepare(made.control)
    before = made.control.image
    with pytest.raises(kind) as caught:
        send(made.session())
    assert caught.value.at_control == "old"
    assert str(caught.value).endswith("nothing was replaced in the control")
    assert made.control.image == before
    assert not [name for name in made.control.memory.names() if name.startswith("staged-")], (
        "nothing is left over"
    )


def test_another_schema_is_refused_by_the_control_too(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    with pytest.raises(SignatureMismatchError):
        rig(control=control()).session().send(Replacement(NEW, OLD, "s2"))


def test_estop_released_before_the_commit(rig: Callable[..., Any], control: Callable[..., Any]) -> None:
    made = rig(control=control())

    def release(stage: str, done: int, total: int) -> None:
        if stage == "commit" and done == 0:
            made.control.set_estop(False)

    with pytest.raises(NotInEmergencyStopError) as caught:
        send(made.session(), progress=release)
    assert caught.value.at_control == "old"


def test_a_control_that_has_lost_what_was_staged_gets_it_again(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(control=control())
    lost = []

    def lose(stage: str, done: int, total: int) -> None:
        if stage == "download" and done > 60 and not lost:
            lost.append(done)
            made.control._staging.drop()

    send(made.session(), progress=lose)
    assert lost
    assert made.control.image == NEW


@pytest.mark.parametrize(("there", "at_control"), [(b"somebody's\n", "unknown"), (NEW, "new")])
def test_a_download_by_another_client_while_the_line_was_cut_is_not_claimed(
    rig: Callable[..., Any],
    control: Callable[..., Any],
    monkeypatch: pytest.MonkeyPatch,
    there: bytes,
    at_control: str,
) -> None:
    """The commit was sent and the line cut; when it is back, the control has committed for another client."""

    class Overtaken(Responder):
        def receive(self, data: bytes) -> bytes:
            answers = super().receive(data)
            if self.restart_due:
                self.control._record.committed = None
                self.control._activate(there)
                raise LinkError("null modem", "cut")
            return answers

    monkeypatch.setattr("tests.transfer.null_modem.Responder", Overtaken)
    with pytest.raises(ImageChangedError) as caught:
        send(rig(control=control()).session())
    assert caught.value.at_control == at_control


class Wrong(Responder):
    """A control that answers otherwise than it should: ``answers`` maps a request to its other answer."""

    answers: ClassVar[dict[type[Message], Callable[[Any], Message]]] = {}

    def _do(self, request: Message) -> Message:
        change = self.answers.get(type(request))
        answer = super()._do(request)
        return answer if change is None else change(answer)


@pytest.mark.parametrize(
    ("request_type", "change", "kind"),
    [
        (Hello, lambda welcome: replace(welcome, version=2), ProtocolMismatchError),
        (Hello, lambda welcome: replace(welcome, chunk=0), ProtocolMismatchError),
        (Hello, lambda welcome: replace(welcome, window=0), ProtocolMismatchError),
        (Hello, lambda welcome: replace(welcome, nonce=b"....", name="late"), ControlSilentError),
        (Hello, lambda _: Refused(Code.VERSION, "the control speaks version 2"), ProtocolMismatchError),
        (OpenUpload, lambda ready: replace(ready, size=1 << 31), ProtocolMismatchError),
        (OpenUpload, lambda ready: replace(ready, sha256=bytes(32)), ImageDamagedError),
        (OpenUpload, lambda _: Refused(99, "out of order today"), ProtocolMismatchError),
        (Read, lambda _: Refused(Code.NO_UPLOAD, "no upload is open"), ProtocolMismatchError),
        (Read, lambda data: replace(data, offset=data.offset + 1), ControlSilentError),
        (Read, lambda _: Ack(0), ControlSilentError),
    ],
)
def test_a_control_that_does_not_keep_to_the_protocol_is_not_believed(
    rig: Callable[..., Any],
    control: Callable[..., Any],
    monkeypatch: pytest.MonkeyPatch,
    request_type: type[Message],
    change: Callable[[Any], Message],
    kind: type[TransferError],
) -> None:
    monkeypatch.setattr("tests.transfer.null_modem.Responder", Wrong)
    monkeypatch.setattr(Wrong, "answers", {request_type: change})
    made = rig(control=control(), bytes_per_second=11_520)
    with pytest.raises(kind) as caught:
        upload(HouseDriver(made.session()))
    assert caught.value.at_control == "", "an upload replaces nothing, and need not say so"
    assert made.clock.now < 120


class Stuck(Responder):
    """A control that answers everything and gets nowhere."""

    def _data(self, data: Data) -> Message:
        return Gap(0)


def test_a_control_that_gets_nowhere_is_given_up(
    rig: Callable[..., Any], control: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tests.transfer.null_modem.Responder", Stuck)
    made = rig(control=control(), bytes_per_second=11_520)
    with pytest.raises(ControlSilentError):
        send(made.session())
    assert made.control.image == OLD
