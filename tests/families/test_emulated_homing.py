"""A homing over the protocol of each emulated control ends where `simulate` of the same file ends, within a
count: one engine is behind both.
"""

import re
from pathlib import Path

import pytest

from amp_studio.families.servo57c422b.emulated.module import HOME, HOMED, LATCH, Module
from amp_studio.families.servo57c422b.lines.content import (
    RegisterContent,
    settings,
    words_of_content,
    written_content,
)
from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.sim import FileMachine, bind_axis, law_of, simulate
from tests.families.acromill.lines.bench import CardBench
from tests.families.grblhal.test_emulated_motion import Bench as GrblBench
from tests.families.ninepc.test_emulated_machine_keys import Bench as PanelBench
from tests.families.num.emulated.test_manual_keys import Bench as NumBench
from tests.programs.test_block import example
from tests.sim.typical_machines import MACHINES, made

GAINS = "PPU X4096|EXC AXIS0 4|PGAIN X.08|DGAIN X.00021|FFVEL X.0000015"
"""Of the bare test motor of appendix C."""


def stop_of(file: ParameterFile, axis: str) -> float:
    """Return where a simulated homing comes to rest, in the unit of the file."""
    found = simulate(file, "home", axis, {}, advise=False).result["stop_position"][0]
    assert found is not None
    return found


@pytest.mark.parametrize(("axis", "base"), [("X", 0), ("Y", 2048)])
def test_the_registers_of_a_module_show_the_place_of_the_simulation(axis: str, base: int) -> None:
    """R66 bit 2, then the latched position in R74, 75 (4-29, 4-38); register 80 is the following error."""
    file, module = example("57c422b-label-press"), Module()
    empty = written_content(dict.fromkeys(settings(), 0))
    for register, word in words_of_content(RegisterContent().encode(file, empty)).items():
        module.write(register, word)
    module.write(base + 65, 1)
    module.write(base + 66, HOME)
    module.write(base + 66, 0)
    for _ in range(60):
        module.advance(0.1)
    module.write(base + 66, LATCH)
    word = module.read(base + 74) << 16 | module.read(base + 75)
    position = word - (1 << 32) if word >> 31 else word
    assert position == pytest.approx(stop_of(file, axis), abs=1.0)
    assert abs(module.read(base + 80)) <= 1
    assert module.read(base + 72) & HOMED
    assert module.read(base + 73) == 0


def test_the_panel_of_a_9pc_shows_the_place_of_the_simulation(tmp_path: Path) -> None:
    bench = PanelBench(tmp_path / "state")
    try:
        bench.give("mdi G28 X0")
        bench.after(12.0)
        page = bench.panel.screen(bench.control).axes[0]
    finally:
        bench.control.close()
    assert page.position == pytest.approx(stop_of(example("mill-1394"), "1"), abs=1e-5)
    assert "homed" in page.states


def test_the_axis_page_of_a_num_shows_the_place_of_the_simulation(tmp_path: Path) -> None:
    bench = NumBench(tmp_path)
    bench.control.operate("homing X")
    bench.after(3.0)
    page = bench.control.screen().axes[0]
    assert page.position == pytest.approx(
        stop_of(example("num-1060-mill"), "0"), abs=0.001
    )  # a µm is a count
    assert page.following_error == pytest.approx(0.0, abs=0.001)


def test_the_terminal_of_a_card_shows_the_place_of_the_simulation(tmp_path: Path) -> None:
    """P6144 is in encoder pulses (page 114). Speeds of homing are settings of AcroMill on the PC: those as
    delivered.
    """
    bench = CardBench(tmp_path)
    for line in GAINS.split("|"):
        bench.card._done(line)
    bench.card.operate("home X")
    for _ in range(85):
        bench.card.advance(0.1)
    pulses = float(bench.card._done("?P6144")[0])
    file = bench.card.motion._content()
    stop = simulate(file, "home", "X", {}, "metric", advise=False).result["stop_position"][0]
    assert stop is not None
    assert pulses == pytest.approx(stop * float(bench.card.settings.values["PPU X"]) / 25.4, abs=1.0)


