"""Twelve machines and more, with ordinary and odd arguments: a sentence or a result, never a fault of the
program."""

import re
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.files import ParameterFile, open_file
from amp_studio.sim import SimulationError, Trace, check_motion, listing, simulate, simulated_axes
from tests.campaigns import CAMPAIGN
from tests.sim.typical_machines import MACHINES, made

LEFT_OUT = {"sweep", "tune", "procedure"} | (set() if CAMPAIGN else {"frequency", "circle", "step"})
"""Scenarios that take seconds, which other tests have; those of the second group are in a campaign."""
ODD: tuple[float | str, ...] = (0.0, -1.0, 1e-9, 1e12, "", "x")


def sentences(trace: Trace) -> str:
    alarms = [alarm.message for alarm in trace.alarms]
    advice = [text for each in trace.recommendations for text in (each.why, each.price)]
    return "\n".join((*trace.doubts, *trace.assumptions, *alarms, *advice))


def ids_in(file: ParameterFile, text: str) -> list[str]:
    """Return the ids of parameters in a text that have a number by which they are called."""
    schema = file.machine_schema
    named = [p.id for p in file.schema.parameters.values() if p.numbers and not schema.is_disputed(p.id)]
    known = re.compile(rf"(?<![\w.])(?:{'|'.join(map(re.escape, named))})(?![\w.])") if named else None
    return known.findall(text) if known else []


def stated(file: ParameterFile, scenario: str, axis: str | None, settings: dict[str, float | str]) -> str:
    """Return what a scenario states; a figure of it is a number or nothing."""
    try:
        trace = simulate(file, scenario, axis, settings, advise=False)
    except SimulationError as error:
        return error.what
    assert all(value is None or abs(value) < float("inf") for value, _ in trace.result.values()), scenario
    return sentences(trace)


@pytest.mark.parametrize("name", MACHINES)
def test_every_scenario_answers_each_axis_with_figures_or_a_sentence(name: str, tmp_path: Path) -> None:
    file = open_file(made(name, tmp_path)).file
    axes = list(simulated_axes(file))
    for scenario in listing(file).scenarios:
        for axis in [] if scenario.name in LEFT_OUT else axes if CAMPAIGN else axes[-1:]:
            text = stated(file, scenario.name, axis, {})
            assert ids_in(file, text) == [], (scenario.name, axis)
    checks = check_motion(file) if CAMPAIGN else ()
    assert ids_in(file, "\n".join(check.why for check in checks)) == []


@pytest.mark.parametrize("name", MACHINES)
def test_odd_arguments_are_refused_in_words_or_done(name: str, tmp_path: Path) -> None:
    file = open_file(made(name, tmp_path)).file
    axis = next(iter(simulated_axes(file)))
    for n, scenario in enumerate(listing(file).scenarios):
        for k, setting in enumerate([] if scenario.name in LEFT_OUT else scenario.settings):
            for odd in ODD if CAMPAIGN else (ODD[(n + k) % len(ODD)],):
                assert ids_in(file, stated(file, scenario.name, axis, {setting: odd})) == []


@pytest.mark.parametrize(
    ("name", "line", "words"),
    [
        ("57c422b feeder", "load --set move.duration=1e12", "simulated is 60 at most"),
        ("57c422b feeder", "step --axis=", "the axis is empty"),
        ("57c422b feeder", "step --axis Q", "Unknown axis"),
        ("9pc lathe with a gearbox", "spindle S500 --set move.drive_time=1e12", "60 at most"),
        ("9pc lathe with a gearbox", "spindle S500 --set move.spindle=2", "No axis is spindle 2 (3-5, 7-82)"),
        ("9pc mill with a rotary and a split axis", "spindle S500", "No axis is spindle 1 (3-5, 7-82)"),
        ("acromill mill", "fault --axis Z --set move.distance=1e12", "takes more than"),
        ("grblhal laser", "fault --axis X --set move.feedrate=1e12", "takes more than"),
        ("syntec router with a bus", "spindle S500", "has no scenario 'spindle'"),
    ],
)
def test_what_cannot_be_simulated_has_its_reason_in_a_sentence(
    name: str, line: str, words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = made(name, tmp_path)
    assert run(["simulate", str(path), *line.split()]) == 2
    assert words in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "block", "words", "refused"),
    [
        ("grblhal laser", "G1 X-10 F-5", "it is no feed", "error:4: F-5 is no feed"),
        ("grblhal laser", "G1 X-10 F0", "it is no feed", "error:22: F0 is no feed"),
        ("acromill mill", "G1 X1 F-5", "it is no feed", "F-5 is no feed"),  # not F-127, of mm
        ("num lathe", "G0 X1 F-5", "it is no feed", "F-5 is no feed"),
        ("syntec lathe", "F100", "no page here names such a word", "F: no page here names such a word"),
    ],
)
def test_a_block_and_a_program_refuse_the_same(
    name: str, block: str, words: str, refused: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, program = made(name, tmp_path), tmp_path / "part.nc"
    program.write_text(f"{block}\n", encoding="utf-8")
    capsys.readouterr()
    run(["block", str(path), block])
    assert words in capsys.readouterr().out
    run(["program", str(program), "--machine", str(path)])
    assert refused in capsys.readouterr().out


def test_recommendations_call_a_parameter_by_number_and_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = made("57c422b feeder", tmp_path)
    capsys.readouterr()
    run(["simulate", str(path), "tune"])
    text = capsys.readouterr().out
    assert "R3 Proportional Gain = " in text
    assert "together with R5 Velocity Gain" in text
