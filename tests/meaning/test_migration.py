"""The way out of an old control: every active parameter once, nothing beyond what the old one allowed."""

import json
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.files import ParameterFile, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.formats import import_file
from amp_studio.meaning import TargetError, migrate, migration_json
from amp_studio.meaning.facts import meanings_of
from amp_studio.meaning.migration import targets
from amp_studio.meaning.reading import read_meaning
from amp_studio.schema import Value, family_ids, load_schema

SOURCES = [family for family in family_ids() if meanings_of(family)]
LISTS = ("exact", "approximate", "not_possible", "old_hardware")


def example(name: str) -> ParameterFile:
    (path,) = (examples_folder() / name).glob("*.amp")
    return open_file(path).file


def changed(file: ParameterFile, **values: str) -> ParameterFile:
    """Return a mill with other values, each by its number."""
    for number, text in values.items():
        address = file.find(number.removeprefix("p"))
        file.set(address, file.read(address, text))
    return file


def ini(file: ParameterFile, tmp_path: Path, **answers: str) -> ParameterFile:
    """Return the configuration that a file is migrated to, as LinuxCNC reads it."""
    texts = migrate(file, "linuxcnc", {k.replace("_", "."): v for k, v in answers.items()}).written.texts
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    return import_file(tmp_path / next(iter(texts)), "linuxcnc")


def figure(file: ParameterFile, name: str) -> float | None:
    value = file.get(file.find(name))
    return None if value is None else value.value


@pytest.mark.parametrize("target", targets())
@pytest.mark.parametrize("name", ["mill-1394", "lathe-ls176", "num-1060-mill"])
def test_every_active_parameter_is_listed_exactly_once(name: str, target: str) -> None:
    file = example(name)
    found = migration_json(migrate(file, target))
    listed = [row["param"] for outcome in LISTS for row in found[outcome]]
    listed += [param for question in found["asked"] for param in question["params"]]
    active = [a for a in file.addresses() if file.get(a) is not None and file.evaluation.state(a).is_active]
    assert sorted(listed) == sorted(file.machine_schema.short(a) for a in active)


def test_the_mill_has_the_figures_that_were_proven_in_the_real_program(tmp_path: Path) -> None:
    found = ini(example("mill-1394"), tmp_path)
    expected = {
        "MIN_LIMIT": -500.0,
        "MAX_LIMIT": 8.0,
        "MAX_VELOCITY": 166.666666,
        "MAX_ACCELERATION": 694.4,
        "FERROR": 11.0,
        "MIN_FERROR": 11.0,
        "HOME": 6.0,
        "HOME_OFFSET": 6.0,
        "HOME_SEARCH_VEL": 41.666666,
        "HOME_LATCH_VEL": -4.2333,
        "HOME_FINAL_VEL": 4.2333,
        "P": 16.666666,
    }
    assert {key: figure(found, f"[JOINT_0]{key}") for key in expected} == expected
    assert figure(found, "[JOINT_0]HOME_USE_INDEX") is True
    assert figure(found, "[JOINT_3]TYPE") == "angular"
    assert [figure(found, f"[JOINT_3]{key}") for key in ("MIN_LIMIT", "MAX_LIMIT")] == [None, None]
    assert figure(found, "[SPINDLE_0]MAX_REVERSE_VELOCITY") == 6000.0
    assert "5182\t0.000000\n5183\t-120.000000\n" in (tmp_path / "MILL_1394.var").read_text()


MUTATED = [
    ({"p1320": "7.1234567 mm"}, {"[JOINT_0]MAX_LIMIT": 7.123456, "[AXIS_X]MAX_LIMIT": 7.123456}),
    ({"p1330": "-499.1234567 mm"}, {"[JOINT_0]MIN_LIMIT": -499.123456}),
    (
        {"p1320": "0.3 in", "p1203": "100 in/min"},
        {"[JOINT_0]MAX_LIMIT": 7.62, "[JOINT_0]MAX_VELOCITY": 42.333333},
    ),
    (
        {"p1010": "minus", "p1002": "Positive direction off switch"},
        {"[JOINT_0]HOME_SEARCH_VEL": -41.666666, "[JOINT_0]HOME_LATCH_VEL": 4.2333},
    ),
    ({"p1710": "2"}, {"[JOINT_0]P": 33.333333}),
    ({"p1020": "False"}, {"[JOINT_0]MIN_LIMIT": None, "[AXIS_X]MAX_LIMIT": None}),
    ({"p1310": "9 mm"}, {"[JOINT_0]HOME": 7.99, "[JOINT_0]HOME_OFFSET": 9.0}),
    ({"p1211": "500 mm/s2"}, {"[JOINT_0]MAX_ACCELERATION": 500.0}),
    ({"p1340": "-0.005 mm"}, {"[JOINT_0]BACKLASH": 0.005}),
    ({"p1300": "1.5 mm"}, {"[JOINT_0]HOME_OFFSET": 4.5, "[JOINT_0]HOME": 6.0}),
    ({"p1011": "30000 mm/min"}, {"[JOINT_0]HOME_SEARCH_VEL": 166.666666}),
]


@pytest.mark.parametrize(("values", "expected"), MUTATED)
def test_limits_are_never_beyond_and_speeds_never_above(tmp_path: Path, values: dict, expected: dict) -> None:
    found = ini(changed(example("mill-1394"), **values), tmp_path)
    assert {key: figure(found, key) for key in expected} == expected


