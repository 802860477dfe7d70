"""What the registers of a module show of its axes now (pages 4-34 to 4-41)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from amp_studio.transfer import ActiveFault, AxisStatus, ControlIdentity, ControlStatus, known_fault

from .content import AXIS_Y

MODE, STATUS, FAULT, POSITION, VELOCITY, ERROR, PERIOD = 65, 72, 73, 74, 78, 80, 83
SHOWN = ((MODE, 1), (STATUS, 12))
"""First register and how many are read."""
SCAN = 0.00125
"""s"""
STATES = {
    0: "axis done",
    1: "axis locked",
    2: "axis busy",
    5: "home sequence complete",
    6: "auto tuning complete",
    7: "control loop enabled",
    8: "feedback registration sensed",
    9: "gearing registration sensed",
    10: "gearing marker sensed",
    15: "command acknowledge",
}
"""Bits of register 72; 0, 8 to 10 and 15 are printed, the others follow from the order of section 4.37."""
FAULTS = {
    0: "Overtravel",
    3: "Drive fault",
    4: "Maximum position error exceeded",
    5: "Maximum velocity error exceeded",
    6: "Feedback fault",
    7: "Output clamped",
    8: "Illegal command",
    9: "System fault",
}
"""Bits of register 73; 4 and 5 are printed, and that 7 is no fault;
the others follow from the order of section 4.38."""
INFERRED = (
    "inferred: the bits of registers 72 and 73 but 0, 8, 9, 10, 15 and 4, 5, by the order of sections 4.37"
    " and 4.38; figures 4.36 and 4.37 are lost."
)


@dataclass(frozen=True)
class AxisRegisters:
    """Registers of one axis that were read together, by the first of each run;
    ``is_latched`` whether positions are of now.
    """

    axis: str
    is_latched: bool
    words: Mapping[int, Sequence[int]]

    def word(self, register: int) -> int:
        """Return a register."""
        first = max(each for each in self.words if each <= register)
        return self.words[first][register - first]

    def signed(self, register: int, words: int) -> int:
        """Return a number of one or two words with its sign."""
        whole = 0
        for n in range(words):
            whole = whole << 16 | self.word(register + n)
        return whole - (1 << 16 * words) if whole >> (16 * words - 1) else whole


def status_of(identity: ControlIdentity, axes: Sequence[AxisRegisters]) -> ControlStatus:
    """Return the status of a module."""
    notes = [INFERRED]
    notes += [
        f"The positions of axis {each.axis} are those of the last latch: a command of another program is in"
        " its register 66 or 67."
        for each in axes
        if not each.is_latched
    ]
    return ControlStatus(
        identity.family,
        identity.protocol,
        identity.name,
        "",
        tuple(map(_axis, axes)),
        tuple(fault for each in axes for fault in _faults(each)),
        assumptions=tuple(notes),
    )


def _axis(registers: AxisRegisters) -> AxisStatus:
    """Return the reading of an axis in counts and counts/s, with its raw words."""
    status, scans = registers.word(STATUS), max(registers.word(PERIOD), 1)
    return AxisStatus(
        registers.axis,
        float(registers.signed(POSITION, 2)),
        float(registers.signed(ERROR, 1)),
        registers.signed(VELOCITY, 2) / scans / SCAN,
        "counts",
        tuple(name for bit, name in STATES.items() if status >> bit & 1),
        tuple(STATES.values()),
        ", ".join(
            f"R{(AXIS_Y if registers.axis == 'Y' else 0) + each} = {registers.word(each):04X}H"
            for each in (STATUS, FAULT)
        ),
    )


def _faults(registers: AxisRegisters) -> Iterator[ActiveFault]:
    """Yield the active faults; the feedback fault of a loop that is not switched on is none."""
    fault, is_on = registers.word(FAULT), bool(registers.word(MODE) & 1)
    for bit in range(16):
        if fault >> bit & 1 and (bit != 6 or is_on):
            yield known_fault("57c422b", f"R73 bit {bit}", FAULTS.get(bit, "unnamed"), registers.axis)
