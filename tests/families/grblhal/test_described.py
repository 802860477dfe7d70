"""The schema of a control is its own description, with the ids, help,
conditions and rules of the numbers that are known.
"""

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from amp_studio.cli import run
from amp_studio.families.grblhal.described import schema_of
from amp_studio.families.grblhal.description import MAX_BYTES
from amp_studio.families.grblhal.settings import compiled_in
from amp_studio.files import Header, ParameterFile, ParameterFileError, open_file
from amp_studio.files.storage import save_file
from amp_studio.schema import Schema, Value, fault, load_schema
from amp_studio.schema.described import DescriptionError
from amp_studio.validate import Validator
from tests.campaigns import examples
from tests.work import calls_of

from .recorded import HELP, LISTING, THREE_AXES, build, with_lines


def file_by(description: bytes) -> ParameterFile:
    schema = schema_of(description)
    return ParameterFile(schema, Header(signature=schema.signature, machine="grblhal"))


def numbers(schema: Schema, parameter: str) -> dict[str, str]:
    return schema.on("grblhal").numbers(schema.parameters[parameter])


def test_every_setting_that_the_control_shows_is_a_parameter() -> None:
    here = schema_of(THREE_AXES).on("grblhal")
    shown = {line.partition("=")[0] for line in LISTING.splitlines()}
    assert shown <= set(here.every_number)
    assert set(here.every_number) - shown == {"$180", "$181", "$182", "$190", "$191", "$192"}, (
        "those that Per axis feedrates brings along"
    )


def test_settings_of_the_axes_are_one_quantity_with_a_column_for_each_axis() -> None:
    assert numbers(schema_of(THREE_AXES), "axis.max_rate") == {"X": "$110", "Y": "$111", "Z": "$112"}
    assert numbers(schema_of(build("XYZUVW")), "axis.max_rate") == {
        "X": "$110",
        "Y": "$111",
        "Z": "$112",
        "U": "$113",
        "V": "$114",
        "W": "$115",
    }
    assert schema_of(THREE_AXES).parameters["axis.max_rate"].name == "Maximum rate"


def test_types_labels_bounds_and_marks_are_those_of_the_control() -> None:
    schema = schema_of(
        with_lines(without="[SETTING:22|") + b"[SETTING:22|11|Homing cycle||2|Enable,Slowly,N/A,Late|||1|0]\n"
    )
    homing = schema.parameters["homing.cycle"]
    assert [(bit.bit, bit.label) for bit in homing.bits or ()] == [(0, "Enable"), (1, "Slowly"), (3, "Late")]
    assert homing.effect is not None
    assert homing.effect.level == "restart"
    assert homing.storage is not None
    assert homing.storage.bits == 4
    assert [c.label for c in schema.parameters["general.mode"].choices or ()] == [
        "Normal",
        "Laser mode",
        "Lathe mode",
    ]
    assert schema.parameters["homing.passes"].ranges == {"": (1.0, 128.0)}
    assert schema.parameters["spindle.pwm_max"].ranges == {"%": (0.0, 100.0)}
    assert schema.parameters["parking.target"].ranges == {"mm": (-100000.0, None)}
    assert schema.parameters["spindle.on_delay"].ranges == {"s": (0.0, 20.0)}, (
        "0 is allowed, though the least is 0.5"
    )
    assert schema.parameters["axis.steps"].decimals == 5


def test_help_alarms_and_errors_are_those_of_the_control() -> None:
    schema = schema_of(THREE_AXES + HELP)
    assert schema.parameters["homing.cycle"].help.what == "Homes the machine.\nNeeds switches."
    assert schema.parameters["homing.cycle"].help.related, "what is known of the number beside it"
    assert [(m.name, m.page) for m in schema.messages.values() if m.reaction != "symptom"] == [
        ("ALARM:9 No switch.", "EA"),
        ("error:53 Not here.", "EE"),
    ]
    assert "axis.max_travel" in schema.messages["alarm-9"].params  # what is known of the code stays
    assert schema.tables["alarms"].rows[0][:2] == ("ALARM:9", "No switch.")


def test_the_table_of_esh_gives_the_help_too_also_over_several_lines() -> None:
    rows = (
        b"22\tHoming cycle\tmask\txbitfield\tEnable\tHomes"
        b" it.\t\t\t0\t0\n61\tDoor\tmask\tbitfield\ta,b\tOne:\nTwo.\t\t\t0\t0\n"
    )
    schema = schema_of(THREE_AXES + rows)
    assert schema.parameters["homing.cycle"].help.what == "Homes it."
    assert schema.parameters["parking.door_options"].help.what == "One:\nTwo."


