"""One parameter as a person reads it."""

from __future__ import annotations

from amp_studio.cli import candidates
from amp_studio.cli.arguments import FAMILY, MACHINE
from amp_studio.cli.console import family
from amp_studio.cli.verb import Options, Verb, VerbArgument

VERB = Verb(
    __doc__,
    FAMILY,
    VerbArgument("param", help="number or id of a parameter", completes=candidates.parameters),
    MACHINE.but(help="machine type, where a number means another parameter on another machine"),
    sections=("families", "PARAM"),
    examples=("amp-studio show 9pc 1300", "amp-studio show num P21", "amp-studio show syntec Pr61"),
)


def run(options: Options) -> int:
    """Print one parameter as a person reads it."""
    from amp_studio.report import page_of

    schema = family(options.family)
    print(page_of(schema, options.param, options.machine))
    return 0
