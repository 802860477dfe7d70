"""families, schema, show: what the program knows, for people and for other programs."""

import pytest

from amp_studio.schema import family_ids, load_schema
from tests.campaigns import some

TYPES = {"integer", "real", "choice", "boolean", "bits", "text", "format"}
SCOPES = {"global", "axis", "spindle", "process", "group", "word", "register"}


def test_families_are_listed_with_their_size(amp) -> None:
    message = amp("families", "--json")
    assert (message.code, message.err) == (0, "")
    rows = {row["id"]: row for row in message.json["families"]}
    schema = load_schema("9pc")
    assert {"id", "name", "parameters", "values"} <= rows["9pc"].keys()
    values = max(len(schema.on(machine).addresses) for machine in ("mill", "lathe"))
    expected = (schema.family.name, len(schema.parameters), values)
    assert expected == (rows["9pc"]["name"], rows["9pc"]["parameters"], rows["9pc"]["values"])


def test_families_for_a_user_are_one_line_each(amp) -> None:
    message = amp("families")
    assert len(amp("families", "--json").json["families"]) == len(message.out.splitlines())
    assert "9pc        Allen-Bradley 9/PC AMP" in message.out


@pytest.fixture
def definitions(amp):
    """Return every definition of the 9/PC by id, as another program reads it."""
    message = amp("schema", "9pc", "--json")
    assert (message.code, message.err, message.json["family"]) == (0, "", "9pc")
    return {row["id"]: row for row in message.json["parameters"]}


def test_a_definition_has_the_promised_shape(definitions) -> None:
    found = definitions["home.calibration"]
    expected = {
        "id": "home.calibration",
        "name": "Home Calibration",
        "group": "Home Parameters",
        "scope": "axis",
        "type": "real",
        "numbers": {str(axis): f"{axis}300" for axis in range(1, 9)},
        "unit": "length",
        "ranges": {"mm": [-999999.99, 999999.99], "in": [-39370.07835, 39370.07835]},
        "choices": None,
        "default": {"mm": 0.0},
        "source": {"document": "9pc-amp-reference-manual", "page": "5-10"},
    }
    assert expected == {key: found[key] for key in expected}
    assert {"available_when", "help", "errata"} <= found.keys()
    assert all(isinstance(found[key], str) for key in ("available_when", "help", "errata"))


def test_a_definition_has_what_the_manual_warns_of_and_what_a_bare_number_is(definitions) -> None:
    sign, teeth = definitions["servo.position_sign"], definitions["servo.position_gear_teeth"]
    danger = {"says": "A wrong sign can make the axis run away.", "page": "7-36"}
    assert sign["danger"] == [{**danger, "brief": "the axis can run away"}]
    assert (teeth["bare"], "danger" in teeth) == ("teeth", False)


def test_every_definition_keeps_the_contract(definitions) -> None:
    assert list(load_schema("9pc").parameters) == list(definitions)
    for name, found in definitions.items():
        assert (found["type"] in TYPES, found["scope"] in SCOPES, name) == (True, True, found["id"])
        assert all(isinstance(number, str) for number in found["numbers"].values())
        for low, high in (found["ranges"] or {}).values():
            for bound in (low, high):
                assert bound is None or isinstance(bound, float) or set(bound) == {"param"}, name
        for choice in found["choices"] or ():
            assert {"code", "label", "raw"} <= choice.keys()
        assert found["default"] is None or isinstance(found["default"], dict)
        assert found["help"].strip()
        assert {"document", "page"} == found["source"].keys() - {"pages"}


def test_choices_come_with_letter_label_and_code(definitions) -> None:
    """Control Type (page 3-9), Software Overtravel Used (page 6-10)."""
    used = definitions["zone.overtravel_used"]
    assert [(c["code"], c["label"], c["raw"]) for c in used["choices"]] == [
        ("a", "True", 1),
        ("b", "False", 0),
    ]
    assert (used["type"], used["default"]) == ("boolean", {"": "False"})


