"""What the parameters and bits of an ACR card show of its axes now (pages 107, 113 and 114)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from amp_studio.transfer import ActiveFault, AxisStatus, ControlIdentity, ControlStatus, known_fault

ENCODER, ENCODER_STEP = 6144, 16
"""Parameter of the encoder position of the first axis, and from one axis to the next (page 114)."""
PRIMARY, SECONDARY, SETPOINT_STEP = 12294, 12295, 256
"""Setpoints of the first axis, before and behind backlash and ballscrew compensation (page 107)."""
NOT_EXCESS, BIT_STEP = 769, 32
"""Bit for not excess error of the first axis (page 113)."""
INFERRED = (
    "inferred: setpoints 256 parameters apart from axis to axis (page 107 prints those of the first);"
    " assumed: setpoints in pulses, a set bit is shown as -1, and ? shows a bit as it shows a parameter"
)


@dataclass(frozen=True)
class CardAxis:
    """What a card shows of one axis: pulses for a unit, encoder position and setpoints in pulses,
    and whether its error is below EXC.
    """

    axis: str
    pulses: float
    encoder: float
    primary: float
    secondary: float
    is_within: bool


def status_of(identity: ControlIdentity, unit: str, axes: list[CardAxis]) -> ControlStatus:
    """Return the status of a card."""
    return ControlStatus(
        identity.family,
        identity.protocol,
        identity.name,
        "",
        tuple(_axis(each, unit) for each in axes),
        tuple(fault for each in axes for fault in _faults(each)),
        assumptions=(INFERRED,),
    )


def _axis(figures: CardAxis, unit: str) -> AxisStatus:
    """Return the reading of an axis in its unit, or in pulses; the compensation is a state."""
    # Without PPU the figures stay pulses.
    scale, compensation = figures.pulses or 1.0, figures.secondary - figures.primary
    states = () if abs(compensation) < 1.0 else (f"compensation {compensation:g} pulses",)
    return AxisStatus(
        figures.axis,
        figures.encoder / scale,
        (figures.secondary - figures.encoder) / scale,
        unit=unit if figures.pulses else "pulses",
        states=states,
    )


def _faults(figures: CardAxis) -> Iterator[ActiveFault]:
    if not figures.is_within:
        yield known_fault("acromill", "EXCESS ERROR", "Excess error", figures.axis)
