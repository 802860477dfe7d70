"""Calculate a published formula of a family; without one, list them."""

from __future__ import annotations

from amp_studio.cli import candidates
from amp_studio.cli.arguments import FAMILY
from amp_studio.cli.console import assignments, family
from amp_studio.cli.errors import UsageError
from amp_studio.cli.verb import Options, Verb, VerbArgument

VERB = Verb(
    __doc__,
    FAMILY,
    VerbArgument("formula", nargs="?", help="the formula to calculate", completes=candidates.formulas),
    VerbArgument("arguments", nargs="*", metavar="NAME=VALUE", help="the values the formula needs"),
    sections=("families",),
    examples=("amp-studio calculate 9pc", "amp-studio calculate 9pc acceleration_time_s milliseconds=125"),
)


def run(options: Options) -> int:
    """List the formulas of a family, describe one, or calculate it."""
    from amp_studio.schema import unknown_name
    from amp_studio.validate import calculate, calculators, shown_result

    known = calculators(family(options.family).family.family)
    if options.formula is None:
        for calculator in known.values():
            print(f"{calculator.name}: {calculator.description.splitlines()[0]}")
        return 0
    if options.formula not in known:
        raise UsageError(f"{unknown_name('formula', options.formula, known)}; without a name all are listed")
    calculator = known[options.formula]
    if not options.arguments:
        print(calculator.description)
        for argument in calculator.arguments:
            default = f" (else {argument.default})" if argument.default is not None else ""
            print(f"  {argument.name}=…{f' {argument.example}' if argument.example else ''}{default}")
        return 0
    texts = dict(assignments(options.arguments, "NAME=VALUE"))
    print(shown_result(calculate(options.family, options.formula, texts)))
    return 0