def test_a_search_and_a_latch_of_one_sign_are_graded_as_approximate() -> None:
    file = changed(example("mill-1394"), p1010="minus")
    rows = {row["param"]: row for row in migration_json(migrate(file, "linuxcnc"))["approximate"]}
    assert "comes again" in rows["1350"]["new"]


def test_answers_fill_the_keys_that_waited_for_them(tmp_path: Path) -> None:
    found = ini(example("mill-1394"), tmp_path, home_order="Z, x Y, B", feedback_sign_X="-")
    assert [figure(found, f"[JOINT_{n}]HOME_SEQUENCE") for n in range(4)] == [1, 1, 0, 2]
    assert figure(found, "[JOINT_0]ENCODER_SCALE") == pytest.approx(-2097152 / 12.7)
    assert figure(found, "[JOINT_1]ENCODER_SCALE") is None


def test_open_questions_write_nothing_unless_a_draft_is_wanted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = str(examples_folder() / "mill-1394" / "MILL_1394.amp")
    words = ["migrate", path, "--to", "linuxcnc", "-o", str(tmp_path / "new"), "--json"]
    assert run(words) == 2
    assert not (tmp_path / "new").exists()
    assert "5 questions are open, nothing was written" in capsys.readouterr().err
    assert run([*words, "--draft"]) == 0
    assert json.loads(capsys.readouterr().out)["open"] == [
        *(f"feedback.sign.{x}" for x in "XYZB"),
        "home.order",
    ]
    before = {p.name: p.read_bytes() for p in (tmp_path / "new").iterdir()}
    assert run([*words, "--draft"]) == 2
    assert {p.name: p.read_bytes() for p in (tmp_path / "new").iterdir()} == before
    assert [p.name for p in tmp_path.iterdir()] == ["new"]


@pytest.mark.parametrize(
    ("answers", "message"),
    [({"home.oder": "Z"}, "Unknown answer 'home.oder'"), ({}, "Unknown target 'fanuc'")],
)
def test_what_was_not_asked_is_refused(answers: dict[str, str], message: str) -> None:
    with pytest.raises(TargetError, match=message):
        migrate(example("mill-1394"), "linuxcnc" if answers else "fanuc", answers)


@pytest.mark.parametrize(
    ("target", "answers", "message"),
    [
        ("linuxcnc", {"home.order": "Z, X Y"}, "each of X, Y, Z, B once"),
        ("linuxcnc", {"home.order": "Z, X Y, B, B"}, "each of X, Y, Z, B once"),
        ("linuxcnc", {"feedback.sign.X": "yes"}, "'yes' is no answer"),
        ("grblhal", {"steps.X": "many"}, "'many' is no answer"),
        ("grblhal", {"home.pull_off": "0"}, "'0' is not above 0"),
    ],
)
def test_an_answer_that_is_none_is_refused_with_its_question(
    target: str, answers: dict[str, str], message: str
) -> None:
    with pytest.raises(TargetError, match=message):
        migrate(example("mill-1394"), target, answers)


@pytest.mark.parametrize("target", ["linuxcnc", "grblhal"])
def test_crossed_limits_are_refused_with_their_parameters(target: str) -> None:
    file = changed(example("mill-1394"), p1320="-500 mm", p1330="8 mm")
    with pytest.raises(
        TargetError, match=r"limits of X are crossed, 8 above -500 \(1330 8 mm, 1320 -500 mm\)"
    ):
        migrate(file, target)


def test_an_axis_with_a_letter_that_cannot_turn_is_asked_about() -> None:
    file = example("mill-1394")
    file.set(("axis.name", "4"), Value("w"))
    found = migrate(file, "linuxcnc")
    assert "letter.W" in [question.id for question in found.written.open]
    assert "coordinates=XYZ\n" in found.written.texts["MILL_1394.ini"]
    answered = migrate(file, "linuxcnc", {"letter.W": "C"}).written.texts["MILL_1394.ini"]
    assert "coordinates=XYZC\n" in answered


@pytest.mark.parametrize("family", SOURCES)
def test_the_facts_name_parameters_of_their_family(family: str) -> None:
    schema, facts = load_schema(family), meanings_of(family)
    concepts = (*facts.axis, *facts.machine, *facts.derived.values())
    named = {text.partition("@")[0] for concept in concepts for text in concept.reads.values()}
    named |= {param for question in facts.questions for param in question.params}
    assert named <= schema.parameters.keys()


def test_a_num_has_its_lengths_in_internal_units(tmp_path: Path) -> None:
    machine = read_meaning(example("num-1060-mill"))
    x = machine.axes[0]
    assert (x.letter, x.number("travel.low"), x.number("travel.high")) == ("X", -1.0, 600.0)
    assert x.number("error.limit") == pytest.approx(6.6)
    assert x.number("gain") == pytest.approx(16.6661, abs=1e-4)
    assert next(a for a in machine.axes if a.turns).choice("travel.kind") == "modulo"
    found = ini(example("num-1060-mill"), tmp_path, home_speed_X="3000")
    assert figure(found, "[JOINT_0]MAX_ACCELERATION") == 500.0
    assert figure(found, "[JOINT_0]HOME_SEARCH_VEL") == -50.0
