"""A packed word given by what its bits are called."""

import pytest

from amp_studio.schema import (
    InvalidValueError,
    Parameter,
    family_ids,
    labels_of_word,
    load_schema,
    read_value,
)
from amp_studio.schema.bit_fields import word_of_labels

WORD = Parameter.model_validate(
    {
        "id": "a.word",
        "name": "Limits",
        "type": "bits",
        "help": {"what": "."},
        "page": "1",
        "storage": {"bits": 16},
        "bits": [
            {"bit": 0, "label": "Enable"},
            {"bit": 1, "label": "Override locks"},
            {"bit": 2, "label": "Stop, at once"},
            {"bit": 3, "label": "spare"},
            {"bit": 4, "label": "Spare"},
            {
                "bit": 5,
                "width": 2,
                "label": "Mode",
                "choices": [
                    {"key": "a", "label": "Slow", "raw": 0},
                    {"key": "b", "label": "Fast, hot", "raw": 2},
                ],
            },
            {"bit": 8, "width": 4, "label": "Count"},
            {"bit": 12, "label": "5 V supply"},
        ],
    }
)


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("Enable", 0b1),
        ("enable , OVERRIDE  locks", 0b11),
        ("Override locks,Enable", 0b11),
        ("Stop, at once", 0b100),
        ("Enable, Stop, at once, Override locks", 0b111),
        ("Enable, Enable", 0b1),
        ("bit 3, bit 14", 1 << 3 | 1 << 14),
        ("Mode: Fast, hot", 2 << 5),
        ("Mode: Fast, hot, Enable", 2 << 5 | 1),
        ("Mode=Slow, Count=9", 9 << 8),
        ("Count: 0xF, Mode: 2", 15 << 8 | 2 << 5),
        ("5 V supply", 1 << 12),
        ("none", 0),
        ("5", 5),
        ("0x05", 5),
        ("0x1F", 31),
        ("$1F", 31),
        ("1e3", 1000),
    ],
)
def test_a_word_is_what_its_labels_say(text: str, word: int) -> None:
    assert read_value(WORD, text, "").value == word


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("Enabel", "'Enabel' is no bit of Limits. Did you mean: Enable"),
        ("Enable, Overide locks", "'Overide locks' is no bit of Limits. Did you mean: Override locks"),
        ("Spare", "'Spare' is what the bits 3 and 4 of Limits are called: set one bit at a time"),
        ("Mode", "Mode of Limits has 2 bits: write 'Mode: …'"),
        ("Mode: Medium", "'Medium' is not a choice of Mode: Slow, Fast, hot"),
        ("Count: 16", "does not fit Count, which takes 0 to 15"),
        ("bit 16", "Limits has the bits 0 to 15, not 16"),
        ("Enable,", "'' is no bit of Limits"),
        ("zzz", "'zzz' is no bit of Limits, whose bits are Enable, "),
        ("5 volts", "Limits is given in a bare number, not in V"),
        ("," * 5000, "is too long for a number"),
        ("Enable," * 400 + "Enable", "too long"),
    ],
)
def test_what_is_no_label_is_refused(text: str, message: str) -> None:
    with pytest.raises(InvalidValueError) as refused:
        read_value(WORD, text, "")
    assert message in str(refused.value)


@pytest.mark.parametrize("family", family_ids())
def test_a_word_of_zero_is_not_called_as_another_value_is(family: str) -> None:
    """NUM's assignment of axis X to group 1 is 0, and ``none`` is 15 there."""
    for parameter in load_schema(family).parameters.values():
        fields = parameter.bits or ()
        text = labels_of_word(parameter, 0)
        assert word_of_labels(parameter, text) == 0
        names = {c.label for field in fields for c in field.choices or () if c.raw}
        assert text not in names, parameter.id
