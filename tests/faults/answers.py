"""Damaged files of answers to the questions of a migration: each is refused in one line,
or its answers are texts.
"""

from pathlib import Path

from amp_studio.meaning import read_answers

from .texts import mutants, violations

FILES = ("home.order: Z, X Y\nfeedback.sign.X: +\n", "# by hand\nhome.speed.X: '3000'\nletter.W: C\n")


def fuzz_answers(folder: Path, seed: int, count: int) -> list[str]:
    """Return what broke the promise."""
    path = folder / "answers.yaml"

    def take(text: str) -> None:
        path.write_bytes(text.encode("utf-8", "replace"))
        found = read_answers(path)
        assert all(isinstance(word, str) for pair in found.items() for word in pair)

    return violations(mutants(FILES, seed, count), take, (ValueError,))
