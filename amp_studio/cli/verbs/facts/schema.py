"""Every parameter definition of a family."""

from __future__ import annotations

from amp_studio.cli import candidates
from amp_studio.cli.arguments import FAMILY, JSON
from amp_studio.cli.console import family, print_json
from amp_studio.cli.errors import UsageError
from amp_studio.cli.verb import Options, Verb, VerbArgument

TYPE_CHECKING = False  # the typing module is not loaded for it
if TYPE_CHECKING:
    from amp_studio.schema import Group, Schema

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

    schema = family(options.family)
    groups = _named_groups(schema, options.group) if options.group else schema.groups
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


def _named_groups(schema: Schema, name: str) -> list[Group]:
    """Return the groups with this key, name or section; raises UsageError."""
    from amp_studio.schema import unknown_name

    called = name.casefold()
    named_groups = [g for g in schema.groups if called in map(str.casefold, (g.key, g.name, g.section))]
    if not named_groups:
        raise UsageError(unknown_name("group", name, [g.name for g in schema.groups]))
    return named_groups