def test_a_setting_that_nobody_knows_has_an_id_of_its_group_and_name() -> None:
    schema = schema_of(
        with_lines(
            "[SETTINGGROUP:20|0|Plasma]",
            "[SETTING:350|20|Arc voltage|V|6|##0.00|10|300|0|0]",
            "[SETTING:351|20|Arc voltage|widgets|5|##0|||1|0]",
            "[SETTING:70|99|SSID||7|x(32)|1|32|0|0]",
            "[SETTING:71|99|Password||8|x(32)|8|32|0|0]",
            "[SETTING:302|99|IP address||9||||0|0]",
        )
    )
    arc, second = (schema.parameters[p] for p in ("plasma.arc_voltage", "plasma.arc_voltage_351"))
    assert (arc.type, arc.unit, arc.ranges, arc.decimals) == ("real", "V", {"V": (10.0, 300.0)}, 2)
    assert (second.unit, second.help.what) == (None, "Arc voltage. In widgets.")
    assert schema.group_of["plasma.arc_voltage"].name == "Plasma"
    assert (schema.parameters["other.ssid"].type, schema.parameters["other.password"].secret) == (
        "text",
        True,
    )
    assert schema.parameters["other.ssid"].help.what == "SSID. At most 32 characters."


def test_texts_of_a_control_are_of_one_line_and_steer_no_terminal() -> None:
    line = "[SETTING:350|1|Arc\\n\x1b[31m voltage\u202e|V|6|##0.00|10|300|0|0]"
    schema = schema_of(with_lines(line, "[SETTINGDESCR:350|One\x1b[2J.\\nTwo.]"))
    (found,) = [p for p in schema.parameters.values() if "voltage" in p.name]
    assert (found.name, found.help.what) == ("Arc\\n [31m voltage", "One [2J.\nTwo.")


def test_a_known_number_of_another_type_is_another_parameter() -> None:
    """Older builds enable homing by yes or no: rules that look at bits of $22 must not look there."""
    old = schema_of(with_lines("[SETTING:22|11|Homing cycle enable||0||||0|0]", without="[SETTING:22|"))
    assert numbers(old, "homing.cycle") == {}
    assert numbers(old, "classic.homing") == {"": "$22"}


def test_a_value_of_a_setting_changes_no_signature() -> None:
    """Per axis feedrates takes $24 and $25 away and brings $180 and $190; a rotary axis is in degrees."""
    rates = [
        f"[SETTING:{base + n}|{43 + n}|{axis}-axis homing {what}|mm/min|6|###0|||0|0]"
        for n, axis in enumerate("XYZ")
        for base, what in ((180, "locate feed rate"), (190, "search seek rate"))
    ]
    bit9 = b"".join(f"{line}\n".encode() for line in rates) + b"".join(
        line + b"\n"
        for line in THREE_AXES.splitlines()
        if b"[SETTING:24|" not in line and b"[SETTING:25|" not in line
    )
    assert schema_of(bit9).signature == schema_of(THREE_AXES).signature
    turning = build("XYZA").replace(b"A-axis travel resolution|step/mm", b"A-axis travel resolution|step/deg")
    assert turning != build("XYZA")
    assert schema_of(turning).signature == schema_of(build("XYZA")).signature
    assert schema_of(build("XYZA")).signature != schema_of(THREE_AXES).signature


def test_what_a_setting_brings_along_is_hidden_until_it_does() -> None:
    file = file_by(THREE_AXES)
    file.set(("homing.cycle", ""), Value(1))
    assert file.evaluation.state(("axis.homing_seek_rate", "X")).state == "hidden"
    file.set(("homing.cycle", ""), Value(1 | 1 << 9))
    assert file.evaluation.state(("axis.homing_seek_rate", "X")).state == "in-force"
    assert file.evaluation.state(("homing.seek_rate", "")).state == "hidden"


def test_an_axis_that_turns_is_in_degrees() -> None:
    file = file_by(build("XYZA"))
    file.set(("axis.steps", "A"), Value(10.0, "steps/mm"))
    file.set_checked({("stepper.rotary_axes", ""): Value(1)})
    assert file.evaluation.unit(("axis.max_rate", "A"), "metric") == "deg/min"
    assert file.get(("axis.steps", "A")) == Value(10.0, "steps/deg")
    assert file.evaluation.unit(("axis.max_rate", "X"), "metric") == "mm/min"
    file.set_checked({("stepper.rotary_axes", ""): Value(0)})
    assert file.get(("axis.steps", "A")) == Value(10.0, "steps/mm")


