"""What a control states of itself now: positions, following errors, states and faults."""

from __future__ import annotations

from amp_studio.cli import candidates
from amp_studio.cli.arguments import JSON, OUTPUT, seconds
from amp_studio.cli.console import family, print_json, print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.motion.trigger import trigger_given
from amp_studio.cli.output import check_replaced
from amp_studio.cli.stopping import stop_requested
from amp_studio.cli.verb import Options, Verb, VerbArgument

TYPE_CHECKING = False  # the typing module is not loaded for it
if TYPE_CHECKING:
    from collections.abc import Iterator

    from amp_studio.transfer import ActiveFault, AxisStatus, ControlStatus

VERB = Verb(
    __doc__,
    VerbArgument("address", metavar="ADDRESS", help="where the control is reached"),
    VerbArgument("--family", help="the family it must be of", completes=candidates.families),
    VerbArgument(
        "--watch", action="store_true", help="ask again, five times a second, until it is interrupted"
    ),
    OUTPUT.but(
        required=False,
        help="CSV in which readings of one axis are recorded, each at its time, for simulate --against",
    ),
    VerbArgument("--axis", help="-o: the axis by the letter that the control shows (default: its only one)"),
    VerbArgument(
        "--seconds", type=seconds, metavar="SECONDS", help="-o: how long is recorded (default: until Ctrl-C)"
    ),
    VerbArgument(
        "--trigger",
        metavar="SIGNAL>LEVEL",
        help="-o: waits until a signal passes a level, 'velocity>100', or is at it, 'following_error>=20'",
    ),
    VerbArgument(
        "--pre-trigger",
        type=seconds,
        metavar="SECONDS",
        help="--trigger: what is kept ahead of it (default: one reading)",
    ),
    JSON,
    writes=("output",),
    sections=("ADDRESS",),
    at_control=True,
    examples=("amp-studio status tcp://127.0.0.1:8193",),
)
PERIOD = 0.2  # s: no control is asked more often
_PLACES = 4


def run(options: Options) -> int:
    """Print what a control states now; with --watch again and again."""
    import time
    from contextlib import closing

    from amp_studio import connect

    if options.family:
        family(options.family)
    if options.output:
        return _record(options)
    if any((options.axis, options.seconds, options.trigger, options.pre_trigger)):
        raise UsageError("--axis, --seconds, --trigger and --pre-trigger belong to -o, which records")
    with closing(connect(options.address, options.family or "").watch()) as seen:
        while True:
            begun = time.monotonic()
            status = next(seen)
            if options.json:
                print_json(_as_json(options.address, status))
            else:
                print(text(status), flush=True)
            if not options.watch:
                return 0
            # What the answer has taken counts: the period is from one question to the next.
            time.sleep(max(PERIOD - (time.monotonic() - begun), 0.0))


def _record(options: Options) -> int:
    """Record the readings of one axis; Ctrl-C ends it and keeps what there is."""
    import time
    from contextlib import closing

    from amp_studio import connect
    from amp_studio.sim import LiveRecorder, write_recording

    check_replaced(options.output)
    trigger = trigger_given(options)
    recorder = LiveRecorder(trigger, options.seconds)
    # Without --seconds Ctrl-C is how a recording ends: no verb was stopped by it, and the code is 0.
    with stop_requested() as stop, closing(connect(options.address, options.family or "").watch()) as seen:
        began = time.monotonic()
        while not (recorder.is_done or stop.is_set()):
            asked = time.monotonic()
            axis = _axis_of(next(seen), options.axis)
            if recorder.count == 0 and trigger is not None:
                print_remark(f"Axis {axis.axis} waits for {trigger}")
            recorder.add(time.monotonic() - began, axis.signals())
            time.sleep(max(PERIOD - (time.monotonic() - asked), 0.0))
    recording = recorder.recording(options.output.stem)
    write_recording(recording, options.output)
    facts = {
        "file": str(options.output),
        "axis": axis.axis,
        "readings": len(recording.time),
        "seconds": float(recording.time[-1]),
        "rate": recording.rate,
        "signals": list(recording.signals),
        "has_fired": recorder.has_fired,
    }
    if options.json:
        print_json(facts)
        return 0
    waited = "" if recorder.has_fired else f"; the trigger {trigger} did not fire"
    print(
        f"{options.output}: {facts['readings']} readings of axis {axis.axis} in {facts['seconds']:.1f} s,"
        f" {recording.rate:.1f} a second: {', '.join(recording.signals).replace('_', ' ')}{waited}"
    )
    return 0


def _axis_of(status: ControlStatus, name: str | None) -> AxisStatus:
    """Return the axis by the letter that the control shows, its only one without; raises UsageError."""
    found = [axis for axis in status.axes if name is None or axis.axis.casefold() == name.casefold()]
    if len(found) == 1:
        return found[0]
    known = ", ".join(axis.axis for axis in status.axes) or "none"
    raise UsageError(f"Name the axis that is recorded with --axis; the control shows {known}")


def _as_json(address: str, status: ControlStatus) -> dict[str, object]:
    """Return a status as other programs read it."""
    from dataclasses import asdict

    return {"address": address, **asdict(status)}


def text(status: ControlStatus) -> str:
    """Return a status as a person reads it."""
    lines = [f"{status.name or status.family}{': ' + status.state if status.state else ''}"]
    lines += map(_axis_line, status.axes)
    lines += [f"  {name} {_number(value)}" for name, value in status.values.items()]
    for fault in status.faults:
        lines += _fault_lines(fault)
    return "\n".join((*lines, *(f"  {note}" for note in status.assumptions)))


def _axis_line(axis: AxisStatus) -> str:
    """Return the figures and states of an axis, of those that the control sends."""
    figures = (
        ("", axis.position, axis.unit),
        ("following error", axis.following_error, axis.unit),
        ("velocity", axis.velocity, f"{axis.unit}/s"),
    )
    texts = [f"{name} {_number(value)} {unit}".strip() for name, value, unit in figures if value is not None]
    return f"  {axis.axis}  {', '.join((*texts, *axis.states))}"


def _fault_lines(fault: ActiveFault) -> Iterator[str]:
    """Yield a fault with its causes, cures and parameters."""
    where = f" of axis {fault.axis}" if fault.axis else ""
    page = f" (page {fault.page})" if fault.page else ""
    yield f"  fault{where}: {fault.code} {fault.text}{page}"
    yield from (f"    cause: {cause}" for cause in fault.causes)
    yield from (f"    cure: {cure}" for cure in fault.cures)
    if fault.params:
        yield f"    parameters: {', '.join(fault.params)}"


def _number(value: float | str) -> str:
    return (
        value
        if isinstance(value, str)
        else f"{round(value, _PLACES):g}"
        if abs(value) < 1e6
        else f"{value:.0f}"
    )
