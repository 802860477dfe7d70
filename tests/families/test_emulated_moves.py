"""A jog or move over the protocol of each emulated control shows, at every moment, the position and the
following error of `simulate` of the same move, count for count: one engine is behind both.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest

from amp_studio.families.servo57c422b.emulated.module import DEFINE, LATCH, Module
from amp_studio.families.servo57c422b.lines.content import (
    RegisterContent,
    settings,
    words_of_content,
    written_content,
)
from amp_studio.files import ParameterFile
from amp_studio.schema import Value
from amp_studio.sim import SimulatedAxis, Trace, bind_axis, law_of, simulate
from tests.families.acromill.lines.bench import CardBench
from tests.families.grblhal.test_emulated_motion import Bench as GrblBench
from tests.families.ninepc.test_emulated_machine_keys import Bench as PanelBench
from tests.families.num.emulated.test_manual_keys import Bench as NumBench
from tests.families.test_emulated_homing import GAINS
from tests.programs.test_block import example

STEP = 0.1
"""s between two looks at a control."""


def jogged(file: ParameterFile, scenario: str, axis: str, **move: float | str) -> Trace:
    return simulate(
        file, scenario, axis, {f"move.{name}": value for name, value in move.items()}, "metric", advise=False
    )


def place(trace: Trace, moment: float) -> tuple[float, ...]:
    """Return measured position and following error of a trace at a moment, the last ones after its end."""
    times, both = trace.columns["time_s"], ("measured_position", "following_error")
    return tuple(float(np.interp(moment, times, trace.columns[name])) for name in both)


def follow(
    trace: Trace,
    look: Callable[[], tuple[float, float]],
    step: Callable[[], object],
    count: float,
    looks: int = 12,
    at: dict[int, Callable[[], object]] | None = None,
) -> None:
    """Compare what a control shows every 0.1 s with a trace; ``at`` has what is done between two looks."""
    for k in range(looks):
        (at or {}).get(k, lambda: None)()
        step()
        assert look() == pytest.approx(place(trace, (k + 1) * STEP), abs=count)


@dataclass
class ModuleBench:
    """A module with the registers of a file, seen at one axis."""

    base: int
    module: Module

    def put(self, register: int, value: int) -> None:
        self.module.write(self.base + register, value >> 16 & 0xFFFF)
        self.module.write(self.base + register + 1, value & 0xFFFF)

    def double(self, register: int) -> int:
        word = self.module.read(self.base + register) << 16 | self.module.read(self.base + register + 1)
        return word - (1 << 32) if word >> 31 else word

    def look(self) -> tuple[float, float]:
        """Latch position and following error (4-38)."""
        self.module.write(self.base + 66, LATCH)
        self.module.write(self.base + 66, 0)
        error = self.module.read(self.base + 80)
        return float(self.double(74)), float(error - 0x10000 if error >> 15 else error)


def press() -> ParameterFile:
    """Return the label press with rates of X that are whole register words."""
    file = example("57c422b-label-press")
    for name, value, unit in (
        ("acceleration", 500000.0, "counts/s2"),
        ("deceleration", 500000.0, "counts/s2"),
        ("velocity", 40000.0, "counts/s"),
    ):
        file.set((f"command.{name}", "X"), Value(value, unit))
    return file


def module_of(file: ParameterFile, base: int) -> ModuleBench:
    module = Module()
    empty = written_content(dict.fromkeys(settings(), 0))
    for register, word in words_of_content(RegisterContent().encode(file, empty)).items():
        module.write(register, word)
    module.write(base + 65, 1)
    return ModuleBench(base, module)


def test_velocity_control_of_a_module_is_the_jog_of_the_simulation() -> None:
    """4-25: bit 2 of register 65 runs the axis until it is off again; 4-38: 74, 75 and 80 are latched."""
    bench = module_of(press(), 0)
    follow(
        jogged(press(), "jog", "X", hold=0.5),
        bench.look,
        lambda: bench.module.advance(STEP),
        1.0,
        8,
        {0: lambda: bench.module.write(65, 5), 5: lambda: bench.module.write(65, 1)},
    )
    assert bench.module.read(73) == 0


def test_a_module_stops_at_its_software_limit_where_the_simulation_stops() -> None:
    """4-10: with its fault bit and the axis regulated behind the limit; the limit is seen by the scan."""
    file = press()
    file.set(("setup.switches", "X"), Value(0x400))
    file.set(("setup.encoder", "X"), Value(0x04))  # linear
    file.set(("setup.overtravel_positive", "X"), Value(10000, "counts"))
    file.set(("setup.overtravel_negative", "X"), Value(-5000, "counts"))
    trace = jogged(file, "travel", "X", start=0.0)
    bench = module_of(file, 0)
    bench.put(17, 0)
    bench.module.write(66, DEFINE)
    bench.module.write(66, 0)
    follow(
        trace, bench.look, lambda: bench.module.advance(STEP), 1.0, 6, {0: lambda: bench.module.write(65, 5)}
    )
    assert trace.alarms[-1].code == "OVERTRAVEL"
    assert bench.module.read(73)


def test_the_keys_of_a_9pc_move_as_the_simulation(tmp_path: Path) -> None:
    bench = PanelBench(tmp_path / "state")

    def look() -> tuple[float, float]:
        axis = next(each for each in bench.panel.screen(bench.control).axes if each.axis == "X")
        return axis.position or 0.0, axis.following_error or 0.0

    keys = {0: lambda: bench.give("jog X- highest"), 7: lambda: bench.give("release")}
    trace = jogged(example("mill-1394"), "jog", "1", hold=0.7, speed="highest", direction="minus")
    try:
        follow(trace, look, lambda: bench.panel.advance(bench.control, STEP), 1e-5, at=keys)
    finally:
        bench.control.close()


def test_the_keys_of_a_num_move_as_the_simulation(tmp_path: Path) -> None:
    bench = NumBench(tmp_path)

    def look() -> tuple[float, float]:
        axis = next(each for each in bench.control.screen().axes if each.axis == "X")
        return axis.position or 0.0, axis.following_error or 0.0

    keys = {0: lambda: bench.control.operate("jog X+ fast"), 10: lambda: bench.control.operate("release")}
    trace = jogged(example("num-1060-mill"), "jog", "0", hold=1.0, speed="fast")
    follow(trace, look, lambda: bench.control.advance(STEP), 0.001, at=keys)


def test_the_terminal_of_a_card_moves_as_the_simulation(tmp_path: Path) -> None:
    """P6144 is in pulses (114); an increment of JOG INC is in units."""
    bench = CardBench(tmp_path)
    for line in GAINS.split("|"):
        bench.card._done(line)
    bench.card._done("JOG INC X0.5")
    axis = bench.card.motion._machine.axes["X"]
    law = axis.law
    assert law.jogging is not None
    speed = next(iter(law.jogging().speeds.values()))
    moved = SimulatedAxis(law)
    ramp = law.jogging().ramp
    assert ramp is not None
    moved.move(12.7, speed, ramp)
    pulses = float(bench.card.settings.values["PPU X"]) / 25.4
    for _ in range(12):
        bench.card.advance(STEP)
        moved.advance(STEP)
        assert float(bench.card._done("?P6144")[0]) == round(moved.position * pulses)


def test_a_grbl_moves_as_the_simulation(tmp_path: Path) -> None:
    from amp_studio.families.grblhal.formats.listing import FORMAT

    file, bench = example("grblhal-router"), GrblBench(tmp_path)
    for line in re.findall(r"^\$\d+=\S+", FORMAT.write(file), re.MULTILINE):
        bench.identity_word(line)
    assert bench.identity_word("$J=G91 G21 X50 F8000") == "ok"
    trace = jogged(file, "step", "X", distance=50.0, feedrate=8000.0)
    follow(trace, lambda: (bench.status()[1][0], 0.0), lambda: bench.firmware.advance(STEP), 0.0125)
    assert bench.status()[0] == "Idle"


@pytest.mark.parametrize("name", ["mill-1394", "lathe-ls176", "num-1060-mill", "syntec-mill"])
def test_the_clock_of_a_machine_keeps_time_whatever_the_servo_period(name: str) -> None:
    """A slice of 20 ms is no whole number of most servo periods: the axis lost up to 2.5 % of its time."""
    file = example(name)
    law = law_of(file.schema.family.family)
    axis = bind_axis(file, law, next(iter(law.axes(file))))
    simulated = SimulatedAxis(axis)
    simulated.go(1.0, next(iter(axis.ramps.values())))
    for _ in range(10):
        simulated.advance(STEP)
    assert simulated._moving.time == pytest.approx(1.0, abs=axis.servo_period)


def test_an_order_after_a_limit_has_limits_again() -> None:
    """An axis that had met one limit ran through the other one."""
    file = example("lathe-ls176")
    law = law_of("9pc")
    bound = bind_axis(file, law, "1")
    assert bound.travel is not None
    axis = SimulatedAxis(bound, position=0.0)
    axis.travel = bound.travel()
    low, high = next(iter(axis.travel.limits.values()))
    ramp = next(iter(bound.ramps.values()))
    for sign, edge in ((-1.0, low), (1.0, high), (1.0, high)):
        axis.go(sign * 50.0, ramp)
        for _ in range(80):
            axis.advance(STEP)
        assert axis.alarm is not None
        assert 0.0 < sign * (axis.position - edge) < 20.0


def test_an_axis_beyond_its_limit_is_moved_back_wherever_its_zero_is() -> None:
    """After a reset the command begins where the axis is, and is there to the last digit but one: that was
    taken for a way on beyond the limit, and the axis could not be jogged back.
    """
    bound = bind_axis(example("mill-1394"), law_of("9pc"), "1")
    assert bound.manual_ramp is not None
    assert bound.travel is not None
    ramp, travel = bound.manual_ramp(False), bound.travel()
    for n in range(12):
        axis = SimulatedAxis(bound)
        axis.go(50.0, ramp)
        axis.advance(0.3 + 0.0371 * n)
        axis.switch_off()
        axis.advance(1.0)
        axis.reset()
        axis.go(20.0, ramp)
        axis.advance(0.4)
        axis.stop(ramp)
        while axis.is_busy:
            axis.advance(0.1)
        axis.travel = replace(travel, limits={"the limit": (-500.0, axis.position - 1.0)})
        before = axis.position
        axis.go(-0.8, ramp)
        axis.advance(0.3)
        assert axis.alarm is None
        assert axis.position < before
