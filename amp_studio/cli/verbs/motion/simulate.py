"""Check settings in motion."""

from __future__ import annotations

import re
from collections.abc import Container, Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from amp_studio.cli import candidates
from amp_studio.cli.arguments import AXIS, JSON, LANGUAGE, OUTPUT, PATH, count, path_of, seconds
from amp_studio.cli.console import assignments, print_json, print_remark, progress
from amp_studio.cli.errors import UsageError
from amp_studio.cli.motion.trigger import trigger_given
from amp_studio.cli.opened import opened
from amp_studio.cli.output import check_replaced, print_remarks
from amp_studio.cli.verb import Options, Verb, VerbArgument
from amp_studio.scenarios import CHARTS, IDENTIFY

if TYPE_CHECKING:
    from amp_studio import MachineParameters
    from amp_studio.files import ParameterFile
    from amp_studio.sim import SweepWay, Trace

VERB = Verb(
    __doc__,
    PATH,
    VerbArgument(
        "scenario",
        nargs="?",
        help="what is simulated; or identify: inertia, friction and weight from a record",
        completes=candidates.scenarios,
    ),
    VerbArgument(
        "record",
        nargs="?",
        type=path_of,
        help=(
            "identify: CSV of a drive with time, velocity or position, and torque; units in the heads."
            " spindle: the S word, as S1500"
        ),
    ),
    VerbArgument(
        "--list", action="store_true", help="list the scenarios of this family, its axes, and what can be set"
    ),
    AXIS,
    VerbArgument(
        "--set",
        action="append",
        default=[],
        metavar="PARAM=VALUE",
        dest="assignments",
        help="parameter and its new value",
        completes=candidates.assignments,
    ),
    VerbArgument(
        "--speed", metavar="SPEED", help="tap and probe: the speed, as 600 or '100 mm/min' (move.speed)"
    ),
    VerbArgument(
        "--pitch", metavar="PITCH", help="tap: the pitch of the thread, as 1 or '0.05 in' (move.pitch)"
    ),
    VerbArgument(
        "--for",
        dest="aim",
        metavar="AIM",
        help="tune: quiet, normal, stiff, or contour (equal gains on all axes)",
    ),
    VerbArgument(
        "--keep",
        metavar="NOTE",
        help=(
            "tune: keep before, after and the machine in the tuning record beside the file (tunings.jsonl),"
            " with a note; the report prints it"
        ),
    ),
    VerbArgument(
        "--over",
        action="append",
        default=[],
        metavar="NAME=FROM:TO:STEPS",
        help=(
            "sweep: a parameter, model.… or move.… that is varied; several make a grid; NAME=FROM:TO or"
            " NAME=MEAN+-SIGMA with --samples"
        ),
    ),
    VerbArgument("--samples", type=count, metavar="N", help="sweep: so many samples instead of all steps"),
    VerbArgument(
        "--figure",
        metavar="NAME",
        help="sweep: what is drawn and sought the best of: settle_time, stiffness, Ms, …",
    ),
    VerbArgument(
        "--scheduler",
        metavar="ADDRESS",
        help="sweep: a Dask cluster that computes it, tcp://HOST:PORT (default: this computer)",
    ),
    VerbArgument("--jobs", type=count, metavar="N", help="sweep: processes (default: as many as cores)"),
    VerbArgument(
        "--machine",
        dest="machine_file",
        type=path_of,
        metavar="FILE.yaml",
        help="the machine that identify has written; --set model.… has precedence",
    ),
    VerbArgument(
        "--scale",
        metavar="TORQUE",
        help="identify: torque of the record for 1 % (or 1 V) of the axis, as '0.056 A'",
    ),
    VerbArgument(
        "--frf",
        dest="response",
        type=path_of,
        metavar="FILE.csv",
        help=(
            "identify: a frequency response (frequency_hz, gain_db, phase_deg, coherence), or the record of a"
            " chirp"
        ),
    ),
    VerbArgument(
        "--turn",
        metavar="TRAVEL",
        help="identify: travel for a turn of the motor, '10 mm', for a record in rpm",
    ),
    VerbArgument(
        "--response",
        dest="quantity",
        metavar="MOTION",
        help="identify --frf: position, velocity or acceleration (default: as slope and phase show)",
    ),
    VerbArgument(
        "--against",
        type=path_of,
        metavar="RECORD.csv",
        help="lay the record of the machine over the move: lag, difference and its root mean square",
    ),
    VerbArgument(
        "--trigger",
        metavar="SIGNAL>LEVEL",
        help=(
            "--against: lay both over each other where a signal passes a level, as 'velocity>100', or"
            " is at it, even from the first row, 'velocity>=100'"
        ),
    ),
    VerbArgument(
        "--pre-trigger",
        type=seconds,
        metavar="SECONDS",
        help="--trigger: how much of the record ahead of it is kept (default: 0)",
    ),
    VerbArgument(
        "--chart",
        choices=CHARTS,
        help="frequency with -o: how the open loop is drawn, over the frequency or in a plane",
    ),
    VerbArgument(
        "--units", metavar="SYSTEM", help="metric or inch, for settings and result (default: as the file)"
    ),
    OUTPUT.but(required=False, help="file to write: .csv, .svg, .png, .pdf, .html; identify: .yaml too"),
    LANGUAGE,
    JSON,
    writes=("output",),
    sections=("scenarios", "PARAM", "VALUE"),
    examples=(
        "amp-studio simulate MILL_1394.amp --list",
        "amp-studio simulate MILL_1394.amp step --axis X",
        "amp-studio simulate MILL_1394.amp step --axis X --set move.distance=50 -o trace.csv",
        "amp-studio simulate MILL_1394.amp tune --axis X --for stiff",
        "amp-studio simulate MILL_1394.amp frequency --axis X --chart nyquist -o loop.svg",
        "amp-studio simulate MILL_1394.amp spindle S1500",
        "amp-studio simulate MILL_1394.amp tap --pitch 1 --speed 400",
        "amp-studio simulate MILL_1394.amp probe --axis Z --speed 100",
        "amp-studio simulate MILL_1394.amp travel --axis X,Y --set move.start=-10,-10 --set move.to=-100,-20",
        "amp-studio simulate MILL_1394.amp sweep --axis X -o map.svg",
        (
            "amp-studio simulate MILL_1394.amp sweep --axis X --over model.inertia_ratio=0.5:2 --over"
            " model.resonance=60:90 --samples 200"
        ),
        "amp-studio simulate MILL_1394.amp identify record.csv --axis X -o machine.yaml",
        "amp-studio simulate MILL_1394.amp step --axis X --machine machine.yaml",
    ),
)


