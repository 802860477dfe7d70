"""Many machines side by side: which of them have the same value, whatever its unit."""

import pytest

from amp_studio.files import new_file
from amp_studio.report import machine_lines
from amp_studio.report.papers import differences
from amp_studio.schema import Value, evaluation

EXCESS = ("servo.excess_error", "1")


def test_values_are_the_same_in_any_unit_and_no_pair_of_machines_is_compared(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of a thousand machines half a million pairs were, for each value that differs."""
    base = new_file("9pc", "mill", ["X"], "bare")
    files = [base.copy() for _ in range(60)]
    for n, file in enumerate(files):
        file.set(EXCESS, Value(float(n), "mm"))
    for file in files[-40:]:
        file.set(EXCESS, Value(1.0, "in"))
    files[-1].set(EXCESS, Value(25.4, "mm"))
    pairs = []
    same = evaluation.same_value

    def count(a: Value | None, b: Value | None) -> bool:
        pairs.append((a, b))
        return same(a, b)

    monkeypatch.setattr(differences, "same_value", count)
    (line,), _ = machine_lines(files)
    assert line.alike == (*range(20), *[20] * 40)
    assert line.departing == set(range(20))
    assert len(pairs) < len(files) * len(base.values), "each machine with the first"
