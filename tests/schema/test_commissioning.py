"""The order of commissioning and the areas of the groups are checked when the facts are compiled."""

from typing import Any

import pytest

from amp_studio.schema import load_schema
from amp_studio.schema.consistency import faults_of_areas, faults_of_experience, faults_of_order
from amp_studio.schema.model import Area, Commissioning, Plausible

STEP: dict[str, Any] = {"id": "one", "title": "One", "page": "1", "groups": ["home"]}


def order(*steps: dict[str, Any], own: tuple[str, ...] = ()) -> Commissioning:
    rest = {"title": "Rest", "what": "What is left.", "page": "1"}
    return Commissioning.model_validate(
        {"order": "ours", "why": "x", "page": "1", "steps": steps, "rest": rest, "of_one_machine": own}
    )


@pytest.mark.parametrize(
    ("steps", "place", "what"),
    [
        ([STEP | {"groups": ["hme"]}], ("steps", 0, "groups", 0), "there is no group 'hme'"),
        ([STEP, STEP | {"id": "two"}], ("steps", 1, "groups", 0), "'home' is in an earlier step"),
        ([STEP, STEP | {"groups": []}], ("steps", 1, "id"), "there are two steps 'one'"),
        ([STEP | {"params": ["home.sped"]}], ("steps", 0, "params", 0), "there is no parameter 'home.sped'"),
        ([STEP | {"again": ["home.sped"]}], ("steps", 0, "again", 0), "there is no parameter 'home.sped'"),
        (
            [
                STEP | {"params": ["axis.name"]},
                {"id": "two", "title": "Two", "page": "1", "params": ["axis.name"]},
            ],
            ("steps", 1, "params", 0),
            "'axis.name' is in an earlier step",
        ),
    ],
)
def test_a_step_that_cannot_be_is_reported_at_its_place(
    steps: list[dict[str, Any]], place: tuple[object, ...], what: str
) -> None:
    assert list(faults_of_order(order(*steps), load_schema("9pc").groups)) == [(place, what)]


def test_a_value_of_one_machine_must_exist() -> None:
    found = list(faults_of_order(order(STEP, own=("home.offset",)), load_schema("9pc").groups))
    assert found == [(("of_one_machine", 0), "there is no parameter 'home.offset'")]


def test_an_unusual_choice_must_exist() -> None:
    facts = Plausible.model_validate({"usual": {"general.mode": {"choices": ["normal", "laser"]}}})
    assert list(faults_of_experience(facts, load_schema("grblhal").groups)) == [
        (("usual", "general.mode", "choices", 1), "'general.mode' has no choice 'laser'")
    ]


def test_the_areas_have_every_group_once_and_in_order() -> None:
    family = load_schema("9pc").family
    assert list(faults_of_areas(family)) == []
    for areas, named in (
        (family.areas[1:], "'configuration'"),
        ((*family.areas, Area(name="More", groups=("heating",))), "'heating'"),
        ((family.areas[1], family.areas[0], *family.areas[2:]), "'the groups in their order'"),
    ):
        (fault,) = faults_of_areas(family.model_copy(update={"areas": areas}))
        assert fault.what == f"the areas do not have each group once: {named}"