_DRAWN = (".svg", ".png", ".pdf", ".html")
"""Endings of what has a picture in it."""
_HAVE_OPTIONS = {"speed": ("spindle", "tap", "probe"), "pitch": ("tap",)}
"""Option -> the scenarios that it belongs to."""

_SETTING_GROUPS = ("move", "model", "tune", "sweep", "gear", "cam")
"""First words of settings. A parameter whose id begins so, as ``cam.time`` of the 57C422B, is no setting."""


def run(options: Options) -> int:
    """Move the machine; 1 where it raised an alarm."""
    from amp_studio.sim import called_parameter, named_parameter, trace_summary, trace_text

    if options.output:
        # Before anything is computed: a sweep takes minutes, and must not replace what it was made of.
        beside = filter(None, (options.record, options.machine_file))
        check_replaced(options.output, options.path, *beside)
    machine = opened(options.path)
    if options.list:
        return _list(machine.file, options.units, as_json=options.json)
    if options.scenario is None:
        raise UsageError("Name a scenario; amp-studio simulate PATH --list lists them")
    if options.keep is not None and options.scenario != "tune":
        raise UsageError(f"--keep belongs to tune, not to {options.scenario}")
    if options.scenario == IDENTIFY:
        return _identify(options, machine)
    file, trace, earlier = _simulated(options, machine)
    if options.output:
        _write(options, file, trace, earlier)
    if options.json:
        print_json(trace_summary(trace, lambda parameter: named_parameter(file, parameter, trace.axis)))
    else:
        print(trace_text(trace, lambda parameter: called_parameter(file, parameter, trace.axis)))
    if options.keep is not None:  # behind the figures, which a full disk must not take along
        _keep(options, file, trace)
    # An alarm is a result: a script reads it from the exit code, and 2 stays for what cannot be used.
    return 1 if trace.alarms else 0


