"""A download that is stopped at any moment reports truly what the control contains;
a commit is answered for in 20 s.
"""

import threading
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import pytest

from amp_studio.transfer.client.exchange import WantedContent, download, upload
from amp_studio.transfer.emulated.faults import Faults
from amp_studio.transfer.emulated.responder import Responder
from amp_studio.transfer.errors import CancelledError, ConnectionCutError, ControlSilentError, TransferError
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.house.driver import HouseDriver
from amp_studio.transfer.house.message import Commit
from amp_studio.transfer.progress import Stop
from tests.transfer.images import NEW, OLD, send


class SetAfter(Stop):
    """Is set when it has been asked so often; ``is_urgent`` as given."""

    def __init__(self, asks: int, *, urgent: bool = False) -> None:
        super().__init__()
        self.left = asks
        self.is_urgent = urgent

    def is_set(self) -> bool:
        self.left -= 1
        return self.left < 0


def keep(image: bytes) -> str:
    return "kept.amp"


@pytest.mark.parametrize("urgent", [False, True])
def test_a_download_stopped_at_any_moment_shows_what_the_control_contains(
    rig: Callable[..., Any], new_control: Callable[..., Any], urgent: bool
) -> None:
    ends: set[tuple[str, str]] = set()
    asks, was_stopped = 0, True
    while was_stopped:
        made = rig(control=new_control(initial=OLD), bytes_per_second=2_000, latency=0.02)
        cancel = SetAfter(asks, urgent=urgent)
        try:
            at_control = download(
                HouseDriver(made.session()), WantedContent(NEW, "s1"), keep, Exchange(cancel=cancel)
            ).at_control
            was_stopped = False
        except CancelledError as error:
            at_control, message = error.at_control, str(error)
        if was_stopped:
            assert message.startswith("stopped")
            assert ("nothing was replaced" in message) == (at_control == "old")
            assert ("kept in kept.amp" in message) == (at_control != "old")
        truth = {OLD: "old", NEW: "new"}[made.control.image]
        assert at_control in {truth, "unknown"}, f"asked {asks} times: said {at_control}, and it is {truth}"
        if at_control == "old":
            assert not [name for name in made.control.memory.names() if name.startswith("staged-")]
        ends.add((at_control, truth))
        made.control.close()
        asks += 1
    assert asks > 40
    assert {("old", "old"), ("new", "new")} <= ends
    assert any(at_control == "unknown" for at_control, _ in ends) == urgent, (
        "asked once, the commit is seen through"
    )


