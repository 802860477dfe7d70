"""How a raw text is framed on the line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from amp_studio.cli.verb import Options

if TYPE_CHECKING:
    from amp_studio.transfer.plain import Tape

_BLANKS = {"nul": b"\0", "space": b" "}


def tape(options: Options) -> Tape:
    from amp_studio.transfer.plain import Tape

    return Tape(options.leader, _BLANKS[options.blank], options.percent)