def test_a_bound_that_another_parameter_sets_is_named(definitions) -> None:
    assert definitions["zone.overtravel_positive"]["ranges"]["mm"] == [
        {"param": "zone.overtravel_negative"},
        2540000.0,
    ]


def test_one_group_can_be_asked_for(amp) -> None:
    found = amp("schema", "9pc", "--group", "Home Parameters", "--json").json["parameters"]
    assert {"Home Parameters"} == {row["group"] for row in found}
    assert found == amp("schema", "9pc", "--group", "home", "--json").json["parameters"]
    lines = amp("schema", "9pc", "--group", "home").out.splitlines()
    assert len(found) == len(lines)
    assert any(line.startswith("1300…8300") and "Home Calibration" in line for line in lines)


@pytest.mark.parametrize("param", ["1300", "home.calibration", "home.calibration@1", " 1300 "])
def test_a_parameter_is_shown_as_a_user_reads_it(amp, param: str) -> None:
    message = amp("show", "9pc", param)
    assert (message.code, message.err) == (0, "")
    for part in (
        "Home Calibration",
        "home.calibration",
        "-999999.99 to 999999.99 mm",
        "page 5-10",
        "How to find its value",
    ):
        assert part in message.out


def test_a_number_of_two_parameters_shows_both(amp) -> None:
    message = amp("show", "9pc", "1013")
    assert message.code == 0
    assert "Teeth on Motor Gear for Velocity Feedback" in message.out
    assert "No of Teeth on Motor Gear" in message.out


def test_the_numbers_are_drawn_together_and_those_of_a_gear_are_named(amp) -> None:
    assert "Number         1750, 2750 … 8750 (Axis 1 to Axis 8)" in amp("show", "9pc", "1750").out
    message = amp("show", "9pc", "912").out
    assert "900" not in message.partition("Id ")[0]
    assert "910, 911 … 917 (Spindle 1, Gear 1 to Spindle 1, Gear 8); 930, 931 … 937" in " ".join(
        message.split()
    )
    assert "page 12-8 and 13-8" in message


def test_a_number_that_a_mill_and_a_lathe_do_not_share_shows_it(amp) -> None:
    message = amp("show", "9pc", "powerup.plane").out
    assert "522 on a mill" in message
    assert "564 on a lathe" in message
    assert amp("show", "9pc", "564").out == amp("show", "9pc", "522").out == message


def test_a_number_on_an_axis_shows_the_parameter_that_it_means_in_a_file(amp) -> None:
    page = amp("show", "9pc", "1300").out
    assert [amp("show", "9pc", text).out for text in ("1300@X", "1300@2", "2300@X")] == [page] * 3
    wrong = amp("show", "9pc", "1300@9")
    assert (wrong.code, wrong.err) == (2, "amp-studio: '1300@9': Home Calibration has @1 to @8\n")


def test_a_printed_table_is_on_the_page_of_what_is_looked_up_in_it(amp) -> None:
    message = amp("show", "9pc", "1801").out
    assert "Velocity Proportional Gain Values for Standard Motors (page 7-55)" in message
    (row,) = [line.split() for line in message.splitlines() if line.strip().startswith("1 : 2  ")]
    assert row[3:] == ["3000", "6000", "9000", "22500", "26214", "18000", "30000", "10800", "66000"]


def test_the_steps_of_the_guides_stand_on_the_page_of_what_they_set(amp) -> None:
    message = amp("show", "num", "P21N0").out
    assert "\n  Integration 3.3 Servo-Control Settings, step 5 of 16: P21 Servo-System Loop Gain" in message
    assert (
        "\n  Integration, procedures with the machine, step 10 of 12: 11.2.1 Time constant (page 11-6)\n"
        in message
    )
    assert "\nGuides\n" not in amp("show", "9pc", "350").out


def test_the_step_of_commissioning_is_on_the_page_and_the_one_that_looks_again(amp) -> None:
    message = amp("show", "9pc", "servo.velocity_integral_gain").out
    steps = (
        "\nCommissioning\n  Step 7 of 23: Velocity loop (page 7-46)\n  Step 22 of 23: Tuning at the machine"
        " (page 36-1)\n"
    )
    assert steps in message


