"""Axes that have no orders of their own: the slave of a split axis, members of a dual group, a synchronised
pair."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from amp_studio.families.ninepc.law_path import path_rules
from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.sim import FileMachine, SimulationError, bind_axis, law_of, simulate
from amp_studio.sim.run import bound_machine
from tests.programs.test_block import example
from tests.sim.typical_machines import made


def machine_of(file: ParameterFile) -> FileMachine:
    machine = FileMachine(law_of(file.schema.family.family), bind_axis)
    machine.take(file)
    return machine


def places(machine: FileMachine, seconds: float) -> dict[str, float]:
    for _ in range(round(seconds / 0.1)):
        machine.advance(0.1)
    return {axis.letter: axis.position for axis in machine.axes()}


def dual_mill() -> ParameterFile:
    """X and Y are group 1; Y is the slower one in all that counts."""
    file = example("mill-1394")
    for axis in "12":
        file.set(("dual.group", axis), Value("g1"))
    file.set(("feedrate.rapid", "2"), Value(4000, "mm/min"))
    file.set(("feedrate.max_cutting", "2"), Value(3000, "mm/min"))
    file.set(("accdec.linear_acceleration", "2"), Value(200, "mm/s2"))
    return file


def test_a_dual_group_is_as_slow_as_its_slowest_axis() -> None:
    """Page 31-2: ramp, velocity step, rapid and cutting feedrate, of every member."""
    file = dual_mill()
    for axis in "12":
        law = bind_axis(file, law_of("9pc"), axis)
        assert law.feedrate == pytest.approx(4000 / 60.0)
        assert law.ramps["linear"].acceleration == pytest.approx(200.0)
        assert any("slowest member" in note for note in law.assumptions)
    trace = simulate(file, "step", "1", {"move.distance": 200.0}, advise=False)
    assert trace.result["feedrate"][0] == pytest.approx(4000.0)
    alone = bind_axis(file, law_of("9pc"), "3")
    assert alone.feedrate == pytest.approx(10000 / 60.0)


def test_a_block_of_the_master_goes_at_the_cutting_feedrate_of_the_slowest() -> None:
    rules = path_rules(bound_machine(dual_mill(), law_of("9pc"), (), {}, lambda _: None))
    assert rules.axis_speed["X"].value == pytest.approx(50.0)
    assert rules.axis_speed["X"].param == ("feedrate.max_cutting", "2")


@pytest.mark.parametrize(
    ("name", "other", "page", "way"),
    [
        ("9pc mill with a rotary and a split axis", "V", "32-7", -20.0),
        ("num gantry", "U", "4-32", 20.0),
        ("", "Y", "31-3", -20.0),
    ],
)
def test_orders_of_the_master_move_all_and_the_others_take_none(
    name: str, other: str, page: str, way: float, tmp_path: Path
) -> None:
    file = open_file(made(name, tmp_path)).file if name else dual_mill()
    if name == "num gantry":  # a table as delivered has 0 in every word of P27
        file.set(("axes.drive_axis", "0"), Value("axis-0"))
    machine = machine_of(file)
    for order in (machine.home, lambda axis: machine.jog(axis, 1.0)):
        with pytest.raises(SimulationError, match=f"moves with axis X .*{page}"):
            order(other)
    machine.home("X")
    homed = places(machine, 20.0)
    machine.jog("X", math.copysign(1.0, way))
    jogged = places(machine, 1.0)
    assert jogged["X"] - homed["X"] == pytest.approx(jogged[other] - homed[other], abs=0.01)
    assert (jogged["X"] - homed["X"]) * way > 0.0
    machine.stop()
    before = places(machine, 2.0)
    machine.move({"X": before["X"] + way}, 10.0)
    after = places(machine, 5.0)
    assert after[other] - before[other] == pytest.approx(way, abs=0.01)


def test_the_slave_of_a_split_axis_stops_at_the_limit_of_its_master(tmp_path: Path) -> None:
    """Page 32-6: its own overtravels are not used."""
    machine = machine_of(open_file(made("9pc mill with a rotary and a split axis", tmp_path)).file)
    machine.home("X")
    places(machine, 20.0)
    machine.jog("X", 1.0, "highest")
    ends = places(machine, 5.0)
    assert ends["X"] - ends["V"] == pytest.approx(0.0, abs=0.01)
    assert [axis.alarm and axis.alarm[0] for axis in machine.axes()] == ["OVERTRAVEL", "OVERTRAVEL"]


@pytest.mark.parametrize("drives", [{"0": "0"}, {"0": "1", "1": "0"}, {"0": "1", "1": "2", "2": "0"}])
def test_a_ring_of_synchronised_axes_is_refused_in_a_sentence(drives: dict[str, str]) -> None:
    """P27 may name the axis itself, or one that it drives: the others still move."""
    file = example("num-1060-mill")
    file.set(("axes.synchronised", ""), Value(sum(1 << int(axis) for axis in drives)))
    for axis, drive in drives.items():
        file.set(("axes.drive_axis", axis), Value(f"axis-{drive}"))
    machine = machine_of(file)
    for axis in drives:
        with pytest.raises(SimulationError, match=f"of axis {axis} is a driven axis itself"):
            machine.home("XYZ"[int(axis)])
        with pytest.raises(SimulationError, match=f"of axis {axis} is a driven axis itself"):
            simulate(file, "jog", axis, {"move.speed": "normal"})
    if len(drives) < 3:
        machine.move({"Z": 5.0}, 10.0)
        assert places(machine, 2.0)["Z"] == pytest.approx(5.0, abs=0.01)
