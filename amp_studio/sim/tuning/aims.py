"""What an axis is tuned for, in a word and in numbers. The numbers are choices of this program;
each result names them.
"""

from __future__ import annotations

from dataclasses import dataclass

from .loops import SOUND, LoopDemand


@dataclass(frozen=True)
class Aim:
    """One word."""

    name: str
    title: str
    need: LoopDemand
    """On the machine as it is taken to be."""
    spread: LoopDemand
    """With half and twice the inertia, without friction and with twice of it."""
    jolt: float
    """By which share of its full range one count of the feedback may move the output in a sample."""
    equal: bool = False
    """Whether all axes of a contour get the same position gain."""

    def text(self) -> str:
        """Return it as words."""
        equal = "; the position gain is that of the slowest axis" if self.equal else ""
        return (
            f"{self.title}: {self.need.text()}; with 0.5 to 2 times the inertia and 0 to 2 times the friction"
            f" {self.spread.text()}; a count of the feedback moves the output by up to {100.0 * self.jolt:g}"
            f" % of its range{equal}."
        )


_STIFF_SPREAD = LoopDemand(2.0, 30.0, 30.0, 6.0)

AIMS = {
    aim.name: aim
    for aim in (
        Aim("quiet", "Quiet", LoopDemand(1.4, 55.0, 50.0, 10.0, 0.9), SOUND, 0.02),
        Aim("normal", "Normal", LoopDemand(1.6, 45.0, 40.0, 8.0, 0.7), SOUND, 0.1),
        Aim("stiff", "Stiff", LoopDemand(1.6, 45.0, 40.0, 8.0, 0.5), _STIFF_SPREAD, 0.25),
        Aim("contour", "Contour", LoopDemand(1.6, 45.0, 40.0, 8.0, 0.9), SOUND, 0.1, equal=True),
    )
}
NORMAL = AIMS["normal"]
