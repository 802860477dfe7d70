"""Thirteen typical machines alive: homed, jogged, driven into a limit, with a fault, an E-stop and a reset.
All of them behind the one panel, and the nine of families with an emulated control at its own commands.
"""

from __future__ import annotations

import contextlib
import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from amp_studio.families.acromill.emulated.settings import CommandError
from amp_studio.families.grblhal.formats.listing import FORMAT as GRBL_TEXT
from amp_studio.families.servo57c422b.emulated.module import HOME, HOMED, Module
from amp_studio.families.servo57c422b.lines.content import (
    RegisterContent,
    settings,
    words_of_content,
    written_content,
)
from amp_studio.files import open_file
from amp_studio.sim import AxisLaw, FileMachine, SimulationError, bind_axis, law_of
from tests.families.acromill.lines.bench import CardBench
from tests.families.grblhal.test_emulated_motion import Bench as GrblBench
from tests.families.ninepc.test_emulated_machine_keys import Bench as PanelBench
from tests.families.num.emulated.test_manual_keys import Bench as NumBench
from tests.families.test_emulated_homing import GAINS
from tests.sim.typical_machines import MACHINES, made

LONG = 40.0
"""s: a homing of the slowest of them."""
FEW = 2.0


class Panel:
    """The first axis of a machine behind the panel."""

    def __init__(self, path: Path) -> None:
        file = open_file(path).file
        law = law_of(file.schema.family.family)
        self.machine = FileMachine(law, bind_axis)
        self.machine.take(file)
        self.machine.make_all()
        self.letter = next(self.machine.axes()).letter
        self.law: AxisLaw = bind_axis(file, law, self.letter)

    def after(self, seconds: float) -> None:
        for _ in range(round(seconds / 0.1)):
            self.machine.advance(0.1)

    def seen(self) -> tuple[float, bool, str]:
        axis = next(each for each in self.machine.axes() if each.letter == self.letter)
        assert math.isfinite(axis.position)
        return axis.position, axis.is_homed, axis.alarm[0] if axis.alarm else ""


@pytest.fixture(params=MACHINES)
def panel(request: pytest.FixtureRequest, tmp_path: Path) -> Panel:
    return Panel(made(request.param, tmp_path))


def test_each_machine_is_homed_or_shows_why_not(panel: Panel) -> None:
    try:
        panel.machine.home(panel.letter)
    except SimulationError:
        return  # no sequence is printed, or it is not set
    panel.after(LONG)
    _, homed, alarm = panel.seen()
    assert homed or alarm or panel.machine.is_busy


def test_each_machine_jogs_both_ways_or_has_no_speed_for_it(panel: Panel) -> None:
    for sign in (1.0, -1.0):
        before = panel.seen()[0]
        try:
            panel.machine.jog(panel.letter, sign)
        except SimulationError:
            return
        panel.after(0.5)
        panel.machine.stop()
        panel.after(FEW)
        assert (panel.seen()[0] - before) * sign > 0.0


def test_each_homed_machine_stops_at_its_limit_with_its_alarm(panel: Panel) -> None:
    with contextlib.suppress(SimulationError):
        panel.machine.home(panel.letter)
    panel.after(LONG)
    travel = panel.law.travel() if panel.law.travel else None
    place, homed, _ = panel.seen()
    found = travel.nearest(place, 1.0) if travel else None
    if travel is None or found is None or travel.refuses or not homed:
        return  # nothing stops it there: scenario `travel` states what does
    with contextlib.suppress(SimulationError):
        speeds = panel.law.jogging().speeds if panel.law.jogging else {}
        fastest = max(speeds, key=lambda name: speeds[name])
        panel.machine.jog(panel.letter, 1.0, fastest)
        panel.after(min((found[1] - place) / speeds[fastest], 300.0) + FEW)
        assert panel.seen()[2] == travel.alarm
        assert panel.seen()[0] > found[1] - 1e-6


def test_each_machine_takes_orders_again_after_fault_e_stop_and_reset(panel: Panel) -> None:
    with contextlib.suppress(SimulationError):
        panel.machine.jog(panel.letter, -1.0)
    panel.after(0.3)
    panel.machine.fail(panel.letter, "drive")
    panel.after(0.5)
    panel.machine.switch_off()
    panel.after(1.0)
    panel.machine.reset()
    place, _, alarm = panel.seen()
    assert alarm == ""
    with contextlib.suppress(SimulationError):
        panel.machine.jog(panel.letter, -1.0)
        panel.after(0.5)
        assert panel.seen()[0] < place


