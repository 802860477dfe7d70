"""The AcroMill family: what its guide prints, and what is special to a control without numbers."""

import re

import pytest

from amp_studio.files import new_file
from amp_studio.schema import InvalidValueError, Schema, Value, convert, load_schema, read_value, show_value


@pytest.fixture(scope="module")
def acromill() -> Schema:
    return load_schema("acromill")


SERVO = [  # page 59: parameter, default, unit; page 113: its command
    ("servo.p_gain", 0.00244, "V/count", "PGAIN"),
    ("servo.i_gain", 0, "V/count/s", "IGAIN"),
    ("servo.i_delay", 0, "s", "IDELAY"),
    ("servo.i_limit", 0, "V", "ILIMIT"),
    ("servo.d_gain", 0, "Vs/count", "DGAIN"),
    ("servo.d_time", 0, "s", "DWIDTH"),
    ("servo.acc_ffwd", 0, "Vs2/count", "FFACC"),
    ("servo.vel_ffwd", 0, "Vs/count", "FFVEL"),
    ("servo.torque_limits", 10, "V", "TLM"),
]


@pytest.mark.parametrize(("parameter_id", "default", "unit", "command"), SERVO)
def test_the_gains_have_unit_default_and_command(
    acromill: Schema, parameter_id: str, default: float, unit: str, command: str
) -> None:
    parameter = acromill.parameter(parameter_id)
    assert parameter.default is not None
    assert (parameter.default.value, parameter.default.unit) == (default, unit)
    assert parameter.storage is not None
    assert parameter.storage.command == f"{command} {{i}}{{v}}"


PRINTED = {  # how the guide prints a command -> what gives it: template, axis, its place, value and others
    "PPU X4096": ("axes.pulses_per_unit", "X", "4096"),  # page 114
    "EXC AXIS7 4": ("axes.excess_error_band", "V", "4"),  # page 114
    "MULT X-4": ("axes.encoder_multiplier", "X", "-4"),  # page 114
    "DAC0 GAIN -3276.8": ("tuning.dac_gain", "X", "-3276.8"),  # page 114
    "TLM X4": ("servo.torque_limits", "X", "4"),  # page 115
    "LOPASS X1000": ("tuning.lopass_frequency", "X", "1000"),  # page 128
    "NOTCH X(500, 50)": ("tuning.notch_frequency", "X", "500"),  # page 128
    "P3=55555": ("p.controller", "3", "55555"),  # page 24
}


@pytest.mark.parametrize("command", PRINTED)
def test_a_command_comes_out_as_it_is_printed(acromill: Schema, command: str) -> None:
    parameter_id, instance, value = PRINTED[command]
    parameter = acromill.parameter(parameter_id)
    assert parameter.storage is not None
    assert parameter.storage.command is not None
    place = acromill.on("mill").instances(parameter).index(instance)
    known = {"i": instance, "k": str(place), "v": value}
    known |= {"tuning.notch_frequency": "500", "tuning.notch_width": "50"}
    assert re.sub("{(.*?)}", lambda found: known[found[1]], parameter.storage.command) == command


def test_a_command_of_two_values_is_the_same_at_both(acromill: Schema) -> None:
    both = {acromill.parameter(f"tuning.notch_{name}").storage.command for name in ("frequency", "width")}
    assert both == {"NOTCH {i}({tuning.notch_frequency}, {tuning.notch_width})"}


def test_only_p_parameters_have_numbers(acromill: Schema) -> None:
    numbered = [p.id for p in acromill.parameters.values() if acromill.on("mill").numbers(p)]
    assert numbered == ["p.controller", "p.reserved", "p.acromill"]
    find = new_file("acromill").find
    assert [find(f"P{n}") for n in (0, 33, 34, 99, 100, 199)] == [
        ("p.controller", "0"),
        ("p.controller", "33"),
        ("p.reserved", "34"),
        ("p.reserved", "99"),
        ("p.acromill", "100"),
        ("p.acromill", "199"),
    ]
    assert find("axes.pulses_per_unit@X") == ("axes.pulses_per_unit", "X")


