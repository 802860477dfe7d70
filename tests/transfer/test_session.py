"""A session ends well over bad lines, and where it cannot, it says truly what the control holds."""

from __future__ import annotations

import hashlib
import random
import threading
from collections.abc import Callable
from dataclasses import replace
from typing import Any, ClassVar

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from amp_studio.transfer import (
    Cancelled,
    ControlBusy,
    ControlFull,
    ControlSilent,
    Faults,
    Flags,
    ImageChanged,
    ImageDamaged,
    ImageRejected,
    LineCut,
    LinkError,
    NoConnection,
    NotInEmergencyStop,
    ProtocolMismatch,
    Session,
    SignatureMismatch,
    TransferError,
    WrongFamily,
    upload,
)
from amp_studio.transfer.frame import Frame, encode_frame
from amp_studio.transfer.message import Ack, Code, Data, Gap, Hello, Message, OpenUpload, Read, Refused, pack
from amp_studio.transfer.responder import Responder

OLD = b"1 old\n" * 20
NEW = b"2 new!\n" * 25


def sha(image: bytes) -> bytes:
    return hashlib.sha256(image).digest()


def send(session: Session, image: bytes = NEW, **options: Any) -> Any:
    return session.send(image, signature="s1", expected=sha(OLD), **options)


@pytest.fixture
def control(new_control: Callable[..., Any]) -> Callable[..., Any]:
    return lambda **options: new_control(initial=OLD, **options)


def test_a_hello_tells_who_the_control_is(rig: Callable[..., Any], control: Callable[..., Any]) -> None:
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


def test_progress_is_told_to_the_last_byte(rig: Callable[..., Any], control: Callable[..., Any]) -> None:
    told: list[tuple[str, int, int]] = []
    session = rig(control=control()).session()
    session.fetch(lambda *step: told.append(step))
    send(session, progress=lambda *step: told.append(step))
    for stage, total in (("upload", len(OLD)), ("download", len(NEW)), ("commit", 1)):
        steps = [done for name, done, _ in told if name == stage]
        assert steps == sorted(steps)
        assert steps[-1] == total
        assert {of for name, _, of in told if name == stage} == {total}


def test_an_empty_image_is_an_image_too(rig: Callable[..., Any], new_control: Callable[..., Any]) -> None:
    session = rig(control=new_control(initial=b"")).session()
    assert session.fetch() == b""
    session.send(NEW, signature="s1", expected=sha(b""))
    session.wait_restarted(1, 10)
    session.send(b"", signature="s1", expected=sha(NEW))
    session.wait_restarted(2, 10)
    assert session.fetch() == b""


# -- bad lines -------------------------------------------------------------------------------------


def test_a_line_cut_at_any_byte_is_made_again_and_the_download_done(
    rig: Callable[..., Any], new_control: Callable[..., Any]
) -> None:
    cut_at, was_cut, resumed = -1, True, 0
    while was_cut:
        cut_at += 1
        made = rig(Faults(drop_after_bytes=cut_at), control=new_control(initial=OLD))
        sent = send(made.session())
        was_cut = made.modem.lines > 1
        resumed += sent.reconnections > 1
        assert made.control.image == NEW, f"cut at byte {cut_at}"
        assert made.control.memory.read("previous.img") == OLD
        assert made.control.incarnation <= 2, "one commit, one restart"
        made.control.close()
    assert cut_at > 500, "the whole exchange was cut through"
    assert resumed > 400


def test_a_line_cut_at_any_byte_for_good_ends_with_the_truth(
    rig: Callable[..., Any], new_control: Callable[..., Any]
) -> None:
    cut_at, was_cut, ends = -1, True, set()
    while was_cut:
        cut_at += 1
        made = rig(Faults(drop_after_bytes=cut_at), control=new_control(initial=OLD), lines=1)
        try:
            send(made.session())
            held = "new"
            was_cut = False
        except LineCut as error:
            held = error.held
        truth = {OLD: "old", NEW: "new"}[made.control.image]
        assert held in {truth, "unknown"}, f"cut at byte {cut_at}: said {held}, and it is {truth}"
        ends.add((held, truth))
        made.control.close()
    assert ends == {("old", "old"), ("unknown", "old"), ("unknown", "new"), ("new", "new")}


