"""A block, typed: each word, the number it becomes and what it does under a file; without a block,
what is active after power-up.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from amp_studio.cli.arguments import JSON, PATH, TEXT
from amp_studio.cli.console import print_json
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from amp_studio.files import ParameterFile
    from amp_studio.programs import BlockWord, PowerUp, PowerUpLine, ReadBlock
    from amp_studio.schema import Address

VERB = Verb(
    __doc__,
    PATH,
    VerbArgument(
        "block", nargs="*", help="a block, in quotes; each further one is read after it", signed=True
    ),
    JSON,
    *TEXT,
    examples=('amp-studio block MILL_1394.amp "G01 X10.5 F200"', "amp-studio block MILL_1394.amp"),
)
_MAX_BLOCKS = 1000
"""Blocks that are read."""


def run(options: Options) -> int:
    """Read blocks: 1 where the control refuses a word."""
    from amp_studio.programs import power_up

    file = opened(options.path, options).file
    # Without a printed page there is no guess: a letter is a feed at one control and a dwell at another.
    if not file.schema.program.page:
        raise UsageError(f"{file.schema.family.name}: no page here prints how its blocks are read")
    if not options.block:
        state = power_up(file)
        print_json(_state_json(file, state)) if options.json else _print_state(file, state)
        return 0
    # An argument may be several lines that were pasted.
    blocks = _read(file, "\n".join(options.block).splitlines())
    if options.json:
        print_json(_json(file, blocks))
    else:
        _print(file, blocks)
    return int(any(block.faults for block in blocks))


def _read(file: ParameterFile, lines: Sequence[str]) -> list[ReadBlock]:
    """Return blocks as the control reads them one after the other; raises UsageError for too many, and for
    what is no block.
    """
    from amp_studio.programs import BlockReader, ProgramBlockError

    if len(lines) > _MAX_BLOCKS:
        raise UsageError(f"{len(lines)} blocks are more than {_MAX_BLOCKS}")
    # One for all of them: what a block switches on is active in the next one.
    reader = BlockReader(file)
    try:
        return [reader.read(line) for line in lines]
    except ProgramBlockError as error:
        raise UsageError(f"{error}") from None


def _labels(file: ParameterFile, addresses: Iterable[Address]) -> list[str]:
    return [file.machine_schema.short(address) for address in addresses]


def _json(file: ParameterFile, blocks: Sequence[ReadBlock]) -> dict[str, Any]:
    """Return the blocks word by word, as ``--json`` prints them."""
    words = [
        {
            "block": n,
            "word": word.word,
            "number": word.number,
            "unit": word.unit,
            "meaning": word.meaning,
            "params": _labels(file, word.params),
            "source": word.page,
            **({"error": word.fault} if word.fault else {}),
        }
        for n, block in enumerate(blocks, 1)
        for word in block.words
    ]
    return {
        "file": str(file.header.name),
        "words": words,
        "errors": [fault for block in blocks for fault in block.faults],
        "unknown": _unknown(blocks),
        "assumptions": _assumptions(blocks),
    }


def _unknown(blocks: Sequence[ReadBlock]) -> list[str]:
    return [word.word for block in blocks for word in block.words if not word.is_known]


def _assumptions(blocks: Sequence[ReadBlock]) -> list[str]:
    return list(dict.fromkeys(text for block in blocks for text in block.assumptions))


def _row(file: ParameterFile, word: BlockWord) -> tuple[str, str, str, str]:
    """Return a word, its figure, what it means, and its parameters with the page."""
    return (
        word.word,
        "" if word.number is None else f"{word.number:.10g} {word.unit}".strip(),
        f"{word.meaning}: {word.fault}" if word.fault else word.meaning,
        f"{', '.join(_labels(file, word.params))} (page {word.page})".strip() if word.page else "",
    )


def _print(file: ParameterFile, blocks: Sequence[ReadBlock]) -> None:
    """Print each word with its figure, meaning and page, then what is not known and what is assumed."""
    for n, block in enumerate(blocks):
        if len(blocks) > 1:
            print("" if n == 0 else "\n", block.text, sep="")
        _print_rows([_row(file, word) for word in block.words])
    if unknown := _unknown(blocks):
        print(f"Not known here: {', '.join(unknown)}. {file.schema.program.not_printed}.")
    for assumption in _assumptions(blocks):
        print(f"ASSUMED {assumption.removeprefix('assumed: ')}")


def _print_rows(rows: Sequence[Sequence[str]]) -> None:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        print("  ".join(f"{cell:{width}}" for cell, width in zip(row, widths, strict=True)).rstrip())


def _state_json(file: ParameterFile, state: PowerUp) -> dict[str, Any]:
    """Return what is active after power-up, as ``--json`` prints it."""

    def rows(lines: Sequence[PowerUpLine]) -> list[dict[str, Any]]:
        return [
            {
                "what": line.what,
                "code": line.code,
                "meaning": line.meaning,
                "params": _labels(file, line.params),
                "source": line.page,
            }
            for line in lines
        ]

    return {"active": rows(state.active), "changes": rows(state.changes), "calls": rows(state.calls)}


def _print_state(file: ParameterFile, state: PowerUp) -> None:
    """Print what is active after power-up, what changes it, and which codes call programs."""
    for title, lines in (
        ("After power-up", state.active),
        ("What changes it", state.changes),
        ("Calls", state.calls),
    ):
        if lines:
            print(f"{title}:")
            _print_rows(
                [
                    (
                        f"  {line.what}",
                        line.code,
                        line.meaning,
                        f"{', '.join(_labels(file, line.params))} (page {line.page})",
                    )
                    for line in lines
                ]
            )
