"""Messages of controls as facts: how they are written, and which mistakes the loader names."""

from pathlib import Path

import pytest
from pydantic import ValidationError

from amp_studio.schema import load_schema
from amp_studio.schema.consistency import faults_of_messages
from amp_studio.schema.model import ControlMessage, Messages

PLAIN = {"id": "too-hot", "text": "TOO HOT", "reaction": "alarm", "page": "1-1"}


def listed(*messages: dict[str, object]) -> Messages:
    return Messages.model_validate({"id": "all", "title": "All", "page": "1-1", "messages": messages})


def test_a_message_has_a_printed_text_or_a_title_of_ours() -> None:
    assert ControlMessage.model_validate(PLAIN | {"code": "7"}).name == "7 TOO HOT"
    for wrong in ({"title": "Too hot"}, {"text": ""}):
        with pytest.raises(ValidationError, match="either the text that is printed or a title"):
            ControlMessage.model_validate(PLAIN | wrong)
    with pytest.raises(ValidationError, match="a span goes upward, and has a code"):
        ControlMessage.model_validate(PLAIN | {"code": "8 to 1", "span": [8, 1]})


def test_a_message_names_only_what_exists_and_is_there_once() -> None:
    schema = load_schema("9pc")
    file = Path("messages/all.yaml")
    bad = listed(
        PLAIN | {"params": ["servo.excess_error", "servo.no_such"], "rules": ["9pc.servo.no-such"]}, PLAIN
    )
    assert list(faults_of_messages({file: bad}, schema.groups, schema.rules)) == [
        (file, ("messages", 0, "params", 1), "too-hot: there is no parameter 'servo.no_such'"),
        (file, ("messages", 0, "rules", 0), "too-hot: there is no rule '9pc.servo.no-such'"),
        (file, ("messages", 1, "id"), "too-hot occurs twice"),
    ]


def test_a_file_of_messages_is_a_table_and_so_is_each_with_a_code_causes_and_cures() -> None:
    fan = PLAIN | {
        "id": "fan",
        "code": "7",
        "means": "The fan stands.",
        "causes": ["Dust"],
        "cures": ["Clean", "Replace"],
    }
    tables = listed(PLAIN, fan).tables()
    assert [table.id for table in tables] == ["all", "fan"]
    assert tables[0].rows == (("", "TOO HOT", "", "1-1"), ("7", "TOO HOT", "The fan stands.", "1-1"))
    assert tables[1].rows == (
        ("When", "The fan stands."),
        ("Cause", "Dust"),
        ("Cure 1", "Clean"),
        ("Cure 2", "Replace"),
    )


def test_the_limits_of_the_following_error_lead_to_their_parameters_and_rules() -> None:
    message = load_schema("9pc").messages["following-error-limits-corrected"]
    assert message.text == "SERVO AMP FE LIMITS CORRECTED"
    assert message.every_page == ("7-20", "7-21", "7-22", "7-24")
    assert message.params[0] == "servo.inposition_band"
    assert "9pc.servo.suppression-within-excess" in message.rules


def test_a_parameter_has_the_messages_that_point_to_it() -> None:
    schema = load_schema("9pc")
    found = [message.id for message in schema.messages_of("servo.excess_error")]
    assert found[:2] == ["following-error-limits-corrected", "excess-following-error"]
    assert schema.messages_of("cycle.rapid_to_hole") == ()
