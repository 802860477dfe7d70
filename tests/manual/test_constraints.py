"""Every constraint that a manual states is covered by something: a range, a choice, a state,
a need or a rule.

``constraints/`` lists the manuals' constraining statements, each with its line in the text and its page. What
cannot be decided from a parameter file is listed too, with the reason.
"""

from pathlib import Path

import pytest
from statements import statements, untold

from amp_studio.schema import load_schema

LISTS = sorted(Path(__file__).with_name("constraints").glob("*.yaml"))


@pytest.mark.parametrize("path", LISTS, ids=lambda path: path.stem)
def test_whatever_a_manual_demands_something_reports(path: Path) -> None:
    assert untold(path) == []


@pytest.mark.parametrize("path", LISTS, ids=lambda path: path.stem)
def test_the_statements_stand_in_the_order_of_the_text(path: Path) -> None:
    lines = [statement.line for statement in statements(path)]
    assert lines == sorted(lines)


@pytest.mark.parametrize("family", sorted({path.stem.partition("_")[0] for path in LISTS}))
def test_each_rule_cites_a_page_with_a_statement_that_was_read(family: str) -> None:
    """Or none at all, and the reason why it is so."""
    read = {
        (rule, statement.page)
        for path in LISTS
        for statement in statements(path)
        for rule in statement.told_by()
    }
    cited = [(rule.id, rule.page) for rule in load_schema(family).rules if rule.page]
    assert [rule for rule in cited if rule not in read] == []
