"""The sources as syntax trees, read once: many tests look at all of them, each for something else."""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path


@cache
def tree_of(path: Path) -> ast.Module:
    """Return the syntax tree of a file, which no test may change."""
    return ast.parse(path.read_text(encoding="utf-8"))


@cache
def nodes_of(path: Path) -> tuple[ast.AST, ...]:
    """Return every node of a file, in the order of ``ast.walk``."""
    return tuple(ast.walk(tree_of(path)))
