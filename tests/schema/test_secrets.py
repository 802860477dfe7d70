"""Which parameters can be secrets, and what may be shown of them."""

import pytest
from pydantic import ValidationError

from amp_studio.schema import MASKED, InvalidValueError, Parameter, Value, load_schema, read_value, show_value
from amp_studio.schema.consistency import faults_between
from amp_studio.schema.model import Group


def parameter(**words: object) -> Parameter:
    given = {
        "id": "a.code",
        "name": "Code",
        "type": "text",
        "secret": True,
        "help": {"what": "."},
        "page": "1",
    }
    return Parameter.model_validate(given | words)


@pytest.mark.parametrize("kind", ["text", "integer", "real"])
def test_a_secret_is_masked_whatever_its_type(kind: str) -> None:
    value = Value("open sesame" if kind == "text" else 77)
    assert show_value(parameter(type=kind), value) == MASKED
    assert show_value(parameter(type=kind), value, secrets=True) == str(value.value)
    assert show_value(parameter(type=kind), None) == "not set"


@pytest.mark.parametrize("kind", ["text", "integer", "real"])
@pytest.mark.parametrize("text", [MASKED, f" {MASKED} ", "••••"])
def test_the_mask_is_no_value(kind: str, text: str) -> None:
    with pytest.raises(InvalidValueError, match="is no value"):
        read_value(parameter(type=kind), text, "")


@pytest.mark.parametrize("text", ["x77", "1.5", "1,234", "77 mm", "1e400", "99999999999999999999"])
def test_what_cannot_be_read_is_not_repeated(text: str) -> None:
    with pytest.raises(InvalidValueError) as refused:
        read_value(parameter(type="integer"), text, "")
    assert str(refused.value) == "Code takes a whole number; the value given is secret and not shown"
    assert refused.value.__suppress_context__


def test_choices_and_words_cannot_be_secrets() -> None:
    with pytest.raises(ValidationError, match="a secret is a number or a text"):
        parameter(type="bits", bits=[{"bit": 0, "label": "On"}])


def test_a_secret_bounds_no_other_parameter() -> None:
    other = parameter(id="a.other", secret=False, type="real", ranges={"": [0, {"param": "a.code"}]})
    group = Group(key="all", name="All", chapter="1", parameters=(parameter(type="real"), other))
    (fault,) = faults_between(
        load_schema("9pc").family.model_copy(
            update={"conditions": {}, "machine_parameter": None, "unit_parameter": None, "angular_when": None}
        ),
        (group,),
    )
    assert (fault.place, fault.what) == (
        ("parameters", 1, "ranges", "", 1, "param"),
        "a.other: the secret 'a.code' cannot bound it",
    )
