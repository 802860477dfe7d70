"""The roles of pictures are checked when the facts are compiled."""

from typing import Any

import pytest

from amp_studio.schema import load_schema
from amp_studio.schema.model import PictureRoles
from amp_studio.schema.role_faults import faults_of_pictures

SPAN = {
    "name": "Travel",
    "low": "zone.overtravel_negative",
    "high": "zone.overtravel_positive",
    "page": "6-10",
}
ZONE = SPAN | {"forbidden": "inside", "group": "zone.group"}
LINEAR = {"kind": "linear", "name": "Linear", "page": "10-8", "acceleration": "accdec.linear_acceleration"}


@pytest.mark.parametrize(
    ("roles", "place", "what"),
    [
        (
            {"travel": {"spans": [SPAN | {"low": "zone.low"}]}},
            ("travel", "spans", 0, "low"),
            "there is no parameter 'zone.low'",
        ),
        (
            {"travel": {"zones": [ZONE | {"group_none": "nine"}]}},
            ("travel", "zones", 0, "group_none"),
            "'nine' is no choice of zone.group",
        ),
        (
            {
                "travel": {
                    "home": {
                        "page": "5-4",
                        "off": {"param": "home.direction_off_switch", "plus": ["up"], "minus": ["negative"]},
                    }
                }
            },
            ("travel", "home", "off", "plus"),
            "'up' is no choice of home.direction_off_switch",
        ),
        (
            {"ramps": {"feedrate": "feedrate.rapid", "kinds": [LINEAR | {"modes": ["linear"]}]}},
            ("ramps", "kinds", 0, "modes"),
            "there is no mode that chooses",
        ),
        (
            {
                "ramps": {
                    "feedrate": "feedrate.rapid",
                    "mode": "accdec.positioning_mode",
                    "kinds": [LINEAR | {"modes": ["lin"]}],
                }
            },
            ("ramps", "kinds", 0, "modes"),
            "'lin' is no choice of accdec.positioning_mode",
        ),
    ],
)
def test_a_role_that_cannot_be_is_reported_at_its_place(
    roles: dict[str, Any], place: tuple[object, ...], what: str
) -> None:
    found = list(faults_of_pictures(PictureRoles.model_validate(roles), load_schema("9pc").groups))
    assert found == [(place, what)]


@pytest.mark.parametrize(
    "roles",
    [
        {"travel": {"zones": [SPAN]}},
        {
            "travel": {
                "zones": [
                    ZONE | {"forbidden_by": {"param": "zone.group", "inside": ["g1"], "outside": ["g2"]}}
                ]
            }
        },
        {"travel": {"home": {"page": "5-4", "off": {"param": "home.direction_off_switch"}}}},
    ],
)
def test_a_zone_has_one_forbidden_side_and_a_direction_two_ways(roles: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match=r"forbidden|direction"):
        PictureRoles.model_validate(roles)


@pytest.mark.parametrize("family", ["9pc", "num", "syntec", "57c422b", "acromill", "grblhal"])
def test_the_roles_of_every_family_are_parameters_and_choices_of_it(family: str) -> None:
    schema = load_schema(family)
    assert list(faults_of_pictures(schema.pictures, schema.groups)) == []
    assert schema.pictures.travel
    assert schema.pictures.ramps
