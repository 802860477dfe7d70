"""The other readers, the settings of a grblHAL, and machines of several families side by side."""

import json
from pathlib import Path

import pytest

from amp_studio.assignments import read_assignments
from amp_studio.cli import run
from amp_studio.files import ParameterFile, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.formats import import_file
from amp_studio.meaning import compare_meanings, migrate
from amp_studio.meaning.migration import less_safe
from amp_studio.meaning.reading import read_meaning

MILL = examples_folder() / "mill-1394" / "MILL_1394.amp"


def example(name: str) -> ParameterFile:
    (path,) = (examples_folder() / name).glob("*.amp")
    return open_file(path).file


def settings(file: ParameterFile, **answers: str) -> dict[str, str]:
    """Return the settings that a file is migrated to, in their order."""
    text = next(
        iter(
            migrate(
                file, "grblhal", {k.replace("_", ".", 1): v for k, v in answers.items()}
            ).written.texts.values()
        )
    )
    return dict(line.split("=", 1) for line in text.splitlines() if line.startswith("$"))


def test_a_grbl_whose_axes_are_not_set_means_less_and_reports_no_fault(
    caplog: pytest.LogCaptureFixture,
) -> None:
    file = example("grblhal-router")
    file.set(("build.axes", ""), None)
    assert "home.search" not in read_meaning(file).axes[0].figures
    assert caplog.records == []


def test_a_mill_is_settings_of_a_grblhal_in_an_order_that_it_takes(tmp_path: Path) -> None:
    found = settings(example("mill-1394"), home_order="Z, X Y, B", home_pull_off="2", steps_X="400")
    assert next(iter(found)) == "$22"
    expected = {
        "$130": "506",
        "$131": "404",
        "$132": "450",
        "$134": "0",
        "$110": "10000",
        "$114": "3600",
        "$120": "694.4",
        "$190": "2500",
        "$180": "253.9",
        "$376": "2",
        "$44": "4",
        "$45": "3",
        "$46": "16",
        "$100": "400",
        "$30": "6000",
    }
    assert {key: found.get(key) for key in expected} == expected
    assert "$101" not in found
    (tmp_path / "a.settings").write_text("".join(f"{k}={v}\n" for k, v in found.items()))
    assert import_file(tmp_path / "a.settings", "grblhal").unknown == {"$N0": "G21 G90 G94"}


@pytest.mark.parametrize(("direction", "mask", "travel"), [("plus", "0", "505.999"), ("minus", "1", "1.876")])
def test_the_travel_is_counted_from_home_and_never_beyond_the_old_limits(
    direction: str, mask: str, travel: str
) -> None:
    file = example("mill-1394")
    for number, text in (("1010", direction), ("1310", "6.1239 mm"), ("1330", "-499.8757 mm")):
        file.set(file.find(number), file.read(file.find(number), text))
    found = settings(file)
    assert (found["$23"], found["$130"]) == (mask, travel)


@pytest.mark.parametrize(
    ("name", "letters", "figures"),
    [
        ("syntec-mill", "XYZA", ("rapid", "travel.low", "home.search")),
        ("acromill-router", "XYZ", ("rapid", "travel.low", "scale", "home.leave")),
        ("grblhal-router", "XYZ", ("rapid", "acceleration", "travel.low")),
        (
            "linuxcnc-mill",
            "XYZ",
            ("rapid", "acceleration", "travel.high", "error.limit", "home.search", "gain"),
        ),
    ],
)
def test_a_machine_of_each_family_is_described(name: str, letters: str, figures: tuple[str, ...]) -> None:
    machine = read_meaning(example(name))
    assert "".join(axis.letter for axis in machine.axes) == letters
    assert [concept for concept in figures if machine.axes[0].number(concept) is None] == []


@pytest.mark.parametrize("name", ["syntec-mill", "acromill-router", "57c422b-label-press", "grblhal-router"])
def test_each_of_them_can_be_migrated(name: str) -> None:
    found = migrate(example(name), "linuxcnc")
    assert len(found.entries) == len({entry.param for entry in found.entries}) > 0
    has_gain = "[JOINT_0]P\n" in found.written.texts["machine.hal"]
    assert has_gain == (
        "\nP = " in next(iter(found.written.texts.values()))
    )  # HAL refuses a value that is not there


