"""new, set, get: a file is made, changed and read."""

import os
import re
import subprocess
import sys
from pathlib import Path
from textwrap import dedent

import pytest

from amp_studio.assignments import CLEARING_TEXT
from amp_studio.files import backup_path, open_file
from amp_studio.schema import Value, family_ids, load_schema

# -- new -----------------------------------------------------------------------------------------------------


def test_a_new_file_is_of_the_machine_and_axes_asked_for(amp, tmp_path: Path) -> None:
    path = tmp_path / "bench.amp"
    message = amp("new", "9pc", path, "--machine", "mill", "--axes", "X, Y,C")
    assert (message.code, message.err) == (0, "")
    assert re.fullmatch(rf"{re.escape(str(path))}: Allen-Bradley 9/PC AMP, mill, \d+ values\n", message.out)
    file = open_file(path).file
    assert (file.machine, file.header.name) == ("mill", "bench")
    assert [Value("x"), Value("y"), Value("c"), None] == [file.get(("axis.name", axis)) for axis in "1234"]


def test_a_new_file_does_not_overwrite(amp, mill: Path, folder) -> None:
    before = folder()
    message = amp("new", "9pc", mill)
    assert (message.code, f"{mill} exists already" in message.err) == (2, True)
    assert before == folder()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("fanuc", "x.amp"), "Unknown family 'fanuc'. Known: "),
        (("9pc", "x.amp", "--machine", "grinder"), "Unknown machine type 'grinder'. Known: lathe, mill"),
        (("9pc", "x.amp", "--axes", "X,Q"), "'Q' is not a choice of Axis Name"),
        (("9pc", "x.amp", "--axes", "X,Y,Z,A,B,C,U,V,W"), "9 axes are too many"),
        (("9pc", "x.amp", "--axes", "X,,Z"), "'' is not a choice of Axis Name"),
        (("9pc", "no/such/folder/x.amp"), "there is no folder no/such/folder"),
        (("9pc",), "PATH"),
    ],
)
def test_a_new_file_that_cannot_be_is_not_made(
    amp, tmp_path: Path, folder, monkeypatch, arguments, message: str
) -> None:
    monkeypatch.chdir(tmp_path)
    refused = amp("new", *arguments)
    assert (refused.code, message in refused.err) == (2, True), refused.err
    assert folder() == {}
    assert list(tmp_path.iterdir()) == []


# -- get


def test_a_value_is_given_as_promised(amp, mill: Path) -> None:
    (row,) = amp("get", mill, "1300", "--json").json["values"]
    expected = {
        "param": "1300",
        "id": "home.calibration",
        "instance": "1",
        "value": 0.0,
        "unit": "mm",
        "raw": 0,
        "default": True,
    }
    assert expected == {key: row[key] for key in expected}


@pytest.mark.parametrize(
    ("param", "expected"),
    [
        (
            "360",
            {"id": "axis.type", "instance": "1", "value": "linear", "unit": "", "raw": None, "default": True},
        ),
        ("control.type", {"param": "350", "instance": "", "value": "Mill", "raw": None, "default": False}),
        ("1020", {"id": "zone.overtravel_used", "value": "False", "raw": 0, "default": True}),
        (
            "1013",
            {
                "param": "servo.velocity_gear_teeth@1",
                "id": "servo.velocity_gear_teeth",
                "instance": "1",
                "value": 1,
            },
        ),
        (
            "4013",
            {"param": "servo.spindle_motor_teeth@4", "id": "servo.spindle_motor_teeth", "instance": "4"},
        ),
        ("3300", {"id": "home.calibration", "instance": "3", "value": 0.0, "unit": "deg", "raw": 0.0}),
        ("1204", {"value": 4.23333, "unit": "mm/s", "raw": 4.23333, "default": True}),
        ("3207", {"id": "axis.rollover", "value": None, "unit": "deg", "raw": None, "default": True}),
        ("1009", {"id": "zone.group", "value": None, "unit": "", "default": True}),
    ],
)
def test_every_kind_of_value_is_given(amp, mill: Path, param: str, expected: dict) -> None:
    (row,) = amp("get", mill, param, "--json").json["values"]
    assert expected == {key: row[key] for key in expected}