@dataclass
class Alive:
    """An emulated control with a machine: what an operator does at it."""

    home: Callable[[], object]
    is_homed: Callable[[], bool]
    fail: Callable[[], object]
    move: Callable[[], object]
    words: Callable[[], str]
    """What it shows."""
    after: Callable[[float], object]


def panel_of(path: Path, folder: Path) -> Alive:
    bench = PanelBench(folder / "state", path)
    return Alive(
        lambda: bench.give("mdi G28 X0"),
        lambda: "X " in bench.give("position") and " not homed" not in bench.give("position").split(";")[0],
        lambda: bench.give("fault drive X"),
        lambda: bench.give("jog X-"),
        lambda: bench.give("position") + bench.panel.screen(bench.control).state,
        bench.after,
    )


def num_of(path: Path, folder: Path) -> Alive:
    bench = NumBench(folder, path)
    operate = bench.control.operate
    return Alive(
        lambda: operate("homing X"),
        lambda: " not homed" not in operate("position").split(";")[0],
        lambda: operate("fault feedback X"),
        lambda: operate("jog X+"),
        lambda: operate("position"),
        bench.after,
    )


def card_of(_path: Path, folder: Path) -> Alive:
    """The gains of appendix C are those of the typical machine."""
    bench = CardBench(folder)
    for line in GAINS.split("|"):
        bench.card._done(line)

    def after(seconds: float) -> None:
        for _ in range(round(seconds / 0.1)):
            bench.card.advance(0.1)

    return Alive(
        lambda: bench.card.operate("home X"),
        lambda: " homed" in bench.card.operate("status"),
        lambda: bench.card.operate("fault drive X"),
        lambda: bench.card._done("JOG FWD X"),
        lambda: bench.card.operate("status"),
        after,
    )


def grbl_of(path: Path, folder: Path) -> Alive:
    bench = GrblBench(folder)
    for line in re.findall(r"^\$\d+=\S+", GRBL_TEXT.write(open_file(path).file), re.MULTILINE):
        bench.identity_word(line)
    return Alive(
        lambda: bench.identity_word("$H"),
        lambda: bench.status()[0] == "Idle" and bench.status()[1][0] != 0.0,
        lambda: bench.firmware.operate("alarm 17"),
        lambda: bench.identity_word("$J=G91 X-5 F500"),
        lambda: str(bench.status()),
        bench.after,
    )


def module_of(path: Path, _folder: Path) -> Alive:
    module = Module()
    empty = written_content(dict.fromkeys(settings(), 0))
    for register, word in words_of_content(RegisterContent().encode(open_file(path).file, empty)).items():
        module.write(register, word)
    module.write(65, 1)

    def home() -> None:
        module.write(66, HOME)
        module.write(66, 0)

    def after(seconds: float) -> None:
        for _ in range(round(seconds / 0.1)):
            module.advance(0.1)

    return Alive(
        home,
        # The feeder has no integral gain: it rests beside its tolerance and is never in position.
        lambda: bool(module.read(72) & HOMED) or bool(module._motion[0].is_stopped),
        lambda: module.trip(0),
        lambda: module.write(65, 5),
        lambda: f"{module.read(72)} {module.read(73)}",
        after,
    )


CONTROLS = {"9pc": panel_of, "num": num_of, "acromill": card_of, "grblhal": grbl_of, "57c422b": module_of}
WITHOUT_CONTROL = ("syntec", "linuxcnc")
"""No protocol of a Syntec is known, and a LinuxCNC is driven itself (tests/families/linuxcnc)."""


@pytest.mark.parametrize("name", [name for name, (family, *_) in MACHINES.items() if family in CONTROLS])
def test_each_emulated_control_homes_its_machine_and_shows_a_fault(name: str, tmp_path: Path) -> None:
    alive = CONTROLS[MACHINES[name][0]](made(name, tmp_path), tmp_path)
    alive.home()
    alive.after(LONG)
    assert alive.is_homed(), alive.words()
    quiet = alive.words()
    alive.fail()
    alive.after(0.5)
    with contextlib.suppress(ValueError, CommandError):
        alive.move()
    alive.after(FEW)
    assert alive.words() != quiet


def test_no_family_of_a_typical_machine_is_forgotten() -> None:
    assert {family for family, *_ in MACHINES.values()} == {*CONTROLS, *WITHOUT_CONTROL}
