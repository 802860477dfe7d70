"""An emulated control that takes downloads and gives uploads, until quit or Ctrl-C."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from amp_studio.cli.arguments import FAMILY, MACHINE, folder, path_of
from amp_studio.cli.console import assignments, family, print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio.transfer.links import Endpoint

VERB = Verb(
    __doc__,
    FAMILY,
    VerbArgument("--listen", required=True, metavar="ADDRESS", help="where the control is reached"),
    VerbArgument("--state", type=folder, metavar="DIR", help="where the control keeps its memory"),
    MACHINE.but(help="machine type of the parameters it starts with"),
    VerbArgument("--no-estop", action="store_true", help="start out of E-stop"),
    VerbArgument("--manual-restart", action="store_true", help="do not restart by itself after a download"),
    VerbArgument(
        "--faults",
        default="{}",
        metavar="JSON",
        help='what goes wrong, to practise with: {"drop_after_bytes": 9000}',
    ),
    VerbArgument(
        "--option",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="what was ordered with the control, where its family has options: axes=3",
    ),
    VerbArgument(
        "--screen",
        metavar="ADDRESS",
        help="where its screen is read with status: positions, messages and alarms of a control"
        " whose protocol has none",
    ),
    VerbArgument(
        "--password-file", type=path_of, metavar="FILE", help="ask clients for the password in its first line"
    ),
    VerbArgument(
        "--certificate",
        type=path_of,
        metavar="FILE",
        help="speak TLS with this certificate (PEM); listen on tls://",
    ),
    VerbArgument(
        "--key", type=path_of, metavar="FILE", help="key of the certificate, where it is in another file"
    ),
    sections=("families", "ADDRESS"),
    at_control=True,
    examples=("amp-studio emulate 9pc --listen tcp://127.0.0.1:8193 --state control",),
)


def run(options: Options) -> int:
    """Be a control until stopped."""
    from amp_studio.transfer.emulated import EmulatedOptions, emulate
    from amp_studio.transfer.links import parse_endpoint

    # An unknown family is reported here, in the words of every verb, before a port is opened.
    family(options.family)
    return emulate(
        _secured(options),
        EmulatedOptions(
            options.family,
            options.state,
            machine=options.machine,
            estop=not options.no_estop,
            autostart=not options.manual_restart,
            faults=options.faults,
            screen=parse_endpoint(options.screen) if options.screen else None,
            hardware=dict(assignments(options.option, "NAME=VALUE")),
        ),
    )


def _secured(options: Options) -> Endpoint:
    """Return where the control listens and what it asks of who connects; notes who else can reach it."""
    from amp_studio.transfer.links import Security, can_others_read, exposure, parse_endpoint, read_password

    place = parse_endpoint(options.listen)
    # A certificate alone may have its key in the same file.
    if (options.key is not None) > (options.certificate is not None):
        raise UsageError("--key belongs to a --certificate")
    password = read_password(options.password_file) if options.password_file is not None else ""
    if options.password_file is not None and can_others_read(options.password_file):
        print_remark(f"warning: {options.password_file} can be read by other users of this computer")
    warning = (
        exposure(place.host, has_tls=place.kind == "tls", has_password=bool(password)) if place.host else ""
    )
    if warning:
        print_remark(f"warning: {warning}")
    return replace(place, security=Security(password, options.certificate, options.key))
