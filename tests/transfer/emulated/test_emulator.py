"""Emulated controls in processes of their own, over real lines: cut off, killed, full, silent."""

import hashlib
import json
import os
import socket
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from amp_studio.transfer.client.exchange import WantedContent, download, upload
from amp_studio.transfer.emulated.emulator import LINES, Emulator, serve
from amp_studio.transfer.errors import (
    CancelledError,
    ConnectionCutError,
    ControlBusyError,
    ControlFullError,
    ControlSilentError,
    NoConnectionError,
    NotInEmergencyStopError,
)
from amp_studio.transfer.exchange import Exchange, Replacement
from amp_studio.transfer.house.driver import HouseDriver
from amp_studio.transfer.house.frame import encode_frame
from amp_studio.transfer.house.message import Flags, Hello, pack
from amp_studio.transfer.house.retry_timer import RetryPolicy
from amp_studio.transfer.house.session import Session
from amp_studio.transfer.links import tcp
from amp_studio.transfer.links.endpoint import parse_endpoint
from amp_studio.transfer.links.link import LinkError
from amp_studio.transfer.links.opening import connect, listen
from tests.campaigns import CAMPAIGN, some
from tests.transfer.null_modem import VirtualClock

OLD = b"".join(b"%d\told.value.%d\t%d mm\n" % (n, n, n * 7) for n in range(400))
NEW = b"".join(b"%d\tnew.value.%d\t%d mm\n" % (n, n, n * 9) for n in range(1_400))[:32_768]

needs_pty = pytest.mark.skipif(not hasattr(os, "openpty"), reason="this system has no pseudo terminals")
KINDS = [pytest.param("tcp://127.0.0.1:0", id="tcp"), pytest.param("pty:", id="pty", marks=needs_pty)]
QUICK = RetryPolicy(first=0.1, least=0.05, most=0.3, tries=3)


OPEN: list[Session] = []


def session_at(address: str, **options: Any) -> Session:
    """Return a quick session; the test's end closes it."""
    place = parse_endpoint(address)
    OPEN.append(Session(lambda look: connect(place), policy=QUICK, **options))
    return OPEN[-1]


@pytest.fixture(autouse=True)
def close_sessions() -> Iterator[None]:
    yield
    while OPEN:
        OPEN.pop().close()


@pytest.fixture(autouse=True)
def short_pauses(monkeypatch: pytest.MonkeyPatch) -> None:
    """Call again sooner than a person would need it."""
    for pause in ("connection.PAUSE", "session.RESTART_PAUSE"):
        monkeypatch.setattr(f"amp_studio.transfer.house.{pause}", 0.03)


def keep(image: bytes) -> str:
    return "kept.amp"


@pytest.mark.parametrize("kind", KINDS)
def test_the_whole_exchange_over_a_real_line(emulate: Callable[..., Any], tmp_path: Path, kind: str) -> None:
    emulated = emulate(tmp_path, kind, initial=OLD.decode())
    with session_at(emulated.address, family="9pc") as session:
        assert upload(HouseDriver(session)) == OLD
        outcome = download(HouseDriver(session), WantedContent(NEW, "s1"), keep)
        assert (outcome.at_control, outcome.verified, outcome.restart) == ("new", True, "done")
        assert upload(HouseDriver(session)) == NEW
    assert emulated.next_line() == "restarted 2"
    assert emulated.operate("quit") == "bye"
    assert emulated.process.wait(60) == 0
    assert (tmp_path / "previous.img").read_bytes() == OLD
    assert not list(tmp_path.glob("staged-*"))


