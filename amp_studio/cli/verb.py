"""What a verb is made of, as plain data: the parser, the help,
the man page and the completion are made of the same.

A verb is one file below ``verbs``: its ``VERB`` describes it, its ``run`` does the work. A room is imported
by the function that uses it, so that help and completion load none.
"""

from __future__ import annotations

TYPE_CHECKING = False  # the typing module is not loaded for it
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from typing import Any

    Completion = Callable[[str, str], Iterable[str]]
    """What may come in a place: of the first word behind the verb (``""`` where there is none)
    and the word that is typed."""


class Options:
    """What was given on the command line: an attribute for each argument of the verb."""

    verb: str
    """Its name."""
    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any: ...


class VerbArgument:
    """A word of a verb (``path``) or an option of it (``-o``, ``--output``).

    ``how`` are arguments of ``ArgumentParser.add_argument``; ``completes`` gives what a shell offers,
    ``signed`` is true where a value may begin with a minus and a figure (``-50=0.001``).
    """

    def __init__(
        self,
        *names: str,
        help: str,  # noqa: A002  # as argparse calls it
        completes: Completion | None = None,
        signed: bool = False,
        **how: Any,
    ) -> None:
        self.names, self.help, self.completes, self.signed, self.how = names, help, completes, signed, how
        self.is_option = names[0].startswith("-")
        self.dest: str = how.get("dest", names[-1].lstrip("-").replace("-", "_"))
        self.choices: tuple[str, ...] = how.get("choices", ())
        self.is_flag = how.get("action", "store") not in ("store", "append")
        """Whether it is an option without a value."""
        self.takes_more = how.get("nargs") in ("*", "+")

    @property
    def label(self) -> str:
        """What the man page calls it: its options, or the name of its place."""
        return ", ".join(self.names) if self.is_option else str(self.how.get("metavar", self.dest.upper()))

    def but(self, **changes: Any) -> VerbArgument:
        """Return the same argument with other properties."""
        mine = {"help": self.help, "completes": self.completes, "signed": self.signed, **self.how}
        return VerbArgument(*self.names, **{**mine, **changes})


class Verb:
    """One verb: what it is for, what it takes, and what its help ends with.

    ``about`` is the docstring of its file, one sentence; ``sections`` are titles of ``manual.SECTIONS``;
    ``writes`` names the arguments whose files it may replace; ``at_control`` is true where it may connect to
    a control and have the user asked for a password.
    """

    def __init__(
        self,
        about: str | None,
        *arguments: VerbArgument,
        examples: tuple[str, ...],
        sections: tuple[str, ...] = (),
        writes: tuple[str, ...] = (),
        at_control: bool = False,
    ) -> None:
        self.about = " ".join((about or "").split())
        self.arguments, self.examples = arguments, examples
        self.sections, self.writes, self.at_control = sections, writes, at_control

    @property
    def options(self) -> list[str]:
        """Every option as it is typed."""
        return ["-h", "--help", *(name for each in self.arguments if each.is_option for name in each.names)]