def test_the_bits_of_a_word_are_shown_and_those_that_count_up_share_a_line(amp) -> None:
    mask = amp("show", "num", "P3N0").out
    assert "Number         P3N0\n" in mask
    assert "Bits           0 to 31: Axis 0 to Axis 31\n" in mask
    word = amp("show", "num", "P34N5").out
    assert "Number         P34N0, P34N1 … P34N31 (Axis 0 to Axis 31)\n" in word
    assert "25 to 26: Sensor type\n                   incremental sensor, stored as 0\n" in word
    lost = amp("show", "num", "P5N0").out
    assert "0 to 7: Bit 0 to Bit 7 (not legible in the manual: keep the present value)" in lost


def test_bits_that_one_lost_figure_would_name_are_reported_once(amp) -> None:
    word = amp("show", "57c422b", "setup.drive").out
    assert (
        "               2 to 15: Unnamed (figure 4.2) (not legible in the manual: keep the present value)\n"
        in word
    )
    assert word.count("Unnamed (figure 4.2)") == 1
    mode = amp("show", "57c422b", "control.mode").out
    assert "3: Direct Drive Reference (inferred) (not legible in the manual: keep the present" in mode
    assert "4: Direction\n" in mode


def test_no_line_of_any_page_is_wider_than_a_terminal(amp) -> None:
    for parameter in some(load_schema("9pc").parameters, 6):
        assert [line for line in amp("show", "9pc", parameter).out.splitlines() if len(line) > 100] == []


def test_a_choice_a_rule_and_a_contradiction_are_shown(amp) -> None:
    message = amp("show", "9pc", "1020", "--machine", "mill")
    for part in ("(a) True, stored as 1", "Software Overtravel Used", "Contradiction in the manual"):
        assert part in message.out
    assert "Velocity Loop Feedback Port\n---" not in message.out, "1020 belongs to the other one"
    assert "Rules that use it" in amp("show", "9pc", "1730").out


def test_the_formulas_of_a_parameter_are_shown_with_their_page(amp) -> None:
    message = " ".join(amp("show", "9pc", "1750").out.split())
    assert (
        "Formulas minimum_excess_error(rapid, gain, break_ratio): Smallest sensible Excess Error" in message
    )
    assert "(page 7-20)" in message


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("schema", "fanuc"), "Unknown family 'fanuc'. Known: "),
        (("schema", "9pc", "--group", "Tools"), "Unknown group 'Tools'"),
        (("show", "fanuc", "1"), "Unknown family 'fanuc'. Known: "),
        (("show", "9pc", "99999"), "Unknown parameter '99999'. Did you mean: "),
        (("show", "9pc", "home.calibratio"), "Unknown parameter 'home.calibratio'"),
        (("show", "9pc"), "PARAM"),
        (("families", "--xml"), "--xml"),
        (("frobnicate",), "frobnicate"),
    ],
)
def test_what_does_not_exist_is_refused(amp, arguments, message: str) -> None:
    refused = amp(*arguments)
    assert (refused.code, message in refused.err) == (2, True), refused.err


# -- tables


def test_tables_are_listed_and_one_is_printed_with_its_parameters(amp) -> None:
    listed = amp("tables", "syntec").out
    assert "mot-019" in listed
    assert "MOT-019 Following error exceed (page 1.5.3)" in listed
    message = amp("tables", "syntec", "mot-019")
    assert message.out.startswith("MOT-019 Following error exceed (page 1.5.3)\n")
    assert "Cause 1" in message.out
    assert message.out.rstrip().splitlines()[-1].startswith("Parameters: servo.loop_gain, feed.rapid")


def test_tables_as_json_are_all_there(amp) -> None:
    for family in family_ids():
        found = amp("tables", family, "--json").json["tables"]
        assert {table["id"] for table in found} == set(load_schema(family).tables)
        assert all(len(row) == len(table["cells"][0]) for table in found for row in table["cells"])