@pytest.mark.parametrize("kind", some(KINDS))
@pytest.mark.parametrize(
    "faults",
    [
        {"drop_after_bytes": 15_000},
        {"drop_after_bytes": 9_000, "drops": 6},
        {"corrupt_every": 5_003},
        {"lose_every": 7_001, "drop_after_bytes": 20_000},
    ],
    ids=str,
)
def test_a_bad_line_is_lived_through(
    emulate: Callable[..., Any], tmp_path: Path, kind: str, faults: dict[str, int]
) -> None:
    emulated = emulate(tmp_path, kind, faults=faults)
    with session_at(emulated.address) as session:
        outcome = download(HouseDriver(session), WantedContent(NEW, "s1"), keep)
    assert (outcome.at_control, outcome.verified) == ("new", True)
    assert (tmp_path / "active.img").read_bytes() == NEW


def test_a_download_goes_on_in_a_control_that_was_killed(emulate: Callable[..., Any], tmp_path: Path) -> None:
    """The process is killed when half the image is there; the next one, on another port, has that half."""
    emulated = [emulate(tmp_path, initial=OLD.decode())]
    staged: list[int] = []

    def open_link(look: Callable[[], None]) -> Any:
        if emulated[-1].is_dead:
            (part,) = tmp_path.glob("staged-*.part")
            staged.append(part.stat().st_size)
            emulated.append(emulate(tmp_path))
        return connect(parse_endpoint(emulated[-1].address))

    reported: list[int] = []

    def kill_at_half(stage: str, done: int, total: int) -> None:
        if stage == "download":
            reported.append(done)
            if done > total // 2 and len(emulated) == 1 and not emulated[0].is_dead:
                emulated[0].kill()

    with Session(open_link, policy=QUICK) as session:
        session.send(Replacement(NEW, OLD, "s1"), Exchange(kill_at_half))
    assert staged[0] > len(NEW) // 2
    assert staged[0] in reported, "it went on where the control said"
    assert (tmp_path / "active.img").read_bytes() == NEW


def test_a_control_killed_at_any_step_of_the_commit_contains_old_or_new(
    emulate: Callable[..., Any], tmp_path: Path
) -> None:
    """Each time the process kills itself at one step of the commit on the disk, and is started again."""
    stride = 1 if CAMPAIGN else 3
    step, died, seen = 1 - stride, True, []
    while died:
        step += stride
        folder = tmp_path / f"step-{step}"
        emulated = [
            emulate(folder, initial=OLD.decode(), faults={"die_at_commit_step": step}, restart_seconds=0.0)
        ]

        def open_link(look: Any, emulated: list[Any] = emulated, folder: Path = folder) -> Any:
            if emulated[-1].is_dead:
                at_control = (folder / "active.img").read_bytes()
                assert at_control in (OLD, NEW)
                seen.append(at_control)
                emulated.append(emulate(folder, restart_seconds=0.0))
            return connect(parse_endpoint(emulated[-1].address))

        with Session(open_link, policy=QUICK) as session:
            outcome = download(HouseDriver(session), WantedContent(NEW, "s1"), keep)
        died = len(emulated) > 1
        assert (outcome.at_control, outcome.verified) == ("new", True), f"step {step}"
        assert (folder / "previous.img").read_bytes() == OLD, f"step {step}"
        assert sorted(p.name for p in folder.iterdir()) == [
            ".control.holder",
            ".control.lock",
            "active.img",
            "control.json",
            "previous.img",
        ]
        emulated[-1].kill()
    assert step > 10
    assert seen == sorted(seen, reverse=True), "old until one step, new from then on"
    assert {OLD, NEW} == set(seen)


def test_a_control_that_stays_dead_after_the_commit_was_asked_for_is_unknown(
    emulate: Callable[..., Any], tmp_path: Path
) -> None:
    emulated = emulate(tmp_path, faults={"die_at_commit_step": 5})
    with session_at(emulated.address, patience=0.5) as session, pytest.raises(ConnectionCutError) as caught:
        download(HouseDriver(session), WantedContent(NEW, "s1"), keep)
    assert (caught.value.at_control, caught.value.kept) == ("unknown", "kept.amp")