def test_a_line_that_is_cut_again_and_again_still_gets_there(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(Faults(drop_after_bytes=480, drops=0), control=control())
    send(made.session(), NEW * 6)
    assert made.control.image == NEW * 6
    assert made.modem.lines > 5


def test_an_upload_goes_on_with_what_has_come(
    rig: Callable[..., Any], new_control: Callable[..., Any]
) -> None:
    image = random.Random(5).randbytes(20_000)
    made = rig(
        Faults(drop_after_bytes=6_000, drops=0), control=new_control(initial=image), bytes_per_second=11_520
    )
    told: list[int] = []
    assert made.session().fetch(lambda stage, done, total: told.append(done)) == image
    assert made.modem.lines > 3
    assert told == sorted(told), "nothing was read twice"


@pytest.mark.parametrize("latency", [0.0, 0.016])
@pytest.mark.parametrize(
    "faults",
    [
        Faults(corrupt_every=1_009),
        Faults(corrupt_every=331),
        Faults(corrupt_every=211, drop_after_bytes=700),
        Faults(lose_every=401),
        Faults(lose_every=503, corrupt_every=307),
    ],
    ids=str,
)
def test_dirty_lines_give_the_exact_image(
    rig: Callable[..., Any], control: Callable[..., Any], faults: Faults, latency: float
) -> None:
    image = random.Random(3).randbytes(4_000)
    made = rig(faults, control=control(), bytes_per_second=11_520, latency=latency, patience=120)
    session = made.session()
    send(session, image)
    session.wait_restarted(1, 60)
    assert session.fetch() == image


def test_a_hopeless_line_ends_in_time_and_with_the_truth(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(Faults(corrupt_every=13), control=control(), patience=20)
    with pytest.raises(ControlSilent) as caught:
        send(made.session())
    assert caught.value.held == "old"
    assert "nothing was replaced" in str(caught.value)
    assert made.control.image == OLD
    assert made.clock.now < 60


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(chance=st.randoms(use_true_random=False), one_in=st.integers(60, 2_000))
def test_noise_of_any_kind_never_gives_a_wrong_image(
    rig: Callable[..., Any], new_control: Callable[..., Any], chance: random.Random, one_in: int
) -> None:
    made = rig(control=new_control(initial=OLD), bytes_per_second=11_520, patience=30)
    connect = made.modem.connect

    class Noisy:
        """A link on which bytes change, vanish and appear, and which is cut now and then."""

        bytes_per_second = 11_520.0

        def __init__(self) -> None:
            self._link = connect()

        def read(self, timeout: float) -> bytes:
            return self._spoil(self._link.read(timeout))

        def write(self, data: bytes) -> None:
            self._link.write(self._spoil(data))

        def close(self) -> None:
            self._link.close()

        def _spoil(self, data: bytes) -> bytes:
            out = bytearray()
            for byte in data:
                if chance.randrange(one_in):
                    out.append(byte)
                elif (what := chance.randrange(4)) == 0:
                    out.append(chance.randrange(256))
                elif what == 1:
                    out += bytes((byte, chance.randrange(256)))
                elif what == 2:
                    raise LinkError("noise", "cut")
            return bytes(out)

    made.modem.connect = Noisy
    try:
        send(made.session())
        said = "new"
    except TransferError as error:
        said = error.held
    truth = {OLD: "old", NEW: "new"}[made.control.image]
    made.control.close()
    assert said in {truth, "unknown"}


def test_a_download_fills_the_line(rig: Callable[..., Any], control: Callable[..., Any]) -> None:
    """32 KiB at 115200 bit/s: at least nine tenths of the line, and 85 % with 16 ms each way."""
    image = random.Random(1).randbytes(32_768)
    for latency, least in ((0.0, 0.90), (0.016, 0.85)):
        made = rig(control=control(), bytes_per_second=11_520, latency=latency, window=16, chunk=512)
        session = made.session()
        session.hello()
        send(session, image)
        assert len(image) / 11_520 / made.clock.now >= least
        made.control.close()


# -- controls that do not do what they are asked ---------------------------------------------------


def test_nothing_listens(rig: Callable[..., Any], control: Callable[..., Any]) -> None:
    with pytest.raises(NoConnection, match="nothing was replaced"):
        rig(control=control(), lines=0).session().hello()


def test_a_silent_control_is_given_up_soon(rig: Callable[..., Any], control: Callable[..., Any]) -> None:
    made = rig(Faults(silent=True), control=control())
    with pytest.raises(ControlSilent, match="does not answer"):
        made.session().hello()
    assert made.clock.now < 6


def test_another_family_is_not_touched(rig: Callable[..., Any], control: Callable[..., Any]) -> None:
    with pytest.raises(WrongFamily, match="is a 9pc, not a num"):
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
    with pytest.raises(ProtocolMismatch, match=r"another control answers.*CNC_2"):
        send(session)
    assert other.control.image == OLD


@pytest.mark.parametrize(
    ("prepare", "kind"),
    [
        (lambda control: control.set_estop(False), NotInEmergencyStop),
        (lambda control: control.patch(lambda image: image + b"x"), ImageChanged),
        (lambda control: setattr(control.memory, "full_at", 100), ControlFull),
        (lambda control: setattr(control, "_capacity", 100), ControlFull),
        (lambda control: setattr(control, "_accept", int), ImageRejected),
    ],
)
def test_a_refusal_becomes_an_error_that_says_nothing_was_replaced(
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
    assert caught.value.held == "old"
    assert str(caught.value).endswith("nothing was replaced in the control")
    assert made.control.image == before
    assert not [name for name in made.control.memory.names() if name.startswith("staged-")], (
        "nothing is left over"
    )


def test_another_schema_is_refused_by_the_control_too(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    with pytest.raises(SignatureMismatch):
        rig(control=control()).session().send(NEW, signature="s2", expected=sha(OLD))


def test_a_full_control_is_said_to_be_full_on_a_dirty_line_too(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(Faults(corrupt_every=211), control=control())
    made.control.memory.full_at = 100
    with pytest.raises(ControlFull, match="cannot store"):
        send(made.session())


def test_estop_released_before_the_commit(rig: Callable[..., Any], control: Callable[..., Any]) -> None:
    made = rig(control=control())

    def release(stage: str, done: int, total: int) -> None:
        if stage == "commit" and done == 0:
            made.control.set_estop(False)

    with pytest.raises(NotInEmergencyStop) as caught:
        send(made.session(), progress=release)
    assert caught.value.held == "old"


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


def test_a_control_that_begins_anew_unnoticed_is_asked_again(
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
            responder = session._line._talk.link._link._responder
            responder._copy = responder._transfer = None

    assert session.fetch(forget) == OLD * 5
    assert reached == sorted(reached), "nothing was read twice"
    reached.clear()
    session.send(NEW * 3, signature="s1", expected=sha(OLD * 5), progress=forget)
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


@pytest.mark.parametrize(("there", "held"), [(b"somebody's\n", "unknown"), (NEW, "new")])
def test_a_download_by_another_client_while_the_line_was_cut_is_not_claimed(
    rig: Callable[..., Any],
    control: Callable[..., Any],
    monkeypatch: pytest.MonkeyPatch,
    there: bytes,
    held: str,
) -> None:
    """The commit was sent and the line cut; when it is back, the control has committed for another client."""

    class Overtaken(Responder):
        def receive(self, data: bytes) -> bytes:
            answers = super().receive(data)
            if self.restart_due:
                self.control._record.committed = None
                self.control._take(there)
                raise LinkError("null modem", "cut")
            return answers

    monkeypatch.setattr("amp_studio.transfer.null_modem.Responder", Overtaken)
    with pytest.raises(ImageChanged) as caught:
        send(rig(control=control()).session())
    assert caught.value.held == held


class OnlyInOrder(Responder):
    """A control that keeps no early pieces, as the page allows."""

    def _data(self, data: Data) -> Message:
        staged = self.control.staged_size
        return Gap(staged) if data.offset > staged else super()._data(data)


def test_a_control_that_keeps_nothing_early_is_served_too(
    rig: Callable[..., Any], control: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("amp_studio.transfer.null_modem.Responder", OnlyInOrder)
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
    monkeypatch.setattr("amp_studio.transfer.null_modem.Responder", Stuck)
    made = rig(control=control(), bytes_per_second=11_520)
    with pytest.raises(ControlSilent):
        send(made.session())
    assert made.control.image == OLD


class Wrong(Responder):
    """A control that answers otherwise than it should: ``answers`` maps a request to what it says instead."""

    answers: ClassVar[dict[type[Message], Callable[[Any], Message]]] = {}

    def _do(self, request: Message) -> Message:
        change = self.answers.get(type(request))
        answer = super()._do(request)
        return answer if change is None else change(answer)


@pytest.mark.parametrize(
    ("request_type", "change", "kind"),
    [
        (Hello, lambda welcome: replace(welcome, version=2), ProtocolMismatch),
        (Hello, lambda welcome: replace(welcome, chunk=0), ProtocolMismatch),
        (Hello, lambda welcome: replace(welcome, window=0), ProtocolMismatch),
        (Hello, lambda welcome: replace(welcome, nonce=b"....", name="late"), ControlSilent),
        (Hello, lambda _: Refused(Code.VERSION, "the control speaks version 2"), ProtocolMismatch),
        (OpenUpload, lambda ready: replace(ready, size=1 << 31), ProtocolMismatch),
        (OpenUpload, lambda ready: replace(ready, sha256=bytes(32)), ImageDamaged),
        (OpenUpload, lambda _: Refused(99, "out of order today"), ProtocolMismatch),
        (Read, lambda _: Refused(Code.NO_UPLOAD, "no upload is open"), ProtocolMismatch),
        (Read, lambda data: replace(data, offset=data.offset + 1), ControlSilent),
        (Read, lambda _: Ack(0), ControlSilent),
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
    monkeypatch.setattr("amp_studio.transfer.null_modem.Responder", Wrong)
    monkeypatch.setattr(Wrong, "answers", {request_type: change})
    made = rig(control=control(), bytes_per_second=11_520)
    with pytest.raises(kind) as caught:
        upload(made.session())
    assert caught.value.held == "old"
    assert made.clock.now < 120


def test_messages_of_a_later_version_are_passed_over(
    rig: Callable[..., Any], control: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    class Talkative(Responder):
        def receive(self, data: bytes) -> bytes:
            return encode_frame(Frame(0xE0, 1, b"news")) + super().receive(data)

    monkeypatch.setattr("amp_studio.transfer.null_modem.Responder", Talkative)
    assert rig(control=control()).session().fetch() == OLD


class Busy(Responder):
    """A control that another client has."""

    def receive(self, data: bytes) -> bytes:
        return encode_frame(pack(Refused(Code.BUSY, "another client has the control"), 0))


def test_a_busy_control_is_said_to_be_busy(
    rig: Callable[..., Any], control: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("amp_studio.transfer.null_modem.Responder", Busy)
    made = rig(control=control())
    with pytest.raises(ControlBusy, match="another client"):
        made.session().hello()
    with pytest.raises(ControlBusy, match="another client"):
        send(made.session())
    assert 20 <= made.clock.now < 30, "it was tried again until patience ended"


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

    with pytest.raises(Cancelled) as caught:
        send(made.session(), cancel=cancel, progress=halfway)
    assert caught.value.held == "old"
    assert str(caught.value) == "cancelled; nothing was replaced in the control"
    assert made.control.image == OLD
    assert not [name for name in made.control.memory.names() if name.startswith("staged-")]
    assert made.clock.now - cancelled_at[0] < 0.6


def test_a_cancel_of_an_upload_and_of_a_waiting_session(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    cancel = threading.Event()
    cancel.set()
    made = rig(control=control())
    with pytest.raises(Cancelled):
        made.session().fetch(cancel=cancel)
    made = rig(Faults(silent=True), control=control())
    with pytest.raises(Cancelled):
        made.session().hello(cancel)
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

    with pytest.raises(KeyboardInterrupt):
        send(made.session(), progress=interrupt)
    assert not [name for name in made.control.memory.names() if name.startswith("staged-")]


def test_a_restart_is_asked_for_and_waited_for(rig: Callable[..., Any], control: Callable[..., Any]) -> None:
    made = rig(control=control(autostart=False))
    session = made.session()
    sent = send(session)
    assert not sent.committed.restarting
    assert session.status().flags & Flags.RESTART_NEEDED
    ended = session.restart()
    welcome = session.wait_restarted(ended, 10)
    assert welcome.incarnation == 2
    assert not welcome.flags & Flags.RESTART_NEEDED
    made.control.set_estop(False)
    with pytest.raises(NotInEmergencyStop):
        session.restart()


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
