"""What a number without a unit counts, or that the manual prints none."""

import pytest

from amp_studio.report import facts
from amp_studio.schema import family_ids, load_schema


@pytest.mark.parametrize("family", family_ids())
def test_every_number_without_a_unit_shows_what_it_is_and_no_other_does(family: str) -> None:
    schema = load_schema(family)
    for parameter in schema.parameters.values():
        is_bare = parameter.type in ("integer", "real") and not any(schema.units_of(parameter))
        assert (parameter.bare is not None) == is_bare, parameter.id


def test_a_bare_number_is_reported_under_its_range() -> None:
    schema = load_schema("9pc")
    reported = facts(schema, schema.parameters["servo.position_gear_teeth"])
    assert ("Unit", "teeth") in reported
    assert reported.index(("Unit", "teeth")) == [title for title, _ in reported].index("Range") + 1


def test_a_figure_whose_unit_the_manual_does_not_print_shows_it() -> None:
    schema = load_schema("syntec")
    assert ("Unit", "not printed in the manual") in facts(schema, schema.parameters["home.offset"])