def test_estop_is_what_the_operator_shows(emulate: Callable[..., Any], tmp_path: Path) -> None:
    emulated = emulate(tmp_path, estop=False)
    with session_at(emulated.address) as session:
        with pytest.raises(NotInEmergencyStopError):
            download(HouseDriver(session), WantedContent(NEW, "s1"), keep)
        assert emulated.operate("estop on") == "estop on"
        assert emulated.operate("autostart off") == "autostart off"
        outcome = download(HouseDriver(session), WantedContent(NEW, "s1"), keep)
        assert (outcome.verified, outcome.restart) == (True, "needed")
        assert emulated.operate("restart") == "restarting"
        assert emulated.next_line() == "restarted 2"
        assert not session_at(emulated.address).hello().flags & Flags.RESTART_NEEDED


def test_the_operator_patches_the_image_and_asks_for_the_state(
    emulate: Callable[..., Any], tmp_path: Path
) -> None:
    emulated = emulate(tmp_path, initial="1 0\n")
    assert emulated.operate("patch 11=5") == "patch 11=5"
    assert emulated.operate("patch 11=abc") == "refused: patch values are plain numbers"
    assert emulated.operate("estop off") == "estop off"
    assert "E-stop" in emulated.operate("patch 11=6")
    assert (
        emulated.operate("jump") == "refused: 'jump' is no command: "
        "estop on|off, autostart on|off, restart, patch KEY=VALUE, status, quit"
    )
    message = emulated.operate("status")
    digest = hashlib.sha256(b"1 0\n11 5\n").hexdigest()
    assert (
        message == "status estop=off running=on restart-needed=on autostart=on changed-at-control=on "
        f"incarnation=1 size=9 sha256={digest}"
    )
    assert upload(HouseDriver(session_at(emulated.address))) == b"1 0\n11 5\n"
    assert json.loads((tmp_path / "control.json").read_text())["changed_at_control"] is True


def test_a_full_control_shows_it(emulate: Callable[..., Any], tmp_path: Path) -> None:
    emulated = emulate(tmp_path, faults={"disk_full_at": 10_000})
    with (
        session_at(emulated.address) as session,
        pytest.raises(ControlFullError, match="nothing was replaced"),
    ):
        download(HouseDriver(session), WantedContent(NEW, "s1"), keep)


@pytest.mark.parametrize("kind", KINDS)
def test_a_silent_control_is_given_up(emulate: Callable[..., Any], tmp_path: Path, kind: str) -> None:
    emulated = emulate(tmp_path, kind, faults={"silent": True})
    with session_at(emulated.address) as session, pytest.raises(ControlSilentError):
        session.hello()


def test_a_cancel_is_heard_at_once(emulate: Callable[..., Any], tmp_path: Path) -> None:
    emulated = emulate(tmp_path, faults={"silent": True})
    cancel = threading.Event()
    timer = threading.Timer(0.2, cancel.set)
    start = time.monotonic()
    with Session.at(emulated.address) as session:
        timer.start()
        with pytest.raises(CancelledError):
            session.hello(Exchange(cancel=cancel))
    assert time.monotonic() - start < 15, "not the 20 s that a silence is waited for"


def test_a_second_client_is_turned_away_and_the_first_goes_on(
    emulate: Callable[..., Any], tmp_path: Path
) -> None:
    emulated = emulate(tmp_path)
    first, second = session_at(emulated.address), session_at(emulated.address)
    first.hello()
    with pytest.raises(ControlBusyError, match="another client has the control"):
        second.hello()
    first.hello()
    first.close()
    second.hello()
    second.close()