def test_a_mask_of_axes_has_the_axes_of_the_control() -> None:
    file = file_by(THREE_AXES)
    address = file.find("$23")
    assert file.read(address, "X, Z") == Value(5)
    assert fault(file.evaluation, address, Value(8)) is not None, "the control refuses it with error:52"


def test_rules_of_the_family_look_at_the_settings_of_the_control() -> None:
    file = file_by(THREE_AXES)
    file.take({("limits.soft", ""): Value(True), ("homing.cycle", ""): Value(0)})
    assert "grblhal.limits.soft-without-homing" in [f.rule for f in Validator(file).run()]


def test_a_file_opens_without_its_control(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = file_by(
        with_lines("[SETTING:350|1|Arc voltage|V|6|##0.00|10|300|0|0]", "[SETTINGDESCR:350|Ünits: 'x' \"y\"]")
    )
    file.set(file.find("$350"), Value(120.5, "V"))
    path = tmp_path / "plasma.amp"
    save_file(file, path)
    again = open_file(path)
    assert again.file.schema.signature == file.schema.signature
    assert again.file.values == file.values
    assert again.file.schema.parameters["general.arc_voltage"].help.what == "Ünits: 'x' \"y\""
    assert run(["set", str(path), "$350=90"]) == 0
    assert run(["set", str(path), "$350=400"]) == 2
    assert "outside 10 to 300 V" in capsys.readouterr().err
    before = path.read_bytes()
    save_file(open_file(path).file, path, open_file(path).digest)
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("10|300", "10|900"),
        ("sha256 ", "sha256 0"),
        ("- '[VER:1.1f.20260817:]'\n", ""),
        ("description:\n", "description: no\nx:\n"),
        ("'[AXS:3:XYZ]'", "{a: b}"),
    ],
)
def test_a_description_that_was_changed_is_refused(tmp_path: Path, old: str, new: str) -> None:
    path = tmp_path / "plasma.amp"
    save_file(file_by(with_lines("[SETTING:350|1|Arc voltage|V|6|##0.00|10|300|0|0]")), path)
    text = path.read_text("utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), "utf-8")
    with pytest.raises(ParameterFileError, match="description of its control"):
        open_file(path)


def test_the_description_of_a_family_that_has_none_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "mill.amp"
    save_file(file_by(THREE_AXES), path)
    path.write_text(path.read_text("utf-8").replace("family: grblhal", "family: 9pc"), "utf-8")
    with pytest.raises(ParameterFileError, match="do not describe themselves"):
        open_file(path)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("[SETTING:110|43|X-axis maximum rate|mm/min|6|#0.0|||0|0]", "described twice"),
        ("[SETTING:999|1|Odd||77||||0|0]", "which is not known"),
        ("[SETTING:999|1|Odd||5||||0]", "10 entries"),
        ("[SETTING:99999999|1|Odd||5||||0|0]", "no number of 0 to 65535"),
        ("[SETTING:-1|1|Odd||5||||0|0]", "no number of 0 to 65535"),
        ("[SETTING:999|1|Odd||5||1e9||0|0]", "which is no number"),
        ("[SETTING:999|1|Odd||5||1||2|0]", "two marks"),
        ("[SETTING:999|1|Odd||3|N/A|||0|0]", "is a choice and has none"),
        ("[SETTING:999|1|Odd||1|" + "a," * 40 + "|||0|0]", "32 are the most"),
        ("[AXS:2:XYZ]", "are no axes"),
        ("[AXS:3:XXY]", "are no axes"),
        ("[SETTINGGROUP:1]", "3 entries"),
    ],
)
def test_what_cannot_be_meant_is_refused(line: str, message: str) -> None:
    with pytest.raises(DescriptionError, match=message):
        schema_of(with_lines(line))


def test_a_content_without_settings_or_axes_has_no_schema() -> None:
    with pytest.raises(DescriptionError, match=r"no setting is described"):
        schema_of(b"[VER:1.1f:]\nok\n")
    with pytest.raises(DescriptionError, match="axes of the control are not described"):
        schema_of(b"[SETTING:0|35|Step pulse time|microseconds|6|#0.0|2.0||0|0]\n")


