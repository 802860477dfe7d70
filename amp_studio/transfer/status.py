"""What a control states of itself now: positions, following errors, states and faults;
asked for without changing anything.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol, runtime_checkable

from amp_studio.schema import load_schema


@dataclass(frozen=True)
class AxisStatus:
    """One axis; None for what the control does not show."""

    axis: str
    position: float | None = None
    following_error: float | None = None
    velocity: float | None = None
    unit: str = ""
    """Of position and following error; the velocity is in that a second."""
    states: tuple[str, ...] = ()
    """What it is doing, in the words of the manual."""
    known_states: tuple[str, ...] = ()
    """Every state that the control shows of an axis, on or off; those that are off are shown too."""
    raw: str = ""
    """The words of the control that this was read from; "" where they say no more."""

    def signals(self) -> dict[str, tuple[float | None, str]]:
        """Return each figure that can be recorded over the time with its unit; None where it is not shown."""
        return {
            "position": (self.position, self.unit),
            "velocity": (self.velocity, f"{self.unit}/s"),
            "following_error": (self.following_error, self.unit),
        }


@dataclass(frozen=True)
class ActiveFault:
    """A fault that is active, with what the family's manual has about it."""

    code: str
    text: str
    axis: str = ""
    means: str = ""
    causes: tuple[str, ...] = ()
    cures: tuple[str, ...] = ()
    params: tuple[str, ...] = ()
    page: str = ""


@dataclass(frozen=True)
class ControlStatus:
    """A control, now."""

    family: str
    protocol: str
    name: str
    state: str
    """In the control's own words; "" where it shows none."""
    axes: tuple[AxisStatus, ...] = ()
    faults: tuple[ActiveFault, ...] = ()
    values: Mapping[str, float | str] = field(default_factory=dict)
    """Further values by name: feed, spindle, inputs."""
    assumptions: tuple[str, ...] = ()
    """What of this is inferred or assumed."""
    not_known: Mapping[str, str] = field(default_factory=dict)
    """Signal -> why the control cannot show it; one without a reason is not asked for, or not stated."""
    raw: str = ""
    """The words of the control that this was read from; "" where they say no more."""


@runtime_checkable
class ShowsStatus(Protocol):
    """A driver that can ask for the status; it writes nothing that changes the control."""

    def status(self) -> ControlStatus:
        """Return what the control states now; raises TransferError."""


def known_fault(family: str, code: str, text: str, axis: str = "") -> ActiveFault:
    """Return a fault with what the family's messages have about it, found by its code or its text;
    a control without codes has the printed text in their place.
    """
    for message in load_schema(family).messages.values():
        if message.code == code or (message.text and message.text in (text, code)):
            return ActiveFault(
                code,
                (message.text if message.text != code else text) or message.title or text,
                axis,
                message.means,
                tuple(message.causes),
                tuple(message.cures),
                tuple(message.params),
                message.page,
            )
    return ActiveFault(code, text, axis)
