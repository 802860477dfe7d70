"""Reading a named path: a file of bounded size, or one sentence about what it is instead, at once."""

import os
import socket
from collections.abc import Callable
from pathlib import Path

import pytest

from amp_studio.schema.regular_file import read_file


def pipe(path: Path) -> None:
    """Make a named pipe, whose other end nobody opens."""
    os.mkfifo(path)


def listening(path: Path) -> None:
    """Make a socket."""
    with socket.socket(socket.AF_UNIX) as made:
        made.bind(str(path))


def test_a_file_is_read_as_it_is_also_through_links(tmp_path: Path) -> None:
    path, link = tmp_path / "a.amp", tmp_path / "link.amp"
    path.write_bytes(b"one\r\ntwo\x00\x1a\n")
    link.symlink_to(path)
    assert read_file(path) == read_file(link) == b"one\r\ntwo\x00\x1a\n"
    path.write_bytes(b"")
    assert read_file(path) == b""


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (pipe, "Is a named pipe, not a file"),
        (listening, "Is a socket, not a file"),
        (Path.mkdir, "Is a directory"),
        (lambda path: path.symlink_to("/dev/zero"), "Is a device, not a file"),
        (lambda path: path.symlink_to("/dev/tty"), "Is a device, not a file"),
        (lambda path: path.symlink_to(path), "Too many levels of symbolic links"),
        (lambda path: path.symlink_to("nowhere"), "No such file or directory"),
    ],
)
def test_what_is_not_a_file_is_reported_at_once(
    tmp_path: Path, make: Callable[[Path], object], message: str
) -> None:
    path = tmp_path / "a.amp"
    make(path)
    with pytest.raises(OSError, match=message) as error:
        read_file(path)
    assert (error.value.filename, error.value.strerror) == (str(path), message)


def test_a_pipe_that_takes_the_name_after_the_look_is_noticed_on_the_handle(
    tmp_path: Path, monkeypatch
) -> None:
    """Opening it does not wait either."""
    path, opened = tmp_path / "a.amp", os.open
    path.write_bytes(b"")

    def swapped(*arguments: object) -> int:
        path.unlink()
        os.mkfifo(path)
        return opened(*arguments)

    monkeypatch.setattr(os, "open", swapped)
    with pytest.raises(OSError, match="Is a named pipe"):
        read_file(path)


def test_a_file_larger_than_the_limit_is_not_taken_into_memory(tmp_path: Path) -> None:
    path = tmp_path / "a.amp"
    path.write_bytes(b"x" * 101)
    assert len(read_file(path, 101)) == 101
    with pytest.raises(OSError, match="Is larger than 100 bytes"):
        read_file(path, 100)
    assert read_file(path, 100, tail=True) == b"x" * 100
    os.truncate(path, 2**40)  # a file with a hole: a terabyte that is not on the disk
    with pytest.raises(OSError, match="Is larger than 16 MiB, the most that is read"):
        read_file(path)


def test_a_file_that_grows_while_it_is_read_ends_at_the_limit(tmp_path: Path, monkeypatch) -> None:
    path, read, asked = tmp_path / "a.amp", os.read, []
    path.write_bytes(b"x" * 10)

    def growing(handle: int, size: int) -> bytes:
        asked.append(size)
        with path.open("ab") as stream:
            stream.write(b"x" * 10)
        return read(handle, min(size, 10))

    monkeypatch.setattr(os, "read", growing)
    with pytest.raises(OSError, match="Is larger than 25 bytes"):
        read_file(path, 25)
    assert asked == [26, 16, 6]


def test_a_file_without_a_size_is_read_to_its_end() -> None:
    path = Path("/proc/self/status")
    if not path.exists():
        pytest.skip("a file of the Linux kernel")
    assert path.stat().st_size == 0
    assert b"\nUmask:" in read_file(path)


def test_a_companion_that_is_a_link_is_not_followed(tmp_path: Path) -> None:
    path, link = tmp_path / "secret", tmp_path / "link"
    path.write_bytes(b"secret")
    link.symlink_to(path)
    with pytest.raises(OSError, match="Is a link, not a file"):
        read_file(link, follow=False)
    assert read_file(path, follow=False) == b"secret"


def test_no_handle_stays_open_when_reading_fails(tmp_path: Path) -> None:
    path = tmp_path / "a.amp"
    path.write_bytes(b"x" * 101)
    free = os.dup(0)
    os.close(free)
    for _ in range(3):
        with pytest.raises(OSError, match="larger"):
            read_file(path, 100)
    assert os.dup(0) == free
    os.close(free)