def test_what_was_asked_for_comes_in_the_order_it_was_asked_for(amp, mill: Path) -> None:
    rows = amp("get", mill, "2300", "home.calibration@1", "350", "--json").json["values"]
    assert [row["param"] for row in rows] == ["2300", "1300", "350"]


def test_without_parameters_everything_that_exists_is_given(amp, mill: Path) -> None:
    displayed = {(row["id"], row["instance"]) for row in amp("get", mill, "--json").json["values"]}
    every = {(row["id"], row["instance"]): row for row in amp("get", mill, "--all", "--json").json["values"]}
    assert set(load_schema("9pc").on("mill").addresses) == set(every)
    is_set = {a for a, row in every.items() if row.get("set", row["value"] is not None)}
    assert displayed == {a for a, row in every.items() if a in is_set and row["state"] != "hidden"}


def test_a_user_sees_what_was_changed_and_what_is_inactive(amp, mill: Path) -> None:
    amp("set", mill, "1300=2")
    lines = amp("get", mill, "1300", "2300", "1320", "1009").out.splitlines()
    assert re.fullmatch(r"1300 Home Calibration +2 mm \*", lines[0])
    assert re.fullmatch(r"2300 Home Calibration +0 mm", lines[1])
    assert re.fullmatch(r"1320 Positive Software Overtravel +0 mm  \(inactive: ignored\)", lines[2])
    assert re.fullmatch(r"1009 Programmable Zone Group Axis +not set", lines[3])


# -- set


def test_a_value_is_set_and_the_previous_file_becomes_the_backup(amp, mill: Path) -> None:
    before = mill.read_bytes()
    message = amp("set", mill, "1300=2.5")
    assert (message.code, message.out, message.err) == (0, "1300 Home Calibration: 0 mm -> 2.5 mm\n", "")
    assert before == backup_path(mill).read_bytes()
    assert Value(2.5, "mm") == open_file(mill).file.get(("home.calibration", "1"))
    (row,) = amp("get", mill, "1300", "--json").json["values"]
    assert (row["value"], row["raw"], row["default"]) == (2.5, 2.5, False)


@pytest.mark.parametrize(
    ("assignment", "address", "expected"),
    [
        ("1300=2,5", ("home.calibration", "1"), Value(2.5, "mm")),
        ("1300=2.5 in", ("home.calibration", "1"), Value(2.5, "in")),
        ("home.calibration@1=-2.5e-3mm", ("home.calibration", "1"), Value(-0.0025, "mm")),
        ("1300=1 234,5", ("home.calibration", "1"), Value(1234.5, "mm")),
        ("1204=10 ipm", ("accdec.velocity_step", "1"), Value(10.0, "in/min")),
        ("1204=1 mm/s", ("accdec.velocity_step", "1"), Value(1.0, "mm/s")),
        ("3300=12", ("home.calibration", "3"), Value(12.0, "deg")),
        ("361=rotary", ("axis.type", "2"), Value("rotary")),
        ("361=ROTARY", ("axis.type", "2"), Value("rotary")),
        ("361=b", ("axis.type", "2"), Value("rotary")),
        ("axis.type@2=rotary", ("axis.type", "2"), Value("rotary")),
        ("1031=Digital or Digital Spindle", ("servo.loop_type", "1"), Value("digital")),
        ("1020=yes", ("zone.overtravel_used", "1"), Value(True)),
        ("1020=True", ("zone.overtravel_used", "1"), Value(True)),
        ("1020=a", ("zone.overtravel_used", "1"), Value(True)),
        ("1020=raw:1", ("zone.overtravel_used", "1"), Value(True)),
        ("1504=raw:0", ("servo.sercos_transmit", "1"), Value("low")),
        ("servo.velocity_port@1=j2", ("servo.velocity_port", "1"), Value("j2")),
        ("1013=0x10", ("servo.velocity_gear_teeth", "1"), Value(16)),
        ("4013=7", ("servo.spindle_motor_teeth", "4"), Value(7)),
        ("1300=not-set", ("home.calibration", "1"), None),
        ("1300=not set", ("home.calibration", "1"), None),
        ("1300=Not-Set", ("home.calibration", "1"), None),
    ],
)
def test_a_value_may_be_given_in_every_clear_form(
    amp, mill: Path, assignment: str, address, expected
) -> None:
    assert amp("set", mill, assignment).code == 0
    assert expected == open_file(mill).file.get(address)