def test_a_table_that_there_is_not_is_refused(amp) -> None:
    assert (
        amp("tables", "syntec", "mot-999").err
        == "amp-studio: Unknown table 'mot-999'. Did you mean: mot-029, mot-019; without a name all are"
        " listed\n"
    )


# -- one number, one answer


def test_a_number_that_belongs_to_another_parameter_is_listed_under_that_one(amp, definitions, mill) -> None:
    """1020 is Software Overtravel Used (pages 6-10 and 37-3),
    though page 7-46 prints it for the velocity port.
    """
    owners = {n: i for i, d in definitions.items() for n in d["numbers"].values()}
    message = amp("get", mill, "1020", "--json")
    assert message.json["values"][0]["id"] == owners["1020"] == "zone.overtravel_used"
    assert (
        message.err
        == "1020 is printed for two parameters: taken is Software Overtravel Used (zone.overtravel_used@1); "
        "the other is Velocity Loop Feedback Port (servo.velocity_port@1)\n"
    )
    port = definitions["servo.velocity_port"]
    assert (port["numbers"], port["numbers_disputed"], port["printed_numbers"]["1"]) == ({}, True, "1020")
    assert port["instances"] == [str(axis) for axis in range(1, 9)]
    assert definitions["zone.overtravel_used"]["numbers_also_printed_for"] == ["servo.velocity_port"]


def test_every_verb_takes_the_same_one_and_shows_it(amp, mill) -> None:
    message = amp("set", mill, "1020=True")
    assert (message.code, "taken is Software Overtravel Used" in message.err) == (0, True)
    assert message.out == "1020 Software Overtravel Used: False -> True\n"
    displayed = " ".join(amp("show", "9pc", "1020").out.split())
    assert (
        "(Axis 1 to Axis 8); also printed for Velocity Loop Feedback Port (servo.velocity_port)" in displayed
    )
    displayed = " ".join(amp("show", "9pc", "servo.velocity_port@X").out.split())
    assert "printed, but they address Software Overtravel Used (zone.overtravel_used)" in displayed
    assert "servo.velocity_port@1 to servo.velocity_port@8 (Axis 1 to Axis 8)" in displayed


def test_the_other_one_is_set_by_its_id_and_named_with_it(amp, mill) -> None:
    message = amp("set", mill, "servo.velocity_port@X=b")
    assert message.out.startswith("Velocity Loop Feedback Port Axis 1 (servo.velocity_port@1): ")
    assert (
        amp("get", mill, "servo.velocity_port@1", "--json").json["values"][0]["value"]
        == "Feedback Connector J1"
    )


def test_a_finding_names_what_has_no_number_by_its_address(amp, tmp_path) -> None:
    path = tmp_path / "router.amp"
    amp("new", "acromill", path)
    amp("set", path, "axes.handwheel_ratio@X=0", "home.priority@X=-1", "--force")
    found = amp("validate", path, "--json").json["findings"]
    ids = {p for f in found if f["severity"] == "error" for p in f["params"]}
    message = amp("validate", path).out
    assert ids
    assert all(f"({p})" in message for p in ids if "@" in p)


def test_values_of_one_parameter_are_named_once_by_their_numbers(amp, tmp_path) -> None:
    path = tmp_path / "second.amp"
    amp("new", "9pc", path, "--like", "mill-1394")
    assert (
        "recommendation 101, 102, 103, 104, 105, 106 Characters of the Password: "
        in amp("validate", path).out
    )


# -- what a definition has


def test_defaults_of_instances_are_whole_where_the_parameter_is(amp, definitions) -> None:
    """Page 33-12: AB-D4 and a space."""
    default = definitions["password.character"]["default"]
    assert default == {"": 65, "instances": {"2": 66, "3": 45, "4": 68, "5": 52, "6": 32}}
    assert all(isinstance(v, int) for v in default["instances"].values())
    assert "66.0" not in amp("schema", "9pc", "--json").out.replace(" ", "")
    displayed = amp("show", "9pc", "101").out
    assert "65, 66 for Character 2, 45 for Character 3" in displayed