def _simulated(options: Options, machine: MachineParameters) -> tuple[ParameterFile, Trace, Trace | None]:
    """Return the file with the values to try, its trace, and for a picture that of the file as it is."""
    from amp_studio.sim import laid_over, machine_for, read_machine

    settings, own = _settings_and_assignments(options, machine.schema.parameters)
    messages: list[str] = []
    tried = machine.with_values(assignments(own), notify=messages.append)
    axis = _axis(options, tried)
    if options.machine_file:
        axis, plant = machine_for(tried.file, read_machine(options.machine_file), axis)
        # What --set gives is what the user tries: it has precedence over the machine that was measured.
        settings = {**plant, **settings}
    system = options.units or tried.file.header.units
    way = _way(options) if options.scenario == "sweep" else None
    trace = tried.simulate(options.scenario, axis, units=system, way=way, **settings)
    if options.against:
        trace = laid_over(trace, options.against, trigger_given(options))
    print_remarks(messages)
    # The second run takes as long as the first: only for a picture, which draws one under the other.
    if own and options.output and options.output.suffix.lower() in _DRAWN:
        return tried.file, trace, _earlier(machine, trace, settings, system)
    return tried.file, trace, None


def _keep(options: Options, file: ParameterFile, trace: Trace) -> None:
    """Add what `tune` found to the tuning record of the file."""
    from amp_studio.sim import add_tuning, recorded_tuning

    machine, aim = _given_machine(options), options.aim or "normal"
    add_tuning(options.path, recorded_tuning(file, options.path, trace, aim, machine, options.keep))


def _write(options: Options, file: ParameterFile, trace: Trace, before: Trace | None) -> None:
    """Write a trace as data, picture or document, by the ending."""
    from amp_studio.motion_paper import PAPERS, write_motion_paper
    from amp_studio.sim import write_trace

    chart = options.chart or CHARTS[0]
    if options.output.suffix.lower() in PAPERS:
        name = options.path.name
        given = _given_machine(options)
        write_motion_paper(
            file,
            name,
            trace,
            options.output,
            print_remark,
            before=before,
            chart=chart,
            machine=given,
            language=options.language,
        )
    else:
        write_trace(trace, options.output, print_remark, before=before, chart=chart)


def _given_machine(options: Options) -> list[tuple[str, str, str]]:
    """Return what was given of the machine: figure, value, and where it is from."""
    from amp_studio.sim import read_machine

    found: dict[str, tuple[str, str, str]] = {}
    if options.machine_file:
        settings = read_machine(options.machine_file).settings
        found = {name: (name, text, options.machine_file.name) for name, text in settings.items()}
    # --set last, as in the simulation: the document names what was computed with.
    own = ((name, text) for name, text in assignments(options.assignments) if name.startswith("model."))
    return list((found | {name: (name, text, "--set") for name, text in own}).values())


def _settings_and_assignments(options: Options, known: Container[str]) -> tuple[dict[str, Any], list[str]]:
    """Return the settings of the scenario and the machine, and the assignments of parameters."""
    if options.trigger and not options.against:
        raise UsageError("--trigger belongs to --against")
    of_options = _settings_with_options(options)
    if (options.record and not of_options) or options.scale:
        raise UsageError(f"a record and its scale belong to {IDENTIFY}, not to {options.scenario}")
    if options.chart and options.scenario != "frequency":
        raise UsageError(f"--chart belongs to frequency, not to {options.scenario}")
    named, own = _settings(options.assignments, known)
    settings: dict[str, Any] = {**of_options, **named}
    if options.aim:
        if options.scenario != "tune":
            raise UsageError(f"--for belongs to tune, not to {options.scenario}")
        settings["tune.for"] = options.aim
    return settings | _sweep_settings(options), own


def _settings_with_options(options: Options) -> dict[str, float | str]:
    """Return the settings that have an option, or a word, of their own: an S word, --speed, --pitch."""
    found: dict[str, float | str] = {}
    # One positional argument for both: the record of identify, the S word of spindle.
    if options.record and options.scenario == "spindle":
        word = str(options.record)
        if not re.fullmatch(r"[Ss]?[+-]?[0-9]+([.,][0-9]+)?", word):
            raise UsageError(f"'{word}' is no S word: S1500, with a minus for M4")
        # The sign stays: M4 is a speed below 0.
        found["move.speed"] = word.lstrip("Ss")
    for name in ("speed", "pitch"):
        value = getattr(options, name)
        if value is None:
            continue
        if options.scenario not in _HAVE_OPTIONS[name]:
            raise UsageError(
                f"--{name} belongs to {' and '.join(_HAVE_OPTIONS[name])}, not to {options.scenario}"
            )
        found[f"move.{name}"] = value
    return found


