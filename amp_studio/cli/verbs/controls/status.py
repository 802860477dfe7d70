"""What a control states of itself now: positions, following errors, states and faults."""

from __future__ import annotations

from amp_studio.cli import candidates
from amp_studio.cli.arguments import JSON
from amp_studio.cli.console import family, print_json
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
    JSON,
    sections=("ADDRESS",),
    at_control=True,
    examples=("amp-studio status tcp://127.0.0.1:8193",),
)
PERIOD = 0.2  # s: no control is asked more often
PLACES = 4


def run(options: Options) -> int:
    """Print what a control states now; with --watch again and again."""
    import time
    from contextlib import closing

    from amp_studio import connect

    if options.family:
        family(options.family)
    with closing(connect(options.address, options.family or "").watch()) as seen:
        while True:
            begun = time.monotonic()
            status = next(seen)
            if options.json:
                print_json(as_json(options.address, status))
            else:
                print(text(status), flush=True)
            if not options.watch:
                return 0
            time.sleep(max(PERIOD - (time.monotonic() - begun), 0.0))


def as_json(address: str, status: ControlStatus) -> dict[str, object]:
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
        else f"{round(value, PLACES):g}"
        if abs(value) < 1e6
        else f"{value:.0f}"
    )