def test_a_keyboard_interrupt_after_the_commit_shows_that_the_new_image_is_there(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(control=control())

    def interrupt(stage: str, done: int, total: int) -> None:
        if stage == "verify":
            raise KeyboardInterrupt

    with pytest.raises(CancelledError) as caught:
        download(HouseDriver(made.session()), WantedContent(NEW, "s1"), keep, Exchange(interrupt))
    assert (caught.value.at_control, caught.value.kept) == ("new", "kept.amp")
    assert made.control.image == NEW


@pytest.mark.parametrize("stage", ["keep", "download", "commit", "restart", "verify"])
def test_a_closed_output_ends_no_exchange(
    rig: Callable[..., Any], control: Callable[..., Any], stage: str
) -> None:
    """A closed standard error broke a download off and left the control in whatever state it was."""

    def closed(reported: str, done: int, total: int) -> None:
        if reported == stage:
            raise BrokenPipeError

    made = rig(control=control())
    assert download(HouseDriver(made.session()), WantedContent(NEW, "s1"), keep, Exchange(closed)).verified


# -- a commit without an answer --------------------------------------------------------------------


class NoAnswerToCommit(Responder):
    """Takes the commit, and is silent from then on; ``does_it`` decides whether the commit happens."""

    does_it = False

    def answer(self, frame: Any) -> bytes:
        if frame.type == Commit.TYPE:
            if self.does_it:
                super().answer(frame)
            self.is_unresponsive = True
        return b"" if getattr(self, "is_unresponsive", False) else super().answer(frame)

    def receive(self, data: bytes) -> bytes:
        self.restart_due = False
        out = b"".join(self.answer(frame) for frame in self.frames(data))
        self.restart_due = False
        return out


@pytest.fixture
def unresponsive(
    rig: Callable[..., Any], control: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> Callable[..., Any]:
    """Give a function that connects with a control that never answers to a commit."""

    def make(*, does_it: bool, lines: int = 1_000_000) -> Any:
        monkeypatch.setattr("tests.transfer.null_modem.Responder", NoAnswerToCommit)
        monkeypatch.setattr(NoAnswerToCommit, "does_it", does_it)
        return rig(control=control(), lines=lines)

    return make


@pytest.mark.parametrize("does_it", [False, True])
@pytest.mark.parametrize("lines", [1, 2, 1_000_000])
def test_an_unanswered_commit_is_given_up_within_20_seconds(
    unresponsive: Callable[..., Any], does_it: bool, lines: int
) -> None:
    """It took 68.8 s: the timeouts of the commit alone add up to 62."""
    made = unresponsive(does_it=does_it, lines=lines)
    asked: list[float] = []

    def note(stage: str, done: int, total: int) -> None:
        if stage == "commit" and not asked:
            asked.append(made.clock.now)

    with pytest.raises(TransferError) as caught:
        download(HouseDriver(made.session()), WantedContent(NEW, "s1"), keep, Exchange(note))
    assert 19.9 <= made.clock.now - asked[0] <= 20.2
    assert isinstance(caught.value, ControlSilentError if lines > 2 else ConnectionCutError)
    assert caught.value.at_control == "unknown"
    assert "verify before you go on" in str(caught.value)
    assert "kept in kept.amp" in str(caught.value)


@pytest.mark.parametrize(("twice", "least", "most"), [(False, 4.9, 5.2), (True, 0.0, 0.2)])
def test_who_stops_while_the_commit_is_not_answered_waits_5_seconds_and_not_at_all_if_asked_twice(
    unresponsive: Callable[..., Any], twice: bool, least: float, most: float
) -> None:
    made = unresponsive(does_it=True)
    cancel = Stop()
    stopped_at: list[float] = []

    def stop(stage: str, done: int, total: int) -> None:
        if stage == "silent" and not stopped_at:
            stopped_at.append(made.clock.now)
            cancel.set()
            if twice:
                cancel.set()

    with pytest.raises(CancelledError, match="stopped before the control has answered") as caught:
        download(HouseDriver(made.session()), WantedContent(NEW, "s1"), keep, Exchange(stop, cancel))
    assert caught.value.at_control == "unknown"
    assert least <= made.clock.now - stopped_at[0] <= most
    assert made.control.image == NEW


# -- silence is shown ------------------------------------------------------------------------------


def silences(made: Any, reported: list[tuple[float, str, int]]) -> Callable[[str, int, int], None]:
    return lambda stage, done, total: reported.append((made.clock.now, stage, done))


def test_a_silent_control_is_reported_within_2_seconds(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(Faults(silent=True), control=control())
    reported: list[tuple[float, str, int]] = []
    with pytest.raises(ControlSilentError):
        upload(HouseDriver(made.session()), Exchange(silences(made, reported)))
    assert [(stage, seconds) for _, stage, seconds in reported] == [
        ("silent", 2),
        ("silent", 3),
        ("silent", 4),
    ]
    assert 1.7 < reported[0][0] <= 2.0


def test_a_line_that_is_not_made_is_reported_within_2_seconds(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    """Nobody answers to the first packet of a connection, and it is waited for 3 s."""
    made = rig(control=control())
    open_link = made.open_link

    def slowly(look: Callable[[], None]) -> Any:
        for _ in range(25):
            look()
            made.clock.sleep(0.1)
        return open_link(look)

    made.open_link = slowly
    reported: list[tuple[float, str, int]] = []
    assert upload(HouseDriver(made.session()), Exchange(silences(made, reported))) == OLD
    assert reported[0][1:] == ("silent", 2)
    assert reported[0][0] <= 2.0
    assert reported[1][1:] == ("silent", 0), "and it is told that this is over"
    assert [stage for _, stage, _ in reported[2:]] == ["upload"] * (len(reported) - 2)


def test_a_line_that_falls_silent_in_the_middle_is_reported_and_when_it_is_there_again(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(control=control(), bytes_per_second=2_000)
    reported: list[tuple[float, str, int]] = []
    fallen_silent: list[float] = []
    session = made.session()

    def note(stage: str, done: int, total: int) -> None:
        reported.append((made.clock.now, stage, done))
        if stage == "download" and done > 60 and not fallen_silent:
            fallen_silent.append(made.clock.now)
            link = session._line._transaction.link
            link.read = lambda timeout: made.clock.sleep(timeout) or b""

    send(session, progress=note)
    stages = [(stage, done) for _, stage, done in reported]
    assert ("silent", 2) in stages
    assert reported[stages.index(("silent", 2))][0] - fallen_silent[0] <= 2.0
    assert ("silent", 0) in stages[stages.index(("silent", 2)) :]


def test_a_control_that_restarts_is_not_called_silent(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(control=control())
    made.modem._restart_seconds = 9.0
    reported: list[tuple[float, str, int]] = []
    outcome = download(
        HouseDriver(made.session()), WantedContent(NEW, "s1"), keep, Exchange(silences(made, reported))
    )
    assert outcome.verified
    restarting = [at for at, stage, _ in reported if stage == "restart"]
    assert all(later - earlier <= 2.0 for earlier, later in pairwise(restarting))
    assert not [stage for _, stage, _ in reported if stage == "silent"]


def test_a_cancel_ends_the_wait_for_a_connection(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(control=control())
    cancel = threading.Event()

    def never(look: Callable[[], None]) -> Any:
        for _ in range(30):
            look()
            made.clock.sleep(0.1)
            cancel.set()
        raise AssertionError("it went on waiting")

    made.open_link = never
    with pytest.raises(CancelledError):
        made.session().hello(Exchange(cancel=cancel))
