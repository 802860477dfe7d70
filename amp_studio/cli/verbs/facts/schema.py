"""Every parameter definition of a family."""

from __future__ import annotations

from amp_studio.cli import candidates
from amp_studio.cli.arguments import FAMILY, JSON
from amp_studio.cli.console import family, print_json
from amp_studio.cli.errors import UsageError
from amp_studio.cli.verb import Options, Verb, VerbArgument

VERB = Verb(
    __doc__,
    FAMILY,
    VerbArgument("--group", help="only the parameters of this group", completes=candidates.groups),
    JSON,
    sections=("families",),
    examples=('amp-studio schema 9pc --group "Home Parameters"', "amp-studio schema num --json"),
)


def run(options: Options) -> int:
    """Print every parameter definition of a family."""
    from amp_studio.report import definition, one_line
    from amp_studio.schema import unknown_name

    schema = family(options.family)
    groups = schema.groups
    if options.group:
        called = options.group.casefold()
        groups = tuple(g for g in groups if called in map(str.casefold, (g.key, g.name, g.section)))
    if not groups:
        raise UsageError(unknown_name("group", options.group, [g.name for g in schema.groups]))
    parameters = [p for g in groups for p in g.parameters]
    if options.json:
        print_json(
            {
                "family": options.family,
                "signature": schema.signature,
                "parameters": [definition(schema, p) for p in parameters],
            }
        )
    else:
        for parameter in parameters:
            print(one_line(schema, parameter))
    return 0
