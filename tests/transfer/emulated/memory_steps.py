"""The power of an emulated control that goes off at a step of its memory."""

from amp_studio.transfer.emulated.memory import Memory


class PowerLoss(BaseException):
    """The power has gone: nothing of what the control does next happens."""


def lose_power_at(memory: Memory, step: int | None) -> None:
    """Have the power go just before a step on the disk, counted from 1; never for None."""
    left = step or 0

    def count(_: str) -> None:
        nonlocal left
        left -= 1
        if left == 0:
            raise PowerLoss

    memory.on_step = count if step else lambda _: None
