"""Encoders: counts of a turn, and how fast they may come."""

from __future__ import annotations

from amp_studio.validate import positive

CHANNEL_HZ = 250000.0
"""Maximum frequency of an encoder input, each channel (page A-1)."""


def counts_per_revolution(lines: float, quadrature: float) -> float:
    """Encoder counts of a turn, quadrature included (page 4-4):
    1000 lines with *4 are 4000 counts (page 4-48).
    """
    return positive("The lines of the encoder", lines) * _quadrature(quadrature)


def highest_count_rate(quadrature: float) -> float:
    """Counts/s that the encoder inputs can take, 250 kHz a channel (page A-1): 1000000 with *4 quadrature."""
    return CHANNEL_HZ * _quadrature(quadrature)


def unwind_constant(counts_per_turn: float, encoder_turns: float, axis_turns: float = 1.0) -> float:
    """Unwind constant: encoder counts of one revolution of the axis (page 4-19).

    Counts of a turn of the encoder times the turns it makes in ``axis_turns`` of the axis.
    """
    counts = positive("The counts of a turn", counts_per_turn) * positive(
        "The turns of the encoder", encoder_turns
    )
    return counts / positive("The turns of the axis", axis_turns)


def _quadrature(factor: float) -> float:
    if factor not in (1, 2, 4):
        raise ValueError(f"The quadrature must be 1, 2 or 4, not {factor!r}.")
    return factor