@pytest.mark.parametrize("assignment", ["1300=", "1300= ", "home.calibration@X=", "361=", "1020="])
def test_an_empty_value_as_of_a_variable_that_is_not_set_clears_nothing(
    amp, mill: Path, assignment: str
) -> None:
    before = mill.read_bytes()
    for verb in (("set", mill, "1350=300"), ("simulate", mill, "step", "--axis", "1", "--set")):
        refused = amp(*verb, assignment)
        name = assignment.partition("=")[0]
        assert (refused.code, refused.out) == (2, "")
        assert f"{name}: no value is given ({name}=not-set clears it)" in refused.err
    assert before == mill.read_bytes()


def test_no_choice_of_any_family_is_spelled_like_the_word_that_clears_a_value() -> None:
    for family in family_ids():
        for parameter in load_schema(family).parameters.values():
            words = {w for c in parameter.choices or () for w in (c.key, c.label, c.code or "")}
            words |= {b.label for b in parameter.bits or ()}
            assert CLEARING_TEXT not in {word.casefold() for word in words}, parameter.id


def test_assignments_count_one_after_the_other(amp, mill: Path) -> None:
    """Axis 1 is a spindle by the time its 1013 is read, and its lengths are angles."""
    message = amp("set", mill, "360=spindle", "1013=9", "1300=5")
    assert message.code == 0
    file = open_file(mill).file
    assert (Value(9), Value(1)) == (
        file.get(("servo.spindle_motor_teeth", "1")),
        file.get(("servo.velocity_gear_teeth", "1")),
    )
    assert Value(5.0, "deg") == file.get(("home.calibration", "1"))


@pytest.mark.parametrize(
    "second", ["1300=6", "home.calibration@1=6", "1300=not-set", "home.calibration@X=5.1"]
)
def test_a_parameter_that_is_given_two_values_gets_neither(amp, mill: Path, second: str) -> None:
    before = mill.read_bytes()
    message = amp("set", mill, "1300=5", second)
    assert (message.code, "it is given two values" in message.err, mill.read_bytes()) == (2, True, before)
    assert amp("set", mill, "1300=5", "1300=5.0 mm").code == 0, "the same one twice is no doubt"


def test_a_pair_that_bounds_each_other_is_set_together(amp, mill: Path) -> None:
    assert amp("set", mill, "1320=100", "1330=50").code == 0
    assert amp("set", mill, "1320=-50", "1330=-100").code == 0
    file = open_file(mill).file
    assert (Value(-50.0, "mm"), Value(-100.0, "mm")) == tuple(
        file.get((f"zone.overtravel_{s}", "1")) for s in ("positive", "negative")
    )


def test_who_sets_what_is_inactive_is_reported(amp, mill: Path) -> None:
    message = amp("set", mill, "1320=5")
    assert (message.code, message.err) == (
        0,
        (
            "1320 Positive Software Overtravel is inactive (ignored): software overtravel is not used on this"
            " axis\n"
        ),
    )


def test_setting_what_is_set_writes_nothing(amp, mill: Path, folder) -> None:
    before = folder()
    assert (amp("set", mill, "1300=0").code, amp("set", mill, "1300=0 in", "1300=0").out) == (0, "")
    assert before == folder()


def test_a_history_is_kept_of_what_was_set(amp, mill: Path) -> None:
    amp("set", mill, "1300=1")
    assert '"home.calibration@1", "0 mm", "1 mm"' in mill.with_name("mill.amp.history").read_text()


