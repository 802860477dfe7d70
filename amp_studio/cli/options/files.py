"""The verbs about the values, the axes and the steps of a file."""

from __future__ import annotations

from amp_studio.cli.arguments import (
    Verbs,
    json_option,
    language_option,
    path_of,
    secrets_option,
    text_options,
)

AXIS_OPERATIONS = ("list", "compare", "copy", "swap", "name", "type", "add", "remove")
"""What the verb about axes does; here, because help loads no room."""


def add(verbs: Verbs) -> None:
    """Add the verbs about the values, the axes and the steps of a file."""
    _files(verbs)
    _guide(verbs)
    _axes(verbs)


def _files(verbs: Verbs) -> None:
    """Add the verbs about the values of a file."""
    sub = verbs.add("new", "files", "a new parameter file with the family's defaults", writes="path")
    sub.add_argument("family")
    sub.add_argument("path", type=path_of)
    sub.add_argument("--machine")
    sub.add_argument(
        "--axes", help="axis names in order, with commas; where axes are in groups, X.2 is X of group 2"
    )
    sub.add_argument("--like", metavar="FILE|EXAMPLE",
                     help="with the values of this file or example, except what was measured on that machine, and passwords")  # fmt: skip
    sub = verbs.add(
        "set", "files", "change values, all or none; the previous file becomes the backup", writes="path"
    )
    sub.add_argument("path", type=path_of)
    sub.add_argument("assignments", nargs="+", metavar="PARAM=VALUE")
    sub.add_argument("--force", action="store_true", help="take values out of range, and mark them")
    sub = verbs.add("get", "files", "values with unit, default, and whether changed")
    sub.add_argument("path", type=path_of)
    sub.add_argument("params", nargs="*", metavar="PARAM")
    sub.add_argument("--all", action="store_true", help="also what is hidden or not set")
    for name, meaning in (
        ("changed", "only values that are not the printed default"),
        ("axes-differ", "only parameters whose axes have different values"),
        ("with-findings", "only values that cause a finding"),
        ("since-download", "only what is not as in the last recorded download"),
        ("restart", "only values that take effect after a restart"),
        ("with-notes", "only values with a note"),
    ):
        sub.add_argument(f"--{name}", action="store_true", help=meaning)
    sub.add_argument(
        "--not-set",
        action="store_true",
        help="only active values that are not set, step by step of the guide",
    )
    json_option(sub)
    secrets_option(sub)
    text_options(sub)
    sub = verbs.add(
        "note", "notes", "read and write notes about values, groups and the machine", writes="path"
    )
    sub.add_argument("path", type=path_of)
    sub.add_argument(
        "about",
        nargs="?",
        metavar="PARAM|group:KEY|machine",
        help="what it is about; KEY of a group, or its name; without it all notes are listed",
    )
    sub.add_argument("text", nargs="?", help="the note; without it the present one is printed")
    sub.add_argument("--remove", action="store_true", help="remove the note")
    json_option(sub)


def _guide(verbs: Verbs) -> None:
    """Add the verb that leads through commissioning."""
    sub = verbs.add("guide", "guide", "the steps of commissioning in the manual's order: what is set, what is not, what is next",
                    writes="path output")  # fmt: skip
    sub.add_argument(
        "path", type=path_of, metavar="FILE", help="parameter file (.amp), or a family for its steps alone"
    )
    sub.add_argument(
        "step", nargs="?", metavar="STEP", help="only this step, by number or id, with its values"
    )
    sub.add_argument("--step", dest="at", metavar="STEP", help="the same")
    sub.add_argument("--next", action="store_true", help="the next value that is not set, with its help")
    sub.add_argument("--after", metavar="PARAM", help="with --next: the one that comes after this parameter")
    sub.add_argument(
        "--done", action="append", metavar="STEP", help="tick a step as done; it is kept in the file"
    )
    sub.add_argument("--not-done", action="append", metavar="STEP", help="take that tick away")
    sub.add_argument(
        "--keep-defaults", metavar="STEP", help="set what is not set in a step to the printed defaults"
    )
    sub.add_argument("-o", "--output", type=path_of, help="write the check list as .pdf, .html or .txt")
    language_option(sub)
    json_option(sub)


def _axes(verbs: Verbs) -> None:
    """Add the verb about the axes of a file."""
    sub = verbs.add("axis", "axes", "list, compare, name, copy, swap, add and remove axes", writes="path")
    sub.add_argument("path", type=path_of)
    sub.add_argument(
        "operation",
        nargs="?",
        choices=AXIS_OPERATIONS,
        default="list",
        help="compare A B, copy FROM TO, swap A B, name A LETTER, type A TYPE, add LETTER [PLACE], remove A",
    )
    sub.add_argument(
        "arguments",
        nargs="*",
        metavar="ARGUMENT",
        help="an axis by itself or by its letter, a letter, a type",
    )
    json_option(sub)
    secrets_option(sub)
