"""The sources as syntax trees, read once: many tests look at all of them, each for something else."""

import ast
from functools import cache
from pathlib import Path

import measure_house


@cache
def text_of(path: Path) -> str:
    """Return the text of a file. Where it lacks a word, the tree need not be searched for that word."""
    return path.read_text(encoding="utf-8")


@cache
def nodes_of(path: Path) -> tuple[ast.AST, ...]:
    """Return every node of a file, in the order of ``ast.walk``."""
    return tuple(ast.walk(measure_house.tree_of(path)))
