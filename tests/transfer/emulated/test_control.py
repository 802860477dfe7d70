"""An emulated control contains its old image or the new one, whatever happens to its disk and whenever."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from amp_studio.transfer.emulated.control import Control
from amp_studio.transfer.emulated.record import Identity, StateError
from amp_studio.transfer.house.message import Code, Commit, Committed, Flags, OpenDownload, RefusalError
from tests.transfer.emulated.images import LOCK, NEW, OLD, TRANSFER, download, opening, sha


@pytest.fixture
def make(new_control: Callable[..., Control]) -> Callable[..., Control]:
    return lambda folder=None, **options: new_control(folder, OLD, **options)


def test_a_new_control_is_in_estop_and_restarts_by_itself(make: Callable[..., Control]) -> None:
    control = make()
    assert control.flags == Flags.ESTOP | Flags.RUNNING | Flags.AUTOSTART
    assert (control.image, control.boot_count) == (OLD, 1)


def test_a_download_replaces_the_image_and_keeps_the_one_before(make: Callable[..., Control]) -> None:
    control = make()
    assert download(control) == Committed(TRANSFER, sha(NEW), 1, True)
    assert control.image == NEW
    assert control.flags & Flags.RESTART_NEEDED
    assert not control.flags & Flags.RUNNING, "the CNC is stopped until the restart"
    control.restart()
    assert not control.flags & Flags.RESTART_NEEDED
    assert control.memory.read("previous.img") == OLD
    assert control.memory.names() == [*LOCK, "active.img", "control.json", "previous.img"]


def test_what_it_contains_and_its_state_outlive_the_process(make: Callable[..., Control]) -> None:
    control = make()
    folder = control.memory.folder
    download(control)
    control.set_autostart(False)
    control.set_estop(False)
    control.close()
    control = make(folder)
    assert control.image == NEW
    assert control.flags == Flags.RUNNING, "not in E-stop, no autostart, and a start makes the image current"
    assert control.boot_count == 2
    control.close()
    assert make(folder, estop=True).flags & Flags.ESTOP, "the panel can be set again at the start"


def test_a_download_is_taken_up_after_a_restart(make: Callable[..., Control]) -> None:
    control = make()
    control.open_download(opening())
    control.stage(TRANSFER, NEW[:150])
    control.close()
    control = make(control.memory.folder)
    assert control.open_download(opening()) == 150
    assert download(control).sha256 == sha(NEW)


@pytest.mark.parametrize(
    ("asked_for", "code"),
    [
        (opening(signature="s2"), Code.SIGNATURE),
        (opening(old=b"another"), Code.IMAGE_CHANGED),
        (OpenDownload(TRANSFER, 1 << 30, sha(NEW), sha(OLD), "s1"), Code.TOO_LARGE),
    ],
)
def test_what_a_download_is_refused_for(
    make: Callable[..., Control], asked_for: OpenDownload, code: Code
) -> None:
    with pytest.raises(RefusalError) as caught:
        make().open_download(asked_for)
    assert caught.value.code == code


def test_estop_is_needed_to_begin_and_to_commit(make: Callable[..., Control]) -> None:
    control = make(estop=False)
    with pytest.raises(RefusalError) as caught:
        control.open_download(opening())
    assert caught.value.code == Code.NOT_IN_ESTOP
    control.set_estop(True)
    control.open_download(opening())
    control.stage(TRANSFER, NEW)
    control.set_estop(False)
    with pytest.raises(RefusalError) as caught:
        control.commit(Commit(TRANSFER, sha(NEW)))
    assert caught.value.code == Code.NOT_IN_ESTOP
    assert control.image == OLD


def test_a_change_at_the_control_before_the_commit_is_noticed(make: Callable[..., Control]) -> None:
    control = make()
    control.open_download(opening())
    control.stage(TRANSFER, NEW)
    control.patch(lambda image: image + b"11 = 5\n")
    assert control.flags & Flags.CHANGED_AT_CONTROL
    with pytest.raises(RefusalError) as caught:
        control.commit(Commit(TRANSFER, sha(NEW)))
    assert caught.value.code == Code.IMAGE_CHANGED
    assert control.image == OLD + b"11 = 5\n"


def test_a_commit_asked_for_again_is_answered_again(make: Callable[..., Control]) -> None:
    control = make()
    first = download(control)
    control.restart()
    control.close()
    control = make(control.memory.folder, estop=False)
    assert control.commit(Commit(TRANSFER, sha(NEW))) == first, "after two restarts, and out of E-stop"
    assert control.open_download(opening()) == len(NEW)
    assert control.memory.read("previous.img") == OLD, "it happened once"


def test_bytes_that_are_missing_or_wrong_are_not_committed(make: Callable[..., Control]) -> None:
    control = make()
    control.open_download(opening())
    control.stage(TRANSFER, NEW[:100])
    with pytest.raises(RefusalError) as caught:
        control.commit(Commit(TRANSFER, sha(NEW)))
    assert caught.value.code == Code.INCOMPLETE
    control.stage(TRANSFER, b"?" * (len(NEW) - 100))
    with pytest.raises(RefusalError) as caught:
        control.commit(Commit(TRANSFER, sha(NEW)))
    assert caught.value.code == Code.DIGEST
    assert control.open_download(opening()) == 0, "the spoilt bytes are gone"
    with pytest.raises(RefusalError) as caught:
        control.stage(TRANSFER, NEW + b"!")
    assert caught.value.code == Code.OUT_OF_RANGE


def test_a_control_may_look_into_the_image(make: Callable[..., Control]) -> None:
    def accept(image: bytes) -> None:
        raise ValueError("record 3 is damaged")

    control = make(accept=accept)
    with pytest.raises(RefusalError, match="record 3") as caught:
        download(control)
    assert caught.value.code == Code.REJECTED
    assert control.image == OLD


def refuse(image: bytes) -> None:
    raise ValueError("nobody can read it")


def test_a_control_takes_back_whatever_it_has_kept(make: Callable[..., Control]) -> None:
    """Under any signature and unread, also after a restart; what it has not contained it reads."""
    control = make()
    download(control)
    folder = control.memory.folder
    control.close()
    control = make(folder, accept=refuse)

    control.open_download(opening(OLD, NEW, b"b" * 16, signature=""))
    control.stage(b"b" * 16, OLD)
    control.commit(Commit(b"b" * 16, sha(OLD)))

    assert control.image == OLD
    with pytest.raises(RefusalError, match="has not contained this image") as caught:
        control.open_download(opening(b"other", OLD, b"c" * 16, signature=""))
    assert caught.value.code == Code.SIGNATURE
    control.open_download(opening(b"other", OLD, b"c" * 16))
    control.stage(b"c" * 16, b"other")
    with pytest.raises(
        RefusalError, match="has not contained this image and does not take it: nobody can read it"
    ):
        control.commit(Commit(b"c" * 16, sha(b"other")))


def test_a_control_remembers_what_was_keyed_in_and_what_lay_in_its_memory(
    make: Callable[..., Control],
) -> None:
    """Every image that was active at some time counts as contained."""
    control = make()
    control.patch(lambda image: b"patched")
    folder = control.memory.folder
    control.close()
    (folder / "active.img").write_bytes(b"laid there")
    control = make(folder, accept=refuse)

    for image in (OLD, b"patched"):
        assert control.open_download(opening(image, b"laid there", sha(image)[:16], signature="")) == 0
    download_back = opening(b"laid there", b"laid there", b"d" * 16, signature="")
    assert control.open_download(download_back) == 0


def test_the_memory_of_images_does_not_grow_for_ever(make: Callable[..., Control]) -> None:
    control = make()
    for number in range(150):
        control.patch(lambda image, n=number: b"%d" % n)
    record = json.loads((control.memory.folder / "control.json").read_bytes())
    assert len(record["images"]) == 100
    assert record["images"][-1] == sha(b"149").hex()


def test_a_memory_of_an_earlier_program_is_taken_over(make: Callable[..., Control]) -> None:
    """It knows only the image it contains."""
    control = make()
    folder = control.memory.folder
    control.close()
    record = json.loads((folder / "control.json").read_bytes())
    del record["images"]
    (folder / "control.json").write_text(json.dumps(record))
    assert make(folder).open_download(opening(OLD, OLD, signature="")) == 0


@pytest.mark.parametrize("images", [5, "x", None, {}])
def test_a_damaged_memory_of_images_is_reported(images: object, make: Callable[..., Control]) -> None:
    control = make()
    folder = control.memory.folder
    control.close()
    record = json.loads((folder / "control.json").read_bytes())
    (folder / "control.json").write_text(json.dumps(record | {"images": images}))
    with pytest.raises(StateError, match="is not what an emulated control writes"):
        make(folder)


def test_only_one_download_is_kept_and_an_abort_ends_it(make: Callable[..., Control]) -> None:
    control = make()
    control.open_download(opening())
    control.stage(TRANSFER, NEW[:100])
    assert control.open_download(opening(transfer=bytes(16))) == 0
    assert len([name for name in control.memory.names() if name.startswith("staged-")]) == 2
    control.abort(bytes(16))
    control.abort(b"unknown to it...")
    assert not [name for name in control.memory.names() if name.startswith("staged-")]
    download(control)
    with pytest.raises(RefusalError) as caught:
        control.abort(TRANSFER)
    assert caught.value.code == Code.ALREADY_COMMITTED


def test_what_belongs_to_no_download_is_removed_at_the_start(
    make: Callable[..., Control], tmp_path: Path
) -> None:
    control = make(tmp_path)
    control.open_download(opening())
    control.close()
    (tmp_path / "staged-00.part").write_bytes(b"left over")
    (tmp_path / "active.img.tmp").write_bytes(b"left over")
    control = make(tmp_path)
    note, part = f"staged-{TRANSFER.hex()}.json", f"staged-{TRANSFER.hex()}.part"
    assert control.memory.names() == [*LOCK, "active.img", "control.json", note, part]


def test_a_folder_belongs_to_one_control(make: Callable[..., Control], tmp_path: Path) -> None:
    control = make(tmp_path)
    with pytest.raises(StateError, match="control is open in another program"):
        make(tmp_path)
    control.close()
    for identity, message in (
        (Identity("num", "s1"), "memory of a 9pc"),
        (Identity("9pc", "s2"), "another parameter schema"),
    ):
        with pytest.raises(StateError, match=message):
            Control(tmp_path, identity)
    (tmp_path / "control.json").write_text("{")
    with pytest.raises(StateError, match="damaged"):
        make(tmp_path)
