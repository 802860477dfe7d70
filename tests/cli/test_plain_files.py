"""send and receive carry any file, and end with a code and a sentence that say what has arrived."""

import socket
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.cli.verbs.controls import receive, send
from amp_studio.transfer.links.endpoint import Endpoint
from amp_studio.transfer.links.tcp import TcpLink
from amp_studio.transfer.plain.files import RECEIVING, SENDING
from amp_studio.transfer.plain.line import ByteLine, Patience
from amp_studio.transfer.plain.receiver import BlockReceiver
from amp_studio.transfer.plain.sender import BlockSender
from amp_studio.transfer.plain.ymodem import PlainFile, receive_batch, send_batch

Serve = Callable[[ByteLine], object]


@pytest.fixture
def other_end() -> Iterator[Callable[[Serve], tuple[str, list[object]]]]:
    """Give a function that serves one caller and returns the address, and where its result comes."""
    threads = []

    def serve(end: Serve) -> tuple[str, list[object]]:
        listening, results = socket.create_server(("127.0.0.1", 0)), list[object]()

        def answer() -> None:
            with listening:
                link = TcpLink(Endpoint("tcp"), listening.accept()[0])
                results.append(end(ByteLine(link, Patience(start=60, quiet=0.02))))
                link.close()

        threads.append(threading.Thread(target=answer))
        threads[-1].start()
        return f"tcp://127.0.0.1:{listening.getsockname()[1]}", results

    yield serve
    for thread in threads:
        thread.join(60)


def receive_xmodem(line: ByteLine) -> bytes:
    receiver = BlockReceiver(line)
    content = receiver.receive(None)
    receiver.finish()
    return content


def test_a_file_is_sent_and_received(
    other_end: Callable[[Serve], tuple[str, list[object]]], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "plan.txt").write_bytes(b"N1 G0\n" * 50)
    address, got = other_end(receive_xmodem)
    assert run(["send", str(tmp_path / "plan.txt"), "--to", address, "--protocol", "xmodem-1k"]) == 0
    assert "plan.txt: 300 bytes sent, and every block acknowledged" in capsys.readouterr().out

    def send(line: ByteLine) -> None:
        sender = BlockSender(line, long_blocks=False)
        sender.await_start()
        sender.send(b"N1 G0\n" * 50)

    address, _ = other_end(send)
    assert run(["receive", "--from", address, "-o", str(tmp_path / "back.txt")]) == 0
    assert (tmp_path / "back.txt").read_bytes() == b"N1 G0\n" * 50
    reported = capsys.readouterr()
    assert reported.out == f"{tmp_path / 'back.txt'}: 300 bytes\n"
    assert "84 bytes 1Ah at its end were taken for padding" in reported.err
    assert run(["receive", "--from", address, "-o", str(tmp_path / "back.txt")]) == 2, (
        "nothing is overwritten"
    )
    assert got[0] == (b"N1 G0\n" * 50).ljust(384, b"\x1a")


