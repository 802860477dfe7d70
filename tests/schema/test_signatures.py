"""The signatures of the families, as files and controls out there hold them."""

import pytest

from amp_studio.schema import load_schema

SIGNATURES = {
    "57c422b": "bf7337a59c775498a9987ab8daaac2b3769f88f1cd1ed1c65d98576ee2b6a71c",
    "9pc": "ce5702f60c5ac7f73030b141b8efdb88959b8954bc35ba5d301c59cb0d886357",
    "acromill": "df24c9f6d55ec5f414d717797de183b3a2fd7dd0e8f4131e51d13696726996e1",
    "num": "bb4dcd098d48a6f033545739e50cd3acf974f48d0246c96faaa14419e7506108",
    "syntec": "9dc9e03592bff1ed04372deca679874380f58beed051bd68a0fd32cc7582cd68",
}
"""A change of one of these makes every file and every control of the family one of another schema:
never by accident."""


@pytest.mark.parametrize("family", SIGNATURES)
def test_the_signature_of_a_family_is_what_files_and_controls_hold(family: str) -> None:
    assert load_schema(family).signature == SIGNATURES[family]