@pytest.mark.parametrize("family", family_ids())
def test_every_instance_is_listed_and_every_default_of_one(amp, family: str) -> None:
    schema = load_schema(family)
    for found in amp("schema", family, "--json").json["parameters"]:
        parameter = schema.parameters[found["id"]]
        listed = {i for m in found.get("instances_by_machine", {"": found["instances"]}).values() for i in m}
        assert listed == {i for m in schema.family.machines for i in schema.on(m.key).instances(parameter)}
        own = parameter.default.instances if parameter.default else None
        assert set((found["default"] or {}).get("instances", {})) == set(own or {})
        if parameter.type in ("integer", "bits") and found["default"]:
            assert not any(isinstance(v, float) for v in found["default"].values())


@pytest.mark.parametrize(
    ("param", "span", "instances"),
    [
        ("fov.position", "@1…@16", "fov.position@1 to fov.position@16 (Pos 1 to Pos 16)"),
        ("sov.position", "@1…@16", "sov.position@1 to sov.position@16 (Pos 1 to Pos 16)"),
        ("rov.position", "@1…@16", "rov.position@1 to rov.position@16 (Pos 1 to Pos 16)"),
    ],
)
def test_instances_without_a_number_are_seen(amp, param: str, span: str, instances: str) -> None:
    assert f"Instances      {instances}\n" in amp("show", "acromill", param).out
    (line,) = [n for n in amp("schema", "acromill").out.splitlines() if f" {param} " in n]
    assert line.startswith(span)


@pytest.mark.parametrize(
    ("param", "unit"),
    [
        ("Pr461", "mm/min or deg/min"),
        ("Pr821", "mm/min or deg/min"),
        ("841", "mm/min or deg/min"),
        ("Pr521", "mm/min or deg/min"),
        ("Pr661", "mm/min"),
        ("Pr410", "ms"),
    ],
)
def test_a_speed_of_syntec_shows_its_unit_where_a_user_looks(amp, tmp_path, param: str, unit: str) -> None:
    """Page 4.1 prints mm/min; an axis that turns has degrees."""
    assert f"Range          no bounds printed, in {unit}\n" in amp("show", "syntec", param).out
    path = tmp_path / "mill.amp"
    amp("new", "syntec", path)
    first = unit.partition(" or ")[0]
    assert amp("get", path, param).out.endswith(f"not set (in {first})\n")
    number = param if param.startswith("Pr") else f"Pr{param}"
    (found,) = [
        d for d in amp("schema", "syntec", "--json").json["parameters"] if number in d["numbers"].values()
    ]
    assert found["units"] == unit.split(" or ")
    lines = amp("schema", "syntec").out.splitlines()
    assert any(line.startswith(number) and line.endswith(f"in {unit}") for line in lines)


def test_a_wrong_name_is_answered_with_the_nearest_by_every_verb(amp, mill) -> None:
    for arguments in (
        ("get", mill, "home.calibrtion@1"),
        ("set", mill, "home.calibrtion@1=2"),
        ("show", "9pc", "home.calibrtion@1"),
        ("simulate", mill, "step", "--set", "home.calibrtion@1=2"),
    ):
        refused = amp(*arguments)
        assert (
            refused.code,
            refused.err.startswith(
                "amp-studio: Unknown parameter 'home.calibrtion@1'. Did you mean: home.calibration@1"
            ),
        ) == (2, True)


def test_a_number_of_several_words_shows_them_all(amp, tmp_path) -> None:
    path = tmp_path / "num.amp"
    amp("new", "num", path)
    rows = amp("get", path, "P21", "--json").json["values"]
    assert [row["param"] for row in rows] == [f"P21N{n}" for n in range(32)]
    assert amp("show", "num", "P21").out == amp("show", "num", "P21N0").out
    assert amp("show", "num", "P3N0.5").out == amp("show", "num", "P3N0").out, (
        "a bit is on the page of its word"
    )
    assert amp("set", path, "P3N0=Axis 1, Axis 5").out.endswith("-> 0x00000022\n")
    refused = amp("set", path, "P3N0=Axis 1, Axs 5")
    assert (refused.code, "Did you mean: Axis 5" in refused.err) == (2, True)