def test_ymodem_carries_several_files_into_a_folder_under_harmless_names(
    other_end: Callable[[Serve], tuple[str, list[object]]], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = [PlainFile("../../evil.txt", b"one"), PlainFile("b.txt", b"")]

    def send(line: ByteLine) -> None:
        send_batch(BlockSender(line, long_blocks=True), files)

    folder = tmp_path / "in"
    folder.mkdir()
    address, _ = other_end(send)
    assert run(["receive", "--from", address, "-o", str(folder), "--protocol", "ymodem"]) == 0
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == {"evil.txt": b"one", "b.txt": b""}
    assert "evil.txt: 3 bytes (sent as ../../evil.txt)" in capsys.readouterr().out
    address, _ = other_end(send)
    assert run(["receive", "--from", address, "-o", str(tmp_path / "one"), "--protocol", "ymodem"]) == 2
    assert "has sent 2 files: give a folder" in capsys.readouterr().err
    assert not (tmp_path / "one").exists()
    address, got = other_end(receive_batch)
    texts = [str(folder / "evil.txt"), str(folder / "b.txt")]
    assert run(["send", *texts, "--to", f"{address}?protocol=ymodem"]) == 0
    assert run(["send", *texts, "--to", address]) == 2
    for _ in range(3000):
        if got:
            break
        threading.Event().wait(0.02)
    assert got == [[PlainFile("evil.txt", b"one"), PlainFile("b.txt", b"")]]


def test_a_broken_transfer_shows_how_much_has_arrived(
    other_end: Callable[[Serve], tuple[str, list[object]]], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "plan.txt").write_bytes(bytes(300))

    def leave(line: ByteLine) -> None:
        line.put(b"C")
        line.get(133, 5)
        line.put(b"\x06")
        line.get(133, 5)
        line.put(b"\x18\x18\x18")

    address, _ = other_end(leave)
    assert run(["send", str(tmp_path / "plan.txt"), "--to", address]) == 4
    reported = capsys.readouterr().err
    assert (
        "the other end has given the transfer up; 128 of 300 bytes were acknowledged: look at the control"
        in reported
    )

    address, _ = other_end(lambda line: line.put(b"C") and line.get(133, 5) and line.put(b"\x18\x18"))
    assert run(["send", str(tmp_path / "plan.txt"), "--to", address]) == 4, "a block was on the line"
    assert "; 0 of 300 bytes were acknowledged" in capsys.readouterr().err
    address, _ = other_end(lambda line: line.put(b"\x18\x18"))
    assert run(["send", str(tmp_path / "plan.txt"), "--to", address]) == 2, "nothing has arrived"
    assert run(["send", str(tmp_path / "plan.txt"), "--to", "tcp://127.0.0.1:1"]) == 2
    address, _ = other_end(lambda line: line.put(b"\x01\x01\xfe"))
    assert run(["receive", "--from", address, "-o", str(tmp_path / "new.txt")]) == 2
    assert not (tmp_path / "new.txt").exists()


def test_raw_text_goes_with_marks_and_leader(
    other_end: Callable[[Serve], tuple[str, list[object]]], tmp_path: Path
) -> None:
    (tmp_path / "plan.txt").write_bytes(b"N1\n")
    address, got = other_end(lambda line: line.get(13, 5))
    raw = ["--protocol", "raw", "--percent", "--leader", "3"]
    assert run(["send", str(tmp_path / "plan.txt"), "--to", address, *raw]) == 0
    address, _ = other_end(lambda line: line.put(b"\0\0\0%\nN1\n%\n\0\0\0"))
    assert run(["receive", "--from", address, "-o", str(tmp_path / "new.txt"), *raw]) == 0
    assert (tmp_path / "new.txt").read_bytes() == b"%\nN1\n%\n"
    assert got == [b"\0\0\0%\nN1\n%\n\0\0\0"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["send", "missing", "--to", "tcp://127.0.0.1:1"], "missing"),
        (["send", "plan.txt", "--to", "here"], "no address"),
        (["send", "plan.txt", "--to", "/dev/ttyS0?bits=7"], "XMODEM needs 8 data bits and no XON/XOFF"),
        (
            ["send", "plan.txt", "--to", "/dev/ttyS0?protocol=zmodem"],
            "Unknown protocol 'zmodem' of a plain file",
        ),
        (
            ["send", "odd.txt", "--to", "/dev/ttyS0?bits=7", "--protocol", "raw"],
            "line 2 contains the byte B5h",
        ),
        (["send", "x" * 120, "--to", "tcp://127.0.0.1:1", "--protocol", "ymodem"], "it has 100 at most"),
        (["receive", "--from", "tcp://127.0.0.1:1", "-o", "."], "is a folder, and xmodem carries no name"),
        (["receive", "--from", "tcp://127.0.0.1:1", "-o", "x", "--wait", "0"], "no number of seconds"),
        (["send", "plan.txt", "--to", "tcp://127.0.0.1:1", "--leader", "-3"], "--leader"),
    ],
)
def test_what_cannot_be_sent_is_refused_before_anything_is_opened(
    arguments: list[str],
    message: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("plan.txt").write_bytes(b"x")
    Path("x" * 120).write_bytes(b"x")
    Path("odd.txt").write_bytes(b"N1\n10 \xb5m\n")
    assert run(arguments) == 2
    assert message in capsys.readouterr().err


def test_the_parser_offers_every_protocol_of_plain_files() -> None:
    assert (send.PROTOCOLS, receive.PROTOCOLS) == (SENDING, RECEIVING)