def test_a_flood_is_refused_at_once() -> None:
    def flooded() -> None:
        with pytest.raises(DescriptionError, match="at most"):
            schema_of(b"[" * (MAX_BYTES + 1))
        with pytest.raises(DescriptionError, match="more than 2000"):
            schema_of(with_lines(*(f"[SETTING:{n}|1|S{n}||5||||0|0]" for n in range(2000, 5000))))
        schema_of(THREE_AXES + b"[SETTINGDESCR:22|" + b"x\n" * 60_000)

    assert calls_of(flooded) < 3_000_000


@settings(max_examples=examples(60))
@given(st.data())
def test_whatever_a_control_says_there_is_a_schema_or_a_plain_refusal(data: st.DataObject) -> None:
    lines = THREE_AXES.decode().splitlines()
    at = data.draw(st.integers(0, len(lines) - 1))
    signs = st.text(st.characters(exclude_characters="\n\r"), max_size=12)
    place = data.draw(st.integers(0, len(lines[at])))
    lines[at] = lines[at][:place] + data.draw(signs) + lines[at][place + data.draw(st.integers(0, 6)) :]
    try:
        schema = schema_of("\n".join(lines).encode("utf-8", "replace"))
    except DescriptionError:
        return
    assert schema.description.decode("utf-8")
    assert schema_of(schema.description).signature == schema.signature


def test_the_facts_of_the_database_are_those_of_the_firmware() -> None:
    """What a fresh build lists of each known number is what is in the database of it."""
    known, told = load_schema("grblhal"), schema_of(THREE_AXES)
    for parameter in known.parameters.values():
        if not parameter.in_signature:
            continue  # of other builds
        other = told.parameters[parameter.id]
        if other.layouts == () or parameter.id.startswith("build."):
            continue
        for fact in ("name", "type", "quantity", "unit", "ranges", "choices", "decimals", "effect"):
            assert getattr(other, fact) == getattr(parameter, fact), f"{parameter.id}: {fact}"
        if (
            parameter.bits
            and known.family.bit_lists.get("axes") != parameter.bits
            and len(parameter.bits) != 8
        ):
            few = tuple(
                bit
                for bit in parameter.bits
                if not bit.needs and (parameter.id != "limits.hard" or bit.bit < 2)
            )
            assert other.bits == few, parameter.id


def test_the_defaults_of_the_database_are_those_of_a_fresh_build() -> None:
    known = load_schema("grblhal")
    here = known.on("grblhal")
    shown = dict(line.split("=") for line in LISTING.splitlines())
    for number, text in shown.items():
        (address,) = here.claims(number)
        default = known.parameters[address[0]].default
        assert default is not None, number
        codes = {c.key: c.raw for c in known.parameters[address[0]].choices or ()}
        value = codes.get(str(default.value), default.value)
        assert float(value) == float(text), number


def test_the_step_rate_of_the_driver_bounds_the_rates_where_the_control_lists_it() -> None:
    file = file_by(with_lines("[MAX STEP RATE:4000 Hz]"))
    assert compiled_in(file.schema) == {
        ("build.axes", ""): Value("XYZ"),
        ("build.max_step_rate", ""): Value(4000.0, "Hz"),
    }
    assert compiled_in(schema_of(THREE_AXES)) == {("build.axes", ""): Value("XYZ")}
    file.take({**compiled_in(file.schema), ("axis.steps", "X"): Value(80.0, "steps/mm")})
    file.set(("axis.max_rate", "X"), Value(3001.0, "mm/min"))
    assert "grblhal.axis.rate-above-driver" in [f.rule for f in Validator(file).run()]
    file.set(("axis.max_rate", "X"), Value(3000.0, "mm/min"))
    assert "grblhal.axis.rate-above-driver" not in [f.rule for f in Validator(file).run()]


def test_rules_run_without_the_settings_that_a_build_does_not_have() -> None:
    """The phases 4 to 6 are those of builds with more axes."""
    file = file_by(THREE_AXES)
    file.take({**compiled_in(file.schema), ("homing.cycle", ""): Value(1)})
    file.take({(f"homing.phase_{n}", ""): Value(0) for n in (1, 2, 3)})
    assert "grblhal.homing.no-phase" in [f.rule for f in Validator(file).run()]


def test_a_setting_that_is_called_like_a_known_one_is_not_taken_for_it() -> None:
    schema = schema_of(with_lines("[SETTING:990|3|Soft||5||||0|0]", without="[SETTING:20|"))
    assert numbers(schema, "limits.soft_990") == {"": "$990"}
    assert numbers(schema, "limits.soft") == {}
    assert schema.parameters["limits.soft"].type == "boolean"
