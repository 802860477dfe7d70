"""Compare values and every byte with what a control contains; print its digest."""

from __future__ import annotations

from dataclasses import asdict

from amp_studio.cli.arguments import JSON, PATH, SECRETS, TEXT, several_controls
from amp_studio.cli.console import print_json, print_remark, progress
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.stopping import stop_requested
from amp_studio.cli.verb import Options, Verb, VerbArgument

TYPE_CHECKING = False  # the typing module is not loaded for it
if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Any

    from amp_studio.files import Difference, ParameterFile
    from amp_studio.transfer.client import ImageComparison

VERB = Verb(
    __doc__,
    PATH.but(nargs="?", help="parameter file (.amp); with --all a folder (default: this one)"),
    *several_controls("--with", dest="control", required=False),
    VerbArgument(
        "--all",
        action="store_true",
        help="every control that the folder knows, from its exchanges and projects, against its file",
    ),
    JSON,
    SECRETS,
    *TEXT,
    sections=("ADDRESS",),
    at_control=True,
    examples=("amp-studio verify MILL_1394.amp --with tcp://127.0.0.1:8193",),
)


def run(options: Options) -> int:
    """Compare a file with what a control contains, its values and every byte; 1 where they differ."""
    from amp_studio import connect
    from amp_studio.cli.controls.by_hand import ways_offered
    from amp_studio.cli.controls.fleet import check_fleet, is_fleet, verify_several

    if options.all:
        from amp_studio.cli.controls.drift import verify_all_verb  # compares many, and prints papers

        return verify_all_verb(options)
    if options.path is None or not options.control:
        raise UsageError("verify takes a file and --with ADDRESS, or --all (see 'amp-studio verify --help')")
    machine = opened(options.path, options)
    file = machine.file
    check_fleet(options, options.control)
    if is_fleet(options, options.control):
        with stop_requested() as stop:
            from amp_studio.transfer import Exchange

            return verify_several(
                options, file, Exchange(cancel=stop, record=options.path, notify=print_remark)
            )
    control = connect(options.control[0], progress=progress(), notify=print_remark)
    with ways_offered(file.schema.family.family, control.address):
        found = control.verify(machine)
    if options.json:
        print_json(_as_json(file, found, control.sha256, secrets=options.secrets))
    else:
        _print(file, found, secrets=options.secrets)
        print(f"sha256 {control.sha256}")
    return int(not found.agrees)


def _as_json(
    file: ParameterFile, comparison: ImageComparison, sha256: str, *, secrets: bool
) -> dict[str, Any]:
    """Return the comparison as ``--json`` prints it."""
    from amp_studio.cli.checks.comparing import difference_json

    def listed(differences: Iterable[Difference]) -> list[dict[str, Any]]:
        return [difference_json(file, difference, secrets) for difference in differences]

    return {
        "differences": listed(comparison.values.differences),
        "same": comparison.values.same,
        "same_bytes": comparison.is_same,
        "sha256": sha256,
        "unreadable": comparison.unreadable or None,
        "absent": comparison.missing or None,
        "in_use": listed(comparison.in_use),
        "stays": comparison.stays or None,
        "not_compared": comparison.not_compared,
        "header": [asdict(d) for d in comparison.head],
        "other_units": listed(comparison.other_units),
    }


def _print(file: ParameterFile, comparison: ImageComparison, *, secrets: bool) -> None:
    """Print what differs: values, units, what is in use since the start, and the header."""
    from amp_studio.cli.checks.comparing import print_comparison, print_difference

    if not comparison.unreadable:
        print_comparison(file, comparison.values, secrets)
    for difference in comparison.other_units:
        print_difference(file, difference, secrets)
    for difference in comparison.in_use:
        print("in use since the start: ", end="")
        print_difference(file, difference, secrets)
    for head in comparison.head:
        print(f"{head.line} in the header: '{head.a}'  |  '{head.b}'")
    print(comparison.summary())
