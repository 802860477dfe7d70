"""Verbs about the machine in motion."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import asdict

from amp_studio.files import ParameterFile, axis_instances
from amp_studio.machine import read_assignments
from amp_studio.scenarios import IDENTIFY
from amp_studio.schema import axis_meant
from amp_studio.sim import (
    SimulationError,
    Trace,
    identified_text,
    identify,
    listing,
    machine_for,
    machine_settings,
    named_parameter,
    read_machine,
    simulate,
    simulated_axes,
    titled,
    trace_summary,
    trace_text,
    write_machine,
    write_trace,
)

from .console import assignments, note, print_json
from .errors import UsageError
from .opened import opened
from .output import check_replaced

PICTURES = (".svg", ".png")
SETTING_GROUPS = ("move", "model", "tune", "gear", "cam")
"""First words of settings that are no parameters."""


def simulate_verb(options: argparse.Namespace) -> int:
    """Move the machine; 1 where it raised an alarm."""
    if options.output:
        beside = (each for each in (options.record, options.machine_file) if each)
        check_replaced(options.output, options.path, *beside)
    file = opened(options.path)
    if options.list:
        return _list(file, options.units, as_json=options.json)
    if options.scenario is None:
        raise UsageError("Name a scenario; amp-studio simulate PATH --list lists them")
    if options.scenario == IDENTIFY:
        return _identify(options, file)
    if options.record or options.scale:
        raise UsageError(f"a record and its scale belong to {IDENTIFY}, not to {options.scenario}")
    settings, own = _settings(options.assignments)
    told: list[str] = []
    before = file.copy()
    for address, value in read_assignments(file, assignments(own), told.append).items():
        file.set(address, value)
    axis = _axis(options, file)
    if options.machine_file:
        axis, machine = machine_for(file, read_machine(options.machine_file), axis)
        settings = {**machine, **settings}
    system = options.units or file.header.units
    trace = simulate(file, options.scenario, axis, settings, system)
    for said in told:
        note(said)
    if options.output:
        is_picture = options.output.suffix.lower() in PICTURES
        earlier = _earlier(before, trace, settings, system) if own and is_picture else None
        write_trace(trace, options.output, note, before=earlier)
    if options.json:
        print_json(trace_summary(trace, lambda parameter: named_parameter(file, parameter, trace.axis)))
    else:
        print(trace_text(trace))
    return 1 if trace.alarms else 0


def _axis(options: argparse.Namespace, file: ParameterFile) -> str | None:
    if not options.axis:
        return None
    return axis_meant(file.evaluation, axis_instances(file) or simulated_axes(file), options.axis)


def _identify(options: argparse.Namespace, file: ParameterFile) -> int:
    """Find the machine of an axis in a record of its drive."""
    if options.record is None:
        raise UsageError(
            f"Name the record: amp-studio simulate {options.path} {IDENTIFY} RECORD.csv --axis X"
        )
    if options.assignments or options.machine_file:
        raise UsageError(f"{IDENTIFY} takes neither --set nor --machine: it finds the machine")
    trace = identify(file, options.record, _axis(options, file), options.scale, options.units)
    if options.output and options.output.suffix.lower() in (".yaml", ".yml"):
        write_machine(trace, file.schema.family.family, options.output, note)
    elif options.output:
        write_trace(trace, options.output, note)
    if options.json:
        machine = {"machine": machine_settings(trace)}
        print_json(
            trace_summary(trace, lambda parameter: named_parameter(file, parameter, trace.axis)) | machine
        )
    else:
        print(identified_text(trace))
    return 0


def _earlier(
    file: ParameterFile, trace: Trace, settings: dict[str, float | str], system: str
) -> Trace | None:
    """Return the same move with the values in the file, to draw under that of the changed ones; None where it has none."""
    try:
        return simulate(file, trace.scenario, trace.axis, settings, system, like=trace)
    except SimulationError:
        return None


def _settings(texts: Sequence[str]) -> tuple[dict[str, float | str], list[str]]:
    """Part the settings of the scenario and its model (``move.feedrate=3000``) from parameters."""
    settings: dict[str, float | str] = {}
    own = []
    for param, text in assignments(texts):
        if param.partition(".")[0] in SETTING_GROUPS:
            settings[param] = text
        else:
            own.append(f"{param}={text}")
    return settings, own


def _list(file: ParameterFile, system: str | None, *, as_json: bool) -> int:
    """Print what can be simulated with a file."""
    found = listing(file, system)
    if as_json:
        print_json(asdict(found))
        return 0
    print(f"axes: {', '.join(map(titled, found.axes, found.letters)) or 'none'}")
    for scenario in found.scenarios:
        print(f"{scenario.name}: {scenario.title}")
        for name, text in scenario.settings.items():
            print(f"  {name:24}{text}")
    print(f"{IDENTIFY} RECORD.csv: inertia, friction and weight of an axis, from a record of its drive")
    print("the machine, in every scenario:")
    for name, text in found.model.items():
        print(f"  {name:32}{text}")
    return 0


def demo_verb(options: argparse.Namespace) -> int:
    """Do the whole job on the example machine."""
    from amp_studio.demo import run_demo  # it needs every room

    return run_demo(terminal=options.terminal)
