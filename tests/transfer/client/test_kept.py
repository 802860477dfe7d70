"""What a control contained is kept byte for byte, whatever it is, under a name nobody has,
and checked before it goes back.
"""

import hashlib
import os
import subprocess
from pathlib import Path

import pytest

from amp_studio.files import Document, SaveError, new_file, open_file
from amp_studio.transfer.client import kept as kept_module
from amp_studio.transfer.client.kept import CopyError, digest_path, keep_image, open_copy, save_image
from amp_studio.transfer.image import encode_image

GARBAGE = b"\x00\xff no image\r\n"


def mill_image() -> bytes:
    return encode_image(new_file("9pc", "mill", ["X"]))


def foreign(image: bytes) -> bytes:
    """Return an image of another schema."""
    signature = image.split(b"\n")[2].removeprefix(b"signature ")
    return image.replace(signature, b"0" * 64)


@pytest.mark.parametrize("image", [GARBAGE, b"", b"\n" * 1000, foreign(mill_image()), mill_image()[:-1]])
def test_what_cannot_be_read_is_kept_as_it_is_with_its_digest(image: bytes, tmp_path: Path) -> None:
    """Garbage, nothing, another schema, an image that was cut off: no parameter file, every byte."""
    path = keep_image(image, tmp_path, "mill")

    assert path.read_bytes() == image
    assert digest_path(path).read_text() == f"{hashlib.sha256(image).hexdigest()}  {path.name}\n"
    assert sorted(tmp_path.iterdir()) == [path, digest_path(path)]
    copy = open_copy(path)
    assert (copy.image, copy.file, copy.is_checked, copy.is_kept) == (image, None, True, True)
    assert copy.fault


def test_a_readable_image_is_kept_as_a_parameter_file_too(tmp_path: Path) -> None:
    image = mill_image()

    path = keep_image(image, tmp_path, "mill")

    readable = path.with_suffix(".amp")
    assert encode_image(open_file(readable).file) == image
    assert path.read_bytes() == image
    for copy in (open_copy(path), open_copy(readable)):
        assert (copy.image, copy.is_kept, copy.fault) == (image, True, "")


def test_a_parameter_file_that_would_not_come_back_the_same_is_not_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The image alone is what the control contained."""
    content = kept_module.content_of
    monkeypatch.setattr(
        kept_module,
        "content_of",
        lambda file: content(file).replace(b"home.calibration@1: 0 mm", b"home.calibration@1: 1 mm"),
    )

    path = keep_image(mill_image(), tmp_path, "mill")

    assert sorted(tmp_path.iterdir()) == [path, digest_path(path)]


def test_names_never_clash_and_nothing_is_ever_overwritten(tmp_path: Path) -> None:
    """Copies of one second have names of their own, and a name of which only a part is taken is left
    alone.
    """
    first = keep_image(GARBAGE, tmp_path, "mill")
    stamp = first.name.removesuffix(".img")
    others = {"-2.img": b"mine", "-3.img.sha256": b"mine", "-4.amp": b"mine"}
    for ending in ("-5.img", "-6.img.sha256", "-7.amp"):
        (tmp_path / (stamp + ending)).symlink_to(tmp_path / "elsewhere")
    for ending, content in others.items():
        (tmp_path / (stamp + ending)).write_bytes(content)

    paths = {first} | {keep_image(image, tmp_path, "mill") for image in (GARBAGE, mill_image(), b"")}

    assert len(paths) == 4
    assert first.read_bytes() == GARBAGE
    assert not (tmp_path / "elsewhere").exists()
    for ending, content in others.items():
        assert (tmp_path / (stamp + ending)).read_bytes() == content


@pytest.mark.parametrize("stem", ["a" * 250, "é" * 125, "mill"])
def test_a_long_name_is_shortened_rather_than_not_kept(stem: str, tmp_path: Path) -> None:
    path = keep_image(mill_image(), tmp_path, stem)

    assert path.name.startswith(stem[:20])
    assert len(os.fsencode(digest_path(path).name)) < 200
    assert open_copy(path).is_checked


@pytest.mark.parametrize("broken", [".img", ".img.sha256"])
def test_a_copy_that_cannot_be_written_whole_leaves_nothing(
    broken: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A full disk at the image or at its digest: the download is not begun, and no half copy lies about."""
    real = kept_module.write_atomic

    def full(path: Path, *arguments: object, **options: object) -> object:
        if path.name.endswith(broken):
            raise SaveError("No space left on device")
        return real(path, *arguments, **options)

    monkeypatch.setattr(kept_module, "write_atomic", full)

    with pytest.raises(SaveError):
        keep_image(GARBAGE, tmp_path, "mill")

    assert list(tmp_path.iterdir()) == []


