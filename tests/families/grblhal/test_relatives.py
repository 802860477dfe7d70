"""Of Marlin, FluidNC and Grbl_ESP32 what they have in common with Grbl is read; the rest is kept as text."""

from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.families.grblhal.formats.listing import FORMAT
from amp_studio.files import open_file
from amp_studio.formats.text_format import FormatError, ReadOptions, TextRead
from amp_studio.schema import Value, load_schema

MARLIN = """echo:; Linear Units:
echo:  G21    ; Units in mm (mm)
echo:; Steps per unit:
echo: M92 X80.00 Y80.00 Z400.00 E93.00
echo:; Maximum feedrates (units/s):
echo:  M203 X500.00 Y500.00 Z5.5 E25.00
echo:  M201 X500 Y600 Z100 E5000
echo:  M204 P500 R1000 T500
echo:  M205 B20000.00 S0.00 T0.00 J0.01
echo:  M211 S1
"""
FLUIDNC = """board: six pack
arc_tolerance_mm: 0.002
junction_deviation_mm: 0.010
stepping:
  engine: I2S_STATIC
  idle_ms: 255
  pulse_us: 2
axes:
  x:
    steps_per_mm: 100.000
    max_rate_mm_per_min: 5000.000
    acceleration_mm_per_sec2: 100.000
    max_travel_mm: 300.000
    homing:
      cycle: 2
  y:
    steps_per_mm: 90.000
  z:
    steps_per_mm: 80.000
"""
BY_NAME = (
    "$X/StepsPerMm=80.000\n$Y/StepsPerMm=81.000\n$Z/StepsPerMm=82.000\n$Stepper/Pulse=4\n"
    "$GCode/LaserMode=On\n$Spindle/Type=PWM\n"
)


def read(text: str) -> TextRead:
    assert FORMAT.recognises(text)
    return FORMAT.read(text, load_schema("grblhal"), ReadOptions())


def number(found: TextRead, parameter: str, axis: str = "") -> object:
    value = found.values.get((parameter, axis))
    return None if value is None else value.value


def test_marlin_lists_rates_in_mm_per_second() -> None:
    found = read(MARLIN)
    assert found.values["axis.max_rate", "X"] == Value(30000.0, "mm/min")
    assert found.values["axis.max_rate", "Z"] == Value(330.0, "mm/min")
    assert (number(found, "axis.steps", "Z"), number(found, "axis.acceleration", "Y")) == (400.0, 600.0)
    assert (number(found, "general.junction_deviation"), found.values["limits.soft", ""]) == (
        0.01,
        Value(True),
    )
    assert found.unknown == {
        "M92": "E93.00",
        "M203": "E25.00",
        "M201": "E5000",
        "M204": "P500 R1000 T500",
        "M205": "B20000.00 S0.00 T0.00",
    }
    with pytest.raises(FormatError, match="in inches"):
        read(MARLIN.replace("G21", "G20"))


@pytest.mark.parametrize(
    ("rates", "expected"),
    [
        ("M566 X900 Y900\nM203 X18000 Y18000 Z900 ; RepRapFirmware", 18000.0),
        ("M203 X18000 Y18000 Z900 ; maximum speeds (mm/min)", 18000.0),
        ("M203 X300 Y300 Z15 ; maximum speeds (mm/sec)", 18000.0),
        ("M203 X300 Y300 Z15", 18000.0),
        ("M203 X18000 Y18000 Z900", None),
    ],
)
def test_the_unit_of_a_rate_is_that_of_the_firmware_and_kept_as_text_where_nothing_shows_it(
    rates: str, expected: float | None
) -> None:
    found = read(f"M92 X80.00 Y80.00 Z400.00\n{rates}\n")
    assert number(found, "axis.steps", "X") == 80.0
    assert number(found, "axis.max_rate", "X") == expected
    assert found.unknown.get("M203") == (None if expected else "X18000 Y18000 Z900")


def test_a_code_that_comes_again_or_has_words_is_kept_each_time() -> None:
    found = read(MARLIN + 'echo:  M145 S0 H185\necho:  M145 S1 H240\necho:  M569 S1 X Y\nM558 P5 C"probe"\n')
    assert [found.unknown[code] for code in ("M145", "M145 (2)", "M569", "M558")] == [
        "S0 H185",
        "S1 H240",
        "S1 X Y",
        'P5 C"probe"',
    ]