COUNTS = {
    "offset.r_geometric": 400,
    "offset.r_wear": 400,
    "offset.h_geometric": 999,
    "offset.h_wear": 999,
    "fov.position": 16,
    "rov.position": 16,
    "sov.position": 16,
    "axes.name": 8,
}
"""Pages 85, 86 and 70 to 72; 2 to 8 axes on page 3."""


@pytest.mark.parametrize("parameter_id", COUNTS)
def test_a_table_has_as_many_entries_as_the_guide_shows(acromill: Schema, parameter_id: str) -> None:
    assert len(acromill.on("mill").instances(acromill.parameter(parameter_id))) == COUNTS[parameter_id]


def test_an_axis_beyond_the_number_of_axes_is_not_there() -> None:
    file = new_file("acromill")
    states = [file.evaluation.state(("servo.p_gain", axis)).state for axis in "XYZABCUV"]
    assert states == ["in-force"] * 8, "unset, all eight are there"
    file.set(("view.number_of_axes", ""), Value(3))
    states = [file.evaluation.state(("servo.p_gain", axis)).state for axis in "XYZABCUV"]
    assert states == ["in-force"] * 3 + ["hidden"] * 5


def test_a_new_file_asks_for_no_offset_and_no_variable() -> None:
    file = new_file("acromill")
    asked = {p.id for p in file.schema.parameters.values() if not p.optional}
    assert {"p.controller", "offset.h_wear", "work.system_1", "tuning.notch_width"}.isdisjoint(asked)
    assert {"servo.p_gain", "speeds.rapid", "reference.point_1"} <= asked


def test_pulses_per_unit_know_their_unit() -> None:
    # 10000 pulses an inch are not 10000 pulses a millimetre: the unit of the control decides what it is sent.
    file = new_file("acromill")
    address = ("axes.pulses_per_unit", "X")
    assert file.get(address) == Value(10000.0, "counts/in")
    assert [file.evaluation.unit(address, system) for system in ("metric", "inch")] == [
        "counts/mm",
        "counts/in",
    ]
    assert convert(10000.0, "counts/in", "counts/mm") == pytest.approx(393.7007874)
    assert file.schema.family.unit_parameter == "control.default_units"
    chosen = {choice.key for choice in file.schema.parameter("control.default_units").choices or ()}
    assert chosen == set(file.schema.family.units)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("0.00244", Value(0.00244, "V/count")),
        ("0.00244 V/pulse", Value(0.00244, "V/count")),
        ("1.99e-7 V/count", Value(1.99e-7, "V/count")),
    ],
)
def test_a_gain_is_read_with_and_without_its_unit(acromill: Schema, text: str, expected: Value) -> None:
    parameter = acromill.parameter("servo.p_gain")
    assert expected == read_value(parameter, text, "V/count")
    assert read_value(parameter, show_value(parameter, expected), "V/count") == expected


def test_a_gain_is_not_taken_for_another() -> None:
    parameter = load_schema("acromill").parameter("servo.d_gain")
    assert show_value(parameter, Value(0.00021, "Vs/count")) == "0.00021 V·s/count"
    with pytest.raises(InvalidValueError, match=r"D Gain is given in V·s/count, not in V/count"):
        read_value(parameter, "0.08 V/count", "Vs/count")


def test_the_default_spindle_code_and_its_typical_one(acromill: Schema) -> None:
    parameter = acromill.parameter("spindle.code")  # page 77
    assert parameter.default is not None
    assert parameter.default.value == 0
    assert [bit.label for bit in parameter.bits or () if 6 >> bit.bit & 1] == [
        "Wait for UPTOSPEED",
        "Look for HI on UPTOSPEED",
    ]


def test_inputs_end_at_31_without_expansion_modules() -> None:
    file = new_file("acromill")
    address = file.find("io.g27_input")
    assert file.get(address) == Value(-1), "Disable"
    with pytest.raises(ValueError, match="outside -1 to 31"):
        file.set_checked({address: Value(32)})
    file.set(("control.io_expansion_modules", ""), Value(1))
    file.set_checked({address: Value(64)})
