"""What answers at an address, and what it contains."""

from __future__ import annotations

from dataclasses import asdict

from amp_studio.cli import candidates
from amp_studio.cli.arguments import JSON
from amp_studio.cli.console import family, print_json, progress
from amp_studio.cli.verb import Options, Verb, VerbArgument

TYPE_CHECKING = False  # the typing module is not loaded for it
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from amp_studio.control import ControlLook

VERB = Verb(
    __doc__,
    VerbArgument("address", metavar="ADDRESS", help="where the control is reached"),
    VerbArgument("--family", help="the family it must be of", completes=candidates.families),
    JSON,
    sections=("ADDRESS",),
    at_control=True,
    examples=("amp-studio identify tcp://127.0.0.1:8193",),
)


def run(options: Options) -> int:
    """Print who answers at an address, and what it contains."""
    from amp_studio import connect
    from amp_studio.cli.controls.by_hand import print_by_hand, ways_offered
    from amp_studio.report import counted

    if options.family:
        family(options.family)
    with ways_offered(options.family or "", options.address):
        found = connect(options.address, options.family or "", progress=progress()).look()
    control, abilities, content = found.identity, found.abilities, found.content
    print_by_hand(control.family)
    axes, signature, values, unreadable = _read(found)
    if options.json:
        print_json(
            {
                "address": options.address,
                "protocol": control.protocol,
                "abilities": asdict(abilities),
                "family": control.family,
                "name": control.name,
                "revision": control.revision,
                "axes": axes,
                "signature": signature,
                "size": len(content),
                "sha256": found.sha256,
                "values": values,
                "unreadable": unreadable or None,
                "in_estop": control.in_estop,
                "restart_needed": control.restart_needed,
            }
        )
        return 0
    readable = f"not readable: {unreadable}" if values is None else counted(values, "value")
    print("\n".join(_lines(found, axes, readable)))
    return 0


def _read(look: ControlLook) -> tuple[list[str], str, int | None, str]:
    """Return axes and signature of a control, as it names them or its content does, and how many values it
    contains; None where they are not readable, with the reason.
    """
    from amp_studio.files import fitted_axes
    from amp_studio.transfer import ImageError

    axes, signature = list(look.identity.axes), look.identity.signature
    try:
        file = look.machine().file
    except ImageError as error:
        return axes, signature, None, str(error) if look.content else "it is empty"
    return axes or list(fitted_axes(file)), signature or file.schema.signature, len(file.values), ""


def _lines(look: ControlLook, axes: Sequence[str], readable: str) -> Iterator[str]:
    """Yield what a control is and contains, in words; ``readable`` is how much of it can be read."""
    control, abilities = look.identity, look.abilities
    name, revision = control.name or "A control", control.revision or "unknown"
    yield f"{name} of the family {control.family}, revision {revision}"
    yield f"protocol {control.protocol}" + ("" if abilities.can_send else ", which takes no download")
    if abilities.can_send:
        yield abilities.lasting_text()
    yield f"axes {', '.join(axes)}" if axes else "axes unknown"
    yield f"{len(look.content)} bytes, {readable}"
    yield f"sha256 {look.sha256}"
    if control.notice:
        yield control.notice
    if control.restart_needed:
        yield "Its parameters become active after a restart."