def first_joint(file: ParameterFile) -> tuple[dict[str, str], list[str]]:
    """Return the keys of the first joint at a LinuxCNC, and what is less safe there."""
    found = migrate(file, "linuxcnc")
    text = next(iter(found.written.texts.values())).partition("[JOINT_0]")[2].partition("\n[")[0]
    return dict(line.split(" = ") for line in text.splitlines() if " = " in line), less_safe(found)


SYNTEC = [
    ({}, {"P": "30", "FERROR": "26.666666", "MIN_FERROR": "26.666666", "HOME": "0", "HOME_OFFSET": "0"}),
    ({"servo.loop_gain@1": "2"}, {"P": "2", "FERROR": "400"}),
    ({"Pr821": "36000 mm/min"}, {"FERROR": "40"}),
    ({"Pr2402": "1000"}, {"MIN_LIMIT": "1", "HOME": "1.01", "HOME_OFFSET": "0"}),
    ({"Pr881": "7000"}, {"HOME": None, "HOME_OFFSET": None}),
    ({"Pr17": "raw:1"}, {"MIN_LIMIT": None, "MAX_LIMIT": None, "ENCODER_SCALE": None, "MAX_VELOCITY": "400"}),
]
"""Page 1.5.3: MOT-019 at twice the following error of G00, 24000 mm/min / 60 / 30 as delivered; 2.2.2.2;
1.2.6."""


@pytest.mark.parametrize(("values", "expected"), SYNTEC)
def test_a_syntec_has_its_gain_its_error_limit_and_its_zero(
    values: dict[str, str], expected: dict[str, str | None]
) -> None:
    file = example("syntec-mill")
    file.set_checked(read_assignments(file, values.items()), force="a mutation")
    found, lost = first_joint(file)
    assert {key: found.get(key) for key in expected} == expected
    assert not any("no limit of the following error" in each for each in lost)
    assert any("travel limits are not known" in each for each in lost) == ("Pr17" in values)
    assert any("distance from the index" in each for each in lost) == ("Pr881" in values)


@pytest.mark.parametrize(("number", "end"), [("1330", "lower"), ("1320", "upper")])
def test_a_missing_travel_limit_is_among_what_is_less_safe(number: str, end: str) -> None:
    file = example("mill-1394")
    file.set(file.find(number), None)
    assert f"X: no travel limit at its {end} end" in first_joint(file)[1]


def test_a_machine_and_what_it_was_migrated_to_have_the_same_meaning(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, text in migrate(example("mill-1394"), "linuxcnc").written.texts.items():
        (tmp_path / name).write_text(text)
    ini = tmp_path / "MILL_1394.ini"
    rows = {
        (row.axis, row.concept): row
        for row in compare_meanings([example("mill-1394"), import_file(ini, "linuxcnc")])
    }
    taken = (
        "travel.low",
        "travel.high",
        "rapid",
        "acceleration",
        "error.limit",
        "gain",
        "backlash",
        "home.coordinate",
        "home.offset",
        "home.search",
        "home.leave",
    )
    assert [
        (axis, concept)
        for axis in "XYZB"
        for concept in taken
        if (axis, concept) in rows and not rows[axis, concept].is_same
    ] == []
    assert run(["compare", str(MILL), str(ini), "--json"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert {"concept": "feed.ceiling", "axis": "X", "unit": "mm/min", "values": [5000.0, None]} in found[
        "rows"
    ]
    assert run(["compare", str(MILL), str(ini), "-o", str(tmp_path / "a.pdf")]) == 2


def test_a_name_with_an_ending_is_the_configuration_alone(tmp_path: Path) -> None:
    path = tmp_path / "mill.settings"
    assert run(["migrate", str(MILL), "--to", "grblhal", "--draft", "-o", str(path)]) == 0
    assert path.read_text().splitlines()[1] == "$22=525"
    assert run(["migrate", str(MILL), "--to", "grblhal", "--draft", "-o", str(path)]) == 2
