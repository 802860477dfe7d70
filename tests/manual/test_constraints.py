"""Every constraint that a manual states is covered by something: a range, a choice, a state, a need or a rule.

``constraints/`` lists the manuals' constraining statements, each with its line in the text and its page. What cannot
be decided from a parameter file is listed too, with the reason.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from statements import statements, untold

LISTS = sorted(Path(__file__).with_name("constraints").glob("*.yaml"))


@pytest.mark.parametrize("path", LISTS, ids=lambda path: path.stem)
def test_whatever_a_manual_demands_something_tells(path: Path) -> None:
    assert untold(path) == []


@pytest.mark.parametrize("path", LISTS, ids=lambda path: path.stem)
def test_the_statements_stand_in_the_order_of_the_text(path: Path) -> None:
    lines = [statement.line for statement in statements(path)]
    assert lines == sorted(lines)
