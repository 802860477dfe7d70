"""Masks of a file, or of a copy, at a control of another build: for which bits they speak.

A build with more axes has more bits in a mask of axes, and a newer one has more bits in others. Those that
the source does not have stay as the control has them; an axis may run backwards if they are cleared.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from amp_studio.schema import MachineSchema, Parameter

from .settings import addresses_by_number

MaskBits = Mapping[int, Mapping[int, str]]
"""Number of a mask -> bit -> its label."""


@dataclass(frozen=True)
class Build:
    """What decides the bits of masks: the schema of a file or a control,
    and the letters of its axes in their order.
    """

    here: MachineSchema
    axes: Sequence[str]

    def masks(self) -> dict[int, Parameter]:
        """Return number -> parameter of each word of bits."""
        every = ((n, self.here.parameters[a[0]]) for n, a in addresses_by_number(self.here).items())
        return {n: p for n, p in every if p.type == "bits"}

    def labels(self, parameter: Parameter) -> dict[int, str]:
        """Return bit -> label of the bits that a mask has in this build."""
        first = parameter.first_axis
        if first is None:
            return {bit.bit: bit.label for bit in parameter.bits or ()}
        # A mask of rotary axes begins with the fourth axis: its bit 0 is A.
        return {n - first: self.axes[n] for n in range(first, len(self.axes))}


def bits_beyond(build: Build, other: Build, *, axes_only: bool = False) -> dict[int, dict[int, str]]:
    """Return number -> bit -> label of the bits that ``build`` has and the same mask of ``other`` does
    not.
    """
    theirs = other.masks()
    found: dict[int, dict[int, str]] = {}
    for number, parameter in build.masks().items():
        same = theirs.get(number)
        if same is None or (axes_only and parameter.first_axis is None):
            continue
        known = other.labels(same)
        if more := {bit: label for bit, label in build.labels(parameter).items() if bit not in known}:
            found[number] = more
    return found


def with_bits(text: str, bits: Mapping[int, str], reported: str) -> str:
    """Return the text of a mask with these bits as another text has them;
    itself where one of them is no number.
    """
    if not text.isdecimal() or not reported.isdecimal():
        return text
    mask = sum(1 << bit for bit in bits)
    return str(int(text) & ~mask | int(reported) & mask)


def set_bits(text: str, bits: Mapping[int, str]) -> dict[int, str]:
    """Return those of these bits that are set in the text of a mask."""
    return {bit: label for bit, label in bits.items() if text.isdecimal() and int(text) >> bit & 1}


def named_bits(labels: MaskBits) -> str:
    """Return which bits of which masks: ``A, B in $3, $4; Mist in $15``."""
    masks: dict[tuple[str, ...], list[int]] = {}
    for number, bits in sorted(labels.items()):
        masks.setdefault(tuple(bits.values()), []).append(number)
    return "; ".join(
        f"{', '.join(bits)} in {', '.join(f'${n}' for n in numbers)}" for bits, numbers in masks.items()
    )
