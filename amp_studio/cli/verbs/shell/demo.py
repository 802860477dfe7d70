"""The whole job on the example machine: in the desktop program, or here without a display."""

from __future__ import annotations

from amp_studio.cli.verb import Options, Verb, VerbArgument

VERB = Verb(
    __doc__,
    VerbArgument(
        "--terminal", action="store_true", help="stay in the terminal even where there is a display"
    ),
    examples=("amp-studio demo --terminal",),
)


def run(options: Options) -> int:
    """Do the whole job on the example machine."""
    from amp_studio.demo import run_demo  # it needs every room

    return run_demo(terminal=options.terminal)