def test_fluidnc_in_a_letter_and_with_an_entry_twice_is_read_and_nothing_is_lost() -> None:
    text = "Here it is:\n\n```yaml\n" + FLUIDNC.replace(
        "  y:\n", "    max_rate_mm_per_min: 600.000 # slower\n  y:\n"
    )
    found = read(text + "```\nWhat is wrong with it?\n")
    assert number(found, "axis.max_rate", "X") == 600.0
    assert found.unknown["axes/x/max_rate_mm_per_min (earlier)"] == "5000.000"
    assert found.unknown["axes/x/homing/cycle"] == "2"
    without_axes = read("board: A\nstepping:\n  engine: RMT\n  idle_ms: 250\n")
    assert number(without_axes, "classic.idle_delay") == 250


def test_fluidnc_is_read_from_its_configuration_and_from_its_entries() -> None:
    entries = (
        "$/axes/x/steps_per_mm=100.000\n$/axes/x/max_rate_mm_per_min=5000.000\n"
        "$/axes/y/steps_per_mm=90.000\n$/stepping/pulse_us=4\n"
    )
    for text in (FLUIDNC, entries):
        found = read(text)
        assert (number(found, "axis.steps", "X"), number(found, "axis.steps", "Y")) == (100.0, 90.0)
        assert number(found, "axis.max_rate", "X") == 5000.0
    found = read(FLUIDNC)
    assert found.unknown["board"] == "six pack"
    assert found.unknown["axes/x/homing/cycle"] == "2"
    assert found.values["build.axes", ""] == Value("XYZ")


def test_sections_that_fluidnc_shows_are_read_under_their_heads() -> None:
    """``$/axes/x`` is answered by the entries below it (RuntimeSetting.cpp)."""
    axis = (
        "$/axes/{0}\n/axes/{0}:\n  steps_per_mm: {1}\n  soft_limits: true\n  motor0:\n"
        "    pulloff_mm: 1.5\nok\n"
    )
    text = (
        axis.format("x", "100.000")
        + axis.format("y", "90.000")
        + "/stepping:\n  pulse_us: 4\nmust_home: false\n"
    )
    found = read(text)
    assert (number(found, "axis.steps", "X"), number(found, "axis.steps", "Y")) == (100.0, 90.0)
    assert (number(found, "limits.soft"), number(found, "homing.pull_off")) == (True, 1.5)
    assert found.unknown == {"must_home": "false"}


def test_what_all_axes_of_fluidnc_agree_in_is_a_setting_of_grbl_and_the_rest_is_kept() -> None:
    """$23 has the bit of an axis that homes in its negative direction (Grbl v1.1 Configuration)."""
    home = (
        "    soft_limits: {}\n    homing:\n      cycle: 1\n      positive_direction: {}\n"
        "      seek_mm_per_min: {}\n"
    )
    motor = "    motor0:\n      hard_limits: false\n      pulloff_mm: 1.500\n"
    axes = "".join(
        f"  {axis}:\n    steps_per_mm: 80.000\n" + home.format("true", direction, speed) + motor
        for axis, direction, speed in (
            ("x", "false", "2000.0"),
            ("y", "false", "2000.0"),
            ("z", "true", "900.0"),
        )
    )
    found = read(f"axes:\n{axes}")
    assert number(found, "limits.soft") is True
    assert number(found, "homing.pull_off") == 1.5
    assert number(found, "homing.invert_direction") == 3
    assert number(found, "homing.seek_rate") is None
    assert found.unknown["axes/z/homing/seek_mm_per_min"] == "900.0"
    one = read("axes:\n" + axes.replace("    soft_limits: true\n", "", 1))
    assert number(one, "limits.soft") is None
    assert one.unknown["axes/y/soft_limits"] == "true"


def test_grbl_esp32_lists_its_settings_by_name() -> None:
    found = read(BY_NAME)
    assert [number(found, "axis.steps", axis) for axis in "XYZ"] == [80.0, 81.0, 82.0]
    assert found.unknown == {"Spindle/Type": "PWM"}
    assert found.machine == "grbl-esp32"


def test_what_is_kept_goes_out_as_remarks(tmp_path: Path) -> None:
    text, made, again = tmp_path / "m503.txt", tmp_path / "made.amp", tmp_path / "again.settings"
    text.write_text(MARLIN, "utf-8")
    assert run(["import", str(text), "-o", str(made)]) == 0
    assert open_file(made).file.unknown["M204"] == "P500 R1000 T500"
    assert run(["export", str(made), "-o", str(again)]) == 0
    assert "; M204 P500 R1000 T500\n" in again.read_text("utf-8")
    assert "\n$110=30000.000\n" in again.read_text("utf-8")