def test_sha256sum_agrees(tmp_path: Path) -> None:
    path = keep_image(GARBAGE, tmp_path, "mill")
    message = subprocess.run(
        ["sha256sum", "--check", "--strict", digest_path(path).name],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (message.returncode, message.stdout) == (0, f"{path.name}: OK\n")


@pytest.mark.parametrize(
    ("digest", "message"),
    [
        (b"0" * 64 + b"  x.img\n", "is not what was kept"),
        (b"junk", "contains no digest"),
        (b"", "contains no digest"),
        (b"\xff" * 64, "contains no digest"),
    ],
)
def test_a_copy_that_is_not_what_was_kept_is_refused(digest: bytes, message: str, tmp_path: Path) -> None:
    path = tmp_path / "x.img"
    save_image(GARBAGE, path)
    digest_path(path).write_bytes(digest)

    with pytest.raises(CopyError, match=message):
        open_copy(path)


def test_a_digest_that_is_there_and_cannot_be_read_is_not_none(tmp_path: Path) -> None:
    path = tmp_path / "x.img"
    save_image(GARBAGE, path)
    digest_path(path).unlink()
    digest_path(path).symlink_to("nowhere")
    with pytest.raises(CopyError, match=r"x\.img\.sha256 cannot be read"):
        open_copy(path)


def test_one_changed_byte_is_found(tmp_path: Path) -> None:
    path = keep_image(mill_image(), tmp_path, "mill")
    path.write_bytes(mill_image().replace(b"0 mm", b"1 mm", 1))
    with pytest.raises(CopyError, match="its digest is not the one in"):
        open_copy(path)


def test_without_a_digest_a_copy_goes_back_unchecked(tmp_path: Path) -> None:
    path = tmp_path / "previous.img"
    path.write_bytes(GARBAGE)
    assert not open_copy(path).is_checked


def test_an_edited_parameter_file_is_no_longer_what_was_kept(tmp_path: Path) -> None:
    """It may be downloaded like any other."""
    path = keep_image(mill_image(), tmp_path, "mill").with_suffix(".amp")
    with Document.open(path) as document:
        address = document.file.find("1300")
        document.file.set(address, document.file.read(address, "5 mm"))
        document.save()

    assert not open_copy(path).is_kept


@pytest.mark.parametrize("name", ["copy.bak", "copy", "copy.amp.bak"])
def test_what_is_no_copy_is_not_sent_to_a_control(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(GARBAGE)
    with pytest.raises(CopyError, match="is no copy of what a control contained"):
        open_copy(tmp_path / name)


def test_a_pipe_a_folder_and_an_endless_device_are_no_copy(tmp_path: Path) -> None:
    """None of them is waited for or read to its end."""
    os.mkfifo(tmp_path / "pipe.img")
    (tmp_path / "folder.img").mkdir()
    (tmp_path / "zero.img").symlink_to("/dev/zero")
    for name in ("pipe.img", "folder.img", "zero.img"):
        with pytest.raises(CopyError, match="cannot be read: Is a "):
            open_copy(tmp_path / name)


def test_an_image_that_cannot_be_written_leaves_no_empty_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def close(handle: int) -> None:
        shut(handle)
        raise OSError(5, "Input/output error")

    shut = os.close
    monkeypatch.setattr(os, "close", close)
    with pytest.raises(OSError, match="Input/output error"):
        save_image(GARBAGE, tmp_path / "new.img")
    monkeypatch.undo()
    assert list(tmp_path.iterdir()) == []