def test_a_client_that_has_long_been_silent_loses_the_line_to_the_next(
    new_control: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A client whose cable was pulled out is not seen to go."""
    monkeypatch.setattr("amp_studio.transfer.emulated.emulator.CLIENT_SILENCE", 0.05)
    listener = listen(parse_endpoint("tcp://127.0.0.1:0"))
    emulator = Emulator(new_control(), listener, say=lambda line: None)
    thread = threading.Thread(target=emulator.run)
    thread.start()
    try:
        gone = connect(listener.endpoint)
        gone.write(b"\x00")
        time.sleep(0.2)
        assert session_at(str(listener.endpoint)).hello().name == "CNC_1"
        with pytest.raises(LinkError):
            gone.read(5)
        gone.close()
    finally:
        emulator.operate("quit")
        thread.join(60)
        listener.close()


def test_clients_that_read_no_answers_do_not_keep_others_waiting(
    new_control: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each kept all others waiting for 3 s, one after the other: eight of them for 24 s."""
    clock, full = VirtualClock(), tcp.select.select

    def select(readers: list[Any], writers: list[Any], errors: list[Any], timeout: float) -> Any:
        if not writers:
            return full(readers, writers, errors, timeout)
        clock.sleep(timeout)  # there is room in no line
        return [], [], []

    listener = listen(parse_endpoint("tcp://127.0.0.1:0"))
    clients = [socket.create_connection(("127.0.0.1", listener.endpoint.port)) for _ in range(LINES)]
    for client in clients:
        client.sendall(encode_frame(pack(Hello(1, b"abcd", "does not read"), 1)))
    monkeypatch.setattr(tcp, "select", SimpleNamespace(select=select))
    monkeypatch.setattr(tcp, "time", SimpleNamespace(monotonic=lambda: clock.now, sleep=time.sleep))
    emulator = Emulator(new_control(), listener, say=lambda line: None)
    for _ in range(2 * LINES):
        emulator.turn()
    assert not emulator._callers, "each has been cut off"
    assert 0 < clock.now < 3, "s of waiting for eight of them"
    for client in clients:
        client.close()
    listener.close()


def test_serve_shows_where_it_listens_and_obeys(new_control: Callable[..., Any]) -> None:
    message: list[str] = []
    assert (
        serve(
            "tcp://127.0.0.1:0",
            new_control(),
            commands=["estop off", "", "patch 1=2", "quit"],
            say=message.append,
        )
        == 0
    )
    assert message[0].startswith("listening on tcp://127.0.0.1:")
    assert message[1:] == ["estop off", "refused: this control cannot be patched", "bye"]


def test_where_nothing_can_be_listened_on_serve_shows_it(new_control: Callable[..., Any]) -> None:
    with pytest.raises(ValueError, match="no address"):
        serve("somewhere", new_control())
    with pytest.raises(LinkError, match="no such port"):
        serve("serial:/dev/no-such-port", new_control())


@needs_pty
def test_a_new_client_on_a_serial_line_begins_again(emulate: Callable[..., Any], tmp_path: Path) -> None:
    """Nobody sees a serial client go; what it has left on the line does no harm to the next."""
    emulated = emulate(tmp_path, "pty:")
    link = connect(parse_endpoint(emulated.address))
    link.write(b"half a frame \x07\x99" * 20)
    link.close()
    with session_at(emulated.address) as session:
        assert download(HouseDriver(session), WantedContent(NEW, "s1"), keep).verified


def test_the_port_is_there_again_at_once_after_a_kill(emulate: Callable[..., Any], tmp_path: Path) -> None:
    emulated = emulate(tmp_path)
    session = session_at(emulated.address)
    session.hello()
    emulated.kill()
    again = emulate(tmp_path, emulated.address)
    assert again.address == emulated.address
    assert session.fetch().startswith(b"0\told"), "the session found the control again by itself"
    assert session.hello().incarnation == 2
    session.close()


def test_while_a_control_restarts_no_client_gets_through(emulate: Callable[..., Any], tmp_path: Path) -> None:
    emulated = emulate(tmp_path, restart_seconds=0.4)
    emulated.operate("restart")
    with pytest.raises((NoConnectionError, ControlSilentError)):
        session_at(emulated.address).hello()
    assert emulated.next_line() == "restarted 2"
    assert session_at(emulated.address).hello().incarnation == 2
