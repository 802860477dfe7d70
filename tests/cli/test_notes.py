"""``note`` reads and writes notes about a value, a group and the machine."""

from pathlib import Path


def test_a_note_is_written_read_listed_and_removed(amp, example: Path) -> None:
    assert amp("note", example, "1750", "long spindle").code == 0
    assert amp("note", example, "group:Home Parameters", "switches renewed").code == 0
    assert amp("note", example, "group:home").out == "switches renewed\n"
    assert amp("note", example, "machine", "in hall 3").code == 0
    assert amp("note", example, "servo.excess_error@X").out == "long spindle\n"
    listed = amp("note", example, "--json").json
    assert [(n["subject"], n["about"], n["text"]) for n in listed] == [
        ("machine", "", "in hall 3"),
        ("group", "home", "switches renewed"),
        ("value", "servo.excess_error@1", "long spindle"),
    ]
    assert amp("note", example, "1750", "--remove").code == 0
    assert amp("note", example, "1750").out == ""


def test_what_there_is_not_gets_no_note(amp, example: Path) -> None:
    before = example.read_bytes()
    assert "Unknown parameter" in amp("note", example, "99999", "x").err
    assert "Unknown group 'hime'" in amp("note", example, "group:hime", "x").err
    assert "4000 are the most" in amp("note", example, "1750", "x" * 5000).err
    assert example.read_bytes() == before


def test_set_takes_an_expression_of_other_values(amp, example: Path) -> None:
    amp("set", example, "1750==Y*1.5", "1340==0.0254/2")
    assert [v["value"] for v in amp("get", example, "1750", "1340", "--json").json["values"]] == [
        16.5,
        0.0127,
    ]
    assert "divides by 0" in amp("set", example, "1750==1/0").err
    assert "not a unit" in amp("set", example, "1750=10-5").err
