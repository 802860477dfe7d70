"""The verbs about the facts of a family."""

from __future__ import annotations

from amp_studio.cli.arguments import Verbs, count, json_option


def add(verbs: Verbs) -> None:
    """Add the verbs about the facts of a family."""
    sub = verbs.add("families", "facts", "list the control families")
    json_option(sub)
    sub = verbs.add("schema", "facts", "every parameter definition of a family")
    sub.add_argument("family")
    sub.add_argument("--group")
    json_option(sub)
    sub = verbs.add("show", "facts", "one parameter as a person reads it")
    sub.add_argument("family")
    sub.add_argument("param")
    sub.add_argument(
        "--machine", help="machine type, where a number means another parameter on another machine"
    )
    sub = verbs.add("tables", "facts", "the manual's tables: alarms, motors, codes; without one, list them")
    sub.add_argument("family")
    sub.add_argument("table", nargs="?")
    json_option(sub)
    sub = verbs.add(
        "find",
        "find",
        "find parameters, values, choices and messages of the control by what one remembers of them; typing errors are forgiven",
    )
    sub.add_argument(
        "words", nargs="+", metavar="FAMILY|FILE WORDS", help="where to look (every family), and what for"
    )
    sub.add_argument("--family", help="look in this family")
    sub.add_argument("--limit", type=count, metavar="N", default=20, help="most hits (default: 20)")
    json_option(sub)
    sub = verbs.add("calculate", "facts", "calculate a published formula of a family; without one, list them")
    sub.add_argument("family")
    sub.add_argument("formula", nargs="?")
    sub.add_argument("arguments", nargs="*", metavar="NAME=VALUE")
