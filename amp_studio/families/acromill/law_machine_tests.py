"""The safety program of appendix C: EXC of three motor turns,
and the bits of all axes on an output (pages 113 and 114).
"""

from __future__ import annotations

from amp_studio.sim import AxisLaw, BoundMachine, MachineTest, MachineTestStep

from .law_facts import MOTION, ids

TURNS, OUTPUT = 3.0, 32
FIRST, STEP = 769, 32


def machine_tests(machine: BoundMachine, _axis: AxisLaw) -> list[MachineTest]:
    """Return the program for the axes of the file."""
    title, page = "Excess error of every axis takes the power away while it is tuned", "113, 114"
    bits = [FIRST + STEP * "XYZABCUV".index(name) for name in machine.fitted]
    pulses = {name: machine.read(name).optional(ids.pulses_per_unit) for name in machine.fitted}
    if missing := [name for name, figure in pulses.items() if not figure]:
        called = machine.parameters.called(ids.pulses_per_unit)
        return [
            MachineTest("excess-error", title, page, refusal=f"{called} of {', '.join(missing)} is not set.")
        ]
    unit = 1.0 if machine.parameters.value(ids.default_units, everywhere=True) == "metric" else 25.4
    # The guide sets 4 units at 4096 pulses; three turns of its motor are 3 units.
    way = TURNS * MOTION.value("pulses_per_turn")
    ranges = " ".join(
        f"AXIS{MOTION.axes.index(name)} {_word(way / (figure or 1.0) / unit)}"
        for name, figure in pulses.items()
    )
    lines = ["PROG0", f"EXC {ranges}", "PLC0", "HALT", "NEW"]
    lines += [f"{10 * n:<5} {'LD' if n == 1 else 'AND'} {bit}" for n, bit in enumerate(bits, 1)]
    lines += [f"{10 * (len(bits) + 1):<5} OUT {OUTPUT}", "RUN"]
    steps = (
        MachineTestStep(
            "Wire output 32 so that it takes the power from the motors when it goes off",
            "the drives have power only while it is on",
        ),
        MachineTestStep(
            "Turn the shaft by hand by more than the range of EXC", "the output goes off, the power goes"
        ),
    )
    return [
        MachineTest(
            "excess-error",
            title,
            page,
            tuple(lines),
            steps,
            ("ASSUMED: 4096 pulses for a motor turn (page 113).",),
        )
    ]


def _word(number: float) -> str:
    return f"{round(number, 6):.6f}".rstrip("0").rstrip(".")
