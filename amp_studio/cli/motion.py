"""Verbs about the machine in motion."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from amp_studio.files import axis_instances, open_file
from amp_studio.schema import InvalidValueError, axis_meant, canonical, unit_named
from amp_studio.schema.values import read_number
from amp_studio.sim import named_parameter, simulate, simulated_axes, trace_summary, trace_text, write_trace

from .console import assignments, note, print_json
from .files import wanted
from .output import check_replaced


def simulate_verb(options: argparse.Namespace) -> int:
    """Move the machine; 1 where it raised an alarm."""
    if options.output:
        check_replaced(options.output, options.path)
    file = open_file(options.path).file
    settings, own = _settings(options.assignments)
    told: list[str] = []
    for address, value in wanted(file, own, told.append).items():
        file.set(address, value)
    axis = (
        axis_meant(file.evaluation, axis_instances(file) or simulated_axes(file), options.axis)
        if options.axis
        else None
    )
    trace = simulate(file, options.scenario, axis, settings)
    for said in told:
        note(said)
    if options.output:
        write_trace(trace, options.output, note)
    if options.json:
        print_json(trace_summary(trace, lambda parameter: named_parameter(file, parameter, trace.axis)))
    else:
        print(trace_text(trace))
    return 1 if trace.alarms else 0


def _settings(texts: Sequence[str]) -> tuple[dict[str, float | str], list[str]]:
    """Part the settings of the scenario and its model (``move.feedrate=3000``) from parameters."""
    settings: dict[str, float | str] = {}
    own = []
    for param, text in assignments(texts):
        if param.partition(".")[0] not in ("move", "model", "tune", "gear", "cam"):
            own.append(f"{param}={text}")
            continue
        try:
            number, unit = read_number(text)
            settings[param] = canonical(number, unit_named(unit)) if unit.strip() else number
        except InvalidValueError:
            settings[param] = text
    return settings, own


def demo_verb(options: argparse.Namespace) -> int:
    """Do the whole job on the example machine."""
    from amp_studio.demo import run_demo  # it needs every room

    return run_demo(terminal=options.terminal)
