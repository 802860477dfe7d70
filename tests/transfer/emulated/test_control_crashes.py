"""An emulated control whose power or disk fails at any step has the old image or the new one."""

import errno
from collections.abc import Callable
from pathlib import Path

import pytest

from amp_studio.transfer.emulated.control import Control
from amp_studio.transfer.emulated.record import Identity
from amp_studio.transfer.house.message import Code, Commit, Flags, RefusalError
from tests.campaigns import CAMPAIGN
from tests.transfer.emulated.images import LOCK, NEW, OLD, TRANSFER, download, opening, sha


class Died(BaseException):
    """The plug is pulled."""


@pytest.fixture
def make(new_control: Callable[..., Control]) -> Callable[..., Control]:
    return lambda folder=None, **options: new_control(folder, OLD, **options)


# -- crashes and faults of the disk at every step --------------------------------------------------


def spoil(control: Control, step: str) -> None:
    """Leave what a write that is cut in the middle leaves."""
    verb, _, name = step.rpartition(" ")
    if verb == "write":
        (control.memory.folder / name).write_bytes(b"{half of it")
    elif verb == "append to":
        with (control.memory.folder / name).open("ab") as stream:
            stream.write(NEW[control.staged_size : control.staged_size + 37])


def plug_at(control: Control, at: int) -> list[str]:
    """Pull the plug of a control at its ``at``-th step; return the list the steps are written to."""
    steps: list[str] = []

    def on_step(step: str) -> None:
        steps.append(step)
        if len(steps) == at:
            spoil(control, step)
            raise Died

    control.memory.on_step = on_step
    return steps


def test_pulling_the_plug_at_any_step_leaves_the_old_image_or_the_new(make: Callable[..., Control]) -> None:
    at, ended, committed_at = 0, False, []
    while not ended:
        at += 1
        control = make()
        folder = control.memory.folder
        steps = plug_at(control, at)
        try:
            download(control)
            control.restart()
            ended = True
        except Died:
            pass
        control.close()

        control = make(folder)
        assert control.image in (OLD, NEW), f"step {at}: {steps[-1]}"
        if control.image == NEW:
            committed_at.append(at)
        assert control.flags & Flags.ESTOP
        assert download(control).sha256 == sha(NEW), f"step {at}: the client asks again and gets there"
        control.restart()
        assert control.memory.read("previous.img") == OLD, f"step {at}: {steps[-1]}"
        assert control.memory.names() == [*LOCK, "active.img", "control.json", "previous.img"]
        control.close()
    assert at > 20
    assert committed_at == list(range(committed_at[0], at + 1)), "there is one moment a commit happens in"


def test_pulling_the_plug_while_starting_does_no_harm(make: Callable[..., Control]) -> None:
    """The recovery is attacked itself: died in the middle of a commit, then at each step of the start."""
    for died_at in range(1, 40, 1 if CAMPAIGN else 3):
        for at in range(1, 40):
            control = make()
            folder = control.memory.folder
            plug_at(control, died_at)
            try:
                download(control)
                control.close()
                return
            except Died:
                pass
            control.close()
            again = Control.__new__(Control)
            if start_and_die(again, folder, at):
                break
            control = make(folder)
            assert control.image in (OLD, NEW)
            assert download(control).sha256 == sha(NEW)
            assert control.memory.read("previous.img") == OLD
            control.close()


def start_and_die(control: Control, folder: Path, at: int) -> bool:
    """Start a control and pull its plug at a step; whether it got through."""
    from amp_studio.transfer.emulated import memory

    count = 0

    class Plugged(memory.Memory):
        def __init__(self, where: Path) -> None:
            super().__init__(where)
            self.on_step = self.step

        def step(self, step: str) -> None:
            nonlocal count
            count += 1
            if count == at:
                raise Died

    patch = pytest.MonkeyPatch()
    patch.setattr("amp_studio.transfer.emulated.control.Memory", Plugged)
    try:
        Control.__init__(control, folder, Identity("9pc", "s1", "CNC_1", "3.05"), OLD)
        control.close()
        return True
    except Died:
        return False
    finally:
        patch.undo()


@pytest.mark.parametrize("for_ever", [False, True], ids=["once", "from then on"])
def test_a_disk_that_fails_at_any_step_of_a_commit_gives_old_or_new_and_shows_which(
    make: Callable[..., Control], for_ever: bool
) -> None:
    at, failed = 0, True
    while failed:
        at += 1
        control = make()
        folder = control.memory.folder
        control.open_download(opening())
        control.stage(TRANSFER, NEW)
        count, failed = 0, False

        def on_step(step: str, at: int = at) -> None:
            nonlocal count, failed
            count += 1
            if count == at or (for_ever and count > at):
                failed = True
                raise OSError(errno.ENOSPC, "No space left on device")

        control.memory.on_step = on_step
        message, code = NEW, None
        try:
            control.commit(Commit(TRANSFER, sha(NEW)))
        except RefusalError as refusal:
            message, code = OLD, refusal.code
        assert code in (None, Code.STORAGE)
        assert control.image == message, f"step {at}"
        control.close()
        control = make(folder)
        assert control.image == message, f"step {at}: it is the same after the next start"
        assert download(control).sha256 == sha(NEW)
        assert control.memory.read("previous.img") == OLD, f"step {at}"
        control.close()
    assert at > 10


def test_a_full_disk_leaves_what_is_staged_as_it_was(make: Callable[..., Control]) -> None:
    control = make()
    control.memory.full_at = 200
    control.open_download(opening())
    control.stage(TRANSFER, NEW[:150])
    with pytest.raises(RefusalError) as caught:
        control.stage(TRANSFER, NEW[150:250])
    assert caught.value.code == Code.STORAGE
    assert control.staged_size == 150
    control.memory.full_at = None
    assert download(control).sha256 == sha(NEW)