def _sweep_settings(options: Options) -> dict[str, float | str]:
    """Return the options of a sweep as its settings; raises UsageError for another scenario."""
    given = {
        "sweep.over": ";".join(options.over),
        "sweep.samples": options.samples,
        "sweep.figure": options.figure,
    }
    found = {name: value for name, value in given.items() if value}
    if options.scenario != "sweep" and (found or options.scheduler or options.jobs):
        raise UsageError(
            f"--over, --samples, --figure, --scheduler and --jobs belong to sweep, not to {options.scenario}"
        )
    # A setting of a scenario is a decimal number or a text; the samples are a count.
    return {name: float(value) if isinstance(value, int) else value for name, value in found.items()}


def _way(options: Options) -> SweepWay:
    from amp_studio.sim import SweepWay

    return SweepWay(options.scheduler, options.jobs, progress(), options.output)


def _axis(options: Options, machine: MachineParameters) -> str | None:
    """Return the axis by itself, several as ``1,2``."""
    if not options.axis:
        return None
    return ",".join(machine.axis(each.strip()) for each in options.axis.split(","))


def _check_identify(options: Options) -> None:
    """Raise UsageError for options that do not fit together."""
    if options.record is None and options.response is None:
        raise UsageError(
            f"Name the record: amp-studio simulate {options.path} {IDENTIFY} RECORD.csv --axis X"
        )
    if options.assignments or options.machine_file:
        raise UsageError(f"{IDENTIFY} takes neither --set nor --machine: it finds the machine")
    if options.response and options.record:
        raise UsageError(f"{IDENTIFY} takes a record or --frf, not both")


def _identify(options: Options, of: MachineParameters) -> int:
    """Find the machine of an axis in a record of its drive."""
    from amp_studio.sim import (
        identified_text,
        identify,
        identify_response,
        machine_settings,
        named_parameter,
        trace_summary,
        with_uncertainty,
        write_machine,
    )

    _check_identify(options)
    file, axis = of.file, _axis(options, of)
    if options.response:
        trace = identify_response(
            file, options.response, axis, options.scale, options.units, options.quantity, options.turn
        )
    else:
        trace = identify(file, options.record, axis, options.scale, options.units, options.turn)
    # A machine that --machine reads again; every other ending is a document about the record.
    if options.output and options.output.suffix.lower() in (".yaml", ".yml"):
        write_machine(trace, file.schema.family.family, options.output, print_remark)
    elif options.output:
        _write(options, file, trace, None)
    if options.json:
        machine = {"machine": machine_settings(trace)}
        summary = trace_summary(trace, lambda parameter: named_parameter(file, parameter, trace.axis))
        print_json(with_uncertainty(summary) | machine)
    else:
        print(identified_text(trace))
    return 0


def _earlier(machine: MachineParameters, trace: Trace, settings: dict[str, Any], system: str) -> Trace | None:
    """Return the same move with the values in the file, to draw under that of the changed ones;
    None where it has none.
    """
    from amp_studio.sim import SimulationError

    try:
        return machine.simulate(trace.scenario, trace.axis, units=system, like=trace, **settings)
    # Often the reason why values are tried at all: with those of the file the move cannot be made.
    except SimulationError:
        return None


def _settings(texts: Sequence[str], known: Container[str]) -> tuple[dict[str, float | str], list[str]]:
    """Part the settings of the scenario and its model (``move.feedrate=3000``) from parameters, of which
    ``known`` has the ids.
    """
    settings: dict[str, float | str] = {}
    own = []
    for param, text in assignments(texts):
        if param.partition(".")[0] in _SETTING_GROUPS and param.partition("@")[0] not in known:
            settings[param] = text
        else:
            own.append(f"{param}={text}")
    return settings, own


def _list(file: ParameterFile, system: str | None, *, as_json: bool) -> int:
    """Print what can be simulated with a file."""
    from amp_studio.sim import listing, titled

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
