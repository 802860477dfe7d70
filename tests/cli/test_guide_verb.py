"""``guide`` and ``get --not-set``: the steps of commissioning without a display."""

import shlex
from pathlib import Path

import pytest

from amp_studio import cli
from amp_studio.files import open_file
from tests.campaigns import CAMPAIGN


@pytest.fixture(scope="module")
def new_file(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("new") / "mill.amp"
    assert cli.run(["new", "9pc", str(path), "--machine", "mill", "--axes", "X,Y,Z"]) == 0
    return path.read_bytes()


@pytest.fixture
def fresh(new_file: bytes, tmp_path: Path) -> Path:
    """Return the path of a new mill with the axes X, Y and Z."""
    path = tmp_path / "mill.amp"
    path.write_bytes(new_file)
    return path


def test_the_overview_has_each_step_with_its_counts_and_the_open_values_of_the_present_one(
    amp, fresh: Path
) -> None:
    message = amp("guide", fresh)
    assert message.code == 0
    lines = message.out.splitlines()
    assert lines[0] == f"{fresh}: 0 of 19 steps done, 3 of 339 values set"
    assert lines[1] == "[~]  1  Control, axes and servos            3-1  3 of 3 set"
    assert lines[2].startswith("[ ]  2  Axis names and rollover             4-1  0 of ")
    assert "not needed on this machine" in next(line for line in lines if "Position loop" in line)
    assert lines[-1].startswith("as delivered, to be set in steps 1, ")
    assert lines[-1].endswith("; validate --json lists them")


def test_what_guide_leaves_out_validate_lists(amp, fresh: Path) -> None:
    later = amp("guide", fresh, "--json").json["later"]
    listed = amp("guide", fresh, "--json").json["steps"]
    found = amp("validate", fresh, "--json").json
    for key, severity in (("errors", "error"), ("warnings", "warning")):
        displayed = {f["message"] for step in listed for f in step["findings"] if f["severity"] == severity}
        every = {f["message"] for f in found["findings"] + found["delivered"] if f["severity"] == severity}
        assert displayed <= every
        assert len([f for f in found["delivered"] if f["severity"] == severity]) >= later[key]
        assert found[key] == 0, "nobody has set anything yet"
    assert later["warnings"] > 0


def test_the_json_has_every_step_with_its_parameters_and_open_values(amp, fresh: Path) -> None:
    message = amp("guide", fresh, "--json").json
    assert (message["family"], message["order"], message["page"]) == ("9pc", "manual", "1-1")
    assert [step["step"] for step in message["steps"]] == list(range(1, 24))
    assert sum(len(step["open"]) for step in message["steps"]) == message["total"] - message["set"]
    first = next(value for step in message["steps"] for value in step["open"])
    assert message["next"] == first
    assert first == {
        "param": "185",
        "id": "axis.integrand_name",
        "instance": "1",
        "name": "Axis Integrand Name",
        "step": 2,
        "unit": "",
        "allowed": "I / J / K / None",
        "page": "4-3",
    }
    tuning = next(step for step in message["steps"] if step["id"] == "tuning")
    assert "servo.reversal_error" in tuning["again"]


def test_a_step_is_shown_by_number_and_by_id(amp, fresh: Path) -> None:
    message = amp("guide", fresh, "home").out
    assert message == amp("guide", fresh, "3").out == amp("guide", fresh, "--step", "3").out
    assert message.startswith("Step 3: Homing (page 5-1)\n")
    assert "1010 G28 Direction to Home                           not set  plus / minus" in message
    only = amp("guide", fresh, "home", "--json").json["steps"]
    assert [step["id"] for step in only] == ["home"]
    values = {value["param"]: value["value"] for value in only[0]["values"]}
    assert values["1300"] == 0.0
    assert values["1010"] is None


def test_the_next_value_comes_with_its_help_and_the_one_after_it_on_request(amp, fresh: Path) -> None:
    message = amp("guide", fresh, "--next").out
    assert message.startswith(
        "Step 2 Axis names and rollover: 185 Axis Integrand Name X (I / J / K / None; page 4-3)\n"
    )
    assert message.endswith("Set it with: 185=…\n")
    assert amp("guide", fresh, "--next", "--after", "185", "--json").json["next"]["param"] == "186"


def test_the_next_value_of_one_step_is_asked_for(amp, fresh: Path) -> None:
    assert amp("guide", fresh, "jog", "--next", "--json").json["next"]["id"] == "jog.speed_lowest"
    assert (
        amp("guide", fresh, "dual", "--next").out == "Every active value of Dual and deskewed axes is set.\n"
    )
    assert amp("guide", fresh, "dual", "--next", "--json").json == {"next": None}


def test_a_walk_of_next_and_set_comes_to_the_end_of_a_step(amp, fresh: Path) -> None:
    while (found := amp("guide", fresh, "--next", "--json").json["next"])["step"] == 2:
        assert amp("set", fresh, f"{found['param']}={found['allowed'].split(' ')[0]}").code == 0
    assert found["id"] == "home.g28_direction"
    assert amp("guide", fresh, "axis", "--json").json["steps"][0]["state"] == "done"


def test_a_step_is_ticked_in_the_file_and_the_tick_taken_away(amp, fresh: Path) -> None:
    message = amp("guide", fresh, "--done", "dual", "--done", "5")
    assert [line[:6] for line in message.out.splitlines()] == ["[x] 19", "[x]  5"]
    assert set(open_file(fresh).file.header.done) == {"dual", "servo"}
    assert amp("guide", fresh, "--not-done", "dual", "--not-done", "servo").code == 0
    assert open_file(fresh).file.header.done == {}


def test_the_defaults_of_a_step_are_kept(amp, fresh: Path) -> None:
    amp("set", fresh, "feedrate.rapid@X=not-set", "feedrate.rapid@Y=not-set")
    message = amp("guide", fresh, "--keep-defaults", "feedrate")
    file = open_file(fresh).file
    assert message.err.startswith("Feedrates: 2 values set to the default")
    assert file.is_default(("feedrate.rapid", "1"))


def test_a_family_has_its_steps_without_a_file(amp) -> None:
    message = amp("guide", "num").out
    assert message.startswith(
        "Chapter 3 of the manual is this order. (page 3-1)\n  1  Axis Declaration (3.1) (page 3-3)\n"
    )
    assert amp("guide", "grblhal", "--json").json["order"] == "ours"
    assert "     P97N0 " in amp("guide", "num", "axes").out


def test_what_makes_no_sense_is_refused_and_changes_nothing(amp, fresh: Path) -> None:
    before = fresh.read_bytes()
    for arguments in (
        ("guide", fresh, "heating"),
        ("guide", fresh, "--done", "heating"),
        ("guide", fresh, "--done", "home", "--done", "heating"),
        ("guide", fresh, "--next", "--after", "4711x"),
        ("guide", fresh, "-o", fresh),
        ("guide", fresh, "-o", fresh.with_name("list.doc")),
        ("guide", "9pc", "--next"),
        ("guide", "9pc", "--done", "home"),
        ("guide", "9px"),
    ):
        assert amp(*arguments).code == 2, arguments
    assert fresh.read_bytes() == before


def test_get_has_what_is_not_set_step_by_step(amp, fresh: Path) -> None:
    rows = amp("get", fresh, "--not-set", "--json").json["values"]
    assert len(rows) == 336
    assert [row["step"] for row in rows] == sorted(row["step"] for row in rows)
    assert {row["value"] for row in rows} == {None}
    assert {row["state"] for row in rows} == {"in-force"}
    message = amp("get", fresh, "--not-set").out
    assert message.startswith("Step 2: Axis names and rollover\n  185 Axis Integrand Name ")
    assert amp("get", fresh, "1011", "--not-set").out.splitlines()[0] == "Step 3: Homing"
    assert amp("get", fresh, "control.type", "--not-set").out == "Every active value is set.\n"


def test_the_check_list_is_written_in_the_format_of_its_ending(amp, fresh: Path, tmp_path: Path) -> None:
    for name, start in (("a.pdf", b"%PDF"), ("a.html", b"<!DOCTYPE html>"), ("a.txt", b"====")):
        assert amp("guide", fresh, "-o", tmp_path / name).out == f"{tmp_path / name}\n"
        assert (tmp_path / name).read_bytes().startswith(start)


# -- new --like


def test_a_file_is_started_like_an_example_and_what_it_lacks_is_named(amp, tmp_path: Path) -> None:
    message = amp("new", "9pc", tmp_path / "second.amp", "--like", "mill-1394")
    assert message.code == 0
    assert (
        message.err
        == "Not taken over, because true of that machine alone: Probe Length Compensation, Probe Radius"
        " Compensation, Characters of the Password\n"
    )
    assert amp("validate", tmp_path / "second.amp").code == 0


def test_a_file_is_started_like_another_on_other_axes(amp, tmp_path: Path) -> None:
    assert amp("new", "9pc", tmp_path / "a.amp", "--like", "mill-1394", "--axes", "X,Y,Z,S").code == 0
    message = amp("new", "9pc", tmp_path / "b.amp", "--like", tmp_path / "a.amp", "--axes", "X,Z,C")
    assert message.err.splitlines()[-2:] == [
        "At the printed defaults, because the other file has no such axis: C",
        "Axes of the other file that the new one does not have: Y, S",
    ]


def test_what_cannot_be_alike_is_refused_and_nothing_is_written(amp, tmp_path: Path) -> None:
    path = tmp_path / "second.amp"
    for arguments, why in (
        (("9pc", path, "--like", "mill-1395"), "Unknown file or example 'mill-1395'"),
        (("num", path, "--like", "mill-1394"), "mill-1394 is a file for Allen-Bradley 9/PC AMP, not for num"),
        (("9pc", path, "--like", "mill-1394", "--machine", "lathe"), "a lathe cannot be made like it"),
        (("num", path, "--like", "num-1060-mill", "--axes", "X,Y"), "leave the axes out"),
    ):
        message = amp("new", *arguments)
        assert message.code == 2
        assert why in message.err
        assert not path.exists()


EXAMPLES = Path(__file__).parents[2] / "examples"
WAYS = [
    ("57c422b-label-press/LABEL_PRESS.amp", ["self-tuning", "manual-tuning"]),
    *(
        [
            ("acromill-router/ROUTER.amp", ["axis", "homing", "tuning"]),
            ("mill-1394/MILL_1394.amp", ["tuning"]),
            ("num-1060-mill/MILL_1060.amp", ["procedures"]),
            ("syntec-mill/SYNTEC_MILL.amp", ["new-axis"]),
        ]
        if CAMPAIGN
        else []
    ),
]


@pytest.mark.parametrize(("example", "ways"), WAYS)
def test_each_step_of_a_printed_way_has_a_command_that_shows_its_figures(
    example: str, ways: list[str], amp
) -> None:
    """They were in the window alone: ``guide`` knew no such name."""
    path = EXAMPLES / example
    assert {way["id"] for way in amp("guide", path, "--json").json["ways"]} >= set(ways)
    commands = dict[str, str]()
    for way in ways:
        assert f"\n--way {way}: " in amp("guide", path).out
        lines = amp("guide", path, "--way", way).out.splitlines()
        found = [n for n, line in enumerate(lines) if line.startswith("     Shown by: amp-studio ")]
        commands |= {lines[n].partition("amp-studio ")[2]: lines[n + 1] for n in found}
    for command, figures in commands.items():
        result = amp(*shlex.split(command), "--json").json["result"]
        assert set(figures.strip().split(", ")) <= result.keys(), command
    assert commands


def test_a_printed_way_has_the_values_of_the_file_and_of_a_family_its_parameters(amp) -> None:
    path = EXAMPLES / WAYS[0][0]
    lines = amp("guide", path, "--way", "manual-tuning").out.splitlines()
    assert lines[:2] == ["Tuning by hand (page 5-3)", "  1  Starting values (page 5-3)"]
    assert ["R5", "Velocity", "Gain", "78"] in [line.split() for line in lines]
    assert "     Look for: No error at rest. Too much of it is not stable." in lines
    assert "     P Gain Axis X" in amp("guide", "acromill", "--way", "tuning").out.splitlines()
    assert "Unknown way 'x'. Known: axis, homing, tuning" in amp("guide", "acromill", "--way", "x").err