def test_a_grbl_reports_the_place_of_the_simulation(tmp_path: Path) -> None:
    from amp_studio.families.grblhal.formats.listing import FORMAT

    file, bench = example("grblhal-router"), GrblBench(tmp_path)
    for line in re.findall(r"^\$\d+=\S+", FORMAT.write(file), re.MULTILINE):
        bench.identity_word(line)
    bench.identity_word("$H")
    assert bench.after(10.0).endswith("ok")
    found = bench.status()[1]
    assert found == [
        pytest.approx(stop_of(file, axis), abs=0.0125) for axis in "XYZ"
    ]  # a step of 80 for 1 mm


@pytest.mark.parametrize(
    ("name", "axis", "limit", "value", "speed"),
    [
        ("mill-1394", "1", "servo.excess_error", Value(1.0, "mm"), "highest"),
        ("num-1060-mill", "0", "servo.max_following_error", Value(500, "iu"), "normal"),
    ],
)
def test_a_following_error_stops_both_with_the_same_words_and_they_run_out_alike(
    name: str, axis: str, limit: str, value: Value, speed: str
) -> None:
    """A drive that is off lets the axis run on: an emulated axis froze half a second after the fault."""
    file = example(name)
    file.set((limit, axis), value)
    trace = simulate(file, "jog", axis, {"move.speed": speed}, advise=False)
    machine = FileMachine(law_of(file.schema.family.family), bind_axis)
    machine.take(file)
    machine.jog(axis, 1.0, speed)
    left = float(trace.columns["time_s"][-1])
    while left > 0.0:
        machine.advance(min(0.1, left))
        left -= 0.1
    stopped = next(machine.axes())
    assert stopped.alarm == (trace.alarms[0].code, trace.alarms[0].message)
    scan = abs(trace.columns["velocity"][-1]) / 60.0 * 0.02  # what it goes on in a slice
    assert stopped.position == pytest.approx(trace.columns["position"][-1], abs=scan + 1e-4)


def test_a_homing_that_is_never_in_position_has_a_sentence_and_leaves_the_module_alive(
    tmp_path: Path,
) -> None:
    """Without an integral gain dry friction keeps the feeder 14 counts off, and register 10 allows 10: the
    result had no reason, and the emulated module took no further order.
    """
    file = open_file(made("57c422b feeder", tmp_path)).file
    alarms = simulate(file, "home", "X", {}, advise=False).alarms
    assert [alarm.code for alarm in alarms] == ["HOME"]
    assert "never in position" in alarms[0].message
    from tests.families.test_emulated_moves import module_of  # which imports this module

    bench = module_of(file, 0)
    bench.module.write(66, HOME)
    bench.module.write(66, 0)
    for _ in range(100):
        bench.module.advance(0.1)
    there = bench.look()[0]
    bench.module.write(65, 5)
    for _ in range(10):
        bench.module.advance(0.1)
    assert bench.look()[0] > there + 10000.0


@pytest.mark.parametrize("name", [name for name in MACHINES if name.startswith(("9pc", "num"))])
def test_every_axis_of_a_typical_machine_comes_home_where_it_is_simulated(name: str, tmp_path: Path) -> None:
    file = open_file(made(name, tmp_path)).file
    machine = FileMachine(law_of(file.schema.family.family), bind_axis)
    machine.take(file)
    machine.make_all()
    own = [axis for axis, each in machine._machine.axes.items() if each.law.ordered_by is None]
    for axis in own:
        machine.home(axis)
    for _ in range(350):
        machine.advance(0.1)
    found = {axis: machine._machine.axes[axis] for axis in own}
    assert own
    assert all(axis.is_homed and axis.alarm is None for axis in found.values())
    for axis, each in found.items():
        assert each.position == pytest.approx(stop_of(file, axis), abs=0.002)


def test_a_homing_that_is_ordered_in_a_jog_stops_the_axis_first() -> None:
    """The command went from one speed to the opposite one at once: a velocity error and a position error."""
    from tests.families.test_emulated_moves import module_of, press  # which imports this module

    bench = module_of(press(), 0)

    def after(seconds: float) -> None:
        for _ in range(round(seconds / 0.1)):
            bench.module.advance(0.1)

    bench.module.write(65, 5)
    after(0.5)
    assert bench.look()[0] > 10000.0
    bench.module.write(66, HOME)
    bench.module.write(66, 0)
    after(12.0)
    assert bench.module.read(73) == 0
    assert bench.module.read(72) & HOMED