@pytest.mark.parametrize(
    ("assignments", "message"),
    [
        (["1300=2", "9999=1"], "Unknown parameter '9999'. Did you mean: "),
        (["1300=2", "home.nothing@1=1"], "Unknown parameter 'home.nothing@1'"),
        (["1300=2", "home.calibration=1"], "'home.calibration': Home Calibration has @1 to @8"),
        (["1300=2", "home.calibration@9=1"], "Home Calibration has @1 to @8"),
        (
            ["1300=2", "2300=1e6"],
            "Home Calibration 1000000 mm is outside -999999.99 to 999999.99 mm; nothing was changed (--force",
        ),
        (["1300=2", "2300=40000 in"], "outside -39370.07835 to 39370.07835 in"),
        (["1300=2", "2300=1,234"], "'1,234' can be read two ways: write 1234 or 1.234"),
        (["1300=2", "2300=five"], "'five' is not a number"),
        (["1300=2", "2300=5 kg"], "'kg' is not a unit"),
        (["1300=2", "2300=5 deg"], "Home Calibration is given in mm, not in °"),
        (["1300=2", "3300=5 mm"], "Home Calibration is given in °, not in mm"),
        (["1300=2", "1013=1.5"], "takes whole numbers, not 1.5"),
        (
            ["1300=2", "361=square"],
            "'square' is not a choice of Axis Type: linear (a), rotary (b), spindle (c), unfitted (d)",
        ),
        (["1300=2", "361=raw:9"], "9 is no code of Axis Type; nothing was changed"),
        (
            ["1300=2", "1020=perhaps"],
            "'perhaps' is not a choice of Software Overtravel Used: True (a), False (b)",
        ),
        (["1300=2", "1320=-1"], "outside 0 to 2540000 mm (set by 1330 Negative Software Overtravel, 0 mm)"),
        (["1300=2", "2300"], "'2300' is not PARAM=VALUE"),
        (["1300=2", "=5"], "'=5' is not PARAM=VALUE"),
        (["1300=2", "1020.3=1"], "Unknown parameter '1020.3'"),
        ([], "PARAM=VALUE"),
    ],
)
def test_one_fault_among_the_assignments_changes_nothing(
    amp, mill: Path, folder, assignments, message: str
) -> None:
    before = folder()
    refused = amp("set", mill, *assignments)
    assert (refused.code, message in refused.err) == (2, True), refused.err
    assert before == folder()


def test_force_takes_a_value_out_of_range_and_marks_it(amp, mill: Path) -> None:
    message = amp("set", mill, "1300=1e6", "2300=5", "--force")
    assert message.code == 0
    assert "1300 Home Calibration: 0 mm -> 1000000 mm" in message.out
    rows = amp("get", mill, "1300", "2300", "--json").json["values"]
    assert [(row["value"], row["forced"]) for row in rows] == [(1e6, True), (5.0, False)]
    assert re.search(r"forced:\n  home\.calibration@1: on 20\S+ by 'set --force'", mill.read_text())
    findings = amp("validate", mill, "--json").json["findings"]
    assert [
        re.search(r"It was forced on 20", f["message"])[0] for f in findings if f["params"] == ["1300"]
    ] == ["It was forced on 20"]


def test_the_mark_goes_with_the_next_value(amp, mill: Path) -> None:
    amp("set", mill, "1300=1e6", "--force")
    assert amp("set", mill, "1300=1").code == 0
    assert "forced" not in mill.read_text()


def test_a_forced_file_is_not_saved_again_for_nothing(amp, mill: Path) -> None:
    amp("set", mill, "1300=1e6", "--force")
    backup = backup_path(mill).read_bytes()
    assert amp("set", mill, "2300=0").code == 0
    assert backup == backup_path(mill).read_bytes()


def test_force_does_not_take_what_is_no_value(amp, mill: Path, folder) -> None:
    before = folder()
    assert amp("set", mill, "1300=five", "--force").code == 2
    assert before == folder()


def test_a_file_in_use_is_not_changed(amp, mill: Path, folder) -> None:
    script = """
        import sys
        from pathlib import Path
        from amp_studio.files import Document
        with Document.open(Path(sys.argv[1])):
            print("open", flush=True)
            sys.stdin.readline()
    """
    command = [sys.executable, "-c", dedent(script), str(mill)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as other:
        assert other.stdout.readline().strip() == "open"
        before = folder()
        message = amp("set", mill, "1300=2")
        assert (message.code, "mill.amp is open in another program (" in message.err) == (2, True)
        assert before == folder()
        other.communicate("\n")
    assert amp("set", mill, "1300=2").code == 0


def test_a_disk_that_is_full_changes_nothing(amp, mill: Path, folder, monkeypatch) -> None:
    before = folder()

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        message = amp("set", mill, "1300=2")
    assert (2, f"amp-studio: {mill} cannot be written: No space left on device\n") == (
        message.code,
        message.err,
    )
    assert before == folder()
