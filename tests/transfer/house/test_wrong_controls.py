"""Controls that refuse, that are silent, stuck or busy, that forget, or that do not keep to the protocol."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any, ClassVar

import pytest

from amp_studio.transfer.client.exchange import upload
from amp_studio.transfer.emulated.faults import Faults
from amp_studio.transfer.emulated.responder import Responder
from amp_studio.transfer.errors import (
    ControlBusyError,
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
from amp_studio.transfer.exchange import Exchange, Replacement
from amp_studio.transfer.house.driver import HouseDriver
from amp_studio.transfer.house.frame import Frame, encode_frame
from amp_studio.transfer.house.message import (
    Ack,
    Code,
    Data,
    Gap,
    Hello,
    Message,
    OpenUpload,
    Read,
    Refused,
    pack,
)
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
            session._line._transaction.link.close()

    with pytest.raises(ProtocolMismatchError) as caught:
        send(session, progress=move_the_cable)
    assert caught.value.at_control == "unknown"


def test_a_line_begins_with_the_end_of_whatever_was_there_before(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(control=control())
    connect = made.modem.connect

    def after_garbage() -> Any:
        link = connect()
        link.write(b"half a frame")
        return link

    made.modem.connect = after_garbage
    made.session().hello()
    assert made.clock.now == 0, "the first Hello was understood"


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


def test_a_full_control_is_shown_to_be_full_on_a_dirty_line_too(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(Faults(corrupt_every=211), control=control())
    made.control.memory.full_at = 100
    with pytest.raises(ControlFullError, match="cannot store"):
        send(made.session())


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


def test_a_control_that_begins_again_unnoticed_is_asked_again(
    rig: Callable[..., Any], new_control: Callable[..., Any]
) -> None:
    """On a serial line nobody sees the other end go: it just does not know of anything open any more."""
    made = rig(control=new_control(initial=OLD * 5))
    session = made.session()
    session.hello()
    forgotten, reached = [], []

    def forget(stage: str, done: int, total: int) -> None:
        reached.append(done)
        if done > total // 3 and stage not in forgotten:
            forgotten.append(stage)
            responder = session._line._transaction.link._link._responder
            responder._copy = responder._transfer = None

    assert session.fetch(Exchange(forget)) == OLD * 5
    assert reached == sorted(reached), "nothing was read twice"
    reached.clear()
    send(session, NEW * 3, OLD * 5, progress=forget)
    assert forgotten == ["upload", "download", "commit"]
    assert made.control.image == NEW * 3
    assert made.modem.lines == 1


def test_staged_bytes_that_rot_are_noticed_and_sent_again(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(control=control())
    rotten = []

    def rot(stage: str, done: int, total: int) -> None:
        if stage == "commit" and done == 0 and not rotten:
            (part,) = made.control.memory.folder.glob("staged-*.part")
            part.write_bytes(b"?" * len(NEW))
            rotten.append(part)

    send(made.session(), progress=rot)
    assert rotten
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


class OnlyInOrder(Responder):
    """A control that keeps no early pieces, as the page allows."""

    def _data(self, data: Data) -> Message:
        staged = self.control.staged_size
        return Gap(staged) if data.offset > staged else super()._data(data)


def test_a_control_that_keeps_nothing_early_is_served_too(
    rig: Callable[..., Any], control: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tests.transfer.null_modem.Responder", OnlyInOrder)
    made = rig(Faults(corrupt_every=307), control=control(), bytes_per_second=11_520)
    send(made.session())
    assert made.control.image == NEW


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


def test_messages_of_a_later_version_are_passed_over(
    rig: Callable[..., Any], control: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    class Talkative(Responder):
        def receive(self, data: bytes) -> bytes:
            return encode_frame(Frame(0xE0, 1, b"news")) + super().receive(data)

    monkeypatch.setattr("tests.transfer.null_modem.Responder", Talkative)
    assert rig(control=control()).session().fetch() == OLD


class Busy(Responder):
    """A control that another client has."""

    def receive(self, data: bytes) -> bytes:
        return encode_frame(pack(Refused(Code.BUSY, "another client has the control"), 0))


def test_a_busy_control_is_shown_to_be_busy(
    rig: Callable[..., Any], control: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tests.transfer.null_modem.Responder", Busy)
    made = rig(control=control())
    with pytest.raises(ControlBusyError, match="another client"):
        made.session().hello()
    with pytest.raises(ControlBusyError, match="another client"):
        send(made.session())
    assert 20 <= made.clock.now < 30, "it was tried again until patience ended"
